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
from sensorsim.render.glossy_kernel import between, glossy

Array = NDArray[Any]
_NONE, _HALF, _ONE, _TWO = np.float32(0.0), np.float32(0.5), np.float32(1.0), np.float32(2.0)
_FARTHEST = np.float32(1e9)  # [m] along the horizon; all air is opaque before


@njit(cache=True, nogil=True, error_model="numpy")
def find_runs(numbers: Array, first: int, last: int, ends: Array, seen: Array) -> None:
    """Where runs end in rows `first` to `last`, in `ends` (height, width), and which numbers are `seen` (s + 1,)."""
    for y in range(first, last):
        row, run, width = numbers[y], 0, numbers.shape[1]
        for x in range(1, width):
            if row[x] != row[x - 1]:
                ends[y, run] = x
                run += 1
                seen[int(row[x - 1])] = True
        ends[y, run] = width
        seen[int(row[width - 1])] = True


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def light_rows(
    numbers: Array, ends: Array, rays: Array, eye: Array, planes: tuple[Array, Array], sent: tuple[Array, Array],
    gloss: Array, around: tuple[Array, ...], air: tuple[Array, Array], first: int, last: int, light: Array,
    surface: Array,
) -> None:  # fmt: skip
    """Band radiance at the sensor and where a surface is seen (height, width), rows `first` to `last` from the top.

    numbers (height, width) from the lowest row up, of surfaces plus one; ends: of their runs; rays (3, 3): through the
    lower left corner, along width and height. planes, sent: of the scene's surfaces and of solids that follow on them.
    gloss (s,): kind or -1. around: sky, gradation, indicatrix, rise (kinds, n), mirror (kinds, m), ground's radiance
    (1,), in reflective bands with the beam (2,) and tables as `glossy` has them. air: terms, none where there is
    no air, and direction of the sun with the asymmetry, see `through_air`.
    """
    height, width = numbers.shape
    source, away, scratch = np.zeros(width, np.float32), np.zeros(width, np.float32), np.zeros((4, width), np.float32)
    step, start, solid = rays[1] / width, np.zeros(3), gloss.size
    along = step.astype(np.float32)
    for y in range(first, last):
        row = height - 1 - y
        start[:] = rays[0] + rays[2] * ((row + 0.5) / height) + 0.5 * step
        ray, begin, run, clear = start.astype(np.float32), 0, 0, min(start[2], start[2] + width * step[2]) > 0.0
        while begin < width:
            place, end = int(numbers[row, begin]) - 1, ends[row, run]
            surface[y, begin:end] = place >= 0
            if place < 0:
                _beyond(ray, along, eye, around, air[1], begin, end, source, away)
            else:
                clear, which = False, int(place >= solid)
                here = place - which * solid
                plane, sends = planes[which][here], sent[which][here]
                _surface(start, step, eye, plane, begin, end, away)
                source[begin:end] = sends[0]
                if which == 0 and gloss[place] >= 0:
                    _gleam(ray, along, plane, sends, gloss[place], around, air[1], begin, end, source)
            begin, run = end, run + 1
        if clear or air[0].shape[0] == 0:
            light[y] = source
        else:
            through_air(ray, along, source, away, air[0], air[1], scratch, light[y])


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def _beyond(
    ray: Array, along: Array, eye: Array, around: tuple[Array, ...], sun: Array, begin: int, end: int,
    source: Array, away: Array,
) -> None:  # fmt: skip
    """Sky above the horizon, with its glow around the sun; below it the endless ground plane."""
    sky, gradation, indicatrix, _, _, ground = around
    above, towards = np.float32(max(eye[2], 0.0)), sun.astype(np.float32)
    for x in range(begin, end):
        place = np.float32(x)
        east, north, up = ray[0] + place * along[0], ray[1] + place * along[1], ray[2] + place * along[2]
        below = up < _NONE
        sine = up / np.sqrt(east * east + north * north + up * up)
        source[x] = ground[0] if below else between(sky, sine)
        away[x] = min(above / (-up if below else _ONE), _FARTHEST) if below else _NONE
    if gradation.size == 0:
        return
    for x in range(begin, end):
        place = np.float32(x)
        east, north, up = ray[0] + place * along[0], ray[1] + place * along[1], ray[2] + place * along[2]
        if up >= _NONE:
            length = np.sqrt(east * east + north * north + up * up)
            cosine = (east * towards[0] + north * towards[1] + up * towards[2]) / length
            source[x] += between(gradation, up / length) * between(indicatrix, _HALF + _HALF * cosine)


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def _surface(start: Array, step: Array, eye: Array, plane: Array, begin: int, end: int, away: Array) -> None:
    """Where the rays meet a surface's plane, but no nearer or farther than the sphere around it lies."""
    facing = plane[0] * start[0] + plane[1] * start[1] + plane[2] * start[2]
    slope = plane[0] * step[0] + plane[1] * step[1] + plane[2] * step[2]
    off = plane[3] - (plane[0] * eye[0] + plane[1] * eye[1] + plane[2] * eye[2])
    east, north, up = plane[4] - eye[0], plane[5] - eye[1], plane[6] - eye[2]
    distance = np.sqrt(east * east + north * north + up * up)
    corner = np.sqrt(start[0] * start[0] + start[1] * start[1] + start[2] * start[2])
    nearest, farthest = max(distance - plane[7], 0.0) / (2.0 * corner), distance + plane[7]
    for x in range(begin, end):
        away[x] = min(max(off / (facing + x * slope), nearest), farthest)


@njit(cache=True, nogil=True, error_model="numpy")
def _gleam(
    ray: Array, along: Array, plane: Array, sent: Array, kind: int, around: tuple[Array, ...], sun: Array, begin: int,
    end: int, source: Array,
) -> None:  # fmt: skip
    """A glossy surface, by the band."""
    _, _, _, rise, mirror, ground = around
    if ground.size == 1:
        _mirror(ray, along, plane, sent, rise[kind], mirror[kind], begin, end, source)
    else:
        glossy(ray, along, plane, sent, kind, (rise, mirror), sun, ground[1], begin, end, source)


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def _mirror(
    ray: Array, along: Array, plane: Array, sent: Array, rise: Array, mirror: Array, begin: int, end: int,
    source: Array,
) -> None:  # fmt: skip
    """A glossy surface: what it emits along the ray, and what lies in the mirror direction."""
    normal, black, emissivity = plane.astype(np.float32), sent[0], sent[1]
    for x in range(begin, end):
        place = np.float32(x)
        east, north, up = ray[0] + place * along[0], ray[1] + place * along[1], ray[2] + place * along[2]
        length = np.sqrt(east * east + north * north + up * up)
        cosine = (east * normal[0] + north * normal[1] + up * normal[2]) / length
        outward = up / length - _TWO * cosine * normal[2]
        mirrored = between(mirror, _HALF + _HALF * outward)
        source[x] = mirrored + emissivity * (_ONE - between(rise, -cosine)) * (black - mirrored)
