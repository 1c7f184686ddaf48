"""The inner loop, compiled: steps of many columns through one wall, in blocks of one lane each.

A column is one orientation at one solar absorptance. A stage solves (C / (gamma dt) + K) T = rhs for the cells, linear
and alike for all columns, condensed onto the faces; their balances are not linear: a 2 x 2 Newton iteration.

Steps: two-stage, second-order, L-stable SDIRK with gamma = 1 - 1/sqrt(2) [Alexander1977]; inputs are linear between
samples. No method of second order keeps every answer monotone [Bolley1978], and a thin metal skin would overshoot the
sunrise: columns in which a stiff cell at a face runs past the temperature that it is drawn to, or any leaves the range
that boundaries and past allow, take that step by backward Euler, which can do neither.
Saturation pressure over water is the polynomial of [Lowe1977], which vectorises where an exponential does not.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.constants import ZERO_CELSIUS
from sensorsim.thermal.boundary import Cells, Columns, FloatArray, Inside, Outside, Work

GAMMA = 1.0 - np.sqrt(0.5)
CARRY = (1.0 - GAMMA) / GAMMA  # weight of the first stage's change in the second stage's right side
TURN = 1e-7  # [K] overshoot that is left alone
ABSORBED, FILM_CUBED, FREE, AIR, EXCHANGE, VAPOUR, LATENT, LATENT_SLOPE, LEFT, RIGHT, MOVED, MARK = range(12)  # rows
LANES = 32
ITERATION_LIMIT = 100
TOLERANCE = 1e-8  # [K] last move; Newton squares it
LEAST_FILM = 1e-3  # [W m-2 K-1] keeps the cube root from dividing by zero in perfectly still air
COLDEST_WATER = -100.0  # [C] below which the saturation polynomial is held


@njit(cache=True, nogil=True, error_model="numpy")
def advance(
    columns: Columns, cells: Cells, damped: Cells, outside: Outside, inside: Inside, first: int, last: int, step: float
) -> int:
    """Make steps `first` to `last` - 1 [of `step` s]; returns how many face balances did not converge.

    `cells` is the wall factored for gamma `step`, `damped` for `step`.
    """
    n, m = columns.cells.shape
    failures, block, pair = 0, (n, LANES), (2, LANES)
    work = Work(
        np.zeros(block), np.zeros(block), np.zeros(block), np.zeros(block), np.zeros(block), np.zeros((12, LANES)),
        np.zeros(pair), np.zeros(pair), np.zeros(pair), np.zeros(pair), np.zeros(pair), np.zeros((6, LANES)),
    )  # fmt: skip
    lane, absorptance = np.zeros(LANES, dtype=np.int64), np.zeros(LANES)
    for begin in range(0, m, LANES):
        _take(columns, work, lane, absorptance, begin)
        heat = np.zeros((2, LANES))
        for k in range(first, last):
            failures += _step(work, lane, absorptance, cells, damped, outside, inside, k)
            heat += step * work.flux[:2]
        _give(columns, work, heat, begin)
    return failures


@njit(cache=True, nogil=True, error_model="numpy")
def _take(columns: Columns, work: Work, lane: NDArray[np.int64], absorptance: FloatArray, begin: int) -> None:
    """Columns into lanes; lanes beyond the last column repeat it."""
    n, m = columns.cells.shape
    for j in range(LANES):
        c = min(begin + j, m - 1)
        lane[j], absorptance[j] = columns.orientation[c], columns.absorptance[c]
        for i in range(n):
            work.now[i, j] = columns.cells[i, c]
        for face in range(2):
            work.faces[face, j], work.films[face, j] = columns.faces[face, c], columns.films[face, c]


@njit(cache=True, nogil=True, error_model="numpy")
def _give(columns: Columns, work: Work, heat: FloatArray, begin: int) -> None:
    """Lanes back into columns."""
    n, m = columns.cells.shape
    for j in range(min(LANES, m - begin)):
        for i in range(n):
            columns.cells[i, begin + j] = work.now[i, j]
        for face in range(2):
            columns.faces[face, begin + j], columns.films[face, begin + j] = work.faces[face, j], work.films[face, j]
            columns.heat[face, begin + j] += heat[face, j]


@njit(cache=True, nogil=True, error_model="numpy")
def _step(
    work: Work, lane: NDArray[np.int64], absorptance: FloatArray, cells: Cells, damped: Cells, outside: Outside,
    inside: Inside, k: int,
) -> int:  # fmt: skip
    """One step of one block: two stages and, where lanes call for it, backward Euler; returns failed balances."""
    n, failures, solves, wet = work.now.shape[0], 0, 2, outside.latent.shape[0] > 1
    work.ends[:] = work.faces
    for solve in range(3):
        if solve == 2:
            if not _calls_for_damping(work, lane, cells, outside, inside, k):
                break
            solves = 3
            work.kept[:] = work.cells
            work.trial[:] = work.ends
            work.held[:] = work.films
            work.ends[:] = work.faces
        for i in range(n):
            for j in range(LANES):
                change = work.cells[i, j] - work.now[i, j]
                work.first[i, j] = change if solve == 1 else work.first[i, j]
                work.star[i, j] = work.now[i, j] + (CARRY * change if solve == 1 else 0.0)
        at = GAMMA if solve == 0 else 1.0
        _load(work.load, lane, absorptance, outside, k, at)
        wall = damped if solve == 2 else cells
        failures += _solve(work, wall, outside.emissivity, inside, k, at, wet, 2 * solve)
    _finish(work, solves == 3)
    return failures


@njit(cache=True, nogil=True, error_model="numpy")
def _finish(work: Work, damped: bool) -> None:
    """The step's outcome, of the lanes that are marked by backward Euler, into `now`, `faces` and the first fluxes."""
    for face in range(2):
        for j in range(LANES):
            again = damped and work.load[MARK, j] > 0.0
            late = (1.0 - GAMMA) * work.flux[face, j] + GAMMA * work.flux[2 + face, j]
            work.flux[face, j] = work.flux[4 + face, j] if again else late
            work.faces[face, j] = work.trial[face, j] if damped and not again else work.ends[face, j]
            work.films[face, j] = work.held[face, j] if damped and not again else work.films[face, j]
    if damped:
        for i in range(work.now.shape[0]):
            for j in range(LANES):
                work.now[i, j] = work.cells[i, j] if work.load[MARK, j] > 0.0 else work.kept[i, j]
    else:
        work.now[:] = work.cells


