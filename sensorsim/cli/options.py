"""Options that commands share, and the readers of their values."""

from collections.abc import Iterator
from contextlib import contextmanager
from datetime import date, datetime, timedelta, timezone
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from sensorsim.environment import Weather, read_weather
from sensorsim.errors import InputError
from sensorsim.tables.bake import Progress as BakeProgress

SceneName = Annotated[str, typer.Argument(help="Scene that comes with the package, or a GeoJSON file.")]
Level = Annotated[str, typer.Option(help="Level of detail: IA, IIA or IIIB.")]
Preset = Annotated[str, typer.Option(help="How finely to bake: draft, report, standard or reference.")]
Backend = Annotated[str, typer.Option(help="OpenGL back end: auto, egl, osmesa or x11.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print figures as JSON.")]


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


def make_folder(folder: Path) -> None:
    """Create the folder that files are to be written to, where it is not there."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        problem = f"the folder cannot be made: {error.strerror}"
        raise InputError("command line", "--out", str(folder), problem, "name another place") from error


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
