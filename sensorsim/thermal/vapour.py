"""Water vapour between a surface and the air: what turns a film of heat into one of vapour.

A film h [W m-2 K-1] carries vapour as it carries heat (Lewis number one), so that a wet surface loses h / gamma for
each pascal that its saturation pressure exceeds the air's; gamma is the psychrometric constant.
"""

import numpy as np

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT, ZERO_CELSIUS
from sensorsim.environment import saturation_vapour_pressure
from sensorsim.thermal.air_properties import SPECIFIC_HEAT
from sensorsim.thermal.grid import FloatArray

VAPOUR_OVER_AIR = 0.622  # [-] molar masses [Allen1998]


def latent_heat(temperature: FloatArray) -> FloatArray:
    """Heat of evaporation [J kg-1] at a temperature [K] [Allen1998 eq. 3-1]."""
    return np.asarray(2.501e6 - 2361.0 * (temperature - ZERO_CELSIUS))


def psychrometric_constant(temperature: FloatArray, pressure: float) -> FloatArray:
    """Psychrometric constant [Pa K-1] of air [K] at a pressure [Pa] [Allen1998 eq. 8]; about 66 at sea level."""
    return np.asarray(SPECIFIC_HEAT * pressure / (VAPOUR_OVER_AIR * latent_heat(temperature)))


def saturation_slope(temperature: FloatArray) -> FloatArray:
    """Rise of the saturation pressure with temperature [Pa K-1] at a temperature [K]."""
    celsius = temperature - ZERO_CELSIUS
    return np.asarray(saturation_vapour_pressure(temperature) * 17.625 * 243.04 / (celsius + 243.04) ** 2)


def potential_evaporation(
    net: FloatArray, film: FloatArray, air: FloatArray, vapour: FloatArray, pressure: float
) -> FloatArray:
    """Latent heat [W m-2] that a wet surface without heat capacity gives off: the law of [Penman1948].

    Parameters
    ----------
    net : radiation that the surface would keep at air temperature [W m-2]; what it sheds by being warmer is counted
    film : convective [W m-2 K-1]
    air, vapour : temperature [K] and vapour pressure [Pa] of the air
    pressure : of the air [Pa]
    """
    total = film + 4.0 * STEFAN_BOLTZMANN_CONSTANT * air**3
    slope, deficit = saturation_slope(air), saturation_vapour_pressure(air) - vapour
    resistance = psychrometric_constant(air, pressure) * total / np.maximum(film, 1e-3)
    return np.asarray((slope * net + total * deficit) / (slope + resistance))
