"""Vehicles that stand in a line of sight, beside the terrain: the host's entities as they are drawn, at their place.

A ray is taken into a vehicle's axes, where its triangles stay as they are from frame to frame. Vehicles of a DIS
exercise are no entities of the host and stand in no line of sight.
"""

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from sensorsim.trainer.articulation import Posture, posed, posture_of
from sensorsim.trainer.host_state import HostState
from sensorsim.trainer.motion import parts_at
from sensorsim.trainer.poses import Pose, Surroundings, entity_pose
from sensorsim.trainer.rotations import FloatArray
from sensorsim.trainer.terrain import Hit, Terrain, ray_hits, terrain_from_triangles
from sensorsim.trainer.things import TYPES
from sensorsim.trainer.vehicle_shape import METAL, VehicleShape


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Standing:
    """An entity's vehicle: triangles in its body axes, within so far of its origin [m]."""

    entity: int
    pose: Pose
    solid: Terrain
    radius: float


def standing_vehicles(state: HostState, time: float, around: Surroundings) -> tuple[Standing, ...]:
    """The active entities that are vehicles, at an IG time [s]."""
    found = []
    for number, entity in sorted(state.entities.items()):
        shape = around.shapes.get(TYPES.get(entity.type_number, "")) if entity.active else None
        pose = None if shape is None else entity_pose(state, number, time, around)
        if shape is None or pose is None:
            continue
        solid, radius = _solid(shape, posture_of(parts_at(entity, time, moving=state.extrapolate)))
        found.append(Standing(entity=number, pose=pose, solid=solid, radius=radius))
    return tuple(found)


def sight_hits(
    terrain: Terrain,
    vehicles: Sequence[Standing],
    origin: FloatArray,
    direction: FloatArray,
    near: float,
    far: float,
    *,
    without: Collection[int] = (),
) -> list[Hit]:
    """Meetings of a ray with terrain and vehicles, but those of the entities `without`; else as `ray_hits`."""
    hits = ray_hits(terrain, origin, direction, near, far)
    for vehicle in vehicles:
        if vehicle.entity not in without and _may_meet(vehicle, origin, direction, near, far):
            hits += _vehicle_hits(vehicle, origin, direction, near, far)
    return sorted(hits, key=lambda hit: hit.range)


@lru_cache(maxsize=256)
def _solid(shape: VehicleShape, posture: Posture) -> tuple[Terrain, float]:
    corners, there = posed(shape.triangles, shape.joints, posture)
    metal = np.full(int(there.sum()), METAL, dtype=np.int64)
    radius = float(np.linalg.norm(corners, axis=2).max())
    return terrain_from_triangles(corners[there], metal), radius


def _may_meet(vehicle: Standing, origin: FloatArray, direction: FloatArray, near: float, far: float) -> bool:
    """Whether a ray comes within the sphere around a vehicle."""
    way = vehicle.pose.position - origin
    along = float(way @ direction)
    aside = float(np.linalg.norm(way - along * direction))
    return aside <= vehicle.radius and near - vehicle.radius <= along <= far + vehicle.radius


def _vehicle_hits(vehicle: Standing, origin: FloatArray, direction: FloatArray, near: float, far: float) -> list[Hit]:
    axes = vehicle.pose.attitude
    start, ahead = (origin - vehicle.pose.position) @ axes, direction @ axes
    return [
        replace(hit, position=origin + hit.range * direction, normal=axes @ hit.normal, entity=vehicle.entity)
        for hit in ray_hits(vehicle.solid, start, ahead, near, far)
    ]
