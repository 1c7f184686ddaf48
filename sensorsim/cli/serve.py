"""`sensorsim serve`: an image generator that a trainer's host drives over CIGI."""

import signal
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from datetime import date, datetime
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from sensorsim.cli.options import (
    Backend,
    Level,
    Preset,
    SceneName,
    bake_progress,
    find_weather,
    local_day,
    read_moment,
    read_size,
)
from sensorsim.environment import Weather
from sensorsim.errors import InputError
from sensorsim.render import World, build_world
from sensorsim.scene import Scene, load_scene
from sensorsim.sensor import load_sensor
from sensorsim.tables import BakeSettings
from sensorsim.tables import preset as bake_preset
from sensorsim.trainer import (
    CIGI_33,
    CIGI_40,
    Endpoint,
    ImageGenerator,
    ImageSettings,
    LocalPlace,
    SessionReport,
    Surroundings,
    UdpEndpoint,
    View,
    build_terrain,
    run_session,
    scene_place,
)
from sensorsim.trainer.background_bake import BackgroundBake, Baked
from sensorsim.trainer.bake_request import BakeRequest
from sensorsim.trainer.delivery import Outlets
from sensorsim.trainer.dis_feed import DisFeed
from sensorsim.trainer.host_weather import host_weather
from sensorsim.trainer.scene_pictures import ScenePictures
from sensorsim.trainer.things import TYPES, Thing
from sensorsim.trainer.vehicle_file import read_vehicle
from sensorsim.trainer.vehicle_shape import VehicleShape
from sensorsim.trainer.vehicles import built_in_vehicles

ENDLESS = 10**9


