"""Measured sunlight put on a finer time grid, by the course that a clear sky would have taken.

A station gives means over an hour, or samples; between them the sun goes on. So each measured value becomes a ratio to
the clear sky's over the same interval, and the clear sky at the moment asked for is multiplied by it: dawn and dusk
fall where they belong. Between samples the ratio goes linearly. Through an interval that was averaged it goes linearly
with a slope limited by the neighbours [VanLeer1977], about the point that keeps the measured mean: smooth on smooth
days, a step where cloud came or went, and never beyond the neighbours' values. Where the clear sky itself is too dim
to divide by, the ratio of the nearest brighter interval holds.
"""

from dataclasses import dataclass, replace
from datetime import timedelta

import numpy as np
import pvlib
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_HOUR
from sensorsim.environment.sun import Sunlight, SunPosition, clear_sunlight, sun_position
from sensorsim.environment.weather import Weather
from sensorsim.errors import InputError

FloatArray = NDArray[np.float64]

PARTS_OF_INTERVAL = 12  # moments at which an interval's clear sky is taken
DIM_BEAM = 100.0  # [W m-2] clear-sky means below these are not divided by
DIM_DIFFUSE = 10.0
NIGHT_LIMIT = 50.0  # [W m-2] that may be written down while the sun is below the horizon: rounding, twilight


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Intervals:
    middle: FloatArray  # (n,) [s since the weather's start]
    moment: FloatArray  # (n, p) within each interval [s since the weather's start]
    position: SunPosition  # at the moments, flat
    clear: Sunlight  # at the moments, flat


def measured_sunlight(weather: Weather, time: FloatArray, clear: Sunlight) -> Sunlight:
    """Sunlight at times [s since weather.start] from the weather's measured radiation.

    Parameters
    ----------
    weather : with direct and diffuse radiation measured, or global alone
    time : (n,) within the weather's own, up to half an averaging time
    clear : sunlight of a clear sky at these times

    Raises
    ------
    InputError : radiation at night, which is the mark of a wrong place, clock or time stamp.
    """
    intervals = _intervals(weather)
    shape = intervals.moment.shape
    beam, diffuse = _split(weather, intervals)
    _require_dark_nights(weather, intervals, beam, diffuse)
    found = []
    for values, course, now, dim in (
        (beam, intervals.clear.beam, clear.beam, DIM_BEAM),
        (diffuse, intervals.clear.diffuse, clear.diffuse, DIM_DIFFUSE),
    ):
        found.append(now * _ratio(time, values, course.reshape(shape), intervals, dim))
    return replace(clear, beam=found[0], diffuse=found[1])


def _intervals(weather: Weather) -> _Intervals:
    width = weather.radiation_averaging
    parts = PARTS_OF_INTERVAL if width > 0.0 else 1
    inside = width * ((np.arange(parts) + 0.5) / parts - 1.0)
    moment = weather.time[:, None] + inside
    begin = np.datetime64(weather.start.replace(tzinfo=None), "ms")
    local = begin + np.round(moment.ravel() * 1000.0).astype("timedelta64[ms]")
    utc = local - np.timedelta64(round(weather.site.utc_offset * SECONDS_PER_HOUR * 1000.0), "ms")
    position = sun_position(weather.site, utc)
    clear = clear_sunlight(weather.site, position, local)
    return _Intervals(middle=weather.time - width / 2.0, moment=moment, position=position, clear=clear)


