"""`sensorsim study accuracy`: what each setting of the baker costs, and how far its tables miss the full solve."""

import json
import math
import re
from collections.abc import Mapping, Sequence
from datetime import date
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from sensorsim.cli.options import AsJson, Backend, Level, bake_progress, find_weather, make_folder
from sensorsim.environment import Weather
from sensorsim.errors import InputError
from sensorsim.materials import load_catalogue
from sensorsim.scene import load_scene
from sensorsim.study import require_plot
from sensorsim.study.accuracy import Accuracy, catalogue_days, scene_days, still_moment, study_accuracy
from sensorsim.study.accuracy_report import accuracy_json, write_accuracy
from sensorsim.study.accuracy_trials import plan_trials
from sensorsim.study.pareto import Advice, advise

REPORT_DAYS = "1976-02-07,1976-09-03,1976-10-07"
KELVIN: Mapping[str, float] = {"K": 1.0, "mK": 1e-3}
SECONDS: Mapping[str, float] = {"s": 1.0, "ms": 1e-3, "min": 60.0}


def accuracy(
    scene: Annotated[str, typer.Argument(help="Scene that comes with the package, or a GeoJSON file.")] = "hospital",
    level: Level = "IIIB",
    catalogue: Annotated[bool, typer.Option("--catalogue", help="All materials at random instead of a scene.")] = False,
    out: Annotated[Path, typer.Option(help="Folder of the page and the tables.")] = Path("out/accuracy"),
    days: Annotated[str, typer.Option(help="Image days, ISO dates with commas between.")] = REPORT_DAYS,
    weather: Annotated[str | None, typer.Option(help="Weather file; by date if left out.")] = None,
    still: Annotated[bool, typer.Option("--still", help="And 2 September 1976, were it clear and windless.")] = False,
    presets: Annotated[str | None, typer.Option(help="Presets to measure, commas between; all if left out.")] = None,
    factors: Annotated[
        str | None, typer.Option(help="Knobs to turn, commas between, '' for none; all, and combinations, if left out.")
    ] = None,
    max_error: Annotated[str | None, typer.Option(help="Recommend for a largest error: 0.2K, 200mK.")] = None,
    max_bake: Annotated[str | None, typer.Option(help="Recommend for the bake of a day: 5s, 500ms, 1min.")] = None,
    backend: Backend = "auto",
    as_json: AsJson = False,
) -> None:
    """Measure the error of each setting in K, its cost, and recommend one for a budget."""
    budget = {
        name: read_quantity(text, f"--{name.replace('_', '-')}", units)
        for name, text, units in (("max_error", max_error, KELVIN), ("max_bake", max_bake, SECONDS))
        if text is not None
    }
    chosen, turned = _names(presets), _names(factors)
    plan_trials(chosen, turned)  # refuses unknown names before anything is solved
    require_plot(Path("accuracy.png"))
    moments = _moments(days, weather) + ([still_moment()] if still else [])
    with bake_progress("accuracy") as progress:
        surfaces = (
            catalogue_days(load_catalogue(), moments)
            if catalogue
            else scene_days(load_scene(scene, level=level), moments, progress=progress)
        )
        make_folder(out)
        title = "the whole catalogue" if catalogue else f"{scene}, level {level}"
        found = study_accuracy(
            surfaces, title=title, presets=chosen, factors=turned, backend=backend, progress=progress
        )
    advice = advise(found.candidates, **budget) if budget else None
    files = write_accuracy(found, out, advice)
    if as_json:
        told = {} if advice is None else {"recommended": {"setting": advice.score.trial.name, "meets": advice.meets}}
        print(json.dumps({**accuracy_json(found), **told, "files": [str(path) for path in files]}))  # noqa: T201
        return
    _show(found, advice, files)


def read_quantity(text: str, option: str, units: Mapping[str, float]) -> float:
    """Number of a text such as `0.2K` in SI; InputError without a unit of `units`, and for what is not above zero."""
    known = ", ".join(units)
    found = re.fullmatch(r"\s*([-+.\w]*[\d.])\s*([a-zA-Z]+)\s*", text)
    if found is None or found[2] not in units:
        raise InputError("command line", option, text, "no number with a unit", f"use one of {known}: 2{known[0]}")
    try:
        value = float(found[1]) * units[found[2]]
    except ValueError as error:
        raise InputError("command line", option, text, "no number", f"write for example 2{known[0]}") from error
    if not 0.0 < value < math.inf:
        raise InputError("command line", option, text, "not a number above zero", f"write for example 2{known[0]}")
    return value


def _names(text: str | None) -> list[str] | None:
    return None if text is None else [name.strip() for name in text.split(",") if name.strip()]


def _moments(days: str, weather: str | None) -> list[tuple[Weather, date]]:
    """Weather and date of every day asked for."""
    found = []
    for text in _names(days) or [days]:
        try:
            day = date.fromisoformat(text)
        except ValueError as error:
            remedy = "write for example 1976-02-07,1976-09-03"
            raise InputError("command line", "--days", text, "no ISO 8601 date", remedy) from error
        found.append((find_weather(weather, day), day))
    return found


def _show(found: Accuracy, advice: Advice | None, files: Sequence[Path]) -> None:
    console = Console(soft_wrap=True, highlight=False, markup=False)
    table = Table(title=f"{found.title}: {found.sampled}", title_justify="left")
    for title in ("setting", "RMS [K]", "p99 [K]", "max [K]", "bake [s]", "tables [MiB]", "frame [ms]"):
        table.add_column(title, justify="left" if title == "setting" else "right")
    for score in found.scores:
        frame = found.frames.get(score.trial.name)
        figures = (score.rms, score.p99, score.max, score.bake, score.table)
        shown = (f"{figure:.3g}" for figure in figures)
        table.add_row(score.trial.name, *shown, "" if frame is None else f"{frame:.3g}")
    console.print(table)
    for score in found.scores:
        if score.trial.group == "preset":
            console.print(f"{score.trial.name} is worst at {score.worst}")
    if advice is not None:
        console.print(f"for {advice.text}", style="bold")
    for path in files:
        console.print(f"wrote {path}")
