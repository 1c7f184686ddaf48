"""Weather: what a station would have written down, on its own time grid and on any other."""

import math
from dataclasses import dataclass, fields, replace
from datetime import datetime, timedelta
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment.site import Site

FloatArray = NDArray[np.float64]
GROUND_STATES = ("dry", "wet", "snow")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Weather:
    """Surface weather at one site; arrays have shape (n,).

    What the sun and the sky sent down may have been measured, or not. Sunlight comes as direct and diffuse, or as
    global alone.
    """

    name: str
    file: Path
    notes: tuple[str, ...]
    site: Site
    start: datetime  # local standard time of the first sample, with its UTC offset
    time: FloatArray  # [s] since start, uniform, ascending
    air_temperature: FloatArray  # [K]
    relative_humidity: FloatArray  # [-] over water, 0 to 1
    wind_speed: FloatArray  # [m s-1]
    wind_direction: FloatArray  # [deg] clockwise from north, where the wind blows from
    cloud_cover: FloatArray  # [-] share of the sky, 0 to 1
    precipitation: FloatArray  # [mm h-1], holds until the next sample
    ground_state: NDArray[np.str_]  # 'dry', 'wet' or 'snow', holds until the next sample
    direct_normal: FloatArray | None = None  # [W m-2] sunlight on a plane normal to the sun
    diffuse_horizontal: FloatArray | None = None  # [W m-2] sunlight from the sky on the horizontal
    global_horizontal: FloatArray | None = None  # [W m-2] sunlight from sun and sky on the horizontal
    sky_infrared: FloatArray | None = None  # [W m-2] long-wave irradiance of the horizontal
    radiation_averaging: float = 0.0  # [s] up to the sample that radiation is the mean of; 0: of that moment
    typical_year: bool = False  # months from several years: day and hour count, the year of `start` does not

    @property
    def interval(self) -> float:
        """Time from sample to sample [s]."""
        return float(self.time[1] - self.time[0])


def cut_weather(weather: Weather, begin: datetime, end: datetime) -> Weather:
    """The samples that tell of `begin` to `end`: one before and one after, where there are such, and one to spare."""
    first = math.floor((begin - weather.start).total_seconds() / weather.interval)
    last = math.ceil((end - weather.start).total_seconds() / weather.interval) + 1
    kept = np.arange(max(first, 0), min(last + 1, weather.time.size))
    return take_samples(weather, kept, weather.start + timedelta(seconds=float(weather.time[kept[0]])))


def take_samples(weather: Weather, samples: NDArray[np.int64], start: datetime) -> Weather:
    """Samples by their indices, in a row from `start` on."""
    values = {field.name: getattr(weather, field.name) for field in fields(weather)}
    taken: dict[str, Any] = {name: value[samples] for name, value in values.items() if isinstance(value, np.ndarray)}
    taken["time"] = np.arange(samples.size) * weather.interval
    return replace(weather, start=start, **taken)


def resample_weather(weather: Weather, time: FloatArray) -> Weather:
    """Weather at other times [s since weather.start], which must lie within its own.

    Scalars go linearly, the wind's direction through its components (so that 350 and 10 degrees meet at north);
    precipitation and ground state keep their value until the next sample. The sky's infrared goes linearly from the
    middle of one averaging time to the next. Measured sunlight is left out, as the sun does not move in straight lines
    (see `measured_sunlight`). `start` and the meaning of `time` stay.
    """
    held = np.searchsorted(weather.time, time, side="right") - 1

    def linear(values: FloatArray) -> FloatArray:
        return np.interp(time, weather.time, values)

    infrared, middle = weather.sky_infrared, weather.time - weather.radiation_averaging / 2.0
    angle = np.deg2rad(weather.wind_direction)
    east, north = linear(np.sin(angle)), linear(np.cos(angle))
    # Half-way between opposite directions there is none: keep the earlier one.
    direction = np.where(
        np.hypot(east, north) > 1e-9, np.rad2deg(np.arctan2(east, north)) % 360.0, weather.wind_direction[held]
    )
    return replace(
        weather,
        time=time,
        air_temperature=linear(weather.air_temperature),
        relative_humidity=linear(weather.relative_humidity),
        wind_speed=linear(weather.wind_speed),
        wind_direction=direction,
        cloud_cover=linear(weather.cloud_cover),
        precipitation=weather.precipitation[held],
        ground_state=weather.ground_state[held],
        direct_normal=None,
        diffuse_horizontal=None,
        global_horizontal=None,
        sky_infrared=None if infrared is None else np.interp(time, middle, infrared),
        radiation_averaging=0.0,
    )
