"""Shapes of vehicles: boxes and lying cylinders joined to triangles, each with the part that it belongs to.

Body axes: x forward, y right, z down, origin on the ground under the middle [m].
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sensorsim.errors import InputError
from sensorsim.trainer.articulation import Joint
from sensorsim.trainer.rotations import FloatArray

PARTS = ("skin", "engine", "exhaust", "tracks", "wheels", "cabin")
METAL = 12  # what vehicles are of: code of figure 9 of [Report1978]
SIDES = 12  # of a cylinder
# Corners of the unit cube by the bits of their number (x, y, z), and its faces counter-clockwise seen from outside
_CORNERS = np.array([[number & 1, number >> 1 & 1, number >> 2 & 1] for number in range(8)]) - 0.5
_FACES = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class VehicleShape:
    """Triangles (t, 3, 3) in body axes [m], counter-clockwise seen from outside; part (t,) as rows of PARTS.

    joints: what moves against the body, inner ones before those that carry them.
    """

    name: str
    triangles: FloatArray
    part: np.ndarray
    joints: tuple[Joint, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what is no closed list of triangles of known parts."""
        if self.triangles.ndim != 3 or self.triangles.shape[1:] != (3, 3) or len(self.triangles) == 0:
            raise InputError(self.name, "triangles", self.triangles.shape, "not (t, 3, 3)", "give triangles")
        if not np.isfinite(self.triangles).all():
            raise InputError(self.name, "triangles", "a corner", "not finite", "give metres")
        if face_area(self.triangles).min() <= 0.0:
            raise InputError(self.name, "triangles", "one of them", "without an area", "take it out")
        known = (self.part >= 0) & (self.part < len(PARTS))
        if self.part.shape != self.triangles.shape[:1] or not known.all():
            raise InputError(self.name, "part", self.part.shape, "not a row of PARTS for each triangle", "name parts")
        for joint in self.joints:
            if joint.carries.shape != self.part.shape or not np.isfinite(joint.pivot).all():
                raise InputError(self.name, "joint", joint.number, "not of this shape", "give a flag for each triangle")


def face_area(triangles: FloatArray) -> FloatArray:
    """Area (t,) [m2]."""
    edges = triangles[:, 1:] - triangles[:, :1]
    return np.asarray(0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1))


def face_normal(triangles: FloatArray) -> FloatArray:
    """Outward unit normals (t, 3)."""
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    return np.asarray(across / np.linalg.norm(across, axis=1)[:, None])


def box(middle: Sequence[float], size: Sequence[float]) -> FloatArray:
    """Twelve triangles of a box; middle and size (3,): forward, right, up [m]."""
    quads = _CORNERS[np.array(_FACES)] * np.array(size) + np.array(middle)
    return _down(np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]))


def cylinder(middle: Sequence[float], radius: float, length: float, axis: int) -> FloatArray:
    """A cylinder along axis 0 forward, 1 right or 2 up, closed at both ends."""
    angle = 2.0 * np.pi * np.arange(SIDES + 1) / SIDES
    around = radius * np.column_stack([np.cos(angle), np.sin(angle)])
    rim = [np.column_stack([around, np.full(SIDES + 1, 0.5 * end * length)]) for end in (-1.0, 1.0)]
    low, high = rim[0], rim[1]
    here, there = slice(0, -1), slice(1, None)
    sides = [np.stack([low[here], low[there], high[there]], axis=1)]
    sides.append(np.stack([low[here], high[there], high[here]], axis=1))
    for ends, order in ((low, (there, here)), (high, (here, there))):
        hub = np.tile([0.0, 0.0, ends[0, 2]], (SIDES, 1))
        sides.append(np.stack([hub, ends[order[0]], ends[order[1]]], axis=1))
    turn = [(2, 0, 1), (1, 2, 0), (0, 1, 2)][axis]  # even permutations: outside stays outside
    return _down(np.concatenate(sides)[:, :, turn] + np.array(middle))


def shape(
    name: str,
    pieces: Sequence[tuple[str, FloatArray]],
    joints: Sequence[tuple[int, tuple[float, float, float], Sequence[int]]] = (),
) -> VehicleShape:
    """A shape of pieces, each with the name of its part.

    joints: number, pivot forward, right, up [m], and the pieces carried; inner ones first.
    """
    part = np.concatenate([np.full(len(triangles), PARTS.index(which)) for which, triangles in pieces])
    piece = np.concatenate([np.full(len(triangles), row) for row, (_, triangles) in enumerate(pieces)])
    return VehicleShape(
        name=name,
        triangles=np.concatenate([triangles for _, triangles in pieces]),
        part=part,
        joints=tuple(
            Joint(number=number, pivot=(forward, right, -up), carries=np.isin(piece, carried))
            for number, (forward, right, up), carried in joints
        ),
    )


def _down(triangles: FloatArray) -> FloatArray:
    """Forward, right, up as forward, right, down; the order of corners turns with the handedness."""
    return np.asarray((triangles * [1.0, 1.0, -1.0])[:, ::-1])
