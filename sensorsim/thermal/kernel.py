"""The inner loop, compiled: steps of many columns through one wall, in blocks with a lane for each.

A column is one orientation at one solar absorptance. A stage solves (C / (gamma dt) + K) T = rhs for the cells, linear
and alike for all columns, condensed onto the faces, whose balances are not linear (see `balance`).

Steps: two-stage, second-order, L-stable SDIRK with gamma = 1 - 1/sqrt(2) [Alexander1977]; inputs are linear between
samples. Columns that overshoot take that step by backward Euler, which cannot (see `damping`).
"""

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.constants import ZERO_CELSIUS
from sensorsim.thermal.balance import Exchange, Guess, Room, balance
from sensorsim.thermal.boundary import Cells, Columns, FloatArray, Inside, Outside, Trace
from sensorsim.thermal.damping import CARRY, GAMMA, calls_for_damping, go_back, join
from sensorsim.thermal.lanes import (
    ABSORBED,
    ABSORPTANCE,
    ALL,
    CELL,
    EXCHANGE,
    EXTERIOR,
    FLUX,
    FORCED,
    HEAT,
    INTERIOR,
    INTERIOR_FLUX,
    INTERIOR_HEAT,
    INTERIOR_RISE,
    INTERIOR_RISE_BEFORE,
    INTERIOR_START,
    LATER,
    LATER_FLUX,
    LATER_INTERIOR_FLUX,
    LEFT,
    LONGWAVE,
    OUTERMOST,
    RIGHT,
    RISE,
    RISE_BEFORE,
    START,
    SUN,
    WORK,
    Group,
    Index,
    give,
    group_at,
    groups,
    inner,
    lanes_for,
    note,
    outer,
    room_for,
    scalar,
    spread,
    take,
    wide,
)
from sensorsim.thermal.passes import close, eliminate, substitute, turn

Shared = tuple[float, float, float, float, float]  # air [C], vapour, room's air [C], radiant temperature [K], film
NO_TRACE = Trace(np.zeros(0, dtype=np.int64), np.zeros((0, 2, 0)))
# Of how far the last stage, the last step and the one before went: where the faces are looked for.
FIRST_GUESS = (0.0, GAMMA + 0.5 * GAMMA * (1.0 + GAMMA), -0.5 * GAMMA * (1.0 + GAMMA))
SECOND_GUESS = (1.0 / GAMMA, 0.0, 0.0)
DAMPED_GUESS = (0.0, 1.0, 0.0)
CHUNK = 32  # steps that all blocks make in turn, so that what acts on them is fetched from memory once


def advance(
    columns: Columns, cells: Cells, damped: Cells, outside: Outside, inside: Inside, first: int, last: int, step: float,
    trace: Trace | None = None,
) -> int:  # fmt: skip
    """Make steps `first` to `last` - 1 [of `step` s]; returns how many face balances did not converge.

    `cells` is the wall factored for gamma `step`, `damped` for `step`; what `trace` asks for is written into it.
    """
    trace = NO_TRACE if trace is None else trace
    place = np.arange(1, cells.outward.shape[0] + 2, dtype=Index) * CELL  # before and beyond them an idle cell
    w, c = room_for(int(ALL)), room_for((place.size + 1) * int(CELL))
    lanes = lanes_for(outside.irradiance.shape[1])
    return int(_advance(lanes, w, c, place, columns, cells, damped, outside, inside, first, last, step, trace))


@outer
def _advance(
    lanes: Index, w: FloatArray, c: FloatArray, place: NDArray[Index], columns: Columns, cells: Cells,
    damped: Cells, outside: Outside, inside: Inside, first: int, last: int, step: float, trace: Trace,
) -> int:  # fmt: skip
    """Steps of all blocks in turn, a chunk at a time."""
    wide()
    failures = 0
    for start in range(first, last, CHUNK):
        stop = min(start + CHUNK, last)
        for number in range(groups(columns, lanes)):
            group = group_at(columns, lanes, number)
            take(lanes, w, c, group, columns, outside)
            sample(lanes, w, group, outside, start)
            eliminate(lanes, w, c, place, cells.outward, cells.exchange[0, 4])
            for k in range(start, stop):
                sample(lanes, w, group, outside, k + 1)
                early, late = share(outside, inside, k), share(outside, inside, k + 1)
                failures += _step(lanes, w, c, place, early, late, cells, damped, outside, inside, step)
                if trace.row.size > 0 and trace.row[k + 1] >= 0:
                    note(w, trace.faces[trace.row[k + 1]], group)
            give(w, c, group, columns)
    return failures


@scalar
def sample(lanes: Index, w: FloatArray, group: Group, outside: Outside, k: int) -> None:
    """The second sample of the last step becomes the first of the next, k its second; all lanes start from its end."""
    for j in range(lanes):
        w[START + j], w[INTERIOR_START + j] = w[EXTERIOR + j], w[INTERIOR + j]
    for j in range(LATER):
        w[ABSORBED + j] = w[LATER + ABSORBED + j]
    spread(lanes, w, LATER + SUN, outside.irradiance[k], group.begin, group.width)
    spread(lanes, w, LATER + LONGWAVE, outside.longwave[k], group.begin, group.width)
    spread(lanes, w, LATER + FORCED, outside.film[k], group.begin, group.width)
    if outside.latent.shape[0] > 1:
        spread(lanes, w, LATER + EXCHANGE, outside.latent[k], group.begin, group.width)
    for j in range(lanes):
        absorbed = w[ABSORPTANCE + j] * w[LATER + SUN + j]
        w[LATER + ABSORBED + j] = absorbed + outside.emissivity * w[LATER + LONGWAVE + j]


