"""The scene's surfaces as triangles, and where rays meet them, in double precision.

A ray meets a triangle by Cramer's rule on the corner and the two edges that leave it [MollerTrumbore1997]; all
triangles are tried at once. The single precision of Embree cannot give a range to a millimetre two kilometres away.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.scene import Scene
from sensorsim.trainer.rotations import FloatArray

EDGE = 1e-9  # barycentric: a ray along the edge of two triangles meets one of them at least
SAME_PLACE = 1e-6  # [m]: meetings closer than this are one, on an edge of two triangles
UNKNOWN_MATERIAL = 0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Terrain:
    """Triangles: corner, two edges and unit normal (t, 3) [m], material code of [Report1978] figure 9 (t,)."""

    corner: FloatArray
    first: FloatArray
    second: FloatArray
    normal: FloatArray
    material: NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Hit:
    """Where a ray met a surface: range along it [m], position (3,) [m], outward unit normal (3,), material code."""

    range: float
    position: FloatArray
    normal: FloatArray
    material: int

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
    corner = triangles[:, 0]
    first, second = triangles[:, 1] - corner, triangles[:, 2] - corner
    across = np.cross(first, second)
    length = np.linalg.norm(across, axis=1)
    solid = length > 0.0
    return Terrain(
        corner=corner[solid],
        first=first[solid],
        second=second[solid],
        normal=across[solid] / length[solid, None],
        material=np.asarray(material)[solid],
    )


def ray_hits(terrain: Terrain, origin: FloatArray, direction: FloatArray, near: float, far: float) -> list[Hit]:
    """Meetings of a ray, nearest first, at ranges from near to far [m]; direction (3,) of unit length."""
    across = np.cross(direction, terrain.second)
    volume = np.einsum("ij,ij->i", terrain.first, across)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        share = 1.0 / volume
        start = origin - terrain.corner
        along_first = share * np.einsum("ij,ij->i", start, across)
        turned = np.cross(start, terrain.first)
        along_second = share * (turned @ direction)
        distance = share * np.einsum("ij,ij->i", terrain.second, turned)
        inside = (along_first >= -EDGE) & (along_second >= -EDGE) & (along_first + along_second <= 1.0 + EDGE)
        met = np.flatnonzero(inside & (volume != 0.0) & (distance >= near) & (distance <= far))
    hits: list[Hit] = []
    for triangle in met[np.argsort(distance[met], kind="stable")].tolist():
        away = float(distance[triangle])
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
    highest_edge = np.maximum(terrain.first[:, 2], terrain.second[:, 2])
    top = 1.0 + float(np.max(terrain.corner[:, 2] + np.maximum(0.0, highest_edge)))
    hits = ray_hits(terrain, np.array([east, north, top]), np.array([0.0, 0.0, -1.0]), 0.0, np.inf)
    return hits[0] if hits else None
