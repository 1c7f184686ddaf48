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
    outward, inward, gains = np.zeros((rate.size, 5)), np.zeros((rate.size, 5)), np.zeros((2, 4))
    _eliminate(rate, conductance, outward, gains[0])
    _eliminate(rate[::-1].copy(), conductance[::-1].copy(), inward, gains[1])
    ends = [0, -1]
    exchange = np.array([[*gains[0], conductance[0]], [*gains[1, ::-1], conductance[-1]]])
    around = (conductance[:-1] + conductance[1:])[ends]
    stiff = step * around > STIFF * grid.capacity[ends]
    return Cells(exchange, outward, inward[::-1].copy(), np.where(stiff, 1.0 + rate[ends] / around, 0.0))


@njit(cache=True, nogil=True, error_model="numpy")
def _eliminate(rate: FloatArray, conductance: FloatArray, factors: FloatArray, gains: FloatArray) -> None:
    """Factors (n, 5) of an elimination from the last cell to the first, and what the faces exchange (4,).

    Compiled, as a bake factors hundreds of walls; in bare loops, which are compiled soon.
    """
    n = rate.size
    inner, pivot, face = 0.0, 0.0, 1.0
    for i in range(n - 1, -1, -1):  # sums of positive terms alone: a metal skin's differences would be all rounding
        inner = rate[i] + conductance[i + 1] * (inner * pivot if i < n - 1 else 1.0)
        pivot = 1.0 / (conductance[i] + inner)
        face *= pivot * conductance[i + 1]
        factors[i, 0], factors[i, 1] = rate[i] * pivot, conductance[i + 1] / rate[i]
        factors[i, 3], factors[i, 4] = pivot * conductance[i], face
    far, taken = 0.0, 0.0
    for i in range(n):
        far = factors[i, 4] + factors[i, 3] * far
        factors[i, 2] = rate[i] * far
        taken += factors[i, 2]
    gains[0], gains[1] = conductance[0] * inner * pivot, conductance[0] * factors[0, 4]
    gains[2], gains[3] = gains[1], gains[1] + taken
