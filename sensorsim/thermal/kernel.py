"""The inner loop: steps of many columns through one wall, compiled.

A column is one orientation at one solar absorptance. Within a step each stage solves (C / (gamma dt) + K) T = rhs for
the cells, which is linear and the same for all columns, and a balance at each face, which is not. The cells are
condensed onto the two faces by one forward and one backward sweep; a 2 x 2 Newton iteration then finds the faces.
Stages: two-stage, second-order, L-stable SDIRK with gamma = 1 - 1/sqrt(2) [Alexander1977]; inputs are linear between
samples. Films join forced and free convection by their cubes [Churchill1977]; the cube root is taken by one Newton
step along with each step of the face temperatures, because it starts from the last step's value.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT

FloatArray = NDArray[np.float64]

GAMMA = 1.0 - np.sqrt(0.5)
CARRY = (1.0 - GAMMA) / GAMMA  # weight of the first stage's change in the second stage's right side
BLOCK = 32  # columns that go through the cells together: fills the vector registers, stays in the nearest cache
ITERATION_LIMIT = 60
TOLERANCE = 1e-9  # [K]
LEAST_FILM = 1e-6  # [W m-2 K-1] keeps the cube root from dividing by zero in perfectly still air
SIGMA = STEFAN_BOLTZMANN_CONSTANT


class Cells(NamedTuple):
    """A wall's linear part, factored for one step length."""

    rate: FloatArray  # (n,) capacity / (gamma step) [W m-2 K-1]
    conductance: FloatArray  # (n + 1,) [W m-2 K-1]
    pivot: FloatArray  # (n,) reciprocal pivots of the elimination [m2 K W-1]
    influence: FloatArray  # (2, n) cell temperatures per kelvin of the exterior and of the interior face [-]
    exchange: FloatArray  # (2, 2) flux into the wall per kelvin of either face [W m-2 K-1]


class Outside(NamedTuple):
    """What acts on the exterior face, at samples (t) and orientations (o)."""

    irradiance: FloatArray  # (t, o) solar [W m-2]
    longwave: FloatArray  # (t, o) irradiance from sky and ground [W m-2]
    film: FloatArray  # (t, o) forced [W m-2 K-1]
    free: FloatArray  # (o,) free film cubed per kelvin [W3 m-6 K-4]
    air: FloatArray  # (t,) [K]
    emissivity: float


class Inside(NamedTuple):
    """What acts on the interior face."""

    air: FloatArray  # (t,) [K]
    radiant: FloatArray  # (t,) [K]
    film: FloatArray  # (t,) forced [W m-2 K-1]
    free: float  # free film cubed per kelvin [W3 m-6 K-4]
    emissivity: float


class Columns(NamedTuple):
    """State of all columns, updated in place."""

    cells: FloatArray  # (n, m) [K]
    faces: FloatArray  # (2, m) exterior, interior [K]
    films: FloatArray  # (2, m) total films [W m-2 K-1]
    heat: FloatArray  # (2, m) heat that has entered through each face [J m-2]
    orientation: NDArray[np.int64]  # (m,)
    absorptance: FloatArray  # (m,)


@njit(cache=True, nogil=True, error_model="numpy", boundscheck=False)
def advance(
    columns: Columns, cells: Cells, outside: Outside, inside: Inside, first: int, last: int, step: float
) -> int:
    """Make steps `first` to `last` - 1 [of `step` s]; returns how many face balances did not converge."""
    n, m = columns.cells.shape
    failures = 0
    stage = np.zeros((n, BLOCK))
    target = np.zeros((n, BLOCK))
    load = np.zeros((5, BLOCK))
    for begin in range(0, m, BLOCK):
        width = min(BLOCK, m - begin)
        for k in range(first, last):
            for s in range(2):
                _right_side(columns.cells, stage, target, begin, width, s)
                _sweep(target, cells, width)
                at = GAMMA if s == 0 else 1.0
                _load(load, columns, outside, k, at, begin, width)
                room = _room(inside, k, at)
                failures += _faces(columns, load, target, cells, outside, inside, room, begin, width)
                weight = step * (1.0 - GAMMA) if s == 0 else step * GAMMA
                _settle(columns, stage, target, cells, weight, begin, width)
            for i in range(n):
                for j in range(width):
                    columns.cells[i, begin + j] = stage[i, j]
    return failures


@njit(cache=True, nogil=True, error_model="numpy")
def _right_side(cells: FloatArray, stage: FloatArray, target: FloatArray, begin: int, width: int, s: int) -> None:
    """Temperatures that the stage relaxes from; the second stage carries the first one's slope on."""
    for i in range(cells.shape[0]):
        for j in range(width):
            start = cells[i, begin + j]
            target[i, j] = start if s == 0 else start + CARRY * (stage[i, j] - start)


@njit(cache=True, nogil=True, error_model="numpy")
def _sweep(target: FloatArray, cells: Cells, width: int) -> None:
    """Solve the cells for faces at 0 K, in place."""
    n = cells.rate.shape[0]
    for i in range(n):
        for j in range(width):
            above = cells.conductance[i] * target[i - 1, j] if i > 0 else 0.0
            target[i, j] = (cells.rate[i] * target[i, j] + above) * cells.pivot[i]
    for i in range(n - 2, -1, -1):
        for j in range(width):
            target[i, j] += cells.conductance[i + 1] * cells.pivot[i] * target[i + 1, j]


