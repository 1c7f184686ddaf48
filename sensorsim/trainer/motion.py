"""Steady motion between the host's messages, and entities taken along to a later time."""

from dataclasses import replace
from functools import lru_cache
from math import atan2, degrees, hypot

import numpy as np
from pyproj import Geod

from sensorsim.trainer.host_state import Entity, Part, Rates, Triple
from sensorsim.trainer.rotations import FloatArray, angles_of, attitude, travelled, turned

PART_AXES = ("xoff", "yoff", "zoff", "roll", "pitch", "yaw")


@lru_cache(maxsize=1)
def _ellipsoid() -> Geod:
    return Geod(ellps="WGS84")


def moved(rates: Rates | None, angles: Triple, elapsed: float) -> tuple[FloatArray, FloatArray]:
    """Way made (3,) [m] and attitude (3, 3) after a time [s], in the axes that the angles are given in."""
    if rates is None or elapsed == 0.0:
        return np.zeros(3), attitude(angles)
    linear, (roll, pitch, yaw) = np.array(rates.linear), rates.angular
    if rates.axes == "world":
        turn = (angles[0] + yaw * elapsed, angles[1] + pitch * elapsed, angles[2] + roll * elapsed)
        return linear * elapsed, attitude(turn)
    start, spin = attitude(angles), np.radians([roll, pitch, yaw])
    return start @ travelled(spin, elapsed) @ linear, start @ turned(spin, elapsed)


def carried_on(entity: Entity, time: float) -> Entity:
    """The entity as it is at a later time [s], so that new rates take it from there and not from where it was."""
    elapsed = time - entity.since
    if entity.place is None or entity.rates is None or elapsed <= 0.0:
        return entity
    (first, second, third), axes = moved(entity.rates, entity.angles, elapsed)
    a, b, c = entity.place
    if entity.parent is None:
        azimuth, way = degrees(atan2(second, first)), hypot(first, second)
        longitude, latitude, _ = _ellipsoid().fwd(b, a, azimuth, way)
        place = (float(latitude), float(longitude), c - float(third))
    else:
        place = (a + float(first), b + float(second), c + float(third))
    return replace(entity, place=place, angles=angles_of(axes), since=time)


def parts_at(entity: Entity, time: float, *, moving: bool) -> dict[int, Part]:
    """An entity's articulated parts as they are at a later time [s], where host and entity extrapolate."""
    carried = moving and entity.extrapolate
    return {key: part_at(part, time) if carried else part for key, part in entity.parts.items()}


def part_at(part: Part, time: float) -> Part:
    """An articulated part as it is at a later time [s], each axis carried on by its rate."""
    elapsed = time - part.since
    if part.rates is None or elapsed <= 0.0:
        return part
    rates = dict(zip(PART_AXES, (*part.rates.linear, *part.rates.angular), strict=True))
    values = {axis: part.values.get(axis, 0.0) + rates[axis] * elapsed for axis in PART_AXES}
    return replace(part, values=values, since=time)
