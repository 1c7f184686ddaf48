"""What of the host's weather only a new bake can honour: temperatures are the result of the days before.

Live, frame by frame: the time of the baked day, visibility, source or apparent radiance, air temperature and humidity
of the path. Asked for, and reported: another date, and the air temperature, humidity, wind, pressure, cloud and rain
that walls have stood in.
"""

from dataclasses import dataclass
from datetime import date, datetime, timedelta

from sensorsim.trainer.host_state import HostState

# Differences that are worth a bake: [K], [-], [m s-1], [deg], [Pa], [-]
WORTH = {
    "air_temperature": 0.5,
    "relative_humidity": 0.05,
    "wind_speed": 0.5,
    "wind_from": 10.0,
    "pressure": 500.0,
    "cloud_cover": 0.1,
}
WET = ("rain", "snow", "sleet", "hail")
CLOUDS = ("cloud 1", "cloud 2", "cloud 3")


@dataclass(frozen=True, slots=True, kw_only=True)
class BakeRequest:
    """Weather to bake for; None: as the weather file has it.

    day: of the site's local standard time. SI units; cloud_cover 0 to 1; wind_from [deg] where it blows from.
    """

    day: date
    air_temperature: float | None = None
    relative_humidity: float | None = None
    wind_speed: float | None = None
    wind_from: float | None = None
    pressure: float | None = None
    cloud_cover: float | None = None
    precipitation: str | None = None


def wanted_bake(state: HostState, moment: datetime, utc_offset: float) -> BakeRequest:
    """The bake that would honour all that the host has said; utc_offset [h] of the site's local standard time."""
    moved = moment - (moment.utcoffset() or timedelta()) + timedelta(hours=utc_offset)
    clouds = [layer.coverage for layer in state.layers.values() if layer.kind in CLOUDS]
    wet = [layer.kind for _, layer in sorted(state.layers.items()) if layer.kind in WET]
    cover = max(clouds) if clouds else None
    day, rain = moved.date(), wet[0] if wet else None
    if state.air is None:
        return BakeRequest(day=day, cloud_cover=cover, precipitation=rain)
    return BakeRequest(
        day=day,
        air_temperature=state.air.temperature,
        relative_humidity=state.air.relative_humidity,
        wind_speed=state.air.wind_speed,
        wind_from=state.air.wind_from,
        pressure=state.air.pressure,
        cloud_cover=cover,
        precipitation=rain,
    )


def is_other_weather(one: BakeRequest, other: BakeRequest) -> bool:
    """Whether two bakes differ by more than a host's small changes, which would have it asked for again and again."""
    if (one.day, one.precipitation) != (other.day, other.precipitation):
        return True
    for name, worth in WORTH.items():
        first, second = getattr(one, name), getattr(other, name)
        if first is None or second is None:
            if first is not second:
                return True
            continue
        apart = abs(first - second)
        if min(apart, 360.0 - apart) > worth if name == "wind_from" else apart > worth:
            return True
    return False
