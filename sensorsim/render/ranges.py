"""How far away what a camera sees can be, at most: from the mesh and the picture's edges, with nothing drawn."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.render.camera import Camera
from sensorsim.scene.mesh import Mesh

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.integer[Any]]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class InView:
    """What of a mesh may be in a picture."""

    surface: NDArray[np.int64]  # (s,) rows of the surfaces, each once
    heights: tuple[float, float]  # lowest and highest of them [m]; 0 where there are none
    longest_range: float  # upper bound of the distance to any of them [m]; 0 where there are none


def in_view(camera: Camera, size: tuple[int, int], mesh: Mesh) -> InView:
    """What may be in a picture of `size`.

    A triangle is out of view where all its corners lie beyond one edge of the picture; of the others the farthest
    corner counts. Looking down all over the picture, no ray goes farther than to the scene's lowest level.
    """
    offset = mesh.position - camera.position
    corner = np.zeros(offset.shape[0], dtype=np.bool_)
    corner[_seen(camera, size, offset, mesh.triangle)] = True
    if not np.any(corner):
        return InView(surface=np.zeros(0, dtype=np.int64), heights=(0.0, 0.0), longest_range=0.0)
    level = mesh.position[corner, 2]
    farthest = float(np.sqrt(np.max(np.einsum("ij,ij->i", offset[corner], offset[corner]))))
    return InView(
        surface=np.flatnonzero(np.bincount(mesh.surface[corner])),
        heights=(float(level.min()), float(level.max())),
        longest_range=min(farthest, _descent(camera, size, float(camera.position[2] - mesh.position[:, 2].min()))),
    )


def _seen(camera: Camera, size: tuple[int, int], offset: FloatArray, triangle: IntArray) -> IntArray:
    """Triangles (s, 3) of which not all corners, `offset` (v, 3) from the camera, lie beyond one edge."""
    forward, right, up = camera.axes()
    width, height = camera.half_extent(size)
    ahead = offset @ forward
    edges = np.zeros(ahead.size, dtype=np.uint8)  # one bit for each edge that a corner lies beyond
    for bit, (axis, half) in enumerate(((right, width), (up, height))):
        place = offset @ axis
        edges |= (place > half * ahead).view(np.uint8) << 2 * bit
        edges |= (-place > half * ahead).view(np.uint8) << 2 * bit + 1
    shared = edges[triangle[:, 0]] & edges[triangle[:, 1]] & edges[triangle[:, 2]]
    return np.asarray(triangle[shared == 0])


def ground_range(camera: Camera, size: tuple[int, int]) -> float:
    """Upper bound [m] of the distance to the ground plane: 0 where no ray goes down, infinite where one goes level."""
    if np.all(_corner_heights(camera, size) >= 0.0):
        return 0.0
    return _descent(camera, size, max(float(camera.position[2]), 0.0))


def half_field(camera: Camera, size: tuple[int, int]) -> float:
    """Greatest angle [rad] between the camera's axis and a ray of the picture: that of its corners."""
    return float(np.arctan(np.hypot(*camera.half_extent(size))))


def _descent(camera: Camera, size: tuple[int, int], drop: float) -> float:
    """Length [m] of the ray that takes longest to go down by `drop` [m]; infinite where one does not go down."""
    # Directions that go down steeper than an angle form a convex cone: the corners of the picture have the flattest.
    flattest = float(-_corner_heights(camera, size).max())
    return max(drop, 0.0) / flattest if flattest > 0.0 else float("inf")


def _corner_heights(camera: Camera, size: tuple[int, int]) -> FloatArray:
    """Upward components (4,) of the unit rays through the picture's corners."""
    corner, right, up = camera.view_rays(size)
    rays = np.array([corner, corner + right, corner + up, corner + right + up])
    return np.asarray(rays[:, 2] / np.linalg.norm(rays, axis=1))
