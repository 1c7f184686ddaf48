"""Parts of a vehicle that move against its body: a turret that turns, a gun that rises in it.

A joint carries some of a shape's triangles about a pivot. Its six values are offsets forward, right and down [m] and
roll, pitch and yaw [deg] against its rest, in the axes of the body where nothing else has moved; a gun goes where its
turret takes it, since the turret's joint carries the gun's triangles too.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from sensorsim.trainer.host_state import Part, Triple
from sensorsim.trainer.motion import PART_AXES
from sensorsim.trainer.rotations import FloatArray, attitude

TURRET, GUN = 1, 2  # numbers of Articulated Part Control, in vehicles built in and in models by name

# Of each part that the host has moved: number, whether it is there, and its values in the order of PART_AXES
Posture: TypeAlias = tuple[tuple[int, bool, tuple[float, ...]], ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Joint:
    """An articulated part: its number, pivot in body axes [m], and the triangles (t,) it carries, those of its own
    parts included."""

    number: int
    pivot: Triple
    carries: NDArray[np.bool_]


def posture_of(parts: Mapping[int, Part]) -> Posture:
    """The parts as the host set them, in a form that can be compared."""
    return tuple(
        (number, part.enabled, tuple(part.values.get(axis, 0.0) for axis in PART_AXES))
        for number, part in sorted(parts.items())
    )


def posed(triangles: FloatArray, joints: tuple[Joint, ...], posture: Posture) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Triangles (t, 3, 3) in body axes as a posture has them, and which are there (t,).

    joints: inner ones before those that carry them. A part that is not enabled is gone with all that it carries.
    """
    shown = np.ones(len(triangles), dtype=np.bool_)
    told = {number: (enabled, values) for number, enabled, values in posture}
    moved = triangles
    for joint in joints:
        if joint.number not in told:
            continue
        enabled, (x, y, z, roll, pitch, yaw) = told[joint.number]
        pivot = np.array(joint.pivot)
        carried = (moved[joint.carries] - pivot) @ attitude((yaw, pitch, roll)).T + pivot + np.array([x, y, z])
        moved = moved.copy()
        moved[joint.carries] = carried
        shown &= enabled | ~joint.carries
    return moved, shown
