"""From weather to environment: the time grid, the sun, the sky and the ground of a lead-in and its image day."""

import math
from dataclasses import dataclass
from datetime import date, datetime, time, timedelta

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY, SECONDS_PER_HOUR, STEFAN_BOLTZMANN_CONSTANT
from sensorsim.environment.environment import Environment
from sensorsim.environment.ground import ground_albedo
from sensorsim.environment.humidity import vapour_pressure
from sensorsim.environment.measured_sunlight import measured_sunlight
from sensorsim.environment.moon import Moonlight, moonlight
from sensorsim.environment.near_infrared import NearInfrared, near_infrared
from sensorsim.environment.perez_sky import SkyBrightness, sky_brightness
from sensorsim.environment.quadrants import circumsolar_share, quadrant_irradiance
from sensorsim.environment.sun import Sunlight, SunPosition, clear_sunlight, sun_position, sunlight_under_cloud
from sensorsim.environment.thermal_sky import sky_temperature
from sensorsim.environment.typical_year import unroll_typical_year
from sensorsim.environment.weather import Weather, cut_weather, resample_weather
from sensorsim.errors import InputError

FloatArray = NDArray[np.float64]

LONGEST_LEAD_IN = 10  # [day] that is asked of a file that holds more
DEFAULT_VISIBILITY = 23_000.0  # [m] the standard clear rural atmosphere


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Light:
    position: SunPosition
    broadband: Sunlight
    quadrant: FloatArray
    brightness: SkyBrightness
    near: NearInfrared
    moon: Moonlight


def build_environment(
    weather: Weather,
    *,
    image_day: date,
    lead_in_days: float = 3.0,
    step: float = 300.0,
    visibility: float = DEFAULT_VISIBILITY,
    aerosol: str = "rural",
    city_glow: float = 0.0,
) -> Environment:
    """Environment from `lead_in_days` before the image day to its last midnight.

    Parameters
    ----------
    weather : covers the whole of it; a typical year covers any. Where it has measured sunlight or infrared
        radiation of the sky, these are taken, else sun and sky are modelled from cloud cover, air and humidity
    image_day : local date, standard time
    lead_in_days : [day] history before the image day, a whole number of steps
    step : [s] a whole number of them makes a day
    visibility : [m] meteorological range
    aerosol : kind of haze or fog, as `band_transmittance` knows them
    city_glow : [W m-2] irradiance of the horizontal by the sky over a city at night, 0.8-1.1 um; none over open land,
        where NIGHT_GLOW is all, and some ten times that near a town

    Raises
    ------
    InputError : an image day or lead-in that the weather does not cover, a step that does not divide the day.
    """
    lead_in = _lead_in_steps(weather, lead_in_days, step)
    image_start = datetime.combine(image_day, time(), weather.site.time_zone)
    start = image_start - timedelta(seconds=lead_in * step)
    if weather.typical_year:
        weather = unroll_typical_year(weather, start=start, image_start=image_start)
    _require_cover(weather, start, image_start)
    if not 0.0 <= city_glow < math.inf:
        raise InputError(weather.file, "city_glow", city_glow, "not an irradiance", "give 0 or more, in W/m2")
    grid: FloatArray = np.arange(lead_in + round(SECONDS_PER_DAY / step) + 1, dtype=np.float64) * step
    series = resample_weather(weather, grid + (start - weather.start).total_seconds())
    end = image_start + timedelta(days=1)
    light = _light(cut_weather(weather, start, end), series)
    return _assemble(
        series, light, start=start, image_start=image_start, step=step, air=(visibility, aerosol), city_glow=city_glow
    )


def longest_lead_in(weather: Weather, image_day: date) -> int:
    """Whole days of history that the weather holds before an image day, LONGEST_LEAD_IN at most."""
    if weather.typical_year:
        return LONGEST_LEAD_IN
    held = (datetime.combine(image_day, time(), weather.site.time_zone) - weather.start) // timedelta(days=1)
    return min(max(held, 0), LONGEST_LEAD_IN)


