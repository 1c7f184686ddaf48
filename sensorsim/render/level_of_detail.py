"""The triangles of a renderer's index buffers by the level of detail that its camera calls for.

Buffers are written again only where the choice has changed. What is not shown is left out of the tiles of frames for
display alone; whole frames draw all of their buffer, in which the rest is triangles without area.
"""

from typing import Protocol

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.render.camera import Camera
from sensorsim.render.detail import DetailRule
from sensorsim.render.shown import Cut, families
from sensorsim.scene import Scene

Flags = NDArray[np.bool_]


class Narrowed(Protocol):
    """Tiles that can be made of some of the scene's triangles."""

    def show_only(self, triangles: Flags) -> None:
        """Draw these of the triangles (t,) from now on."""


class LevelOfDetail:
    """What one renderer shows of a scene; of a scene of one level all of it, always."""

    def __init__(self, scene: Scene, size: tuple[int, int], rule: DetailRule, index: moderngl.Buffer | None) -> None:
        """`index`: buffer of the corners of the scene's triangles, in their order."""
        self._scene, self._size, self._rule, self._index = scene, size, rule, index
        self._families = None if scene.lineage is None else families(scene)
        self._cut: Cut | None = None
        self._tiles: Narrowed | None = None  # that hold the present choice

    def look(self, camera: Camera, tiles: Narrowed | None) -> None:
        """Choose for a picture, and tell the buffer and the tiles, if there are any yet."""
        if self._families is None:
            return
        last, rule = self._cut, self._rule
        self._cut = self._families.cut(camera, self._size, rule, last if rule.steady else None)
        changed = last is None or not np.array_equal(last.shown, self._cut.shown)
        if not changed and tiles is self._tiles:
            return
        shown = self._cut.triangles(self._scene)
        if changed and self._index is not None:
            triangle = self._scene.mesh.triangle
            padded = np.zeros(triangle.shape, np.uint32)
            padded[: np.count_nonzero(shown)] = triangle[shown]
            self._index.write(padded)
        if tiles is not None:
            tiles.show_only(shown)
        self._tiles = tiles
