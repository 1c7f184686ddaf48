"""What one part of a picture does to others: capacitors that forget a channel's level, and halos of bright lights.

A channel of a parallel scan is coupled by a capacitor: what it reports lacks the level that it has settled to,
b = sum_k a^k L_-k over the sweep behind it, a = exp(-dwell 2 pi f) per element, and a hot object leaves a dark streak
[Lloyd1975]. The level of the whole picture is restored. In an intensifier a share of the light above saturation comes
back as a disc of fixed size [Thomas2005]. The NumPy twin of shaders/sensor/block_mean.frag, baseline.frag, halo.frag.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import convolve

from sensorsim.radiometry import FloatArray
from sensorsim.sensor.sensor import Sensor

IntArray = NDArray[np.int64]

STREAK_BLOCK = 16  # elements along a row that share a level
HALO_BLOCK = 4  # elements to either side of which excess is joined


def kept_per_block(sensor: Sensor, field: float, size: tuple[int, int]) -> float:
    """Share of a channel's level [-] left a block later, over a horizontal field [rad]; 0 without capacitors."""
    rate = sensor.scan.sweep_rate(field, size[1])
    if rate <= 0.0 or sensor.scan.ac_coupling <= 0.0:
        return 0.0
    dwell = field / size[0] / rate
    return math.exp(-2.0 * math.pi * sensor.scan.ac_coupling * dwell * STREAK_BLOCK)


def halo_radius(sensor: Sensor, field: float, width: int) -> float:
    """Radius of the halo [blocks of HALO_BLOCK elements] of `width` over a horizontal field [rad]; 0 without."""
    if sensor.intensifier is None:
        return 0.0
    return max(1.0, sensor.intensifier.halo_radius * width / (field * HALO_BLOCK))


def block_mean(light: NDArray[Any], width: int, height: int) -> FloatArray:
    """Means of blocks; those at the right and at the top, where rows are counted from, may be smaller."""
    total = _sums(_sums(light[::-1].T, height).T, width)
    number = [_sums(np.ones((1, count)), extent)[0] for count, extent in zip(light.shape, (height, width), strict=True)]
    return np.asarray((total / np.outer(*number))[::-1])


def _sums(values: NDArray[Any], extent: int) -> NDArray[Any]:
    """Sums of `extent` neighbours along the rows, of what is left at their ends."""
    if extent == 1:
        return values
    rows, columns = values.shape
    padded = values if columns % extent == 0 else np.pad(values, ((0, 0), (0, -columns % extent)))
    return np.asarray(padded.reshape(rows, -1, extent).sum(axis=2, dtype=np.float64))


def baseline(light: NDArray[Any], kept: float) -> FloatArray:
    """Level (height, blocks) [W m-2 sr-1] that channels have settled to."""
    blocks = block_mean(light, STREAK_BLOCK, 1)
    place = np.arange(blocks.shape[1])
    weight = kept ** ((place[None, :] - place[:, None]) % place.size)  # of a block in what is left at another
    return np.asarray(blocks @ (weight / weight[0].sum()))


def halo(light: NDArray[Any], full: float, share: float, radius: float) -> FloatArray:
    """Halo (blocks, blocks) [W m-2 sr-1] of what lies above `full`, over a disc of `radius` blocks."""
    excess = block_mean(np.maximum(light - full, 0.0), HALO_BLOCK, HALO_BLOCK)
    line = np.arange(-int(radius), int(radius) + 1)
    disc = (line[:, None] ** 2 + line[None, :] ** 2 <= radius**2).astype(np.float64)
    return np.asarray(share * convolve(excess, disc / disc.sum(), mode="constant"))


def spread_blocks(blocks: FloatArray, size: tuple[int, int], width: int, height: int) -> FloatArray:
    """Values of blocks at each element (height, width), straight between their middles; rows are counted from below."""
    rows = blocks_by_row(blocks, size[1], height)
    left, share = block_places(size[0], blocks.shape[1], width)
    right = np.minimum(left + 1, blocks.shape[1] - 1)
    return np.asarray(rows[:, left] * (1.0 - share) + rows[:, right] * share)


def blocks_by_row(blocks: FloatArray, rows: int, height: int) -> FloatArray:
    """Values of blocks at each of `rows` rows (rows, blocks), straight between the middles of blocks of a height."""
    low, share = block_places(rows, blocks.shape[0], height)
    high, flipped = np.minimum(low + 1, blocks.shape[0] - 1), blocks[::-1]
    return np.asarray((flipped[low] * (1.0 - share[:, None]) + flipped[high] * share[:, None])[::-1])


def block_places(count: int, blocks: int, extent: int) -> tuple[IntArray, FloatArray]:
    """For each of `count` elements the block whose middle lies before it, and how far it is to the next one's."""
    place = np.clip((np.arange(count) + 0.5) / extent - 0.5, 0.0, blocks - 1.0)
    low = np.minimum(place.astype(np.int64), max(blocks - 2, 0))
    return low, place - low
