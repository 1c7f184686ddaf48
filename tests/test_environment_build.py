"""The environment on its time grid."""

import re
import time
from dataclasses import fields
from datetime import date, datetime, timedelta, timezone
from pathlib import Path

import numpy as np
import pytest

from sensorsim.environment import (
    SNOW_MAXIMUM_TEMPERATURE,
    Environment,
    build_environment,
    ground_albedo,
    read_weather,
)
from sensorsim.errors import InputError
from sensorsim.resources import assets_folder

DAYS = {"winter": date(1976, 2, 7), "summer": date(1976, 9, 3), "fall": date(1976, 10, 7)}
WINTER = assets_folder() / "weather" / "winter_1976-02-07.csv"


@pytest.fixture(scope="module")
def winter() -> Environment:
    return build_environment(read_weather("winter"), image_day=DAYS["winter"])


def _finite(environment: Environment) -> None:
    for field in fields(environment):
        value = getattr(environment, field.name)
        if isinstance(value, np.ndarray):
            assert value.shape[0] == environment.time.size, field.name
            assert value.dtype.kind == "U" or np.isfinite(value).all(), field.name


@pytest.mark.parametrize("name", DAYS)
def test_every_array_covers_the_grid_and_is_finite(name: str) -> None:
    _finite(build_environment(read_weather(name), image_day=DAYS[name], lead_in_days=5))


def test_grid_runs_from_lead_in_midnight_to_last_midnight(winter: Environment) -> None:
    assert winter.start == datetime(1976, 2, 4, tzinfo=timezone(timedelta(hours=-5)))
    assert winter.image_start - winter.start == timedelta(days=3)
    assert winter.time.size == 4 * 288 + 1
    window = winter.image_window
    assert winter.start + timedelta(seconds=winter.time[window][0]) == winter.image_start
    assert winter.time[window][-1] - winter.time[window][0] == 86400.0
    assert window.stop == winter.time.size


def test_clock_is_local_standard_time(winter: Environment) -> None:
    """Sunrise at 7:39 and sunset at 18:02 on 7 February; solar noon at 12:50, far west in the zone."""
    window = winter.image_window
    hours = (winter.time[window] - winter.time[window][0]) / 3600.0
    up = hours[winter.sun_elevation[window] > 0.0]
    assert up[0] == pytest.approx(7.65, abs=0.1)
    assert up[-1] == pytest.approx(18.03, abs=0.1)
    assert hours[np.argmax(winter.sun_elevation[window])] == pytest.approx(12.83, abs=0.1)


def test_quarters_sum_to_the_diffuse_all_the_time(winter: Environment) -> None:
    np.testing.assert_allclose(winter.quadrant_irradiance.sum(axis=-1), winter.diffuse_irradiance, rtol=1e-12)


def test_seasons_rank_as_the_report_says() -> None:
    """At 10 h the beam is strongest in winter, weaker in fall, least in summer; the sky is warmest in summer."""
    winter, summer, fall = (
        build_environment(read_weather(name), image_day=day).at(36000.0) for name, day in DAYS.items()
    )
    assert winter.beam_irradiance > fall.beam_irradiance > summer.beam_irradiance
    assert winter.quadrant_irradiance.sum() < summer.quadrant_irradiance.sum()
    assert winter.sky_temperature < fall.sky_temperature < summer.sky_temperature
    assert winter.beam_irradiance > 10.0 * winter.quadrant_irradiance.sum()


def test_sample_at_a_step_is_that_step_and_between_steps_lies_between(winter: Environment) -> None:
    index = winter.image_window.start + 10 * 12
    on, off = winter.at(36000.0), winter.at(36150.0)
    assert on.air_temperature == winter.air_temperature[index]
    np.testing.assert_allclose(on.sun_direction, winter.sun_direction[index], atol=1e-12)
    assert off.beam_irradiance == pytest.approx(winter.beam_irradiance[index : index + 2].mean())
    np.testing.assert_allclose(off.nir_quadrant, winter.nir_quadrant[index : index + 2].mean(axis=0))
    assert np.linalg.norm(off.sun_direction) == pytest.approx(1.0)
    assert winter.at(86400.0).air_temperature == winter.air_temperature[-1]
    assert winter.at(0.0).attenuation_coefficient("FLIR") > 0.0
    assert off.transmittance("LLLTV").at(0.0) == pytest.approx(1.0)
    assert off.band_sky(np.array([0.0, 90.0])).air.shape == (2,)


