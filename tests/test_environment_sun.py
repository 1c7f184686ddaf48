"""Position of the sun and sunlight under clear and cloudy skies."""

from datetime import UTC, datetime, timedelta, timezone

import numpy as np
import pandas as pd
import pvlib
import pytest
from numpy.typing import NDArray

from sensorsim.environment import Site, Sunlight, clear_sunlight, linke_turbidity, sun_position, sunlight_under_cloud

FAIRBORN = Site(name="Fairborn", longitude=-84.02, latitude=39.82, altitude=255.0, utc_offset=-5.0)

# Local standard time, apparent elevation, azimuth [deg], Linke turbidity, extraterrestrial, beam, diffuse [W m-2]:
# pvlib 0.16.1 run once from end to end (solarposition nrel_numpy, clearsky.ineichen, its turbidity lookup).
EXPECTED = [
    ("1976-02-07T07:00", -8.018, 103.511, 2.925, 1405.261, 0.0, 0.0),
    ("1976-02-07T10:00", 22.046, 135.317, 2.925, 1405.261, 749.321, 56.966),
    ("1976-02-07T16:00", 19.387, 228.823, 2.925, 1405.261, 707.614, 52.248),
    ("1976-09-03T07:00", 9.546, 88.213, 4.147, 1342.724, 225.082, 36.748),
    ("1976-09-03T13:00", 57.030, 191.320, 4.147, 1342.724, 805.615, 137.536),
    ("1976-10-07T07:00", 3.472, 100.141, 3.625, 1368.550, 49.622, 6.797),
    ("1976-10-07T17:00", 12.085, 251.804, 3.625, 1368.550, 389.757, 45.357),
]


def _utc(local: NDArray[np.datetime64], site: Site) -> NDArray[np.datetime64]:
    return local - np.timedelta64(int(site.utc_offset * 3600), "s")


def _year(site: Site, year: int, minutes: int = 60) -> tuple[NDArray[np.datetime64], Sunlight, NDArray[np.float64]]:
    first, last = np.datetime64(f"{year}-01-01", "m"), np.datetime64(f"{year + 1}-01-01", "m")
    local = np.arange(first, last, np.timedelta64(minutes, "m"))
    position = sun_position(site, _utc(local, site))
    return local, clear_sunlight(site, position, local), position.elevation


@pytest.mark.parametrize("row", EXPECTED, ids=lambda row: row[0])
def test_sun_over_fairborn_in_1976(row: tuple[str, float, float, float, float, float, float]) -> None:
    text, elevation, azimuth, turbidity, extraterrestrial, beam, diffuse = row
    local = np.array([text], dtype="datetime64[s]")
    position = sun_position(FAIRBORN, _utc(local, FAIRBORN))
    light = clear_sunlight(FAIRBORN, position, local)
    assert position.elevation[0] == pytest.approx(elevation, abs=0.002)
    assert position.azimuth[0] == pytest.approx(azimuth, abs=0.002)
    assert linke_turbidity(FAIRBORN, local)[0] == pytest.approx(turbidity, abs=0.001)
    assert light.extraterrestrial[0] == pytest.approx(extraterrestrial, abs=0.001)
    assert light.beam[0] == pytest.approx(beam, abs=0.05)
    assert light.diffuse[0] == pytest.approx(diffuse, abs=0.05)


def test_direction_is_a_unit_vector_that_agrees_with_the_angles() -> None:
    local = np.arange(np.datetime64("1976-02-07T00:00", "m"), np.datetime64("1976-02-08T00:00", "m"), 5)
    position = sun_position(FAIRBORN, _utc(local, FAIRBORN))
    np.testing.assert_allclose(np.linalg.norm(position.direction, axis=-1), 1.0)
    np.testing.assert_allclose(np.rad2deg(np.arcsin(position.direction[:, 2])), position.elevation, atol=1e-9)
    morning = position.direction[local == np.datetime64("1976-02-07T10:00")][0]
    assert morning[0] > 0.0 > morning[1]


