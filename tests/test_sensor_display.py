"""Gain, level and polarity: from band radiance to the grey of the display."""

import numpy as np
import pytest

from sensorsim.errors import InputError, NumericsError
from sensorsim.radiometry import FLIR_BAND, band_radiance, build_band_table
from sensorsim.sensor import (
    DisplaySettings,
    auto_window,
    display_code,
    fix_window,
    grey_level,
    tone_curve,
    window_from_temperatures,
    window_limits,
)

WINDOW = DisplaySettings(level=45.0, span=10.0)
BLACK_HOT = DisplaySettings(polarity="black-hot", level=45.0, span=10.0)


def test_grey_is_linear_in_radiance_with_the_gain_as_slope():
    radiance = np.linspace(40.0, 50.0, 101)
    assert np.diff(grey_level(radiance, WINDOW)) / np.diff(radiance) == pytest.approx(WINDOW.gain, rel=1e-9)
    assert WINDOW.gain == 0.1


def test_level_is_middle_grey_and_the_ends_are_black_and_white():
    assert grey_level([40.0, 45.0, 50.0], WINDOW).tolist() == [0.0, 0.5, 1.0]
    assert display_code([40.0, 45.0, 50.0], WINDOW).tolist() == [0, 128, 255]


def test_radiance_beyond_the_window_saturates():
    assert display_code([0.0, 39.9, 50.1, 1e6], WINDOW).tolist() == [0, 0, 255, 255]


def test_black_hot_is_the_negative_of_white_hot():
    radiance = np.linspace(38.0, 52.0, 999)
    assert grey_level(radiance, BLACK_HOT) == pytest.approx(1.0 - grey_level(radiance, WINDOW), abs=1e-15)
    both = display_code(radiance, BLACK_HOT).astype(int) + display_code(radiance, WINDOW)
    assert set(both.tolist()) <= {255, 256}  # 256 only where both round a half up


def test_every_code_covers_the_same_share_of_the_window():
    radiance = np.linspace(40.0, 50.0, 255 * 100 + 1)[:-1] + 10.0 / (255 * 200)
    counts = np.bincount(display_code(radiance, WINDOW), minlength=256)
    assert set(counts[1:-1].tolist()) == {100}  # the two ends are half as wide
    assert counts[[0, -1]].tolist() == [50, 50]


def test_automatic_window_leaves_the_tails_outside():
    radiance = np.random.default_rng(1).normal(45.0, 3.0, (100, 200))
    level, span = auto_window(radiance, tail=0.05)
    assert np.mean(radiance < level - span / 2.0) == pytest.approx(0.05, abs=1e-3)
    assert np.mean(radiance > level + span / 2.0) == pytest.approx(0.05, abs=1e-3)


@pytest.mark.parametrize("kind", [np.float32, np.float64])
@pytest.mark.parametrize("count", [3, 100, 76800])
def test_automatic_window_is_between_quantiles_as_numpy_has_them(kind, count):
    radiance = np.random.default_rng(count).normal(45.0, 3.0, count).astype(kind)
    low, high = np.quantile(radiance.astype(np.float64), (0.02, 0.98))
    level, span = auto_window(radiance, tail=0.02)
    assert level == pytest.approx((low + high) / 2.0, rel=1e-14)
    assert span == pytest.approx(high - low, rel=1e-12)


def test_automatic_window_follows_gain_and_offset_of_the_scene():
    radiance = np.random.default_rng(2).normal(45.0, 3.0, 1000)
    level, span = auto_window(radiance)
    assert auto_window(2.0 * radiance + 7.0) == pytest.approx((2.0 * level + 7.0, 2.0 * span), rel=1e-12)


@pytest.mark.parametrize("radiance", [0.0, 4e-6, 46.9])
def test_frame_of_one_radiance_is_middle_grey(radiance):
    frame = np.full((6, 8), radiance)
    assert set(display_code(frame, fix_window(DisplaySettings(), frame)).flat) == {128}


def test_automatic_gain_does_not_show_a_millikelvin_as_contrast():
    """An isothermal scene that is off by 1 mK stays within a few of 255 codes."""
    radiance = band_radiance(FLIR_BAND, np.array([290.0, 290.001]))
    codes = display_code(radiance, fix_window(DisplaySettings(tail=0.0), radiance)).astype(int)
    assert abs(codes[1] - codes[0]) <= 5


