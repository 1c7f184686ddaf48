"""`sensorsim bench`: what a frame costs, in stages, against one colour and against other renderers."""

import json
from datetime import date
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from sensorsim.cli.options import AsJson, Backend, Level, Preset, bake_progress, read_size
from sensorsim.environment import read_weather
from sensorsim.errors import InputError
from sensorsim.render import build_world, station_camera
from sensorsim.scene import load_scene
from sensorsim.sensor import load_sensor
from sensorsim.study.bench import Bench, run_bench
from sensorsim.tables import preset as bake_preset

DAY = date(1976, 2, 7)


def bench(
    scene: Annotated[str, typer.Argument(help="Scene that comes with the package, or a GeoJSON file.")] = "hospital",
    level: Level = "IIIB",
    size: Annotated[str, typer.Option(help="WIDTHxHEIGHT in pixels.")] = "640x480",
    sensor: Annotated[str, typer.Option(help="Sensor that comes with the package, or a TOML file.")] = "flir1977",
    camera: Annotated[str | None, typer.Option(help="Camera of the scene, its first if left out.")] = None,
    frames: Annotated[int, typer.Option(help="Frames that are measured.")] = 30,
    peers: Annotated[
        bool, typer.Option("--peers", help="Also pyrender, VTK through pyvista and Panda3D, where installed.")
    ] = False,
    growth: Annotated[bool, typer.Option(help="Also with more pixels, triangles, surfaces and wall types.")] = True,
    preset: Preset = "standard",
    backend: Backend = "auto",
    as_json: AsJson = False,
) -> None:
    """Measure frames for display alone, medians over frames that take turns with one colour on the same triangles."""
    pixels = read_size(size)
    if frames < 1:
        raise InputError("command line", "--frames", frames, "no frame", "give 1 or more")
    place = load_scene(scene, level=level)
    view = station_camera(place, place.cameras[0].name if camera is None else camera)
    with bake_progress("baking") as progress:
        world = build_world(
            place, read_weather("winter"), image_day=DAY, settings=bake_preset(preset), progress=progress
        )
    found = run_bench(
        world, load_sensor(sensor), view, size=pixels, frames=frames, peers=peers, growth=growth, backend=backend
    )
    if as_json:
        print(json.dumps(found.to_dict()))  # noqa: T201
    else:
        _show(found)


def _show(found: Bench) -> None:
    console = Console(highlight=False)
    size = f"{found.size[0]} x {found.size[1]}"
    console.print(f"{found.scene}, {found.sensor}, {size}, {found.renderer}", markup=False)
    console.print(f"{found.triangles} triangles, {found.surfaces} surfaces, {found.wall_types} wall types")
    table = Table("", "wall ms", "processor ms", title_justify="left")
    table.add_row("frame", f"{found.frame_ms:.2f}", f"{found.processor_ms:.2f}")
    for stage, span in found.stages_ms.items():
        table.add_row(f"  {stage}", f"{span:.2f}", "")
    table.add_row("one colour", f"{found.constant_colour_ms:.2f}", f"{found.constant_colour_processor_ms:.2f}")
    table.add_row("ratio", f"{found.ratio_constant_colour:.2f}", f"{found.ratio_processor:.2f}")
    for name, times in found.peers.items():
        cells = (times, "") if isinstance(times, str) else (f"{value:.2f}" for value in times.values())
        table.add_row(name, *cells)
    for name, rows in found.growth.items():
        for row in rows:
            table.add_row(f"{row['count']:.0f} {name}", f"{row['frame_ms']:.2f}", f"{row['processor_ms']:.2f}")
    console.print(table)
    console.print(f"{found.frames_per_second:.1f} frames/s")
