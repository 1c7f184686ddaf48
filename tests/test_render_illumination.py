import numpy as np
import pytest
from small_world import environment, tables

from sensorsim.environment import CLOUD_TEMPERATURE_DEPRESSION, EnvironmentSample, band_sky
from sensorsim.radiometry import BandTable, build_band_table
from sensorsim.render import Illumination, illuminate
from sensorsim.sensor import load_sensor

HOURS = (0.0, 7.0, 10.0, 13.0, 17.0, 24.0)


@pytest.fixture(scope="module")
def table() -> BandTable:
    return build_band_table(load_sensor("flir").band)


def _sample(hour: float) -> EnvironmentSample:
    return environment().at(3600.0 * hour)


def _thermal(hour: float, table: BandTable) -> Illumination:
    return illuminate(load_sensor("flir"), _sample(hour), float(tables().ground_temperature[0]), table)


@pytest.mark.parametrize("hour", HOURS)
def test_sky_table_is_the_sky_of_the_environment_at_any_elevation(hour: float, table: BandTable) -> None:
    """Expected: 5 mK of apparent temperature between the entries, from the horizon to the zenith."""
    sample, light = _sample(hour), _thermal(hour, table)
    elevation = np.concatenate([np.linspace(0.0, 2.0, 400), np.linspace(2.0, 90.0, 400)])
    parts = band_sky(elevation, vapour_pressure=sample.vapour_pressure, cloud_cover=sample.cloud_cover)
    cloud = table.radiance_at(sample.air_temperature - CLOUD_TEMPERATURE_DEPRESSION)
    exact = parts.air * table.radiance_at(sample.air_temperature) + parts.cloud * cloud
    looked_up = light.sky_table().evaluate(np.sin(np.radians(elevation)))
    miss = table.apparent_temperature(looked_up) - table.apparent_temperature(exact)
    assert np.abs(miss).max() < 5e-3


@pytest.mark.parametrize("hour", HOURS)
def test_mean_sky_gives_a_roof_what_the_sky_gives_it(hour: float, table: BandTable) -> None:
    """Rationale: irradiance of the horizontal is the integral of radiance times cosine, in fine steps of elevation."""
    light = _thermal(hour, table)
    angle = (np.arange(20000) + 0.5) / 20000.0 * np.pi / 2.0
    sky = light.sky_table().evaluate(np.sin(angle))
    irradiance = np.sum(sky * 2.0 * np.pi * np.sin(angle) * np.cos(angle)) * np.pi / 2.0 / 20000.0
    assert np.pi * light.sky_radiance == pytest.approx(irradiance, rel=1e-5)


def test_thermal_horizon_is_as_warm_as_the_air_and_the_zenith_is_colder(table: BandTable) -> None:
    for hour in HOURS:
        light = _thermal(hour, table)
        assert light.air_radiance == pytest.approx(float(table.radiance_at(_sample(hour).air_temperature)), rel=1e-12)
        assert light.sky[0] <= light.air_radiance * (1.0 + 1e-12)
        assert light.sky[0] > light.sky[-1]
        assert light.beam == 0.0


def test_thermal_ground_glows_at_its_own_temperature(table: BandTable) -> None:
    warm = illuminate(load_sensor("flir"), _sample(13.0), 300.0, table)
    assert warm.ground_radiance == pytest.approx(float(table.radiance_at(300.0)), rel=1e-12)


@pytest.mark.parametrize("hour", HOURS)
def test_low_light_adds_up(hour: float) -> None:
    """A roof gets the sky's quarters together; the ground returns its albedo of beam and sky."""
    sample = _sample(hour)
    light = illuminate(load_sensor("lltv"), sample, 280.0, None)
    diffuse = float(np.sum(sample.nir_quadrant))
    assert np.pi * light.sky_radiance == pytest.approx(diffuse, rel=1e-9)
    received = sample.nir_beam * max(float(sample.sun_direction[2]), 0.0) + diffuse
    assert np.pi * light.ground_radiance == pytest.approx(sample.ground_albedo * received, rel=1e-9)
    assert light.attenuation > 0.0


def test_low_light_by_night_is_only_the_glow_of_the_sky() -> None:
    noon, night = (illuminate(load_sensor("lltv"), _sample(hour), 280.0, None) for hour in (12.0, 0.0))
    assert night.beam == 0.0
    assert 0.0 < night.sky_radiance < 1e-4 * noon.sky_radiance


def test_single_coefficient_of_the_air_is_exact_at_a_kilometre(table: BandTable) -> None:
    """Eq. 15 of the report has one coefficient: exp(-alpha 1 km) is the transmittance of a kilometre."""
    for name, band in (("flir", "FLIR"), ("lltv", "LLLTV")):
        made = table if name == "flir" else None
        light = illuminate(load_sensor(name), _sample(10.0), 280.0, made)
        exact = float(_sample(10.0).transmittance(band).at(1000.0))
        assert np.exp(-1000.0 * light.attenuation) == pytest.approx(exact, rel=1e-9)
