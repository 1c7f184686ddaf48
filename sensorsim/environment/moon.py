"""The moon by night in 0.8-1.1 um: where it stands, how much of it is lit, and what light comes from it.

Position by the low-precision series of the Astronomical Almanac [Seidelmann1992], good to 0.3 degrees, with parallax.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment.air_mass import relative_air_mass
from sensorsim.environment.site import Site
from sensorsim.environment.sun import SunPosition

FloatArray = NDArray[np.float64]

# Each term: amplitude [deg], phase [deg], rate [deg per Julian century] of sines (parallax: cosines).
_LONGITUDE = np.array([
    (6.29, 134.9, 477198.85), (-1.27, 259.2, -413335.38), (0.66, 235.7, 890534.23), (0.21, 269.9, 954397.70),
    (-0.19, 357.5, 35999.05), (-0.11, 186.6, 966404.05),
])  # fmt: skip
_LATITUDE = np.array([
    (5.13, 93.3, 483202.03), (0.28, 228.2, 960400.87), (-0.28, 318.3, 6003.18), (-0.17, 217.6, -407332.20),
])  # fmt: skip
_PARALLAX = np.array([
    (0.0518, 134.9, 477198.85), (0.0095, 259.2, -413335.38), (0.0078, 235.7, 890534.23), (0.0028, 269.9, 954397.70),
])  # fmt: skip
_MEAN_LONGITUDE, _MEAN_MOTION, _MEAN_PARALLAX = 218.32, 481267.883, 0.9508  # [deg], [deg per century], [deg]

FULL_MOON = 982e-6  # [W m-2] in the band above the atmosphere, [LOWTRAN7]
# The moon's share of that against its phase angle [deg], [LOWTRAN7]; from 150 on extrapolated to the new moon.
_PHASE = np.array([0.0, 10.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0])
_SHARE = np.array([1.0, 0.732, 0.423, 0.167, 0.067, 0.0244, 3e-3, 1e-5])
# Clear air: exp(-0.386 m^0.474) of the beam gets through, 0.29 of what is lost comes down as skylight. The same as
# `near_infrared` has for the sun at air masses 1 and 2, against 259 W m-2 above the atmosphere [LOWTRAN7].
_DEPTH, _DEPTH_POWER, _SKYLIGHT = 0.386, 0.474, 0.29


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Moonlight:
    """Moon over n times; irradiance [W m-2] in 0.8-1.1 um."""

    direction: FloatArray  # (n, 3) unit vector east, north, up, also below the horizon
    phase_angle: FloatArray  # (n,) [deg] sun-moon-earth: 0 full, 180 new
    beam: FloatArray  # (n,) normal to the moon, zero while it is down
    diffuse: FloatArray  # (n,) on the horizontal from the moonlit sky


def moonlight(site: Site, utc: NDArray[np.datetime64], sun: SunPosition, cloud_cover: FloatArray) -> Moonlight:
    """Moon and its light at times (n,) in UTC under a sky that clouds cover to the share given [-].

    Clouds take from it what they take from the sun: see `sunlight_under_cloud`.
    """
    direction = moon_direction(site, utc)
    apart = np.degrees(np.arccos(np.clip(np.sum(direction * sun.direction, axis=-1), -1.0, 1.0)))
    phase = 180.0 - apart  # the sun is 390 times as far away
    above = FULL_MOON * np.exp(np.interp(phase, _PHASE, np.log(_SHARE)))
    height = np.maximum(direction[:, 2], 0.0)
    mass = relative_air_mass(np.degrees(np.arcsin(height)))
    through = np.exp(-_DEPTH * mass**_DEPTH_POWER)
    clear = above * through * (direction[:, 2] > 0.0)
    total = (clear + _SKYLIGHT * above * (1.0 - through)) * height * (1.0 - 0.75 * cloud_cover**3.4)
    beam = clear * (1.0 - cloud_cover)
    return Moonlight(direction=direction, phase_angle=phase, beam=beam, diffuse=total - beam * height)


def moon_direction(site: Site, utc: NDArray[np.datetime64]) -> FloatArray:
    """Unit vectors (n, 3) east, north, up from a site towards the moon's middle, for times (n,) in UTC."""
    days = (utc - np.datetime64("2000-01-01T12:00")) / np.timedelta64(1, "s") / 86400.0
    century = days / 36525.0
    longitude = np.radians(_MEAN_LONGITUDE + _MEAN_MOTION * century + _series(_LONGITUDE, century, np.sin))
    latitude = np.radians(_series(_LATITUDE, century, np.sin))
    parallax = np.radians(_MEAN_PARALLAX + _series(_PARALLAX, century, np.cos))
    tilt = np.radians(23.439 - 0.0130 * century)  # of the ecliptic against the equator
    x, across, up = np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude), np.sin(latitude)
    y, z = np.cos(tilt) * across - np.sin(tilt) * up, np.sin(tilt) * across + np.cos(tilt) * up
    turned = np.radians(280.46062 + 360.98564737 * days + site.longitude)  # sidereal time there [Seidelmann1992]
    towards = np.cos(turned) * x + np.sin(turned) * y  # in the plane of the meridian
    east = np.cos(turned) * y - np.sin(turned) * x
    lie = np.radians(site.latitude)
    north = np.cos(lie) * z - np.sin(lie) * towards
    zenith = np.cos(lie) * towards + np.sin(lie) * z - np.sin(parallax)  # the site stands off the Earth's middle
    vector = np.stack([east, north, zenith], axis=-1)
    return np.asarray(vector / np.linalg.norm(vector, axis=-1, keepdims=True))


def _series(terms: FloatArray, century: FloatArray, wave: np.ufunc) -> FloatArray:
    amplitude, phase, rate = terms.T
    return np.asarray(wave(np.radians(phase + rate * century[..., None])) @ amplitude)
