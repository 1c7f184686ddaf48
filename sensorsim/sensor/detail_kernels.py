"""Detail enhancement of a picture's rows as compiled loops: `enhance_detail` in the precision of the arrays.

As in `row_kernels` each works on rows `first` to `last`, so that threads share a picture; the second one needs all rows
of the first one's.
"""

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[Any]


@njit(cache=True, nogil=True, error_model="numpy")
def _around(values: Array, y: int, reach: int, line: Array, total: Array) -> None:
    """Sums (width,) over the surroundings of a row's elements; the picture's edge goes on beyond it."""
    height, width = values.shape
    middle = line[reach : reach + width]
    middle[:] = 0.0
    for row in range(y - reach, y + reach + 1):
        source = values[min(max(row, 0), height - 1)]
        for x in range(width):
            middle[x] += source[x]
    line[:reach], line[reach + width :] = middle[0], middle[width - 1]
    total[:] = 0.0
    for tap in range(2 * reach + 1):
        shifted = line[tap : tap + width]
        for x in range(width):
            total[x] += shifted[x]


@njit(cache=True, nogil=True, error_model="numpy")
def fit_base(
    share: Array, square: Array, reach: int, edge: Array, first: int, last: int, slope: Array, offset: Array
) -> None:
    """Slope and offset (height, width) of the base as a line in `share` around each element; edge (1,)."""
    width, count = share.shape[1], share.dtype.type((2 * reach + 1) ** 2)
    line = np.zeros(width + 2 * reach, share.dtype)
    mean, other = np.zeros(width, share.dtype), np.zeros(width, share.dtype)
    none, one, floor = count - count, count / count, edge[0] * edge[0]
    for y in range(first, last):
        _around(share, y, reach, line, mean)
        _around(square, y, reach, line, other)
        for x in range(width):
            middle = mean[x] / count
            variance = max(other[x] / count - middle * middle, none)
            slope[y, x] = variance / (variance + floor)
            offset[y, x] = middle * (one - slope[y, x])


@njit(cache=True, nogil=True, error_model="numpy")
def stretch_detail(
    signal: Array, share: Array, slope: Array, offset: Array, reach: int, gain: Array, first: int, last: int, out: Array
) -> None:
    """`signal` with `gain` (1,) times what `share` differs from its base, in `out`."""
    width, count = share.shape[1], share.dtype.type((2 * reach + 1) ** 2)
    line = np.zeros(width + 2 * reach, share.dtype)
    rise, start = np.zeros(width, share.dtype), np.zeros(width, share.dtype)
    for y in range(first, last):
        _around(slope, y, reach, line, rise)
        _around(offset, y, reach, line, start)
        for x in range(width):
            base = (rise[x] * share[y, x] + start[x]) / count
            out[y, x] = signal[y, x] + gain[0] * (share[y, x] - base)
