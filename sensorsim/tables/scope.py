"""What a bake has to solve: all that any scene might ask of it, or what one scene shows.

What is left out is not solved and holds no number: tables of one scene refuse other normals, and so a wall type's
orientations that only other wall types need are NaN. What is kept comes out the same to the last bit, because a column
of the march does not know its neighbours.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.effects import EffectPlan
from sensorsim.materials import WallType
from sensorsim.tables.assign import Assignment
from sensorsim.tables.orientations import FloatArray, OrientationSet, orientation_set
from sensorsim.tables.settings import BakeSettings

SAME = 1e-9  # reflectances that are this close are one


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scope:
    """Orientations and reflectances to solve of each wall type."""

    orientations: OrientationSet
    needed: NDArray[np.bool_]  # (w, o) orientations of each wall type
    reflectances: tuple[tuple[float, ...], ...]  # (w) of each wall type, those of the settings or some of them

    @property
    def columns(self) -> int:
        """Histories to be solved, one for each wall type, orientation and reflectance."""
        return sum(int(row.sum()) * len(values) for row, values in zip(self.needed, self.reflectances, strict=True))

    def of_part(self, wall_types: Sequence[WallType], part: WallType) -> tuple[NDArray[np.bool_], tuple[float, ...]]:
        """Orientations (o,) and reflectances of a wall type, for itself and for mixtures that hold it."""
        rows = [row for row, wall in enumerate(wall_types) if part in plain_walls(wall)]
        return np.any(self.needed[rows], axis=0), max((self.reflectances[row] for row in rows), key=len)


def plain_walls(wall: WallType) -> tuple[WallType, ...]:
    """The wall types that have to be solved for one: itself, or the parts of a mixture."""
    return tuple(part.wall for part in wall.parts) or (wall,)


def whole_scope(wall_types: Sequence[WallType], settings: BakeSettings) -> Scope:
    """Everything: tables for any normal and any reflectance."""
    orientations = orientation_set(settings.orientations)
    return Scope(
        orientations=orientations,
        needed=np.ones((len(wall_types), orientations.normal.shape[0]), dtype=np.bool_),
        reflectances=(settings.reflectances,) * len(wall_types),
    )


def scene_scope(
    assignment: Assignment, normal: FloatArray, settings: BakeSettings, plan: EffectPlan, *, lit: bool
) -> Scope:
    """What surfaces of unit normals (s, 3) ask for, as far as the plan leaves out what is spare.

    Of the reflectances those are spare that no surface has, where all its own are among those of the settings and the
    polynomial goes through them; without sunlight (`lit`) all but one are.
    """
    scope = whole_scope(assignment.wall_types, settings)
    orientations, needed = scope.orientations, scope.needed
    if not plan.has("spare_orientations"):
        orientations = orientations.restrict(normal)
        needed = np.zeros((len(assignment.wall_types), orientations.normal.shape[0]), dtype=np.bool_)
        corner, _ = orientations.locate(normal)
        needed[assignment.wall_type[:, None], corner] = True
    values = scope.reflectances
    if not plan.has("spare_reflectances"):
        values = tuple(
            settings.reflectances[:1] if not lit else _own(assignment, row, settings) for row in range(len(values))
        )
    return Scope(orientations=orientations, needed=needed, reflectances=values)


def _own(assignment: Assignment, row: int, settings: BakeSettings) -> tuple[float, ...]:
    """The settings' reflectances that the surfaces of a wall type have; all where one of theirs is not among them."""
    own = assignment.reflectance[assignment.wall_type == row]
    nodes = np.asarray(settings.reflectances)
    near = np.abs(own[:, None] - nodes) < SAME
    exact = settings.degree == nodes.size - 1 and bool(np.all(np.any(near, axis=1)))
    if assignment.wall_types[row].parts or not exact or own.size == 0:
        return settings.reflectances
    return tuple(np.asarray(nodes[np.any(near, axis=0)]).tolist())
