"""Glossy surfaces as compiled loops over the pixels of a run: what they show goes with the view.

In thermal bands what they emit and mirror, as in shaders/radiance/emitted.glsl; in reflective ones what they mirror of
sky, ground and sun, and what they scatter, as in shaders/radiance/glossy.glsl, whose tables these are.
"""

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.constants import PI
from sensorsim.materials.facets import ANGLE_ENTRIES
from sensorsim.render.mirror import DISC_VARIANCE

Array = NDArray[Any]
_NONE, _HALF, _ONE, _TWO, _FOUR = (np.float32(value) for value in (0.0, 0.5, 1.0, 2.0, 4.0))
_PI, _DISC, _LEAST_COSINE, _LEAST_LENGTH = (np.float32(value) for value in (PI, DISC_VARIANCE, 1e-4, 1e-6))


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def between(table: Array, share: Any) -> Any:
    """A table of equal steps at a share of its length from 0 to 1, its end values beyond."""
    last = np.uint32(table.size - 1)
    place = min(max(share, _NONE), _ONE) * np.float32(last)
    low = min(np.uint32(place), np.uint32(last - np.uint32(1)))
    return table[low] + (place - np.float32(low)) * (table[low + np.uint32(1)] - table[low])


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def emit_and_mirror(
    ray: Array, along: Array, plane: Array, sent: Array, rise: Array, mirror: Array, begin: int, end: int,
    source: Array,
) -> None:  # fmt: skip
    """A glossy surface in a thermal band: what it emits along the ray, and what lies in the mirror direction.

    sent (2,): radiance of a black body as warm, emissivity along the normal; rise, mirror: rows of its kind.
    """
    normal, black, emissivity = plane.astype(np.float32), sent[0], sent[1]
    for x in range(begin, end):
        place = np.float32(x)
        east, north, up = ray[0] + place * along[0], ray[1] + place * along[1], ray[2] + place * along[2]
        length = np.sqrt(east * east + north * north + up * up)
        cosine = (east * normal[0] + north * normal[1] + up * normal[2]) / length
        outward = up / length - _TWO * cosine * normal[2]
        mirrored = between(mirror, _HALF + _HALF * outward)
        source[x] = mirrored + emissivity * (_ONE - between(rise, -cosine)) * (black - mirrored)


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def mirror_and_scatter(
    ray: Array, along: Array, plane: Array, sent: Array, rises: Array, mirrors: Array, kind: int, light: Array,
    begin: int, end: int, source: Array,
) -> None:  # fmt: skip
    """A glossy surface in a reflective band.

    sent (2,): reflectance of a facet along its normal, radiance that the facets' lower side would scatter at normal
    view; rises, mirrors (3 kinds, n): tables of `mirror`; light (4,): direction towards the sun, its irradiance.
    """
    kinds, facet, below = rises.shape[0] // 3, sent[0], sent[1]
    rise, glow = rises[kind, :ANGLE_ENTRIES], mirrors[kinds + kind]
    normal, view, outward = plane[:3].astype(np.float32), np.zeros(3, np.float32), np.zeros(3, np.float32)
    sun = normal[0] * light[0] + normal[1] * light[1] + normal[2] * light[2]
    shone = sun > _NONE and light[3] > _NONE
    for x in range(begin, end):
        view[:] = ray + np.float32(x) * along
        view /= np.sqrt(view[0] * view[0] + view[1] * view[1] + view[2] * view[2])
        cosine = view[0] * normal[0] + view[1] * normal[1] + view[2] * normal[2]
        outward[:] = view - _TWO * cosine * normal
        eye = max(-cosine, _LEAST_COSINE)
        risen = between(rise, eye)
        up, towards = _HALF + _HALF * outward[2], outward[0] * light[0] + outward[1] * light[1] + outward[2] * light[2]
        sky = between(mirrors[kind], up)
        sky += between(glow, up) * between(mirrors[2 * kinds + kind], _HALF + _HALF * towards)
        source[x] = (facet + (_ONE - facet) * risen) * sky + below * (_ONE - risen)
        if shone:
            source[x] += light[3] * _glint(rises, kind, facet, normal, view, light, sun, eye)


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def _glint(rises: Array, kind: int, facet: Any, normal: Array, view: Array, light: Array, sun: Any, eye: Any) -> Any:
    """Radiance of the mirrored sun for an irradiance of 1 [sr-1], see glint() in shaders/radiance/glossy.glsl."""
    kinds = rises.shape[0] // 3
    seen = rises[kinds + kind, :ANGLE_ENTRIES]
    half = light[:3] - view
    half /= np.sqrt(half[0] * half[0] + half[1] * half[1] + half[2] * half[2])
    upright = half[0] * normal[0] + half[1] * normal[1] + half[2] * normal[2]
    incidence = -(half[0] * view[0] + half[1] * view[1] + half[2] * view[2])
    slope, lean = half / upright - normal, light[:3] + view
    lean -= (lean[0] * normal[0] + lean[1] * normal[1] + lean[2] * normal[2]) * normal
    length = max(np.sqrt(lean[0] * lean[0] + lean[1] * lean[1] + lean[2] * lean[2]), _LEAST_LENGTH)
    in_plane = ((slope[0] * lean[0] + slope[1] * lean[1] + slope[2] * lean[2]) / length) ** 2
    across = max(slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2] - in_plane, _NONE)
    plain = rises[kinds + kind, ANGLE_ENTRIES]
    within, beside = plain + _DISC, plain + _DISC / (incidence * incidence)
    density = np.exp(-in_plane / within - across / beside) / (_PI * np.sqrt(within * beside) * upright**4)
    mirrored = facet + (_ONE - facet) * between(rises[2 * kinds + kind, :ANGLE_ENTRIES], incidence)
    return mirrored * density * between(seen, sun) * between(seen, eye) / (_FOUR * eye)
