"""View factors between plane polygons in space, eq. 5 of [Report1978], to about 1e-13 by contour integrals.

Polygons may be convex or concave and may share corners and edges; what of either lies behind the other's plane takes
no part. Nothing stands between them: occlusion by third surfaces is left to `exchange`.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.thermal.contour_integral import mutual_area

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

FLATNESS = 1e-6  # greatest distance of a corner from the polygon's plane, in units of its extent


class Outlines(NamedTuple):
    """Plane surfaces as directed edges, counter-clockwise as seen from the front; holes run clockwise."""

    edge: FloatArray  # from, to [m], shape (e, 2, 3)
    start: IntArray  # first edge of each surface, and e, shape (n + 1,)
    normal: FloatArray  # unit, towards the front, shape (n, 3)
    area: FloatArray  # [m2], shape (n,)
    centre: FloatArray  # mean of the corners: a point in the plane [m], shape (n, 3)
    radius: FloatArray  # greatest distance of a corner from it [m], shape (n,)


def polygon_view_factor(first: FloatArray, second: FloatArray) -> float:
    """View factor F12 [-] from a polygon (n, 3) to a polygon (m, 3) [m], counter-clockwise as seen from their fronts.

    Raises InputError for corners that are not finite, fewer than three, in one line, or not in one plane.
    """
    return float(view_factor_matrix((first, second))[0, 1])


def view_factor_matrix(polygons: Sequence[FloatArray]) -> FloatArray:
    """View factors F[i, j] [-] from each of n polygons (k, 3) [m] to each other, zero on the diagonal, shape (n, n).

    Errors as of `polygon_view_factor`.
    """
    outlines = outlines_of_polygons(polygons)
    count = len(polygons)
    rows, columns = np.triu_indices(count, 1)
    mutual = np.zeros((count, count))
    mutual[rows, columns] = mutual_areas(outlines, rows, columns)
    return np.asarray((mutual + mutual.T) / outlines.area[:, None])


def outlines_of_polygons(polygons: Sequence[FloatArray]) -> Outlines:
    """Outlines of polygons (k, 3) [m], counter-clockwise as seen from their fronts."""
    loops = [np.asarray(polygon, dtype=np.float64) for polygon in polygons]
    for row, loop in enumerate(loops):
        if loop.ndim != 2 or loop.shape[1] != 3 or len(loop) < 3:
            remedy = "give at least three corners of three coordinates"
            raise InputError("polygons", f"polygon {row}", loop.shape, "not an outline in space", remedy)
    edges = [np.stack((loop, np.roll(loop, -1, axis=0)), axis=1) for loop in loops]
    return _outlines(np.concatenate(edges), np.cumsum([0, *map(len, loops)]))


def outlines_of_mesh(position: FloatArray, triangle: NDArray[np.int32], surface: NDArray[np.int32]) -> Outlines:
    """Outlines, holes included, of surfaces cut into triangles (t, 3) of corners (v, 3); surface (v,) numbers them.

    The edges of a surface that only one of its triangles has are its outline; rows of `surface` start at 0.
    """
    pairs = np.concatenate((triangle[:, :2], triangle[:, 1:], triangle[:, ::-2])).astype(np.int64)
    count = len(position)
    inner = np.isin(pairs[:, 0] * count + pairs[:, 1], pairs[:, 1] * count + pairs[:, 0])
    pairs = pairs[~inner]
    pairs = pairs[np.argsort(surface[pairs[:, 0]], kind="stable")]
    sizes = np.bincount(surface[pairs[:, 0]], minlength=int(surface.max()) + 1)
    return _outlines(np.asarray(position, dtype=np.float64)[pairs], np.cumsum([0, *sizes]))


def mutual_areas(outlines: Outlines, rows: IntArray, columns: IntArray) -> FloatArray:
    """A_i F_ij [m2] of pairs of surfaces, shape (p,): never below zero but by rounding, which is taken off."""
    first, second = (np.ascontiguousarray(index, dtype=np.int64) for index in (rows, columns))
    return np.asarray(_mutual_areas(outlines, first, second))


def _outlines(edge: FloatArray, start: IntArray) -> Outlines:
    """Outlines of given edges, after they are known to be finite, flat and of some area."""
    owner = np.repeat(np.arange(len(start) - 1), np.diff(start))
    if not np.all(np.isfinite(edge)):
        row = int(owner[~np.isfinite(edge).all(axis=(1, 2))][0])
        raise InputError("polygons", f"polygon {row}", "a coordinate", "not a finite number", "give metres")
    centre = np.add.reduceat(edge[:, 0], start[:-1]) / np.diff(start)[:, None]
    about = edge - centre[owner][:, None]
    radius = np.maximum.reduceat(np.linalg.norm(about[:, 0], axis=-1), start[:-1])
    vector = 0.5 * np.add.reduceat(np.cross(about[:, 0], about[:, 1]), start[:-1])
    area = np.linalg.norm(vector, axis=-1)
    if np.any(thin := ~(area > 1e-12 * radius**2)):
        row = int(np.argmax(thin))
        raise InputError("polygons", f"polygon {row}", float(area[row]), "no area [m2]", "give corners not in one line")
    normal = vector / area[:, None]
    height = np.abs(np.sum(about[:, 0] * normal[owner], axis=-1))
    if np.any(bent := height > FLATNESS * radius[owner]):
        row = int(owner[np.argmax(bent)])
        remedy = "cut it into plane ones"
        raise InputError("polygons", f"polygon {row}", float(height.max()), "corners off their plane [m]", remedy)
    return Outlines(edge, start.astype(np.int64), normal, area, centre, radius)


@njit(cache=True, nogil=True, error_model="numpy")
def _mutual_areas(outlines: Outlines, rows: IntArray, columns: IntArray) -> FloatArray:
    found = np.zeros(rows.shape[0])
    for k in range(rows.shape[0]):
        i, j = rows[k], columns[k]
        one = outlines.edge[outlines.start[i] : outlines.start[i + 1]]
        two = outlines.edge[outlines.start[j] : outlines.start[j + 1]]
        first, second = (outlines.normal[i], outlines.centre[i]), (outlines.normal[j], outlines.centre[j])
        found[k] = max(mutual_area(one, first, two, second), 0.0)
    return found
