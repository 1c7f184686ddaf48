"""Glossy surfaces in reflective bands along a run of pixels, as a compiled loop: shaders/radiance/glossy.glsl."""

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.effects.glint import DISC_VARIANCE, LEAST_COSINE

Array = NDArray[Any]
_NONE, _ONE = np.float32(0.0), np.float32(1.0)
_BRIGHTEST = 0.25 / (np.pi * DISC_VARIANCE)  # [sr-1] the disc itself, over its irradiance


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def between(table: Array, share: Any) -> Any:
    """A table of equal steps at a share of its length from 0 to 1, its end values beyond."""
    last = np.uint32(table.size - 1)
    place = min(max(share, _NONE), _ONE) * np.float32(last)
    low = min(np.uint32(place), np.uint32(last - np.uint32(1)))
    return table[low] + (place - np.float32(low)) * (table[low + np.uint32(1)] - table[low])


@njit(cache=True, nogil=True, error_model="numpy")
def glossy(
    ray: Array, along: Array, plane: Array, sent: Array, kind: int, tables: tuple[Array, Array], sun: Array,
    beam: float, begin: int, end: int, source: Array,
) -> None:  # fmt: skip
    """Sky and glint that facets mirror along rays, ray + x along, and what scatters below them.

    sent (2,): what scatters along the normal, reflectance of a facet there. tables: `mirror.facet_table` and
    `mirror.glow_mirror_table`; sun (4,): direction to the light, and more.
    """
    rise, mirror = tables
    kinds, last = rise.shape[0] // 3, rise.shape[1] - 1
    whole, seen, single = rise[kind, :last], rise[kinds + kind, :last], rise[2 * kinds + kind, :last]
    facing = plane[0] * sun[0] + plane[1] * sun[1] + plane[2] * sun[2]
    lit = facing > 0.0 and beam > 0.0
    sun_seen, variance = between(seen, np.float32(facing)), rise[kinds + kind, last]
    for x in range(begin, end):
        east, north, up = ray[0] + x * along[0], ray[1] + x * along[1], ray[2] + x * along[2]
        length = -np.sqrt(east * east + north * north + up * up)
        eye = (east / length, north / length, up / length)  # from the surface
        cosine = eye[0] * plane[0] + eye[1] * plane[1] + eye[2] * plane[2]
        high = 2.0 * cosine * plane[2] - eye[2]
        lean = 2.0 * cosine * facing - (eye[0] * sun[0] + eye[1] * sun[1] + eye[2] * sun[2])
        above, ahead = np.float32(0.5 + 0.5 * high), np.float32(0.5 + 0.5 * lean)
        sky = between(mirror[kind], above)
        sky += between(mirror[kinds + kind], above) * between(mirror[2 * kinds + kind], ahead)
        out = max(cosine, LEAST_COSINE)
        share = between(whole, np.float32(out))
        source[x] = (sent[1] + (_ONE - sent[1]) * share) * sky + sent[0] * (_ONE - share)
        if lit:
            shown = sun_seen * between(seen, np.float32(out)) / (4.0 * out)
            density, mirrored = _facing_facets(eye, plane, sun, facing, cosine, variance, sent[1], single)
            source[x] += beam * mirrored * min(density * shown, _BRIGHTEST)


@njit(cache=True, nogil=True, error_model="numpy")
def _facing_facets(
    eye: tuple[float, float, float], plane: Array, sun: Array, facing: float, cosine: float, variance: float,
    facet: float, rise: Array,
) -> tuple[Any, Any]:  # fmt: skip
    """Density of facets that mirror the light into the eye, and their reflectance."""
    length = np.sqrt((sun[0] + eye[0]) ** 2 + (sun[1] + eye[1]) ** 2 + (sun[2] + eye[2]) ** 2)
    upright, incidence = (facing + cosine) / length, 0.5 * length
    tilt, across, in_plane = 0.0, 0.0, 0.0
    for k in range(3):
        slope = (sun[k] + eye[k]) / (length * upright) - plane[k]
        side = sun[k] - eye[k] - (facing - cosine) * plane[k]
        tilt, across, in_plane = tilt + slope * slope, across + side * side, in_plane + slope * side
    in_plane = in_plane * in_plane / max(across, 1e-12)
    wide, broad = variance + DISC_VARIANCE, variance + DISC_VARIANCE / (incidence * incidence)
    density = np.exp(-in_plane / wide - max(tilt - in_plane, 0.0) / broad) / np.sqrt(wide * broad)
    mirrored = facet + (1.0 - facet) * between(rise, np.float32(incidence))
    return density / (np.pi * upright**4), mirrored
