"""Haze above the ground: how much of it there is at a height, and on the mean along a straight path.

Up to `MIXED` above the ground its density goes by one exponential, above by another: thick haze is stirred evenly into
the lowest kilometre and all but ends with it, while clear air thins out all the way [LOWTRAN7].
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from sensorsim.errors import InputError

FloatArray = npt.NDArray[np.float64]

MIXED = 1000.0  # [m] up to which the lower exponential holds
SMALL = 1e-2  # argument below which (1 - e^-x) / x and its kin come from their series, in the shader too


@dataclass(frozen=True, slots=True, kw_only=True)
class Haze:
    """Extinction by haze in a band. Raises InputError for one that is negative or not finite."""

    extinction: float  # [m-1] at the ground
    below: float  # [m-1] inverse scale height up to MIXED
    above: float  # [m-1] the same from there on

    def __post_init__(self) -> None:
        for entry in ("extinction", "below", "above"):
            value = getattr(self, entry)
            if not (np.isfinite(value) and value >= 0.0):
                raise InputError("haze", entry, value, "negative or no number", "give a finite one of 0 or more")

    def density(self, height: npt.ArrayLike) -> FloatArray:
        """Density [-] relative to that at the ground, at heights [m]."""
        over = np.asarray(height, dtype=np.float64) - MIXED
        return np.asarray(np.exp(-self.below * (MIXED + np.minimum(over, 0.0)) - self.above * np.maximum(over, 0.0)))

    def mean_density(self, start: npt.ArrayLike, end: npt.ArrayLike) -> FloatArray:
        """Density [-] relative to that at the ground, mean over straight paths between heights [m] that broadcast."""
        first, last = np.broadcast_arrays(np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64))
        rise, mixed = last - first, MIXED - first
        low = mixed > 0.0
        near, far = np.where(low, self.below, self.above), np.where(low, self.above, self.below)
        reach = np.where(low, np.minimum(rise, mixed), np.maximum(rise, mixed))  # on the side of the start
        share = np.where(rise == 0.0, 1.0, reach / np.where(rise == 0.0, 1.0, rise))
        beyond = np.exp(-near * mixed) * mean_decay(far * (rise - reach))
        mean = share * mean_decay(near * reach) + np.where(share < 1.0, (1.0 - share) * beyond, 0.0)
        return np.asarray(self.density(first) * mean)


def mean_decay(x: FloatArray) -> FloatArray:
    """(1 - e^-x) / x, 1 at 0."""
    safe = np.where(np.abs(x) < SMALL, 1.0, x)
    return np.asarray(np.where(np.abs(x) < SMALL, 1.0 - x / 2.0 + x * x / 6.0, -np.expm1(-safe) / safe))


NO_HAZE = Haze(extinction=0.0, below=0.0, above=0.0)
