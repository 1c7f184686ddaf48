"""The page of the hard cases: what was asked, what came out, and plots."""

from collections.abc import Sequence
from itertools import groupby
from pathlib import Path

import numpy as np

from sensorsim.study.page import Page
from sensorsim.study.stability_model import Outcome
from sensorsim.study.stability_pixel_tables import rounding
from sensorsim.study.stability_plots import draw_convergence, draw_melting, draw_overshoot, draw_sunrise

HEAD = ("case", "stresses", "measured", "unit", "bound", "reason of the bound", "result", "margin")


def margin_text(outcome: Outcome) -> str:
    """Bound over result in words: 'exact' where nothing was left."""
    if outcome.problem:
        return outcome.problem
    if outcome.result == 0.0:
        return "exact"
    return f"{outcome.margin:.2g}"


def write_stability_page(path: Path, outcomes: Sequence[Outcome]) -> None:
    """All outcomes as one HTML file."""
    failed = [outcome for outcome in outcomes if not outcome.holds]
    page = Page("Stability: the hard cases")
    page.text(
        f"{len(outcomes)} cases, of which {len(failed)} fail. Each is measured when this page is made, by the same "
        "functions that the tests call. The margin is the bound over the result; rows that fail are coloured."
    )
    _draw_plots(page)
    for group, members in groupby(outcomes, key=lambda outcome: outcome.case.group):
        rows = list(members)
        page.heading(group[0].upper() + group[1:])
        page.table(HEAD, [_row(outcome) for outcome in rows], alarm=[not outcome.holds for outcome in rows])
    page.heading("What half precision would cost")
    page.text(
        f"The coefficients of the tables in float32 cost {1e3 * rounding(np.float32):.2g} mK at most. Float16 would "
        f"halve the memory and cost up to {rounding(np.float16):.2g} K: as much as the fit may cost altogether."
    )
    page.write(path)


def _row(outcome: Outcome) -> tuple[object, ...]:
    case = outcome.case
    result = outcome.result
    return (
        case.name, case.stresses, case.measured, case.unit, case.bound, case.reason, result, margin_text(outcome)
    )  # fmt: skip


def _draw_plots(page: Page) -> None:
    page.figure(
        draw_sunrise(),
        "Sun of 800 W m-2 rises within one step on a copper skin over batting. The skin answers within minutes; "
        "Crank and Nicolson's method rings for hours at the steps that a day is marched in.",
    )
    page.figure(
        draw_overshoot(),
        "How far the skin falls on its way, or passes its balance. Values of 1e-12 stand for none; the dashed line is "
        "the bound of the cases.",
    )
    page.figure(
        draw_melting(),
        "Snow through a thaw: it waits at 0 C while it melts, whatever the step, and freezes with the night.",
    )
    page.figure(
        draw_convergence(),
        "Error of both faces over half a day against exact solutions under true fourth-power boundaries, made so that "
        "the sunlight closes the balance. Left: cells halve at steps of 15 s. Right: steps halve at 400 cells a layer; "
        "single halvings differ, because a step that would pass its balance is taken by backward Euler.",
    )
