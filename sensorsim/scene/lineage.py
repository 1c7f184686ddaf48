"""Which feature of a coarser level of detail each feature of a finer one stands in.

The sheets of the levels number their features anew [Report1978, figures 3, 5 and 7], so kin is found by place. A
solid belongs to the solid of the next coarser level that covers most of its footprint; where none covers any, to the
nearest one with the same feature identification, if that is no farther away than the coarser level resolves. What is
left has no kin: at the coarser level it is not there at all. Ground planes tile the ground, each level in its own way,
and so belong together, not to each other.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely import union_all
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from sensorsim.scene.features import Feature
from sensorsim.scene.levels import LEVELS, RESOLUTION
from sensorsim.scene.projection import LocalFrame

KINDS = ("root", "ground", "overlap", "near", "none")  # of kin, as in the column `kin`


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Lineage:
    """Of each feature of a scene that holds all its levels of detail, from coarse to fine, a structure of arrays."""

    level: NDArray[np.int64]  # 0 for the coarsest, shape (f,)
    parent: NDArray[np.int64]  # row of the coarser feature that it is a part of, -1 where there is none, shape (f,)
    kin: NDArray[np.str_]  # how the parent was found, one of KINDS, shape (f,)
    apart: NDArray[np.float64]  # distance of the two footprints [m], 0 where they overlap or there is none, shape (f,)

    @property
    def is_ground(self) -> NDArray[np.bool_]:
        """Whether a feature is a plane of the ground (f,)."""
        return np.asarray(self.kin == "ground")

    def childless(self) -> NDArray[np.int64]:
        """Rows of solids above the finest level that no finer feature stands in."""
        held = np.isin(np.arange(self.level.size), self.parent)
        return np.flatnonzero(~held & ~self.is_ground & (self.level < self.level.max()))


def trace(features: Sequence[Sequence[Feature]], frame: LocalFrame) -> Lineage:
    """Lineage of features given level by level, from coarse to fine; rows run through all levels in that order."""
    level = np.repeat(np.arange(len(features)), [len(those) for those in features])
    parent, apart = np.full(level.size, -1, dtype=np.int64), np.zeros(level.size)
    ground = np.array([feature.parts[0].is_plane for those in features for feature in those])
    kin = np.where(ground, "ground", np.where(level == 0, "root", "none")).astype("<U7")
    outline = [_outline(feature, frame) for those in features for feature in those]
    identity = [feature.feature_id for those in features for feature in those]
    for row in np.flatnonzero(~ground & (level > 0)).tolist():
        older = np.flatnonzero(~ground & (level == level[row] - 1)).tolist()
        covered = [outline[row].intersection(outline[one]).area for one in older]
        if max(covered, default=0.0) > 0.0:
            parent[row], kin[row] = older[int(np.argmax(covered))], "overlap"
            continue
        alike = {one: outline[row].distance(outline[one]) for one in older if identity[one] == identity[row]}
        nearest = min(alike, key=lambda one: alike[one], default=-1)
        if alike and alike[nearest] <= RESOLUTION[LEVELS[level[row] - 1]]:
            parent[row], kin[row], apart[row] = nearest, "near", alike[nearest]
    return Lineage(level=level.astype(np.int64), parent=parent, kin=kin, apart=apart)


def _outline(feature: Feature, frame: LocalFrame) -> BaseGeometry:
    """Footprints of all parts of a feature in local metres."""
    metres = frame.metres_from_degrees
    return union_all([Polygon(metres(part.footprint), [metres(hole) for hole in part.holes]) for part in feature.parts])
