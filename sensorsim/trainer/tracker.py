"""The tracking gate: what a sensor follows, where its gate stands in the picture, and when it loses it.

Target and ship modes take the active entity nearest to the picture's middle that is in the field and in sight; scene
and force correlate take the point of terrain in the middle. What was taken is followed until it leaves the field or
something stands before it; the lock is then broken until the host switches tracking off and on.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from math import atan2, degrees, hypot
from typing import TypeAlias

import numpy as np

from sensorsim.trainer.fields import Value
from sensorsim.trainer.host_state import HostState, SensorState, View
from sensorsim.trainer.obstacles import Standing, sight_hits
from sensorsim.trainer.poses import Pose, Surroundings, entity_pose, view_pose
from sensorsim.trainer.rotations import FloatArray
from sensorsim.trainer.sight import AT_THE_END, Answer
from sensorsim.trainer.terrain import ray_hits

SEARCHING, TRACKING, IMPENDING_BREAKLOCK, BREAKLOCK = range(4)
GATE = (32, 32)  # [pixels] wide and high
MARGIN = 0.1  # of the half field, within which the edge threatens the lock


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Lock:
    """What a sensor follows: an entity, else a fixed point (3,) [m]; broken where it was lost."""

    entity: int | None
    point: FloatArray
    broken: bool = False


Locks: TypeAlias = Mapping[tuple[int, int], Lock]


def track_sensors(
    state: HostState, time: float, around: Surroundings, locks: Locks, vehicles: Sequence[Standing] = ()
) -> tuple[list[Answer], Locks]:
    """A response for every sensor that tracks, each frame, and the locks after it."""
    answers: list[Answer] = []
    kept: dict[tuple[int, int], Lock] = {}
    for key, sensor in sorted(state.sensors.items()):
        view = state.views.get(sensor.view)
        if sensor.track_mode == "off" or not sensor.on or view is None:
            continue
        eye = view_pose(view, entity_pose(state, view.entity, time, around))
        lock = None if eye is None else locks.get(key) or _acquire(state, sensor, view, eye, time, around, vehicles)
        lock, said = _gate(state, view, eye, lock, time, around, vehicles)
        if lock is not None:
            kept[key] = lock
        answers.append(_response(state, sensor, lock, said, around))
    return answers, kept


def _acquire(
    state: HostState,
    sensor: SensorState,
    view: View,
    eye: Pose,
    time: float,
    around: Surroundings,
    vehicles: Sequence[Standing],
) -> Lock | None:
    if sensor.track_mode in ("scene", "force correlate"):
        hits = ray_hits(around.terrain, eye.position, eye.attitude[:, 0], view.near, view.far)
        return Lock(entity=None, point=hits[0].position) if hits else None
    best: tuple[float, Lock] | None = None
    for number, entity in sorted(state.entities.items()):
        pose = entity_pose(state, number, time, around) if entity.active and number != view.entity else None
        if pose is None:
            continue
        across, up = _offsets(eye, pose.position)
        away = hypot(across, up)
        nearer = (best is None or away < best[0]) and _margin(view, across, up) >= 0.0
        if nearer and _in_sight(eye, pose.position, around, vehicles, {view.entity, number}):
            best = away, Lock(entity=number, point=pose.position)
    return None if best is None else best[1]


def _gate(
    state: HostState,
    view: View,
    eye: Pose | None,
    lock: Lock | None,
    time: float,
    around: Surroundings,
    vehicles: Sequence[Standing],
) -> tuple[Lock | None, dict[str, Value]]:
    """The lock brought up to date, with status, size and place of the gate."""
    if eye is None or lock is None:
        return None, {"sensor_status": SEARCHING}
    pose = None if lock.entity is None else entity_pose(state, lock.entity, time, around)
    if lock.entity is not None and (pose is None or not state.entities[lock.entity].active):
        return replace(lock, broken=True), {"sensor_status": BREAKLOCK}
    point = lock.point if pose is None else pose.position
    across, up = _offsets(eye, point)
    margin = _margin(view, across, up)
    passed = {view.entity} | (set() if lock.entity is None else {lock.entity})
    seen = margin >= 0.0 and _in_sight(eye, point, around, vehicles, passed)
    if lock.broken or not seen:
        return replace(lock, broken=True), {"sensor_status": BREAKLOCK}
    status = IMPENDING_BREAKLOCK if margin < MARGIN else TRACKING
    gate: dict[str, Value] = {"gate_x_size": GATE[0], "gate_y_size": GATE[1], "gate_x_pos": across, "gate_y_pos": up}
    return replace(lock, point=point), {"sensor_status": status, **gate}


def _response(
    state: HostState, sensor: SensorState, lock: Lock | None, said: dict[str, Value], around: Surroundings
) -> Answer:
    values: dict[str, Value] = {"view_id": sensor.view, "sensor_id": sensor.sensor, "frame_ctr": state.host_frame}
    values |= said
    if not sensor.extended_response:
        return "sensor_response", values
    if lock is not None and not lock.broken:
        values["track_lat"], values["track_lon"], values["track_alt"] = around.place.geodetic(lock.point)
        values["entity_id_valid"], values["entity_id"] = int(lock.entity is not None), lock.entity or 0
    return "sensor_ext_response", values


def _offsets(eye: Pose, point: FloatArray) -> tuple[float, float]:
    """Angles right and up of the picture's middle [deg]; 180 behind it."""
    ahead, right, down = (eye.attitude.T @ (point - eye.position)).tolist()
    return degrees(atan2(right, ahead)), degrees(atan2(-down, ahead))


def _margin(view: View, across: float, up: float) -> float:
    """Least distance to an edge of the field as a share of its half; negative outside."""
    wide, high = 0.5 * (view.right - view.left), 0.5 * (view.top - view.bottom)
    sideways = min(across - view.left, view.right - across) / wide
    return min(sideways, min(up - view.bottom, view.top - up) / high)


def _in_sight(
    eye: Pose, target: FloatArray, around: Surroundings, vehicles: Sequence[Standing], passed: Collection[int]
) -> bool:
    way = target - eye.position
    length = float(np.linalg.norm(way))
    if length <= 2.0 * AT_THE_END:
        return False
    far = length - 10.0 * AT_THE_END
    return not sight_hits(around.terrain, vehicles, eye.position, way / length, AT_THE_END, far, without=passed)