@njit(cache=True, nogil=True, error_model="numpy")
def _load(
    load: FloatArray, lane: NDArray[np.int64], absorptance: FloatArray, outside: Outside, k: int, at: float
) -> None:
    """What acts on the exterior face at a fraction of step k."""
    rest = 1.0 - at
    air = rest * outside.air[k] + at * outside.air[k + 1] - ZERO_CELSIUS
    for j in range(LANES):
        o = lane[j]
        sun = rest * outside.irradiance[k, o] + at * outside.irradiance[k + 1, o]
        sky = rest * outside.longwave[k, o] + at * outside.longwave[k + 1, o]
        film = rest * outside.film[k, o] + at * outside.film[k + 1, o]
        load[ABSORBED, j] = absorptance[j] * sun + outside.emissivity * sky
        load[FILM_CUBED, j] = film * film * film
        load[FREE, j] = outside.free[o]
        load[AIR, j] = air
    if outside.latent.shape[0] > 1:
        for j in range(LANES):
            o = lane[j]
            load[EXCHANGE, j] = rest * outside.latent[k, o] + at * outside.latent[k + 1, o]
            load[VAPOUR, j] = rest * outside.vapour[k] + at * outside.vapour[k + 1]


@njit(cache=True, nogil=True, error_model="numpy")
def _calls_for_damping(
    work: Work, lane: NDArray[np.int64], cells: Cells, outside: Outside, inside: Inside, k: int
) -> bool:
    """Mark the lanes that call for it: a stiff cell passed the temperature it was drawn to, or left its bounds."""
    _bound(work, lane, outside, inside, k)
    least, most, mark = work.load[LEFT], work.load[RIGHT], work.load[MARK]
    mark[:] = 0.0
    n = work.now.shape[0]
    for i in range(n):
        reach = 1.0 + cells.lag[i] if cells.stiff[i] and (i == 0 or i == n - 1) else 1e9
        for j in range(LANES):
            first, second = work.first[i, j], work.cells[i, j] - work.star[i, j]
            beyond = work.cells[i, j] - work.now[i, j] - reach * first  # past the balance of the first stage
            passed = first * second < 0.0 and beyond * first > 0.0 and abs(beyond) > TURN
            left = work.cells[i, j] < least[j] or work.cells[i, j] > most[j]
            mark[j] = 1.0 if passed or left else mark[j]
    return bool(mark.max() > 0.0)


