"""The air of rooms: an exact first-order node, thermostats, heat gains, and what a radiant temperature would add."""

import numpy as np
import pytest
from wall_cases import constant, outdoors

from sensorsim.errors import InputError
from sensorsim.materials import INTERIORS, Room, load_catalogue, load_construction
from sensorsim.thermal import Inside, build_interior, march_paths, room_air
from sensorsim.thermal.convection import INTERIOR_FREE
from sensorsim.units import kelvin_from_fahrenheit

STEP = 300.0
DAY = 288
ROOM = Room(loss_coefficient=5.0, time_constant=20000.0)
LOW, HIGH = kelvin_from_fahrenheit(65.0), kelvin_from_fahrenheit(75.0)


def _swing(days: int, mean: float = 285.0, amplitude: float = 8.0) -> np.ndarray:
    return mean + amplitude * np.sin(2.0 * np.pi * np.arange(days * DAY + 1) / DAY)


def _air(condition: str, outdoor: np.ndarray, **numbers: float) -> np.ndarray:
    return room_air(condition, outdoor, STEP, room=ROOM, **numbers)


def test_without_gain_the_mean_indoors_is_that_outdoors() -> None:
    outdoor = _swing(10)
    last = slice(9 * DAY, 10 * DAY)
    assert _air("unheated", outdoor)[last].mean() == pytest.approx(outdoor[last].mean(), abs=1e-6)


@pytest.mark.parametrize("gain", [10.0, 60.0, 250.0])
def test_a_gain_lifts_the_air_by_exactly_gain_over_loss(gain: float) -> None:
    outdoor = _swing(3)
    rise = _air("unheated", outdoor, heat_gain=gain) - _air("unheated", outdoor)
    np.testing.assert_allclose(rise, gain / 5.0, rtol=1e-12)


def test_a_daily_swing_arrives_damped_and_late_as_the_first_order_node_has_it() -> None:
    """Expected: amplitude 1 / sqrt(1 + (w tau)^2), lag atan(w tau) / w; 4e-5 by the lines between samples."""
    outdoor, turn = _swing(12), 2.0 * np.pi / 86400.0
    indoors = _air("unheated", outdoor) - 285.0
    time = STEP * np.arange(outdoor.size)
    exact = 8.0 * np.sin(turn * time - np.arctan(turn * 20000.0)) / np.hypot(1.0, turn * 20000.0)
    assert np.abs(indoors - exact)[11 * DAY :].max() < 8.0 * 4e-5


@pytest.mark.parametrize("step", [60.0, 300.0, 3600.0])
def test_a_ramp_outdoors_is_followed_exactly_at_any_step(step: float) -> None:
    """Rationale: inputs are linear between samples. Expected: T = a + b (t - tau) once the start is forgotten."""
    time = step * np.arange(round(40 * 20000.0 / step))
    indoors = room_air("unheated", 270.0 + 1e-4 * time, step, room=ROOM)
    assert indoors[-1] == pytest.approx(270.0 + 1e-4 * (time[-1] - 20000.0), abs=1e-9)


def test_air_starts_in_the_steady_state_of_the_mean() -> None:
    outdoor = _swing(2) + np.linspace(0.0, 5.0, 2 * DAY + 1)
    assert _air("unheated", outdoor, heat_gain=25.0)[0] == pytest.approx(outdoor.mean() + 5.0, rel=1e-12)


def test_a_room_of_no_inertia_is_the_outdoor_air_and_one_of_much_is_its_mean() -> None:
    outdoor = _swing(2)
    quick = room_air("unheated", outdoor, STEP, room=Room(loss_coefficient=5.0, time_constant=1.0))
    slow = room_air("unheated", outdoor, STEP, room=Room(loss_coefficient=5.0, time_constant=1e12))
    assert np.abs(quick - outdoor)[1:].max() < 1e-3
    assert np.abs(slow - outdoor.mean()).max() < 1e-4


