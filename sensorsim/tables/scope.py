"""What a bake has to solve: all that any scene might ask of it, or what one scene shows.

Tables without lobes whose orientations are looked up in triangles need nothing of a wall type but the corners around
its surfaces. Other orientations are then neither solved nor kept: tables of one scene refuse other normals, and what
only other wall types need is NaN. What is kept comes out the same, because a column of the march does not know its
neighbours. A spline, the closest three and lobes are made from all orientations together; there none is spare.

A wall type whose surfaces have fewer reflectances than the settings solve can be solved at those alone, with a
polynomial of a lower degree through all of them. A mixture's parts have others, and so has whatever is a part of one.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.effects import SUNLIGHT, EffectPlan
from sensorsim.environment import Environment
from sensorsim.materials import WallType
from sensorsim.tables.assign import Assignment
from sensorsim.tables.coefficients import least_squares, lookup_orientations, reflectance_powers
from sensorsim.tables.orientations import FloatArray, OrientationSet, orientation_set
from sensorsim.tables.settings import BakeSettings


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scope:
    """Orientations and reflectances to solve of each wall type."""

    lookup: OrientationSet  # that normals are looked up in
    solved: FloatArray  # (o, 3) normals that are solved
    needed: NDArray[np.bool_]  # (w, o) which of them each wall type needs
    reflectances: tuple[tuple[float, ...], ...]  # of each wall type (w), that are solved: one where no light is
    lit: bool  # whether there is light, as far as it is known

    @property
    def columns(self) -> int:
        """Histories to be solved, one for each wall type, orientation and reflectance."""
        return sum(int(row.sum()) * len(own) for row, own in zip(self.needed, self.reflectances, strict=True))

    @property
    def most(self) -> int:
        """Greatest number of reflectances of a wall type."""
        return max((len(own) for own in self.reflectances), default=1)

    def reflectances_of(self, wall_types: Sequence[WallType], part: WallType) -> FloatArray:
        """Reflectances (r,) of a wall type, plain or mixed, that is solved for itself and for mixtures that hold it."""
        if len(set(self.reflectances)) == 1:  # no wall types to compare
            return np.asarray(self.reflectances[0])
        own = [
            self.reflectances[row] for row, wall in enumerate(wall_types) if part == wall or part in plain_walls(wall)
        ]
        return np.asarray(max(own, key=len))

    def of_part(self, wall_types: Sequence[WallType], part: WallType) -> NDArray[np.bool_]:
        """Orientations (o,) of a wall type that is solved, for itself and for mixtures that hold it."""
        if np.all(self.needed):
            return np.ones(self.needed.shape[1], dtype=np.bool_)
        rows = [row for row, wall in enumerate(wall_types) if part in plain_walls(wall)]
        return np.asarray(np.any(self.needed[rows], axis=0))


def plain_walls(wall: WallType) -> tuple[WallType, ...]:
    """The wall types that have to be solved for one: itself, or the parts of a mixture."""
    return tuple(part.wall for part in wall.parts) or (wall,)


def wants_lobes(settings: BakeSettings, scope: Scope, plan: EffectPlan) -> bool:
    """Whether tables have lobes of the sun: where the settings ask for them, there is light and it counts."""
    return settings.lobes > 0.0 and scope.lit and plan.any_of("direct_sun", "sky_glow")


def whole_scope(wall_types: Sequence[WallType], settings: BakeSettings) -> Scope:
    """Everything: tables for any normal and any reflectance."""
    normal = orientation_set(settings.orientations).normal
    return Scope(
        lookup=lookup_orientations(settings),
        solved=normal,
        needed=np.ones((len(wall_types), normal.shape[0]), dtype=np.bool_),
        reflectances=(settings.reflectances,) * len(wall_types),
        lit=True,
    )


def scene_scope(
    environment: Environment, assignment: Assignment, normal: FloatArray, settings: BakeSettings, plan: EffectPlan
) -> Scope:
    """What surfaces of unit normals (s, 3) ask for, as far as the plan leaves out what is spare."""
    scope = whole_scope(assignment.wall_types, settings)
    lookup, solved, needed = scope.lookup, scope.solved, scope.needed
    separate = settings.lobes == 0.0 and settings.interpolation == "barycentric"
    if separate and not plan.has("spare_orientations"):
        lookup = lookup.restrict(normal)
        solved = lookup.normal
        needed = np.zeros((len(assignment.wall_types), solved.shape[0]), dtype=np.bool_)
        corner, _ = lookup.locate(normal)
        needed[assignment.wall_type[:, None], corner] = True
    light = np.any(environment.beam_irradiance > 0.0) or np.any(environment.diffuse_irradiance > 0.0)
    lean = not plan.has("spare_reflectances")
    dark = lean and not (light and plan.any_of(*SUNLIGHT))
    if dark:
        values = (settings.reflectances[:1],) * len(assignment.wall_types)
    else:
        values = shown_reflectances(assignment, settings) if lean else scope.reflectances
    return Scope(lookup=lookup, solved=solved, needed=needed, reflectances=values, lit=not dark)


def shown_reflectances(assignment: Assignment, settings: BakeSettings) -> tuple[tuple[float, ...], ...]:
    """Of each wall type those that its surfaces have, where they are fewer than those of the settings, else those."""
    walls = assignment.wall_types
    mixed = {part for wall in walls if wall.parts for part in plain_walls(wall)}
    found = []
    for row, wall in enumerate(walls):
        own = tuple(np.unique(assignment.reflectance[assignment.wall_type == row]).tolist())
        fewer = 0 < len(own) < len(settings.reflectances) and len(own) <= settings.degree + 1
        found.append(own if fewer and not wall.parts and wall not in mixed else settings.reflectances)
    return tuple(found)


def polynomial_miss(own: Sequence[float], settings: BakeSettings) -> float:
    """How far in reflectance a polynomial reaches for its values at reflectances (a,), at most.

    It is a sum of the solved ones with weights that add up to 1: each weight times how far its reflectance lies off.
    Times what the temperature can change per reflectance, that is what a table of all differs by from a solve there.
    """
    solved = np.asarray(settings.reflectances)
    powers = reflectance_powers(np.asarray(own), settings.degree + 1, settings.knot)
    weight = powers @ least_squares(tuple(solved.tolist()), settings.degree, settings.knot)
    return float(np.max(np.sum(np.abs(weight) * np.abs(np.subtract.outer(own, solved)), axis=1)))
