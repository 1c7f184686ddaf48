"""Eq. 5 of [Report1978] as a double contour integral, compiled.

Stokes' theorem turns the integral over two areas into one over their outlines [Sparrow1963]:
A1 F12 = (1 / 2 pi) sum over pairs of edges of (u . v) times the integral of ln r over both. A surface is a set of
directed edges (k, 2, 3), counter-clockwise as seen from its front, in any order: concave outlines and holes are
nothing special, and a cut through the set is closed by edges along the cut. The inner integral over a straight edge
has a closed form [Mitalas1966]; so has the whole pair where edges are parallel. Otherwise the outer integrand is
analytic but for three pairs of points of the complex plane: two where the edge meets a distance of zero to an end of
the other, one where the two lines are closest [Schroder1993]. Gauss-Legendre rules on intervals no longer than their
distance to all three keep full precision at shared corners, shared edges and crossings alike.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
Vector = tuple[float, float, float]
Plane = tuple[FloatArray, FloatArray]  # unit normal, a point

FINEST = 2.0**-27  # share of an edge below which an interval is not halved again: what is left is of order its square
PARALLEL = 1e-13  # sine of the angle below which two edges count as parallel
LOPSIDED = 4.0  # ratio of lengths up to which the closed form of a parallel pair is used: it loses its square in digits
FAR = 3.0  # gap in units of the longer edge from which a product of two short rules is exact to rounding
ON_PLANE = 1e-10  # height in units of the pair's distance below which a corner lies in the other's plane
NODE, WEIGHT = np.polynomial.legendre.leggauss(12)
FAR_NODE, FAR_WEIGHT = np.polynomial.legendre.leggauss(6)


@njit(cache=True, nogil=True, error_model="numpy")
def mutual_area(first: FloatArray, first_plane: Plane, second: FloatArray, second_plane: Plane) -> float:
    """A1 F12 = A2 F21 [m2] of edge sets (k, 2, 3), each with a unit normal and a point of its plane.

    Each is cut at the plane of the other first; what lies behind it or in it exchanges nothing.
    """
    if first.shape[0] == 0 or second.shape[0] == 0:
        return 0.0
    scale = _distance(first, second)
    one = clip(first, second_plane[0], second_plane[1], scale)
    two = clip(second, first_plane[0], first_plane[1], scale)
    total = 0.0
    for i in range(one.shape[0]):
        for j in range(two.shape[0]):
            total += _edge_pair(one[i], two[j], scale)
    return total / (2.0 * np.pi)


@njit(cache=True, nogil=True, error_model="numpy")
def clip(edges: FloatArray, normal: FloatArray, origin: FloatArray, scale: float) -> FloatArray:
    """The part of an edge set (k, 2, 3) in front of a plane, closed along the cut; scale [m] sets what is in it."""
    kept = np.zeros((3 * edges.shape[0], 2, 3))
    count = 0
    anchor = -1
    for k in range(edges.shape[0]):
        low = _above(edges[k, 0], normal, origin, scale)
        high = _above(edges[k, 1], normal, origin, scale)
        if low <= 0.0 and high <= 0.0:
            continue
        piece = count
        count += 1
        _cut(edges[k], low, high, kept[piece])
        for end in range(2):
            if (low, high)[end] <= 0.0:  # an end in the plane: join it to the first one found, whichever way it runs
                if anchor < 0:
                    anchor = 2 * piece + end
                for axis in range(3):
                    kept[count, 1 - end, axis] = kept[piece, end, axis]
                    kept[count, end, axis] = kept[anchor // 2, anchor % 2, axis]
                count += 1
    return kept[:count]


@njit(cache=True, nogil=True, error_model="numpy")
def _above(point: FloatArray, normal: FloatArray, origin: FloatArray, scale: float) -> float:
    rise = 0.0
    for axis in range(3):
        rise += (point[axis] - origin[axis]) * normal[axis]
    return rise if abs(rise) > ON_PLANE * scale else 0.0


@njit(cache=True, nogil=True, error_model="numpy")
def _cut(edge: FloatArray, low: float, high: float, kept: FloatArray) -> None:
    """Copy the part of an edge that has a positive height, given those of its ends."""
    start = low / (low - high) if low < 0.0 else 0.0
    end = low / (low - high) if high < 0.0 else 1.0
    for axis in range(3):
        here, after = edge[0, axis], edge[1, axis]
        kept[0, axis] = here + (after - here) * start if start > 0.0 else here
        kept[1, axis] = here + (after - here) * end if end < 1.0 else after


@njit(cache=True, nogil=True, error_model="numpy")
def _distance(first: FloatArray, second: FloatArray) -> float:
    """A length of the order of the distances between two outlines: logarithms of its multiples are small."""
    gap, size = 0.0, 0.0
    for axis in range(3):
        low, high, middle = extent(first, axis)
        floor, roof, centre = extent(second, axis)
        gap += (middle - centre) ** 2
        size = max(size, high - low, roof - floor)
    return float(max(np.sqrt(gap), 0.5 * size))


@njit(cache=True, nogil=True, error_model="numpy")
def extent(edges: FloatArray, axis: int) -> tuple[float, float, float]:
    """Least, greatest and mean coordinate of the corners along an axis."""
    low = high = edges[0, 0, axis]
    total = 0.0
    for k in range(edges.shape[0]):
        here = edges[k, 0, axis]
        low, high, total = min(low, here), max(high, here), total + here
    return low, high, total / edges.shape[0]


@njit(cache=True, nogil=True, error_model="numpy")
def _edge_pair(one: FloatArray, two: FloatArray, scale: float) -> float:
    """Integral of ln(r / scale) over two edges (2, 3), times the cosine between them [m2]."""
    u, length = _unit(_between(one[0], one[1], scale))
    v, other = _unit(_between(two[0], two[1], scale))
    if length > other:  # the rule runs along the shorter edge, the closed form along the longer: fewest digits lost
        one, two, u, v, length, other = two, one, v, u, other, length
    cosine = _dot(u, v)
    if length == 0.0 or abs(cosine) < 1e-16:
        return 0.0
    w = _between(one[0], two[0], scale)
    middle = _along(_along(w, -0.5 * length, u), 0.5 * other, v)
    if _unit(middle)[1] - 0.5 * (length + other) > FAR * other:
        integral = _far_pair(middle, u, length, v, other)
    elif _unit(_cross(u, v))[1] < PARALLEL and other < LOPSIDED * length:
        integral = _parallel_pair(w, u, length, other, cosine)
    else:
        integral = _near_pair(w, u, v, length, other)
    return cosine * integral * scale * scale


@njit(cache=True, nogil=True, error_model="numpy")
def _far_pair(middle: Vector, u: Vector, length: float, v: Vector, other: float) -> float:
    """Integral of ln r over two edges whose middles lie `middle` apart."""
    total = 0.0
    for i in range(FAR_NODE.shape[0]):
        point = _along(middle, -0.5 * length * FAR_NODE[i], u)
        for j in range(FAR_NODE.shape[0]):
            ray = _along(point, 0.5 * other * FAR_NODE[j], v)
            total += FAR_WEIGHT[i] * FAR_WEIGHT[j] * np.log(_dot(ray, ray))
    return 0.125 * length * other * total


@njit(cache=True, nogil=True, error_model="numpy")
def _parallel_pair(w: Vector, u: Vector, length: float, other: float, cosine: float) -> float:
    """Integral of ln r over two parallel edges, of which the second starts w from the first's start."""
    start = _dot(w, u)
    apart = _unit(_along(w, -start, u))[1]
    low, high = (start, start + other) if cosine > 0.0 else (start - other, start)
    return float(
        _second_integral(high, apart)
        - _second_integral(low, apart)
        - _second_integral(high - length, apart)
        + _second_integral(low - length, apart)
    )