def test_thermostats_hold_their_limits_and_leave_the_rest_alone() -> None:
    outdoor = _swing(3, mean=293.0, amplitude=15.0)
    free, heated, cooled = (_air(condition, outdoor) for condition in ("unheated", "heated", "cooled"))
    assert heated.min() == LOW
    assert (cooled.min(), cooled.max()) == (LOW, HIGH)
    np.testing.assert_array_equal(heated[free > LOW], free[free > LOW])
    between = (free > LOW) & (free < HIGH)
    assert between.any()
    np.testing.assert_array_equal(cooled[between], free[between])


def test_a_gain_warms_a_heated_room_only_once_it_carries_the_room_above_the_thermostat() -> None:
    outdoor = constant(275.0, 50)
    assert np.all(_air("heated", outdoor, heat_gain=10.0) == LOW)
    np.testing.assert_allclose(_air("heated", outdoor, heat_gain=150.0), 305.0, rtol=1e-12)
    assert np.all(_air("cooled", outdoor, heat_gain=150.0) == HIGH)


@pytest.mark.parametrize("condition", INTERIORS)
def test_inside_faces_see_the_room_at_its_air_temperature(condition: str) -> None:
    inside = build_interior(condition, _swing(1), constant(3.0, DAY + 1), STEP, 0.9)
    np.testing.assert_array_equal(inside.air, inside.radiant)
    assert inside.emissivity == 0.9
    assert inside.film.shape == inside.air.shape


def test_open_sees_the_outdoor_air_and_none_the_mean_of_the_weather() -> None:
    outdoor = _swing(1)
    wind = constant(4.0, DAY + 1)
    np.testing.assert_array_equal(build_interior("open", outdoor, wind, STEP, 0.9).air, outdoor)
    np.testing.assert_allclose(build_interior("none", outdoor, wind, STEP, 0.9).air, outdoor.mean(), rtol=1e-14)


def test_an_industrial_hall_shows_its_gain_on_the_outside() -> None:
    """A hall of sheet metal with 250 W per m2 of floor is 20 K warmer inside; its roof shows a third of that."""
    catalogue = load_catalogue()
    room, outdoor = catalogue.construction_class("metal").room, constant(270.0, 200)
    faces = []
    for gain in (0.0, 250.0):
        wall = catalogue.wall_type(60, "unheated", room=room, heat_gain=gain)
        inside = build_interior("unheated", outdoor, constant(3.0, 200), STEP, 0.7, room=wall.room, heat_gain=gain)
        history = march_paths(
            wall, outdoors(outdoor, 12.0, sky=255.0, emissivity=0.7), inside, np.ones(1), step=STEP,
            record=np.array([199]),
        )  # fmt: skip
        faces.append(float(history.exterior[0, 0, 0]))
    assert room.loss_coefficient == 12.5
    assert 5.0 < faces[1] - faces[0] < 9.0


@pytest.mark.parametrize(
    ("name", "error"), [("insulated_wood", 0.05), ("brick", 0.25), ("uninsulated_wood", 0.16), ("steel_sheet", 0.55)]
)
def test_radiant_temperature_3_kelvin_below_the_air_costs_the_outer_face_what_is_stated(
    name: str, error: float
) -> None:
    faces = []
    for radiant in (293.15, 290.15):
        inside = Inside(constant(293.15, 300), constant(radiant, 300), constant(0.5, 300), INTERIOR_FREE**3, 0.9)
        outside = outdoors(constant(263.0, 300), 15.0, sky=250.0, emissivity=0.9)
        history = march_paths(load_construction(name), outside, inside, np.ones(1), step=3600.0, record=np.array([299]))
        faces.append(float(history.exterior[0, 0, 0]))
    assert 0.7 * error < faces[0] - faces[1] < error


def test_unknown_condition_is_told_with_those_known() -> None:
    with pytest.raises(InputError, match=r"interior = 'tepid': unknown condition; use one of heated, cooled, unheated"):
        build_interior("tepid", _swing(1), constant(0.0, DAY + 1), STEP, 0.9)
