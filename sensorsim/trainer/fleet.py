"""The vehicles of a scene from frame to frame: how warm their parts are, and the triangles that a renderer draws.

The skin is the sunlit sheet of the world's tables, by each face's direction: the wall type of metal, or where the scene
has none, the lightest. Paint, the same all over: emissivity and reflectances are estimates.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.render import World
from sensorsim.render.solids import Solids
from sensorsim.tables.shade import surface_temperature
from sensorsim.thermal.view_factors import quadrant_view_factors
from sensorsim.trainer.articulation import posed
from sensorsim.trainer.host_state import Triple
from sensorsim.trainer.part_heat import Doing, excess_after, steady_excess
from sensorsim.trainer.rotations import ENU_FROM_NED, Angles, FloatArray, attitude
from sensorsim.trainer.things import Thing
from sensorsim.trainer.vehicle_shape import METAL, VehicleShape, face_normal

EMISSIVITY, SOLAR_REFLECTANCE, LOW_LIGHT_REFLECTANCE = 0.92, 0.25, 0.35  # of olive paint
STANDS = 0.3  # [m s-1] below which a vehicle whose speed nobody said stands
FASTEST = 80.0  # [m s-1]; a place further away is one that it was put to
TURN, SKIN_EVERY = 1.0, 10.0  # [deg], [s] after which the sunlight on a vehicle is found anew
SMOOTHING = 1.0  # [s] over which a speed that nobody said is found


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Known:
    """A vehicle as it was: excess of its parts [K], place [m], speed [m s-1], and when [s]; how its faces stood."""

    excess: FloatArray
    position: Triple
    speed: float
    time: float
    faces: "_Faces"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Faces:
    """Skin temperature (t,) [K] and view factors (t, 4) of a vehicle's faces, and what they were found for."""

    found_for: object
    skin: FloatArray
    quarters: FloatArray


