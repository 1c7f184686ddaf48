"""How a wall of a bake begins where its history is too short: as its first day leaves it when that is repeated.

What one repetition changes is carried to its limit mode by mode, as in `wall_start`, for all columns at once.
"""

from collections.abc import Sequence

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY, STEFAN_BOLTZMANN_CONSTANT
from sensorsim.thermal.boundary import Inside, Outside
from sensorsim.thermal.grid import FloatArray, LayerLike, WallGrid
from sensorsim.thermal.march import march
from sensorsim.thermal.wall_modes import grid_modes

REPETITIONS = 3  # each makes what is left some twenty times smaller


def settled_cells(
    layers: Sequence[LayerLike], grid: WallGrid, outside: Outside, inside: Inside, absorptances: FloatArray, step: float
) -> FloatArray:
    """Cell temperatures (n, o, a) [K] at the first sample."""
    outer = mean_film(outside.film, outside.emissivity, outside.air)
    inner = grid.interior_area * mean_film(inside.film, inside.emissivity, inside.radiant)
    modes, record = grid_modes(grid, outer, inner), np.array([0, round(SECONDS_PER_DAY / step)])
    cells = None
    for _ in range(REPETITIONS):
        history = march(
            layers, outside, inside, absorptances, step=step, record=record, keep_nodes=True, grid=grid, start=cells
        )
        nodes = np.asarray(history.nodes)
        drift = (nodes[1] - nodes[0]).reshape(grid.capacity.size, -1)
        cells = nodes[0] + modes.limit(drift, SECONDS_PER_DAY).reshape(nodes.shape[1:])
    return np.asarray(cells)


def mean_film(film: FloatArray, emissivity: float, temperature: FloatArray) -> float:
    """Film [W m-2 K-1] that stands for convection and radiation near temperatures (t,) [K]."""
    return float(np.mean(film) + 4.0 * emissivity * STEFAN_BOLTZMANN_CONSTANT * np.mean(temperature) ** 3)
