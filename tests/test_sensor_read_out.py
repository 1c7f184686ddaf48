"""Noise-equivalent temperatures by the photon model, deviates, and the seven components of noise."""

import dataclasses
import math

import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.radiometry import band_radiance, spectral_radiance
from sensorsim.sensor import load_sensor, netd, normal_deviate, read_out, sensitivity, stream_seed
from sensorsim.sensor.noise import Noise
from sensorsim.sensor.random_field import deviate_table
from sensorsim.sensor.read_out import fixed_pattern, frame_noise

SIZE = (160, 120)
QUIET = Noise(seed=3)
FRAMES = 48


def electrons(sensor, temperature):
    """Photoelectrons of a photon detector by a sum over photons, wavelength by wavelength."""
    band, detector, optics = sensor.band, sensor.detector, sensor.optics
    wavelength = np.linspace(band.wavelength[0], band.wavelength[-1], 20001)
    response = np.interp(wavelength, band.wavelength, band.response)
    peak = band.wavelength[np.argmax(band.response)]
    efficiency = detector.quantum_efficiency * response * peak / wavelength
    photon = 6.62607015e-34 * 299792458.0 / wavelength
    rate = np.trapezoid(spectral_radiance(wavelength, temperature) * efficiency / photon, wavelength)
    solid_angle = math.pi / (1.0 + 4.0 * (optics.focal_length / optics.aperture) ** 2)
    area = detector.width * detector.height
    return detector.integration_time * area * solid_angle * optics.transmission * rate


@pytest.mark.parametrize("temperature", [260.0, 300.0, 340.0])
def test_netd_of_a_photon_detector_is_that_of_its_electrons(temperature):
    sensor = load_sensor("cooled_mwir")
    detector = sensor.detector
    count = electrons(sensor, temperature)
    slope = (electrons(sensor, temperature + 0.05) - electrons(sensor, temperature - 0.05)) / 0.1
    dark = detector.dark_current * detector.integration_time
    rounding = (detector.well / (2**detector.bits - 1)) ** 2 / 12.0
    noise = math.sqrt(count + dark + detector.read_noise**2 + rounding)
    assert netd(sensor, temperature) == pytest.approx(noise / slope, rel=2e-3)


def test_netd_of_a_scanned_detector_is_lloyds():
    """NETD = 4 F^2 sqrt(bandwidth) / (sqrt(A) tau D* dM/dT) [Lloyd1975], for a slow lens and fine counts."""
    sensor = load_sensor("flir1977")
    optics = dataclasses.replace(sensor.optics, aperture=sensor.optics.focal_length / 20.0)
    detector = dataclasses.replace(sensor.detector, bits=30)
    sensor = dataclasses.replace(sensor, optics=optics, detector=detector)
    slope = math.pi * (band_radiance(sensor.band, 300.05) - band_radiance(sensor.band, 299.95)) / 0.1
    area = detector.width * detector.height
    lloyd = 4.0 * 20.0**2 * math.sqrt(detector.bandwidth / area) / (optics.transmission * detector.detectivity * slope)
    assert netd(sensor) == pytest.approx(float(lloyd), rel=1e-3)


def test_netd_of_a_thermal_detector_is_the_stated_one_and_grows_in_the_cold():
    sensor = load_sensor("uncooled")
    assert netd(sensor) == pytest.approx(sensor.detector.netd, rel=6e-3)  # counts add the rest
    assert 1.4 < netd(sensor, 260.0) / netd(sensor) < 1.7


def test_ideal_sensor_has_no_sensitivity():
    with pytest.raises(InputError, match="not described"):
        sensitivity(load_sensor("flir"))


def test_less_light_is_more_noise_by_its_square_root():
    look = sensitivity(load_sensor("emccd"))
    bare = dataclasses.replace(look, constant=0.0)
    assert bare.stopped(0.25).deviation(1.0) == pytest.approx(2.0 * bare.deviation(1.0), rel=1e-12)
    assert look.stopped(0.25).full == pytest.approx(4.0 * look.full, rel=1e-12)


def test_deviates_are_normal_and_uncorrelated():
    assert deviate_table().var() == pytest.approx(1.0, rel=1e-12)
    column, row = np.arange(400)[None, :], np.arange(300)[:, None]
    field = normal_deviate(column, row, 5, 9)
    assert field.mean() == pytest.approx(0.0, abs=4.0 / math.sqrt(field.size))
    assert field.var() == pytest.approx(1.0, abs=6.0 / math.sqrt(field.size))
    assert (field**4).mean() == pytest.approx(3.0, abs=0.1)
    for other in (normal_deviate(column, row, 6, 9), normal_deviate(column, row, 5, 10), field[::-1], field[:, ::-1]):
        assert abs((field * other).mean()) < 5.0 / math.sqrt(field.size)
    assert abs((field[:, 1:] * field[:, :-1]).mean()) < 5.0 / math.sqrt(field.size)
    assert abs((field[1:] * field[:-1]).mean()) < 5.0 / math.sqrt(field.size)


def test_deviates_are_the_same_in_any_order():
    whole = normal_deviate(np.arange(50)[None, :], np.arange(40)[:, None], 7, 11)
    assert float(normal_deviate(np.array([31]), np.array([17]), 7, 11)[0]) == whole[17, 31]


