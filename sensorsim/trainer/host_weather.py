"""The weather file as the host's wishes change it: what a bake that was asked for is made of."""

from dataclasses import replace
from datetime import datetime

import numpy as np

from sensorsim.environment import Weather
from sensorsim.trainer.bake_request import BakeRequest

RAIN = 4.0  # [mm h-1] moderate, of precipitation that the host names without a rate
WHITE = ("snow", "sleet", "hail")


def host_weather(weather: Weather, wanted: BakeRequest, moment: datetime) -> Weather:
    """The series with the host's values in place of its own, from its first sample to its last.

    Air temperature keeps its course over the day and is shifted as a whole, so that it is the host's at the moment that
    the host spoke of. The sun under another cloud cover is modelled: measurements of it are left out then.
    """
    whole = np.ones(weather.time.size)
    values: dict[str, object] = {}
    if wanted.air_temperature is not None:
        now = np.interp((moment - weather.start).total_seconds(), weather.time, weather.air_temperature)
        values["air_temperature"] = weather.air_temperature + (wanted.air_temperature - now)
    if wanted.relative_humidity is not None:
        values["relative_humidity"] = whole * wanted.relative_humidity
    if wanted.wind_speed is not None:
        values["wind_speed"] = whole * wanted.wind_speed
    if wanted.wind_from is not None:
        values["wind_direction"] = whole * wanted.wind_from
    if wanted.cloud_cover is not None:
        values |= {"cloud_cover": whole * wanted.cloud_cover, "direct_normal": None, "diffuse_horizontal": None}
        values |= {"global_horizontal": None, "sky_infrared": None}
    if wanted.precipitation is not None:
        ground = "snow" if wanted.precipitation in WHITE else "wet"
        values |= {"precipitation": whole * RAIN, "ground_state": np.full(weather.time.size, ground)}
    return replace(weather, name=f"{weather.name} as the host has it", **values) if values else weather  # type: ignore[arg-type]
