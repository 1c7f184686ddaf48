"""Random numbers that are the same on every device: a hash of place, frame and seed, and deviates that it chooses.

The twin of shaders/common/random.glsl, bit for bit. pcg4d of [Jarzynski2020] scrambles four whole numbers; the top 12
bits of the first choose one of 4096 equally likely deviates of unit variance, the largest 3.67.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from sensorsim.radiometry import FloatArray

DEVIATES = 4096
_SHIFT = np.uint32(20)  # 32 bits less those that count the deviates


@cache
def deviate_table() -> FloatArray:
    """The deviates (DEVIATES,), quantiles of the normal distribution scaled to unit variance; not to be written to."""
    quantile = ndtri((np.arange(DEVIATES) + 0.5) / DEVIATES)
    table = np.asarray(quantile / np.sqrt(np.mean(quantile**2)))
    table.flags.writeable = False
    return table


def place_rank(column: NDArray[np.integer], row: NDArray[np.integer], seed: int) -> NDArray[np.uint32]:
    """Whole numbers at columns and rows, broadcast against each other, in a random order: few are alike."""
    return _hash(column, row, 0, seed)


def normal_deviate(column: NDArray[np.integer], row: NDArray[np.integer], frame: int, seed: int) -> FloatArray:
    """Deviates at columns and rows, broadcast against each other, of one frame and seed; numbers below 2^32."""
    return np.asarray(deviate_table()[_hash(column, row, frame, seed) >> _SHIFT])


def _hash(column: NDArray[np.integer], row: NDArray[np.integer], frame: int, seed: int) -> NDArray[np.uint32]:
    parts = np.broadcast_arrays(column, row, np.uint32(frame), np.uint32(seed))
    x, y, z, w = (part.astype(np.uint32) * np.uint32(1664525) + np.uint32(1013904223) for part in parts)
    for last in (False, True):
        x = x + y * w
        y = y + z * x
        z = z + x * y
        w = w + y * z
        if not last:
            x, y, z, w = (part ^ (part >> np.uint32(16)) for part in (x, y, z, w))
    return np.asarray(x)
