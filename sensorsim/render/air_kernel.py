"""The air before a row of pixels, as a compiled loop that becomes vectors: `AirPath.apparent_radiance` a row at a time.

Single precision throughout, the exponential by its series, since a library's would keep the loop from being vectors.
"""

from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[Any]
_NONE, _ONE, _TWO, _HALF = np.float32(0.0), np.float32(1.0), np.float32(2.0), np.float32(0.5)
_SMALL = np.float32(1e-2)  # below it quotients come from their series, as in environment.air_path
_MOST = np.float32(80.0)  # nothing is left of light then
_THIRD, _SIXTH = np.float32(1.0 / 3.0), np.float32(1.0 / 6.0)
_LOG2E = np.float32(1.4426950408889634)
_LN2, _LN2_REST = np.float32(0.693359375), np.float32(-2.1219444005469057e-4)  # in two parts, the first of few bits
_SERIES = tuple(np.float32(1.0 / factorial) for factorial in (2.0, 6.0, 24.0, 120.0, 720.0, 5040.0, 40320.0))
GENTLE = 0.5  # scale heights up to which the series above holds to 1e-8
_BIAS, _MANTISSA = np.int32(127), np.int32(23)


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"}, inline="always")
def decay(x: Any) -> Any:
    """e to the power -x, of -80 to 80 at most: a power of two times the series around 0, relative error 2e-7."""
    y = -min(max(x, -_MOST), _MOST)
    whole = np.floor(y * _LOG2E + _HALF)
    rest = (y - whole * _LN2) - whole * _LN2_REST
    a2, a3, a4, a5, a6, a7, _ = _SERIES
    series = _ONE + rest * (_ONE + rest * (a2 + rest * (a3 + rest * (a4 + rest * (a5 + rest * (a6 + rest * a7))))))
    return series * np.int32((np.int32(whole) + _BIAS) << _MANTISSA).view(np.float32)


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def through_air(
    ray: Array, along: Array, source: Array, away: Array, terms: Array, sun: Array, scratch: Array, seen: Array
) -> None:
    """Radiance `seen` (width,) of sources at distances `away` along rays, ray + x along, none of unit length.

    terms (k, 7): extinction at the camera's height, weight, inverse scale height, source, its slope, source by the
    beam, 1 where the rise is known to be below GENTLE scale heights; sun (4,): direction towards it and the asymmetry
    of the haze; scratch (4, width).
    """
    reach, rise, forward, thin = scratch[0], scratch[1], scratch[2], scratch[3]
    for x in range(source.size):
        place = np.float32(x)
        east, north, up = ray[0] + place * along[0], ray[1] + place * along[1], ray[2] + place * along[2]
        reach[x], rise[x] = away[x] * np.sqrt(east * east + north * north + up * up), away[x] * up
        seen[x] = _NONE
    for term in terms:
        extinction, weight, inverse, near, slope, beam, gentle = term
        if beam > _NONE:
            _phase(ray, along, sun, forward)
        _mean_decay(inverse, rise, gentle > _NONE, thin)
        for x in range(source.size):
            depth = extinction * thin[x] * reach[x]
            part = decay(depth)
            short = depth < _SMALL
            known = _ONE if short else depth
            lag = depth * (_HALF - depth * _THIRD) if short else (_ONE - part) / known - part
            glow = near + beam * forward[x]
            seen[x] += weight * (glow + part * (source[x] - glow) + lag * slope * rise[x])


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def _mean_decay(inverse: Any, rise: Array, gentle: bool, out: Array) -> None:
    """(1 - exp(-h)) / h of rises over h scale heights: mean density of the air along a path."""
    if not gentle:
        for x in range(rise.size):
            height = inverse * rise[x]
            small = abs(height) < _SMALL
            safe = _ONE if small else height
            out[x] = _ONE + height * (height * _SIXTH - _HALF) if small else (_ONE - decay(safe)) / safe
        return
    a2, a3, a4, a5, a6, a7, a8 = _SERIES
    for x in range(rise.size):
        h = -inverse * rise[x]
        out[x] = _ONE + h * (a2 + h * (a3 + h * (a4 + h * (a5 + h * (a6 + h * (a7 + h * a8))))))


@njit(cache=True, nogil=True, error_model="numpy", fastmath={"contract"})
def _phase(ray: Array, along: Array, sun: Array, forward: Array) -> None:
    """Scattering towards the sensor relative to that at a right angle [HenyeyGreenstein1941]."""
    asymmetry = np.float32(sun[3])
    whole = _ONE + asymmetry * asymmetry
    towards = sun.astype(np.float32)
    for x in range(forward.size):
        place = np.float32(x)
        east, north, up = ray[0] + place * along[0], ray[1] + place * along[1], ray[2] + place * along[2]
        length = np.sqrt(east * east + north * north + up * up)
        cosine = (east * towards[0] + north * towards[1] + up * towards[2]) / length
        part = whole / (whole - _TWO * asymmetry * cosine)
        forward[x] = part * np.sqrt(part)
