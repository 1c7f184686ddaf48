"""Coefficients of a mixed block from those of its components: one temperature that radiates as their mean.

The temperature of the block is the one whose fourth power is the mean of the components' fourth powers, weighted by
area and emissivity: the block emits what its components emit together, at all wavelengths. Near 290 K radiance in
8-14 um is about as convex in temperature as the fourth power: by it the block would be 0.02 K colder where components
differ by 10 K (standard deviation).
"""

from collections.abc import Mapping

import numpy as np

from sensorsim.materials import WallType, part_reflectance
from sensorsim.tables.orientations import FloatArray


def mix_coefficients(wall: WallType, solved: Mapping[WallType, FloatArray], reflectances: FloatArray) -> FloatArray:
    """Coefficients (t, o, p) [K] of a mixed wall type from those of its parts.

    At each of the reflectances (r,) that the fit goes through, every part has its own, see `part_reflectance`.
    """
    mean = sum(part.share * part.reflectance for part in wall.parts)
    total = sum(part.share * part.wall.emissivity for part in wall.parts)
    powers = solved[wall.parts[0].wall].shape[-1]
    fourth = np.zeros(())
    for part in wall.parts:
        own = np.array([part_reflectance(part.reflectance, mean, float(value)) for value in reflectances])
        temperature = solved[part.wall] @ np.vander(own, powers, increasing=True).T
        fourth = fourth + part.share * part.wall.emissivity / total * temperature**4
    return np.asarray(fourth**0.25 @ np.linalg.pinv(np.vander(reflectances, powers, increasing=True)).T)
