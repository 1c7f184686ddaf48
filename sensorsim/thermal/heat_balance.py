"""What the environment does to the exterior face of a surface, for every orientation and sample.

Section 3.1.3 and 3.6.1 of [Report1978]: sun by its angle to the surface, daylight from the sky, sunlight from the
ground, thermal sky and ground by their view factors, convection to the air. There are two skies (SKIES):

perez      daylight by a dome, a glow around the sun and a bright horizon [Perez1990]; thermal radiation that grows
           towards the horizon.
quadrants  the report's: daylight of one radiance from each of four quarters, thermal radiation of one from all over.
"""

from dataclasses import dataclass

import numpy as np

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.effects import EVERYTHING, QUARTERS, EffectPlan
from sensorsim.environment import Environment, circumsolar_irradiance, perez_irradiance
from sensorsim.errors import InputError
from sensorsim.thermal.air_properties import air_at, pressure_at
from sensorsim.thermal.boundary import Outside
from sensorsim.thermal.convection import forced_film, free_film_cubed
from sensorsim.thermal.grid import FloatArray
from sensorsim.thermal.view_factors import ground_view_factor, quadrant_view_factors, sky_view_factor

SKIES = ("perez", "quadrants")
# Fitted to the radiances of [LOWTRAN7] for six model atmospheres, clear and overcast, within 3 W m-2 at any tilt.
HORIZON_WARMTH = 0.11


@dataclass(frozen=True, slots=True, kw_only=True)
class Exposure:
    """Radiation on a set of orientations: the same for all wall types."""

    normal: FloatArray  # (o, 3)
    irradiance: FloatArray  # (t, o) solar, beam, diffuse and from the ground [W m-2]
    longwave: FloatArray  # (t, o) from sky and ground [W m-2]


def solar_irradiance(
    environment: Environment, normal: FloatArray, *, sky: str = "perez", plan: EffectPlan = EVERYTHING
) -> FloatArray:
    """Solar irradiance (t, o) [W m-2] on orientations (o, 3)."""
    total = np.zeros((environment.time.size, normal.shape[0]))
    if plan.has("direct_sun"):
        total += environment.beam_irradiance[:, None] * np.maximum(environment.sun_direction @ normal.T, 0.0)
    if plan.any_of("sky_dome", "sky_glow", "sky_horizon", *QUARTERS):
        total += sky_irradiance(environment, normal, sky=sky, plan=plan)
    if plan.has("ground_sun"):
        total += np.outer(reflected_irradiance(environment), ground_view_factor(normal))
    return total


def sky_irradiance(
    environment: Environment, normal: FloatArray, *, sky: str = "perez", plan: EffectPlan = EVERYTHING
) -> FloatArray:
    """Diffuse solar irradiance (t, o) [W m-2] from the sky, one of SKIES, on orientations (o, 3).

    The quarters, each of one radiance, give walls 25 to 55 % less than the sky of [Perez1990] under a clear sky, whose
    horizon is bright; level surfaces get the same from both while the sun stands 5 degrees high.
    """
    _require_sky(sky)
    if sky == "quadrants":
        seen = np.array([plan.has(name) for name in QUARTERS])
        return np.asarray(4.0 * environment.quadrant_irradiance[:, seen] @ quadrant_view_factors(normal)[:, seen].T)
    return perez_irradiance(
        environment.diffuse_irradiance,
        environment.sky_brightness,
        environment.sun_direction,
        normal,
        dome=plan.has("sky_dome"),
        glow=plan.has("sky_glow"),
        horizon=plan.has("sky_horizon"),
    )


def directional_irradiance(
    environment: Environment, *, sky: str = "perez", plan: EffectPlan = EVERYTHING
) -> FloatArray:
    """Irradiance (t,) [W m-2] on a plane normal to the sun of all light that comes from its direction.

    The beam, and under the 'perez' sky the glow around the sun: what falls on a surface by the cosine of its angle to
    the sun and ends where the sun sets on it.
    """
    _require_sky(sky)
    beam = environment.beam_irradiance if plan.has("direct_sun") else np.zeros_like(environment.beam_irradiance)
    if sky == "quadrants" or not plan.has("sky_glow"):
        return beam
    glow = circumsolar_irradiance(environment.diffuse_irradiance, environment.sky_brightness, environment.sun_direction)
    return np.asarray(beam + glow)


