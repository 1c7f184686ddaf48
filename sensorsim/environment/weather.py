"""Weather: what a station would have written down, on its own time grid and on any other."""

from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment.site import Site

FloatArray = NDArray[np.float64]
GROUND_STATES = ("dry", "wet", "snow")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Weather:
    """Surface weather at one site; arrays have shape (n,)."""

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


def resample_weather(weather: Weather, time: FloatArray) -> Weather:
    """Weather at other times [s since weather.start], which must lie within its own.

    Scalars go linearly, the wind's direction through its components (so that 350 and 10 degrees meet at north);
    precipitation and ground state keep their value until the next sample. `start` and the meaning of `time` stay.
    """
    held = np.searchsorted(weather.time, time, side="right") - 1

    def linear(values: FloatArray) -> FloatArray:
        return np.interp(time, weather.time, values)

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
    )
