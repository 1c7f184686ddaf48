"""Light in 0.8-1.1 um by day, in twilight and at night."""

from datetime import date

import numpy as np
import pytest

from sensorsim.environment import (
    NIGHT_GLOW,
    Sunlight,
    SunPosition,
    build_environment,
    near_infrared,
    read_weather,
    twilight_irradiance,
)


def _position(elevation: float) -> SunPosition:
    up = np.deg2rad(elevation)
    return SunPosition(
        direction=np.array([[0.0, -np.cos(up), np.sin(up)]]),
        elevation=np.array([elevation]),
        true_elevation=np.array([elevation]),
        azimuth=np.array([180.0]),
    )


def test_sun_at_sixty_degrees_puts_into_the_band_what_radiative_transfer_puts_there() -> None:
    """Mid-latitude summer, 23 km: beam 148 (LOWTRAN7) to 155 W m-2 (6S), diffuse 15.7 W m-2; SPCTRAL2's broadband."""
    clear = Sunlight(beam=np.array([657.0]), diffuse=np.array([129.0]), extraterrestrial=np.array([1361.0]))
    found = near_infrared(clear, clear, _position(30.0), np.zeros(1), np.zeros(1))
    assert 148.0 <= found.beam[0] <= 155.0
    assert found.quadrant.sum() == pytest.approx(15.7, rel=0.02)


def test_overcast_light_has_the_colour_of_the_clear_global_light() -> None:
    clear = Sunlight(beam=np.array([657.0]), diffuse=np.array([129.0]), extraterrestrial=np.array([1361.0]))
    total = 657.0 * 0.5 + 129.0
    cloudy = Sunlight(beam=np.zeros(1), diffuse=np.array([total / 4.0]), extraterrestrial=np.array([1361.0]))
    bright = near_infrared(clear, clear, _position(30.0), np.zeros(1), np.zeros(1))
    dull = near_infrared(clear, cloudy, _position(30.0), np.ones(1), np.zeros(1))
    expected = (bright.beam[0] * 0.5 + bright.quadrant.sum()) / total
    assert dull.quadrant.sum() / (total / 4.0) == pytest.approx(expected)


def test_twilight_falls_steadily_to_the_glow_of_the_night() -> None:
    elevation = np.linspace(0.0, -30.0, 3001)
    light = twilight_irradiance(elevation)
    assert (np.diff(light) <= 0.0).all()
    assert (light[1:] / light[:-1]).min() > 0.98  # no step: a hundredth of a degree takes at most two percent
    assert light[-1] == NIGHT_GLOW
    assert (np.diff(light[elevation > -18.0]) < 0.0).all()


@pytest.mark.parametrize(("elevation", "lux"), [(0.0, 758.6), (-6.0, 3.6), (-12.0, 8.0e-3)])
def test_twilight_has_the_illuminance_of_the_almanac(elevation: float, lux: float) -> None:
    """Sunset, civil and nautical dusk: about 760, 3.6 and 0.008 lx; a fifth of the watts of 110 lm/W."""
    found = (twilight_irradiance(np.array([elevation]))[0] - NIGHT_GLOW) * 110.0 / 0.2
    assert found == pytest.approx(lux, rel=0.1)


@pytest.mark.parametrize(("name", "day"), [("winter", date(1976, 2, 7)), ("fall", date(1976, 10, 7))])
def test_light_passes_sunrise_and_sunset_without_a_step(name: str, day: date) -> None:
    """Minute by minute the diffuse light in the band never more than doubles or halves, and never goes out."""
    environment = build_environment(read_weather(name), image_day=day, lead_in_days=0, step=60.0)
    diffuse = environment.nir_quadrant.sum(axis=-1)
    assert diffuse.min() > 0.0
    assert np.abs(np.diff(np.log2(diffuse))).max() < 0.5
    down = environment.sun_elevation < 0.0
    np.testing.assert_allclose(environment.nir_quadrant[down], diffuse[down, None] / 4.0 * np.ones(4))
    assert (environment.nir_beam[down] == 0.0).all()


def test_winter_frame_at_seven_has_light_though_the_sun_is_eight_degrees_down() -> None:
    sample = build_environment(read_weather("winter"), image_day=date(1976, 2, 7), lead_in_days=0).at(7 * 3600.0)
    assert sample.sun_elevation == pytest.approx(-8.0, abs=0.05)
    assert 1e-4 < sample.nir_quadrant.sum() < 1e-2
    assert sample.quadrant_irradiance.sum() == 0.0
