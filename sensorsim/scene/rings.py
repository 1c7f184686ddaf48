"""Outlines of GeoJSON polygons, checked and wound one way."""

from itertools import pairwise

import numpy as np
from shapely.geometry import Polygon
from shapely.geometry.polygon import orient
from shapely.validation import explain_validity

from sensorsim.scene.entry import Entry
from sensorsim.scene.projection import FloatArray


def _ring(entry: Entry, name: str, coordinates: object) -> FloatArray:
    """Longitude and latitude [deg] of one closed ring, shape (n, 2), last position dropped."""
    if not isinstance(coordinates, list) or len(coordinates) < 4:
        entry.refuse(name, coordinates, "a ring needs four positions, first = last", "give at least three corners")
    positions: list[tuple[float, float]] = []
    for index, position in enumerate(coordinates):
        where = f"{name}[{index}]"
        if not isinstance(position, list) or len(position) < 2:
            entry.refuse(where, position, "not a position", "write [longitude, latitude]")
        pair = position[:2]
        if not all(isinstance(value, int | float) and not isinstance(value, bool) for value in pair):
            entry.refuse(where, position, "not a pair of numbers", "write [longitude, latitude] in degrees")
        if not (abs(pair[0]) <= 180.0 and abs(pair[1]) < 90.0):  # also false for NaN
            entry.refuse(where, position, "no longitude and latitude", "give WGS 84 degrees, longitude first")
        positions.append((float(pair[0]), float(pair[1])))
    if positions[0] != positions[-1]:
        entry.refuse(name, positions[-1], "the ring is not closed", "repeat the first position at its end")
    for index, (here, after) in enumerate(pairwise(positions)):
        if here == after:
            entry.refuse(f"{name}[{index}]", list(here), "the same position twice running", "remove one of them")
    return np.array(positions[:-1], dtype=np.float64)


def _polygon(entry: Entry, name: str, coordinates: object) -> tuple[FloatArray, ...]:
    if not isinstance(coordinates, list) or not coordinates:
        entry.refuse(name, coordinates, "not a polygon", "give a list of rings, the outline first")
    rings = [_ring(entry, f"{name}[{index}]", ring) for index, ring in enumerate(coordinates)]
    outline = Polygon(rings[0], rings[1:])
    if not outline.is_valid or outline.area == 0.0:
        reason = explain_validity(outline)
        entry.refuse(name, reason, "the polygon crosses or touches itself", "redraw it as a simple outline")
    wound = orient(outline, sign=1.0)
    loops = [wound.exterior, *wound.interiors]
    return tuple(np.array(loop.coords, dtype=np.float64)[:-1, :2] for loop in loops)


def read_rings(entry: Entry, geometry: object) -> tuple[tuple[FloatArray, ...], ...]:
    """Rings [deg] of every polygon: outline counter-clockwise, holes clockwise, not closed.

    Altitudes that a position may carry are not used; a feature's heights are in its properties.
    """
    kind = geometry.get("type") if isinstance(geometry, dict) else geometry
    if not isinstance(geometry, dict) or kind not in ("Polygon", "MultiPolygon"):
        entry.refuse("geometry", kind, "not an outline", "give a Polygon or a MultiPolygon")
    coordinates = geometry.get("coordinates")
    if kind == "Polygon":
        return (_polygon(entry, "coordinates", coordinates),)
    if not isinstance(coordinates, list) or not coordinates:
        entry.refuse("coordinates", coordinates, "no polygon in it", "give at least one polygon")
    return tuple(_polygon(entry, f"coordinates[{index}]", part) for index, part in enumerate(coordinates))
