"""A wall's conduction, factored once: the elimination of its cells, either way, and their response to the two faces.

The matrix (C / (gamma dt) + K) is tridiagonal, symmetric and an M-matrix, so the elimination needs no pivoting.
Source: eq. 2 and 9 of [Report1978], solved implicitly; eq. 9 prints no bracket around T[i-1] + T[i+1], which
consistency (eq. 10) demands.
"""

import numpy as np
from numba import njit

from sensorsim.thermal.boundary import Cells, FloatArray
from sensorsim.thermal.grid import WallGrid

STIFF = 1.0 + np.sqrt(2.0)  # of a cell's own relaxation over a step, from where the two stages may overshoot


def factor(grid: WallGrid, span: float, step: float) -> Cells:
    """Elimination factors of a wall for an implicit stage of `span` [s] within steps of `step` [s]."""
    rate, conductance = grid.capacity / span, grid.conductance
    if rate.size == 0:
        idle = np.array([1.0, 1.0, 1.0, 1.0, 0.0]) * conductance[0]
        return Cells(np.stack([idle, idle]), np.zeros((0, 5)), np.zeros((0, 5)), np.zeros(2))
    return Cells(*_factored(rate, conductance, grid.capacity, step))


@njit(cache=True, nogil=True, error_model="numpy")
def _factored(
    rate: FloatArray, conductance: FloatArray, capacity: FloatArray, step: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """The parts of `Cells` for at least one cell; compiled, as a bake factors hundreds of walls in one go."""
    outward, gains = _eliminate(rate, conductance)
    inward, mirrored = _eliminate(rate[::-1].copy(), conductance[::-1].copy())
    exchange, reach = np.zeros((2, 5)), np.zeros(2)
    exchange[0, :4], exchange[0, 4] = gains, conductance[0]
    exchange[1, :4], exchange[1, 4] = mirrored[::-1], conductance[-1]
    for end in (0, -1):
        around = conductance[end] + conductance[1 if end == 0 else -2]
        if step * around > STIFF * capacity[end]:
            reach[end] = 1.0 + rate[end] / around
    return exchange, outward, inward[::-1].copy(), reach


@njit(cache=True, nogil=True, error_model="numpy")
def _eliminate(rate: FloatArray, conductance: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Factors (n, 5) of an elimination from the last cell to the first, and what the faces exchange (4,)."""
    n = rate.size
    inner, factors = rate + conductance[n], np.zeros((n, 5))
    pivot, face = 0.0, 1.0
    for i in range(n - 1, -1, -1):  # sums of positive terms alone: a metal skin's differences would be all rounding
        if i < n - 1:
            inner[i] = rate[i] + conductance[i + 1] * inner[i + 1] * pivot
        pivot = 1.0 / (conductance[i] + inner[i])
        face *= pivot * conductance[i + 1]
        factors[i, 0], factors[i, 1] = rate[i] * pivot, conductance[i + 1] / rate[i]
        factors[i, 3], factors[i, 4] = pivot * conductance[i], face
    far, taken = 0.0, 0.0
    for i in range(n):
        far = factors[i, 4] + factors[i, 3] * far
        factors[i, 2] = rate[i] * far
        taken += factors[i, 2]
    through = conductance[0] * factors[0, 4]
    return factors, np.array([conductance[0] * inner[0] * pivot, through, through, through + taken])