@njit(cache=True, nogil=True, error_model="numpy")
def _near_pair(w: Vector, u: Vector, v: Vector, length: float, other: float) -> float:
    """Integral of ln r over two edges: closed over the second, graded Gauss-Legendre over the first."""
    end = _along(w, other, v)
    pole = np.zeros((3, 2))  # along the edge, and distance from it, of what limits the rule
    pole[0, 0], pole[0, 1] = _dot(w, u), _unit(_cross(w, u))[1]
    pole[1, 0], pole[1, 1] = _dot(end, u), _unit(_cross(end, u))[1]
    normal, sine = _unit(_cross(u, v))
    pole[2, 0], pole[2, 1] = 0.0, np.inf
    if sine > PARALLEL:
        pole[2, 0], pole[2, 1] = _dot(_cross(w, v), normal) / sine, abs(_dot(w, normal)) / sine
    stack = np.zeros((64, 2))
    stack[0, 1] = length
    depth, total = 1, 0.0
    while depth > 0:
        depth -= 1
        low, high = stack[depth, 0], stack[depth, 1]
        if high - low > FINEST * length and _too_long(low, high, pole):
            stack[depth, 1] = stack[depth + 1, 0] = 0.5 * (low + high)
            stack[depth + 1, 1] = high
            depth += 2
            continue
        for k in range(NODE.shape[0]):
            s = 0.5 * (low + high + (high - low) * NODE[k])
            total += 0.5 * (high - low) * WEIGHT[k] * _edge_from_point(_along(w, -s, u), v, other)
    return total


