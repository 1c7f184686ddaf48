"""What one part of a picture does to others: capacitors that forget a channel's level, and halos of bright lights.

A channel of a parallel scan is coupled by a capacitor: what it reports lacks the level that it has settled to,
b = sum_k a^k L_-k over the sweep behind it, a = exp(-dwell 2 pi f) per element, and a hot object leaves a dark streak
[Lloyd1975]. The level of the whole picture is restored. In an intensifier a share of the light above saturation comes
back as a disc of fixed size [Thomas2005]. The NumPy twin of shaders/sensor/block_mean.frag, baseline.frag, halo.frag.
"""

import math

import numpy as np
from scipy.ndimage import convolve

from sensorsim.radiometry import FloatArray
from sensorsim.sensor.sensor import Sensor

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


def block_mean(light: FloatArray, width: int, height: int) -> FloatArray:
    """Means of blocks; those at the right and at the top, where rows are counted from, may be smaller."""
    rows, columns = -(-light.shape[0] // height), -(-light.shape[1] // width)
    flipped, means = light[::-1], np.zeros((rows, columns))
    for row in range(rows):
        for column in range(columns):
            part = flipped[row * height : (row + 1) * height, column * width : (column + 1) * width]
            means[row, column] = part.mean()
    return means[::-1]


def baseline(light: FloatArray, kept: float) -> FloatArray:
    """Level (height, blocks) [W m-2 sr-1] that channels have settled to."""
    blocks = block_mean(light, STREAK_BLOCK, 1)
    count = blocks.shape[1]
    weight = kept ** np.arange(count)
    return np.asarray(sum(w * np.roll(blocks, back, axis=1) for back, w in enumerate(weight)) / weight.sum())


def halo(light: FloatArray, full: float, share: float, radius: float) -> FloatArray:
    """Halo (blocks, blocks) [W m-2 sr-1] of what lies above `full`, over a disc of `radius` blocks."""
    excess = block_mean(np.maximum(light - full, 0.0), HALO_BLOCK, HALO_BLOCK)
    line = np.arange(-int(radius), int(radius) + 1)
    disc = (line[:, None] ** 2 + line[None, :] ** 2 <= radius**2).astype(np.float64)
    return np.asarray(share * convolve(excess, disc / disc.sum(), mode="constant"))


def spread_blocks(blocks: FloatArray, size: tuple[int, int], width: int, height: int) -> FloatArray:
    """Values of blocks at each element (height, width), straight between their middles; rows are counted from below."""
    x = np.clip((np.arange(size[0]) + 0.5) / width - 0.5, 0.0, blocks.shape[1] - 1.0)
    y = np.clip((np.arange(size[1]) + 0.5) / height - 0.5, 0.0, blocks.shape[0] - 1.0)
    flipped = blocks[::-1]
    left, low = (
        np.minimum(x.astype(int), max(blocks.shape[1] - 2, 0)),
        np.minimum(y.astype(int), max(blocks.shape[0] - 2, 0)),
    )
    right, high = np.minimum(left + 1, blocks.shape[1] - 1), np.minimum(low + 1, blocks.shape[0] - 1)
    across, up = x - left, (y - low)[:, None]
    lower = flipped[low][:, left] * (1.0 - across) + flipped[low][:, right] * across
    upper = flipped[high][:, left] * (1.0 - across) + flipped[high][:, right] * across
    return np.asarray((lower * (1.0 - up) + upper * up)[::-1])
