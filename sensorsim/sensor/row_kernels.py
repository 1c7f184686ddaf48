"""Blur, noise, counts and grey of a picture's rows as compiled loops, for machines whose processor draws the frame.

Each works on rows `first` to `last` of arrays (height, width), row 0 at the top, so that threads share a picture; its
inner loops run over neighbouring elements, which the compiler turns into vectors. They do what `focal_plane`,
`read_out` and `display_code` do, in the precision of the arrays that they are given.
"""

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[Any]


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def blur(
    picture: Array, row: Array, column: Array, places: Array, samples: int, first: int, last: int, out: Array
) -> None:
    """Radiance on the elements [W m-2 sr-1] of a picture (height samples, columns), by the products of a kernel.

    row, column (r, n); places (width,): sample that each column looks at. The picture's edge goes on beyond it.
    """
    height, width = picture.shape
    ranks, taps = row.shape
    reach = taps // 2
    line, wide = np.zeros(width + 2 * reach, picture.dtype), np.zeros(width, picture.dtype)
    middle = line[reach : reach + width]
    for y in range(first, last):
        top = samples * y + samples // 2 - reach
        wide[:] = 0.0
        for rank in range(ranks):
            middle[:] = 0.0
            for tap in range(taps):
                weight, source = column[rank, tap], picture[min(max(top + tap, 0), height - 1)]
                for x in range(width):
                    middle[x] += weight * source[x]
            line[:reach], line[reach + width :] = line[reach], line[reach + width - 1]
            for tap in range(taps):
                weight, shifted = row[rank, tap], line[tap : tap + width]
                for x in range(width):
                    wide[x] += weight * shifted[x]
        target = out[y]
        for x in range(places.size):
            target[x] = wide[places[x]]


@njit(cache=True, nogil=True, error_model="numpy")
def add_blocks(
    light: Array, rows: Array, left: Array, share: Array, numbers: Array, first: int, last: int,
    out: Array,
) -> None:  # fmt: skip
    """`light` + a constant + a factor times blocks (height, blocks), straight between `left` and its neighbour."""
    end = rows.shape[1] - 1
    constant, factor = numbers
    for y in range(first, last):
        source, blocks, target = light[y], rows[y], out[y]
        for x in range(source.size):
            low, high = blocks[left[x]], blocks[min(left[x] + 1, end)]
            target[x] = source[x] + constant + factor * (low + share[x] * (high - low))


@njit(cache=True, nogil=True, error_model="numpy")
def _choices(y: int, frame: int, seed: int, out: Array) -> None:
    """Number of the deviate of each element of a row: pcg4d of [Jarzynski2020], as in `random_field`."""
    m, a = np.uint32(1664525), np.uint32(1013904223)
    q, f, s = np.uint32(np.uint32(y) * m + a), np.uint32(np.uint32(frame) * m + a), np.uint32(np.uint32(seed) * m + a)
    shift, top = np.uint32(16), np.uint32(20)
    for place in range(out.size):
        x, v, z, w = np.uint32(np.uint32(place) * m + a), q, f, s
        x = np.uint32(x + np.uint32(v * w))
        v = np.uint32(v + np.uint32(z * x))
        z = np.uint32(z + np.uint32(x * v))
        w = np.uint32(w + np.uint32(v * z))
        x, v, z, w = x ^ (x >> shift), v ^ (v >> shift), z ^ (z >> shift), w ^ (w >> shift)
        out[place] = np.uint32(x + np.uint32(np.uint32(v) * np.uint32(w))) >> top


@njit(cache=True, nogil=True, error_model="numpy")
def report(
    light: Array, pattern: Array, row: Array, line: Array, deviates: Array, look: Array, frame: int, seed: int,
    first: int, last: int, out: Array,
) -> None:  # fmt: skip
    """What the detector reports [W m-2 sr-1].

    pattern (3, height, width): fixed deviate, gain less one, 1 where it sees. look: constant and shot of the variance,
    step and number of counts, radiance of the correction; in the arrays' own precision, so that nothing is computed
    in a finer one.
    """
    constant, shot, step, highest, corrected_at = look
    none, half = look.dtype.type(0.0), look.dtype.type(0.5)
    choice, deviate = np.zeros(line.size, np.uint32), np.zeros(line.size, light.dtype)
    for y in range(first, last):
        _choices(y, frame, seed, choice)
        for x in range(line.size):
            deviate[x] = deviates[choice[x]]
        source, fixed, gain, sees = light[y], pattern[0, y], pattern[1, y], pattern[2, y]
        target, whole = out[y], row[y]
        for x in range(line.size):
            here = source[x]
            noise = np.sqrt(constant + shot * max(here, none)) * (deviate[x] + fixed[x] + whole + line[x])
            signal = here + gain[x] * (here - corrected_at) + noise
            count = min(max(np.floor(signal * sees[x] / step + half), none), highest)
            target[x] = count * step


@njit(cache=True, nogil=True, error_model="numpy")
def show(signal: Array, curve: Array, window: Array, black_hot: bool, first: int, last: int, out: Array) -> None:
    """Display codes of radiance; window: level and span. `curve` (n,): grey at equal steps, straight where empty."""
    level, span, half, one, full = window
    none, last_entry = one - one, curve.size - 1
    for y in range(first, last):
        source, target = signal[y], out[y]
        for x in range(source.size):
            grey = min(max((source[x] - level) / span + half, none), one)
            if last_entry > 0:
                entry = min(int(grey * last_entry), last_entry - 1)
                grey = curve[entry] + (grey * last_entry - entry) * (curve[entry + 1] - curve[entry])
            if black_hot:
                grey = one - grey
            target[x] = np.uint8(full * grey + half)
