"""Water vapour in the air."""

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import ZERO_CELSIUS

FloatArray = NDArray[np.float64]
WATER_VAPOUR_GAS_CONSTANT = 461.52  # [J kg-1 K-1] R / (18.0153 g mol-1) [CODATA2018]


def saturation_vapour_pressure(air_temperature: FloatArray) -> FloatArray:
    """Saturation vapour pressure over water [Pa] at a temperature [K]; Magnus form of [Alduchov1996]."""
    celsius = air_temperature - ZERO_CELSIUS
    return np.asarray(610.94 * np.exp(17.625 * celsius / (celsius + 243.04)), dtype=np.float64)


def vapour_pressure(air_temperature: FloatArray, relative_humidity: FloatArray) -> FloatArray:
    """Vapour pressure [Pa] at an air temperature [K] and a relative humidity [-]."""
    return relative_humidity * saturation_vapour_pressure(air_temperature)


def vapour_density(air_temperature: FloatArray, relative_humidity: FloatArray) -> FloatArray:
    """Absolute humidity [kg m-3] at an air temperature [K] and a relative humidity [-]."""
    return vapour_pressure(air_temperature, relative_humidity) / (WATER_VAPOUR_GAS_CONSTANT * air_temperature)


def precipitable_water(air_temperature: FloatArray, pressure: FloatArray) -> FloatArray:
    """Water in the column [kg m-2] from air temperature [K] and vapour pressure [Pa] at the ground [Prata1996]."""
    return 4.65 * pressure / air_temperature