@njit(cache=True, nogil=True, error_model="numpy")
def _load(load: FloatArray, columns: Columns, outside: Outside, k: int, at: float, begin: int, width: int) -> None:
    """Absorbed flux, forced film and its cube, free film and air of a block at a fraction of step k."""
    rest = 1.0 - at
    for j in range(width):
        o = columns.orientation[begin + j]
        sun = rest * outside.irradiance[k, o] + at * outside.irradiance[k + 1, o]
        sky = rest * outside.longwave[k, o] + at * outside.longwave[k + 1, o]
        load[0, j] = columns.absorptance[begin + j] * sun + outside.emissivity * sky
        load[1, j] = rest * outside.film[k, o] + at * outside.film[k + 1, o]
        load[2, j] = outside.free[o]
        load[3, j] = rest * outside.air[k] + at * outside.air[k + 1]


@njit(cache=True, nogil=True, error_model="numpy")
def _room(inside: Inside, k: int, at: float) -> tuple[float, float, float]:
    """Interior air, absorbed interior radiation and interior forced film at a fraction of step k."""
    rest = 1.0 - at
    radiant = rest * inside.radiant[k] + at * inside.radiant[k + 1]
    return (
        rest * inside.air[k] + at * inside.air[k + 1],
        inside.emissivity * SIGMA * radiant**4,
        rest * inside.film[k] + at * inside.film[k + 1],
    )


@njit(cache=True, nogil=True, error_model="numpy")
def _film(forced: float, free: float, difference: float, h: float) -> float:
    """Total film, by a Newton step towards (forced^3 + free |difference|)^(1/3) from h [W m-2 K-1]."""
    root = (2.0 * h + (forced * forced * forced + free * difference) / (h * h)) / 3.0
    return forced if free == 0.0 else max(root, LEAST_FILM)


@njit(cache=True, nogil=True, error_model="numpy")
def _faces(
    columns: Columns, load: FloatArray, target: FloatArray, cells: Cells, outside: Outside, inside: Inside,
    room: tuple[float, float, float], begin: int, width: int,
) -> int:  # fmt: skip
    """Newton iteration of both faces' heat balances for a block; returns how many columns did not converge."""
    faces, films, n = columns.faces, columns.films, cells.rate.shape[0]
    grey, grey_inside = outside.emissivity * SIGMA, inside.emissivity * SIGMA
    a, b, c, d = cells.exchange[0, 0], cells.exchange[0, 1], cells.exchange[1, 0], cells.exchange[1, 1]
    for _ in range(ITERATION_LIMIT):
        for j in range(width):
            ext, inn = faces[0, begin + j], faces[1, begin + j]
            from_first = cells.conductance[0] * target[0, j] if n > 0 else 0.0
            from_last = cells.conductance[n] * target[n - 1, j] if n > 0 else 0.0
            gap, gap_inside = load[3, j] - ext, room[0] - inn
            h = _film(load[1, j], load[2, j], abs(gap), films[0, begin + j])
            h_inside = _film(room[2], inside.free, abs(gap_inside), films[1, begin + j])
            films[0, begin + j], films[1, begin + j] = h, h_inside
            left = load[0, j] + h * gap - grey * ext**4 - a * ext + b * inn + from_first
            right = room[1] + h_inside * gap_inside - grey_inside * inn**4 - d * inn + c * ext + from_last
            bend = load[2, j] * abs(gap) / (3.0 * h * h) if load[2, j] > 0.0 else 0.0
            bend_inside = inside.free * abs(gap_inside) / (3.0 * h_inside * h_inside) if inside.free > 0.0 else 0.0
            slope = a + h + bend + 4.0 * grey * ext**3
            slope_inside = d + h_inside + bend_inside + 4.0 * grey_inside * inn**3
            scale = 1.0 / (slope * slope_inside - b * c)
            move, move_inside = (left * slope_inside + b * right) * scale, (right * slope + c * left) * scale
            faces[0, begin + j], faces[1, begin + j] = max(ext + move, 0.0), max(inn + move_inside, 0.0)
            load[4, j] = abs(move) + abs(move_inside)
        moving = 0
        for j in range(width):
            moving += not load[4, j] <= TOLERANCE
        if moving == 0:
            return 0
    return moving


@njit(cache=True, nogil=True, error_model="numpy")
def _settle(
    columns: Columns, stage: FloatArray, target: FloatArray, cells: Cells, weight: float, begin: int, width: int
) -> None:
    """Cells from the found faces; the heat that went through the faces during the stage."""
    n = cells.rate.shape[0]
    for i in range(n):
        for j in range(width):
            ext, inn = columns.faces[0, begin + j], columns.faces[1, begin + j]
            stage[i, j] = target[i, j] + cells.influence[0, i] * ext + cells.influence[1, i] * inn
    for j in range(width):
        ext, inn = columns.faces[0, begin + j], columns.faces[1, begin + j]
        next_ext = stage[0, j] if n > 0 else inn
        next_inn = stage[n - 1, j] if n > 0 else ext
        columns.heat[0, begin + j] += weight * cells.conductance[0] * (ext - next_ext)
        columns.heat[1, begin + j] += weight * cells.conductance[n] * (inn - next_inn)
