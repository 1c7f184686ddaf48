"""Radiance of the sky in the 8-14 um window against elevation: what a mirror or the background of a frame shows.

The window is clear, so the zenith of a dry sky is some 60 K colder than the air, and only the horizon is as warm. The
sky is two sources: air near the ground, at air temperature, and cloud base, a few kelvin colder. With shares a and c,

    band radiance = a B(T_air) + c B(T_air - CLOUD_TEMPERATURE_DEPRESSION).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment.air_mass import relative_air_mass
from sensorsim.environment.thermal_sky import CLOUD_EMISSIVITY

FloatArray = NDArray[np.float64]

# Zenith emissivity of the clear sky in 8-14 um against vapour pressure [Pa]: the six model atmospheres of [LOWTRAN7].
_VAPOUR_PRESSURE = np.array([140.0, 440.0, 780.0, 1200.0, 1900.0, 2600.0])
_ZENITH_EMISSIVITY = np.array([0.219, 0.241, 0.269, 0.343, 0.432, 0.528])
_GREATEST_ZENITH_EMISSIVITY = 0.95
# The path is not grey, so depth grows as a power of the air mass less than 1: this one high up, by zenith emissivity,
# turning into that of the horizon with the square of ln m. The rest are fitted to the same atmospheres.
_AIR_MASS_EXPONENT = np.array([0.525, 0.565, 0.608, 0.660, 0.700, 0.705])
_HORIZON_EXPONENT = 0.72
_HORIZON_DEFICIT = 0.028  # the air that a level look ends in lies higher and is colder


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BandSky:
    """Emissivities [-] of the two parts of the sky for each elevation; together at most 1."""

    elevation: FloatArray  # [deg] above the horizon
    air: FloatArray  # of a blackbody at air temperature
    cloud: FloatArray  # of a blackbody at air temperature minus CLOUD_TEMPERATURE_DEPRESSION


def zenith_emissivity(vapour_pressure: FloatArray) -> FloatArray:
    """Emissivity [-] of the clear zenith in 8-14 um for a vapour pressure [Pa] at the ground.

    Linear between the model atmospheres (140 to 2600 Pa) and on beyond them along the last slope, never above 0.95.
    """
    inside = np.interp(vapour_pressure, _VAPOUR_PRESSURE, _ZENITH_EMISSIVITY)
    slope = np.diff(_ZENITH_EMISSIVITY) / np.diff(_VAPOUR_PRESSURE)
    below = slope[0] * np.minimum(vapour_pressure - _VAPOUR_PRESSURE[0], 0.0)
    beyond = slope[-1] * np.maximum(vapour_pressure - _VAPOUR_PRESSURE[-1], 0.0)
    return np.asarray(np.minimum(inside + below + beyond, _GREATEST_ZENITH_EMISSIVITY), dtype=np.float64)


def clear_sky_emissivity(elevation: FloatArray, zenith: FloatArray | float) -> FloatArray:
    """Emissivity [-] in 8-14 um of the clear sky at an elevation [deg], 0 to 90, from that of the zenith.

    1 - (1 - zenith)^(m^p) with the relative air mass m, less a little near the horizon: within 2.5 K of apparent
    temperature of the six atmospheres of [LOWTRAN7] at every elevation, mostly 1.
    """
    mass = relative_air_mass(elevation)
    high = np.interp(zenith, _ZENITH_EMISSIVITY, _AIR_MASS_EXPONENT)
    level = (np.log(mass) / np.log(relative_air_mass(np.zeros(())))) ** 2
    grown = 1.0 - (1.0 - zenith) ** (mass ** (high + (_HORIZON_EXPONENT - high) * level))
    return np.asarray(grown - _HORIZON_DEFICIT * grown**8, dtype=np.float64)


def band_sky(elevation: FloatArray, *, vapour_pressure: float, cloud_cover: float) -> BandSky:
    """Both parts of the 8-14 um sky at elevations [deg] from vapour pressure [Pa] and cloud cover [-]."""
    air = clear_sky_emissivity(elevation, zenith_emissivity(np.array(vapour_pressure)))
    return BandSky(elevation=elevation, air=air, cloud=cloud_cover * (1.0 - air) * CLOUD_EMISSIVITY)
