"""A wall's conduction, factored once: the elimination of its cells, either way, and their response to the two faces.

The matrix (C / (gamma dt) + K) is tridiagonal, symmetric and an M-matrix, so the elimination needs no pivoting.
Source: eq. 2 and 9 of [Report1978], solved implicitly; eq. 9 prints no bracket around T[i-1] + T[i+1], which
consistency (eq. 10) demands.
"""

import numpy as np

from sensorsim.thermal.boundary import Cells, FloatArray
from sensorsim.thermal.grid import WallGrid

STIFF = 1.0 + np.sqrt(2.0)  # of a cell's own relaxation over a step, from where the two stages may overshoot


def factor(grid: WallGrid, span: float, step: float) -> Cells:
    """Elimination factors of a wall for an implicit stage of `span` [s] within steps of `step` [s]."""
    rate, conductance = grid.capacity / span, grid.conductance
    if rate.size == 0:
        idle = np.array([1.0, 1.0, 1.0, 1.0, 0.0]) * conductance[0]
        return Cells(np.stack([idle, idle]), np.zeros((0, 5)), np.zeros((0, 5)), np.zeros(2))
    outward, gains = _eliminate(rate, conductance)
    inward, mirrored = _eliminate(rate[::-1], conductance[::-1])
    exchange = np.stack([np.append(gains, conductance[0]), np.append(mirrored[::-1], conductance[-1])])
    ends = np.array([0, -1])
    around = (conductance[:-1] + conductance[1:])[ends]
    stiff = step * around > STIFF * grid.capacity[ends]
    return Cells(exchange, outward, inward[::-1].copy(), np.where(stiff, 1.0 + rate[ends] / around, 0.0))


def _eliminate(rate: FloatArray, conductance: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Factors (n, 5) of an elimination from the last cell to the first, and what the faces exchange (4,)."""
    n = rate.size
    inner, pivot = rate + conductance[n], np.zeros(n)
    for i in range(n - 1, -1, -1):  # sums of positive terms alone: a metal skin's differences would be all rounding
        if i < n - 1:
            inner[i] = rate[i] + conductance[i + 1] * inner[i + 1] * pivot[i + 1]
        pivot[i] = 1.0 / (conductance[i] + inner[i])
    before, after = pivot * conductance[:-1], pivot * conductance[1:]
    face = np.cumprod(after[::-1])[::-1]
    far = face.copy()
    for i in range(1, n):
        far[i] += before[i] * far[i - 1]
    through = conductance[0] * far[0]
    gains = np.array([conductance[0] * inner[0] * pivot[0], through, through, through + rate @ far])
    return np.stack([rate * pivot, conductance[1:] / rate, rate * far, before, face], axis=1), gains