def reflected_irradiance(environment: Environment) -> FloatArray:
    """Radiosity (t,) of the sunlit ground plane [W m-2]."""
    height = np.maximum(environment.sun_direction[:, 2], 0.0)
    total = environment.beam_irradiance * height + environment.diffuse_irradiance
    return np.asarray(environment.ground_albedo * total)


def longwave_irradiance(
    environment: Environment, normal: FloatArray, ground: FloatArray, *, sky: str = "perez",
    plan: EffectPlan = EVERYTHING,
) -> FloatArray:  # fmt: skip
    """Thermal irradiance (t, o) [W m-2] from the sky and from a ground of temperature (t,) [K], a near black body.

    The sky's temperature is that of what a level surface receives. A wall sees more of the horizon, where the air is
    thick and all but as warm as on the ground: under 'perez' it gets HORIZON_WARMTH sin(tilt)^1.5 of what the sky
    lacks of a black body at air temperature besides, 7 to 11 W m-2 under a clear sky. What the plan leaves out, of sky
    and ground, is as warm as the air.
    """
    _require_sky(sky)
    air = STEFAN_BOLTZMANN_CONSTANT * environment.air_temperature**4
    level = STEFAN_BOLTZMANN_CONSTANT * environment.sky_temperature**4 if plan.has("thermal_sky") else air
    soil = STEFAN_BOLTZMANN_CONSTANT * ground**4 if plan.has("ground_exchange") else air
    total = np.outer(level, sky_view_factor(normal)) + np.outer(soil, ground_view_factor(normal))
    if sky == "perez" and plan.has("thermal_sky"):
        lacking = air - level
        total += np.outer(HORIZON_WARMTH * lacking, np.hypot(normal[:, 0], normal[:, 1]) ** 1.5)
    return np.asarray(total)


def expose(
    environment: Environment, normal: FloatArray, ground: FloatArray, *, sky: str = "perez",
    plan: EffectPlan = EVERYTHING,
) -> Exposure:  # fmt: skip
    """Radiation on orientations (o, 3) over a ground of temperature (t,) [K] under one of SKIES."""
    return Exposure(
        normal=normal,
        irradiance=solar_irradiance(environment, normal, sky=sky, plan=plan),
        longwave=longwave_irradiance(environment, normal, ground, sky=sky, plan=plan),
    )


def outside_of(
    environment: Environment,
    exposure: Exposure,
    *,
    emissivity: float,
    roughness: str,
    correlation: str = "mowitt",
    length: float | None = None,
    plan: EffectPlan = EVERYTHING,
) -> Outside:
    """Exterior boundary of a wall of a long-wave emissivity and a roughness class.

    `correlation` is one of `convection.CORRELATIONS`, `length` [m] that of the surface along the wind, which some of
    them need. Air has the pressure of the site's altitude; free convection that of the mean temperature.
    """
    pressure = pressure_at(environment.site.altitude)
    film, still = np.zeros(exposure.irradiance.shape), np.zeros(exposure.normal.shape[0])
    free, colder = still, still
    if plan.has("forced_convection"):
        film = forced_film(
            exposure.normal,
            environment.wind_speed,
            environment.wind_direction,
            roughness,
            correlation=correlation,
            length=length,
            air=air_at(environment.air_temperature, pressure),
        )
    if plan.has("free_convection"):
        mean = air_at(float(environment.air_temperature.mean()), pressure)
        free = free_film_cubed(exposure.normal, air=mean)
        colder = free_film_cubed(exposure.normal, air=mean, warmer=False)
    return Outside(
        exposure.irradiance, exposure.longwave, film, free, environment.air_temperature, emissivity, free_colder=colder
    )


def _require_sky(sky: str) -> None:
    if sky not in SKIES:
        raise InputError("heat balance", "sky", sky, "unknown", f"use one of {', '.join(SKIES)}")
