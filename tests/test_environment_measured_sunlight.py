"""Measured radiation in a station's file drives the environment: sums kept, dusk in its place, nonsense refused."""

from collections.abc import Sequence
from datetime import date
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from year_files import SITE, clear_means

from sensorsim.environment import build_environment, clear_sunlight, read_weather, sun_position
from sensorsim.errors import InputError

FloatArray = NDArray[np.float64]

DAYS = (date(1976, 2, 6), date(1976, 2, 7), date(1976, 2, 8))
HEAD = (
    "# site: Testville\n# longitude_deg: -84.02\n# latitude_deg: 39.82\n# altitude_m: 255\n# utc_offset_h: -5\n"
    "{averaging}time,air_temperature_C,relative_humidity_percent,wind_speed_m_s,wind_direction_deg,"
    "cloud_cover_percent,precipitation_mm_h,ground_state,{columns}\n"
)


def _station(
    folder: Path, columns: Sequence[str], values: Sequence[FloatArray], *, averaging: int, minutes: int = 60
) -> Path:
    """A station's file from the first hour of DAYS on, every row closing its interval; flat weather, full cloud."""
    note = f"# radiation_averaging_s: {averaging}\n" if averaging else ""
    start = np.datetime64("1976-02-06T00:00")
    rows = []
    for k in range(values[0].size + 1):
        stamp = start + np.timedelta64(k * minutes, "m")
        cells = ",".join(f"{value[max(k - 1, 0)] if averaging else value[k % value.size]:.4f}" for value in values)
        rows.append(f"{stamp}:00-05:00,3,60,3,270,100,0,dry,{cells}")
    path = folder / "station.csv"
    path.write_text(HEAD.format(averaging=note, columns=",".join(columns)) + "\n".join(rows) + "\n")
    return path


def _hour_means(values: FloatArray) -> FloatArray:
    return ((values[1:] + values[:-1]) / 2.0).reshape(-1, 60).mean(axis=-1)


def test_hour_means_come_out_again_whatever_the_clouds_did(tmp_path: Path) -> None:
    """Each hour's mean is kept where the sun stands well up, and the beam never exceeds that of a clear sky.

    What is left is the ramp of a minute on either side of a step, which shifts half a per cent of it to the next hour.
    """
    beam, diffuse = (values.ravel() for values in clear_means(DAYS))
    share = np.array([0.0, 1.0, 0.3, 0.9, 0.0, 0.6, 0.1, 1.0] * 9)
    path = _station(
        tmp_path, ("direct_normal_W_m2", "diffuse_horizontal_W_m2"), (share * beam, 2.0 * diffuse), averaging=3600
    )
    environment = build_environment(read_weather(path), image_day=DAYS[1], lead_in_days=0, step=60.0)
    bright = beam[24:48] > 300.0
    assert np.count_nonzero(bright) >= 8
    np.testing.assert_allclose(
        _hour_means(environment.beam_irradiance)[bright], (share * beam)[24:48][bright], atol=7.0
    )
    np.testing.assert_allclose(_hour_means(environment.diffuse_irradiance), 2.0 * diffuse[24:48], rtol=0.01, atol=2.0)
    assert environment.beam_irradiance.min() >= 0.0
    columns = ("direct_normal_W_m2", "diffuse_horizontal_W_m2")
    cloudless = read_weather(_station(tmp_path, columns, (beam, diffuse), averaging=3600))
    clear = build_environment(cloudless, image_day=DAYS[1], lead_in_days=0, step=60.0)
    assert (environment.beam_irradiance <= 1.01 * clear.beam_irradiance + 1e-9).all()


def test_samples_are_met_where_they_were_taken(tmp_path: Path) -> None:
    local = np.datetime64("1976-02-06T00:00", "s") + (np.arange(3 * 144) * 600).astype("timedelta64[s]")
    clear = clear_sunlight(SITE, sun_position(SITE, local + np.timedelta64(5 * 3600, "s")), local)
    share = 0.5 + 0.3 * np.sin(np.arange(local.size))
    path = _station(
        tmp_path,
        ("direct_normal_W_m2", "diffuse_horizontal_W_m2"),
        (share * clear.beam, clear.diffuse),
        averaging=0,
        minutes=10,
    )
    environment = build_environment(read_weather(path), image_day=DAYS[1], lead_in_days=0, step=600.0)
    bright = clear.beam[144:288] > 100.0
    np.testing.assert_allclose(
        environment.beam_irradiance[:-1][bright], (share * clear.beam)[144:288][bright], rtol=1e-4, atol=0.01
    )


