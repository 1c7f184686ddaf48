"""The planes that surfaces lie in: where a ray meets a surface that is known to be seen there."""

import numpy as np
from numpy.typing import NDArray

from sensorsim.scene import Mesh

FLAT = 1e-3  # [m] that a corner may lie off its surface's plane
Planes = NDArray[np.float64]


def surface_planes(mesh: Mesh, normal: NDArray[np.float64]) -> Planes | None:
    """Rows (s, 8) of surfaces with unit normals (s, 3); None where one of them is not flat.

    normal, height along it of the plane [m], middle of a sphere around the surface [m], its radius [m].
    """
    row = np.zeros((len(normal), 8))
    row[:, :3] = normal
    owner = mesh.surface[mesh.triangle[:, 2]]  # the corner that decides in OpenGL
    corner = mesh.position[mesh.triangle]
    height = np.einsum("tck,tk->tc", corner, normal[owner])
    low, high = np.full(len(normal), np.inf), np.full(len(normal), -np.inf)
    np.minimum.at(low, owner, height.min(axis=1))
    np.maximum.at(high, owner, height.max(axis=1))
    drawn = np.isfinite(low)
    if np.any(high[drawn] - low[drawn] > FLAT):
        return None
    row[drawn, 3] = 0.5 * (low[drawn] + high[drawn])
    lowest, highest = np.full((len(normal), 3), np.inf), np.full((len(normal), 3), -np.inf)
    np.minimum.at(lowest, owner, corner.min(axis=1))
    np.maximum.at(highest, owner, corner.max(axis=1))
    row[drawn, 4:7] = 0.5 * (lowest[drawn] + highest[drawn])
    row[drawn, 7] = 0.5 * np.linalg.norm(highest[drawn] - lowest[drawn], axis=1)
    return row


def triangle_planes(triangles: NDArray[np.float64]) -> Planes:
    """The same of triangles (t, 3, 3) [m], each its own surface, counter-clockwise seen from outside."""
    row = np.zeros((len(triangles), 8))
    across = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    length = np.linalg.norm(across, axis=1, keepdims=True)
    row[:, :3] = across / np.where(length > 0.0, length, 1.0)
    row[:, 3] = np.einsum("tk,tk->t", row[:, :3], triangles[:, 0])
    row[:, 4:7] = triangles.mean(axis=1)
    row[:, 7] = np.linalg.norm(triangles - row[:, None, 4:7], axis=2).max(axis=1)
    return row
