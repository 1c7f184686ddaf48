"""`sensorsim view`: fly through a scene in a window."""

from dataclasses import replace
from datetime import timedelta
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console

from sensorsim.cli.options import (
    AnyLevel,
    Backend,
    Effects,
    Preset,
    SceneName,
    bake_progress,
    find_weather,
    local_day,
    read_moment,
    read_scene,
    read_size,
)
from sensorsim.cli.render import read_camera
from sensorsim.effects import read_choice
from sensorsim.environment import read_weather
from sensorsim.errors import InputError
from sensorsim.frames.camera_path import read_camera_path
from sensorsim.render import World, build_world
from sensorsim.sensor import Sensor, load_sensor
from sensorsim.sensor.load import sensor_names
from sensorsim.tables import BakeSettings
from sensorsim.tables import preset as bake_preset
from sensorsim.tables.bake import Progress
from sensorsim.viewer import Place, ViewState, read_script
from sensorsim.viewer.choices import choosable_days, default_day, shipped_days, weather_name
from sensorsim.viewer.effect_list import baked_choice, with_choice
from sensorsim.viewer.stage import SCALES

EXTRA = "pip install 'sensorsim[viewer]'"


def view(
    scene: SceneName,
    at: Annotated[
        str | None, typer.Option(help="Local standard time to begin with: 1976-02-07T10:00; 10 h if left out.")
    ] = None,
    level: AnyLevel = "IIIB",
    sensor: Annotated[str, typer.Option(help="Sensor to begin with: a name, or a TOML file.")] = "flir",
    weather: Annotated[
        str | None, typer.Option(help="winter, summer, fall or a file; by date, else winter, if left out.")
    ] = None,
    preset: Preset = "standard",
    effects: Effects = "all",
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
    sensors, pixels = _sensors(sensor), read_size(size)
    ground, rule = read_scene(scene, level)
    place = replace(_place(at, weather, ground.level, ground.site.utc_offset), choice=read_choice(effects))
    build = partial(_build, scene, bake_preset(preset))
    opening, first = read_camera(ground, camera, None), load_sensor(sensor).name
    options = viewer_options(
        size=pixels, folder=out, sensors=sensors, days=choosable_days(place.weather, place.day), build=build,
        backend=backend, detail=replace(rule, steady=True), frames=frames,
        script=None if script is None else read_script(script),
        flight=None if path is None else read_camera_path(path, ground.frame),
    )  # fmt: skip
    with bake_progress("baking") as progress:
        world = build(place, progress)
    for warning in world.warnings:
        Console(stderr=True, soft_wrap=True).print(f"warning: {warning}", style="yellow", markup=False, highlight=False)
    state = ViewState(
        camera=opening, time_of_day=_time_of_day(at, world), place=place,
        sensors=(first, "lltv" if first != "lltv" else "flir"), scale=scale,
    )  # fmt: skip
    run_viewer(world, state, options)


def _build(scene: str, settings: BakeSettings, asked: Place, progress: Progress) -> World:
    """The world of a place; the baker calls it from a thread."""
    whole, _ = read_scene(scene, asked.level)
    baked = build_world(
        whole, read_weather(asked.weather), image_day=asked.day, settings=settings, progress=progress,
        effects=baked_choice(asked.choice),
    )  # fmt: skip
    return with_choice(baked, asked.choice)


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


def _time_of_day(at: str | None, world: World) -> float:
    """Seconds after midnight of the world's day; 10 h where no time was given."""
    midnight = world.environment.image_start
    moment = midnight + timedelta(hours=10) if at is None else read_moment(at)
    return (moment.replace(tzinfo=moment.tzinfo or midnight.tzinfo) - midnight).total_seconds()


def _place(at: str | None, weather: str | None, level: str, utc_offset: float) -> Place:
    """Level, weather and day: without a time the weather's own day, without both the first that is shipped."""
    shipped = shipped_days()
    if at is not None:
        moment = read_moment(at)
        here = local_day(moment, utc_offset)
        series = find_weather(weather, here)
        return Place(level=level, weather=weather_name(weather, here), day=local_day(moment, series.site.utc_offset))
    name = shipped[0][0] if weather is None else weather
    days = dict(shipped) | {own.isoformat(): own for _, own in shipped}
    day = days[name] if name in days else default_day(read_weather(name))
    return Place(level=level, weather=weather_name(name, day), day=day)