def test_turbidity_is_the_one_that_pvlib_interpolates() -> None:
    dates = np.arange(np.datetime64("2023-01-01"), np.datetime64("2025-01-01"), 17)
    monthly = pvlib.clearsky.lookup_linke_turbidity(
        pd.DatetimeIndex(["2023-06-15"], tz="UTC"), 39.82, -84.02, interp_turbidity=False
    )
    mid_june = linke_turbidity(FAIRBORN, np.array(["2023-06-15"], dtype="datetime64[D]"))
    assert mid_june[0] == pytest.approx(monthly.iloc[0], abs=0.01)
    daily = linke_turbidity(FAIRBORN, dates)
    assert np.abs(np.diff(daily)).max() < 0.7
    assert daily.shape == dates.shape


@pytest.mark.parametrize("latitude", [-90.0, -66.6, 0.0, 39.82, 78.2, 90.0])
def test_no_latitude_or_season_gives_nan_or_negative_light(latitude: float) -> None:
    """A leap year by the hour, with polar day and night, at both poles and on the equator."""
    site = Site(name="anywhere", longitude=15.6, latitude=latitude, altitude=10.0, utc_offset=1.0)
    _, clear, elevation = _year(site, 1976)
    for cover in (0.0, 0.5, 1.0):
        light = sunlight_under_cloud(clear, elevation, np.full(elevation.shape, cover))
        for values in (light.beam, light.diffuse, light.extraterrestrial):
            assert np.isfinite(values).all()
            assert (values >= 0.0).all()
        assert (light.beam <= light.extraterrestrial).all()
        assert (light.beam[elevation <= 0.0] == 0.0).all()
        assert (light.diffuse[elevation <= 0.0] == 0.0).all()


def test_polar_night_and_polar_day_are_what_they_are() -> None:
    site = Site(name="Longyearbyen", longitude=15.6, latitude=78.2, altitude=10.0, utc_offset=1.0)
    local, clear, _ = _year(site, 1976)
    month = local.astype("datetime64[M]")
    assert clear.diffuse[month == np.datetime64("1976-12")].max() == 0.0
    assert clear.diffuse[month == np.datetime64("1976-06")].min() > 0.0


def test_leap_day_is_a_day_of_its_own() -> None:
    dates = np.array(["1976-02-28", "1976-02-29", "1976-03-01"], dtype="datetime64[D]")
    noon = dates.astype("datetime64[s]") + np.timedelta64(12 * 3600, "s")
    position = sun_position(FAIRBORN, _utc(noon, FAIRBORN))
    light = clear_sunlight(FAIRBORN, position, noon)
    steps = np.diff(light.extraterrestrial)
    assert steps[0] == pytest.approx(steps[1], rel=0.05)
    assert np.diff(position.elevation) == pytest.approx([0.375, 0.378], abs=0.02)


def test_clouds_take_what_kasten_and_czeplak_say_and_the_diffuse_is_never_negative() -> None:
    """Overcast leaves a quarter of the clear global light and no beam; the balance holds at every cover."""
    _, clear, elevation = _year(FAIRBORN, 1976, minutes=20)
    height = np.sin(np.deg2rad(np.maximum(elevation, 0.0)))
    total = clear.beam * height + clear.diffuse
    for cover in np.linspace(0.0, 1.0, 21):
        light = sunlight_under_cloud(clear, elevation, np.full(elevation.shape, cover))
        assert light.diffuse.min() >= 0.0
        np.testing.assert_allclose(light.beam * height + light.diffuse, total * (1.0 - 0.75 * cover**3.4), atol=1e-9)
    assert light.beam.max() == 0.0
    np.testing.assert_allclose(light.diffuse, total / 4.0, atol=1e-9)


def test_utc_offset_shifts_the_clock_and_nothing_else() -> None:
    moment = datetime(1976, 2, 7, 15, tzinfo=UTC)
    elevations = []
    for offset in (-5.0, 0.0, 5.5):
        local = moment.astimezone(timezone(timedelta(hours=offset))).replace(tzinfo=None)
        site = Site(name="Fairborn", longitude=-84.02, latitude=39.82, altitude=255.0, utc_offset=offset)
        elevations.append(sun_position(site, _utc(np.array([local], dtype="datetime64[s]"), site)).elevation[0])
    assert np.ptp(elevations) == 0.0