def test_measured_sunlight_ignores_the_cloud_cover(tmp_path: Path) -> None:
    """The files have full cloud, under which the model knows no beam."""
    beam, diffuse = (values.ravel() for values in clear_means(DAYS))
    columns = ("direct_normal_W_m2", "diffuse_horizontal_W_m2")
    path = _station(tmp_path, columns, (beam, diffuse), averaging=3600)
    environment = build_environment(read_weather(path), image_day=DAYS[1], lead_in_days=0)
    assert environment.beam_irradiance.max() > 800.0
    np.testing.assert_allclose(environment.quadrant_irradiance.sum(axis=-1), environment.diffuse_irradiance)
    assert environment.nir_beam.max() > 100.0


def test_global_radiation_alone_is_split_and_adds_up(tmp_path: Path) -> None:
    """On a clear winter day most of it is beam, and beam and diffuse give the global means back."""
    local = np.datetime64("1976-02-06T00:00", "s") + (np.arange(72 * 60) * 60 + 30).astype("timedelta64[s]")
    position = sun_position(SITE, local + np.timedelta64(5 * 3600, "s"))
    clear = clear_sunlight(SITE, position, local)
    level = clear.beam * np.maximum(position.direction[:, 2], 0.0) + clear.diffuse
    hourly = level.reshape(-1, 60).mean(axis=-1)
    path = _station(tmp_path, ("global_horizontal_W_m2",), (hourly,), averaging=3600)
    environment = build_environment(read_weather(path), image_day=DAYS[1], lead_in_days=0, step=60.0)
    direct = environment.beam_irradiance * np.maximum(environment.sun_direction[:, 2], 0.0)
    found = _hour_means(direct + environment.diffuse_irradiance)
    bright = hourly[24:48] > 150.0
    np.testing.assert_allclose(found[bright], hourly[24:48][bright], rtol=0.03)
    assert direct.sum() > 2.0 * environment.diffuse_irradiance.sum()


def test_sunlight_at_night_betrays_a_wrong_clock_or_place(tmp_path: Path) -> None:
    beam, diffuse = (np.roll(values.ravel(), 6) for values in clear_means(DAYS))
    columns = ("direct_normal_W_m2", "diffuse_horizontal_W_m2")
    weather = read_weather(_station(tmp_path, columns, (beam, diffuse), averaging=3600))
    with pytest.raises(InputError, match="with the sun below the horizon; check place, UTC offset") as caught:
        build_environment(weather, image_day=DAYS[1], lead_in_days=0)
    assert str(weather.file) in str(caught.value)


@pytest.mark.parametrize(
    ("columns", "expected"),
    [
        (("direct_normal_W_m2",), "diffuse_horizontal_W_m2 is missing; give both"),
        (("diffuse_horizontal_W_m2", "global_horizontal_W_m2"), "direct_normal_W_m2 is missing; give both"),
    ],
)
def test_half_of_the_sunlight_is_refused(columns: tuple[str, ...], expected: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=expected):
        read_weather(_station(tmp_path, columns, [np.zeros(4)] * len(columns), averaging=3600))


@pytest.mark.parametrize(
    ("column", "value"), [("direct_normal_W_m2", -1.0), ("direct_normal_W_m2", 9999.0), ("sky_infrared_W_m2", 0.0)]
)
def test_impossible_radiation_is_refused(column: str, value: float, tmp_path: Path) -> None:
    columns = ("direct_normal_W_m2", "diffuse_horizontal_W_m2", "sky_infrared_W_m2")
    values = [np.full(4, value) if name == column else np.full(4, 300.0) for name in columns]
    with pytest.raises(InputError, match=f"{column} = "):
        read_weather(_station(tmp_path, columns, values, averaging=3600))


def test_sky_infrared_of_a_station_sets_the_sky_temperature(tmp_path: Path) -> None:
    path = _station(tmp_path, ("sky_infrared_W_m2",), (np.full(72, 250.0),), averaging=3600)
    environment = build_environment(read_weather(path), image_day=DAYS[1], lead_in_days=0)
    np.testing.assert_allclose(environment.sky_temperature, (250.0 / 5.670374419e-8) ** 0.25, rtol=1e-12)
    assert environment.beam_irradiance.max() == 0.0
