"""Which part of what passes between two surfaces third surfaces let through, by rays, compiled."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.thermal.contour_integral import extent
from sensorsim.thermal.polygon_view_factors import Outlines

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]

TRIALS = 400  # points of a bounding box tried per point wanted: enough for an outline that fills 1 % of it
GOLDEN, SILVER = 0.5 * (np.sqrt(5.0) - 1.0), np.sqrt(2.0) - 1.0  # steps of a sequence that fills a square evenly
CLEAR = 1e-9  # share of a ray, at either end, within which nothing stands in its way


@njit(cache=True, nogil=True, error_model="numpy")
def sample_points(outlines: Outlines, count: int) -> FloatArray:
    """Points (n, count, 3) [m] spread evenly over each surface; the mean of its corners where none was met."""
    surfaces = outlines.area.shape[0]
    points = np.zeros((surfaces, count, 3))
    for i in range(surfaces):
        normal = outlines.normal[i]
        k, first, second = _axes(normal)
        edges = outlines.edge[outlines.start[i] : outlines.start[i + 1]]
        left, right, _ = extent(edges, first)
        floor, roof, _ = extent(edges, second)
        found = 0
        for trial in range(TRIALS * count):
            if found == count:
                break
            across, along = (GOLDEN * (trial // 2 + 0.5)) % 1.0, (SILVER * (trial // 2 + 0.5)) % 1.0
            if trial % 2 == 1:  # each point with its mirror image, so that few of them lean to no side
                across, along = 1.0 - across, 1.0 - along
            x, y = left + (right - left) * across, floor + (roof - floor) * along
            if _inside(edges, first, second, x, y):
                rise = (x - outlines.centre[i, first]) * normal[first] + (y - outlines.centre[i, second]) * normal[
                    second
                ]
                points[i, found, first], points[i, found, second] = x, y
                points[i, found, k] = outlines.centre[i, k] - rise / normal[k]
                found += 1
        for rest in range(found, count):
            for axis in range(3):
                points[i, rest, axis] = points[i, rest - found, axis] if found > 0 else outlines.centre[i, axis]
    return points


@njit(cache=True, nogil=True, error_model="numpy")
def visible_shares(
    outlines: Outlines, points: FloatArray, blocking: BoolArray, rows: IntArray, columns: IntArray
) -> FloatArray:
    """Share [-] of the exchange of pairs of surfaces that no third one of those that block stands in, shape (p,).

    Rays join all sample points of one to all of the other, each weighted by the integrand of eq. 5 of [Report1978].
    """
    share = np.ones(rows.shape[0])
    near = np.zeros(outlines.area.shape[0], dtype=np.int64)
    for pair in range(rows.shape[0]):
        i, j = rows[pair], columns[pair]
        count = _between(outlines, blocking, i, j, near)
        if count == 0:
            continue
        total, through = 0.0, 0.0
        for p in range(points.shape[1]):
            for q in range(points.shape[1]):
                weight = _kernel(points[i, p], outlines.normal[i], points[j, q], outlines.normal[j])
                if weight > 0.0:
                    total += weight
                    if not _blocked(outlines, points[i, p], points[j, q], near, count):
                        through += weight
        if total > 0.0:
            share[pair] = through / total
    return share


@njit(cache=True, nogil=True, error_model="numpy")
def _axes(normal: FloatArray) -> tuple[int, int, int]:
    """The axis nearest to the normal and the other two."""
    x, y, z = abs(normal[0]), abs(normal[1]), abs(normal[2])
    if z >= x and z >= y:
        return 2, 0, 1
    return (0, 1, 2) if x >= y else (1, 2, 0)


@njit(cache=True, nogil=True, error_model="numpy")
def _inside(edges: FloatArray, first: int, second: int, x: float, y: float) -> bool:
    """Whether a point lies within an outline, holes excluded, both seen along the third axis."""
    inside = False
    for k in range(edges.shape[0]):
        y0, y1 = edges[k, 0, second], edges[k, 1, second]
        if (y0 > y) != (y1 > y):
            x0, x1 = edges[k, 0, first], edges[k, 1, first]
            inside ^= x < x0 + (x1 - x0) * (y - y0) / (y1 - y0)
    return inside


@njit(cache=True, nogil=True, error_model="numpy")
def _between(outlines: Outlines, blocking: BoolArray, i: int, j: int, near: IntArray) -> int:
    """Fill in the surfaces whose spheres reach the capsule around a pair; return how many there are."""
    count = 0
    reach = max(outlines.radius[i], outlines.radius[j])
    for k in range(outlines.area.shape[0]):
        if blocking[k] and k != i and k != j:
            gap = _gap(outlines.centre[i], outlines.centre[j], outlines.centre[k])
            if gap < reach + outlines.radius[k]:
                near[count] = k
                count += 1
    return count


@njit(cache=True, nogil=True, error_model="numpy")
def _gap(start: FloatArray, end: FloatArray, point: FloatArray) -> float:
    """Distance of a point from a line between two others."""
    along, square = 0.0, 0.0
    for axis in range(3):
        along += (end[axis] - start[axis]) * (point[axis] - start[axis])
        square += (end[axis] - start[axis]) ** 2
    share = min(max(along / square, 0.0), 1.0) if square > 0.0 else 0.0
    gap = 0.0
    for axis in range(3):
        gap += (point[axis] - start[axis] - share * (end[axis] - start[axis])) ** 2
    return float(np.sqrt(gap))


@njit(cache=True, nogil=True, error_model="numpy")
def _kernel(start: FloatArray, normal: FloatArray, end: FloatArray, other: FloatArray) -> float:
    """cos cos / r2, up to a factor, of two elements that face each other; zero of others."""
    leaves, meets, square = 0.0, 0.0, 0.0
    for axis in range(3):
        step = end[axis] - start[axis]
        leaves += step * normal[axis]
        meets -= step * other[axis]
        square += step * step
    return leaves * meets / (square * square) if leaves > 0.0 and meets > 0.0 else 0.0


@njit(cache=True, nogil=True, error_model="numpy")
def _blocked(outlines: Outlines, start: FloatArray, end: FloatArray, near: IntArray, count: int) -> bool:
    """Whether any of the surfaces listed crosses the way between two points."""
    for listed in range(count):
        k = near[listed]
        if _gap(start, end, outlines.centre[k]) >= outlines.radius[k]:
            continue
        low, high = 0.0, 0.0
        for axis in range(3):
            low += (start[axis] - outlines.centre[k, axis]) * outlines.normal[k, axis]
            high += (end[axis] - outlines.centre[k, axis]) * outlines.normal[k, axis]
        if low * high >= 0.0:
            continue
        share = low / (low - high)
        if share < CLEAR or share > 1.0 - CLEAR:
            continue
        _, first, second = _axes(outlines.normal[k])
        x = start[first] + share * (end[first] - start[first])
        y = start[second] + share * (end[second] - start[second])
        if _inside(outlines.edge[outlines.start[k] : outlines.start[k + 1]], first, second, x, y):
            return True
    return False