@njit(cache=True, nogil=True, error_model="numpy")
def _bound(work: Work, lane: NDArray[np.int64], outside: Outside, inside: Inside, k: int) -> None:
    """Range that the maximum principle leaves for a step: past, air, radiant surroundings; sun lifts the upper end."""
    low = min(outside.air[k], outside.air[k + 1], inside.air[k], inside.air[k + 1])
    high = max(outside.air[k], outside.air[k + 1], inside.air[k], inside.air[k + 1])
    low = min(low, inside.radiant[k], inside.radiant[k + 1]) - ZERO_CELSIUS
    high = max(high, inside.radiant[k], inside.radiant[k + 1]) - ZERO_CELSIUS
    least, most, wet = work.load[LEFT], work.load[RIGHT], outside.latent.shape[0] > 1
    for j in range(LANES):
        o = lane[j]
        sky, later = outside.longwave[k, o], outside.longwave[k + 1, o]
        coldest = np.sqrt(np.sqrt(min(sky, later) / SIGMA)) - ZERO_CELSIUS
        warmest = np.sqrt(np.sqrt(max(sky, later) / SIGMA)) - ZERO_CELSIUS
        sunlit = outside.irradiance[k, o] + outside.irradiance[k + 1, o] > 0.0
        least[j] = -1e9 if wet else min(low, coldest, work.faces[0, j], work.faces[1, j])
        most[j] = 1e9 if wet or sunlit else max(high, warmest, work.faces[0, j], work.faces[1, j])
    for i in range(work.now.shape[0]):
        for j in range(LANES):
            least[j], most[j] = min(least[j], work.now[i, j]), max(most[j], work.now[i, j])


@njit(cache=True, nogil=True, error_model="numpy")
def _solve(work: Work, wall: Cells, emissivity: float, inside: Inside, k: int, at: float, wet: bool, row: int) -> int:
    """Solve a stage from its right side `star` into `cells` and `ends`; fluxes go to `row`; returns failed balances."""
    n, load, ends, a = work.now.shape[0], work.load, work.ends, wall.exchange
    _sweep(work.cells, work.star, wall)
    for j in range(LANES):
        load[LEFT, j] = wall.conductance[0] * work.cells[0, j] if n > 0 else 0.0
        load[RIGHT, j] = wall.conductance[n] * work.cells[n - 1, j] if n > 0 else 0.0
    rest = 1.0 - at
    radiant = rest * inside.radiant[k] + at * inside.radiant[k + 1]
    air = rest * inside.air[k] + at * inside.air[k + 1] - ZERO_CELSIUS
    film = rest * inside.film[k] + at * inside.film[k + 1]
    room = (air, inside.emissivity * SIGMA * radiant**4, film**3, inside.free, inside.emissivity * SIGMA)
    failures = _balance(work, a, emissivity * SIGMA, room, wet)
    for j in range(LANES):
        work.flux[row, j] = a[0, 0] * ends[0, j] - a[0, 1] * ends[1, j] - load[LEFT, j]
        work.flux[row + 1, j] = a[1, 1] * ends[1, j] - a[1, 0] * ends[0, j] - load[RIGHT, j]
    for i in range(n):
        for j in range(LANES):
            work.cells[i, j] += wall.influence[0, i] * ends[0, j] + wall.influence[1, i] * ends[1, j]
    return failures


@njit(cache=True, nogil=True, error_model="numpy")
def _sweep(cells: FloatArray, star: FloatArray, wall: Cells) -> None:
    """Solve the cells for faces at 0 C."""
    n = cells.shape[0]
    for i in range(n):
        rate, pivot = wall.rate[i] * wall.pivot[i], wall.pivot[i] * wall.conductance[i]
        for j in range(LANES):
            cells[i, j] = rate * star[i, j]
        if i > 0:
            for j in range(LANES):
                cells[i, j] += pivot * cells[i - 1, j]
    for i in range(n - 2, -1, -1):
        back = wall.conductance[i + 1] * wall.pivot[i]
        for j in range(LANES):
            cells[i, j] += back * cells[i + 1, j]


