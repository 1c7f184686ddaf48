"""The moon: where eclipses put it, and what it gives."""

import numpy as np
import pytest

from sensorsim.environment import Site, sun_position
from sensorsim.environment.moon import FULL_MOON, moon_direction, moonlight


def _site(latitude: float, longitude: float) -> Site:
    return Site(name="place", latitude=latitude, longitude=longitude, altitude=0.0, utc_offset=0.0)


# Instants and places of greatest eclipse of the sun: the moon stands before it.
ECLIPSES = [
    ("1999-08-11T11:03", 45.08, 24.30),
    ("2017-08-21T18:26", 36.97, -87.67),
    ("2024-04-08T18:17", 25.29, -104.14),
    ("1976-10-23T05:13", -29.99, 92.27),
]


@pytest.mark.parametrize(("instant", "latitude", "longitude"), ECLIPSES)
def test_moon_stands_before_the_sun_in_an_eclipse(instant: str, latitude: float, longitude: float) -> None:
    """Expected: within 0.4 degrees as seen from there, the series' 0.3 and the discs' own play."""
    time, site = np.array([instant], dtype="datetime64[s]"), _site(latitude, longitude)
    apart = np.degrees(np.arccos(moon_direction(site, time)[0] @ sun_position(site, time).direction[0]))
    assert apart < 0.4


def test_moon_eclipsed_by_the_earth_is_full_and_one_that_eclipses_is_new() -> None:
    """21 January 2000, 04:44 UTC, over Ohio; 11 August 1999 over Romania."""
    for instant, place, low, high in (("2000-01-21T04:44", (39.8, -84.0), 0.0, 1.6),
                                      ("1999-08-11T11:03", (45.08, 24.3), 179.0, 180.0)):  # fmt: skip
        time, site = np.array([instant], dtype="datetime64[s]"), _site(*place)
        found = moonlight(site, time, sun_position(site, time), np.zeros(1))
        assert low <= found.phase_angle[0] <= high


def test_moonlight_rises_and_sets_with_the_moon_and_dims_under_cloud() -> None:
    time = np.datetime64("2000-01-20T00:00", "s") + np.arange(0, 48 * 3600, 600).astype("timedelta64[s]")
    site = _site(39.8, -84.0)
    sun = sun_position(site, time)
    clear, dull = (moonlight(site, time, sun, np.full(time.size, cover)) for cover in (0.0, 1.0))
    down = clear.direction[:, 2] <= 0.0
    assert 0.2 < down.mean() < 0.8
    assert (clear.beam[down] == 0.0).all()
    assert (clear.diffuse[down] == 0.0).all()
    assert 0.5 * FULL_MOON < clear.beam.max() < FULL_MOON
    assert (dull.beam == 0.0).all()
    global_light = [light.beam * np.maximum(light.direction[:, 2], 0.0) + light.diffuse for light in (clear, dull)]
    np.testing.assert_allclose(global_light[1], 0.25 * global_light[0], rtol=1e-12)


def test_half_moon_gives_far_less_than_half() -> None:
    """The opposition surge and the rough ground: a fifteenth at a phase angle of 90 degrees."""
    time = np.datetime64("2000-01-21T06:00", "s") - np.arange(0, 8 * 86400, 3600).astype("timedelta64[s]")
    site = _site(39.8, -84.0)
    found = moonlight(site, time, sun_position(site, time), np.zeros(time.size))
    high = found.direction[:, 2] > 0.4
    half = found.beam[high & (np.abs(found.phase_angle - 90.0) < 6.0)].mean()
    full = found.beam[high & (found.phase_angle < 6.0)].mean()
    assert 0.04 < half / full < 0.12
