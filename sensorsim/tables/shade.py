"""Shade of any surface from the tables, in NumPy: the twin that the shader is held to.

Section 3.6.2 of [Report1978]: interpolate the coefficients of the standard orientations around the normal, evaluate
the polynomial at the surface's reflectance.
"""

import numpy as np

from sensorsim.tables.coefficients import ShadeTables
from sensorsim.tables.orientations import FloatArray, IntArray


def surface_temperature(
    tables: ShadeTables, normal: FloatArray, wall_type: IntArray, reflectance: FloatArray, time_of_day: float
) -> FloatArray:
    """Surface temperature (m,) [K] for unit normals (m, 3), rows of the wall types (m,) and reflectances (m,)."""
    corner, weight = tables.orientations.locate(normal)
    around = tables.at(time_of_day)[wall_type[:, None], corner]
    coefficient = np.einsum("mk,mkp->mp", weight, around)
    return evaluate_polynomial(coefficient, reflectance)


def evaluate_polynomial(coefficient: FloatArray, argument: FloatArray) -> FloatArray:
    """Value (m,) of polynomials with coefficients (m, p), lowest power first."""
    value = coefficient[:, -1]
    for power in range(coefficient.shape[1] - 2, -1, -1):
        value = value * argument + coefficient[:, power]
    return np.asarray(value)
