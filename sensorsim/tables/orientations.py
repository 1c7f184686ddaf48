"""Standard orientations: normals for which histories are solved, and where any other normal lies among them.

A set is a triangulated sphere. A normal is interpolated from the corners of the spherical triangle that holds it:
section 3.6.2 of [Report1978] takes the three closest, which jumps where the third changes; the triangle does not,
because on an edge only the edge's two corners count. Weights are the normal's coordinates along the three corners,
scaled to sum to one. Octahedral sets have the horizon and four meridians among the sides of their triangles.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from sensorsim.errors import InputError

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]

LAYOUTS = (
    "report10", "report26", "icosphere42", "icosphere162", "icosphere642", "icosphere2562",
    "octahedron18", "octahedron38", "octahedron66", "octahedron102", "octahedron146", "octahedron258", "octahedron578",
    "octahedron1026",
)  # fmt: skip
SCHEMES = ("barycentric", "closest")
OUTSIDE = 1e-6  # how far beyond a triangle's edges a normal may lie by rounding
ALIKE = 1e-12  # coordinates that differ by rounding, for normals of about unit length
IN_CACHE = 1 << 15  # products of normals and triangles at a time
NEAREST = 1e-6  # [-] squared distance at which one of the closest three takes all


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OrientationSet:
    """Normals on the unit sphere with their Delaunay triangles."""

    name: str
    normal: FloatArray  # (o, 3) unit
    triangle: IntArray  # (t, 3) corners
    inverse: FloatArray  # (t, 3, 3) rows give a direction's coordinates along the three corners
    scheme: str = "barycentric"  # one of SCHEMES

    def locate(self, normal: FloatArray) -> tuple[IntArray, FloatArray]:
        """Orientations (m, 3) around normals (m, 3) of any length and their weights (m, 3), which sum to one.

        By the scheme `barycentric` these are the corners of the triangle that holds the normal, by `closest` the three
        closest, as in the report, each by the inverse of its squared distance. Raises InputError for a normal without
        direction: zero, NaN or infinite.
        """
        undirected = ~(np.all(np.isfinite(normal), axis=1) & np.any(normal != 0.0, axis=1))
        if np.any(undirected):
            row = int(np.argmax(undirected))
            problem = f"the normal of row {row} has no direction"
            raise InputError(self.name, "normal", normal[row].tolist(), problem, "mend the surface")
        if self.scheme == "closest":
            return self._closest(_unit(normal))
        corner = np.zeros((normal.shape[0], 3), dtype=np.int64)
        weight = np.zeros((normal.shape[0], 3))
        along = np.ascontiguousarray(self.inverse.transpose(1, 2, 0))  # products of matrices: cities have many normals
        parts = max(1, normal.shape[0] * self.triangle.shape[0] // IN_CACHE)
        for rows in np.array_split(np.arange(normal.shape[0]), parts):
            least = np.minimum.reduce([normal[rows] @ one for one in along])  # (m, t)
            close = least >= least.max(axis=1, keepdims=True) - ALIKE
            best = np.argmax(close, axis=1)  # the first, so that rounding decides nothing where triangles meet
            held = np.einsum("mij,mj->mi", self.inverse[best], normal[rows])
            if np.any(held < -OUTSIDE * np.linalg.norm(normal[rows], axis=1, keepdims=True)):
                lost = normal[rows][np.argmin(held.min(axis=1))].round(4).tolist()
                problem, remedy = f"not among the orientations of {self.name} that were solved", "bake all effects"
                raise InputError("tables", "normal", lost, problem, remedy)
            inside = np.maximum(held, 0.0)
            corner[rows] = self.triangle[best]
            weight[rows] = inside / inside.sum(axis=1, keepdims=True)
        return corner, weight

    def restrict(self, normal: FloatArray) -> "OrientationSet":
        """The triangles that hold unit normals (m, 3), and their corners alone; other normals are refused."""
        corner, _ = self.locate(normal)
        held = np.unique(corner)
        place = np.full(self.normal.shape[0], -1, dtype=np.int64)
        place[held] = np.arange(held.size)
        kept = np.isin(self.triangle, held).all(axis=1)
        return OrientationSet(
            name=self.name,
            normal=self.normal[held],
            triangle=place[self.triangle[kept]],
            inverse=self.inverse[kept],
            scheme=self.scheme,
        )

    def _closest(self, normal: FloatArray) -> tuple[IntArray, FloatArray]:
        squared = np.maximum(2.0 - 2.0 * normal @ self.normal.T, 0.0)
        corner = np.argsort(squared, axis=1, kind="stable")[:, :3]
        weight = 1.0 / np.maximum(np.take_along_axis(squared, corner, axis=1), NEAREST)
        return corner, weight / weight.sum(axis=1, keepdims=True)


@lru_cache(maxsize=8)
def orientation_set(name: str) -> OrientationSet:
    """The named set; `report26` are a cube's faces, edges and corners, `report10` eight azimuths, up and down."""
    if name not in LAYOUTS:
        raise InputError("bake settings", "orientations", name, "unknown layout", f"use one of {', '.join(LAYOUTS)}")
    count = int(name.lstrip("abcdehiknoprst"))
    kinds = {"icosphere": _icosphere, "octahedron": _octahedron, "report": _report_set}
    normal = kinds[name[: -len(str(count))]](count)
    triangle = _outward(ConvexHull(normal).simplices.astype(np.int64), normal)
    inverse = np.linalg.inv(np.swapaxes(normal[triangle], 1, 2))
    return OrientationSet(name=name, normal=normal, triangle=triangle, inverse=inverse)


