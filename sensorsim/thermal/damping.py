"""Steps of second order that must not stand: columns in which a cell overshot go back and take backward Euler.

No method of second order keeps every answer monotone [Bolley1978], and a thin metal skin would overshoot the sunrise.
"""

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.constants import ZERO_CELSIUS
from sensorsim.thermal.boundary import FloatArray
from sensorsim.thermal.lanes import (
    CELL,
    EXTERIOR,
    FIRST,
    FLUX,
    HIGHEST,
    INTERIOR,
    INTERIOR_FLUX,
    INTERIOR_PER_FILM,
    INTERIOR_START,
    KEPT,
    LANES,
    LATER,
    LATER_FLUX,
    LATER_INTERIOR_FLUX,
    LEAST,
    LONGWAVE,
    LOWEST,
    MARK,
    MOST,
    NOW,
    OLD,
    OUTERMOST,
    PER_FILM,
    START,
    SUN,
    Index,
    inner,
    wide,
)

GAMMA = 1.0 - np.sqrt(0.5)
CARRY = (1.0 - GAMMA) / GAMMA  # weight of the first stage's change in the second stage's right side
TURN = 1e-7  # [K] overshoot that is left alone


RESULTS = (EXTERIOR, INTERIOR, PER_FILM, INTERIOR_PER_FILM, FLUX, INTERIOR_FLUX, LATER_FLUX, LATER_INTERIOR_FLUX)


@inner
def calls_for_damping(
    lanes: Index, w: FloatArray, c: FloatArray, place: NDArray[Index], low: float, high: float, reach: FloatArray,
    wet: bool,
) -> bool:  # fmt: skip
    """Mark lanes in which a stiff cell passed the balance of the first stage and turned, or any left its range.

    The range is that of the start of the step and of air and rooms, which are from `low` to `high` [C].
    """
    wide()
    calls = 0
    for j in range(lanes):
        face, room_face, lowest, highest = w[START + j], w[INTERIOR_START + j], w[LOWEST + j], w[HIGHEST + j]
        least, most = (
            min(low, min(face, room_face), w[LEAST + j]) - TURN,
            max(high, max(face, room_face), w[MOST + j]) + TURN,
        )
        cold, hot = lowest + (ZERO_CELSIUS + TURN), highest + (ZERO_CELSIUS - TURN)
        sunlit = w[SUN + j] + w[LATER + SUN + j] > 0.0
        below = SIGMA * cold * cold * cold * cold < min(w[LONGWAVE + j], w[LATER + LONGWAVE + j])
        above = SIGMA * hot * hot * hot * hot > max(w[LONGWAVE + j], w[LATER + LONGWAVE + j]) and not sunlit
        left = (lowest < least and below) or (highest > most and above)
        w[LEAST + j], w[MOST + j], mark = lowest, highest, 1.0 if left and not wet else 0.0
        w[MARK + j] = mark
        calls += 1 if mark > 0.0 else 0
    if reach[0] > 0.0:
        calls += _turned(lanes, w, c, CELL, OUTERMOST, reach[0])
    if reach[1] > 0.0:
        calls += _turned(lanes, w, c, place[-2], FIRST, reach[1])
    return calls > 0


@inner
def _turned(lanes: Index, w: FloatArray, c: FloatArray, at: Index, stage: Index, reach: float) -> int:
    """Mark lanes in which a cell passed the balance of the first stage and turned; returns how many are marked."""
    wide()
    calls = 0
    for j in range(lanes):
        change, first = c[at + NOW + j] - c[at + OLD + j], w[stage + j] - c[at + OLD + j]
        beyond, back = change - reach * first, CARRY * first - change
        mark = max(w[MARK + j], 1.0 if beyond * back - TURN * abs(back) > 0.0 else 0.0)
        w[MARK + j] = mark
        calls += 1 if mark > 0.0 else 0
    return calls


@inner
def go_back(lanes: Index, w: FloatArray, c: FloatArray, place: NDArray[Index]) -> None:
    """All lanes to the start of the step; what they have reached is put away."""
    wide()
    for row in range(8):
        kept, result = KEPT + Index(row * LANES), RESULTS[row]
        for j in range(lanes):
            w[kept + j] = w[result + j]
    for i in range(place.size - 1):
        at = place[i]
        for j in range(lanes):
            c[at + OLD + j], c[at + NOW + j] = c[at + NOW + j], c[at + OLD + j]


@inner
def join(lanes: Index, w: FloatArray) -> None:
    """Lanes without a mark take up again what they had reached before others were damped."""
    for row in range(8):
        kept, result = KEPT + Index(row * LANES), RESULTS[row]
        for j in range(lanes):
            w[result + j] = w[result + j] if w[MARK + j] > 0.0 else w[kept + j]
    for j in range(lanes):
        w[LEAST + j], w[MOST + j] = w[LOWEST + j], w[HIGHEST + j]
