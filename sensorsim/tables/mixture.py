"""A mixed block from its components: one temperature that radiates as their mean.

The temperature of the block is the one whose fourth power is the mean of the components' fourth powers, weighted by
area and emissivity: the block emits what its components emit together, at all wavelengths. Near 290 K radiance in
8-14 um is about as convex in temperature as the fourth power: by it the block would be 0.02 K colder where components
differ by 10 K (standard deviation).
"""

from collections.abc import Sequence

import numpy as np

from sensorsim.materials import WallType, part_reflectances
from sensorsim.tables.orientations import FloatArray


def mixed_reflectances(wall: WallType, reflectances: FloatArray) -> FloatArray:
    """Solar reflectances (parts, r) of the components of a mixed wall type where it has `reflectances` (r,)."""
    own, share = [part.reflectance for part in wall.parts], [part.share for part in wall.parts]
    return part_reflectances(own, share, reflectances)


def mix_temperatures(wall: WallType, temperature: Sequence[FloatArray]) -> FloatArray:
    """Temperature [K] of a mixed wall type from those of its components, each of the same shape."""
    shares = _emitting_shares(wall)
    fourth = sum(share * part**4 for share, part in zip(shares, temperature, strict=True))
    return np.asarray(fourth**0.25)


def mix_rises(wall: WallType, temperature: Sequence[FloatArray], rise: Sequence[FloatArray]) -> FloatArray:
    """Small rise [K] of a mixed wall type's temperature from the rises of its components at their temperatures [K]."""
    mixed = mix_temperatures(wall, temperature)
    shares = _emitting_shares(wall)
    parts = zip(shares, temperature, rise, strict=True)
    return np.asarray(sum(share * (own / mixed) ** 3 * part for share, own, part in parts))


def _emitting_shares(wall: WallType) -> list[float]:
    """What each component emits over what the block does, at one temperature [-]."""
    total = sum(part.share * part.wall.emissivity for part in wall.parts)
    return [part.share * part.wall.emissivity / total for part in wall.parts]