@pytest.mark.parametrize("moment", [-1.0, 86401.0, float("nan")])
def test_time_outside_of_the_day_is_refused(winter: Environment, moment: float) -> None:
    with pytest.raises(InputError, match="0 to 86400"):
        winter.at(moment)


def test_finer_steps_agree_where_they_meet() -> None:
    weather = read_weather("fall")
    coarse = build_environment(weather, image_day=DAYS["fall"], lead_in_days=1, step=600.0)
    fine = build_environment(weather, image_day=DAYS["fall"], lead_in_days=1, step=60.0)
    for name in ("beam_irradiance", "sky_temperature", "nir_quadrant", "sun_direction"):
        np.testing.assert_allclose(getattr(fine, name)[::10], getattr(coarse, name), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"image_day": date(1976, 2, 8)}, "image day = '1976-02-08'"),
        ({"image_day": date(1976, 1, 1)}, "image day = '1976-01-01'"),
        ({"lead_in_days": 6}, "ask for 5 at most"),
        ({"lead_in_days": -1}, "lead_in_days"),
        ({"lead_in_days": 0.0001}, "lead_in_days"),
        ({"lead_in_days": float("nan")}, "lead_in_days"),
        ({"step": 0.0}, "step"),
        ({"step": 7.0}, "step"),
        ({"step": 7200.0}, "step"),
    ],
)
def test_what_the_weather_cannot_give_is_refused_with_the_remedy(options: dict[str, object], expected: str) -> None:
    weather = read_weather("winter")
    with pytest.raises(InputError) as caught:
        build_environment(weather, **{"image_day": DAYS["winter"], **options})  # type: ignore[arg-type]
    assert expected in str(caught.value)
    assert str(weather.file) in str(caught.value)


def _elsewhere(folder: Path, edits: dict[str, str]) -> Path:
    text = WINTER.read_text()
    for old, new in edits.items():
        text = re.sub(old, new, text)
    path = folder / "elsewhere.csv"
    path.write_text(text)
    return path


def test_leap_day_can_be_the_image_day(tmp_path: Path) -> None:
    """The winter file moved on by 22 days: 24 February to 1 March 1976, with 29 February within."""

    def later(match: re.Match[str]) -> str:
        return (date.fromisoformat(match[0]) + timedelta(days=22)).isoformat()

    path = tmp_path / "leap.csv"
    path.write_text(re.sub(r"1976-02-\d\d", later, WINTER.read_text()))
    environment = build_environment(read_weather(path), image_day=date(1976, 2, 29))
    _finite(environment)
    noon = environment.at(12 * 3600.0 + 3000.0)
    assert 41.0 < noon.sun_elevation < 43.0


@pytest.mark.parametrize(
    ("latitude", "offset"), [(78.2, "+01:00"), (-78.0, "+12:00"), (90.0, "+00:00"), (-90.0, "+00:00")]
)
def test_polar_day_and_night_are_finite(tmp_path: Path, latitude: float, offset: str) -> None:
    edits = {
        r"latitude_deg: 39.82": f"latitude_deg: {latitude}",
        r"utc_offset_h: -5": f"utc_offset_h: {int(offset[:3])}",
        r":00-05:00": f":00{offset}",
        r"1976-02": "1976-06",
    }
    environment = build_environment(read_weather(_elsewhere(tmp_path, edits)), image_day=date(1976, 6, 7))
    _finite(environment)
    assert (environment.diffuse_irradiance > 0.0).all() == (latitude > 0.0)
    assert environment.nir_quadrant.min() > 0.0


def test_half_hour_zone_keeps_local_midnight(tmp_path: Path) -> None:
    edits = {r"utc_offset_h: -5": "utc_offset_h: -4.5", r":00-05:00": ":00-04:30"}
    environment = build_environment(read_weather(_elsewhere(tmp_path, edits)), image_day=DAYS["winter"])
    assert environment.image_start.isoformat() == "1976-02-07T00:00:00-04:30"


def test_snow_returns_more_light_than_dry_ground_and_dry_more_than_wet() -> None:
    snow, dry, wet = ground_albedo(np.array(["snow", "dry", "wet"]))
    assert 1.0 > snow > dry > wet > 0.0
    assert SNOW_MAXIMUM_TEMPERATURE == 273.15


def test_five_days_at_five_minutes_are_built_in_half_a_second() -> None:
    weather = read_weather("winter")
    build_environment(weather, image_day=DAYS["winter"], lead_in_days=0)
    begun = time.perf_counter()
    build_environment(weather, image_day=DAYS["winter"], lead_in_days=4)
    assert time.perf_counter() - begun < 0.5