def test_fixing_the_window_keeps_what_the_operator_has_set():
    radiance = np.linspace(40.0, 50.0, 101)
    level, span = auto_window(radiance)
    assert fix_window(DisplaySettings(level=44.0), radiance) == DisplaySettings(level=44.0, span=span)
    assert fix_window(DisplaySettings(span=3.0), radiance) == DisplaySettings(level=level, span=3.0)
    assert fix_window(BLACK_HOT, radiance) is BLACK_HOT


def test_window_in_kelvin_puts_its_temperatures_at_the_ends():
    table = build_band_table(FLIR_BAND)
    level, span = window_from_temperatures(table, 270.0, 300.0)
    settings = DisplaySettings(level=level, span=span)
    assert table.apparent_temperature(window_limits(settings)) == pytest.approx([270.0, 300.0], abs=1e-9)


def test_window_in_kelvin_must_rise():
    with pytest.raises(InputError, match="give the colder one first"):
        window_from_temperatures(build_band_table(FLIR_BAND), 300.0, 270.0)


@pytest.mark.parametrize("settings", [DisplaySettings(), DisplaySettings(level=1.0), DisplaySettings(span=1.0)])
def test_an_automatic_window_cannot_be_applied(settings):
    assert settings.is_automatic
    with pytest.raises(InputError, match="fix_window"):
        display_code([1.0], settings)


def test_a_span_lost_in_rounding_is_refused():
    with pytest.raises(InputError, match="lost in the rounding"):
        display_code([45.0], DisplaySettings(level=45.0, span=1e-15))


@pytest.mark.parametrize(
    ("entry", "settings"),
    [
        ("polarity", {"polarity": "hot"}),
        ("level", {"level": np.nan}),
        ("level", {"level": np.inf}),
        ("span", {"span": 0.0}),
        ("span", {"span": -1.0}),
        ("span", {"span": np.nan}),
    ],
)
def test_impossible_settings_are_refused(entry, settings):
    with pytest.raises(InputError, match=f"{entry} = "):
        DisplaySettings(**settings)


@pytest.mark.parametrize("radiance", [np.nan, np.inf, -np.inf])
def test_radiance_that_is_not_finite_is_refused(radiance):
    with pytest.raises(NumericsError, match="finite"):
        display_code([45.0, radiance], WINDOW)
    with pytest.raises(NumericsError, match="finite"):
        auto_window([45.0, radiance])


def test_no_window_is_chosen_from_no_pixels():
    with pytest.raises(NumericsError, match="0 pixels"):
        auto_window([])


@pytest.mark.parametrize("tail", [-0.1, 0.5, np.nan])
def test_impossible_tail_is_refused(tail):
    with pytest.raises(InputError, match="tail"):
        auto_window([1.0, 2.0], tail=tail)


def test_gamma_brightens_the_middle_and_leaves_the_ends():
    curve = tone_curve("linear", 2.2, [], 40.0, 50.0)
    assert curve[[0, -1]].tolist() == [0.0, 1.0]
    assert float(grey_level(45.0, WINDOW, curve)) == pytest.approx(0.5 ** (1.0 / 2.2), abs=2e-6)


def test_equalisation_of_evenly_spread_radiance_is_a_straight_line():
    radiance = np.linspace(40.0, 50.0, 400_000)
    assert tone_curve("plateau", 1.0, radiance, 40.0, 50.0) == pytest.approx(np.linspace(0.0, 1.0, 512), abs=0.01)


def test_equalisation_gives_grey_to_where_pixels_are_within_its_limits():
    radiance = np.random.default_rng(4).normal(45.0, 0.3, 100_000)
    curve = tone_curve("plateau", 1.0, radiance, 40.0, 50.0)
    slope = np.diff(curve) * 511
    assert (slope >= 0.0).all()
    assert slope.max() <= 4.0 + 1e-9
    middle = grey_level([44.7, 45.3], WINDOW, curve)
    assert middle[1] - middle[0] > 2.5 * 0.06  # a straight line gives 0.06
    assert curve[0] + curve[-1] == pytest.approx(1.0, abs=1e-9)


def test_equalisation_without_pixels_in_the_window_stays_straight():
    assert tone_curve("plateau", 1.0, [1.0, 2.0], 40.0, 50.0) == pytest.approx(np.linspace(0.0, 1.0, 512), abs=1e-9)


@pytest.mark.parametrize(("entry", "value"), [("tone", "magic"), ("gamma", 0.0), ("gamma", float("nan"))])
def test_display_refuses_unknown_tones_and_gammas(entry, value):
    with pytest.raises(InputError, match=entry):
        DisplaySettings(**{entry: value})
