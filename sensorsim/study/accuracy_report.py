"""The accuracy study on disk: accuracy.html, accuracy.csv, accuracy_images.csv, and its figures for programs."""

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from sensorsim.study.accuracy import Accuracy
from sensorsim.study.accuracy_measure import Score
from sensorsim.study.accuracy_plots import factor_figure, histogram_figure, map_figure, pareto_figure
from sensorsim.study.accuracy_trials import FACTORS
from sensorsim.study.page import Page
from sensorsim.study.pareto import Advice, advise, pareto_front
from sensorsim.thermal import write_whole

ERROR_BUDGETS, BAKE_BUDGETS = (0.3, 1.0, 3.0), (0.5, 2.0, 10.0)  # [K], [s] that the page gives advice for
HEAD = ("setting", "RMS [K]", "p99 [K]", "max [K]", "worst", "bake [s]", "processor [s]", "tables [MiB]", "measured on")
SCORE_HEAD = ("group", *HEAD, "frame [ms]", "front")
IMAGE_HEAD = ("setting", "day", "hour", "RMS [K]", "max [K]", "Spearman", "Kendall", "surfaces")


def accuracy_json(found: Accuracy) -> dict[str, Any]:
    """Figures of presets, factors and combinations as plain values."""
    by_group: dict[str, dict[str, Any]] = {"preset": {}, "factor": {}, "combination": {}}
    for score in found.scores:
        by_group[score.trial.group][score.trial.name] = {
            "rms": score.rms,
            "p99": score.p99,
            "max": score.max,
            "bake_s": score.bake,
            "table_mib": score.table,
            "frame_ms": found.frames.get(score.trial.name),
        }
    return {
        "presets": by_group["preset"],
        "factors": by_group["factor"],
        "combinations": by_group["combination"],
        "worst": {score.trial.name: str(score.worst) for score in found.scores},
        "sample": found.sampled,
    }


def write_accuracy(found: Accuracy, folder: Path, advice: Advice | None = None) -> list[Path]:
    """Write the page and its tables into an existing folder; returns the files, the page first."""
    page, tables = accuracy_page(found, advice), {folder / "accuracy.csv": _csv(SCORE_HEAD, _score_rows(found))}
    if found.images:
        tables[folder / "accuracy_images.csv"] = _csv(IMAGE_HEAD, _image_rows(found))
    write_whole(tables)
    page.write(folder / "accuracy.html")
    return [folder / "accuracy.html", *tables]


def accuracy_page(found: Accuracy, advice: Advice | None = None) -> Page:
    """The page, its plots included."""
    page = Page(f"Accuracy against time: {found.title}")
    page.text(
        "Error is the temperature by the tables less that of the full solve of the very surface, in steps of a minute "
        "and cells of half the size under the same sky, every twelve minutes of the day: "
        f"{found.sampled}. Bake times are those of one day of all wall types on the machine that ran this, elapsed and "
        "summed over processors; the plots use the latter."
    )
    if found.candidates:
        words = "Error against the cost of a bake, and against the size of its tables"
        page.figure(pareto_figure(found.candidates), words)
    page.heading("Presets")
    page.table((*HEAD, "frame [ms]"), [row[1:11] for row in _score_rows(found) if row[0] == "preset"])
    presets = [score for score in found.scores if score.trial.group == "preset"]
    if presets:
        page.figure(histogram_figure(presets), "How often an error is exceeded")
    _advise(page, found, advice)
    page.heading("Where the fit is worst")
    where = f"{found.map.name}: {found.map.wall} as a vertical wall on {found.map.day.isoformat()}"
    page.figure(map_figure(found.map), where)
    _factors(page, found)
    _pictures(page, found)
    page.heading("All settings")
    page.table(SCORE_HEAD, _score_rows(found))
    return page


def _pictures(page: Page, found: Accuracy) -> None:
    page.heading("Pictures")
    if not found.images:
        page.text("None: pictures need a scene and presets.", note=True)
        return
    page.text(
        "Frames of presets from the scene's tower against frames of the full solve: apparent temperature over the "
        "pixels that see a measured surface, and the order of the surfaces by their mean: Kendall's tau is the share "
        "of pairs of surfaces whose contrast has the right sign less that of the others."
    )
    page.table(IMAGE_HEAD, _image_rows(found))


def _advise(page: Page, found: Accuracy, advice: Advice | None) -> None:
    page.heading("Recommendations")
    if not found.candidates:
        page.text("Only single knobs were turned: there is nothing to choose among.", note=True)
        return
    standing = [advise(found.candidates, max_error=budget) for budget in ERROR_BUDGETS]
    standing += [advise(found.candidates, max_bake=budget) for budget in BAKE_BUDGETS]
    for each in standing if advice is None else (advice, *standing):
        page.text(f"For {each.text}.")


def _factors(page: Page, found: Accuracy) -> None:
    page.heading("One knob at a time")
    for name, factor in FACTORS.items():
        scores = [score for score in found.scores if score.trial.factor == name]
        if scores:
            page.figure(factor_figure(factor.title, scores), f"{name}: {factor.title}; grey bars are the bake's cost")


def _score_rows(found: Accuracy) -> list[tuple[Any, ...]]:
    front = _front(found.candidates)
    return [
        (
            score.trial.group,
            score.trial.name,
            score.rms,
            score.p99,
            score.max,
            str(score.worst),
            score.bake,
            score.bake_processor,
            score.table,
            score.scope,
            found.frames.get(score.trial.name, ""),
            "yes" if score.trial.name in front else "",
        )
        for score in found.scores
    ]


def _front(scores: Sequence[Score]) -> set[str]:
    """Names of the settings that no other beats in both p99 and bake."""
    cost, error = (np.array([getattr(score, name) for score in scores]) for name in ("bake_processor", "p99"))
    return {scores[row].trial.name for row in pareto_front(cost, error)}


def _image_rows(found: Accuracy) -> list[tuple[Any, ...]]:
    return [
        (
            image.name, image.day.isoformat(), image.hour, image.rms, image.max, image.spearman, image.kendall,
            image.surfaces,
        )
        for image in found.images
    ]  # fmt: skip


def _csv(head: Iterable[str], rows: Iterable[Sequence[Any]]) -> bytes:
    """A table as the bytes of a file."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(head)
    writer.writerows(rows)
    return text.getvalue().encode()
