"""What the environment does to the exterior face of a surface, for every orientation and sample.

Section 3.1.3 and 3.6.1 of [Report1978]: sun by its angle to the surface, four diffuse quarters of the sky, sunlight
from the ground, thermal sky and ground by their view factors, convection to the air.
"""

from dataclasses import dataclass

import numpy as np

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.environment import Environment
from sensorsim.thermal.convection import forced_film, free_film_cubed
from sensorsim.thermal.grid import FloatArray
from sensorsim.thermal.kernel import Outside
from sensorsim.thermal.view_factors import ground_view_factor, quadrant_view_factors, sky_view_factor


@dataclass(frozen=True, slots=True, kw_only=True)
class Exposure:
    """Radiation on a set of orientations: the same for all wall types."""

    normal: FloatArray  # (o, 3)
    irradiance: FloatArray  # (t, o) solar, beam, diffuse and from the ground [W m-2]
    longwave: FloatArray  # (t, o) from sky and ground [W m-2]


def solar_irradiance(environment: Environment, normal: FloatArray) -> FloatArray:
    """Solar irradiance (t, o) [W m-2] on orientations (o, 3)."""
    beam = environment.beam_irradiance[:, None] * np.maximum(environment.sun_direction @ normal.T, 0.0)
    diffuse = 4.0 * environment.quadrant_irradiance @ quadrant_view_factors(normal).T
    return np.asarray(beam + diffuse + reflected_irradiance(environment)[:, None] * ground_view_factor(normal))


def reflected_irradiance(environment: Environment) -> FloatArray:
    """Radiosity (t,) of the sunlit ground plane [W m-2]."""
    height = np.maximum(environment.sun_direction[:, 2], 0.0)
    total = environment.beam_irradiance * height + environment.diffuse_irradiance
    return np.asarray(environment.ground_albedo * total)


def longwave_irradiance(environment: Environment, normal: FloatArray, ground: FloatArray) -> FloatArray:
    """Thermal irradiance (t, o) [W m-2] from the sky and from a ground of temperature (t,) [K], a near black body."""
    sky = STEFAN_BOLTZMANN_CONSTANT * environment.sky_temperature**4
    soil = STEFAN_BOLTZMANN_CONSTANT * ground**4
    return np.asarray(np.outer(sky, sky_view_factor(normal)) + np.outer(soil, ground_view_factor(normal)))


def expose(environment: Environment, normal: FloatArray, ground: FloatArray) -> Exposure:
    """Radiation on orientations (o, 3) over a ground of temperature (t,) [K]."""
    return Exposure(
        normal=normal,
        irradiance=solar_irradiance(environment, normal),
        longwave=longwave_irradiance(environment, normal, ground),
    )


def outside_of(environment: Environment, exposure: Exposure, *, emissivity: float, roughness: str) -> Outside:
    """Exterior boundary of a wall of the given long-wave emissivity and roughness class."""
    film = forced_film(exposure.normal, environment.wind_speed, environment.wind_direction, roughness)
    return Outside(
        exposure.irradiance,
        exposure.longwave,
        film,
        free_film_cubed(exposure.normal),
        environment.air_temperature,
        emissivity,
    )
