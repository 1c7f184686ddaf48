"""From the numbers of the surfaces that pixels show to band radiance at the sensor, as compiled loops over rows.

Neighbours that show the same surface are a run: what it sends and the plane it lies in are looked up once, and the
distance along a ray follows from the plane. Where the view matters, for sky and glossy surfaces, a run's own loop
looks it up; then one loop over the whole row, which the compiler turns into vectors, adds the air (`air_kernel`).
"""

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.render.air_kernel import through_air

Array = NDArray[Any]
_FARTHEST = 1e9  # [m] along the horizon; all air is opaque before


@njit(cache=True, nogil=True, error_model="numpy")
def mark_seen(numbers: Array, first: int, last: int, seen: Array) -> None:
    """Set `seen` (s + 1,) at the numbers in rows `first` to `last`."""
    for y in range(first, last):
        before = -1
        for x in range(numbers.shape[1]):
            number = int(numbers[y, x])
            if number != before:
                seen[number] = True
                before = number


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def light_rows(
    numbers: Array, rays: Array, eye: Array, planes: tuple[Array, Array], sent: tuple[Array, Array], gloss: Array,
    around: tuple[Array, ...], air: tuple[Array, Array], first: int, last: int, light: Array, marked: Array,
) -> None:  # fmt: skip
    """Band radiance at the sensor and where no surface is seen (height, width), rows `first` to `last` from the top.

    numbers (height, width) from the lowest row up, of surfaces plus one; rays (3, 3): through the lower left corner,
    along width and height. planes, sent: of the scene's surfaces and of solids that follow on them. gloss (s,): kind
    or -1. around: sky, gradation, indicatrix, rise (kinds, n), mirror (kinds, m), ground's radiance (1,). air: terms
    and direction of the sun with the asymmetry, see `through_air`.
    """
    height, width = numbers.shape
    source, away = np.zeros(width, light.dtype), np.zeros(width, light.dtype)
    step, start = rays[1] / width, np.zeros(3)
    for y in range(first, last):
        row = height - 1 - y
        for axis in range(3):
            start[axis] = rays[0, axis] + rays[2, axis] * (row + 0.5) / height + 0.5 * step[axis]
        begin = 0
        while begin < width:
            number, end = numbers[row, begin], begin + 1
            while end < width and numbers[row, end] == number:
                end += 1
            place = int(number) - 1
            marked[y, begin:end] = place < 0
            if place < 0:
                _beyond(start, step, eye, around, air[1], begin, end, source, away)
            elif place < gloss.size:
                _surface(
                    start, step, eye, planes[0][place], sent[0][place], gloss[place], around, begin, end, source, away
                )
            else:
                more = place - gloss.size
                _surface(start, step, eye, planes[1][more], sent[1][more], -1, around, begin, end, source, away)
            begin = end
        through_air(start, step, source, away, air[0], air[1], light[y])


@njit(cache=True, nogil=True, error_model="numpy")
def _between(table: Array, share: float) -> float:
    """A table of equal steps at a share of its length, its end values beyond."""
    place = min(max(share, 0.0), 1.0) * (table.size - 1)
    low = min(int(place), table.size - 2)
    return float(table[low] + (place - low) * (table[low + 1] - table[low]))


@njit(cache=True, nogil=True, error_model="numpy")
def _beyond(
    start: Array, step: Array, eye: Array, around: tuple[Array, ...], sun: Array, begin: int, end: int, source: Array,
    away: Array,
) -> None:  # fmt: skip
    """Sky above the horizon, with its glow around the sun; below it the endless ground plane."""
    sky, gradation, indicatrix, _, _, ground = around
    above = max(eye[2], 0.0)
    for x in range(begin, end):
        ray = start[0] + x * step[0], start[1] + x * step[1], start[2] + x * step[2]
        if ray[2] < 0.0:
            source[x], away[x] = ground[0], min(above / -ray[2], _FARTHEST)
            continue
        length = np.sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2])
        sine = ray[2] / length
        source[x], away[x] = _between(sky, sine), 0.0
        if gradation.size:
            cosine = (ray[0] * sun[0] + ray[1] * sun[1] + ray[2] * sun[2]) / length
            source[x] += _between(gradation, sine) * _between(indicatrix, 0.5 + 0.5 * cosine)


@njit(cache=True, nogil=True, error_model="numpy")
def _surface(
    start: Array, step: Array, eye: Array, plane: Array, sent: Array, kind: int, around: tuple[Array, ...],
    begin: int, end: int, source: Array, away: Array,
) -> None:  # fmt: skip
    """One surface: where the rays meet its plane, but no nearer or farther than the sphere around it lies."""
    normal, middle = plane[:3], plane[4:7] - eye
    facing = normal[0] * start[0] + normal[1] * start[1] + normal[2] * start[2]
    slope = normal[0] * step[0] + normal[1] * step[1] + normal[2] * step[2]
    off = plane[3] - (normal[0] * eye[0] + normal[1] * eye[1] + normal[2] * eye[2])
    distance = np.sqrt(middle[0] * middle[0] + middle[1] * middle[1] + middle[2] * middle[2])
    corner = np.sqrt(start[0] * start[0] + start[1] * start[1] + start[2] * start[2])
    nearest, farthest = max(distance - plane[7], 0.0) / (2.0 * corner), distance + plane[7]
    for x in range(begin, end):
        source[x], away[x] = sent[0], min(max(off / (facing + x * slope), nearest), farthest)
    if kind < 0:
        return
    _, _, _, rise, mirror, _ = around
    for x in range(begin, end):
        ray = start[0] + x * step[0], start[1] + x * step[1], start[2] + x * step[2]
        length = np.sqrt(ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2])
        cosine = (facing + x * slope) / length
        up = ray[2] / length - 2.0 * cosine * normal[2]
        mirrored = _between(mirror[kind], 0.5 + 0.5 * up)
        source[x] = mirrored + sent[1] * (1.0 - _between(rise[kind], -cosine)) * (sent[0] - mirrored)
