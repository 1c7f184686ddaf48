"""Steps of second order that must not stand: columns in which a cell overshot go back and take backward Euler.

No method of second order keeps every answer monotone [Bolley1978], and a thin metal skin would overshoot the sunrise.
"""

import numpy as np

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.constants import ZERO_CELSIUS
from sensorsim.thermal.boundary import FloatArray
from sensorsim.thermal.lanes import (
    CELL,
    EXTERIOR,
    FIRST,
    HIGHEST,
    INTERIOR,
    INTERIOR_START,
    LATER,
    LEAST,
    LONGWAVE,
    LOWEST,
    MARK,
    MOST,
    NOW,
    STAGE,
    START,
    SUN,
    UNBOUNDED,
    Index,
    inner,
)

GAMMA = 1.0 - np.sqrt(0.5)
CARRY = (1.0 - GAMMA) / GAMMA  # weight of the first stage's change in the second stage's right side
TURN = 1e-7  # [K] overshoot that is left alone


@inner
def bound(lanes: Index, w: FloatArray, low: float, high: float) -> None:
    """Range of the step's start and of air and rooms, which are from `low` to `high` [C]."""
    for j in range(lanes):
        w[LEAST + j] = min(low, w[START + j], w[INTERIOR_START + j], w[LOWEST + j]) - TURN
        w[MOST + j] = max(high, w[START + j], w[INTERIOR_START + j], w[HIGHEST + j]) + TURN


@inner
def calls_for_damping(lanes: Index, w: FloatArray, c: FloatArray, factors: FloatArray, wet: bool) -> bool:
    """Mark lanes in which a stiff cell passed the balance of the first stage and turned, or any left its range."""
    calls = 0
    measure(lanes, w, c)
    for j in range(lanes):
        cold, hot = w[LOWEST + j] + (ZERO_CELSIUS + TURN), w[HIGHEST + j] + (ZERO_CELSIUS - TURN)
        sunlit = w[SUN + j] + w[LATER + SUN + j] > 0.0
        below = SIGMA * cold * cold * cold * cold < min(w[LONGWAVE + j], w[LATER + LONGWAVE + j])
        above = SIGMA * hot * hot * hot * hot > max(w[LONGWAVE + j], w[LATER + LONGWAVE + j]) and not sunlit
        left = (w[LOWEST + j] < w[LEAST + j] and below) or (w[HIGHEST + j] > w[MOST + j] and above)
        w[MARK + j] = 1.0 if left and not wet else 0.0
    for i in range(factors.shape[0]):
        at, reach = Index(i + 1) * CELL, factors[i, 5]
        if reach > 0.0:
            for j in range(lanes):
                change, first = c[at + STAGE + j] - c[at + NOW + j], c[at + FIRST + j] - c[at + NOW + j]
                beyond, back = change - reach * first, CARRY * first - change
                w[MARK + j] = max(w[MARK + j], beyond * back - TURN * abs(back))
    for j in range(lanes):
        w[MARK + j] = 1.0 if w[MARK + j] > 0.0 else 0.0
        calls += 1 if w[MARK + j] > 0.0 else 0
    return calls > 0


@inner
def measure(lanes: Index, w: FloatArray, c: FloatArray) -> None:
    """Coldest and warmest cell; two cells at a time, from both ends, as this is all fetching and storing."""
    for j in range(lanes):
        w[LOWEST + j], w[HIGHEST + j] = UNBOUNDED, -UNBOUNDED
    outer, deeper = CELL, Index(c.size) - CELL - CELL
    while outer <= deeper:
        for j in range(lanes):
            one, other = c[outer + STAGE + j], c[deeper + STAGE + j]
            w[LOWEST + j] = min(w[LOWEST + j], min(one, other))
            w[HIGHEST + j] = max(w[HIGHEST + j], max(one, other))
        outer, deeper = outer + CELL, deeper - CELL


@inner
def go_back(lanes: Index, w: FloatArray, c: FloatArray) -> None:
    """Marked lanes to the start of the step; what the others have reached is kept where the first stage was."""
    for j in range(lanes):
        w[EXTERIOR + j] = w[START + j] if w[MARK + j] > 0.0 else w[EXTERIOR + j]
        w[INTERIOR + j] = w[INTERIOR_START + j] if w[MARK + j] > 0.0 else w[INTERIOR + j]
    for at in range(CELL, Index(c.size) - CELL, CELL):
        for j in range(lanes):
            c[at + FIRST + j], c[at + STAGE + j] = c[at + STAGE + j], c[at + NOW + j]


@inner
def join(lanes: Index, w: FloatArray, c: FloatArray) -> None:
    """Lanes without a mark take up again what they had reached before others were damped."""
    for at in range(CELL, Index(c.size) - CELL, CELL):
        for j in range(lanes):
            c[at + STAGE + j] = c[at + STAGE + j] if w[MARK + j] > 0.0 else c[at + FIRST + j]
    measure(lanes, w, c)