class Fleet:
    """Keeps the heat of every vehicle that is there; one that goes is forgotten."""

    def __init__(self, shapes: Mapping[str, VehicleShape]) -> None:
        self._shapes = dict(shapes)
        self._known: dict[tuple[int, ...], _Known] = {}

    def solids(self, things: Sequence[Thing], time: float, world: World, time_of_day: float) -> Solids | None:
        """Triangles of all vehicles that have a shape, at a time [s] of any clock; None where there is none."""
        shown = [thing for thing in things if thing.model in self._shapes]
        faces = self._faces(shown, world, time_of_day)
        self._known = {thing.key: self._now(thing, time, found) for thing, found in zip(shown, faces, strict=True)}
        if not shown:
            return None
        shapes, known = [self._shapes[thing.model] for thing in shown], [self._known[thing.key] for thing in shown]
        placed = [_placed(shape, thing) for shape, thing in zip(shapes, shown, strict=True)]
        there = np.concatenate([seen for _, seen in placed])
        if not there.any():
            return None
        triangles = np.concatenate([corners for corners, _ in placed])[there]
        heat = [one.faces.skin + one.excess[shape.part] for one, shape in zip(known, shapes, strict=True)]
        even = np.ones(len(triangles))
        return Solids(
            triangles=triangles,
            normal=face_normal(triangles),
            quarters=np.concatenate([one.faces.quarters for one in known])[there],
            temperature=np.concatenate(heat)[there],
            emissivity=EMISSIVITY * even,
            reflectance=LOW_LIGHT_REFLECTANCE * even,
            number=np.repeat(np.arange(len(shown)), [len(shape.part) for shape in shapes])[there],
        )

    def _now(self, thing: Thing, time: float, faces: _Faces) -> _Known:
        """A vehicle that appears has long been doing what it does."""
        before = self._known.get(thing.key)
        if before is None:
            doing = _doing(thing, thing.speed or 0.0)
            return _Known(
                excess=steady_excess(doing), position=thing.position, speed=doing.speed, time=time, faces=faces
            )
        elapsed = time - before.time
        speed = _speed(before, thing, elapsed) if thing.speed is None else thing.speed
        excess = excess_after(before.excess, _doing(thing, speed), elapsed)
        return _Known(excess=excess, position=thing.position, speed=speed, time=time, faces=faces)

    def _faces(self, shown: Sequence[Thing], world: World, time_of_day: float) -> list[_Faces]:
        """Faces as last found, but where a vehicle or a part turned, the clock went on or the world is another."""
        wanted = [(*_stance(thing), time_of_day // SKIN_EVERY, world.inputs_sha256) for thing in shown]
        before = [self._known[thing.key].faces if thing.key in self._known else None for thing in shown]
        stale = [row for row, old in enumerate(before) if old is None or old.found_for != wanted[row]]
        found = _sunlit([self._normals(shown[row]) for row in stale], world, time_of_day)
        new = {
            row: _Faces(found_for=wanted[row], skin=skin, quarters=quarters)
            for row, (skin, quarters) in zip(stale, found, strict=True)
        }
        return [new[row] if old is None or row in new else old for row, old in enumerate(before)]

    def _normals(self, thing: Thing) -> FloatArray:
        """Outward normals (t, 3) east, north, up of a vehicle that stands as `_stance` says."""
        shape, (_, angles, _) = self._shapes[thing.model], _stance(thing)
        corners, _ = posed(shape.triangles, shape.joints, thing.posture)
        return np.asarray(face_normal(corners) @ (ENU_FROM_NED @ attitude(angles)).T)


def _stance(thing: Thing) -> tuple[str, Angles, tuple[tuple[int, ...], ...]]:
    """What the sunlight on a vehicle goes by: its model, and its own and its parts' angles to the nearest TURN."""
    yaw, pitch, roll = (round(angle / TURN) * TURN for angle in thing.angles)
    parts = tuple((number, *(round(angle / TURN) for angle in values[3:])) for number, _, values in thing.posture)
    return thing.model, (yaw, pitch, roll), parts


def _sunlit(normals: Sequence[FloatArray], world: World, time_of_day: float) -> list[tuple[FloatArray, FloatArray]]:
    """Skin temperature (t,) [K] and view factors (t, 4) of several vehicles' faces, of which many face the same way."""
    if not normals:
        return []
    ways, which = np.unique(np.round(np.concatenate(normals), 9) + 0.0, axis=0, return_inverse=True)
    wall, reflectance = np.full(len(ways), skin_wall(world)), np.full(len(ways), SOLAR_REFLECTANCE)
    skin = surface_temperature(world.tables, ways, wall, reflectance, time_of_day)[which]
    ends = np.cumsum([len(faces) for faces in normals])[:-1]
    quarters = quadrant_view_factors(ways)[which]
    return list(zip(np.split(skin, ends), np.split(quarters, ends), strict=True))


def skin_wall(world: World) -> int:
    """Row of the wall type that stands for sheet metal: metal, with outside air behind it if there is such a wall."""
    walls = world.tables.wall_types

    def unlike(row: int) -> tuple[bool, bool, float]:
        wall = walls[row]
        mass = sum(layer.density * layer.specific_heat * layer.thickness for layer in wall.layers)
        return wall.code != METAL, wall.interior not in ("open", "none"), mass if wall.layers else np.inf

    return min(range(len(walls)), key=unlike)


def _doing(thing: Thing, speed: float) -> Doing:
    moving = speed > STANDS
    runs = moving if thing.engine_on is None else thing.engine_on
    return Doing(engine_on=runs, speed=speed if moving else 0.0, burning=thing.burning)


def _speed(before: _Known, thing: Thing, elapsed: float) -> float:
    """Speed from place to place, smoothed."""
    if elapsed <= 0.0:
        return before.speed
    new = float(np.linalg.norm(np.subtract(thing.position, before.position))) / elapsed
    if new > FASTEST:
        return before.speed
    share = 1.0 - np.exp(-elapsed / SMOOTHING)
    return float(before.speed + share * (new - before.speed))


def _placed(shape: VehicleShape, thing: Thing) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Triangles (t, 3, 3) east, north, up [m], and which of them are there (t,)."""
    corners, there = posed(shape.triangles, shape.joints, thing.posture)
    return corners @ (ENU_FROM_NED @ attitude(thing.angles)).T + np.array(thing.position), there
