"""Exterior boundary of any surface: walls as they are, and the simplest credible model of each natural surface.

Natural surfaces (`materials.Cover`) exchange heat with the air through the resistance of the layer above them,

    r_a = ln((z - d) / z0) ln((z' - d) / (0.1 z0)) / (k^2 U)   [s m-1],

[Allen1998 eq. 4], where z and z' are 10 m, of the wind, and 2 m, of the air's temperature, above them, the same for all
orientations, as a crown or a meadow is porous. Plants have d = 2/3 and z0 = 0.123 of their height. U is the wind with
the gusts of the day's free convection [Beljaars1995], which stand in for the free film. Vapour takes the same way, and
a further one: none for water, snow and wet surfaces; for soil a share, its `moisture`; through the stomata of a canopy
as one big leaf, which opens by the light from above [Jarvis1976, Stewart1988],

    r_s = r_least / (LAI f_light f_deficit f_temperature).

Dew forms on what evaporates, where its surface is colder than the air's dew point; not on dry walls.
"""

import numpy as np

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.environment import Environment, saturation_vapour_pressure
from sensorsim.materials import Cover, WallType
from sensorsim.thermal.air_properties import GRAVITY, SPECIFIC_HEAT, air_at, pressure_at
from sensorsim.thermal.boundary import Outside
from sensorsim.thermal.convection import ROUGHNESS_FACTOR
from sensorsim.thermal.grid import FloatArray
from sensorsim.thermal.heat_balance import Exposure, outside_of
from sensorsim.thermal.rain import FILM_CAPACITY, LEAF_CAPACITY, caught_rain, rain_film, wet_share
from sensorsim.thermal.vapour import psychrometric_constant

VON_KARMAN = 0.41  # [Allen1998]
WIND_HEIGHT, AIR_HEIGHT = 10.0, 2.0  # [m] above the surface, of a weather station's instruments
DISPLACEMENT, ROUGHNESS, HEAT_ROUGHNESS = 2.0 / 3.0, 0.123, 0.1  # of plant height, of it, of z0 [Allen1998]
MIXED_LAYER = 1000.0  # [m] depth of the air that the day stirs [Beljaars1995]
HEATING_SHARE = 0.2  # [-] of the sunlight that a landscape hands on to the air as heat, estimate
LEAST_GUST = 0.2  # [m s-1] by night [Fairall2003]
LIGHT = (0.004, 0.05, 0.81)  # b [m2 W-1], c, a of f_light = (b S + c) / (a (b S + 1)) [IFS2020]
BEST_TEMPERATURE, TEMPERATURE_SENSITIVITY = 298.0, 0.0016  # [K], [K-2] [NoilhanPlanton1989]
CLOSED = 1e-3  # [-] least opening of the stomata, estimate
STILL_WATER_CONDUCTIVITY = 0.6  # [W m-1 K-1] at 10 C [EN12524]
DAY_OF_TRAFFIC = (6.0, 22.0)  # [h] estimate
FREE_DIFFERENCE = 3.0  # [K] from the air, that the free film is taken at where a wet wall's vapour needs it beforehand
AERODYNAMIC = ("soil", "plants", "water", "snow")


def surface_boundary(
    environment: Environment, exposure: Exposure, wall: WallType, *, correlation: str = "mowitt",
    plan: EffectPlan = EVERYTHING, smooth: Outside | None = None,
) -> Outside:  # fmt: skip
    """What acts on the exterior face of a wall type: building, soil, plants, water, snow or road, in rain and sun.

    `smooth` is what acts on a very smooth building, where by the correlation the roughness only multiplies its film,
    for who has it already: the same for all wall types.
    """
    cover = wall.cover
    if smooth is None:
        outside = outside_of(
            environment, exposure, emissivity=wall.emissivity, roughness=wall.roughness, correlation=correlation,
            length=wall.characteristic_length, plan=plan,
        )  # fmt: skip
    else:
        outside = smooth._replace(film=ROUGHNESS_FACTOR[wall.roughness] * smooth.film, emissivity=wall.emissivity)
    if cover is not None and cover.kind in AERODYNAMIC:
        film, still = np.zeros(exposure.irradiance.shape), np.zeros_like(outside.free)
        if plan.has("forced_convection"):
            film = aerodynamic_film(environment, cover)[:, None] * np.ones(exposure.normal.shape[0])
        sunlight = cover.interception * exposure.irradiance
        outside = outside._replace(film=film, free=still, free_colder=still, irradiance=sunlight)
    if cover is not None and cover.traffic_heat > 0.0:
        heat = cover.traffic_heat * _by_day(environment) / wall.emissivity  # the balance takes this share of long waves
        outside = outside._replace(longwave=outside.longwave + heat[:, None])
    return _moisten(environment, exposure, wall, outside, plan)


def aerodynamic_film(environment: Environment, cover: Cover) -> FloatArray:
    """Film (t,) [W m-2 K-1] of the air above a natural surface."""
    roughness = ROUGHNESS * cover.height if cover.kind == "plants" else cover.roughness_length
    crown = cover.height * (1.0 - DISPLACEMENT)
    profile = np.log((WIND_HEIGHT + crown) / roughness) * np.log((AIR_HEIGHT + crown) / (HEAT_ROUGHNESS * roughness))
    density = air_at(environment.air_temperature, pressure_at(environment.site.altitude)).density
    return np.asarray(density * SPECIFIC_HEAT * VON_KARMAN**2 / profile * effective_wind(environment))


