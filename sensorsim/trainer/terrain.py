"""The scene's surfaces as triangles, and where rays meet them, in double precision.

Triangles lie in groups of neighbours with a box around each; a ray tries all boxes, then what is in those it meets.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.scene import Scene
from sensorsim.trainer.ray_kernel import GROUP, meetings
from sensorsim.trainer.rotations import FloatArray

SAME_PLACE = 1e-6  # [m]: meetings closer than this are one, on an edge of two triangles
UNKNOWN_MATERIAL = 0
MARGIN = 1e-6  # [m] around a box, for rays along its faces


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Terrain:
    """Triangles: corner, two edges and unit normal (t, 3) [m], material code of [Report1978] figure 9 (t,).

    low, high (g, 3) [m]: boxes around groups of `GROUP` triangles, in their order.
    """

    corner: FloatArray
    first: FloatArray
    second: FloatArray
    normal: FloatArray
    material: NDArray[np.int64]
    low: FloatArray
    high: FloatArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Hit:
    """Where a ray met a surface: range along it [m], position (3,) [m], outward unit normal (3,), material code.

    entity: whose surface it is, None for the terrain.
    """

    range: float
    position: FloatArray
    normal: FloatArray
    material: int
    entity: int | None = None

    @property
    def height(self) -> float:
        """Height above the scene's ground [m]."""
        return float(self.position[2])


def build_terrain(scene: Scene) -> Terrain:
    """The terrain of a scene: every surface of its mesh. Material code 0 where a class decides the section."""
    words = scene.surfaces.word[scene.mesh.surface[scene.mesh.triangle[:, 0]]]
    materials = np.array([int(word[:2]) if word else UNKNOWN_MATERIAL for word in words.tolist()], dtype=np.int64)
    return terrain_from_triangles(scene.mesh.position[scene.mesh.triangle], materials)


def terrain_from_triangles(triangles: FloatArray, material: NDArray[np.int64]) -> Terrain:
    """Terrain of triangles (t, 3, 3) [m], counter-clockwise seen from outside, with their material codes (t,)."""
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(across, axis=1)
    kept = np.flatnonzero(length > 0.0)
    kept = kept[_by_neighbourhood(triangles[kept].mean(axis=1))]
    corners, starts = triangles[kept], np.arange(0, len(kept), GROUP)
    none = np.zeros((0, 3))
    return Terrain(
        corner=np.ascontiguousarray(corners[:, 0]),
        first=corners[:, 1] - corners[:, 0],
        second=corners[:, 2] - corners[:, 0],
        normal=across[kept] / length[kept, None],
        material=np.asarray(material)[kept],
        low=np.minimum.reduceat(corners.min(axis=1), starts) - MARGIN if len(kept) else none,
        high=np.maximum.reduceat(corners.max(axis=1), starts) + MARGIN if len(kept) else none,
    )


def _by_neighbourhood(middle: FloatArray) -> NDArray[np.intp]:
    """Order in which triangles that follow each other lie near each other: strips of the map, up and down in turn."""
    count = max(1, round((len(middle) / GROUP) ** 0.5))
    strip = np.zeros(len(middle), dtype=np.int64)
    strip[np.argsort(middle[:, 0], kind="stable")] = np.arange(len(middle)) * count // max(1, len(middle))
    along = np.where(strip % 2 == 0, middle[:, 1], -middle[:, 1])
    return np.asarray(np.lexsort((along, strip)))


def ray_hits(terrain: Terrain, origin: FloatArray, direction: FloatArray, near: float, far: float) -> list[Hit]:
    """Meetings of a ray, nearest first, at ranges from near to far [m]; direction (3,) of unit length."""
    found, ranges = meetings(
        terrain.corner, terrain.first, terrain.second, terrain.low, terrain.high,
        np.ascontiguousarray(origin), np.ascontiguousarray(direction), float(near), float(far),
    )  # fmt: skip
    hits: list[Hit] = []
    for row in np.argsort(ranges, kind="stable").tolist():
        away, triangle = float(ranges[row]), int(found[row])
        if hits and away - hits[-1].range <= SAME_PLACE:
            continue
        hits.append(
            Hit(
                range=away,
                position=origin + away * direction,
                normal=terrain.normal[triangle],
                material=int(terrain.material[triangle]),
            )
        )
    return hits


def height_of_terrain(terrain: Terrain, east: float, north: float) -> Hit | None:
    """The highest surface at a place, None where there is none; its range is not used."""
    if terrain.corner.size == 0:
        return None
    top = 1.0 + float(terrain.high[:, 2].max())
    hits = ray_hits(terrain, np.array([east, north, top]), np.array([0.0, 0.0, -1.0]), 0.0, np.inf)
    return hits[0] if hits else None