@scalar
def share(outside: Outside, inside: Inside, k: int) -> Shared:
    """What all columns have in common at a sample."""
    air, room = outside.air[k] - ZERO_CELSIUS, inside.air[k] - ZERO_CELSIUS
    return (air, outside.vapour[k], room, inside.radiant[k], inside.film[k])


@scalar
def _step(
    lanes: Index, w: FloatArray, c: FloatArray, place: NDArray[Index], early: Shared, late: Shared, cells: Cells,
    damped: Cells, outside: Outside, inside: Inside, step: float,
) -> int:  # fmt: skip
    """One step of one block: two stages and, where lanes call for it, backward Euler; returns failed balances."""
    first, second, whole = _swap(cells.exchange, 0), _swap(cells.exchange, 1), _swap(damped.exchange, 0)
    failures = _faces(lanes, w, early, late, outside, inside, first, GAMMA, FIRST_GUESS)
    flow(lanes, w, first, Index(0))
    if cells.reach[0] > 0.0:
        outermost(lanes, w, c, cells.outward)
    turn(lanes, w, c, place, cells.outward, cells.inward, second[4], CARRY)
    failures += _faces(lanes, w, early, late, outside, inside, second, 1.0, SECOND_GUESS)
    flow(lanes, w, second, LATER_FLUX - FLUX)
    close(lanes, w, c, place, cells.inward, cells.outward, first[4])
    low = min(min(early[0], late[0]), min(early[2], late[2]), min(early[3], late[3]) - ZERO_CELSIUS)
    high = max(max(early[0], late[0]), max(early[2], late[2]), max(early[3], late[3]) - ZERO_CELSIUS)
    if calls_for_damping(lanes, w, c, place, low, high, cells.reach, outside.latent.shape[0] > 1):
        go_back(lanes, w, c, place)
        eliminate(lanes, w, c, place, damped.outward, whole[4])
        failures += _faces(lanes, w, early, late, outside, inside, whole, 1.0, DAMPED_GUESS)
        flow(lanes, w, whole, Index(0))
        flow(lanes, w, whole, LATER_FLUX - FLUX)
        substitute(lanes, w, c, place, damped.outward)
        join(lanes, w)
        eliminate(lanes, w, c, place, cells.outward, first[4])
    settle(lanes, w, step)
    return failures


@scalar
def _swap(exchange: FloatArray, row: int) -> Exchange:
    return (exchange[row, 0], exchange[row, 1], exchange[row, 2], exchange[row, 3], exchange[row, 4])


@inner
def outermost(lanes: Index, w: FloatArray, c: FloatArray, ended: FloatArray) -> None:
    """The outermost cell after the first stage."""
    wide()
    for j in range(lanes):
        w[OUTERMOST + j] = c[CELL + WORK + j] + ended[0, 3] * w[EXTERIOR + j] + ended[0, 4] * w[INTERIOR + j]


@inner
def flow(lanes: Index, w: FloatArray, exchange: Exchange, at: Index) -> None:
    """Flux through the faces, as the cells have it."""
    wide()
    a, b, c, d, _ = exchange
    for j in range(lanes):
        ext, inn = w[EXTERIOR + j], w[INTERIOR + j]
        w[at + FLUX + j] = a * ext - b * inn - w[LEFT + j]
        w[at + INTERIOR_FLUX + j] = d * inn - c * ext - w[RIGHT + j]


@inner
def settle(lanes: Index, w: FloatArray, step: float) -> None:
    """End of a step: heat that has entered, and how far the faces went."""
    wide()
    early, late = (1.0 - GAMMA) * step, GAMMA * step
    for j in range(lanes):
        w[HEAT + j] += early * w[FLUX + j] + late * w[LATER_FLUX + j]
        w[INTERIOR_HEAT + j] += early * w[INTERIOR_FLUX + j] + late * w[LATER_INTERIOR_FLUX + j]
        w[RISE_BEFORE + j], w[INTERIOR_RISE_BEFORE + j] = w[RISE + j], w[INTERIOR_RISE + j]
        w[RISE + j], w[INTERIOR_RISE + j] = w[EXTERIOR + j] - w[START + j], w[INTERIOR + j] - w[INTERIOR_START + j]


@scalar
def room_at(early: Shared, late: Shared, at: float, free: float, grey: float) -> Room:
    """What acts on the interior face at a fraction of the step."""
    rest = 1.0 - at
    air, radiant, film = rest * early[2] + at * late[2], rest * early[3] + at * late[3], rest * early[4] + at * late[4]
    return (air, grey * radiant * radiant * radiant * radiant, film * film * film, free, grey)


@scalar
def _faces(
    lanes: Index, w: FloatArray, early: Shared, late: Shared, outside: Outside, inside: Inside, exchange: Exchange,
    at: float, guess: Guess,
) -> int:  # fmt: skip
    """Solve both faces at a fraction `at` of the step; returns failed balances."""
    wet, rest, grey = outside.latent.shape[0] > 1, 1.0 - at, outside.emissivity * SIGMA
    air, vapour = rest * early[0] + at * late[0], rest * early[1] + at * late[1]
    room = room_at(early, late, at, inside.free, inside.emissivity * SIGMA)
    return balance(lanes, w, exchange, grey, air, vapour, room, wet, at, guess)
