"""Blur kernels: what they hold, and the edge that they make against the integral of the transfer function."""

import dataclasses

import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.sensor import blur_kernel, load_sensor, system_transfer
from sensorsim.sensor.focal_plane import column_places, focal_plane

MODELLED = ["flir1977", "uncooled", "sit1977", "emccd", "cooled_mwir"]


def element(sensor):
    return sensor.detector.pitch / sensor.optics.focal_length


def sweep_rate(sensor):
    return sensor.scan.sweep_rate(np.radians(sensor.horizontal_field_of_view), sensor.size[1])


def edge(sensor, place):
    """Response at `place` [rad] to a vertical edge at 0, by the integral of the transfer function."""
    frequency = np.linspace(0.0, 40.0 / element(sensor), 40001)[1:]
    contrast = system_transfer(sensor, np.zeros(1), frequency, sweep_rate=sweep_rate(sensor))
    step = frequency[1] - frequency[0]
    wave = contrast * np.sin(2.0 * np.pi * frequency * place) / (np.pi * frequency)
    return 0.5 + step * (wave.sum() + place)  # the value at frequency 0 is 2 place, of weight one half


@pytest.mark.parametrize("name", MODELLED)
def test_kernel_is_not_negative_and_sums_to_one(name):
    sensor = load_sensor(name)
    weights = blur_kernel(sensor, element(sensor)).weights
    assert weights.sum() == pytest.approx(1.0, rel=1e-12)
    assert weights.min() > -2e-5
    assert weights[::-1, ::-1] == pytest.approx(weights, abs=2e-4)


@pytest.mark.parametrize("name", MODELLED)
@pytest.mark.parametrize("samples", [1, 3])
def test_edge_is_that_of_the_transfer_function(name, samples):
    sensor = load_sensor(name)
    kernel = blur_kernel(sensor, element(sensor) / samples)
    response = np.cumsum(kernel.weights.sum(axis=0))
    reach = response.size // 2
    for index in range(0, response.size, max(1, response.size // 12)):
        place = (index - reach + 0.5) / samples * element(sensor)
        assert response[index] == pytest.approx(edge(sensor, place), abs=5e-3)


@pytest.mark.parametrize("name", MODELLED)
def test_relative_edge_response_of_a_drawn_edge_is_right(name):
    """Edges drawn half an element to either side of a column's middle: the difference of what it sees."""
    sensor, samples = load_sensor(name), 5
    kernel = blur_kernel(sensor, element(sensor) / samples)
    places = column_places(41, samples, 0.1, equal_angle=False)
    seen = []
    for start in (20 * samples, 21 * samples):  # the two sides of column 20
        picture = np.zeros((9 * samples, 41 * samples))
        picture[:, start:] = 1.0
        seen.append(focal_plane(picture, kernel, places, samples)[4, 20])
    half = 0.5 * element(sensor)
    assert seen[0] - seen[1] == pytest.approx(edge(sensor, half) - edge(sensor, -half), abs=0.01)


def test_more_of_the_light_takes_a_wider_kernel():
    sensor = load_sensor("uncooled")
    taps = [blur_kernel(sensor, element(sensor), energy=energy).row.shape[1] for energy in (0.9, 0.97, 0.987)]
    assert taps[0] < taps[1] < taps[2]


def test_ideal_sensor_has_no_kernel_and_full_contrast():
    assert blur_kernel(load_sensor("flir"), 1e-3) is None
    assert system_transfer(load_sensor("flir"), np.zeros((3, 1)), np.ones((1, 2))).tolist() == [[1.0, 1.0]] * 3


def test_kernel_refuses_samples_that_are_too_fine():
    with pytest.raises(InputError, match="wider than 192 samples"):
        blur_kernel(load_sensor("uncooled"), 1e-6)


def test_columns_of_a_turning_mirror_are_equal_in_angle():
    flat = column_places(640, 3, np.radians(40.0), equal_angle=False)
    assert flat.tolist() == [3 * column + 1 for column in range(640)]
    turned = column_places(640, 3, np.radians(40.0), equal_angle=True)
    assert np.abs(turned - flat).max() / (0.5 * 640 * 3) == pytest.approx(0.0163, abs=0.0015)
    assert (turned + turned[::-1]).tolist() == pytest.approx([640 * 3 - 1] * 640, abs=1.0)


def test_uniform_light_stays_uniform():
    sensor = load_sensor("uncooled")
    kernel = blur_kernel(sensor, element(sensor))
    places = column_places(20, 1, 0.01, equal_angle=False)
    assert focal_plane(np.full((15, 20), 47.0), kernel, places, 1) == pytest.approx(np.full((15, 20), 47.0), rel=1e-9)


def test_drift_smears_along_the_rows_only():
    sharp = load_sensor("emccd")
    moving = dataclasses.replace(sharp, optics=dataclasses.replace(sharp.optics, drift=2.0 * element(sharp)))
    still, smeared = (blur_kernel(sensor, element(sharp)).weights for sensor in (sharp, moving))
    spread = [np.sqrt((w.sum(axis=0) * (np.arange(w.shape[1]) - w.shape[1] // 2) ** 2).sum()) for w in (still, smeared)]
    assert spread[1] ** 2 - spread[0] ** 2 == pytest.approx(4.0 / 12.0, abs=0.15)
