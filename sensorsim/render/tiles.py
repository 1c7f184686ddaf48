"""Triangles in tiles of the ground, so that a frame draws the tiles it sees, the nearest first.

Small scenes are one tile, in which high features come first, since they hide the others. A triangle wider than a tile,
such as ground, belongs to none and is drawn last.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.render.camera import Camera
from sensorsim.scene import Mesh

PER_TILE = 4000  # triangles; fewer save little, since each tile is a call
IntArray = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Tiles:
    """Runs of triangles with the boxes around them."""

    triangle: NDArray[np.int32]  # (t, 3) run after run
    edge: IntArray  # (n + 1,) where runs begin and the last one ends
    lowest: NDArray[np.float64]  # (n, 3) [m]
    highest: NDArray[np.float64]  # (n, 3) [m]
    is_wide: NDArray[np.bool_]  # (n,)


def build_tiles(mesh: Mesh, height: NDArray[np.float64]) -> Tiles:
    """Tiles of a mesh; `height` (t,) decides the order of triangles within one, the highest first."""
    corner = mesh.position[mesh.triangle]
    low, high = corner.min(axis=1), corner.max(axis=1)
    extent = mesh.position.max(axis=0)[:2] - mesh.position.min(axis=0)[:2]
    side = max(float(np.sqrt(extent[0] * extent[1] * PER_TILE / len(mesh.triangle))), 1.0)
    one = len(mesh.triangle) <= PER_TILE
    place = np.floor((0.5 * (low + high)[:, :2] - mesh.position.min(axis=0)[:2]) / side).astype(np.int64)
    across = math.ceil(extent[0] / side) + 1
    tile = np.zeros(len(low), np.int64) if one else place[:, 1] * across + place[:, 0]
    wide = np.zeros(len(low), np.bool_) if one else np.any((high - low)[:, :2] > side, axis=1)
    tile[wide] = -1
    order = np.lexsort((-height, tile, wide))
    first = np.flatnonzero(np.diff(tile[order], prepend=-2))
    return Tiles(
        triangle=np.ascontiguousarray(mesh.triangle[order]),
        edge=np.append(first, len(order)),
        lowest=np.minimum.reduceat(low[order], first, axis=0),
        highest=np.maximum.reduceat(high[order], first, axis=0),
        is_wide=wide[order][first],
    )


def visible_tiles(tiles: Tiles, camera: Camera, size: tuple[int, int]) -> IntArray:
    """Tiles that may be in the picture, in the order of drawing: the nearest first, wide ones last."""
    pick = np.array([[(code >> axis) & 1 for axis in range(3)] for code in range(8)], dtype=np.bool_)
    corner = np.where(pick, tiles.highest[:, None], tiles.lowest[:, None]) - camera.position
    forward, right, up = (corner @ axis for axis in camera.axes())
    width, height = camera.half_extent(size)
    beyond = [forward < 0.0]
    beyond += [sign * side > half * forward for side, half in ((right, width), (up, height)) for sign in (-1.0, 1.0)]
    seen = ~np.any([np.all(outside, axis=1) for outside in beyond], axis=0)
    away = np.maximum(np.maximum(tiles.lowest - camera.position, camera.position - tiles.highest), 0.0)
    order = np.lexsort((np.linalg.norm(away, axis=1), tiles.is_wide))
    return np.asarray(order[seen[order]])