def serve(
    scene: SceneName,
    sensor: Annotated[
        str, typer.Option("--sensor", "--sensors", help="Sensors by their numbers from 0, with commas between.")
    ] = "flir",
    at: Annotated[str, typer.Option(help="Local standard time until the host sets the clock.")] = "1976-02-07T14:00",
    level: Level = "IIIB",
    size: Annotated[str, typer.Option(help="WIDTHxHEIGHT of every view.")] = "320x240",
    rate: Annotated[float, typer.Option(help="Frames per second.")] = 60.0,
    address: Annotated[str, typer.Option("--bind", help="Address to listen on; this machine alone.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="UDP port to listen on.")] = 8000,
    host: Annotated[str, typer.Option(help="The only address that is heard and answered.")] = "127.0.0.1",
    host_port: Annotated[int, typer.Option(help="UDP port of the host.")] = 8001,
    cigi: Annotated[str, typer.Option(help="3.3 or 4.0, until the host speaks.")] = "3.3",
    asynchronous: Annotated[bool, typer.Option("--asynchronous", help="Both run freely, by timestamps.")] = False,
    ring: Annotated[Path | None, typer.Option(help="File of a ring of pictures, for other programs.")] = None,
    ring_kind: Annotated[str, typer.Option(help="Pictures in it: display, centikelvin or radiance.")] = "display",
    video: Annotated[
        str | None, typer.Option(help="Video of the first view: udp://host:port, rtp://host:port or a .ts file.")
    ] = None,
    bag: Annotated[Path | None, typer.Option(help="MCAP file of the first view's temperatures.")] = None,
    dis: Annotated[int | None, typer.Option(help="UDP port to hear a DIS exercise of the host on, often 3000.")] = None,
    model: Annotated[
        list[str] | None, typer.Option(help="Model in place of truck, tank or car: NAME=FILE (glTF, OBJ).")
    ] = None,
    frames: Annotated[int, typer.Option(help="Frames to serve; 0 for no end.")] = 0,
    weather: Annotated[str | None, typer.Option(help="winter, summer, fall or a file; by date if left out.")] = None,
    preset: Preset = "standard",
    backend: Backend = "auto",
) -> None:
    """Serve a scene to a trainer's host: CIGI over UDP in, pictures out, at a steady rate."""
    say, size_of = Console(stderr=True, soft_wrap=True, highlight=False, markup=False).print, read_size(size)
    endpoint = Endpoint(address=address, port=port, host=host, host_port=host_port)
    sensors = [load_sensor(name) for name in sensor.split(",")]
    place, moment, settings = load_scene(scene, level=level), read_moment(at), bake_preset(preset)
    series = find_weather(weather, local_day(moment, place.site.utc_offset))
    world = _world(place, series, local_day(moment, series.site.utc_offset), settings)
    start = moment if moment.tzinfo else moment.replace(tzinfo=world.environment.image_start.tzinfo)
    asked = _settings(start, len(sensors), cigi, asynchronous)
    shapes = {**built_in_vehicles(), **_models(model or [])}
    ig = ImageGenerator(asked, _around(place, shapes), utc_offset=series.site.utc_offset)

    def told(done: Baked) -> None:
        say(f"bake of {done.request.day}: {done.reason or 'done, in use'}")
        ig.bake_refused(done.reason) if done.world is None else ig.bake_done(done.request)

    outlets = Outlets(ring=ring, ring_kind=ring_kind, video=video, bag=bag)
    with ExitStack() as stack:
        stopped = stack.enter_context(_stopped_by_signals())
        draw = ScenePictures(
            world, sensors, size_of, bake=_baker(place, series, settings), on_bake=told, say=say, backend=backend,
            planes=outlets.planes, shapes=shapes,
            heard=_heard(stack, endpoint, dis, ig.around.place),
        )  # fmt: skip
        stack.enter_context(draw).prepare(range(len(sensors)))
        link = stack.enter_context(UdpEndpoint(endpoint))
        deliver = outlets.open(stack, size_of, rate, ig.around.place, sensors[0].name, say)
        say(f"serving {place.name} {place.level} on {address}:{link.port} to {host}:{host_port}")
        report = run_session(ig, link, draw, deliver, rate=rate, frames=frames or ENDLESS, stop=stopped.is_set)
    say(_summary(report, link))


def _world(scene: Scene, series: Weather, day: date, settings: BakeSettings) -> World:
    with bake_progress("baking") as progress:
        return build_world(scene, series, image_day=day, settings=settings, progress=progress)


def _settings(start: datetime, views: int, cigi: str, asynchronous: bool) -> ImageSettings:
    """One view for each sensor, all of entity 0."""
    dialects = {"3.3": CIGI_33, "4.0": CIGI_40}
    if cigi not in dialects:
        raise InputError("command line", "--cigi", cigi, "unknown", f"use {' or '.join(dialects)}")
    return ImageSettings(
        start=start,
        views=tuple(View(number=number, view_type=number) for number in range(views)),
        dialect=dialects[cigi],
        synchronous=not asynchronous,
    )


def _around(scene: Scene, shapes: Mapping[str, VehicleShape]) -> Surroundings:
    return Surroundings(place=scene_place(scene), terrain=build_terrain(scene), shapes=shapes)


def _baker(scene: Scene, series: Weather, settings: BakeSettings) -> BackgroundBake:
    """Bakes what the host wants from the weather of its day where there is one, else from the one at hand."""

    def bake(wanted: BakeRequest, moment: datetime) -> World:
        weather = host_weather(_weather_of(wanted.day, series), wanted, moment)
        return build_world(scene, weather, image_day=wanted.day, settings=settings)

    return BackgroundBake(bake)


def _weather_of(day: date, series: Weather) -> Weather:
    try:
        return find_weather(None, day)
    except InputError:
        return series


def _models(words: list[str]) -> dict[str, VehicleShape]:
    """Shapes by the names of vehicles that they stand for."""
    shapes = {}
    for word in words:
        name, _, path = word.partition("=")
        if name not in TYPES.values() or not path:
            problem = f"no NAME=FILE with a name of {', '.join(TYPES.values())}"
            raise InputError("command line", "--model", word, problem, "write for example tank=tank.glb")
        shapes[name] = read_vehicle(Path(path))
    return shapes


def _heard(
    stack: ExitStack, endpoint: Endpoint, port: int | None, place: LocalPlace
) -> Callable[[float], Sequence[Thing]]:
    """Vehicles of the host's DIS exercise, none where no port was given."""
    if port is None:
        return lambda _: ()
    return stack.enter_context(DisFeed(replace(endpoint, port=port), place))


@contextmanager
def _stopped_by_signals() -> Iterator[threading.Event]:
    """An event that Ctrl-C and SIGTERM set in place of ending the program."""
    stopped = threading.Event()
    before = {number: signal.signal(number, lambda *_: stopped.set()) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield stopped
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _summary(report: SessionReport, link: UdpEndpoint) -> str:
    median, high = (1e3 * value for value in report.latency)
    return (
        f"{report.frames} frames, {report.late} without their message, {report.overrun} periods lost, "
        f"{report.refused} packets refused, {link.from_others} from others, {link.too_fast} too fast; "
        f"host message to picture {median:.1f} ms, 99 % within {high:.1f} ms"
    )
