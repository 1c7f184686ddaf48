"""Levels of detail by projected error: what is chosen, that nothing flickers, and how large a change is."""

import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.render import Camera
from sensorsim.render.detail import RESOLUTIONS, DetailRule, box_distance, choose_detail, pixel_angle
from sensorsim.units import metres_from_feet

ANGLE = 0.5e-3  # [rad]
RULE = DetailRule(pixels=4.0)


def test_levels_are_the_reports() -> None:
    assert tuple(metres_from_feet(feet) for feet in (500.0, 200.0, 50.0)) == RESOLUTIONS


@pytest.mark.parametrize("pixels", [0.5, 1.0, 8.0])
def test_coarsest_level_whose_error_is_small_enough(pixels: float) -> None:
    """Expected: borders where resolution = pixels x angle x distance."""
    borders = [resolution / (pixels * ANGLE) for resolution in RESOLUTIONS]
    rule = DetailRule(pixels=pixels)
    for level, border in enumerate(borders[:2]):
        near, far = choose_detail(np.array([0.999, 1.001]) * border, ANGLE, rule)
        assert (near, far) == (level + 1, level)
    assert choose_detail(np.array([0.0, 1e9]), ANGLE, rule).tolist() == [2, 0]


def test_detail_falls_with_distance_and_rises_with_zoom() -> None:
    distance = np.linspace(0.0, 3e5, 5000)
    levels = choose_detail(distance, ANGLE, RULE)
    assert np.all(np.diff(levels) <= 0)
    assert set(levels) == {0, 1, 2}
    assert np.all(choose_detail(distance, 0.5 * ANGLE, RULE) >= levels)


def _flight(distances: np.ndarray, rule: DetailRule) -> np.ndarray:
    present, shown = choose_detail(distances[:1], ANGLE, rule), []
    for distance in distances:
        present = choose_detail(np.array([distance]), ANGLE, rule, present)
        shown.append(int(present[0]))
    return np.array(shown)


@pytest.mark.parametrize("speed", [30.0, 250.0, 700.0])
def test_passing_by_changes_each_level_once_each_way(speed: float) -> None:
    """Out of the far distance, past at 500 m and away again, 30 frames a second, shaken by 20 m at random."""
    along = np.arange(-2.0e5, 2.0e5, speed / 30.0 * 20.0)
    shaken = np.hypot(along, 500.0) + np.random.default_rng(2).uniform(-20.0, 20.0, along.size)
    levels = _flight(shaken, RULE)
    assert np.count_nonzero(np.diff(levels)) == 4
    assert (levels[0], levels.max(), levels[-1]) == (0, 2, 0)


def test_hovering_at_a_border_does_not_flicker_and_without_a_band_would() -> None:
    border = RESOLUTIONS[0] / (RULE.pixels * ANGLE)
    shaken = border * (1.0 + 0.05 * np.random.default_rng(3).uniform(-1.0, 1.0, 500))
    assert np.count_nonzero(np.diff(_flight(shaken, RULE))) <= 1
    assert np.count_nonzero(np.diff(_flight(shaken, DetailRule(pixels=4.0, band=0.0)))) > 100


def test_what_changes_is_smaller_than_the_pixels_allowed() -> None:
    distances = np.concatenate([np.geomspace(1e2, 3e5, 4000), np.geomspace(3e5, 1e2, 4000)])
    levels = _flight(distances, RULE)
    for at in np.flatnonzero(np.diff(levels)):
        coarser = min(levels[at], levels[at + 1])
        pixels = RESOLUTIONS[coarser] / (ANGLE * distances[at + 1])
        assert pixels <= RULE.pixels * 1.01
        assert pixels >= RULE.pixels * (1.0 - RULE.band) * 0.99


def test_what_is_shown_is_never_too_coarse_whatever_was_shown_before() -> None:
    distance = np.random.default_rng(4).uniform(0.0, 3e5, 3000)
    present = np.random.default_rng(5).integers(0, 3, 3000)
    shown = choose_detail(distance, ANGLE, RULE, present)
    fine = choose_detail(distance, ANGLE, RULE)
    assert np.all(shown >= fine)
    assert np.all(choose_detail(distance, ANGLE, RULE, shown) == shown)  # it stays


def test_distance_to_a_box_is_that_to_its_nearest_point() -> None:
    lowest, highest = np.array([[0.0, 0.0, 0.0]]), np.array([[10.0, 20.0, 5.0]])
    for place, expected in (((5.0, 5.0, 2.0), 0.0), ((-3.0, 5.0, 9.0), 5.0), ((13.0, 24.0, 17.0), 13.0)):
        assert box_distance(np.array(place), lowest, highest)[0] == pytest.approx(expected)


def test_angle_of_a_pixel_follows_field_and_size() -> None:
    camera = Camera(position=np.zeros(3), yaw=0.0, pitch=0.0, horizontal_field_of_view=20.0)
    assert pixel_angle(camera, (640, 480)) == pytest.approx(2.0 * np.tan(np.radians(10.0)) / 640, rel=1e-12)


@pytest.mark.parametrize(
    "changes",
    [{"pixels": 0.0}, {"pixels": np.nan}, {"pixels": np.inf}, {"band": 1.0}, {"band": -0.1},
     {"resolutions": ()}, {"resolutions": (10.0, 20.0)}, {"resolutions": (10.0, np.nan)}],
)  # fmt: skip
def test_rules_that_cannot_be_are_refused(changes: dict[str, object]) -> None:
    with pytest.raises(InputError, match="level of detail"):
        DetailRule(**changes)  # type: ignore[arg-type]