def effective_wind(environment: Environment) -> FloatArray:
    """Wind (t,) [m s-1] with the gusts of free convection, w* = (g / T H / (rho c) z_i)^(1/3) [Beljaars1995].

    The heat H that a landscape gives to the air is a share of the sunlight; without sun the least gust remains.
    """
    state = air_at(environment.air_temperature, pressure_at(environment.site.altitude))
    flux = HEATING_SHARE * sunlight_from_above(environment) / (state.density * SPECIFIC_HEAT)  # [K m s-1]
    gust = np.maximum(np.cbrt(GRAVITY / state.temperature * flux * MIXED_LAYER), LEAST_GUST)
    return np.asarray(np.hypot(environment.wind_speed, gust))


def sunlight_from_above(environment: Environment) -> FloatArray:
    """Direct and diffuse light (t,) on level ground [W m-2]."""
    height = np.maximum(environment.sun_direction[:, 2], 0.0)
    return np.asarray(environment.beam_irradiance * height + environment.diffuse_irradiance)


def canopy_resistance(environment: Environment, cover: Cover) -> FloatArray:
    """Resistance (t,) [s m-1] of the stomata of all leaves together, which open by the light from above."""
    sunlight, (slope, least, scale) = sunlight_from_above(environment), LIGHT
    light = np.minimum((slope * sunlight + least) / (scale * (slope * sunlight + 1.0)), 1.0)
    air = environment.air_temperature
    deficit = np.maximum(saturation_vapour_pressure(air) - environment.vapour_pressure, 0.0)
    dryness = np.exp(-cover.deficit_sensitivity * deficit)
    warmth = np.clip(1.0 - TEMPERATURE_SENSITIVITY * (BEST_TEMPERATURE - air) ** 2, 0.0, 1.0)
    opening = np.maximum(light * dryness * warmth, CLOSED)
    return np.asarray(cover.stomatal_resistance / (cover.leaf_area_index * opening))


def cool_skin(temperature: FloatArray, outside: Outside, record: np.ndarray, cover: Cover) -> FloatArray:
    """Temperature (r, o, a) [K] of the skin of water whose upper layer has `temperature` at the samples `record`.

    The sun warms what lies below; the heat lost at the surface itself has to come up through a layer of still water.
    """
    lost = outside.emissivity * (STEFAN_BOLTZMANN_CONSTANT * temperature**4 - outside.longwave[record, :, None])
    lost += outside.film[record, :, None] * (temperature - outside.air[record, None, None])
    pressure = saturation_vapour_pressure(temperature)
    lost += outside.latent[record, :, None] * (pressure - outside.vapour[record, None, None])
    return np.asarray(temperature - cover.skin / STILL_WATER_CONDUCTIVITY * lost)


def melting_depth(wall: WallType) -> float:
    """Thickness [m] of the snow that a wall type begins with; 0 without."""
    return wall.layers[0].thickness if wall.cover is not None and wall.cover.kind == "snow" else 0.0


def _moisten(
    environment: Environment, exposure: Exposure, wall: WallType, outside: Outside, plan: EffectPlan
) -> Outside:
    """The boundary with rain and evaporation; without any film of air nothing takes vapour away."""
    cover, pressure = wall.cover, pressure_at(environment.site.altitude)
    film, wet = outside.film, np.zeros(outside.film.shape)
    if plan.has("rain") and np.any(environment.precipitation > 0.0):
        caught = caught_rain(environment, exposure.normal)
        capacity = FILM_CAPACITY if cover is None else max(FILM_CAPACITY, LEAF_CAPACITY * cover.leaf_area_index)
        drying = _with_free(film, outside)
        wet = wet_share(environment, exposure, caught, drying, capacity, pressure)
        outside = outside._replace(film=film + rain_film(caught))
    if wall.interior == "none" and (cover is None or cover.kind in ("soil", "road")):
        wet = np.where((environment.ground_state == "wet")[:, None], 1.0, wet)
    always = cover is not None and cover.kind in AERODYNAMIC
    if not (plan.has("evaporation") and (always or np.any(wet > 0.0))):
        return outside
    film = _with_free(film, outside)
    if not np.any(film > 0.0):
        return outside
    share = _evaporating_share(environment, cover, film, wet)
    if not np.any(share > 0.0):
        return outside
    gamma = psychrometric_constant(environment.air_temperature, pressure)[:, None]
    return outside._replace(latent=share * film / gamma, vapour=environment.vapour_pressure)


def _with_free(film: FloatArray, outside: Outside) -> FloatArray:
    """Film (t, o) [W m-2 K-1] with the free one, as it is at FREE_DIFFERENCE from the air."""
    return np.cbrt(film**3 + FREE_DIFFERENCE * outside.free) if np.any(outside.free) else film


def _evaporating_share(environment: Environment, cover: Cover | None, film: FloatArray, wet: FloatArray) -> FloatArray:
    """Vapour that leaves a surface over what would if it were water (t, o) [-], at the same temperature."""
    if cover is None or cover.kind == "road":
        return wet
    if cover.kind in ("water", "snow"):
        return np.ones_like(wet)
    if cover.kind == "soil":
        return np.maximum(wet, cover.moisture)
    if cover.leaf_area_index <= 0.0:
        return wet
    state = air_at(environment.air_temperature, pressure_at(environment.site.altitude))
    air_resistance = (state.density * SPECIFIC_HEAT)[:, None] / film
    dry = air_resistance / (air_resistance + canopy_resistance(environment, cover)[:, None])
    return np.asarray(wet + (1.0 - wet) * dry)


def _by_day(environment: Environment) -> FloatArray:
    """1 in the hours of traffic, else 0 (t,)."""
    begin = environment.start.hour + environment.start.minute / 60.0 + environment.start.second / 3600.0
    hour = (begin + environment.time / 3600.0) % 24.0
    return np.asarray((hour >= DAY_OF_TRAFFIC[0]) & (hour < DAY_OF_TRAFFIC[1]), dtype=np.float64)
