"""HAT/HOT and line of sight answered from the scene's geometry.

Height of terrain is that of the highest surface at the place; height above terrain is the difference to it; vehicles
are no terrain. In a line of sight they stand like walls, all but the one that the ray starts from, in its axes, and the
one that it asks for. Answers are refused (valid 0) beside the scene, from an entity that has no place, and for a
ray that meets nothing.
"""

from collections.abc import Mapping, Sequence
from math import asin, atan2, cos, degrees, radians, sin

import numpy as np

from sensorsim.trainer.fields import Value
from sensorsim.trainer.host_state import HostState, Query
from sensorsim.trainer.obstacles import Standing, sight_hits
from sensorsim.trainer.poses import Surroundings, entity_pose
from sensorsim.trainer.rotations import ENU_FROM_NED, FloatArray
from sensorsim.trainer.terrain import Hit, height_of_terrain

Answer = tuple[str, dict[str, Value]]  # a packet's name and values

MOST_MEETINGS = 16  # answers to one question
AT_THE_END = 1e-4  # [m]: a surface this near to a segment's end is what the end lies on
HAT, HOT, EXTENDED = range(3)
OPAQUE_GREY = {"red": 128, "green": 128, "blue": 128, "alpha": 255}  # surfaces have no visible colour here


def answer(
    state: HostState, query: Query, time: float, around: Surroundings, vehicles: Sequence[Standing] = ()
) -> list[Answer]:
    """Response packets to one question, at least one, with the host frame's low bits."""
    values = query.values
    if query.kind == "hat_hot_request":
        answers = [_hat_hot(state, values, time, around)]
    elif query.kind == "los_segment_request":
        answers = _segment(state, values, time, around, vehicles)
    else:
        answers = _vector(state, values, time, around, vehicles)
    for _, said in answers:
        said["host_frame_number_lsn"] = state.host_frame & 15
    return answers


def point(
    state: HostState, values: Mapping[str, Value], prefix: str, entity: int | None, time: float, around: Surroundings
) -> FloatArray | None:
    """Local position of a place of a packet: geodetic where entity is None, else in that entity's axes."""
    a, b, c = (float(values[f"{prefix}{axis}"]) for axis in ("lat_xoff", "lon_yoff", "alt_zoff"))
    if entity is None:
        return around.place.local(a, b, c)
    pose = entity_pose(state, entity, time, around)
    return None if pose is None else pose.from_body(np.array([a, b, c]))


def _hat_hot(state: HostState, values: Mapping[str, Value], time: float, around: Surroundings) -> Answer:
    entity = int(values["entity_id"]) if values["coordinate_system"] else None
    place = point(state, values, "", entity, time, around)
    hit = None if place is None else height_of_terrain(around.terrain, place[0], place[1])
    said: dict[str, Value] = {"hat_hot_id": values["hat_hot_id"], "valid": int(hit is not None)}
    if int(values["type"]) == EXTENDED:
        if hit is not None and place is not None:
            said["hat"], said["hot"] = float(place[2]) - hit.height, hit.height + around.place.altitude
            latitude, longitude, _ = around.place.geodetic(hit.position)
            said |= _surface(hit, around.place.convergence(latitude, longitude))
        return "hat_hot_ext_response", said
    said["type"] = int(values["type"])
    if hit is not None and place is not None:
        wants_hot = int(values["type"]) == HOT
        said["height"] = hit.height + around.place.altitude if wants_hot else float(place[2]) - hit.height
    return "hat_hot_response", said


def _segment(
    state: HostState, values: Mapping[str, Value], time: float, around: Surroundings, vehicles: Sequence[Standing]
) -> list[Answer]:
    """Whether the end is seen from the start; where not, every surface between."""
    source_entity = int(values["entity_id"])
    to_entity = bool(values["destination_entity_id_valid"])
    end_entity = int(values["destination_entity_id"]) if to_entity else source_entity
    start = point(state, values, "source_", source_entity if values["source_coord"] else None, time, around)
    end = point(state, values, "destination_", end_entity if values["destination_coord"] else None, time, around)
    if start is None or end is None or not np.any(end - start):
        return [_unseen(values, 0)]
    length = float(np.linalg.norm(end - start))
    passed = ({source_entity} if values["source_coord"] else set()) | ({end_entity} if to_entity else set())
    hits = sight_hits(
        around.terrain, vehicles, start, (end - start) / length, AT_THE_END, length - AT_THE_END, without=passed
    )
    if hits:
        return _meetings(state, values, hits, time, around, {"visible": 0})
    name, said = _unseen(values, 1)
    said["visible"] = 1
    if to_entity:
        said["entity_id_valid"], said["entity_id"] = 1, end_entity
    return [(name, said)]


