"""The host's sensor knobs: polarity, gain, level, noise, coupling and dropped lines do what their names say."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from sensorsim.errors import InputError, NumericsError
from sensorsim.trainer.host_state import SensorState
from sensorsim.trainer.sensor_knobs import DROPPED, NOISIEST, Knobs, ac_coupled, display_settings, sensor_picture

KNOBS = Knobs(darkest=40.0, brightest=90.0)
MANUAL = SensorState(view=0, sensor=1, auto_gain=False, gain=0.0, level=0.5)


def ramp(height: int = 60, width: int = 80) -> NDArray[np.float64]:
    return np.linspace(40.0, 90.0, height * width).reshape(height, width)


@pytest.mark.parametrize(
    "control",
    [
        MANUAL,
        replace(MANUAL, gain=0.7, level=0.2),
        replace(MANUAL, auto_gain=True),
        replace(MANUAL, noise=0.5, line_dropout=True, ac_coupling=20.0),
    ],
    ids=["manual", "high gain, dark", "automatic", "noise, dropout, coupling"],
)
def test_black_hot_is_the_exact_mirror_of_white_hot(control: SensorState) -> None:
    white = sensor_picture(ramp(), control, KNOBS, 7)
    black = sensor_picture(ramp(), replace(control, black_hot=True), KNOBS, 7)
    assert white.min() < white.max()
    assert np.array_equal(black, 255 - white)


def test_polarity_is_in_the_window_too() -> None:
    assert display_settings(MANUAL, KNOBS).polarity == "white-hot"
    assert display_settings(replace(MANUAL, black_hot=True), KNOBS).polarity == "black-hot"
    assert display_settings(replace(MANUAL, auto_gain=True), KNOBS).is_automatic


def test_gain_0_shows_the_whole_range_and_gain_1_a_hundredth() -> None:
    whole = sensor_picture(ramp(), MANUAL, KNOBS, 0)
    assert (whole.min(), whole.max(), len(np.unique(whole))) == (0, 255, 256)
    assert display_settings(replace(MANUAL, gain=1.0), KNOBS).span == pytest.approx(0.5)
    assert display_settings(replace(MANUAL, gain=0.5), KNOBS).span == pytest.approx(5.0)


def test_more_gain_is_more_contrast_about_the_same_middle() -> None:
    scene = ramp() * 0.02 + 64.0  # 64.8 to 65.8
    spread = [float(sensor_picture(scene, replace(MANUAL, gain=gain), KNOBS, 0).std()) for gain in (0.0, 0.3, 0.6, 0.9)]
    assert spread == sorted(spread)
    assert spread[-1] > 20.0 * spread[0]


def test_more_level_is_a_brighter_picture_from_black_to_white() -> None:
    scene = np.full((4, 4), 65.0)
    codes = [
        int(sensor_picture(scene, replace(MANUAL, gain=0.5, level=level), KNOBS, 0)[0, 0])
        for level in (0, 0.48, 0.5, 0.52, 1)
    ]
    assert codes[0] == 0
    assert codes[-1] == 255
    assert codes == sorted(codes)
    assert codes[2] == 128


def test_a_sensor_that_is_off_is_black_in_both_polarities() -> None:
    for black_hot in (False, True):
        assert not sensor_picture(ramp(), replace(MANUAL, on=False, black_hot=black_hot), KNOBS, 0).any()


def test_noise_has_the_share_of_the_window_that_it_is_set_to_and_repeats_by_frame() -> None:
    scene = np.full((200, 200), 65.0)
    noisy = replace(MANUAL, noise=0.2)
    first, again, next_frame = (sensor_picture(scene, noisy, KNOBS, frame) for frame in (1, 1, 2))
    assert float(first.std()) / 255.0 == pytest.approx(0.2 * NOISIEST, rel=0.02)  # 40,000 pixels: 0.35 % standard error
    assert np.array_equal(first, again)
    assert not np.array_equal(first, next_frame)


def test_dropped_lines_are_whole_lines_and_as_many_as_said() -> None:
    scene = np.full((4000, 8), 65.0)
    codes = sensor_picture(scene, replace(MANUAL, line_dropout=True), KNOBS, 3)
    lost = (codes == 0).all(axis=1)
    assert np.array_equal(lost, (codes == 0).any(axis=1))
    assert lost.mean() == pytest.approx(DROPPED, abs=3.0 * np.sqrt(DROPPED / 4000))


def test_coupling_makes_a_step_decay_with_its_constant() -> None:
    """A long line of mean zero and step 1: after one decay constant 1 / e of it is left."""
    width, decay = 1000, 10e-6
    signal = np.zeros((1, width))
    signal[0, 400:] = 1.0
    after = ac_coupled(signal - signal.mean(), decay, 50e-6)
    steps = round(decay / (50e-6 / width))
    before_step = float(after[0, 399])
    at, later = float(after[0, 400]) - before_step, float(after[0, 400 + steps])
    assert at == pytest.approx(1.0, abs=2.0 / steps)
    slow_before = float((signal - signal.mean())[0, 399]) - before_step
    expected = (0.4 - slow_before) * np.exp(-1.0)  # the step is to 0.4 above the mean
    assert later == pytest.approx(expected, rel=2.0 / steps)


def test_no_coupling_and_a_flat_scene_change_nothing() -> None:
    assert np.array_equal(ac_coupled(ramp(), 0.0, 50e-6), ramp())
    flat = np.full((5, 7), 65.0)
    assert ac_coupled(flat, 3e-6, 50e-6) == pytest.approx(flat, abs=1e-12)


@pytest.mark.parametrize("radiance", [np.zeros((0, 4)), np.zeros(4), np.full((2, 2), np.nan), np.full((2, 2), np.inf)])
def test_what_is_no_picture_is_refused(radiance: NDArray[np.float64]) -> None:
    with pytest.raises(NumericsError, match="picture"):
        sensor_picture(radiance, MANUAL, KNOBS, 0)


@pytest.mark.parametrize("values", [{"darkest": 90.0}, {"brightest": np.nan}, {"line_time": 0.0}])
def test_knobs_without_a_range_are_refused(values: dict[str, float]) -> None:
    with pytest.raises(InputError):
        Knobs(**({"darkest": 40.0, "brightest": 90.0} | values))
