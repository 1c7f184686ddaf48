"""Pairs of surfaces that can see much of each other, and how much of it stands above the horizon, compiled."""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.thermal.contour_integral import clip, extent, mutual_area
from sensorsim.thermal.polygon_view_factors import Outlines

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
BoolArray = NDArray[np.bool_]

Span = tuple[float, float]

SLICES = 4  # levels that a pair's common range of heights is cut into
LEVEL = 1e-9  # height in units of an extent below which a point is in a plane, or an edge level


@njit(cache=True, nogil=True, error_model="numpy")
def candidate_pairs(outlines: Outlines, acting: BoolArray, threshold: float) -> tuple[IntArray, IntArray]:
    """Pairs i < j, shapes (p,), of which one acts on the other by a view factor that may reach the threshold.

    No pair that reaches it is lost: F_ij is at most A_j / A_i, and at most A_j / (pi d2) for outlines at least d apart.
    """
    count = outlines.area.shape[0]
    firsts, seconds = [0], [0]  # a first entry, taken off again, tells the compiler the type
    for i in range(count):
        for j in range(i + 1, count):
            square = 0.0
            for axis in range(3):
                square += (outlines.centre[i, axis] - outlines.centre[j, axis]) ** 2
            apart = max(np.sqrt(square) - outlines.radius[i] - outlines.radius[j], 0.0)
            wide = np.pi * apart * apart * threshold
            large, small = outlines.area[i], outlines.area[j]
            to_first = acting[i] and large >= max(wide, threshold * small)
            to_second = acting[j] and small >= max(wide, threshold * large)
            if (to_first or to_second) and not (_behind(outlines, i, j) or _behind(outlines, j, i)):
                firsts.append(i)
                seconds.append(j)
    return np.array(firsts)[1:], np.array(seconds)[1:]


@njit(cache=True, nogil=True, error_model="numpy")
def areas_above(outlines: Outlines, rows: IntArray, columns: IntArray, whole: FloatArray) -> FloatArray:
    """The part of A_i F_ij [m2], `whole`, by which surface j stands higher than what sees it of surface i, shape (p,).

    Where heights overlap, both are cut into level slices; of a slice that faces one of the same level half counts as
    higher, which is exact for upright walls with level edges and for others an error of second order in the slice.
    """
    above = np.zeros(rows.shape[0])
    for pair in range(rows.shape[0]):
        i, j = rows[pair], columns[pair]
        bottom, top = _heights(outlines, i)
        low, high = _heights(outlines, j)
        tolerance = LEVEL * (outlines.radius[i] + outlines.radius[j])
        if top <= low + tolerance:
            above[pair] = whole[pair]
        elif bottom >= high - tolerance:
            above[pair] = 0.0
        elif top - bottom <= tolerance:
            above[pair] = _slab_area(outlines, i, (-np.inf, np.inf), j, (top, np.inf))
        elif high - low <= tolerance:
            above[pair] = _slab_area(outlines, i, (-np.inf, low), j, (-np.inf, np.inf))
        else:
            count = 1 if _is_upright(outlines, i) and _is_upright(outlines, j) else SLICES
            above[pair] = _sliced_area(outlines, i, j, max(bottom, low), min(top, high), count)
    return above


@njit(cache=True, nogil=True, error_model="numpy")
def _sliced_area(outlines: Outlines, i: int, j: int, low: float, high: float, count: int) -> float:
    total = _slab_area(outlines, i, (-np.inf, low), j, (low, np.inf))
    for k in range(count):
        floor = low + (high - low) * k / count
        roof = low + (high - low) * (k + 1) / count
        total += _slab_area(outlines, i, (floor, roof), j, (roof, np.inf))
        total += 0.5 * _slab_area(outlines, i, (floor, roof), j, (floor, roof))
    return total


@njit(cache=True, nogil=True, error_model="numpy")
def _slab_area(outlines: Outlines, i: int, of_first: Span, j: int, of_second: Span) -> float:
    """A_i F_ij [m2] between the parts of two surfaces within ranges of height."""
    one, two = _slab(outlines, i, of_first), _slab(outlines, j, of_second)
    first, second = (outlines.normal[i], outlines.centre[i]), (outlines.normal[j], outlines.centre[j])
    return float(max(mutual_area(one, first, two, second), 0.0))


@njit(cache=True, nogil=True, error_model="numpy")
def _slab(outlines: Outlines, i: int, span: Span) -> FloatArray:
    """Edges of the part of a surface within a range of height."""
    edges = outlines.edge[outlines.start[i] : outlines.start[i + 1]]
    for side in range(2):
        if np.isfinite(span[side]):
            origin, normal = np.zeros(3), np.zeros(3)
            origin[2], normal[2] = span[side], 1.0 - 2.0 * side
            edges = clip(edges, normal, origin, outlines.radius[i])
    return edges


@njit(cache=True, nogil=True, error_model="numpy")
def _is_upright(outlines: Outlines, i: int) -> bool:
    """Whether a surface is an upright wall of level and plumb edges: the same at all heights, if it is convex."""
    edges = outlines.edge[outlines.start[i] : outlines.start[i + 1]]
    for k in range(edges.shape[0]):
        rise = abs(edges[k, 1, 2] - edges[k, 0, 2])
        run = abs(edges[k, 1, 0] - edges[k, 0, 0]) + abs(edges[k, 1, 1] - edges[k, 0, 1])
        if min(rise, run) > LEVEL * outlines.radius[i]:
            return False
    return bool(edges.shape[0] == 4 and abs(outlines.normal[i, 2]) < LEVEL)


@njit(cache=True, nogil=True, error_model="numpy")
def _behind(outlines: Outlines, i: int, j: int) -> bool:
    """Whether all of surface j lies behind the plane of surface i, or in it."""
    for k in range(outlines.start[j], outlines.start[j + 1]):
        rise = 0.0
        for axis in range(3):
            rise += (outlines.edge[k, 0, axis] - outlines.centre[i, axis]) * outlines.normal[i, axis]
        if rise > LEVEL * (outlines.radius[i] + outlines.radius[j]):
            return False
    return True


@njit(cache=True, nogil=True, error_model="numpy")
def _heights(outlines: Outlines, i: int) -> tuple[float, float]:
    low, high, _ = extent(outlines.edge[outlines.start[i] : outlines.start[i + 1]], 2)
    return low, high
