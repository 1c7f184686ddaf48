"""How sky light in a reflective band lies over the sky: the clear and the overcast sky of the CIE [ISO15469].

    radiance = gradation(elevation) * indicatrix(angle from the sun or moon)

Clear: type 12, bright around the sun and at the horizon. Overcast: type 1, three times as bright overhead as at the
horizon, the same all around. Standards of daylight; taken over for 0.8-1.1 um, where the glow around the sun is if
anything stronger. Between the two the sky is mixed by cloud cover. Each is scaled to its share of the irradiance.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_CLEAR_GRADATION = (-1.0, -0.32)
_CLEAR_INDICATRIX = (10.0, -3.0, 0.45)
_OVERCAST_GRADATION = (4.0, -0.7)
INDICATRIX_ENTRIES = 1024  # equally spaced in the cosine of the angle from the sun, -1 to 1
_RINGS, _SECTORS = 200, 180  # of the sphere, for the scale
_LEAST_SINE = 1e-3  # the gradation has its limit at the horizon


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkyGlow:
    """Sky light that leans to the sun or moon: radiance gradation * indicatrix."""

    gradation: FloatArray  # (n,) [W m-2 sr-1] at elevations whose sine goes evenly from 0 to 1
    indicatrix: FloatArray  # (INDICATRIX_ENTRIES,) [-] against the cosine of the angle from the light, -1 to 1
    irradiance: float  # [W m-2] of the horizontal by all of it


def clear_glow(irradiance: float, direction: FloatArray, entries: int) -> SkyGlow:
    """Clear sky of an irradiance of the horizontal [W m-2] around a light in a unit direction above the horizon."""
    sine = (np.arange(_RINGS) + 0.5) / _RINGS
    around = 2.0 * np.pi * (np.arange(_SECTORS) + 0.5) / _SECTORS
    flat = np.sqrt(1.0 - sine**2)
    height, level = float(direction[2]), float(np.hypot(direction[0], direction[1]))
    cosine = sine[:, None] * height + flat[:, None] * level * np.cos(around)
    shape = _gradation(sine, *_CLEAR_GRADATION)[:, None] * _indicatrix(cosine)
    whole = 2.0 * np.pi * float(np.mean(shape * sine[:, None]))
    return SkyGlow(
        gradation=irradiance / whole * _gradation(np.linspace(0.0, 1.0, entries), *_CLEAR_GRADATION),
        indicatrix=_indicatrix(np.linspace(-1.0, 1.0, INDICATRIX_ENTRIES)),
        irradiance=irradiance,
    )


def overcast_radiance(irradiance: float, entries: int) -> FloatArray:
    """Radiance (entries,) [W m-2 sr-1] of the overcast sky, elevations whose sine goes evenly from 0 to 1."""
    sine = np.linspace(0.0, 1.0, entries)
    shape = _gradation(sine, *_OVERCAST_GRADATION)
    return np.asarray(irradiance / (2.0 * np.pi * np.trapezoid(shape * sine, sine)) * shape)


def _gradation(sine: FloatArray, a: float, b: float) -> FloatArray:
    """[ISO15469] eq. 2, in the sine of the elevation."""
    return np.asarray(1.0 + a * np.exp(b / np.maximum(sine, _LEAST_SINE)))


def _indicatrix(cosine: FloatArray) -> FloatArray:
    """[ISO15469] eq. 4, in the cosine of the angle from the sun."""
    c, d, e = _CLEAR_INDICATRIX
    angle = np.arccos(np.clip(cosine, -1.0, 1.0))
    return np.asarray(1.0 + c * (np.exp(d * angle) - np.exp(d * np.pi / 2.0)) + e * cosine**2)
