"""Weather between its samples, and the three days of the report."""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from sensorsim.environment import Weather, read_weather, resample_weather, saturation_vapour_pressure
from sensorsim.units import kelvin_from_fahrenheit

DAYS = {"winter": "1976-02-07", "summer": "1976-09-03", "fall": "1976-10-07"}


def _at(weather: Weather, day: str, hour: float) -> Weather:
    days = (np.datetime64(day) - np.datetime64(weather.start.date().isoformat())).astype(int)
    return resample_weather(weather, np.array([(float(days) * 24.0 + hour) * 3600.0]))


def test_samples_map_to_themselves_and_scalars_lie_half_way_between() -> None:
    weather = read_weather("winter")
    same = resample_weather(weather, weather.time)
    np.testing.assert_array_equal(same.air_temperature, weather.air_temperature)
    np.testing.assert_allclose(same.wind_direction, weather.wind_direction)
    half = resample_weather(weather, weather.time[:-1] + 1800.0)
    expected = (weather.air_temperature[:-1] + weather.air_temperature[1:]) / 2.0
    np.testing.assert_allclose(half.air_temperature, expected)


def test_wind_turns_through_north_the_short_way() -> None:
    weather = read_weather("winter")
    turning = replace(weather, wind_direction=np.where(np.arange(weather.time.size) % 2 == 0, 350.0, 10.0))
    half = resample_weather(turning, weather.time[:-1] + 1800.0)
    np.testing.assert_allclose(np.cos(np.deg2rad(half.wind_direction)), 1.0)
    opposed = replace(weather, wind_direction=np.where(np.arange(weather.time.size) % 2 == 0, 90.0, 270.0))
    assert np.isfinite(resample_weather(opposed, weather.time[:-1] + 1800.0).wind_direction).all()


def test_rain_and_ground_state_hold_until_the_next_sample() -> None:
    weather = read_weather("winter")
    state = np.where(weather.time < 36000.0, "dry", "wet")
    rainy = replace(weather, precipitation=weather.time / 3600.0, ground_state=state)
    between = resample_weather(rainy, np.array([35999.0, 36000.0, 36001.0, 39599.0]))
    assert between.ground_state.tolist() == ["dry", "wet", "wet", "wet"]
    assert between.precipitation.tolist() == [9.0, 10.0, 10.0, 10.0]


def test_the_days_are_as_the_report_words_them() -> None:
    """[Report1978] section IV, seasonal variation: temperatures at 10 h, cloud and wind, and how the days rank."""
    winter, summer, fall = (_at(read_weather(name), day, 10.0) for name, day in DAYS.items())
    assert abs(winter.air_temperature[0] - kelvin_from_fahrenheit(40.0)) < 2.0
    assert abs(summer.air_temperature[0] - kelvin_from_fahrenheit(65.0)) < 0.5
    assert winter.air_temperature[0] < fall.air_temperature[0] < summer.air_temperature[0]
    assert winter.cloud_cover[0] <= 0.1 < fall.cloud_cover[0] < 0.65 < 0.9 <= summer.cloud_cover[0]
    assert winter.wind_speed[0] > 5.0 > 1.5 > max(summer.wind_speed[0], fall.wind_speed[0])


@pytest.mark.parametrize(("name", "day"), DAYS.items())
def test_course_of_the_day_is_natural(name: str, day: str) -> None:
    weather = read_weather(name)
    hours = np.arange(24)
    air = np.array([_at(weather, day, hour).air_temperature[0] for hour in hours])
    assert 5 <= hours[np.argmin(air)] <= 8
    assert 14 <= hours[np.argmax(air)] <= 16
    vapour = weather.relative_humidity * saturation_vapour_pressure(weather.air_temperature)
    assert np.ptp(vapour) < 0.06 * vapour.mean()
    assert (weather.ground_state == "dry").all()
    assert (weather.precipitation == 0.0).all()
    assert weather.time[-1] >= (4 + 1) * 86400.0


def test_files_are_what_the_tool_writes(tmp_path: Path) -> None:
    tool = Path(__file__).resolve().parent.parent / "tools" / "make_weather.py"
    subprocess.run([sys.executable, tool, tmp_path], check=True, capture_output=True)
    for name in DAYS:
        shipped = read_weather(name).file
        assert (tmp_path / shipped.name).read_bytes() == shipped.read_bytes()
