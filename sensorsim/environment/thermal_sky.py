"""Long-wave radiation of the sky, all wavelengths together, for the heat balance of surfaces."""

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.environment.humidity import precipitable_water

FloatArray = NDArray[np.float64]

CLOUD_EMISSIVITY = 0.96  # [-] low and middle cloud, 0.95 to 0.99 by [LOWTRAN7]
CLOUD_TEMPERATURE_DEPRESSION = 5.0  # [K] cloud base below air temperature; estimate, 3 to 8 K for low and middle cloud


def clear_sky_irradiance_dilley(air_temperature: FloatArray, vapour_pressure: FloatArray) -> FloatArray:
    """Long-wave irradiance [W m-2] of a cloudless sky [DilleyOBrien1998] from air temperature [K] and vapour [Pa].

    Within 1.5 K r.m.s. of sky temperature of [LOWTRAN7] over its six model atmospheres.
    """
    water = precipitable_water(air_temperature, vapour_pressure)
    return np.asarray(59.38 + 113.7 * (air_temperature / 273.16) ** 6 + 96.96 * np.sqrt(water / 25.0), dtype=np.float64)


def clear_sky_irradiance_prata(air_temperature: FloatArray, vapour_pressure: FloatArray) -> FloatArray:
    """The same by the emissivity of [Prata1996]; within 2.2 K r.m.s. of [LOWTRAN7]."""
    water = precipitable_water(air_temperature, vapour_pressure) / 10.0  # the paper's unit: cm of water
    emissivity = 1.0 - (1.0 + water) * np.exp(-np.sqrt(1.2 + 3.0 * water))
    return np.asarray(emissivity * STEFAN_BOLTZMANN_CONSTANT * air_temperature**4, dtype=np.float64)


def sky_irradiance(clear: FloatArray, air_temperature: FloatArray, cloud_cover: FloatArray) -> FloatArray:
    """Long-wave irradiance [W m-2] with clouds over the share `cloud_cover` [-] of the sky.

    Cloud fills the gaps that water vapour and carbon dioxide leave in the spectrum, after [MartinBerdahl1984]:
    L = L_clear + n (1 - emissivity_clear) emissivity_cloud sigma T_cloud^4.
    """
    black = STEFAN_BOLTZMANN_CONSTANT * air_temperature**4
    cloud = CLOUD_EMISSIVITY * STEFAN_BOLTZMANN_CONSTANT * (air_temperature - CLOUD_TEMPERATURE_DEPRESSION) ** 4
    return np.asarray(clear + cloud_cover * np.maximum(1.0 - clear / black, 0.0) * cloud, dtype=np.float64)


def sky_temperature(air_temperature: FloatArray, vapour_pressure: FloatArray, cloud_cover: FloatArray) -> FloatArray:
    """Temperature [K] of the black hemisphere that radiates like the sky.

    From air temperature [K], vapour pressure [Pa] and cloud cover [-], with the clear sky of [DilleyOBrien1998].
    """
    clear = clear_sky_irradiance_dilley(air_temperature, vapour_pressure)
    irradiance = sky_irradiance(clear, air_temperature, cloud_cover)
    return np.asarray((irradiance / STEFAN_BOLTZMANN_CONSTANT) ** 0.25, dtype=np.float64)
