"""Normals where an interpolation over the sphere may break: poles, edges, corners, opposites, and what is no normal."""

from collections.abc import Callable
from functools import partial

import numpy as np

from sensorsim.errors import InputError
from sensorsim.study.stability_model import Case
from sensorsim.study.stability_world import FloatArray, directions, shade
from sensorsim.tables import OrientationSet, orientation_set
from sensorsim.thermal import ground_view_factor, quadrant_view_factors, sky_view_factor

SETS = ("report26", "icosphere42", "icosphere162")
POLES = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])


def dense_weights(layout: OrientationSet, normal: FloatArray) -> FloatArray:
    """Weights (m, o) of all orientations."""
    corner, weight = layout.locate(normal)
    dense = np.zeros((normal.shape[0], layout.normal.shape[0]))
    np.add.at(dense, (np.arange(normal.shape[0])[:, None], corner), weight)
    return dense


def _at_corners(name: str) -> float:
    """How far a standard orientation is from standing for itself alone; the poles are among them."""
    layout = orientation_set(name)
    dense = dense_weights(layout, layout.normal)
    at_poles = dense_weights(layout, POLES).max(axis=1)
    return max(float(np.abs(dense - np.eye(layout.normal.shape[0])).max()), float(np.abs(at_poles - 1.0).max()))


def _on_edges(name: str) -> float:
    """Weight of the third corner half way along each edge."""
    layout = orientation_set(name)
    first, second = layout.normal[layout.triangle[:, 0]], layout.normal[layout.triangle[:, 1]]
    dense = dense_weights(layout, first + second)
    rows = np.arange(dense.shape[0])
    return float(np.abs(dense[rows, layout.triangle[:, 0]] + dense[rows, layout.triangle[:, 1]] - 1.0).max())


def _across_edges() -> float:
    """Jump of the shade over every edge, 1e-9 to either side."""
    layout = orientation_set("icosphere42")
    a, b, c = np.moveaxis(layout.normal[layout.triangle], 1, 0)
    on_edge = a + 0.37 * (b - a)
    inward = 1e-9 * (c - on_edge)
    return float(np.abs(shade(on_edge + inward) - shade(on_edge - inward)).max())


def _around_a_pole() -> float:
    """Spread of the shade on a circle of 1e-9 around each pole."""
    azimuth = np.linspace(0.0, 2.0 * np.pi, 73)
    around = 1e-9 * np.column_stack([np.sin(azimuth), np.cos(azimuth), np.zeros(73)])
    return max(float(np.ptp(shade(pole + around))) for pole in POLES)


def _opposites(name: str) -> float:
    """Weights of opposite normals, mirrored, less each other."""
    layout, normal = orientation_set(name), directions(2000)
    mirror = np.argmin(layout.normal @ layout.normal.T, axis=1)
    return float(np.abs(dense_weights(layout, -normal)[:, mirror] - dense_weights(layout, normal)).max())


def _half_spaces() -> float:
    """How far a surface's shares of sky and ground, its own and its opposite's, are from filling the sphere."""
    normal = np.concatenate([directions(2000), POLES])
    sky, ground = sky_view_factor(normal), ground_view_factor(normal)
    quarters = quadrant_view_factors(normal).sum(axis=1)
    both = sky + sky_view_factor(-normal) - 1.0
    return float(max(np.abs(sky + ground - 1.0).max(), np.abs(quarters - sky).max(), np.abs(both).max()))


def _length() -> float:
    """What the length of a normal, 1e-6 to 1e6, does to the shade."""
    normal = directions(500)
    plain = shade(normal)
    return max(float(np.abs(shade(scale * normal) - plain).max()) for scale in (1e-6, 0.5, 3.0, 1e6))


def _no_normal() -> float:
    """Normals that have no direction and are let through."""
    passed = 0
    for bad in ([0.0, 0.0, 0.0], [np.nan, 0.0, 1.0], [0.0, np.inf, 0.0], [0.0, 0.0, -np.inf]):
        try:
            orientation_set("icosphere42").locate(np.array([[0.0, 0.0, 1.0], bad]))
        except InputError:
            continue
        passed += 1
    return float(passed)


def _case(
    name: str, stresses: str, measured: str, bound: float, reason: str, measure: Callable[[], float], unit: str = "-"
) -> Case:
    return Case(
        name=name, group="normals", stresses=stresses, measured=measured, unit=unit, bound=bound, reason=reason,
        measure=measure,
    )  # fmt: skip


CASES = (
    *(
        _case(
            f"normal at a pole and at every orientation of {name}",
            "a corner belongs to five or six triangles at once",
            "how far the corner is from standing for itself alone",
            1e-12,
            "rounding of three products",
            partial(_at_corners, name),
        )
        for name in SETS
    ),
    *(
        _case(
            f"normal on every edge of {name}",
            "an edge belongs to two triangles",
            "weight that its two corners lack",
            1e-12,
            "on an edge only its two corners count",
            partial(_on_edges, name),
        )
        for name in SETS
    ),
    _case(
        "step of 1e-9 across every edge",
        "the three closest orientations change there, by which the report interpolates",
        "jump of the shade",
        1e-6,
        "1e-9 of a radian times slopes of up to 100 K",
        _across_edges,
        "K",
    ),
    _case(
        "circle of 1e-9 around a pole",
        "azimuth is undefined at a pole",
        "spread of the shade",
        1e-6,
        "as above; an azimuth would spread it by kelvins",
        _around_a_pole,
        "K",
    ),
    *(
        _case(
            f"opposite normals in {name}",
            "a sum of the two is zero",
            "weights less the mirrored ones",
            1e-9,
            "the set is its own mirror image",
            partial(_opposites, name),
        )
        for name in SETS
    ),
    _case(
        "view factors of opposite normals",
        "closed forms with roots that vanish when level or upright",
        "what sky, ground and quarters lack of a full sphere",
        1e-12,
        "view factors of an enclosure sum to 1",
        _half_spaces,
    ),
    _case(
        "normals of length 1e-6 to 1e6",
        "a mesh whose normals are not unit vectors",
        "what the length does to the shade",
        1e-9,
        "a direction has no length",
        _length,
        "K",
    ),
    _case(
        "normals of length 0, NaN and infinity",
        "0/0 in the weights",
        "how many of four are let through",
        0.0,
        "what has no direction is refused",
        _no_normal,
    ),
)
