"""The scene's surfaces as triangles, and where rays meet them, in double precision.

A ray meets a triangle by Cramer's rule on the corner and the two edges that leave it [MollerTrumbore1997]. Triangles
lie in groups of neighbours with a box around each; a ray tries all boxes at once, then the triangles of those it meets.
The single precision of Embree cannot give a range to a millimetre two kilometres away.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.scene import Scene
from sensorsim.trainer.rotations import FloatArray

EDGE = 1e-9  # barycentric: a ray along the edge of two triangles meets one of them at least
SAME_PLACE = 1e-6  # [m]: meetings closer than this are one, on an edge of two triangles
UNKNOWN_MATERIAL = 0
GROUP = 32  # triangles
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
        corner=corners[:, 0],
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


def _candidates(terrain: Terrain, origin: FloatArray, direction: FloatArray, far: float) -> NDArray[np.intp]:
    """Triangles of the groups whose box a ray meets."""
    slope = np.where(direction == 0.0, 1e-300, direction)  # 0 / 0 must not arise on a box's face
    one, other = (terrain.low - origin) / slope, (terrain.high - origin) / slope
    enter, leave = np.minimum(one, other).max(axis=1), np.maximum(one, other).min(axis=1)
    groups = np.flatnonzero((enter <= leave) & (leave >= 0.0) & (enter <= far))
    triangles = (groups[:, None] * GROUP + np.arange(GROUP)).ravel()
    return triangles[triangles < len(terrain.corner)]


def ray_hits(terrain: Terrain, origin: FloatArray, direction: FloatArray, near: float, far: float) -> list[Hit]:
    """Meetings of a ray, nearest first, at ranges from near to far [m]; direction (3,) of unit length."""
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        tried = _candidates(terrain, origin, direction, far)
        first, second = terrain.first[tried], terrain.second[tried]
        across = np.cross(direction, second)
        volume = np.einsum("ij,ij->i", first, across)
        share = 1.0 / volume
        start = origin - terrain.corner[tried]
        along_first = share * np.einsum("ij,ij->i", start, across)
        turned = np.cross(start, first)
        along_second = share * (turned @ direction)
        distance = share * np.einsum("ij,ij->i", second, turned)
        inside = (along_first >= -EDGE) & (along_second >= -EDGE) & (along_first + along_second <= 1.0 + EDGE)
        met = np.flatnonzero(inside & (volume != 0.0) & (distance >= near) & (distance <= far))
    hits: list[Hit] = []
    for row in met[np.argsort(distance[met], kind="stable")].tolist():
        away, triangle = float(distance[row]), tried[row]
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
