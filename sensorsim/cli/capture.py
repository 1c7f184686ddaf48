"""`sensorsim capture`: sequences of frames to disk, resumed where they were cut off."""

import math
import multiprocessing
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass, replace
from datetime import datetime
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

from sensorsim.cli.options import (
    Aerosol,
    AnyLevel,
    Atmosphere,
    Backend,
    Effects,
    Enhance,
    Exchange,
    Preset,
    Radiance,
    SceneName,
    Settle,
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
from sensorsim.cli.render import read_camera
from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.environment import DEFAULT_VISIBILITY
from sensorsim.errors import InputError
from sensorsim.frames.camera_path import CameraPath, read_camera_path
from sensorsim.frames.sequence import SequenceOptions, Shot, draw_block, frame_path, sequence_blocks
from sensorsim.frames.side_by_side import join_frames
from sensorsim.frames.video import VIDEO_SUFFIXES, write_video
from sensorsim.render import Renderer, World, build_world
from sensorsim.render.air import DEFAULT_ATMOSPHERE
from sensorsim.render.detail import DetailRule
from sensorsim.scene import Scene
from sensorsim.sensor import Sensor, load_sensor
from sensorsim.tables import preset as bake_preset

FORMATS = ("png", "exr", "npy", "tiff")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Job:
    """A block of one sensor, for a process of its own."""

    world: World
    sensor: Sensor
    size: tuple[int, int] | None
    samples: int
    backend: str
    atmosphere: str
    shots: tuple[Shot, ...]
    numbers: range
    options: SequenceOptions
    detail: DetailRule


def capture(
    scene: SceneName,
    at: Annotated[str, typer.Option(help="Local standard time of the first frame: 1976-02-07T10:00.")],
    out: Annotated[Path, typer.Option(help="Folder of the frames.")],
    path: Annotated[
        Path | None, typer.Option(help="Camera path: CSV of t,lat,lon,alt,yaw,pitch,roll,hfov, or TUM poses (.tum).")
    ] = None,
    camera: Annotated[str | None, typer.Option(help="Camera of the scene, where there is no path.")] = None,
    until: Annotated[str | None, typer.Option(help="Local standard time of the last frame, without a path.")] = None,
    every: Annotated[float, typer.Option(help="Seconds between frames, without a path.")] = 900.0,
    rate: Annotated[
        float | None, typer.Option(help="Frames per second along a path; its own times if left out.")
    ] = None,
    level: AnyLevel = "IIIB",
    sensors: Annotated[str, typer.Option("--sensors", "--sensor", help="Sensors, with commas between.")] = "flir",
    size: Annotated[str | None, typer.Option(help="WIDTHxHEIGHT in pixels; each sensor's own if left out.")] = None,
    samples: Annotated[int, typer.Option(help="Samples per pixel's side of sensors with optics: 1, 3, 5 or 7.")] = 1,
    weather: Annotated[str | None, typer.Option(help="winter, summer, fall or a file; by date if left out.")] = None,
    planes: Annotated[str, typer.Option(help="Planes to write, with commas between.")] = "",
    file_format: Annotated[
        str, typer.Option("--format", help="png (with planes beside it), exr, npy or tiff.")
    ] = "png",
    plane_format: Annotated[str, typer.Option(help="Of planes beside a png: exr, npy, png or tiff.")] = "exr",
    enhance: Enhance = None,
    settle: Settle = None,
    video: Annotated[str | None, typer.Option(help="Also join the pictures: mp4 or gif.")] = None,
    video_rate: Annotated[float, typer.Option(help="Pictures per second of the video.")] = 30.0,
    side_by_side: Annotated[
        bool, typer.Option("--side-by-side", help="Also join the sensors' pictures of each moment, and their videos.")
    ] = False,
    jobs: Annotated[int, typer.Option(help="Processes that draw at once.")] = 1,
    atmosphere: Atmosphere = DEFAULT_ATMOSPHERE,
    radiance: Radiance = "apparent",
    visibility: Visibility = DEFAULT_VISIBILITY / 1000.0,
    aerosol: Aerosol = "rural",
    preset: Preset = "standard",
    exchange: Exchange = False,
    effects: Effects = "auto",
    backend: Backend = "auto",
) -> None:
    """Render a sequence; run again, it goes on where it was cut off, without redoing what is whole."""
    _check(jobs, every, file_format, video)
    devices = [with_display(one, detail=enhance, settle=settle) for one in _sensors(sensors, side_by_side, file_format)]
    pixels, air = None if size is None else read_size(size), read_atmosphere(atmosphere, radiance)
    moment = read_moment(at)
    place, detail = read_scene(scene, level)
    route = _route(place, path, rate, camera, moment, until, every)
    names = tuple(name for name in planes.split(",") if name)
    found = find_weather(weather, local_day(moment, place.site.utc_offset))
    build = partial(
        build_world, place, found, image_day=local_day(moment, found.site.utc_offset),
        settings=replace(bake_preset(preset), exchange=exchange), visibility=1000.0 * visibility, aerosol=aerosol,
        effects=read_effects(effects, names),
    )  # fmt: skip
    worlds = [_world(build, device) for device in devices]
    show_warnings(warning for world in worlds for warning in world.warnings)
    shots = _shots(route, moment, worlds[0])
    make_folder(out)
    options = SequenceOptions(folder=out, planes=names, plane_format=plane_format, suffix=f".{file_format}")
    work = [
        _Job(
            world=world, sensor=device, size=pixels, samples=samples if device.detector else 1, backend=backend,
            atmosphere=air, shots=shots, numbers=numbers, options=options, detail=detail,
        )
        for world, device in zip(worlds, devices, strict=True)
        for numbers in sequence_blocks(device, shots)
    ]  # fmt: skip
    _draw_all(work, jobs, len(shots) * len(devices))
    series = {device.name: [frame_path(options, device, shot.number) for shot in shots] for device in devices}
    _finish(series, out, side_by_side, video, video_rate)


def _sensors(names: str, side_by_side: bool, file_format: str) -> list[Sensor]:
    devices = [load_sensor(name) for name in names.split(",")]
    if side_by_side and (len(devices) < 2 or file_format != "png"):
        remedy = "give --sensors flir,lltv and --format png"
        raise InputError("command line", "--side-by-side", names, "needs pictures of two sensors", remedy)
    return devices


def _world(build: Callable[..., World], sensor: Sensor) -> World:
    """The scene for one sensor: what may be left out depends on its noise."""
    with bake_progress("baking") as progress:
        return build(progress=progress, sensor=sensor)


def _finish(
    series: Mapping[str, Sequence[Path]], out: Path, side_by_side: bool, video: str | None, rate: float
) -> None:
    """Pictures of several sensors joined, and videos of all."""
    shown = dict(series)
    if side_by_side:
        name = "_".join(series)
        shown[name] = [out / f"{name}_{number:06d}.png" for number in range(len(next(iter(series.values()))))]
        for target, *pictures in zip(shown[name], *series.values(), strict=True):
            join_frames(pictures, target)
    for name, frames in shown.items() if video else ():
        write_video(frames, out / f"{name}.{video}", rate)
        Console(soft_wrap=True).print(f"wrote {out / f'{name}.{video}'}", markup=False, highlight=False)


def _check(jobs: int, every: float, file_format: str, video: str | None) -> None:
    if not 1 <= jobs <= 256:
        raise InputError("command line", "--jobs", jobs, "not 1 to 256", "use about as many as there are cores")
    if not (math.isfinite(every) and every > 0.0):
        raise InputError("command line", "--every", every, "not above 0", "give seconds between frames")
    if file_format not in FORMATS:
        raise InputError("command line", "--format", file_format, "unknown", f"use {', '.join(FORMATS)}")
    if video is not None and (video not in VIDEO_SUFFIXES or file_format != "png"):
        remedy = f"use {' or '.join(VIDEO_SUFFIXES)} with --format png"
        raise InputError("command line", "--video", video, "cannot be made of these frames", remedy)


def _route(
    scene: Scene,
    path: Path | None,
    rate: float | None,
    camera: str | None,
    at: datetime,
    until: str | None,
    every: float,
) -> CameraPath:
    """The cameras of a file, or one camera from `at` to `until`."""
    if path is not None:
        if camera is not None or until is not None:
            raise InputError("command line", "--path", str(path), "beside --camera or --until", "give one of them")
        route = read_camera_path(path, scene.frame)
        return route if rate is None else route.resample(rate)
    view = read_camera(scene, camera, None)
    span = 0.0 if until is None else (read_moment(until) - at).total_seconds()
    if span < 0.0:
        raise InputError("command line", "--until", until, "before --at", "give the later time")
    count = math.floor(span / every + 1e-9) + 1
    return CameraPath(time=tuple(every * number for number in range(count)), camera=(view,) * count)


def _shots(route: CameraPath, at: datetime, world: World) -> tuple[Shot, ...]:
    """Frames of a route that begins `at`; InputError where it leaves the day that is baked."""
    midnight = world.environment.image_start
    start = ((at if at.tzinfo else at.replace(tzinfo=midnight.tzinfo)) - midnight).total_seconds()
    times = [start + second - route.time[0] for second in route.time]
    if not (times[0] >= 0.0 and times[-1] <= SECONDS_PER_DAY):
        problem = f"leaves the day of {midnight.date().isoformat()}"
        raise InputError("command line", "--at", at.isoformat(), problem, "capture each day on its own")
    return tuple(
        Shot(number=number, time_of_day=time, camera=view)
        for number, (time, view) in enumerate(zip(times, route.camera, strict=True))
    )


def _draw_all(work: Sequence[_Job], jobs: int, total: int) -> None:
    """All blocks, in this process or in several, with a bar."""
    console = Console(stderr=True)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=console, disable=not console.is_terminal) as bar:
        task = bar.add_task("frames", total=total)
        written = 0
        for done, new in _outcomes(work, jobs):
            bar.update(task, advance=done)
            written += new
    console.print(f"{written} frames written, {total - written} were there", highlight=False)


def _outcomes(work: Sequence[_Job], jobs: int) -> Iterator[tuple[int, int]]:
    """Frames done and newly written, block by block."""
    if jobs == 1:
        yield from map(_draw, work)
        return
    # A fresh process for each worker: an OpenGL context does not survive a fork.
    with ProcessPoolExecutor(max_workers=jobs, mp_context=multiprocessing.get_context("spawn")) as pool:
        for future in as_completed([pool.submit(_draw, job) for job in work]):
            yield future.result()


def _draw(job: _Job) -> tuple[int, int]:
    """One block: frames done, frames newly written."""
    with Renderer(
        job.world, job.sensor, size=job.size, samples=job.samples, backend=job.backend, atmosphere=job.atmosphere,
        detail=job.detail,
    ) as renderer:  # fmt: skip
        return len(job.numbers), draw_block(renderer, job.shots, job.numbers, job.options)
