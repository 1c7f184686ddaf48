"""Where a ray meets triangles, as a compiled loop: a frame has time for dozens of questions.

By Cramer's rule on a triangle's corner and the two edges that leave it [MollerTrumbore1997], in double precision: the
single precision of Embree cannot give a range to a millimetre two kilometres away.
"""

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[Any]

GROUP = 32  # triangles to a box
EDGE = 1e-9  # barycentric: a ray along the edge of two triangles meets one of them at least
LEAST_SLOPE = 1e-300  # 0 / 0 must not arise on a box's face


@njit(cache=True, nogil=True, error_model="numpy")
def may_meet(low: Array, high: Array, origin: Array, direction: Array, far: float) -> bool:
    """Whether a ray comes through a box, low to high (3,), before a range."""
    enter, leave = -np.inf, np.inf
    for axis in range(3):
        slope = direction[axis] if direction[axis] != 0.0 else LEAST_SLOPE
        one, other = (low[axis] - origin[axis]) / slope, (high[axis] - origin[axis]) / slope
        enter, leave = max(enter, min(one, other)), min(leave, max(one, other))
    return enter <= leave and leave >= 0.0 and enter <= far


@njit(cache=True, nogil=True, error_model="numpy")
def range_to(corner: Array, first: Array, second: Array, origin: Array, direction: Array) -> float:
    """Range along a ray to a triangle's plane, NaN where it passes beside the triangle or along it."""
    dx, dy, dz = direction
    fx, fy, fz = first
    sx, sy, sz = second
    ax, ay, az = dy * sz - dz * sy, dz * sx - dx * sz, dx * sy - dy * sx
    volume = fx * ax + fy * ay + fz * az
    if volume == 0.0:
        return np.nan
    ox, oy, oz = origin[0] - corner[0], origin[1] - corner[1], origin[2] - corner[2]
    along_first = (ox * ax + oy * ay + oz * az) / volume
    tx, ty, tz = oy * fz - oz * fy, oz * fx - ox * fz, ox * fy - oy * fx
    along_second = (tx * dx + ty * dy + tz * dz) / volume
    inside = along_first >= -EDGE and along_second >= -EDGE and along_first + along_second <= 1.0 + EDGE
    return (sx * tx + sy * ty + sz * tz) / volume if inside else np.nan


@njit(cache=True, nogil=True, error_model="numpy")
def meetings(
    corner: Array, first: Array, second: Array, low: Array, high: Array, origin: Array, direction: Array,
    near: float, far: float,
) -> tuple[Array, Array]:  # fmt: skip
    """Triangles that a ray meets from near to far, and the ranges (m,), in the triangles' order.

    corner, first, second (t, 3); low, high (g, 3): boxes around GROUP triangles each.
    """
    triangle, away = np.zeros(len(corner), np.int64), np.zeros(len(corner))
    count = 0
    for group in range(len(low)):
        if not may_meet(low[group], high[group], origin, direction, far):
            continue
        for row in range(group * GROUP, min((group + 1) * GROUP, len(corner))):
            distance = range_to(corner[row], first[row], second[row], origin, direction)
            if near <= distance <= far:
                triangle[count], away[count] = row, distance
                count += 1
    return triangle[:count], away[:count]
