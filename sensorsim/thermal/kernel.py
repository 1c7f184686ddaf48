"""The inner loop, compiled: steps of many columns through one wall, in blocks of one lane each.

A column is one orientation at one solar absorptance. A stage solves (C / (gamma dt) + K) T = rhs for the cells, linear
and alike for all columns, condensed onto the faces, whose balances are not linear (see `balance`).

Steps: two-stage, second-order, L-stable SDIRK with gamma = 1 - 1/sqrt(2) [Alexander1977]; inputs are linear between
samples. Columns that overshoot take that step by backward Euler, which cannot (see `damping`).
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.constants import ZERO_CELSIUS
from sensorsim.thermal.balance import Room, balance
from sensorsim.thermal.boundary import Cells, Columns, FloatArray, Inside, Outside, Trace
from sensorsim.thermal.damping import CARRY, GAMMA, bound, calls_for_damping, go_back, join
from sensorsim.thermal.lanes import (
    ABSORBED,
    ABSORPTANCE,
    ALL,
    CELL,
    EXCHANGE,
    EXTERIOR,
    FILM_CUBED,
    FIRST,
    FLUX,
    FORCED,
    HEAT,
    INTERIOR,
    INTERIOR_FLUX,
    INTERIOR_HEAT,
    INTERIOR_RISE,
    INTERIOR_START,
    LANES,
    LATER,
    LEFT,
    LOAD,
    LONGWAVE,
    MARK,
    MOVED,
    NOW,
    RIGHT,
    RISE,
    SENT,
    STAGE,
    START,
    SUN,
    UNBOUNDED,
    Index,
    give,
    inner,
    note,
    take,
)

NO_TRACE = Trace(np.zeros(0, dtype=np.int64), np.zeros((0, 2, 0)))
CHUNK = 64  # steps that all blocks make in turn, so that what acts on them is fetched from memory once
AIR, VAPOUR, ROOM_AIR, ROOM_RADIANT, ROOM_FILM = range(5)  # of what all columns share


def advance(
    columns: Columns, cells: Cells, damped: Cells, outside: Outside, inside: Inside, first: int, last: int, step: float,
    trace: Trace | None = None,
) -> int:  # fmt: skip
    """Make steps `first` to `last` - 1 [of `step` s]; returns how many face balances did not converge.

    `cells` is the wall factored for gamma `step`, `damped` for `step`; what `trace` asks for is written into it.
    """
    trace = NO_TRACE if trace is None else trace
    w, c = np.zeros(int(ALL)), np.zeros((cells.factors.shape[0] + 2) * int(CELL))  # beyond either end an idle cell
    lane = np.zeros(LANES, dtype=Index)  # made out here, so that the compiled code does not know how many
    return int(_advance(w, c, lane, columns, cells, damped, outside, inside, first, last, step, trace))


@njit(cache=True, nogil=True, error_model="numpy")
def _advance(
    w: FloatArray, c: FloatArray, lane: NDArray[Index], columns: Columns, cells: Cells, damped: Cells,
    outside: Outside, inside: Inside, first: int, last: int, step: float, trace: Trace,
) -> int:  # fmt: skip
    """Steps of all blocks in turn, a chunk at a time."""
    lanes, shared, failures = Index(lane.size), np.zeros((2, 5)), 0
    for start in range(first, last, CHUNK):
        stop = min(start + CHUNK, last)
        for begin in range(0, columns.orientation.size, lane.size):
            take(lanes, w, c, lane, columns, outside.free, outside.free_colder, begin)
            sample(lanes, w, lane, outside, start)
            for k in range(start, stop):
                sample(lanes, w, lane, outside, k + 1)
                share(shared, outside, inside, k)
                failures += _step(lanes, w, c, shared, cells, damped, outside, inside, step)
                if trace.row.size > 0 and trace.row[k + 1] >= 0:
                    note(lanes, w, trace.faces[trace.row[k + 1]], begin)
            give(lanes, w, c, columns, begin)
    return failures


@inner
def sample(lanes: Index, w: FloatArray, lane: NDArray[Index], outside: Outside, k: int) -> None:
    """The second sample of the last step becomes the first of the next, k its second; all lanes start from its end."""
    irradiance, longwave, film, emissivity = outside.irradiance, outside.longwave, outside.film, outside.emissivity
    for j in range(lanes):
        w[MARK + j], w[START + j], w[INTERIOR_START + j] = 1.0, w[EXTERIOR + j], w[INTERIOR + j]
    for j in range(LATER):
        w[ABSORBED + j] = w[LATER + ABSORBED + j]
    for j in range(lanes):
        o = lane[j]
        sun, sky = irradiance[k, o], longwave[k, o]
        w[LATER + SUN + j], w[LATER + LONGWAVE + j], w[LATER + FORCED + j] = sun, sky, film[k, o]
        w[LATER + ABSORBED + j] = w[ABSORPTANCE + j] * sun + emissivity * sky
    if outside.latent.shape[0] > 1:
        for j in range(lanes):
            w[LATER + EXCHANGE + j] = outside.latent[k, lane[j]]


@inner
def share(shared: FloatArray, outside: Outside, inside: Inside, k: int) -> None:
    """What all columns have in common at both samples of step k."""
    for row in range(2):
        shared[row, AIR], shared[row, VAPOUR] = outside.air[k + row] - ZERO_CELSIUS, outside.vapour[k + row]
        shared[row, ROOM_AIR], shared[row, ROOM_FILM] = inside.air[k + row] - ZERO_CELSIUS, inside.film[k + row]
        shared[row, ROOM_RADIANT] = inside.radiant[k + row]


@inner
def _step(
    lanes: Index, w: FloatArray, c: FloatArray, shared: FloatArray, cells: Cells, damped: Cells, outside: Outside,
    inside: Inside, step: float,
) -> int:  # fmt: skip
    """One step of one block: two stages and, where lanes call for it, backward Euler; returns failed balances."""
    wet, low, high = outside.latent.shape[0] > 1, UNBOUNDED, -UNBOUNDED
    surfaces = (outside.emissivity * SIGMA, inside.emissivity * SIGMA, inside.free)
    failures = _stage(lanes, w, c, shared, surfaces, cells, wet, GAMMA, 0.0, 1.0 - GAMMA)
    failures += _stage(lanes, w, c, shared, surfaces, cells, wet, 1.0, CARRY, GAMMA)
    for row in range(2):
        air, room, radiant = shared[row, AIR], shared[row, ROOM_AIR], shared[row, ROOM_RADIANT] - ZERO_CELSIUS
        low, high = min(low, air, room, radiant), max(high, air, room, radiant)
    bound(lanes, w, low, high)
    if calls_for_damping(lanes, w, c, cells.factors, wet):
        go_back(lanes, w, c)
        failures += _stage(lanes, w, c, shared, surfaces, damped, wet, 1.0, 0.0, 1.0)
        join(lanes, w, c)
    settle(lanes, w, step)
    return failures


@inner
def settle(lanes: Index, w: FloatArray, step: float) -> None:
    """End of a step: heat that has entered, and how far the faces went."""
    for j in range(lanes):
        w[HEAT + j] += step * w[FLUX + j]
        w[INTERIOR_HEAT + j] += step * w[INTERIOR_FLUX + j]
        w[RISE + j], w[INTERIOR_RISE + j] = w[EXTERIOR + j] - w[START + j], w[INTERIOR + j] - w[INTERIOR_START + j]


@inner
def load(lanes: Index, w: FloatArray, at: float, guess: float) -> None:
    """What acts on the exterior face at a fraction `at` of the step; faces go on by `guess` of their last rise."""
    rest = 1.0 - at
    for j in range(lanes):
        forced = rest * w[FORCED + j] + at * w[LATER + FORCED + j]
        w[FILM_CUBED + j], w[MOVED + j] = forced * forced * forced, UNBOUNDED * w[MARK + j]
        w[LOAD + j] = rest * w[ABSORBED + j] + at * w[LATER + ABSORBED + j]
        w[EXTERIOR + j] += guess * w[MARK + j] * w[RISE + j]
        w[INTERIOR + j] += guess * w[MARK + j] * w[INTERIOR_RISE + j]


@inner
def room_at(shared: FloatArray, at: float, free: float, grey: float) -> Room:
    """What acts on the interior face at a fraction of the step."""
    rest = 1.0 - at
    air, film = (
        rest * shared[0, ROOM_AIR] + at * shared[1, ROOM_AIR],
        rest * shared[0, ROOM_FILM] + at * shared[1, ROOM_FILM],
    )
    radiant = rest * shared[0, ROOM_RADIANT] + at * shared[1, ROOM_RADIANT]
    return (air, grey * radiant * radiant * radiant * radiant, film * film * film, free, grey)


@inner
def _stage(
    lanes: Index, w: FloatArray, c: FloatArray, shared: FloatArray, surfaces: tuple[float, float, float],
    wall: Cells, wet: bool, at: float, carry: float, weight: float,
) -> int:  # fmt: skip
    """Solve a stage at a fraction `at` of the step for the lanes that are marked; returns failed balances.

    A second stage goes on from the first by `carry`, and its flux, which counts by `weight`, adds to the first one's.
    """
    rest, grey, room_grey = 1.0 - at, surfaces[0], surfaces[1]
    air, vapour = rest * shared[0, AIR] + at * shared[1, AIR], rest * shared[0, VAPOUR] + at * shared[1, VAPOUR]
    load(lanes, w, at, 1.0 - GAMMA if carry > 0.0 else at)
    _eliminate(lanes, w, c, wall.factors, wall.exchange[4], carry)
    room = room_at(shared, at, surfaces[2], room_grey)
    moving = balance(lanes, w, wall.exchange, grey, air, vapour, room, wet, at)
    _substitute(lanes, w, c, wall.exchange, wall.factors, 0.0 if carry == 0.0 else 1.0, weight)
    return moving


@inner
def _eliminate(lanes: Index, w: FloatArray, c: FloatArray, factors: FloatArray, outermost: float, carry: float) -> None:
    """Elimination of the cells, innermost first, for faces at 0 C, and what the cells then send to the faces."""
    at = Index(c.size) - CELL  # its loops touch c alone: on a way backwards the compiler could not tell it from w
    for i in range(factors.shape[0] - 1, -1, -1):
        at -= CELL
        own, inward, sent = factors[i, 0], factors[i, 1], factors[i, 2]
        if carry == 0.0:
            for j in range(lanes):
                star = c[at + STAGE + j]
                c[at + NOW + j], c[at + SENT + j] = star, c[at + CELL + SENT + j] + sent * star
                c[at + STAGE + j] = own * star + inward * c[at + CELL + STAGE + j]
        else:
            for j in range(lanes):
                star = c[at + NOW + j] + carry * (c[at + STAGE + j] - c[at + NOW + j])
                c[at + FIRST + j], c[at + SENT + j] = c[at + STAGE + j], c[at + CELL + SENT + j] + sent * star
                c[at + STAGE + j] = own * star + inward * c[at + CELL + STAGE + j]
    for j in range(lanes):
        w[LEFT + j], w[RIGHT + j] = outermost * c[at + STAGE + j], c[at + SENT + j]


@inner
def _substitute(
    lanes: Index, w: FloatArray, c: FloatArray, exchange: FloatArray, factors: FloatArray, keep: float, weight: float
) -> None:
    """Flux through the faces, `keep` of what it was and `weight` of this; back substitution of the cells."""
    for j in range(lanes):
        ext, inn, marked = w[EXTERIOR + j], w[INTERIOR + j], w[MARK + j] > 0.0
        flux = keep * w[FLUX + j] + weight * (exchange[0] * ext - exchange[1] * inn - w[LEFT + j])
        flux_inside = keep * w[INTERIOR_FLUX + j] + weight * (exchange[3] * inn - exchange[2] * ext - w[RIGHT + j])
        w[FLUX + j] = flux if marked else w[FLUX + j]
        w[INTERIOR_FLUX + j] = flux_inside if marked else w[INTERIOR_FLUX + j]
        c[STAGE + j] = ext
    for i in range(factors.shape[0]):
        at, outward, face = Index(i + 1) * CELL, factors[i, 3], factors[i, 4]
        for j in range(lanes):
            c[at + STAGE + j] += outward * c[at - CELL + STAGE + j] + face * w[INTERIOR + j]
