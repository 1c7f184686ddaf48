"""Rain on surfaces: what reaches them by their orientation, the heat it takes up, the film of water that stays.

Section 3.1.3 of [Report1978]: by rate, wind and orientation some water hits each square metre, is heated from its own
temperature to the surface's, and evaporates. Rain has the temperature of the air, from which it differs by a kelvin or
two at most in the damp air of rain. Below freezing it falls as snow, which stays on the ground only.
"""

import numpy as np

from sensorsim.constants import SECONDS_PER_HOUR, STEFAN_BOLTZMANN_CONSTANT, ZERO_CELSIUS
from sensorsim.environment import Environment
from sensorsim.thermal.grid import FloatArray
from sensorsim.thermal.heat_balance import Exposure
from sensorsim.thermal.vapour import latent_heat, potential_evaporation

WATER_SPECIFIC_HEAT = 4186.0  # [J kg-1 K-1] at 15 C, by the calorie of that temperature [NIST811]
DRIVEN_COEFFICIENT, DRIVEN_POWER = 2.0 / 9.0, 8.0 / 9.0  # of rain on a wall facing the wind [ISO15927]
FILM_CAPACITY = 0.25  # [kg m-2] that stays on buildings [Jarvi2011]
LEAF_CAPACITY = 0.2  # [kg m-2] on each unit of leaf area [Dickinson1984]
WET_SHARE_POWER = 2.0 / 3.0  # of the film's fullness, for the share of the surface it covers [Deardorff1978]
WET_ABSORPTANCE = 0.7  # [-] of sun, for how fast the film dries, estimate; the balance has the surface's own


def caught_rain(environment: Environment, normal: FloatArray) -> FloatArray:
    """Rain (t, o) [kg m-2 s-1] that hits orientations (o, 3): falling on tops, driven by the wind on walls."""
    rate = np.where(environment.air_temperature > ZERO_CELSIUS, environment.precipitation, 0.0)  # [mm h-1]
    angle = np.radians(environment.wind_direction)
    against = np.stack([np.sin(angle), np.cos(angle)], axis=-1) @ normal[:, :2].T
    driven = (DRIVEN_COEFFICIENT * environment.wind_speed * rate**DRIVEN_POWER)[:, None] * against
    return np.asarray(np.maximum(np.outer(rate, normal[:, 2]) + driven, 0.0) / SECONDS_PER_HOUR)


def rain_film(caught: FloatArray) -> FloatArray:
    """Film [W m-2 K-1] by which rain that runs off at the surface's temperature exchanges heat with it."""
    return np.asarray(WATER_SPECIFIC_HEAT * caught)


def wet_share(
    environment: Environment, exposure: Exposure, caught: FloatArray, film: FloatArray, capacity: float, pressure: float
) -> FloatArray:
    """Share (t, o) [-] of the surface under a film of water, which rain fills to `capacity` [kg m-2] and air dries.

    It dries at the potential rate, computed ahead, at which a surface without heat capacity would [Penman1948].
    """
    air, step = environment.air_temperature[:, None], environment.step
    net = WET_ABSORPTANCE * exposure.irradiance + exposure.longwave - STEFAN_BOLTZMANN_CONSTANT * air**4
    heat = potential_evaporation(net, film, air, environment.vapour_pressure[:, None], pressure)
    dried = np.maximum(heat, 0.0) / latent_heat(air)
    kept = np.zeros_like(caught)
    for sample in range(1, len(kept)):
        gained = step * (caught[sample - 1] - dried[sample - 1])
        kept[sample] = np.clip(kept[sample - 1] + gained, 0.0, capacity)
    return np.asarray((kept / capacity) ** WET_SHARE_POWER)