@njit(cache=True, nogil=True, error_model="numpy")
def _balance(
    work: Work, exchange: FloatArray, grey: float, room: tuple[float, float, float, float, float], wet: bool
) -> int:
    """Newton iteration of both faces; returns how many lanes did not converge."""
    moving = 0
    work.load[MOVED] = 1.0
    for _ in range(ITERATION_LIMIT):
        if wet:
            _evaporate(work.load, work.ends)
        _approach(work.load, work.ends, work.films, exchange, grey, room)
        moving = 0
        for j in range(LANES):
            moving += 0 if work.load[MOVED, j] <= TOLERANCE else 1
        if moving == 0:
            break
    return moving


@njit(cache=True, nogil=True, error_model="numpy")
def _approach(
    load: FloatArray, ends: FloatArray, films: FloatArray, exchange: FloatArray, grey: float,
    room: tuple[float, float, float, float, float],
) -> None:  # fmt: skip
    """One Newton step of both faces, in one loop over the lanes, because that is what vectorises."""
    a, b, c, d = exchange[0, 0], exchange[0, 1], exchange[1, 0], exchange[1, 1]
    air, radiation, cubed, free, grey_inside = room
    third = 1.0 / 3.0
    for j in range(LANES):
        ext, inn, h, h_inside = ends[0, j], ends[1, j], films[0, j], films[1, j]
        gap, gap_inside = load[AIR, j] - ext, air - inn
        inverse, inverse_inside = 1.0 / (h * h), 1.0 / (h_inside * h_inside)
        lift, lift_inside = load[FREE, j] * abs(gap) * inverse, free * abs(gap_inside) * inverse_inside
        h = max((2.0 * h + load[FILM_CUBED, j] * inverse + lift) * third, LEAST_FILM)
        h_inside = max((2.0 * h_inside + cubed * inverse_inside + lift_inside) * third, LEAST_FILM)
        total = h if load[FILM_CUBED, j] + load[FREE, j] > 0.0 else 0.0
        total_inside = h_inside if cubed + free > 0.0 else 0.0
        kelvin, kelvin_inside = ext + ZERO_CELSIUS, inn + ZERO_CELSIUS
        cube = grey * kelvin * kelvin * kelvin
        cube_inside = grey_inside * kelvin_inside * kelvin_inside * kelvin_inside
        lack = load[ABSORBED, j] + total * gap - cube * kelvin - load[LATENT, j] - a * ext + b * inn + load[LEFT, j]
        lack_inside = radiation + total_inside * gap_inside - cube_inside * kelvin_inside
        lack_inside += c * ext - d * inn + load[RIGHT, j]
        slope = a + total + lift * third + 4.0 * cube + load[LATENT_SLOPE, j]
        slope_inside = d + total_inside + lift_inside * third + 4.0 * cube_inside
        scale = 1.0 / (slope * slope_inside - b * c)
        move = (lack * slope_inside + b * lack_inside) * scale
        move_inside = (lack_inside * slope + c * lack) * scale
        moves = load[MOVED, j] > TOLERANCE  # a lane that has settled does not know whether its neighbours have
        films[0, j] = h if moves else films[0, j]
        films[1, j] = h_inside if moves else films[1, j]
        ends[0, j] = max(ext + move, -ZERO_CELSIUS) if moves else ext
        ends[1, j] = max(inn + move_inside, -ZERO_CELSIUS) if moves else inn
        load[MOVED, j] = abs(move) + abs(move_inside) if moves else load[MOVED, j]


@njit(cache=True, nogil=True, error_model="numpy")
def _evaporate(load: FloatArray, ends: FloatArray) -> None:
    """Latent heat that leaves a wet face and its slope, by the saturation pressure of [Lowe1977]."""
    for j in range(LANES):
        t = max(ends[0, j], COLDEST_WATER)
        high = 3.031240396e-4 + t * (2.034080948e-6 + t * 6.136820929e-9)
        pressure = 610.7799961 + t * (44.36518521 + t * (1.428945805 + t * (2.650648471e-2 + t * high)))
        high = 4.0 * 3.031240396e-4 + t * (5.0 * 2.034080948e-6 + t * 6.0 * 6.136820929e-9)
        rise = 44.36518521 + t * (2.0 * 1.428945805 + t * (3.0 * 2.650648471e-2 + t * high))
        load[LATENT, j] = load[EXCHANGE, j] * (pressure - load[VAPOUR, j])
        load[LATENT_SLOPE, j] = load[EXCHANGE, j] * max(rise, 0.0)
