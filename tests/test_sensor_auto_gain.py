"""Gain and tone that follow a sequence with a time constant, and do not depend on where it was begun."""

import numpy as np
import pytest

from sensorsim.sensor import MEMORY, AutoGain, DisplaySettings, fix_window, tone_curve, window_limits
from sensorsim.sensor.settling import Settling

PERIOD = 1.0 / 30.0
SLOW = DisplaySettings(settle=0.5)


def scenes(count: int) -> list[np.ndarray]:
    rng = np.random.default_rng(4)
    return [rng.uniform(30.0 + rng.uniform(0.0, 4.0), 50.0, 2000) for _ in range(count)]


def windows(settings: DisplaySettings, seen: list[np.ndarray], first: int = 0) -> list[tuple[float, float]]:
    gain = AutoGain(PERIOD)
    found = []
    for frame in range(first, len(seen)):
        gain.begin(frame, 100.0 + PERIOD * frame)
        found.append(window_limits(gain.window(settings, seen[frame])))
    return found


def test_step_is_followed_by_its_time_constant() -> None:
    """1 - exp(-t / tau), but for the share exp(-MEMORY) that is forgotten, and for the frame that t is counted from."""
    follower = Settling(1e-3)
    for frame in range(4001):
        found = float(follower.settle(frame, frame * 1e-3, np.array([float(frame >= 2000)]), 0.25)[0])
        if frame >= 2000:
            assert found == pytest.approx(1.0 - np.exp(-(frame - 1999) * 1e-3 / 0.25), abs=1.1 * np.exp(-MEMORY))


def test_what_stays_is_what_it_is() -> None:
    follower = Settling(PERIOD)
    for frame in range(40):
        found = follower.settle(frame, 7.0, np.array([3.25, -8.5]), 0.3)
        assert found == pytest.approx([3.25, -8.5], rel=1e-13)


def test_window_of_a_frame_is_the_same_wherever_the_sequence_began() -> None:
    seen = scenes(90)
    whole, late = windows(SLOW, seen), windows(SLOW, seen, first=10)
    assert whole[80:] == late[70:]
    assert whole[75] != windows(SLOW, seen, first=75)[0]


def test_window_flickers_less_by_the_frames_that_it_goes_by() -> None:
    """The variance of a mean over 2 tau / dt frames: a thirtieth for half a second, and more for the memory's end."""
    seen = scenes(200)
    quick, slow = (np.array(windows(settings, seen))[70:, 0] for settings in (DisplaySettings(), SLOW))
    assert quick.std() > 0.5
    assert slow.std() < quick.std() / 3.5
    assert slow.mean() == pytest.approx(quick.mean(), abs=4.0 * quick.std() / np.sqrt(100.0))


def test_first_frame_a_cut_and_a_gain_without_time_constant_are_the_frame_alone() -> None:
    seen = scenes(6)
    alone = [window_limits(fix_window(DisplaySettings(), radiance)) for radiance in seen]
    assert windows(DisplaySettings(), seen) == alone
    gain = AutoGain(PERIOD)
    for frame in (0, 2, 4):
        gain.begin(frame, 100.0)
        assert window_limits(gain.window(SLOW, seen[frame])) == pytest.approx(alone[frame], rel=1e-12)


def test_clock_that_runs_or_jumps_settles_at_once() -> None:
    seen = scenes(4)
    gain = AutoGain(PERIOD)
    for frame, time in enumerate((0.0, 900.0, 1800.0, 36000.0)):
        gain.begin(frame, time)
        alone = window_limits(fix_window(SLOW, seen[frame]))
        assert window_limits(gain.window(SLOW, seen[frame])) == pytest.approx(alone, rel=1e-12)


def test_frame_that_is_drawn_again_is_the_same_again() -> None:
    seen = scenes(3)
    gain = AutoGain(PERIOD)
    found = []
    for frame in (0, 1, 2, 2, 2):
        gain.begin(frame, 5.0)
        found.append(window_limits(gain.window(SLOW, seen[frame])))
    assert found[2] == found[3] == found[4]


def test_what_the_operator_has_set_stays() -> None:
    gain = AutoGain(PERIOD)
    for frame, radiance in enumerate(scenes(5)):
        gain.begin(frame, 5.0)
        assert gain.window(DisplaySettings(level=41.0, settle=1.0), radiance).level == 41.0
        assert gain.window(DisplaySettings(span=9.0, settle=1.0), radiance).span == 9.0
        fixed = DisplaySettings(level=41.0, span=9.0, settle=1.0)
        assert gain.window(fixed, radiance) == fixed


def test_tone_curve_settles_and_stays_a_curve() -> None:
    settings = DisplaySettings(level=40.0, span=20.0, tone="plateau", settle=0.5)
    gain = AutoGain(PERIOD)
    seen = scenes(2)
    alone = [tone_curve("plateau", 1.0, radiance, 30.0, 50.0) for radiance in seen]
    for frame, radiance in enumerate(seen):
        gain.begin(frame, 5.0)
        curve = gain.curve(settings, radiance)
        assert curve is not None
        assert np.all(np.diff(curve) >= 0.0)
    kept = np.exp(-PERIOD / 0.5)
    assert curve == pytest.approx((alone[1] + kept * alone[0]) / (1.0 + kept), rel=1e-12)
    assert gain.curve(DisplaySettings(level=40.0, span=20.0), seen[0]) is None


@pytest.mark.parametrize("tail", [0.0, 0.02, 0.2])
def test_tails_of_the_display_saturate(tail: float) -> None:
    radiance = np.random.default_rng(8).uniform(0.0, 1.0, 20001)
    low, high = window_limits(fix_window(DisplaySettings(tail=tail), radiance))
    assert np.mean(radiance < low) == pytest.approx(tail, abs=1e-4)
    assert np.mean(radiance > high) == pytest.approx(tail, abs=1e-4)
