"""How near the nearest surface is: what the near clip plane, and so the depth buffer's resolution far away, goes by.

Boxes of surfaces in blocks, so that of a large scene only the blocks near by are searched.
"""

import numpy as np
from numpy.typing import NDArray

from sensorsim.render.detail import box_distance
from sensorsim.scene import Mesh

IN_BLOCK = 256  # surfaces, which lie near each other in the order of the scene
FloatArray = NDArray[np.float64]


class Nearest:
    """The surfaces of a mesh, to be asked how far they are at least."""

    def __init__(self, mesh: Mesh) -> None:
        count = int(mesh.surface.max()) + 1
        self._lowest, self._highest = np.full((count, 3), np.inf), np.full((count, 3), -np.inf)
        np.minimum.at(self._lowest, mesh.surface, mesh.position)
        np.maximum.at(self._highest, mesh.surface, mesh.position)
        self._first = np.arange(0, count, IN_BLOCK)
        self._block = np.minimum.reduceat(self._lowest, self._first), np.maximum.reduceat(self._highest, self._first)

    def distance(self, place: FloatArray) -> float:
        """Distance [m] from a place (3,) that no surface is nearer than; 0 where one may be there."""
        away = box_distance(place, *self._block)
        best = self._within(place, self._first[[np.argmin(away)]])
        return min(best, self._within(place, self._first[away < best]))

    def _within(self, place: FloatArray, first: NDArray[np.int64]) -> float:
        """The same to the surfaces of blocks that begin at these rows; infinite where there are none."""
        rows = (first[:, None] + np.arange(IN_BLOCK)).ravel()
        rows = rows[rows < len(self._lowest)]
        found = box_distance(place, self._lowest[rows], self._highest[rows])
        return float(found.min(initial=np.inf))
