"""Shade of any surface from the tables, in NumPy: the twin that the shader is held to.

Section 3.6.2 of [Report1978]: interpolate the coefficients of the standard orientations around the normal, evaluate
the polynomial at the surface's reflectance. Tables with lobes add the sun's, each as far as the surface saw it, and
bend the sum back to a temperature (see `straighten`).
"""

import numpy as np

from sensorsim.tables.coefficients import Moment, ShadeTables, reflectance_powers
from sensorsim.tables.lobes import gain_terms
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.tables.straighten import bend_back, tilt_terms
from sensorsim.thermal.convection import wind_share


def surface_temperature(
    tables: ShadeTables,
    normal: FloatArray,
    wall_type: IntArray,
    reflectance: FloatArray,
    time_of_day: float,
    *,
    visibility: FloatArray | None = None,
) -> FloatArray:
    """Surface temperature (m,) [K] for normals (m, 3) of any length, rows of the wall types (m,) and reflectances (m,).

    `visibility` (m, l) [-] is how much of each lobe of that time the surfaces saw; all of it where not given.
    """
    place = tables.orientations.locate(normal)
    unit = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    return shade(tables.at(time_of_day), place, unit, wall_type, reflectance, visibility=visibility)


def shade(
    moment: Moment,
    place: tuple[IntArray, FloatArray],
    normal: FloatArray,
    wall_type: IntArray,
    reflectance: FloatArray,
    *,
    visibility: FloatArray | None = None,
) -> FloatArray:
    """The same (m,) [K] at a moment for unit normals whose `place`, (m, 3) orientations and weights, is known."""
    corner, weight = place
    coefficient = np.einsum("mk,mkp->mp", weight, moment.coefficients[wall_type[:, None], corner])
    facing = np.maximum(normal @ moment.direction.T, 0.0)
    seen = facing if visibility is None else visibility * facing
    rise, gain = moment.weight[wall_type], np.sum(moment.gain[wall_type] * gain_terms(normal), axis=1)
    sun = gain * np.sum(seen * (rise[..., 0] + rise[..., 1] * reflectance[:, None]), axis=1)
    value = evaluate_polynomial(coefficient, reflectance, knot=moment.knot) + sun
    terms = (wind_share(normal, moment.towards[None])[0], *tilt_terms(normal))
    return bend_back(value, moment.level[wall_type], moment.loss[wall_type], terms)


def evaluate_polynomial(coefficient: FloatArray, argument: FloatArray, *, knot: float = 0.0) -> FloatArray:
    """Value (m,) of polynomials with coefficients (m, p), lowest power first, the last one from the knot on."""
    return np.asarray(np.sum(coefficient * reflectance_powers(argument, coefficient.shape[1], knot), axis=1))
