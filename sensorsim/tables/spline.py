"""A smooth surface over the sphere through the values at the standard orientations.

Cubes of the distances to them, as many as there are values, and what is known of the form: constant, linear and
quadratic in the normal, a cone at the zenith and the nadir (a bright or warm horizon, a wall's share of the wind) and
an edge along the horizon (the free film turns over there). Radial functions with a polynomial: [Wendland2005 ch. 8].
"""

from functools import lru_cache

import numpy as np

from sensorsim.tables.orientations import FloatArray, orientation_set

FEW = 26  # orientations, below which only what is constant and linear is taken as known


def dense_layout(solved: str) -> str:
    """The set of orientations, so many that straight lines between them do, to which values at `solved` are led.

    Octahedra have the horizon among the sides of their triangles, where walls face and values have an edge; dense ones
    hold all of the sparser ones, and the corners of a cube, its edges' and faces' middles.
    """
    if solved in ("icosphere642", "icosphere2562"):
        return solved
    return "octahedron1026" if solved in ("octahedron258", "octahedron1026") else "octahedron578"


@lru_cache(maxsize=8)
def spline_matrix(solved: str, dense: str) -> FloatArray:
    """Values (d, o) at the orientations of the set `dense` of the splines through 1 at one of the set `solved`, else 0.

    Where both sets share an orientation the value there is kept.
    """
    known, asked = orientation_set(solved).normal, orientation_set(dense).normal
    inverse = _solved_system(known)
    wanted = np.hstack([_cubes(asked, known), _form(asked)[:, : inverse.shape[0] - known.shape[0]]])
    return np.asarray((wanted @ inverse)[:, : known.shape[0]])


@lru_cache(maxsize=8)
def roughness(solved: str) -> FloatArray:
    """Form A (o, o) of the set `solved`: v A v is the energy of the spline through values v, 0 where all is known."""
    count = orientation_set(solved).normal.shape[0]
    energy = _solved_system(orientation_set(solved).normal)[:count, :count]
    return np.asarray(0.5 * (energy + energy.T))


def _solved_system(known: FloatArray) -> FloatArray:
    """From values at normals (o, 3), then as many zeros as forms are known, to the factors of cubes and forms."""
    size = 11 if known.shape[0] >= FEW else 4
    form = _form(known)[:, :size]
    system = np.block([[_cubes(known, known), form], [form.T, np.zeros((size, size))]])
    return np.asarray(np.linalg.pinv(system))


def _cubes(first: FloatArray, second: FloatArray) -> FloatArray:
    squared = np.maximum(2.0 - 2.0 * first @ second.T, 0.0)
    return np.asarray(squared * np.sqrt(squared))


def _form(normal: FloatArray) -> FloatArray:
    x, y, z = normal.T
    known = (np.ones_like(x), x, y, z, x * y, y * z, x * z, x * x - y * y, z * z, np.hypot(x, y), np.abs(z))
    return np.stack(known, axis=1)
