"""A wall's conduction, factored once: the elimination of its cells and their response to the two faces.

The matrix (C / (gamma dt) + K) is tridiagonal, symmetric and an M-matrix, so the elimination needs no pivoting.
Source: eq. 2 and 9 of [Report1978], solved implicitly; eq. 9 prints no bracket around T[i-1] + T[i+1], which
consistency (eq. 10) demands.
"""

import numpy as np

from sensorsim.thermal.boundary import Cells
from sensorsim.thermal.grid import FloatArray, WallGrid

STIFF = 1.2  # of a cell's own relaxation over a step: half the least mode whose SDIRK factor is negative


def factor(grid: WallGrid, span: float, step: float) -> Cells:
    """Elimination factors of a wall for an implicit stage of `span` [s] within steps of `step` [s]."""
    rate = grid.capacity / span
    conductance = grid.conductance
    n = rate.size
    stiff = step * (conductance[:-1] + conductance[1:]) > STIFF * grid.capacity
    lag = rate / (conductance[:-1] + conductance[1:])
    pivot = np.zeros(n)
    for i in range(n):
        above = conductance[i] ** 2 * pivot[i - 1] if i > 0 else 0.0
        pivot[i] = 1.0 / (rate[i] + conductance[i] + conductance[i + 1] - above)
    influence = np.zeros((2, n))
    if n == 0:
        exchange = np.full((2, 2), conductance[0])
        return Cells(rate, conductance, pivot, influence, exchange, stiff, lag)
    sources = np.zeros((2, n))
    sources[0, 0], sources[1, n - 1] = conductance[0], conductance[n]
    for row in range(2):
        influence[row] = _solve(sources[row], conductance, pivot)
    exchange = np.array(
        [
            [conductance[0] * (1.0 - influence[0, 0]), conductance[0] * influence[1, 0]],
            [conductance[n] * influence[0, n - 1], conductance[n] * (1.0 - influence[1, n - 1])],
        ]
    )
    return Cells(rate, conductance, pivot, influence, exchange, stiff, lag)


def _solve(source: FloatArray, conductance: FloatArray, pivot: FloatArray) -> FloatArray:
    """Solution of the cells' system for one source (n,) [W m-2], by the stored elimination."""
    n = source.size
    solution = np.zeros(n)
    for i in range(n):
        above = conductance[i] * solution[i - 1] if i > 0 else 0.0
        solution[i] = (source[i] + above) * pivot[i]
    for i in range(n - 2, -1, -1):
        solution[i] += conductance[i + 1] * pivot[i] * solution[i + 1]
    return solution