def _vector(
    state: HostState, values: Mapping[str, Value], time: float, around: Surroundings, vehicles: Sequence[Standing]
) -> list[Answer]:
    """Every surface that a ray meets between two ranges; a greatest range of 0 sets no limit."""
    in_body = bool(values["source_coord"])
    pose = entity_pose(state, int(values["entity_id"]), time, around) if in_body else None
    start = point(state, values, "source_", int(values["entity_id"]) if in_body else None, time, around)
    if start is None:
        return [_unseen(values, 0)]
    azimuth, elevation = radians(float(values["azimuth"])), radians(float(values["elevation"]))
    if pose is not None:
        axes = pose.attitude
    else:
        latitude, longitude, _ = around.place.geodetic(start)
        azimuth -= radians(around.place.convergence(latitude, longitude))
        axes = ENU_FROM_NED
    flat = cos(elevation)
    direction = axes @ np.array([cos(azimuth) * flat, sin(azimuth) * flat, -sin(elevation)])
    far = float(values["max_range"]) or np.inf
    own = {int(values["entity_id"])} if in_body else set()
    near = max(AT_THE_END, float(values["min_range"]))
    hits = sight_hits(around.terrain, vehicles, start, direction, near, far, without=own)
    return _meetings(state, values, hits, time, around, {"visible": 1}) if hits else [_unseen(values, 0)]


def _unseen(values: Mapping[str, Value], valid: int) -> Answer:
    """An answer without a meeting."""
    name, count = ("los_ext_response", "response_count") if values["type"] else ("los_response", "count")
    return name, {"los_id": values["los_id"], "valid": valid, count: 1}


def _meetings(
    state: HostState,
    values: Mapping[str, Value],
    hits: list[Hit],
    time: float,
    around: Surroundings,
    common: dict[str, Value],
) -> list[Answer]:
    """One answer for each surface met, with the number of them all."""
    kept = hits[:MOST_MEETINGS]
    said: dict[str, Value] = {"los_id": values["los_id"], "valid": 1, **common}
    if not values["type"]:
        return [("los_response", {**said, **_whose(hit), "count": len(kept), "range": hit.range}) for hit in kept]
    pose = entity_pose(state, int(values["entity_id"]), time, around) if values["response_coord"] else None
    answers: list[Answer] = []
    for hit in kept:
        where = around.place.geodetic(hit.position)
        north = around.place.convergence(where[0], where[1])
        if pose is not None:
            first, second, third = (pose.attitude.T @ (hit.position - pose.position)).tolist()
            where = (first, second, third)
        places: dict[str, Value] = dict(zip(("lat_xoff", "lon_yoff", "alt_zoff"), where, strict=True))
        found: dict[str, Value] = {"response_count": len(kept), "range_valid": 1, "range": hit.range}
        more = {**_whose(hit), **_surface(hit, north)}
        answers.append(("los_ext_response", {**said, **found, **places, **OPAQUE_GREY, **more}))
    return answers


def _whose(hit: Hit) -> dict[str, Value]:
    """The entity whose surface was met."""
    return {} if hit.entity is None else {"entity_id_valid": 1, "entity_id": hit.entity}


def _surface(hit: Hit, convergence: float) -> dict[str, Value]:
    """Material code and the normal's azimuth from true north, -180 to 180, and elevation [deg]."""
    east, north, up = hit.normal.tolist()
    azimuth = 0.0 if (east, north) == (0.0, 0.0) else degrees(atan2(east, north)) + convergence
    return {
        "material_code": hit.material,
        "normal_vector_azimuth": (azimuth + 180.0) % 360.0 - 180.0,
        "normal_vector_elevation": degrees(asin(max(-1.0, min(1.0, up)))),
    }
