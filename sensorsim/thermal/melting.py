"""Walls that begin with snow or ice, compiled: backward Euler in enthalpy, one column after the other.

A cell of capacity C that has taken up latent heat M of its L holds C T + M. While 0 < M < L it stays at 0 C, whether
it melts or freezes, and what reaches it goes into M. A step guesses which cells do so, solves the others, linear then,
with both faces, and corrects the guess until it holds, cells that begin to melt within those that end it: the nested
iteration of [Brugnano2008], finite and free of chatter as the matrix is an M-matrix.

Snow drains: it stays at 0 C when it has melted, its water carries off what heat comes then, and where its face would
get warmer than 0 C the face holds that, and all heat that it takes in goes to the first cell, and on inward where that
has melted. Ice keeps its water, which warms. Melted snow keeps its place, density and conductivity, and as much water
as it held stays to freeze again.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.constants import ZERO_CELSIUS
from sensorsim.thermal.balance import balance, evaporate, load
from sensorsim.thermal.boundary import Columns, FloatArray, Inside, Outside
from sensorsim.thermal.grid import LayerLike, WallGrid
from sensorsim.thermal.kernel import DAMPED_GUESS, Shared, room_at, sample, settle, share
from sensorsim.thermal.lanes import (
    ALL,
    CELL,
    EXTERIOR,
    FILM_CUBED,
    FLUX,
    FREE,
    FREE_COLDER,
    INTERIOR,
    INTERIOR_FLUX,
    LATENT,
    LATER_FLUX,
    LATER_INTERIOR_FLUX,
    LEFT,
    LOAD,
    MOVED,
    NOW,
    RIGHT,
    UNBOUNDED,
    Index,
    give,
    inner,
    take,
)

HEAT_OF_FUSION = 3.34e5  # [J kg-1] of ice [Incropera2007]
FROZEN, MELTING, MELTED = 0.0, 1.0, 2.0
STATE, CONTENT, OWN, OUTWARD, ROOM, ROWS = range(6)  # of a cell: what it is guessed to be, heat content over the step
# [W m-2], its temperature's own part [C] and what it has of the cell outward of it and of the interior face [-]
NEGLIGIBLE = 1e-10  # [W m-2] that a cell may lack of being frozen, so that rounding does not turn its state for ever
GUESSES = 200


class Thaw(NamedTuple):
    """A wall that melts."""

    capacity: FloatArray  # (n,) [J m-2 K-1]
    conductance: FloatArray  # (n + 1,) [W m-2 K-1]
    latent: FloatArray  # (n,) heat that it takes to melt each cell, 0 for what does not melt [J m-2]
    drains: bool  # whether its water runs off rather than get warmer


def latent_heat(layers: Sequence[LayerLike], grid: WallGrid, depth: float) -> FloatArray:
    """Heat (n,) [J m-2] that it takes to melt each cell of a wall that is snow or ice down to `depth` [m]."""
    melts = grid.depth < depth
    bottom = np.cumsum([layer.thickness for layer in layers])
    specific = np.array([layer.specific_heat for layer in layers])[np.searchsorted(bottom, grid.depth[melts])]
    latent = np.zeros(grid.capacity.size)
    latent[melts] = grid.capacity[melts] / specific * HEAT_OF_FUSION
    return latent


def advance_melting(
    columns: Columns,
    taken: FloatArray,
    wall: Thaw,
    outside: Outside,
    inside: Inside,
    first: int,
    last: int,
    step: float,
) -> int:
    """Make steps `first` to `last` - 1 [of `step` s]; returns how many balances or states did not settle.

    `taken` (n + 1, m) [J m-2] is the latent heat that cells have taken up and, last, what has drained.
    """
    n = wall.capacity.size
    w, c, lane = np.zeros(int(ALL)), np.zeros((n + 2) * int(CELL)), np.zeros(1, dtype=Index)
    return int(_advance(w, c, lane, np.zeros((ROWS, n)), columns, taken, wall, outside, inside, first, last, step))


@njit(cache=True, nogil=True, error_model="numpy")
def _advance(
    w: FloatArray, c: FloatArray, lane: NDArray[Index], v: FloatArray, columns: Columns, taken: FloatArray, wall: Thaw,
    outside: Outside, inside: Inside, first: int, last: int, step: float,
) -> int:  # fmt: skip
    """Steps of all columns in turn."""
    exchange, failures, one = np.zeros(5), 0, Index(lane.size)
    for column in range(columns.orientation.size):
        take(one, w, c, lane, columns, outside.free, outside.free_colder, column)
        sample(one, w, lane, outside, first)
        for k in range(first, last):
            sample(one, w, lane, outside, k + 1)
            shared = share(outside, inside, k + 1)
            failures += _step(one, w, c, v, shared, exchange, taken[:, column], wall, outside, inside, step)
            settle(one, w, step)
        give(one, w, c, columns, column)
    return failures


@inner
def _step(
    one: Index, w: FloatArray, c: FloatArray, v: FloatArray, shared: Shared, exchange: FloatArray,
    taken: FloatArray, wall: Thaw, outside: Outside, inside: Inside, step: float,
) -> int:  # fmt: skip
    """One step of one column; returns failures."""
    wet, grey, failures = outside.latent.shape[0] > 1, outside.emissivity * SIGMA, 0
    room = room_at(shared, shared, 1.0, inside.free, inside.emissivity * SIGMA)
    air, vapour = shared[0], shared[1]
    for i in range(v.shape[1]):
        v[CONTENT, i] = (wall.capacity[i] * c[Index(i + 1) * CELL + NOW] + taken[i]) / step
        v[STATE, i] = FROZEN if taken[i] <= 0.0 else (MELTING if wall.drains or taken[i] < wall.latent[i] else MELTED)
    load(one, w, 1.0, DAMPED_GUESS)
    gain = _gain_at_zero(one, w, grey, air, vapour, wet)
    held, changed = False, True
    for _ in range(GUESSES):
        _eliminate(w, v, exchange, wall, step, held, gain)
        w[MOVED] = UNBOUNDED
        failures = balance(
            one, w, (exchange[0], exchange[1], exchange[2], exchange[3], 0.0), grey, air, vapour, room, wet, 1.0, 1
        )
        _substitute(w, c, v, wall, held, gain)
        turned = wall.drains and wall.latent[0] > 0.0 and _turns(w, c, wall, held, gain)
        held = held != turned
        changed = turned or _guess_frozen(c, v, wall, held, gain)
        changed = changed or _guess_melted(c, v, wall, step, held, gain)
        if not changed:
            break
    _store(c, v, taken, wall, step, held, gain)
    return failures + (1 if changed else 0)


@inner
def _gain_at_zero(one: Index, w: FloatArray, grey: float, air: float, vapour: float, wet: bool) -> float:
    """Heat [W m-2] that the exterior face takes from its surroundings at 0 C."""
    face = w[EXTERIOR]
    w[EXTERIOR] = 0.0
    if wet:
        evaporate(one, w, vapour, 1.0)
    w[EXTERIOR] = face
    film = np.cbrt(w[FILM_CUBED] + (w[FREE] if air < 0.0 else w[FREE_COLDER]) * abs(air))
    return float(w[LOAD] + film * air - grey * ZERO_CELSIUS**4 - (w[LATENT] if wet else 0.0))


@inner
def _eliminate(
    w: FloatArray, v: FloatArray, exchange: FloatArray, wall: Thaw, step: float, held: bool, gain: float
) -> None:
    """Elimination of the cells that are not at 0 C, innermost first, and what the faces then exchange.

    Sums of positive terms alone, as in `conduction`. A face that is held at 0 C gives the first cell its `gain`.
    """
    n, kept, own, room = v.shape[1], 1.0, 0.0, 1.0  # 1 less what the cell inward has of this one; its own, the room's
    for i in range(n - 1, -1, -1):
        outward, inward = 0.0 if held and i == 0 else wall.conductance[i], wall.conductance[i + 1]
        inside = wall.capacity[i] / step + inward * kept
        source = v[CONTENT, i] - (wall.latent[i] / step if v[STATE, i] == MELTED else 0.0)
        source += gain if held and i == 0 else 0.0
        share_of = 0.0 if v[STATE, i] == MELTING else 1.0 / (outward + inside)
        own, room = (source + inward * own) * share_of, inward * room * share_of
        kept = 1.0 if v[STATE, i] == MELTING else inside * share_of
        v[OWN, i], v[OUTWARD, i], v[ROOM, i] = own, outward * share_of, room
    outermost = 0.0 if held else wall.conductance[0]
    exchange[0] = UNBOUNDED if held else outermost * kept
    exchange[1], w[LEFT] = outermost * room, outermost * own
    from_face, own, room = 1.0, 0.0, 0.0
    for i in range(n):
        own, room = v[OWN, i] + v[OUTWARD, i] * own, v[ROOM, i] + v[OUTWARD, i] * room
        from_face *= v[OUTWARD, i]
    exchange[2], exchange[3] = wall.conductance[n] * from_face, wall.conductance[n] * (1.0 - room)
    w[RIGHT] = wall.conductance[n] * own


@inner
def _substitute(w: FloatArray, c: FloatArray, v: FloatArray, wall: Thaw, held: bool, gain: float) -> None:
    """Temperatures of the cells from those of the faces, and the heat [W m-2] that enters through both."""
    n, before = v.shape[1], 0.0 if held else w[EXTERIOR]
    w[EXTERIOR] = before
    for i in range(n):
        before = v[OWN, i] + v[OUTWARD, i] * before + v[ROOM, i] * w[INTERIOR]
        c[Index(i + 1) * CELL + NOW] = before
    w[FLUX] = gain if held else wall.conductance[0] * (w[EXTERIOR] - c[CELL + NOW])
    w[INTERIOR_FLUX] = wall.conductance[n] * (w[INTERIOR] - before)
    w[LATER_FLUX], w[LATER_INTERIOR_FLUX] = w[FLUX], w[INTERIOR_FLUX]
    c[NOW], c[Index(n + 1) * CELL + NOW] = w[EXTERIOR], w[INTERIOR]


@inner
def _turns(w: FloatArray, c: FloatArray, wall: Thaw, held: bool, gain: float) -> bool:
    """Whether the face begins or ends to be held at 0 C."""
    if held:
        return bool(gain + wall.conductance[0] * c[CELL + NOW] < 0.0)
    return bool(w[EXTERIOR] > 0.0)


@inner
def _content(c: FloatArray, v: FloatArray, wall: Thaw, i: int, held: bool, gain: float) -> float:
    """Heat [J m-2] over the step [s] that a cell at 0 C ends with."""
    at = Index(i + 1) * CELL + NOW
    outer = gain if held and i == 0 else wall.conductance[i] * (c[at - CELL] - c[at])
    return float(v[CONTENT, i] + outer + wall.conductance[i + 1] * (c[at + CELL] - c[at]))


@inner
def _guess_frozen(c: FloatArray, v: FloatArray, wall: Thaw, held: bool, gain: float) -> bool:
    """Cells that begin to melt, or freeze to the end; whether there are any."""
    changed = False
    for i in range(v.shape[1]):
        if v[STATE, i] == FROZEN and wall.latent[i] > 0.0 and c[Index(i + 1) * CELL + NOW] > 0.0:
            v[STATE, i], changed = MELTING, True
        elif v[STATE, i] == MELTING and _content(c, v, wall, i, held, gain) < -NEGLIGIBLE:
            v[STATE, i], changed = FROZEN, True
    return changed


@inner
def _guess_melted(c: FloatArray, v: FloatArray, wall: Thaw, step: float, held: bool, gain: float) -> bool:
    """Cells that melt to the end, or begin to freeze; whether there are any. What drains stays as it is."""
    changed = False
    for i in range(v.shape[1]):
        if v[STATE, i] == MELTED and c[Index(i + 1) * CELL + NOW] < 0.0:
            v[STATE, i], changed = MELTING, True
            continue
        most = UNBOUNDED if wall.drains else wall.latent[i] / step + NEGLIGIBLE
        if v[STATE, i] == MELTING and _content(c, v, wall, i, held, gain) > most:
            v[STATE, i], changed = MELTED, True
    return changed


@inner
def _store(c: FloatArray, v: FloatArray, taken: FloatArray, wall: Thaw, step: float, held: bool, gain: float) -> None:
    """Latent heat at the end of the step; what is more than melts snow goes on inward, and at last drains."""
    passing = 0.0
    for i in range(v.shape[1]):
        content = 0.0
        if v[STATE, i] == MELTING:
            content = step * _content(c, v, wall, i, held, gain)
        elif v[STATE, i] == MELTED:
            content = wall.latent[i]
        content += passing
        taken[i] = min(content, wall.latent[i]) if wall.drains else content
        passing = content - taken[i]
    taken[v.shape[1]] += passing
