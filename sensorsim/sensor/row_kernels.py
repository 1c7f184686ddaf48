"""Blur, noise, counts and grey of a picture's rows as compiled loops, for machines whose processor draws the frame.

Each works on rows `first` to `last` of arrays (height, width), row 0 at the top, so that threads share a picture, and
of these on `every` so manieth, since lines may come in turn; its inner loops run over neighbouring elements, which
the compiler turns into vectors. They do what `focal_plane`, `read_out` and `display_code` do, in the precision of the
arrays that they are given.
"""

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.sensor.words import folded, plus, times

Array = NDArray[Any]


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def blur(
    picture: Array, row: Array, column: Array, reach: int, places: Array, samples: int, first: int, last: int,
    every: int, out: Array,
) -> None:  # fmt: skip
    """Radiance on the elements [W m-2 sr-1] of a picture (height samples, columns), by the products of a kernel.

    row, column (r, n): weights of n taps from `reach` samples before, as `padded` gives them; places (width,): sample
    that each column looks at. The picture's edge goes on beyond it.
    """
    (height, width), (ranks, taps) = picture.shape, row.shape
    wide, others = np.zeros(width, picture.dtype), np.zeros(4, np.int64)
    one, two = np.zeros(width + taps, picture.dtype), np.zeros(width + taps, picture.dtype)
    for y in range(first, last, every):
        top = samples * y + samples // 2 - reach
        wide[:] = 0.0
        for rank in range(0, ranks, 2):
            one[:], two[:] = 0.0, 0.0
            for tap in range(0, taps, 4):
                for near in range(4):
                    others[near] = min(max(top + tap + near, 0), height - 1)
                weight = column[rank : rank + 2, tap : tap + 4]
                _across(picture, others, weight, one[reach : reach + width], two[reach : reach + width])
            for line in (one, two):
                line[:reach], line[reach + width :] = line[reach], line[reach + width - 1]
            for tap in range(0, taps, 4):
                _along(one[tap:], two[tap:], row[rank : rank + 2, tap : tap + 4], wide)
        target = out[y]
        for x in range(places.size):
            target[x] = wide[places[x]]


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def _across(picture: Array, rows: Array, weight: Array, one: Array, two: Array) -> None:
    """Add four rows of a picture to two lines (width,), weights (2, 4): eight products for six loads.

    Arrays of one dimension without gaps, here and below: others the compiler does not turn into vectors.
    """
    a, b, c, d = picture[rows[0]], picture[rows[1]], picture[rows[2]], picture[rows[3]]
    p0, p1, p2, p3 = weight[0, 0], weight[0, 1], weight[0, 2], weight[0, 3]
    q0, q1, q2, q3 = weight[1, 0], weight[1, 1], weight[1, 2], weight[1, 3]
    for x in range(one.size):
        k, m, n, o = a[x], b[x], c[x], d[x]
        one[x] += (p0 * k + p1 * m) + (p2 * n + p3 * o)
        two[x] += (q0 * k + q1 * m) + (q2 * n + q3 * o)


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def _along(one: Array, two: Array, weight: Array, out: Array) -> None:
    """Add to a line (width,) four neighbours in each of two lines, weights (2, 4)."""
    width = out.size
    a, b, c, d = one[:width], one[1 : 1 + width], one[2 : 2 + width], one[3 : 3 + width]
    e, f, g, h = two[:width], two[1 : 1 + width], two[2 : 2 + width], two[3 : 3 + width]
    p0, p1, p2, p3 = weight[0, 0], weight[0, 1], weight[0, 2], weight[0, 3]
    q0, q1, q2, q3 = weight[1, 0], weight[1, 1], weight[1, 2], weight[1, 3]
    for x in range(width):
        first = (p0 * a[x] + p1 * b[x]) + (p2 * c[x] + p3 * d[x])
        out[x] += first + ((q0 * e[x] + q1 * f[x]) + (q2 * g[x] + q3 * h[x]))


def padded(weights: Array) -> NDArray[np.float32]:
    """Weights (r, n) with zeros, so that products come in pairs and taps in fours."""
    ranks, taps = weights.shape
    filled = np.pad(weights, ((0, -ranks % 2), (0, -taps % 4)))
    return np.ascontiguousarray(filled, np.float32)


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract", "reassoc"})
def settled_blocks(light: Array, extent: int, kept: float, first: int, last: int, every: int, out: Array) -> None:
    """Level (height, blocks) that each row has settled to, as `spill.baseline`: its sum from block to block.

    kept: share of the level left a block of `extent` neighbours later; the sweep that ends a row begins the next.
    """
    width, count = light.shape[1], out.shape[1]
    means, whole, around = np.zeros(count), 0.0, 1.0
    for _ in range(count):
        whole += around
        around *= kept
    for y in range(first, last, every):
        row, level = light[y], 0.0
        for block in range(count):
            begin, end, total = block * extent, min((block + 1) * extent, width), 0.0
            for x in range(begin, end):
                total += row[x]
            means[block] = total / (end - begin)
            level = kept * level + means[block]
        for block in range(count):
            level = kept * level + (1.0 - around) * means[block]
            out[y, block] = level / whole


@njit(cache=True, nogil=True, error_model="numpy")
def add_blocks(
    light: Array, rows: Array, left: Array, right: Array, share: Array, numbers: Array, first: int, last: int,
    every: int, out: Array,
) -> None:  # fmt: skip
    """`light` + a constant + a factor times blocks (height, blocks), straight between the `left` and the `right`."""
    constant, factor = numbers
    for y in range(first, last, every):
        source, blocks, target = light[y], rows[y], out[y]
        for x in range(source.size):
            low = blocks[left[x]]
            target[x] = source[x] + constant + factor * (low + share[x] * (blocks[right[x]] - low))


@njit(cache=True, nogil=True, error_model="numpy")
def deviate_row(row: int, frame: int, seed: int, deviates: Array, out: Array) -> None:
    """Deviates of the elements of a row: pcg4d of [Jarzynski2020], as in `random_field`."""
    m, a, top = np.uint32(1664525), np.uint32(1013904223), np.uint32(20)
    q, f = plus(times(np.uint32(row), m), a), plus(times(np.uint32(frame), m), a)
    s = plus(times(np.uint32(seed), m), a)
    fixed = plus(a, times(q, s))
    for place in range(out.size):
        x = plus(times(np.uint32(place), m), fixed)
        v = plus(q, times(f, x))
        z = plus(f, times(x, v))
        w = plus(s, times(v, z))
        out[place] = deviates[plus(folded(x), times(folded(v), folded(w))) >> top]


@njit(cache=True, nogil=True, error_model="numpy")
def report(
    light: Array, pattern: Array, row: Array, line: Array, deviates: Array, look: Array, frame: int, seed: int,
    first: int, last: int, every: int, out: Array,
) -> None:  # fmt: skip
    """What the detector reports [W m-2 sr-1].

    pattern (3, height, width): fixed deviate, gain less one, 1 where it sees. look: constant and shot of the variance,
    step and number of counts, radiance of the correction; in the arrays' own precision, so that nothing is computed
    in a finer one.
    """
    constant, shot, step, highest, corrected_at = look
    none, half = look.dtype.type(0.0), look.dtype.type(0.5)
    deviate = np.zeros(line.size, light.dtype)
    for y in range(first, last, every):
        deviate_row(y, frame, seed, deviates, deviate)
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