def _ratio(time: FloatArray, values: FloatArray, course: FloatArray, intervals: _Intervals, dim: float) -> FloatArray:
    """Ratio of measured to clear at times [s], out of measured values (n,) and the clear course (n, p)."""
    mean = course.mean(axis=-1)
    bright = mean > dim
    if not bright.any():
        ratio = np.divide(values, mean, out=np.zeros_like(mean), where=mean > 0.0)
        return np.asarray(np.interp(time, intervals.middle, ratio), dtype=np.float64)
    nearest = _nearest(np.flatnonzero(bright), mean.size)
    ratio = (values / np.where(bright, mean, 1.0))[nearest]
    if course.shape[-1] == 1:
        return np.asarray(np.interp(time, intervals.middle, ratio), dtype=np.float64)
    weight = np.where(mean > 0.0, mean, 1.0)
    centre = np.where(mean > 0.0, (course * intervals.moment).mean(axis=-1) / weight, intervals.middle)
    slope = np.where(bright, _limited_slope(centre, ratio), 0.0)
    edges = (intervals.middle[1:] + intervals.middle[:-1]) / 2.0
    # On the very edge of two intervals the mean of both holds.
    sides = [np.searchsorted(edges, time, side=side) for side in ("left", "right")]
    before, after = (ratio[cell] + slope[cell] * (time - centre[cell]) for cell in sides)
    return np.asarray(np.maximum((before + after) / 2.0, 0.0), dtype=np.float64)


def _nearest(there: NDArray[np.int64], count: int) -> NDArray[np.int64]:
    """For each of `count` places the nearest one of the ascending places `there`."""
    place = np.arange(count)
    after = np.minimum(np.searchsorted(there, place), there.size - 1)
    before = np.maximum(after - 1, 0)
    return np.where(place - there[before] <= there[after] - place, there[before], there[after])


def _limited_slope(centre: FloatArray, value: FloatArray) -> FloatArray:
    """Slope (n,) through each value: the central one, at most twice that to either neighbour, zero at a peak."""
    step = np.diff(value) / np.diff(centre)
    left, right = np.concatenate([[0.0], step]), np.concatenate([step, [0.0]])
    least = np.minimum(2.0 * np.minimum(np.abs(left), np.abs(right)), np.abs(left + right) / 2.0)
    return np.where(left * right > 0.0, np.sign(left) * least, 0.0)


def _split(weather: Weather, intervals: _Intervals) -> tuple[FloatArray, FloatArray]:
    """Beam and diffuse means of each interval; out of the global one by [Erbs1982] where only that was measured."""
    if weather.direct_normal is not None and weather.diffuse_horizontal is not None:
        return weather.direct_normal, weather.diffuse_horizontal
    if weather.global_horizontal is None:
        raise InputError(weather.file, "sunlight", None, "not measured", "give direct and diffuse, or global")
    height = np.maximum(np.sin(np.deg2rad(intervals.position.elevation)), 0.0)
    zenith = np.rad2deg(np.arccos(height.reshape(intervals.moment.shape).mean(axis=-1)))
    parts = pvlib.irradiance.erbs(weather.global_horizontal, zenith, _day_of_year(weather, intervals))
    return np.asarray(parts["dni"], dtype=np.float64), np.asarray(parts["dhi"], dtype=np.float64)


def _day_of_year(weather: Weather, intervals: _Intervals) -> FloatArray:
    new_year = weather.start.replace(month=1, day=1, hour=0, minute=0, second=0, microsecond=0)
    since = (weather.start - new_year) / timedelta(days=1)
    return np.floor((since + intervals.middle / 86400.0) % 366.0) + 1.0


def _require_dark_nights(weather: Weather, intervals: _Intervals, beam: FloatArray, diffuse: FloatArray) -> None:
    """Refuse radiation in intervals in which the sun does not rise."""
    highest = intervals.position.elevation.reshape(intervals.moment.shape).max(axis=-1)
    wrong = (highest <= 0.0) & (np.maximum(beam, diffuse) > NIGHT_LIMIT)
    if wrong.any():
        first = int(np.argmax(wrong))
        stamp = (weather.start + timedelta(seconds=float(weather.time[first]))).isoformat()
        value = round(float(max(beam[first], diffuse[first])), 1)
        problem = f"W/m2 of sunlight at {stamp}, with the sun below the horizon"
        raise InputError(weather.file, "radiation", value, problem, "check place, UTC offset and time stamps")