def _assemble(
    series: Weather,
    light: _Light,
    *,
    start: datetime,
    image_start: datetime,
    step: float,
    air: tuple[float, str],
    city_glow: float,
) -> Environment:
    """Put weather, sun, sky and ground on the grid together."""
    vapour = vapour_pressure(series.air_temperature, series.relative_humidity)
    return Environment(
        name=series.name,
        site=series.site,
        start=start, image_start=image_start, step=step,
        time=series.time - series.time[0],
        air_temperature=series.air_temperature,
        relative_humidity=series.relative_humidity,
        vapour_pressure=vapour,
        wind_speed=series.wind_speed,
        wind_direction=series.wind_direction,
        cloud_cover=series.cloud_cover,
        precipitation=series.precipitation,
        ground_state=series.ground_state,
        ground_albedo=ground_albedo(series.ground_state),
        visibility=air[0], aerosol=air[1],
        sun_direction=light.position.direction,
        sun_elevation=light.position.elevation,
        beam_irradiance=light.broadband.beam,
        diffuse_irradiance=light.broadband.diffuse,
        quadrant_irradiance=light.quadrant,
        circumsolar_brightness=light.brightness.circumsolar,
        horizon_brightness=light.brightness.horizon,
        sky_temperature=_sky_temperature(series, vapour),
        nir_beam=light.near.beam,
        nir_quadrant=light.near.quadrant + (light.moon.diffuse[:, None] + city_glow) / 4.0,
        moon_direction=light.moon.direction,
        moon_beam=light.moon.beam,
    )  # fmt: skip


def _light(weather: Weather, series: Weather) -> _Light:
    """Sun and daylight at the times of `series`, which is `weather` on a finer grid."""
    begin = np.datetime64(series.start.replace(tzinfo=None), "ms")
    local = begin + np.round(series.time * 1000.0).astype("timedelta64[ms]")
    utc = local - np.timedelta64(round(series.site.utc_offset * SECONDS_PER_HOUR * 1000.0), "ms")
    position = sun_position(series.site, utc)
    clear = clear_sunlight(series.site, position, local)
    if weather.direct_normal is None and weather.global_horizontal is None:
        light = sunlight_under_cloud(clear, position.elevation, series.cloud_cover)
    else:
        light = measured_sunlight(weather, series.time + (series.start - weather.start).total_seconds(), clear)
    share = circumsolar_share(light.beam, light.extraterrestrial)
    return _Light(
        position=position,
        broadband=light,
        quadrant=quadrant_irradiance(light.diffuse, position.azimuth, share),
        brightness=sky_brightness(light, position),
        near=near_infrared(clear, light, position, series.cloud_cover, share),
        moon=moonlight(series.site, utc, position, series.cloud_cover),
    )


def _sky_temperature(series: Weather, vapour: FloatArray) -> FloatArray:
    """Temperature (n,) [K] of the black hemisphere that radiates like the sky, measured or modelled."""
    if series.sky_infrared is None:
        return sky_temperature(series.air_temperature, vapour, series.cloud_cover)
    return np.asarray((series.sky_infrared / STEFAN_BOLTZMANN_CONSTANT) ** 0.25, dtype=np.float64)


def _lead_in_steps(weather: Weather, lead_in_days: float, step: float) -> int:
    """Number of steps before the image day."""
    remedy = "give a number of seconds that divides 86400, such as 300"
    if not (math.isfinite(step) and 1.0 <= step <= SECONDS_PER_HOUR and _whole(SECONDS_PER_DAY / step)):
        raise InputError(weather.file, "step", step, "does not divide the day, or is not within 1 s to 1 h", remedy)
    if not (math.isfinite(lead_in_days) and lead_in_days >= 0.0 and _whole(lead_in_days * SECONDS_PER_DAY / step)):
        raise InputError(weather.file, "lead_in_days", lead_in_days, "not a whole number of steps", "give whole days")
    return round(lead_in_days * SECONDS_PER_DAY / step)


def _whole(number: float) -> bool:
    return abs(number - round(number)) < 1e-6


def _require_cover(weather: Weather, start: datetime, image_start: datetime) -> None:
    """Refuse an image day or a lead-in that the weather does not cover."""
    end = image_start + timedelta(days=1)
    last = weather.start + timedelta(seconds=float(weather.time[-1]))
    day = image_start.date().isoformat()
    if image_start < weather.start or end > last:
        span = f"the file covers {weather.start.isoformat()} to {last.isoformat()}"
        raise InputError(
            weather.file, "image day", day, span, "choose a day that lies wholly within, or extend the file"
        )
    if start < weather.start:
        most = math.floor((image_start - weather.start) / timedelta(days=1))
        asked = (image_start - start) / timedelta(days=1)
        problem = f"the file begins only {weather.start.isoformat()}"
        raise InputError(
            weather.file, "lead-in in days", asked, problem, f"ask for {most} at most, or extend the file back"
        )
