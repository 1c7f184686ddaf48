"""Days that call for effects which the three days of [Report1978] do not have: the same, with one thing changed."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from datetime import date

import numpy as np

from sensorsim.constants import SECONDS_PER_HOUR
from sensorsim.environment import Weather, read_weather
from sensorsim.study.gallery import FALL, SUMMER, WINTER

SHOWER, SHOWER_HOURS = 4.0, (10.0, 13.0)  # [mm/h] and hours of every day


def _as_it_is(weather: Weather) -> Weather:
    return weather


def _still(weather: Weather) -> Weather:
    return replace(weather, name=f"{weather.name}, still", wind_speed=np.zeros_like(weather.wind_speed))


def _rainy(weather: Weather) -> Weather:
    """A shower before noon under a closed sky, and wet ground."""
    hour = (weather.start.hour + weather.time / SECONDS_PER_HOUR) % 24.0
    raining = (hour >= SHOWER_HOURS[0]) & (hour < SHOWER_HOURS[1])
    return replace(
        weather, name=f"{weather.name}, rain", precipitation=np.where(raining, SHOWER, 0.0),
        cloud_cover=np.ones_like(weather.cloud_cover), ground_state=np.full(weather.time.size, "wet"),
    )  # fmt: skip


def _snowy(weather: Weather) -> Weather:
    return replace(weather, name=f"{weather.name}, snow", ground_state=np.full(weather.time.size, "snow"))


Change = Callable[[Weather], Weather]
DAYS: Mapping[str, tuple[date, Change, str]] = {
    "winter": (WINTER, _as_it_is, "7 February 1976, clear, cold and windy"),
    "summer": (SUMMER, _as_it_is, "3 September 1976, warm, overcast, still"),
    "fall": (FALL, _as_it_is, "7 October 1976, mild, partly cloudy"),
    "still winter": (WINTER, _still, "7 February 1976 without its wind"),
    "rain": (FALL, _rainy, f"7 October 1976 overcast, with {SHOWER:g} mm/h of rain from 10 to 13 h"),
    "snow": (WINTER, _snowy, "7 February 1976 with snow on the ground"),
}


def study_weather(name: str) -> tuple[Weather, date, str]:
    """Weather, image day and words of a day by its name; KeyError for one that is none."""
    day, change, words = DAYS[name]
    return change(read_weather(day.isoformat())), day, words
