"""Where an entity and a view are at a time: motion carried on, parents followed, geodetic places made local."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from sensorsim.trainer.host_state import Entity, HostState, Triple, View
from sensorsim.trainer.local_place import LocalPlace
from sensorsim.trainer.motion import moved
from sensorsim.trainer.rotations import ENU_FROM_NED, FloatArray, attitude, turned
from sensorsim.trainer.terrain import Terrain, height_of_terrain
from sensorsim.trainer.vehicle_shape import VehicleShape

DEEPEST_CHAIN = 32  # entities that hang from each other
EDGE_OF_MAP = 6e5  # [m] from the scene's origin


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Pose:
    """Position (3,) east, north, up of the scene's origin [m], and the attitude (3, 3) from body to those axes."""

    position: FloatArray
    attitude: FloatArray

    def from_body(self, point: FloatArray) -> FloatArray:
        """Local position of a point in body axes (3,) [m]."""
        return np.asarray(self.position + self.attitude @ point)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Surroundings:
    """What places are measured against, and the shapes of vehicles by name, which stand in lines of sight."""

    place: LocalPlace
    terrain: Terrain
    shapes: Mapping[str, VehicleShape] = field(default_factory=dict)


def entity_pose(state: HostState, key: int, time: float, around: Surroundings) -> Pose | None:
    """Pose of an entity at an IG time [s]; None where it, or what it hangs from, has no place on the map."""
    entity = state.entities.get(key)
    chain = [entity]
    while entity is not None and entity.parent is not None and len(chain) <= DEEPEST_CHAIN:
        entity = state.entities.get(entity.parent)
        chain.append(entity)
    if len(chain) > DEEPEST_CHAIN or any(link is None or link.place is None for link in chain):
        return None
    pose: Pose | None = None
    for link in reversed(chain):
        assert link is not None
        assert link.place is not None
        elapsed = max(0.0, time - link.since) if state.extrapolate and link.extrapolate else 0.0
        pose = _child(pose, link, elapsed) if pose is not None else _top_level(link, link.place, elapsed, around)
        if pose is None:
            return None
    return _on_map(pose)


def view_pose(view: View, entity: Pose | None) -> Pose | None:
    """Pose of a view's eye: its offset, then its angles, in the axes of the entity that it is attached to."""
    if entity is None:
        return None
    eye = entity.from_body(np.array(view.offset))
    return _on_map(Pose(position=eye, attitude=entity.attitude @ attitude(view.angles)))


def _on_map(pose: Pose | None) -> Pose | None:
    return pose if pose is not None and np.all(np.abs(pose.position) < EDGE_OF_MAP) else None


def _top_level(entity: Entity, place: Triple, elapsed: float, around: Surroundings) -> Pose | None:
    latitude, longitude, altitude = place
    position = around.place.local(latitude, longitude, altitude)
    if position is None:
        return None
    yaw, pitch, roll = entity.angles
    map_from_true = ENU_FROM_NED @ attitude((-around.place.convergence(latitude, longitude), 0.0, 0.0))
    way, axes = moved(entity.rates, (yaw, pitch, roll), elapsed)
    position = position + map_from_true @ way
    pose = Pose(position=position, attitude=map_from_true @ axes)
    return pose if entity.clamp == "none" else _clamped(pose, entity.clamp == "conformal", altitude, around.terrain)


def _child(parent: Pose, entity: Entity, elapsed: float) -> Pose:
    assert entity.place is not None
    way, axes = moved(entity.rates, entity.angles, elapsed)
    position = parent.from_body(np.array(entity.place) + way)
    return Pose(position=position, attitude=parent.attitude @ axes)


def _clamped(pose: Pose, conformal: bool, above: float, terrain: Terrain) -> Pose:
    """On the terrain, `above` it by that height [m]; conformal: its up along the terrain's normal. As is beside it."""
    hit = height_of_terrain(terrain, pose.position[0], pose.position[1])
    if hit is None:
        return pose
    position = np.array([pose.position[0], pose.position[1], hit.height + above])
    if not conformal:
        return Pose(position=position, attitude=pose.attitude)
    axis = np.cross([0.0, 0.0, 1.0], hit.normal)
    sine = float(np.linalg.norm(axis))
    tilt = (
        turned(np.asarray(axis / sine, dtype=np.float64), float(np.arctan2(sine, hit.normal[2])))
        if sine > 0.0
        else np.eye(3)
    )
    return Pose(position=position, attitude=tilt @ pose.attitude)
