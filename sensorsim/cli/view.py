"""`sensorsim view`: fly through a scene in a window."""

from datetime import time
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from sensorsim.cli.options import Backend, Level, Preset, SceneName, bake_progress, read_moment, read_size
from sensorsim.cli.render import read_camera
from sensorsim.environment import read_weather
from sensorsim.errors import InputError
from sensorsim.frames.camera_path import read_camera_path
from sensorsim.render import World, build_world
from sensorsim.scene import load_scene
from sensorsim.sensor import Sensor, load_sensor
from sensorsim.sensor.load import sensor_names
from sensorsim.tables import preset as bake_preset
from sensorsim.tables.bake import Progress
from sensorsim.viewer import Place, ViewState, read_script
from sensorsim.viewer.choices import choosable_days, default_day, shipped_days, weather_name
from sensorsim.viewer.stage import SCALES

EXTRA = "pip install 'sensorsim[viewer]'"


def view(
    scene: SceneName,
    at: Annotated[
        str | None, typer.Option(help="Local standard time to begin with: 1976-02-07T10:00; 10 h if left out.")
    ] = None,
    level: Level = "IIIB",
    sensor: Annotated[str, typer.Option(help="Sensor to begin with: a name, or a TOML file.")] = "flir",
    weather: Annotated[
        str | None, typer.Option(help="winter, summer, fall or a file; by date, else winter, if left out.")
    ] = None,
    preset: Preset = "standard",
    size: Annotated[str, typer.Option(help="WIDTHxHEIGHT of the window in pixels.")] = "1280x720",
    camera: Annotated[
        str | None, typer.Option(help="Camera of the scene, or east,north,up,yaw,pitch in m and deg.")
    ] = None,
    path: Annotated[Path | None, typer.Option(help="Camera path to replay (Backspace).")] = None,
    out: Annotated[Path, typer.Option(help="Folder of what is saved.")] = Path("views"),
    scale: Annotated[
        float | None, typer.Option(help="Window pixels per pixel drawn; as many as keep it fluid if left out.")
    ] = None,
    script: Annotated[
        Path | None,
        typer.Option(help="File of timed inputs, for checks without hands: see sensorsim/viewer/script.py."),
    ] = None,
    frames: Annotated[int | None, typer.Option(help="Close after so many frames.")] = None,
    backend: Backend = "auto",
) -> None:
    """Fly through a scene in a window. H shows the keys."""
    run_viewer, viewer_options = _window_parts()
    _check(scale, frames)
    steps = None if script is None else read_script(script)
    sensors = _sensors(sensor)
    place = _place(at, weather, level)
    hour = read_moment(at).time() if at is not None else time(10)
    settings = bake_preset(preset)

    def build(asked: Place, progress: Progress) -> World:
        return build_world(
            load_scene(scene, level=asked.level), read_weather(asked.weather), image_day=asked.day, settings=settings,
            progress=progress,
        )  # fmt: skip

    opening = read_camera(load_scene(scene, level=level), camera, None)
    with bake_progress("baking") as progress:
        world = build(place, progress)
    for warning in world.warnings:
        Console(stderr=True, soft_wrap=True).print(f"warning: {warning}", style="yellow", markup=False, highlight=False)
    first = load_sensor(sensor).name
    state = ViewState(
        camera=opening, time_of_day=3600.0 * hour.hour + 60.0 * hour.minute + float(hour.second), place=place,
        sensors=(first, "lltv" if first != "lltv" else "flir"), scale=scale,
    )  # fmt: skip
    options = viewer_options(
        size=read_size(size), folder=out, sensors=sensors, days=choosable_days(place.weather, place.day), build=build,
        backend=backend, script=steps, frames=frames,
        flight=None if path is None else read_camera_path(path, world.scene.frame),
    )  # fmt: skip
    run_viewer(world, state, options)


def _window_parts() -> tuple[Any, Any]:
    """The parts that need the extra and a display."""
    try:
        from sensorsim.viewer import window
        from sensorsim.viewer.viewer import ViewerOptions, run_viewer
    except ImportError as error:
        problem = f"{error.name} is not installed" if error.name else str(error)
        raise InputError("sensorsim view", "extra", "viewer", problem, EXTRA) from error
    window.check_display()
    return run_viewer, ViewerOptions


def _check(scale: float | None, frames: int | None) -> None:
    if scale is not None and scale not in SCALES:
        known = ", ".join(f"{step:g}" for step in SCALES)
        raise InputError("command line", "--scale", scale, "not one of the steps", f"use {known}")
    if frames is not None and frames < 1:
        raise InputError("command line", "--frames", frames, "below 1", "give a number of frames")


def _sensors(chosen: str) -> dict[str, Sensor]:
    """All sensors by name: the two of the report, the others that come with the package, and the user's own."""
    names = dict.fromkeys(["flir", "lltv", *sensor_names(), chosen])
    return {device.name: device for device in map(load_sensor, names)}


def _place(at: str | None, weather: str | None, level: str) -> Place:
    """Level, weather and day: without a time the weather's own day, without both the first that is shipped."""
    shipped = shipped_days()
    if at is not None:
        day = read_moment(at).date()
        return Place(level=level, weather=weather_name(weather, day), day=day)
    name = shipped[0][0] if weather is None else weather
    days = dict(shipped) | {own.isoformat(): own for _, own in shipped}
    day = days[name] if name in days else default_day(read_weather(name))
    return Place(level=level, weather=weather_name(name, day), day=day)
