"""A variable in which a wall's temperature answers the sun in proportion.

The warmer a face, the more it loses per kelvin, by radiation and free convection: its temperature is concave in what
it absorbs, by 15 K of 65 for an insulated roof in still air. Of x kelvin above a level, x + b x^2 is all but straight,
with one b for each wall type and time, for all orientations and reflectances. Lobes add up in it, and fewer powers of
the reflectance do.
"""

import numpy as np

from sensorsim.tables.coefficients import least_squares
from sensorsim.tables.orientations import FloatArray

MOST_BEND = 0.05  # [K-1]
WEAK = 25.0  # [K2] curvature of x^2 in reflectance below which too little sun tells what b is


def fit_bend(temperature: FloatArray, reflectances: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Level (t,) [K] and bend b (t,) [K-1] of temperatures (t, o, r) [K] at reflectances (r,).

    Least squares of the second-order term in reflectance; without three reflectances nothing is bent.
    """
    level = temperature.min(axis=(1, 2))
    if reflectances.size < 3:
        return level, np.zeros_like(level)
    above = temperature - level[:, None, None]
    second = least_squares(tuple(reflectances.tolist()), 2)[2]
    own, square = above @ second, above**2 @ second
    bend = -np.sum(own * square, axis=1) / (np.sum(square**2, axis=1) + WEAK**2 * square.shape[1])
    return level, np.clip(bend, 0.0, MOST_BEND)


def straighten(temperature: FloatArray, level: FloatArray, bend: FloatArray) -> FloatArray:
    """Straightened values [K] of temperatures [K], all of shapes that go together."""
    above = temperature - level
    return np.asarray(above + bend * above**2)


def bend_back(value: FloatArray, level: FloatArray, bend: FloatArray) -> FloatArray:
    """Temperatures [K] of straightened values [K]."""
    root = np.sqrt(np.maximum(1.0 + 4.0 * bend * value, 0.0))
    return np.asarray(level + 2.0 * value / (1.0 + root))
