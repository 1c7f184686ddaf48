"""The modes in which a wall forgets: its linear part with mean films and linearised radiation on both faces."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh_tridiagonal

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.thermal.grid import FloatArray, WallGrid
from sensorsim.thermal.wall_boundary import WallBoundary, WallSurface


@dataclass(frozen=True, slots=True, kw_only=True)
class WallModes:
    """Temperatures of the cells as a sum of patterns that each decay at a rate of their own."""

    rate: FloatArray  # (n,) ascending [s-1]
    pattern: FloatArray  # (n, n) orthonormal columns, of temperature times the root of capacity
    root: FloatArray  # (n,) of capacity [J^0.5 m-1 K-0.5]

    @property
    def time_constant(self) -> float:
        """Time [s] in which the slowest mode falls to 1/e; 0 without capacity, infinite without exchange."""
        if self.rate.size == 0:
            return 0.0
        return 1.0 / float(self.rate[0]) if self.rate[0] > 0.0 else float("inf")

    def limit(self, change: FloatArray, period: float) -> FloatArray:
        """What a change (n,) or (n, m) over one `period` [s] adds up to when the period is repeated for ever."""
        share = -np.expm1(-np.maximum(self.rate, 0.0) * period)
        amplitude = self.pattern.T @ (self.root * change.T).T
        return np.asarray(((self.pattern @ (amplitude.T / np.maximum(share, 1e-9)).T).T / self.root).T)


def wall_modes(grid: WallGrid, boundary: WallBoundary, surface: WallSurface) -> WallModes:
    """Modes of a wall at the mean of its boundary."""
    outer = _film(boundary.exterior_film, boundary.air_temperature, surface.emissivity)
    inner = _film(boundary.interior_film, boundary.interior_air_temperature, surface.interior_emissivity)
    return grid_modes(grid, outer, grid.interior_area * inner)


def grid_modes(grid: WallGrid, outer: float, inner: float) -> WallModes:
    """Modes of a wall under films [W m-2 K-1] for convection and radiation, both per unit of its exterior area."""
    root = np.sqrt(grid.capacity)
    if root.size == 0:
        return WallModes(rate=root, pattern=np.zeros((0, 0)), root=root)
    link = grid.conductance.copy()
    link[0] *= outer / (link[0] + outer)
    link[-1] *= inner / max(link[-1] + inner, 1e-300)  # both are 0 at the centre of a solid
    diagonal = (link[:-1] + link[1:]) / grid.capacity
    rate, pattern = eigh_tridiagonal(diagonal, -link[1:-1] / (root[:-1] * root[1:]))
    if link[0] + link[-1] == 0.0:
        rate[0] = 0.0
    return WallModes(rate=rate, pattern=pattern, root=root)


def _film(film: FloatArray, air: FloatArray, emissivity: float) -> float:
    """Film that stands for convection and radiation [W m-2 K-1]."""
    return float(np.mean(film + 4.0 * emissivity * STEFAN_BOLTZMANN_CONSTANT * air**3))
