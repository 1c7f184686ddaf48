"""`sensorsim study city`: what a large scene costs to build and to draw, and that a frame goes by what it sees."""

import json
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from sensorsim.cli.options import AsJson, Backend, Preset, read_size
from sensorsim.errors import InputError
from sensorsim.sensor import load_sensor
from sensorsim.study.city_bench import CityBench, run_city
from sensorsim.tables import preset as bake_preset


def city(
    buildings: Annotated[int, typer.Option(help="Buildings of the city, of ten triangles each and more.")] = 100_000,
    size: Annotated[str, typer.Option(help="WIDTHxHEIGHT in pixels.")] = "640x480",
    sensor: Annotated[str, typer.Option(help="Sensor that comes with the package, or a TOML file.")] = "flir1977",
    frames: Annotated[int, typer.Option(help="Frames that are measured of each view.")] = 15,
    preset: Preset = "standard",
    backend: Backend = "auto",
    as_json: AsJson = False,
) -> None:
    """Generate a city, build it as any scene, and measure views that see little of it, much of it and all."""
    if frames < 1:
        raise InputError("command line", "--frames", frames, "no frame", "give 1 or more")
    with TemporaryDirectory() as folder:
        found = run_city(
            buildings, load_sensor(sensor), Path(folder), size=read_size(size), frames=frames,
            settings=bake_preset(preset), backend=backend,
        )  # fmt: skip
    if as_json:
        print(json.dumps(found.to_dict()))  # noqa: T201
    else:
        _show(found)


def _show(found: CityBench) -> None:
    console = Console(highlight=False)
    console.print(
        f"{found.buildings} buildings, {found.triangles} triangles in {found.tiles} tiles, {found.surfaces} surfaces; "
        f"{found.size[0]} x {found.size[1]}, {found.renderer}",
        markup=False,
    )
    steps = Table("build", "wall s", "processor s")
    for name, span in found.build.items():
        steps.add_row(name, f"{span.wall:.2f}", f"{span.processor:.2f}")
    console.print(steps)
    console.print(f"at most {found.peak_mib:.0f} MiB of memory")
    views = Table("view", "triangles", "tiles", "wall ms", "processor ms")
    for name, view in found.views.items():
        views.add_row(
            name, str(view.triangles), str(view.tiles), f"{view.frame_ms:.1f}", f"{view.processor_ms:.1f}"
        )  # fmt: skip
    console.print(views)