@njit(cache=True, nogil=True, error_model="numpy")
def _too_long(low: float, high: float, pole: FloatArray) -> bool:
    for k in range(pole.shape[0]):
        beside = max(low - pole[k, 0], pole[k, 0] - high, 0.0)
        if beside * beside + pole[k, 1] * pole[k, 1] < (high - low) ** 2:
            return True
    return False


@njit(cache=True, nogil=True, error_model="numpy")
def _edge_from_point(start: Vector, v: Vector, length: float) -> float:
    """Integral of ln r from the origin along an edge of that start, direction and length."""
    along = _dot(start, v)
    apart = _unit(_cross(start, v))[1]
    return float(_first_integral(along + length, apart) - _first_integral(along, apart))


@njit(cache=True, nogil=True, error_model="numpy")
def _first_integral(x: float, apart: float) -> float:
    """Integral over x of ln sqrt(x2 + apart2)."""
    square = x * x + apart * apart
    return float(x * (0.5 * np.log(square) - 1.0) + apart * np.arctan2(x, apart)) if square > 0.0 else 0.0


@njit(cache=True, nogil=True, error_model="numpy")
def _second_integral(x: float, apart: float) -> float:
    """Integral over x of `_first_integral`."""
    square = x * x + apart * apart
    if square == 0.0:
        return 0.0
    logarithm = 0.25 * (x * x - apart * apart) * np.log(square)
    return float(logarithm + x * apart * np.arctan2(x, apart) - 0.75 * x * x)


@njit(cache=True, nogil=True, error_model="numpy")
def _between(start: FloatArray, end: FloatArray, scale: float) -> Vector:
    return (end[0] - start[0]) / scale, (end[1] - start[1]) / scale, (end[2] - start[2]) / scale


@njit(cache=True, nogil=True, error_model="numpy")
def _along(start: Vector, distance: float, direction: Vector) -> Vector:
    return (
        start[0] + distance * direction[0],
        start[1] + distance * direction[1],
        start[2] + distance * direction[2],
    )


@njit(cache=True, nogil=True, error_model="numpy")
def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@njit(cache=True, nogil=True, error_model="numpy")
def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@njit(cache=True, nogil=True, error_model="numpy")
def _unit(a: Vector) -> tuple[Vector, float]:
    """Direction and length of a vector; a vector of no length is its own direction."""
    length = float(np.sqrt(_dot(a, a)))
    return (a[0] / length, a[1] / length, a[2] / length) if length > 0.0 else a, length