def _report_set(count: int) -> FloatArray:
    if count == 10:
        azimuth = np.radians(np.arange(8) * 45.0)
        walls = np.stack([np.sin(azimuth), np.cos(azimuth), np.zeros(8)], axis=1)
        return np.vstack([walls, [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]])
    steps = np.array([-1.0, 0.0, 1.0])
    cube = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    return _unit(cube[np.any(cube != 0.0, axis=1)])


def _icosphere(count: int) -> FloatArray:
    """Icosahedron with one vertex up, its triangles split into four until there are `count` vertices."""
    ring = np.radians(np.arange(5) * 72.0)
    low = np.arctan(0.5)
    upper = np.stack([np.cos(low) * np.sin(ring), np.cos(low) * np.cos(ring), np.full(5, np.sin(low))], axis=1)
    turned = ring + np.radians(36.0)
    lower = np.stack([np.cos(low) * np.sin(turned), np.cos(low) * np.cos(turned), np.full(5, -np.sin(low))], axis=1)
    normal = np.vstack([[[0.0, 0.0, 1.0]], upper, lower, [[0.0, 0.0, -1.0]]])
    while normal.shape[0] < count:
        triangle = ConvexHull(normal).simplices
        edge = np.unique(np.sort(triangle[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
        normal = np.vstack([normal, _unit(normal[edge].sum(axis=1))])
    return normal


def _octahedron(count: int) -> FloatArray:
    """Octahedron with corners up, down and along the axes, its edges split into so many that there are `count`."""
    parts = round(np.sqrt((count - 2) / 4))
    steps = np.arange(-parts, parts + 1)
    grid = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    on_face = grid[np.abs(grid).sum(axis=1) == parts] / parts
    return _unit(np.sin(on_face * (0.5 * np.pi)))  # the sine spaces them evenly along the axes' circles


def _outward(triangle: IntArray, normal: FloatArray) -> IntArray:
    """Corners counter-clockwise seen from outside, triangles in a fixed order."""
    corner = normal[triangle]
    flipped = np.linalg.det(corner) < 0.0
    triangle = np.where(flipped[:, None], triangle[:, ::-1], triangle)
    first = np.argmin(triangle, axis=1)
    turned = np.take_along_axis(triangle, (first[:, None] + np.arange(3)) % 3, axis=1)
    return np.asarray(turned[np.lexsort(turned.T[::-1])], dtype=np.int64)


def _unit(vector: FloatArray) -> FloatArray:
    return np.asarray(vector / np.linalg.norm(vector, axis=-1, keepdims=True))
