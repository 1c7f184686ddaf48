"""Which features of a scene that holds all its levels of detail are in a picture: a cut through their lineage.

A feature gives way to the finer ones that stand in it as soon as its level would miss more than the rule allows, seen
at the distance of the nearest of them all. A solid without kin at the coarser level is what that level misses, by its
own size. The ground changes level as a whole, since its planes tile it in another way at each.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.render.camera import Camera
from sensorsim.render.detail import DetailRule, box_distance, choose_detail, pixel_angle
from sensorsim.scene import Lineage, Scene

Flags = NDArray[np.bool_]
FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Cut:
    """What is shown, and what a later cut has to know so that nothing flickers."""

    shown: Flags  # (f,)
    wanted: NDArray[np.int64]  # (f,) level that the place of each feature calls for
    open: Flags  # (f,) whether it, or what is finer, is shown

    def triangles(self, scene: Scene) -> Flags:
        """Which triangles of the scene's mesh are shown (t,)."""
        surface = scene.mesh.surface[scene.mesh.triangle[:, 0]]
        return self.shown[scene.surfaces.feature[surface]]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Families:
    """Boxes around each feature and all that is finer in it, or around all of the ground."""

    lineage: Lineage
    lowest: FloatArray  # (f, 3) [m]
    highest: FloatArray  # (f, 3) [m]
    size: FloatArray  # (f,) diagonal of each feature's own box [m]

    def cut(self, camera: Camera, size: tuple[int, int], rule: DetailRule, last: Cut | None = None) -> Cut:
        """What a picture of `size` (width, height) shows, near the border between two levels as in the `last` one."""
        lineage, angle = self.lineage, pixel_angle(camera, size)
        distance = box_distance(camera.position, self.lowest, self.highest)
        wanted = choose_detail(distance, angle, rule, None if last is None else last.wanted)
        allowed = rule.pixels * angle * distance
        if last is not None:
            allowed = np.where(last.open, allowed * (1.0 - rule.band), allowed)
        alone = np.where(lineage.is_ground, wanted >= lineage.level, self.size > allowed) | (lineage.level == 0)
        open_ = np.zeros(wanted.size, dtype=np.bool_)
        for level in range(int(lineage.level.max()) + 1):  # a coarser one decides first
            rows = np.flatnonzero(lineage.level == level)
            above = lineage.parent[rows]
            open_[rows] = np.where(above < 0, alone[rows], open_[above] & (wanted[above] >= level))
        return Cut(shown=open_ & (wanted <= lineage.level), wanted=wanted, open=open_)


def families(scene: Scene) -> Families:
    """Boxes of a scene with all its levels; InputError for any other scene."""
    lineage = scene.lineage
    if lineage is None:
        raise InputError(scene.name, "level", scene.level, "holds no other level to choose from", "load all levels")
    feature = scene.surfaces.feature[scene.mesh.surface]
    lowest, highest = np.full((lineage.level.size, 3), np.inf), np.full((lineage.level.size, 3), -np.inf)
    np.minimum.at(lowest, feature, scene.mesh.position)
    np.maximum.at(highest, feature, scene.mesh.position)
    size = np.linalg.norm(highest - lowest, axis=1)
    for level in range(int(lineage.level.max()), 0, -1):
        rows = np.flatnonzero((lineage.level == level) & (lineage.parent >= 0))
        np.minimum.at(lowest, lineage.parent[rows], lowest[rows])
        np.maximum.at(highest, lineage.parent[rows], highest[rows])
    ground = lineage.is_ground
    lowest[ground], highest[ground] = lowest[ground].min(axis=0), highest[ground].max(axis=0)
    return Families(lineage=lineage, lowest=lowest, highest=highest, size=size)
