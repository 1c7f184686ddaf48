"""View factors of a tilted surface to the sky, to the ground and to the four quarters of the sky, in closed form.

The irradiance of a uniform spherical polygon is the sum over its edges of arc length times the edge plane's normal
[Baum1989 eq. 3], so each quarter of the sky (the triangle zenith, horizon, horizon) is clipped at the surface's own
horizon and summed. The four quarters then add up to the sky's own factor (1 + cos tilt) / 2.
"""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

QUADRANT_AZIMUTHS = (0.0, 90.0, 180.0, 270.0)  # [deg] of the middle of the N, E, S and W quarter


def sky_view_factor(normal: FloatArray) -> FloatArray:
    """Fraction of a surface's hemisphere that is sky, for unit normals (..., 3) [-]."""
    return 0.5 * (1.0 + normal[..., 2])


def ground_view_factor(normal: FloatArray) -> FloatArray:
    """Fraction of a surface's hemisphere that is ground, for unit normals (..., 3) [-]."""
    return 0.5 * (1.0 - normal[..., 2])


def quadrant_view_factors(normal: FloatArray) -> FloatArray:
    """Fractions of a surface's hemisphere that are the N, E, S and W quarter of the sky, (m, 3) -> (m, 4) [-]."""
    return np.stack([_polygon_view_factor(_quadrant(azimuth), normal) for azimuth in QUADRANT_AZIMUTHS], axis=-1)


def _quadrant(azimuth: float) -> FloatArray:
    """Corners (3, 3) of a quarter of the sky, counter-clockwise as seen from the ground's centre."""
    corners = np.radians([azimuth + 45.0, azimuth - 45.0])
    horizon = [(np.sin(angle), np.cos(angle), 0.0) for angle in corners]
    return np.array([(0.0, 0.0, 1.0), *horizon])


def _polygon_view_factor(polygon: FloatArray, normal: FloatArray) -> FloatArray:
    """View factor (m,) from unit normals (m, 3) to a spherical polygon (k, 3), clipped at each surface's horizon."""
    height = normal @ polygon.T
    total = np.zeros(normal.shape[0])
    count = polygon.shape[0]
    crossings = np.zeros((2, normal.shape[0], 3))  # where the outline leaves and enters the hemisphere
    crosses = np.zeros(normal.shape[0], dtype=bool)
    for k in range(count):
        start, end = polygon[k], polygon[(k + 1) % count]
        h_start, h_end = height[:, k], height[:, (k + 1) % count]
        cut = _unit(np.abs(h_end)[:, None] * start + np.abs(h_start)[:, None] * end)
        leaves, enters = (h_start > 0) & (h_end <= 0), (h_start <= 0) & (h_end > 0)
        first = np.where(enters[:, None], cut, start)
        last = np.where(leaves[:, None], cut, end)
        seen = (h_start > 0) | (h_end > 0)
        total += np.where(seen, _edge_term(first, last, normal), 0.0)
        crossings[0, leaves], crossings[1, enters] = cut[leaves], cut[enters]
        crosses |= leaves
    total += np.where(crosses, _edge_term(crossings[0], crossings[1], normal), 0.0)
    return np.maximum(total / (2.0 * np.pi), 0.0)


def _edge_term(first: FloatArray, last: FloatArray, normal: FloatArray) -> FloatArray:
    """Arc length of an edge times the component of its plane's normal along the surface's normal."""
    cross = np.cross(first, last)
    sine = np.linalg.norm(cross, axis=-1)
    angle = np.arctan2(sine, np.sum(first * last, axis=-1))
    scale = np.divide(angle, sine, out=np.ones_like(sine), where=sine > 1e-12)
    return np.asarray(scale * np.sum(cross * normal, axis=-1))


def _unit(vector: FloatArray) -> FloatArray:
    length = np.linalg.norm(vector, axis=-1, keepdims=True)
    return np.asarray(np.divide(vector, length, out=np.zeros_like(vector), where=length > 0))
