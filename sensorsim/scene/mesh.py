"""Triangles for drawing: each polygon cut exactly, corners shared within a polygon and with no other."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from shapely import constrained_delaunay_triangles
from shapely.geometry import Polygon

from sensorsim.errors import NumericsError
from sensorsim.scene.extrude import Facet, ring_area
from sensorsim.scene.projection import FloatArray
from sensorsim.scene.surfaces import IntArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Mesh:
    """Triangle mesh, flat shaded."""

    position: FloatArray  # corners, local east, north, up [m], shape (v, 3)
    surface: IntArray  # row of the surface table, per corner, shape (v,)
    triangle: IntArray  # corners, counter-clockwise seen from outside, shape (t, 3)


def triangulate(rings: tuple[FloatArray, ...]) -> IntArray:
    """Corner indices of counter-clockwise triangles, shape (t, 3), that fill an outline with holes.

    Rings have shape (n, 2), the outline first; indices run through all rings in order. The cut is a constrained
    Delaunay triangulation: no corner is added, concave outlines and holes keep their area.
    """
    if len(rings) == 1 and len(rings[0]) == 4 and (turn := _turn_of_quad(rings[0])) != 0:
        return np.array([[0, 1, 2], [0, 2, 3]] if turn > 0 else [[2, 1, 0], [3, 2, 0]], dtype=np.int32)
    corners = np.concatenate(rings)
    index = {(float(x), float(y)): row for row, (x, y) in enumerate(corners)}
    pieces = constrained_delaunay_triangles(Polygon(rings[0], rings[1:])).geoms
    triangles = [[index[x, y] for x, y in piece.exterior.coords[:3]] for piece in pieces]
    wound = [row if ring_area(corners[row]) > 0.0 else row[::-1] for row in triangles]
    filled = sum(ring_area(corners[row]) for row in wound)
    outline = abs(ring_area(rings[0])) - sum(abs(ring_area(hole)) for hole in rings[1:])
    if not abs(filled - outline) <= 1e-9 * outline:
        raise NumericsError(f"triangles fill {filled:.6g} of {outline:.6g} m2: outline too narrow to be cut")
    return np.array(wound, dtype=np.int32)


def _turn_of_quad(ring: FloatArray) -> int:
    """1 where an outline of four corners turns left at each, -1 where right, else 0: in a city few need more search."""
    (a, b), (c, d), (e, f), (g, h) = ring.tolist()
    turns = (
        (c - a) * (f - d) - (d - b) * (e - c), (e - c) * (h - f) - (f - d) * (g - e),
        (g - e) * (b - h) - (h - f) * (a - g), (a - g) * (d - b) - (b - h) * (c - a),
    )  # fmt: skip
    return 1 if min(turns) > 0.0 else -1 if max(turns) < 0.0 else 0


def _facet_triangles(facet: Facet) -> IntArray:
    if facet.role == "wall":
        return np.array([[0, 1, 2], [0, 2, 3]], dtype=np.int32)
    cut = triangulate(tuple(ring[:, :2] for ring in facet.rings))
    return cut[:, ::-1] if facet.role == "bottom" else cut


def build_mesh(facets: Iterable[Facet]) -> Mesh:
    """Mesh of all facets, in the order of the surface table."""
    positions: list[FloatArray] = []
    surfaces: list[IntArray] = []
    triangles: list[IntArray] = []
    offset = 0
    for row, facet in enumerate(facets):
        corners = np.concatenate(facet.rings)
        positions.append(corners)
        surfaces.append(np.full(len(corners), row, dtype=np.int32))
        triangles.append(_facet_triangles(facet) + np.int32(offset))
        offset += len(corners)
    return Mesh(
        position=np.concatenate(positions), surface=np.concatenate(surfaces), triangle=np.concatenate(triangles)
    )
