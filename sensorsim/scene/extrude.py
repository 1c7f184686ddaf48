"""Footprints raised to polygons: a roof, walls and a bottom, or one polygon for a plane."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np

from sensorsim.scene.features import Part
from sensorsim.scene.projection import FloatArray, LocalFrame

Role = Literal["roof", "wall", "bottom", "plane"]

_UP = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Facet:
    """One flat polygon, one surface as the report counts them."""

    rings: tuple[FloatArray, ...]  # corners [m], shape (n, 3), counter-clockwise seen from outside; holes clockwise
    normal: FloatArray  # unit, pointing away from the solid, shape (3,)
    area: float  # [m2]
    role: Role


def ring_area(ring: FloatArray) -> float:
    """Signed area [m2] of a closed outline of shape (n, 2), positive where counter-clockwise."""
    x, y = (ring - ring[0]).T  # about its own corner, so that large coordinates cost no digits
    around = np.dot(x[:-1], y[1:]) - np.dot(y[:-1], x[1:])  # the side back to the start adds nothing there
    return 0.5 * float(around)


def extrude(part: Part, frame: LocalFrame) -> list[Facet]:
    """Facets of a part in local metres: roof, walls in the order of its corners, bottom; or the plane alone."""
    rings = [frame.metres_from_degrees(ring) for ring in part.rings]
    if part.is_plane:
        return [_flat(rings, part.base, "plane")]
    facets = [_flat(rings, part.top, "roof")]
    for ring in rings:
        facets.extend(_walls(ring, part.base, part.top))
    if part.has_bottom:
        facets.append(_flat(rings, part.base, "bottom"))
    return facets


def _flat(rings: list[FloatArray], height: float, role: Role) -> Facet:
    area = sum(ring_area(ring) for ring in rings)
    raised = [np.column_stack((ring, np.full(len(ring), height))) for ring in rings]
    if role == "bottom":
        return Facet(rings=tuple(ring[::-1] for ring in raised), normal=-_UP, area=area, role=role)
    return Facet(rings=tuple(raised), normal=_UP, area=area, role=role)


def _walls(ring: FloatArray, base: float, top: float) -> Iterator[Facet]:
    """One wall per side; the outside is to the right of the outline, for holes too."""
    for here, after in zip(ring, np.concatenate([ring[1:], ring[:1]]), strict=True):
        along = after - here
        length = float(np.hypot(along[0], along[1]))
        corners = np.array([[*here, base], [*after, base], [*after, top], [*here, top]])
        normal = np.array([along[1] / length, -along[0] / length, 0.0])
        yield Facet(rings=(corners,), normal=normal, area=length * (top - base), role="wall")
