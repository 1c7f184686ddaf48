"""Relative air mass, for sunlight coming down and for the sky's own radiation alike."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


def relative_air_mass(elevation: FloatArray) -> FloatArray:
    """Air mass [-] relative to the zenith at an apparent elevation [deg]; 37.9 at the horizon [KastenYoung1989].

    Below the horizon the horizon's value is returned: nothing that uses it is lit from there.
    """
    above = np.clip(elevation, 0.0, 90.0)
    return np.asarray(1.0 / (np.sin(np.deg2rad(above)) + 0.50572 * (above + 6.07995) ** -1.6364), dtype=np.float64)
