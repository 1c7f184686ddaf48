"""The times of day that tables keep: close by day and in rain, few in a dry night."""

from dataclasses import replace

import numpy as np
import pytest
from small_world import SETTINGS, environment, random_normals, wall_types

from sensorsim.environment import Environment
from sensorsim.tables import bake_tables, surface_temperature
from sensorsim.tables.slices import DRYING, QUIET, kept_samples

FINE = replace(SETTINGS, slice_interval=300.0)


def _kept(weather: Environment, interval: float = 300.0) -> np.ndarray:
    """Times [s] of the image day that are kept."""
    samples = kept_samples(weather, replace(SETTINGS, slice_interval=interval))
    return np.asarray((samples - weather.image_window.start) * weather.step)


def test_day_is_kept_closely_and_the_night_by_the_quarter_of_an_hour() -> None:
    weather = environment()
    kept = _kept(weather)
    assert (kept[0], kept[-1]) == (0.0, 86400.0)
    window = weather.image_window
    light = (weather.beam_irradiance + weather.diffuse_irradiance)[window] > 0.0
    lit = np.flatnonzero(light) * weather.step
    spacing = np.diff(kept)
    by_day = (kept[:-1] >= lit[0] - DRYING) & (kept[1:] <= lit[-1] + DRYING)
    np.testing.assert_array_equal(spacing[by_day], 300.0)
    assert spacing.max() == QUIET
    assert np.mean(by_day) > 0.5
    assert kept.size < 200


def test_rain_at_night_is_kept_closely_too() -> None:
    weather = environment()
    rain = np.zeros_like(weather.precipitation)
    begin = weather.image_window.start
    rain[begin + 12 : begin + 24] = 2.0
    kept = _kept(replace(weather, precipitation=rain))
    assert set(np.arange(0.0, 7200.0 + DRYING, 300.0)) <= set(kept)
    assert kept.size > _kept(weather).size


@pytest.mark.parametrize("interval", [900.0, 1800.0, 3600.0, 86400.0])
def test_slices_that_are_far_apart_stay_as_they_are(interval: float) -> None:
    np.testing.assert_array_equal(_kept(environment(), interval), np.arange(0.0, 86400.0 + interval, interval))


def test_polar_night_keeps_only_quarters_of_an_hour_and_midsummer_all() -> None:
    weather = environment()
    none, full = np.zeros_like(weather.beam_irradiance), np.ones_like(weather.beam_irradiance)
    dark = replace(weather, beam_irradiance=none, diffuse_irradiance=none)
    np.testing.assert_array_equal(_kept(dark), np.arange(0.0, 86400.0 + QUIET, QUIET))
    bright = replace(weather, diffuse_irradiance=full)
    np.testing.assert_array_equal(_kept(bright), np.arange(0.0, 86400.0 + 300.0, 300.0))


def test_sheet_metal_at_night_is_between_its_few_slices_what_it_is_with_all_of_them() -> None:
    """At two times in three that the night leaves out, against slices of its own: within 0.01 K."""
    weather, sheet, normal = environment(), wall_types()[1:2], random_normals(30)
    few = bake_tables(weather, sheet, ground=wall_types()[3], settings=FINE)
    bright = replace(weather, precipitation=np.full_like(weather.precipitation, 1e-12))
    kept = bake_tables(bright, sheet, ground=wall_types()[3], settings=FINE)
    assert few.time_of_day.size < 0.7 * kept.time_of_day.size
    wall, reflectance = np.zeros(30, dtype=np.int64), np.full(30, 0.4)
    for time in (300.0, 6900.0, 11100.0, 77100.0):
        assert time not in few.time_of_day
        one, other = (surface_temperature(baked, normal, wall, reflectance, time) for baked in (few, kept))
        np.testing.assert_allclose(one, other, atol=0.01)
