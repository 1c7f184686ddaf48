"""A wall's conduction, factored once: the elimination of its cells and their response to the two faces.

The matrix (C / (gamma dt) + K) is tridiagonal, symmetric and an M-matrix, so the elimination needs no pivoting.
Source: eq. 2 and 9 of [Report1978], solved implicitly; eq. 9 prints no bracket around T[i-1] + T[i+1], which
consistency (eq. 10) demands.
"""

import numpy as np

from sensorsim.thermal.boundary import Cells
from sensorsim.thermal.grid import WallGrid

STIFF = 1.0 + np.sqrt(2.0)  # of a cell's own relaxation over a step, from where the two stages may overshoot


def factor(grid: WallGrid, span: float, step: float) -> Cells:
    """Elimination factors of a wall for an implicit stage of `span` [s] within steps of `step` [s]."""
    rate, conductance = grid.capacity / span, grid.conductance
    n = rate.size
    if n == 0:
        return Cells(np.array([1.0, 1.0, 1.0, 1.0, 0.0]) * conductance[0], np.zeros((0, 6)))
    around, inner, pivot = conductance[:-1] + conductance[1:], rate + conductance[n], np.zeros(n)
    for i in range(n - 1, -1, -1):  # sums of positive terms alone: a metal skin's differences would be all rounding
        if i < n - 1:
            inner[i] = rate[i] + conductance[i + 1] * inner[i + 1] * pivot[i + 1]
        pivot[i] = 1.0 / (conductance[i] + inner[i])
    outward, inward = pivot * conductance[:-1], pivot * conductance[1:]
    face = np.cumprod(inward[::-1])[::-1]
    interior = face.copy()
    for i in range(1, n):
        interior[i] += outward[i] * interior[i - 1]
    through = conductance[0] * interior[0]
    gains = np.array([conductance[0] * inner[0] * pivot[0], through, through, through + rate @ interior])
    stiff, at_face = step * around > STIFF * grid.capacity, np.isin(np.arange(n), [0, n - 1])
    reach = np.where(stiff & at_face, 1.0 + rate / around, 0.0)
    return Cells(
        np.append(gains, conductance[0]),
        np.stack([rate * pivot, inward, rate * interior, outward, face, reach], axis=1),
    )