def cube(noise, bits=30):
    """Reports of a uniform black body of 300 K over many frames, in units of the random noise."""
    sensor = load_sensor("uncooled")
    sensor = dataclasses.replace(sensor, noise=noise, detector=dataclasses.replace(sensor.detector, bits=bits))
    look = sensitivity(sensor)
    light = np.full((SIZE[1], SIZE[0]), float(band_radiance(sensor.band, 300.0)))
    frames = np.stack([read_out(sensor, look, light, frame) for frame in range(FRAMES)])
    return (frames - light) / look.deviation(light)


def components(data):
    """Standard deviations of the seven components, by averages over the other directions [DAgostino1991]."""
    t, v, h = 0, 1, 2
    data = data - data.mean()
    first = {"t": data.mean((v, h), keepdims=True), "v": data.mean((t, h), keepdims=True)}
    first["h"] = data.mean((t, v), keepdims=True)
    second = {
        "tv": data.mean(h, keepdims=True) - first["t"] - first["v"],
        "th": data.mean(v, keepdims=True) - first["t"] - first["h"],
        "vh": data.mean(t, keepdims=True) - first["v"] - first["h"],
    }
    rest = data - sum(first.values()) - sum(second.values())
    return {name: float(part.std()) for name, part in {**first, **second, "tvh": rest}.items()}


@pytest.mark.parametrize("name", ["v", "h", "vh", "t", "tv", "th"])
def test_each_component_of_noise_is_found_again(name):
    strong = 3.0
    found = components(cube(dataclasses.replace(QUIET, **{name: strong})))
    count = {"v": 120, "h": 160, "t": FRAMES, "vh": 120 * 160, "tv": FRAMES * 120, "th": FRAMES * 160}[name]
    assert found[name] == pytest.approx(strong, rel=max(0.02, 4.0 / math.sqrt(2 * count)))
    assert found["tvh"] == pytest.approx(1.0, rel=0.02)
    for other in {"v", "h", "vh", "t", "tv", "th"} - {name}:
        left = strong / math.sqrt(FRAMES) if set(other) < set(name) else 0.0  # of the mean over the fewest there are
        assert found[other] < 0.2 + 1.3 * left


def test_measured_noise_of_a_uniform_frame_is_the_netd():
    for name in ("cooled_mwir", "uncooled", "flir1977"):
        sensor = dataclasses.replace(load_sensor(name), noise=QUIET)
        look = sensitivity(sensor)
        warm, warmer = (float(band_radiance(sensor.band, kelvin)) for kelvin in (300.0, 300.5))
        frames = [read_out(sensor, look, np.full((480, 640), light), 1) for light in (warm, warmer)]
        response = (frames[1].mean() - frames[0].mean()) / 0.5
        measured = frames[0].std() / response
        assert measured == pytest.approx(netd(sensor), rel=0.01)


def test_full_elements_report_no_more():
    sensor = load_sensor("cooled_mwir")
    look = sensitivity(sensor)
    assert read_out(sensor, look, np.full((4, 5), 3.0 * look.full), 0).max() == pytest.approx(look.full, rel=1e-12)
    assert read_out(sensor, look, np.zeros((4, 5)), 0).min() == 0.0


def test_dead_elements_report_nothing_and_stay():
    noise = dataclasses.replace(QUIET, dead=0.01)
    sensor = dataclasses.replace(load_sensor("uncooled"), noise=noise)
    dead = fixed_pattern(sensor, SIZE)[..., 2] == 0.0
    assert dead.mean() == pytest.approx(0.01, abs=1.5 / 4096 + 1e-4)
    light = np.full((SIZE[1], SIZE[0]), 40.0)
    for frame in (0, 1):
        assert np.array_equal(read_out(sensor, sensitivity(sensor), light, frame) == 0.0, dead)


def test_gains_do_not_show_at_the_temperature_of_their_correction():
    noise = dataclasses.replace(QUIET, gain=0.02)
    sensor = dataclasses.replace(load_sensor("uncooled"), noise=noise)
    look, flat = sensitivity(sensor), dataclasses.replace(sensor, noise=QUIET)
    for kelvin, visible in ((300.0, 0.0), (330.0, 0.02)):
        light = np.full((SIZE[1], SIZE[0]), float(band_radiance(sensor.band, kelvin)))
        pattern = read_out(sensor, look, light, 0) - read_out(flat, look, light, 0)
        difference = light[0, 0] - float(band_radiance(sensor.band, 300.0))
        assert pattern.std() == pytest.approx(visible * difference, rel=0.03, abs=look.step)


def test_channel_of_a_parallel_scan_draws_the_lines_of_all_fields_at_its_height():
    sensor = dataclasses.replace(load_sensor("flir1977"), noise=Noise(v=1.0))
    rows = frame_noise(sensor, (64, 360), 0).row
    assert rows[0::2].tolist() == rows[1::2].tolist()
    assert np.unique(rows).size > 170  # 180 channels, of which some have the same of 4096 deviates
    assert rows[::2].std() == pytest.approx(1.0, rel=0.2)
    assert np.unique(frame_noise(sensor, (64, 90), 0).row).size > 85  # of few rows each has a channel of its own


def test_streams_differ():
    sensor = load_sensor("uncooled")
    assert len({stream_seed(sensor, name) for name in ("tvh", "vh", "v", "h", "t", "tv", "th", "gain", "dead")}) == 9
