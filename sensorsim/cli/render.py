"""`sensorsim render`: one frame to disk."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from rich.console import Console

from sensorsim.cli.options import (
    Aerosol,
    AnyLevel,
    AsJson,
    Atmosphere,
    Backend,
    Effects,
    Enhance,
    Exchange,
    Preset,
    Radiance,
    SceneName,
    Visibility,
    bake_progress,
    find_weather,
    local_day,
    make_folder,
    read_atmosphere,
    read_effects,
    read_moment,
    read_scene,
    read_size,
    show_warnings,
    with_display,
)
from sensorsim.environment import DEFAULT_VISIBILITY
from sensorsim.errors import InputError, NumericsError
from sensorsim.frames import Frame, plane_names, require_writable, take_frame, write_frame
from sensorsim.radiometry import build_band_table
from sensorsim.render import Camera, Renderer, build_world, station_camera
from sensorsim.render.air import DEFAULT_ATMOSPHERE
from sensorsim.scene import Scene
from sensorsim.sensor import DisplaySettings, Sensor, load_sensor, window_from_temperatures
from sensorsim.tables import preset as bake_preset


def render(
    scene: SceneName,
    at: Annotated[
        str, typer.Option(help="Local standard time, ISO 8601: 1976-02-07T10:00, or with its own UTC offset.")
    ],
    out: Annotated[Path, typer.Option(help="File of the picture: .png, or .exr, .npy, .tiff for planes alone.")],
    level: AnyLevel = "IIIB",
    sensor: Annotated[
        str, typer.Option(help="Sensor that comes with the package (flir, lltv), or a TOML file.")
    ] = "flir",
    camera: Annotated[
        str | None,
        typer.Option(help="Camera of the scene, its first if left out, or east,north,up,yaw,pitch in m and deg."),
    ] = None,
    field_of_view: Annotated[float | None, typer.Option(help="Horizontal field of view [deg].")] = None,
    size: Annotated[str | None, typer.Option(help="WIDTHxHEIGHT in pixels; the sensor's own if left out.")] = None,
    weather: Annotated[
        str | None, typer.Option(help="winter, summer, fall, or a CSV, TMY3 or EPW file; by date if left out.")
    ] = None,
    planes: Annotated[str, typer.Option(help="Planes to write beside the picture, with commas between.")] = "",
    plane_format: Annotated[
        str, typer.Option(help="exr, npy, or png and tiff of 16 bits: centikelvin, counts.")
    ] = "exr",
    window: Annotated[str | None, typer.Option(help="Black and white as temperatures COLD:WARM [K].")] = None,
    polarity: Annotated[str | None, typer.Option(help="white-hot or black-hot; the sensor's own if left out.")] = None,
    enhance: Enhance = None,
    atmosphere: Atmosphere = DEFAULT_ATMOSPHERE,
    radiance: Radiance = "apparent",
    visibility: Visibility = DEFAULT_VISIBILITY / 1000.0,
    aerosol: Aerosol = "rural",
    preset: Preset = "standard",
    exchange: Exchange = False,
    effects: Effects = "auto",
    backend: Backend = "auto",
    as_json: AsJson = False,
) -> None:
    """Render one frame and write it with a sidecar of all its inputs."""
    device = with_display(load_sensor(sensor), detail=enhance)
    pixels = device.size if size is None else read_size(size)
    display = _display(device, window, polarity)
    wanted = [name for name in planes.split(",") if name]
    require_writable(out, plane_names(device), planes=wanted, plane_format=plane_format)
    choice = read_effects(effects, wanted)
    moment = read_moment(at)
    place, detail = read_scene(scene, level)
    view = read_camera(place, camera, field_of_view)
    series = find_weather(weather, local_day(moment, place.site.utc_offset))
    day = local_day(moment, series.site.utc_offset)
    settings = replace(bake_preset(preset), exchange=exchange)
    air = read_atmosphere(atmosphere, radiance)
    make_folder(out.parent)
    with bake_progress("baking") as progress:
        world = build_world(
            place, series, image_day=day, settings=settings, progress=progress, visibility=1000.0 * visibility,
            aerosol=aerosol, effects=choice, sensor=device,
        )  # fmt: skip
    show_warnings(world.warnings)
    with Renderer(world, device, size=pixels, backend=backend, atmosphere=air, detail=detail) as renderer:
        frame = take_frame(renderer, view, moment, display=display, fit_error="fit_error" in wanted)
    files = write_frame(frame, out, planes=wanted, plane_format=plane_format)
    _report(frame, files, as_json)


def read_camera(scene: Scene, text: str | None, field_of_view: float | None) -> Camera:
    """The scene's camera of that name, its first where none is named, or one from five numbers."""
    if text is None:
        return station_camera(scene, scene.cameras[0].name, horizontal_field_of_view=field_of_view)
    if "," in text:
        try:
            east, north, up, yaw, pitch = (float(part) for part in text.split(","))
        except ValueError as error:
            remedy = "write east,north,up,yaw,pitch or a name"
            raise InputError("command line", "--camera", text, "not five numbers", remedy) from error
        field = 40.0 if field_of_view is None else field_of_view
        return Camera(position=np.array([east, north, up]), yaw=yaw, pitch=pitch, horizontal_field_of_view=field)
    return station_camera(scene, text, horizontal_field_of_view=field_of_view)


def _display(sensor: Sensor, window: str | None, polarity: str | None) -> DisplaySettings:
    chosen: Any = sensor.display.polarity if polarity is None else polarity  # DisplaySettings refuses any other word
    if window is None:
        return replace(sensor.display, polarity=chosen)
    try:
        cold, warm = (float(part) for part in window.split(":"))
    except ValueError as error:
        raise InputError("command line", "--window", window, "no COLD:WARM", "write for example 260:300") from error
    if sensor.mode != "emissive":
        remedy = "leave it out for this sensor"
        raise InputError("command line", "--window", window, f"{sensor.name} sees reflected light", remedy)
    try:
        level, span = window_from_temperatures(build_band_table(sensor.band), cold, warm)
    except NumericsError as error:
        remedy = "give temperatures from 150 to 700 K"
        raise InputError("command line", "--window", window, "outside of the sensor's table", remedy) from error
    return replace(sensor.display, polarity=chosen, level=level, span=span)


def _report(frame: Frame, files: list[Path], as_json: bool) -> None:
    if as_json:
        limits = {name: plane.limits for name, plane in frame.planes.items()}
        print(json.dumps({"files": [str(path) for path in files], "limits": limits, "settings": frame.settings}))  # noqa: T201
        return
    console = Console(soft_wrap=True)
    for path in files:
        console.print(f"wrote {path}", markup=False, highlight=False)
