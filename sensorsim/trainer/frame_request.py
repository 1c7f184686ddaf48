"""One frame as the host wants it, free of packets: what a renderer needs and nothing else.

`PictureSource` is the seam to whatever draws: it takes a FrameRequest and gives the planes of each view by its number.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from sensorsim.trainer.bake_request import BakeRequest
from sensorsim.trainer.handle_environment import moment_of
from sensorsim.trainer.host_state import Air, Component, HostState, Layer, Part, SensorState, Triple, View
from sensorsim.trainer.motion import parts_at
from sensorsim.trainer.poses import Pose, Surroundings, entity_pose, view_pose
from sensorsim.trainer.rotations import ENU_FROM_NED, Angles, angles_of


@dataclass(frozen=True, slots=True, kw_only=True)
class ViewRequest:
    """One picture: eye east, north, up of the scene's origin [m], yaw from the map's north, pitch up, roll [deg].

    Half-angles [deg]: left and bottom negative where the picture holds its axis. visibility [m]: at the eye, None where
    the host has not said it. sensors: those of this view, in order of number.
    """

    number: int
    view_type: int
    position: Triple
    angles: Angles
    left: float
    right: float
    bottom: float
    top: float
    near: float
    far: float
    mirror: int
    visibility: float | None
    sensors: tuple[SensorState, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class EntityRequest:
    """A thing to be drawn: place and angles as those of a view, and its parts and switches as the host set them."""

    number: int
    type_number: int
    position: Triple
    angles: Angles
    alpha: float
    parts: Mapping[int, Part]
    components: Mapping[int, Component]


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameRequest:
    """All of one frame. fresh: the host's message for it came in time; else it is the last one's, carried on.

    time: of the image generator [s]. bake: the weather of the last days that the host wants and the tables do not
    have, None where they have it.
    """

    frame: int
    host_frame: int
    time: float
    fresh: bool
    moment: datetime
    sun: bool
    views: tuple[ViewRequest, ...]
    entities: tuple[EntityRequest, ...]
    air: Air | None
    layers: tuple[Layer, ...]
    bake: BakeRequest | None


PictureSource: TypeAlias = Callable[[FrameRequest], Mapping[int, Mapping[str, NDArray[np.generic]]]]


def compose_frame(
    state: HostState, around: Surroundings, *, frame: int, time: float, fresh: bool, bake: BakeRequest | None
) -> FrameRequest:
    """The frame at an IG time [s]. Views of entities without a place and entities that are not active are left out."""
    shown = {number for number, entity in state.entities.items() if entity.active}
    needed = sorted(shown | {view.entity for view in state.views.values()})
    poses = {number: entity_pose(state, number, time, around) for number in needed}
    views = (_view(state, view, poses[view.entity], around) for _, view in sorted(state.views.items()))
    return FrameRequest(
        frame=frame,
        host_frame=state.host_frame,
        time=time,
        fresh=fresh,
        moment=moment_of(state.clock, time),
        sun=state.clock.sun,
        views=tuple(view for view in views if view is not None),
        entities=_entities(state, time, {number: poses[number] for number in sorted(shown)}),
        air=state.air,
        layers=tuple(layer for _, layer in sorted(state.layers.items())),
        bake=bake,
    )


def visibility_at(state: HostState, height: float) -> float | None:
    """Visibility [m] at a geodetic height [m]: of the thickest layer around it, else of the global atmosphere."""
    inside = [layer.visibility for layer in state.layers.values() if 0.0 <= height - layer.base <= layer.thickness]
    return min(inside) if inside else (state.air.visibility if state.air else None)


def local_angles(pose: Pose) -> Angles:
    """Yaw from the map's north, pitch up and roll right wing down [deg]."""
    return angles_of(np.asarray(ENU_FROM_NED.T @ pose.attitude))


def _triple(position: NDArray[np.float64]) -> Triple:
    east, north, up = position.tolist()
    return east, north, up


def _view(state: HostState, view: View, entity: Pose | None, around: Surroundings) -> ViewRequest | None:
    pose = view_pose(view, entity)
    if pose is None:
        return None
    return ViewRequest(
        number=view.number,
        view_type=view.view_type,
        position=_triple(pose.position),
        angles=local_angles(pose),
        left=view.left,
        right=view.right,
        bottom=view.bottom,
        top=view.top,
        near=view.near,
        far=view.far,
        mirror=view.mirror,
        visibility=visibility_at(state, float(pose.position[2]) + around.place.altitude),
        sensors=tuple(sensor for key, sensor in sorted(state.sensors.items()) if key[0] == view.number),
    )


def _entities(state: HostState, time: float, poses: Mapping[int, Pose | None]) -> tuple[EntityRequest, ...]:
    found = []
    for number, pose in poses.items():
        if pose is None:
            continue
        entity = state.entities[number]
        request = EntityRequest(
            number=number,
            type_number=entity.type_number,
            position=_triple(pose.position),
            angles=local_angles(pose),
            alpha=entity.alpha,
            parts=parts_at(entity, time, moving=state.extrapolate),
            components={key[2]: part for key, part in state.components.items() if key[:2] == (0, number)},
        )
        found.append(request)
    return tuple(found)
