"""What the host says of the sky, the clock and the air."""

from collections.abc import Mapping
from dataclasses import replace
from datetime import datetime, timedelta, timezone

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.errors import InputError
from sensorsim.trainer.fields import Value
from sensorsim.trainer.handle_entities import flag, number, whole_number
from sensorsim.trainer.host_state import Air, Clock, HostState, Layer
from sensorsim.trainer.settings import Moment

Values = Mapping[str, Value]

PASCAL_PER_HECTOPASCAL = 100.0
LAYERS = ("fog", "cloud 1", "cloud 2", "cloud 3", "rain", "snow", "sleet", "hail", "sand", "dust")
SCOPES = ("global", "regional", "entity")


def celestial_sphere(state: HostState, values: Values, moment: Moment) -> HostState:
    """Celestial Sphere Control: sets the clock where date and time are valid, and lets it run or stand."""
    clock = state.clock
    running, sun = flag(values, "ephemeris_enable"), flag(values, "sun_enable")
    held = moment_of(clock, moment.time)
    said = _moment(values, moment) if flag(values, "date_time_valid") else held
    return replace(state, clock=Clock(moment=said, since=moment.time, running=running, sun=sun))


def moment_of(clock: Clock, time: float) -> datetime:
    """The clock's date and time at an IG time [s]."""
    return clock.moment + timedelta(seconds=time - clock.since) if clock.running else clock.moment


def atmosphere(state: HostState, values: Values, _: Moment) -> HostState:
    """Atmosphere Control, in SI."""
    air = Air(
        path_model=flag(values, "atmospheric_model_enable"),
        relative_humidity=number(values, "humidity") / 100.0,
        temperature=number(values, "air_temp") + ZERO_CELSIUS,
        visibility=number(values, "visibility_range"),
        wind_speed=number(values, "horiz_wind"),
        updraught=number(values, "vert_wind"),
        wind_from=number(values, "wind_direction") % 360.0,
        pressure=number(values, "barometric_pressure") * PASCAL_PER_HECTOPASCAL,
    )
    return replace(state, air=air)


def weather(state: HostState, values: Values, _: Moment) -> HostState:
    """Weather Control: a layer as the host describes it, or its end where it is not enabled."""
    layer_number, scope = whole_number(values, "layer_id"), SCOPES[whole_number(values, "scope")]
    if layer_number >= len(LAYERS):
        raise InputError("weather_control", "layer_id", layer_number, "no such layer", f"use 0 to {len(LAYERS) - 1}")
    if scope != "global":
        raise InputError("weather_control", "scope", scope, "weather here is the same everywhere", "send it as global")
    others = {key: layer for key, layer in state.layers.items() if key != layer_number}
    if not flag(values, "weather_enable"):
        return replace(state, layers=others)
    layer = Layer(
        kind=LAYERS[layer_number],
        visibility=number(values, "visibility_range"),
        temperature=number(values, "air_temp") + ZERO_CELSIUS,
        relative_humidity=number(values, "humidity") / 100.0,
        coverage=number(values, "coverage") / 100.0,
        severity=whole_number(values, "severity"),
        base=number(values, "base_elevation"),
        thickness=number(values, "thickness"),
        wind_speed=number(values, "horiz_wind"),
        wind_from=number(values, "wind_direction") % 360.0,
    )
    return replace(state, layers={**others, layer_number: layer})


def _moment(values: Values, moment: Moment) -> datetime:
    """Date and time of the packet, date as MMDDYYYY."""
    date = whole_number(values, "date")
    month, day, year = date // 1000000, date // 10000 % 100, date % 10000
    zone = timezone(timedelta(hours=moment.settings.celestial_utc_offset))
    try:
        start = datetime(year, month, day, whole_number(values, "hour"), whole_number(values, "minute"), tzinfo=zone)
    except ValueError as error:
        problem = f"{error}, as MMDDYYYY"
        raise InputError("celestial_sphere_control", "date", date, problem, "write month, day, year") from error
    return start + timedelta(seconds=float(values.get("seconds", 0.0)))
