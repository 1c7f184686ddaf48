"""Detail against its base: what is stretched, what is not."""

import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.sensor import DETAIL_REACH, EDGE, DisplaySettings, enhance_detail

LEVEL, SPAN = 40.0, 8.0
COLUMN = np.arange(200)[None, :] + np.zeros((60, 1))


@pytest.mark.parametrize("gain", [0.0, 0.5, 1.0, 4.0, 20.0])
def test_uniform_picture_and_gain_of_one_change_nothing(gain: float) -> None:
    flat = np.full((20, 30), 43.0)
    assert enhance_detail(flat, LEVEL, SPAN, gain) == pytest.approx(flat, rel=1e-12)
    noisy = np.random.default_rng(1).normal(LEVEL, 1.0, (20, 30))
    assert enhance_detail(noisy, LEVEL, SPAN, 1.0) == pytest.approx(noisy, rel=1e-12)


@pytest.mark.parametrize("gain", [0.0, 3.0])
def test_faint_texture_gets_the_gain(gain: float) -> None:
    """A wave of a whole number of periods in the base's width has no mean there, so that all of it is detail."""
    wave = 0.02 * EDGE * SPAN * np.sin(2.0 * np.pi * COLUMN / (2 * DETAIL_REACH + 1) * 3.0)
    inside = np.s_[10:-10, 10:-10]
    shown = enhance_detail(LEVEL + wave, LEVEL, SPAN, gain) - LEVEL
    assert shown[inside] == pytest.approx(gain * wave[inside], abs=2e-3 * wave.max() * gain + 1e-3 * wave.max())


def test_slow_ramp_is_base() -> None:
    ramp = LEVEL + 0.1 * EDGE * SPAN * COLUMN / 200.0
    shown = enhance_detail(ramp, LEVEL, SPAN, 5.0)
    assert shown[10:-10, 10:-10] == pytest.approx(ramp[10:-10, 10:-10], abs=1e-6 * SPAN)


def test_edge_of_the_whole_window_has_no_seam() -> None:
    """Unsharp masking by plain means of the same extent overshoots by 4/9 (gain - 1) of the step; here a fiftieth."""
    step = LEVEL + SPAN * (COLUMN >= 100) - 0.5 * SPAN
    shown = enhance_detail(step, LEVEL, SPAN, 4.0)
    over = max(float((shown - step.max()).max()), float((step.min() - shown).max()))
    assert over < 4.0 / 9.0 * 3.0 * SPAN / 50.0


def test_single_precision_does_for_a_sky_far_below_the_window() -> None:
    picture = np.random.default_rng(2).normal(LEVEL, 0.3, (60, 80))
    picture[:20] = LEVEL - 20.0 * SPAN
    single = enhance_detail(picture.astype(np.float32), LEVEL, SPAN, 4.0)
    assert single.dtype == np.float32
    assert single[30:] == pytest.approx(enhance_detail(picture, LEVEL, SPAN, 4.0)[30:], abs=1e-4 * SPAN)


@pytest.mark.parametrize(("entry", "value"), [
    ("detail", -0.1), ("detail", float("nan")), ("detail", 21.0), ("tail", 0.5), ("tail", -1e-9),
    ("settle", -1.0), ("settle", float("inf")),
])  # fmt: skip
def test_impossible_display_numbers_are_refused(entry: str, value: float) -> None:
    with pytest.raises(InputError, match=entry):
        DisplaySettings(**{entry: value})  # type: ignore[arg-type]
