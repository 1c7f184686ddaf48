"""Options that commands share, and the readers of their values."""

from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from datetime import date, datetime, timedelta, timezone
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from sensorsim.effects import EffectChoice, read_choice
from sensorsim.environment import Weather, read_weather
from sensorsim.errors import InputError
from sensorsim.render.air import check_atmosphere
from sensorsim.render.detail import DetailRule
from sensorsim.scene import ALL_LEVELS, Scene, load_all_levels, load_scene
from sensorsim.sensor import Sensor
from sensorsim.tables.bake import Progress as BakeProgress

SceneName = Annotated[str, typer.Argument(help="Scene that comes with the package, or a GeoJSON file.")]
Level = Annotated[str, typer.Option(help="Level of detail: IA, IIA or IIIB.")]
AnyLevel = Annotated[
    str,
    typer.Option(
        help="Level of detail: IA, IIA, IIIB, or auto: each feature as finely as its pixels show; auto:4 for 4."
    ),
]
Preset = Annotated[str, typer.Option(help="How finely to bake: draft, report, standard or reference.")]
Backend = Annotated[str, typer.Option(help="OpenGL back end: auto, egl, osmesa or x11.")]
Effects = Annotated[
    str, typer.Option(help="auto, all, none, single effects: +name,-name, what auto may change: auto,0.1K.")
]
Atmosphere = Annotated[
    str, typer.Option(help="standard (from the weather), report (eq. 15), or modtran (its tables' summer day).")
]
Visibility = Annotated[float, typer.Option(help="Meteorological range [km].")]
Radiance = Annotated[
    str, typer.Option(help="apparent, as it reaches the sensor, or source, as it leaves the surfaces.")
]
Exchange = Annotated[
    bool,
    typer.Option("--exchange", help="Near surfaces see each other by long waves and diffuse light, without shadows."),
]
Aerosol = Annotated[str, typer.Option(help="rural, urban, maritime, tropospheric, advection_fog or radiation_fog.")]
TEMPERATURE_PLANES = frozenset({"surface_temperature", "fit_error"})  # a band that shows none has them on request
Enhance = Annotated[float | None, typer.Option(help="Gain of fine detail; the sensor's own if left out, 1 for none.")]
Settle = Annotated[
    float | None, typer.Option(help="Time constant of automatic gain over frames [s]; the sensor's own if left out.")
]
AsJson = Annotated[bool, typer.Option("--json", help="Print figures as JSON.")]


def read_scene(name: str, level: str) -> tuple[Scene, DetailRule]:
    """A scene at one level, or for `auto` and auto:PIXELS at all of them, with the rule that chooses among them."""
    word, _, pixels = level.partition(":")
    if word != ALL_LEVELS:
        return load_scene(name, level=level), DetailRule()
    try:
        rule = DetailRule(pixels=float(pixels)) if ":" in level else DetailRule()
    except ValueError as error:
        raise InputError("command line", "--level", level, "no number of pixels", "write auto or auto:4") from error
    return load_all_levels(name), rule


def read_size(text: str) -> tuple[int, int]:
    """Width and height of `WIDTHxHEIGHT`."""
    width, _, height = text.partition("x")
    if not (width.isascii() and width.isdigit() and height.isascii() and height.isdigit()):
        raise InputError("command line", "--size", text, "no WIDTHxHEIGHT", "write for example 640x480")
    size = (int(width), int(height))
    if min(size) < 1 or max(size) > 16384:
        raise InputError("command line", "--size", text, "not 1 to 16384 pixels a side", "write for example 640x480")
    return size


def read_moment(text: str) -> datetime:
    """Date and time of an ISO 8601 text."""
    try:
        return datetime.fromisoformat(text)
    except ValueError as error:
        remedy = "write for example 1976-02-07T10:00"
        raise InputError("command line", "--at", text, "no ISO 8601 date and time", remedy) from error


def local_day(moment: datetime, utc_offset: float) -> date:
    """Date that a clock `utc_offset` [h] ahead of UTC shows; a moment without offset is by that clock already."""
    return (moment if moment.tzinfo is None else moment.astimezone(timezone(timedelta(hours=utc_offset)))).date()


def read_effects(text: str, planes: Collection[str]) -> EffectChoice:
    """The choice of effects, with the temperatures that the planes need."""
    choice = read_choice(text)
    return choice.with_wanted("temperature") if TEMPERATURE_PLANES & set(planes) else choice


def read_atmosphere(name: str, radiance: str) -> str:
    """Name of the air to look through: none of it for what leaves the surfaces."""
    if radiance not in ("source", "apparent"):
        raise InputError("command line", "--radiance", radiance, "unknown", "use source or apparent")
    check_atmosphere(name)
    return name if radiance == "apparent" else "none"


def show_warnings(warnings: Iterable[str]) -> None:
    """What a user should know of the inputs, on the error stream."""
    for warning in dict.fromkeys(warnings):
        Console(stderr=True, soft_wrap=True).print(f"warning: {warning}", style="yellow", markup=False, highlight=False)


def make_folder(folder: Path) -> None:
    """Create the folder that files are to be written to, where it is not there."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        problem = f"the folder cannot be made: {error.strerror}"
        raise InputError("command line", "--out", str(folder), problem, "name another place") from error


def with_display(sensor: Sensor, **changes: float | None) -> Sensor:
    """The sensor with some numbers of its display replaced, those that are given."""
    given: dict[str, Any] = {name: value for name, value in changes.items() if value is not None}
    return replace(sensor, display=replace(sensor.display, **given)) if given else sensor


def find_weather(name: str | None, day: date) -> Weather:
    """The weather asked for, else the one that comes with the package for that day."""
    return read_weather(day.isoformat() if name is None else name)


@contextmanager
def bake_progress(title: str) -> Iterator[BakeProgress]:
    """A progress bar on the error stream while tables are baked, where that is a terminal."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task(title, total=None)

        def report(name: str, done: int, total: int) -> None:
            bar.update(task, completed=done, total=total, description=f"{title}: {name}")

        yield report
