"""What drives a surface from outside: weather read from files, the sun, the sky, the ground and the air in between.

`read_weather` reads a station's record, an EPW or a TMY3 file, `build_environment` adds sun and sky on a uniform time
grid for the thermal model, and `Environment.at` gives the state at one moment for drawing a frame.
"""

from sensorsim.environment.air_mass import relative_air_mass
from sensorsim.environment.air_path import AirPath, clear_path, right_angle_phase, single_term
from sensorsim.environment.atmosphere import LAPSE_RATE, Transmittance, attenuation_coefficient, band_transmittance
from sensorsim.environment.band_sky import BandSky, band_sky, clear_sky_emissivity, zenith_emissivity
from sensorsim.environment.build import DEFAULT_VISIBILITY, build_environment, longest_lead_in
from sensorsim.environment.environment import Environment
from sensorsim.environment.ground import GROUND_ALBEDO, SNOW_MAXIMUM_TEMPERATURE, ground_albedo
from sensorsim.environment.humidity import saturation_vapour_pressure, vapour_density, vapour_pressure
from sensorsim.environment.moon import Moonlight, moonlight
from sensorsim.environment.near_infrared import NearInfrared, near_infrared
from sensorsim.environment.night import NIGHT_GLOW, twilight_irradiance
from sensorsim.environment.perez_sky import (
    SkyBrightness,
    circumsolar_irradiance,
    perez_irradiance,
    sky_brightness,
)
from sensorsim.environment.place_check import check_place, great_circle_distance, place_mismatch
from sensorsim.environment.quadrants import (
    QUADRANT_AZIMUTH,
    QUADRANT_NAMES,
    QUADRANT_SOLID_ANGLE,
    circumsolar_share,
    quadrant_irradiance,
)
from sensorsim.environment.sample import EnvironmentSample
from sensorsim.environment.site import Site
from sensorsim.environment.sky_glow import SkyGlow, clear_glow, overcast_radiance
from sensorsim.environment.sun import (
    SUN_RADIUS,
    Sunlight,
    SunPosition,
    clear_sunlight,
    linke_turbidity,
    sun_position,
    sunlight_under_cloud,
)
from sensorsim.environment.thermal_sky import (
    CLOUD_EMISSIVITY,
    CLOUD_TEMPERATURE_DEPRESSION,
    clear_sky_irradiance_dilley,
    clear_sky_irradiance_prata,
    sky_irradiance,
    sky_temperature,
)
from sensorsim.environment.weather import GROUND_STATES, Weather, resample_weather
from sensorsim.environment.weather_file import read_weather

__all__ = [
    "CLOUD_EMISSIVITY",
    "CLOUD_TEMPERATURE_DEPRESSION",
    "DEFAULT_VISIBILITY",
    "GROUND_ALBEDO",
    "GROUND_STATES",
    "LAPSE_RATE",
    "NIGHT_GLOW",
    "QUADRANT_AZIMUTH",
    "QUADRANT_NAMES",
    "QUADRANT_SOLID_ANGLE",
    "SNOW_MAXIMUM_TEMPERATURE",
    "SUN_RADIUS",
    "AirPath",
    "BandSky",
    "Environment",
    "EnvironmentSample",
    "Moonlight",
    "NearInfrared",
    "Site",
    "SkyBrightness",
    "SkyGlow",
    "SunPosition",
    "Sunlight",
    "Transmittance",
    "Weather",
    "attenuation_coefficient",
    "band_sky",
    "band_transmittance",
    "build_environment",
    "check_place",
    "circumsolar_irradiance",
    "circumsolar_share",
    "clear_glow",
    "clear_path",
    "clear_sky_emissivity",
    "clear_sky_irradiance_dilley",
    "clear_sky_irradiance_prata",
    "clear_sunlight",
    "great_circle_distance",
    "ground_albedo",
    "linke_turbidity",
    "longest_lead_in",
    "moonlight",
    "near_infrared",
    "overcast_radiance",
    "perez_irradiance",
    "place_mismatch",
    "quadrant_irradiance",
    "read_weather",
    "relative_air_mass",
    "resample_weather",
    "right_angle_phase",
    "saturation_vapour_pressure",
    "single_term",
    "sky_brightness",
    "sky_irradiance",
    "sky_temperature",
    "sun_position",
    "sunlight_under_cloud",
    "twilight_irradiance",
    "vapour_density",
    "vapour_pressure",
    "zenith_emissivity",
]
