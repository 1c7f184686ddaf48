"""A whole frame of a modelled sensor, and the display pass against its twin, by a line and by curves."""

from dataclasses import replace

import numpy as np
import pytest
from small_world import town

from sensorsim.errors import InputError
from sensorsim.render import Renderer, look_at
from sensorsim.render.picture import exposed
from sensorsim.sensor import DisplaySettings, Noise, display_code, load_sensor, sensitivity, tone_curve, window_limits

SIZE = (64, 48)
NOON = 12.0 * 3600.0
CAMERA = look_at([-60.0, -80.0, 40.0], [20.0, 20.0, 5.0], 40.0)


@pytest.fixture(scope="module")
def uncooled():
    with Renderer(town(), load_sensor("uncooled"), size=SIZE, samples=3) as renderer:
        yield renderer


@pytest.mark.parametrize("polarity", ["white-hot", "black-hot"])
@pytest.mark.parametrize("tone", ["linear", "plateau"])
@pytest.mark.parametrize("gamma", [1.0, 2.2])
def test_display_is_its_twin(uncooled, tone, gamma, polarity):
    wanted = DisplaySettings(tone=tone, gamma=gamma, polarity=polarity)
    picture = uncooled.render(CAMERA, NOON, display=wanted)
    low, high = window_limits(picture.display)
    curve = None
    if not wanted.is_straight:
        curve = tone_curve(tone, gamma, exposed(picture.planes), low, high)
    twin = display_code(picture.planes["signal"], picture.display, curve)
    assert np.abs(picture.planes["display"].astype(int) - twin).max() <= 1
    assert np.mean(picture.planes["display"] != twin) < 0.01


def test_signal_is_the_radiance_blurred_and_noisy_within_reason(uncooled):
    picture = uncooled.render(CAMERA, NOON)
    signal, radiance = picture.planes["signal"], picture.planes["radiance"]
    assert signal.shape == radiance.shape == (SIZE[1], SIZE[0])
    assert float(signal.mean()) == pytest.approx(float(radiance.mean()), rel=0.01)
    counts = signal / sensitivity(uncooled.sensor).step
    assert counts == pytest.approx(np.round(counts), abs=5e-3)


def test_frames_repeat_and_differ_by_number(uncooled):
    first, again, other = (uncooled.render(CAMERA, NOON, frame=frame).planes["signal"] for frame in (5, 5, 8))
    assert np.array_equal(first, again)
    assert not np.array_equal(first, other)


def test_display_of_a_modelled_sensor_shows_its_signal():
    quiet = replace(load_sensor("uncooled"), noise=Noise())
    with Renderer(town(), quiet, size=SIZE) as renderer:
        picture = renderer.render(CAMERA, NOON)
    assert np.array_equal(picture.planes["display"], display_code(picture.planes["signal"], picture.display))


@pytest.mark.parametrize("samples", [0, 2, 9])
def test_renderer_refuses_even_and_huge_numbers_of_samples(samples):
    with pytest.raises(InputError, match="samples"):
        Renderer(town(), load_sensor("uncooled"), size=SIZE, samples=samples)


def test_renderer_refuses_samples_that_an_ideal_sensor_does_not_join():
    with pytest.raises(InputError, match="no detector to join"):
        Renderer(town(), load_sensor("flir"), size=SIZE, samples=3)
