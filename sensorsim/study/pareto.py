"""What is worth its cost: the front of settings that nothing beats in both, and the choice for a budget."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sensorsim.errors import InputError
from sensorsim.study.accuracy_measure import Score
from sensorsim.tables.orientations import FloatArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Advice:
    """The setting for a budget, or the nearest to it where none keeps it."""

    score: Score
    meets: bool
    text: str


def pareto_front(cost: FloatArray, error: FloatArray) -> np.ndarray:
    """Rows (k,) that no other row beats in cost or error without losing in the other, by rising cost."""
    order = np.lexsort((error, cost))
    front, least = [], np.inf
    for row in order:
        if error[row] < least:
            front.append(int(row))
            least = float(error[row])
    return np.asarray(front, dtype=np.int64)


def advise(scores: Sequence[Score], *, max_error: float | None = None, max_bake: float | None = None) -> Advice:
    """The cheapest setting whose largest error [K] and bake [s] keep the budget; without `max_error` the most exact.

    Where none does, the one that exceeds its budget by the least factor. Raises InputError for no settings, no budget,
    and a budget that is not above zero.
    """
    if not scores:
        raise InputError("accuracy study", "settings", [], "none were measured", "measure presets")
    for name, asked in (("max error", max_error), ("max bake", max_bake)):
        if asked is not None and not 0.0 < asked < np.inf:
            raise InputError("accuracy study", name, asked, "not a number above zero", "give one, as 0.2K or 5s")
    if max_error is None and max_bake is None:
        raise InputError("accuracy study", "budget", None, "neither max error nor max bake", "give one of them")
    budget = _words(max_error, max_bake)
    meeting = [score for score in scores if _excess(score, max_error, max_bake) <= 1.0]
    if meeting:
        best = min(meeting, key=lambda score: score.max if max_error is None else score.bake)
        return Advice(score=best, meets=True, text=f"{budget}: {best.trial.name} ({_figures(best)})")
    nearest = min(scores, key=lambda score: _excess(score, max_error, max_bake))
    text = f"{budget}: none of {len(scores)} settings; the nearest is {nearest.trial.name} ({_figures(nearest)})"
    return Advice(score=nearest, meets=False, text=text)


def _excess(score: Score, max_error: float | None, max_bake: float | None) -> float:
    """How many times its budget a setting takes, at the worse of both."""
    error = 0.0 if max_error is None else score.max / max_error
    return max(error, 0.0 if max_bake is None else score.bake / max_bake)


def _words(max_error: float | None, max_bake: float | None) -> str:
    parts = [] if max_error is None else [f"errors up to {max_error:g} K"]
    return " and ".join(parts + ([] if max_bake is None else [f"a bake within {max_bake:g} s"]))


def _figures(score: Score) -> str:
    return f"largest error {score.max:.2g} K, p99 {score.p99:.2g} K, bake {score.bake:.2g} s"
