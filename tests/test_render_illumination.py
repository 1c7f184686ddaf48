from dataclasses import replace

import numpy as np
import pytest
from small_world import environment, tables

from sensorsim.environment import CLOUD_TEMPERATURE_DEPRESSION, EnvironmentSample, band_sky
from sensorsim.errors import InputError
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
        assert light.sky[0] <= float(table.radiance_at(_sample(hour).air_temperature)) * (1.0 + 1e-12)
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
    received = light.beam * max(float(light.sun_direction[2]), 0.0) + diffuse
    assert light.beam == max(sample.nir_beam, sample.moon_beam)
    assert np.pi * light.ground_radiance == pytest.approx(sample.ground_albedo * received, rel=1e-9)
    assert (light.air.coefficient > 0.0).all()


def test_low_light_by_night_is_only_the_glow_of_the_sky() -> None:
    noon, night = (illuminate(load_sensor("lltv"), _sample(hour), 280.0, None) for hour in (12.0, 4.0))
    assert night.beam == 0.0  # the half moon of that night has set
    assert night.glow is None
    assert 0.0 < night.sky_radiance < 1e-4 * noon.sky_radiance


@pytest.mark.parametrize("hour", [8.0, 12.0, 16.0])
@pytest.mark.parametrize("cover", [0.0, 0.4, 1.0])
def test_low_light_sky_gives_a_roof_its_diffuse_light(hour: float, cover: float) -> None:
    """Rationale: radiance times cosine over the whole hemisphere, in fine steps, is the irradiance; expected 0.5 %."""
    sample = replace(_sample(hour), cloud_cover=cover)
    light = illuminate(load_sensor("lltv"), sample, 280.0, None)
    sine = (np.arange(600) + 0.5) / 600.0
    azimuth = 2.0 * np.pi * (np.arange(720) + 0.5) / 720.0
    flat = np.sqrt(1.0 - sine**2)[:, None]
    cosine = sine[:, None] * light.sun_direction[2] + flat * (
        np.cos(azimuth) * light.sun_direction[0] + np.sin(azimuth) * light.sun_direction[1]
    )
    gradation, indicatrix = light.glow_tables()
    radiance = light.sky_table().evaluate(sine)[:, None] + (
        gradation.evaluate(sine)[:, None] * indicatrix.evaluate(cosine)
    )
    assert (radiance >= 0.0).all()
    irradiance = 2.0 * np.pi * float(np.mean(radiance * sine[:, None]))
    assert irradiance == pytest.approx(float(np.sum(sample.nir_quadrant)), rel=5e-3)


def test_clear_low_light_sky_is_brightest_by_the_sun_and_the_overcast_one_overhead() -> None:
    clear, dull = (
        illuminate(load_sensor("lltv"), replace(_sample(12.0), cloud_cover=cover), 280.0, None) for cover in (0.0, 1.0)
    )
    assert clear.glow is not None
    assert clear.glow.indicatrix[-1] > 4.0 * clear.glow.indicatrix[512]
    assert clear.sky.max() == 0.0
    assert dull.glow is None or dull.glow.irradiance == 0.0
    assert dull.sky[-1] == pytest.approx(2.986 * dull.sky[0], rel=1e-3)  # 1 + 4 exp(-0.7), [ISO15469] type 1


def test_moon_lights_what_the_sun_does_not(table: BandTable) -> None:
    night = replace(_sample(4.0), moon_beam=3e-4, moon_direction=np.array([0.6, 0.0, 0.8]))
    light = illuminate(load_sensor("lltv"), night, 280.0, None)
    assert light.beam == 3e-4
    np.testing.assert_array_equal(light.sun_direction, [0.6, 0.0, 0.8])
    day = replace(_sample(12.0), moon_beam=3e-4, moon_direction=np.array([0.6, 0.0, 0.8]))
    assert illuminate(load_sensor("lltv"), day, 280.0, None).beam == day.nir_beam
    assert illuminate(load_sensor("flir"), night, 280.0, table).beam == 0.0


def test_air_of_the_report_has_one_coefficient_exact_at_a_kilometre(table: BandTable) -> None:
    """Eq. 15 of the report: exp(-alpha 1 km) is the transmittance of a kilometre, the same at all heights."""
    for name, band in (("flir", "FLIR"), ("lltv", "LLLTV")):
        made = table if name == "flir" else None
        air = illuminate(load_sensor(name), _sample(10.0), 280.0, made, atmosphere="report").air
        exact = float(_sample(10.0).transmittance(band).at(1000.0))
        assert float(air.transmittance(1000.0)) == pytest.approx(exact, rel=1e-9)
        assert float(air.transmittance(1000.0, 900.0, 100.0)) == pytest.approx(exact, rel=1e-9)


def test_standard_air_is_the_weathers_and_thins_out_with_height(table: BandTable) -> None:
    for name, band in (("flir", "FLIR"), ("lltv", "LLLTV")):
        air = illuminate(load_sensor(name), _sample(10.0), 280.0, table if name == "flir" else None).air
        distance = np.geomspace(10.0, 30e3, 40)
        exact = _sample(10.0).transmittance(band).at(distance)
        np.testing.assert_allclose(air.transmittance(distance), exact, rtol=1e-12)
        assert (np.diff(air.transmittance(3000.0, np.linspace(0.0, 3000.0, 20))) > 0.0).all()


def test_no_air_shows_surfaces_as_they_are(table: BandTable) -> None:
    air = illuminate(load_sensor("flir"), _sample(10.0), 280.0, table, atmosphere="none").air
    np.testing.assert_array_equal(air.apparent_radiance(np.array([0.0, 12.0, 80.0]), 5e3, 300.0), [0.0, 12.0, 80.0])


def test_haze_under_a_colder_sky_shines_less_than_the_air(table: BandTable) -> None:
    """What haze scatters comes from sky and ground; what it does not scatter it emits at air temperature."""
    light = illuminate(load_sensor("flir"), _sample(7.0), 270.0, table)
    air = float(table.radiance_at(_sample(7.0).air_temperature))
    around = 0.5 * (light.sky_radiance + light.ground_radiance)
    assert around < air
    assert ((light.air.source < air) & (light.air.source > around)).all()
    assert light.air.source[0] < light.air.source[-1]  # the clearer the air, the more of its light is scattered


def test_air_light_by_day_is_brighter_towards_the_sun() -> None:
    light = illuminate(load_sensor("lltv"), _sample(13.0), 280.0, None)
    far = [float(light.air.apparent_radiance(0.0, 20e3, 50.0, 50.0, cosine)) for cosine in (-1.0, 0.0, 0.5, 1.0)]
    assert (np.diff(far) > 0.0).all()
    night = illuminate(load_sensor("lltv"), _sample(4.0), 280.0, None)
    assert float(night.air.beam_source.max()) == 0.0


@pytest.mark.parametrize("name", ["", "Standard", "lowtran"])
def test_unknown_atmosphere_is_refused_by_name(table: BandTable, name: str) -> None:
    with pytest.raises(InputError, match="standard, report, modtran, none"):
        illuminate(load_sensor("flir"), _sample(10.0), 280.0, table, atmosphere=name)
