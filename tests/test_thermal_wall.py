"""One wall under a boundary series: closed forms, other ways to the same answer, starts, and what must not break it."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from wall_cases import FloatArray, constant, exact_case, gap, indoors, outdoors, reference_walls, slab

from sensorsim.errors import InputError, NumericsError
from sensorsim.materials import Layer
from sensorsim.thermal import (
    WallBoundary,
    WallHistory,
    build_wall_boundary,
    exterior_loads,
    march,
    march_wall,
)

STEEL = slab(0.0015, 38.0, 7824.0, 500.0)
BRICK = slab(0.1, 0.9, 1900.0, 790.0)
CONCRETE = slab(1.0, 1.7, 2300.0, 900.0)
HOUR, DAY = 3600.0, 86400.0
SURFACE = {"absorptance": 0.7, "emissivity": 0.9, "interior_emissivity": 0.9, "sky_view": 0.5}
NO_RADIATION = {"emissivity": 0.0, "interior_emissivity": 0.0}


def weather(time: FloatArray, **changes: FloatArray | float) -> WallBoundary:
    """Days of a clear spring, alike."""
    hour = time / HOUR
    series: dict[str, FloatArray | float] = {
        "air_temperature": 283.0 + 8.0 * np.sin((hour - 9.0) / 12.0 * np.pi),
        "sky_temperature": 260.0,
        "ground_temperature": 283.0,
        "beam": np.maximum(600.0 * np.sin((hour - 6.0) / 12.0 * np.pi), 0.0),
        "exterior_film": 15.0,
        "interior_air_temperature": 293.0,
        "interior_film": 3.0,
    }
    return build_wall_boundary(time, **{**series, **changes})


def hours(count: int) -> FloatArray:
    return HOUR * np.arange(count)


def go(layers: tuple[Layer, ...], boundary: WallBoundary, **changes: Any) -> WallHistory:
    return march_wall(layers, boundary, **{**SURFACE, **changes})


# --- closed forms ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("parameters", "value"), [(row[0], row[2]) for row in exact_case("steady_nonlinear")])
def test_steady_start_is_the_exact_steady_state_and_stays(parameters: str, value: float) -> None:
    """Exact values hold 9 to 12 digits and a Stefan-Boltzmann constant of their own: 1e-6 K."""
    boundary = build_wall_boundary(
        hours(5), air_temperature=263.15, sky_temperature=230.0, beam=300.0, exterior_film=20.0,
        interior_air_temperature=293.15, interior_film=8.29,
    )  # fmt: skip
    history = go(
        reference_walls()[parameters.split()[0]], boundary, absorptance=1.0, interior_emissivity=0.0, sky_view=1.0,
        start="steady",
    )  # fmt: skip
    assert history.exterior == pytest.approx(np.full(5, value), abs=1e-6)


def test_wall_without_capacity_follows_ohms_law() -> None:
    boundary = weather(hours(25))
    history = go((gap(0.2), gap(0.3)), boundary, **NO_RADIATION)
    series = 1.0 / 15.0 + 0.5 + 1.0 / 3.0
    sun = boundary.air_temperature + 0.7 * boundary.beam / 15.0
    assert history.exterior == pytest.approx(sun + (293.0 - sun) / 15.0 / series, abs=1e-6)
    assert history.interior == pytest.approx(293.0 + (sun - 293.0) / 3.0 / series, abs=1e-6)
    assert history.start.time_constant == 0.0


def test_time_constant_of_a_thin_sheet_is_capacity_over_films() -> None:
    history = go((STEEL,), weather(hours(3)), **NO_RADIATION)
    assert history.start.time_constant == pytest.approx(0.0015 * 7824.0 * 500.0 / 18.0, rel=1e-3)


def test_time_constant_of_a_slab_held_on_both_faces_is_that_of_its_first_sine() -> None:
    history = go((BRICK,), weather(hours(3), exterior_film=1e5, interior_film=1e5))
    assert history.start.time_constant == pytest.approx(0.1**2 * 1900.0 * 790.0 / 0.9 / np.pi**2, rel=0.01)


# --- other ways to the same answer -------------------------------------------------------------------------------


def test_equal_samples_give_what_the_march_of_many_columns_gives() -> None:
    """Rationale: same cells, same steps, inputs linear between the same samples."""
    time = 60.0 * np.arange(361)
    boundary = weather(time + 6.0 * HOUR, exterior_film=15.0 + 10.0 * np.sin(time / 2000.0))
    history = go((BRICK,), boundary, sky_view=1.0, start="linear", keep_nodes=True)
    assert history.nodes is not None
    outside = outdoors(
        boundary.air_temperature, boundary.exterior_film, sun=boundary.beam, sky=boundary.sky_temperature,
        emissivity=0.9,
    )  # fmt: skip
    other = march(
        (BRICK,), outside, indoors(boundary.interior_air_temperature, 3.0, emissivity=0.9), np.array([0.7]),
        step=60.0, record=np.arange(1, 361), grid=history.grid, start=history.nodes[0],
    )  # fmt: skip
    assert np.max(np.abs(history.exterior[1:] - other.exterior[:, 0, 0])) < 1e-6
    assert np.max(np.abs(history.interior[1:] - other.interior[:, 0, 0])) < 1e-6


@pytest.mark.parametrize("wall", [(BRICK,), (STEEL,)], ids=["brick", "steel"])
def test_more_samples_of_the_same_lines_change_nothing(wall: tuple[Layer, ...]) -> None:
    """Rationale: inputs are linear between samples, so samples on those lines tell nothing new.

    Expected: within the error of steps of 60 s, also where samples jump between 1 s and an hour and do not divide it.
    """
    coarse = weather(hours(49))
    jumps = np.concatenate([np.arange(1.0, 60.0), HOUR * 20.0 + np.arange(-30.0, 30.0), 777.7 * np.arange(100, 150)])
    time = np.union1d(coarse.time, jumps)
    names = [name for name in WallBoundary.__slots__ if name != "time"]
    fine = WallBoundary(time=time, **{name: np.interp(time, coarse.time, getattr(coarse, name)) for name in names})
    plain = go(wall, coarse, start="steady")
    refined = go(wall, fine, start="steady")
    assert np.max(np.abs(refined.exterior[np.isin(time, coarse.time)] - plain.exterior)) < 2e-3


def test_hourly_samples_at_the_default_step_match_steps_of_fifteen_seconds() -> None:
    for wall in ((STEEL,), (BRICK,), reference_walls()["wood_insulated"]):
        boundary = weather(hours(30))
        rough, fine = go(wall, boundary, start="steady"), go(wall, boundary, start="steady", step=15.0)
        assert np.max(np.abs(rough.exterior - fine.exterior)) < 5e-3


def test_layer_of_no_thickness_adds_nothing() -> None:
    with_skin = go((slab(0.0, 1.0, 1000.0, 1000.0), BRICK), weather(hours(25)))
    assert np.array_equal(with_skin.exterior, go((BRICK,), weather(hours(25))).exterior)


def test_samples_far_from_zero_are_as_good_as_near() -> None:
    boundary = weather(hours(30))
    later = replace(boundary, time=boundary.time + 2.0**31)
    assert np.array_equal(go((BRICK,), later).exterior, go((BRICK,), boundary).exterior)


def test_loads_balance_what_conduction_takes_in() -> None:
    """The face holds no heat: its loads are the flux into the wall, whose integral over steps of 10 s is the heat."""
    time = 10.0 * np.arange(4321)
    boundary = weather(time)
    history = go((BRICK,), boundary, start="steady")
    total = exterior_loads(history, boundary).total
    entered = history.heat[-1, 0] - history.heat[0, 0]
    assert np.trapezoid(total, time) == pytest.approx(entered, rel=1e-4)
    assert abs(history.energy_residual) < 1e-12


# --- start -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "wall",
    [(STEEL,), (BRICK,), (CONCRETE,), (slab(4.0, 1.7, 2300.0, 900.0),)],
    ids=["steel", "brick", "1 m", "4 m of concrete"],
)
def test_periodic_start_is_the_same_a_day_later(wall: tuple[Layer, ...]) -> None:
    """The day closes on itself; a few repetitions do, where the slowest mode of 4 m alone takes weeks."""
    hour = np.arange(25.0)
    time = np.union1d(HOUR * hour, DAY - 60.0 * np.arange(60.0))  # the last hour leads back: here it already has
    sun = 500.0 * np.maximum(np.sin((time / HOUR - 6.0) / 12.0 * np.pi), 0.0)
    boundary = weather(time, air_temperature=283.0, beam=np.where(time < 20.0 * HOUR, sun, 0.0))
    history = go(wall, boundary, keep_nodes=True)
    assert history.nodes is not None
    assert history.start.kind == "periodic"
    assert history.start.settled
    assert history.start.days <= 4
    assert np.max(np.abs(history.nodes[-1] - history.nodes[0])) < 1.1e-3


def test_repeating_many_days_from_steady_comes_to_the_periodic_start() -> None:
    boundary = weather(hours(24))  # a day without its 24th hour is a day
    start = go((BRICK,), boundary).exterior[0]
    assert go((BRICK,), boundary, start="steady", lead_in=6).exterior[0] == pytest.approx(start, abs=2e-3)


def test_series_shorter_than_a_day_starts_steady_and_one_without_exchange_linear() -> None:
    assert go((BRICK,), weather(hours(12))).start.kind == "steady"
    apart = go((BRICK,), weather(hours(30), exterior_film=0.0, interior_film=0.0, beam=0.0), **NO_RADIATION)
    assert apart.start.kind == "linear"
    assert apart.start.time_constant == np.inf


def test_faces_of_a_linear_start_are_in_balance_at_once() -> None:
    boundary = weather(HOUR * 10.0 + np.array([0.0, 1e-3]))
    history = go((gap(0.1), BRICK), boundary, start="linear")
    assert history.exterior[0] == pytest.approx(history.exterior[1], abs=0.01)
    assert history.exterior[0] > boundary.air_temperature[0] + 1.0  # the sun is on it


# --- hard cases --------------------------------------------------------------------------------------------------

ALTERNATING = np.where(np.arange(49) % 2 == 0, 0.0, 1e6)
HARD: dict[str, tuple[tuple[Layer, ...], dict[str, Any], dict[str, Any]]] = {
    "all resistance": ((gap(0.2), gap(0.3)), {}, {}),
    "skin between resistances": ((gap(0.2), STEEL, gap(0.3)), {}, {}),
    "copper on batting": ((slab(0.0007, 390.0, 8900.0, 390.0), slab(0.09, 0.04, 20.0, 1000.0)), {}, {}),
    "steel at one-hour steps": ((STEEL,), {}, {"step": HOUR}),
    "one metre of concrete": ((CONCRETE,), {}, {}),
    "perfect insulation": ((gap(1e9), BRICK), {}, {}),
    "no exchange at all": ((BRICK,), {"exterior_film": 0.0, "interior_film": 0.0, "beam": 0.0}, NO_RADIATION),
    "film between 0 and 1e6": ((STEEL,), {"exterior_film": ALTERNATING, "interior_film": 0.0}, {}),
    "both films 0 every other hour, no radiation": (
        (BRICK,),
        {"exterior_film": ALTERNATING, "interior_film": ALTERNATING},
        NO_RADIATION,
    ),
    "air that jumps": ((STEEL,), {"air_temperature": 283.0 + 30.0 * (ALTERNATING > 0.0)}, {}),
    "sun that jumps": ((BRICK, gap(0.1), STEEL), {"beam": 900.0 * (ALTERNATING > 0.0)}, {}),
}


@pytest.mark.parametrize(("wall", "inputs", "options"), HARD.values(), ids=HARD.keys())
def test_hard_case_stays_finite_and_keeps_its_heat(
    wall: tuple[Layer, ...], inputs: dict[str, Any], options: dict[str, Any]
) -> None:
    """The residual is of 1 K of the wall or of all heat that passed; conductances of 5e4 W m-2 K-1 cost digits."""
    history = go(wall, weather(hours(49), **inputs), **options)
    assert np.all(np.isfinite([history.exterior, history.interior]))
    assert abs(history.energy_residual) < 1e-9


@pytest.mark.parametrize("step", [1.0, 60.0, HOUR])
@pytest.mark.parametrize("wall", [(STEEL,), (BRICK,)], ids=["steel", "brick"])
def test_without_sun_temperatures_stay_between_those_met(wall: tuple[Layer, ...], step: float) -> None:
    time = np.concatenate([np.arange(60.0), 60.0 + HOUR * np.arange(6), 60.0 + HOUR * 5.0 + np.arange(1.0, 60.0)])
    boundary = weather(time, beam=0.0, air_temperature=283.0 + 20.0 * np.sign(np.cos(time)))
    history = go(wall, boundary, step=step, start="linear", keep_nodes=True)
    assert history.nodes is not None
    assert history.nodes.min() >= 260.0 - 1e-9
    assert history.nodes.max() <= 303.0 + 1e-9


def test_radiation_to_a_sky_of_absolute_zero_cools_and_never_passes_it() -> None:
    boundary = weather(hours(49), beam=0.0, sky_temperature=0.0, exterior_film=0.0, interior_film=0.0)
    history = go((STEEL,), boundary, sky_view=1.0, interior_emissivity=0.0, start="linear")
    assert np.all(np.diff(history.exterior) < 0.0)
    assert history.exterior[-1] > 0.0


# --- refusals ----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"absorptance": 1.2}, "wall: absorptance = 1.2: not a number from 0 to 1"),
        ({"sky_view": float("nan")}, "wall: sky_view = nan: not a number from 0 to 1"),
        ({"step": 0.0}, "wall: step = 0.0: not a number above 0"),
        ({"start": "warm"}, "wall: start = 'warm': unknown; use one of auto"),
        ({"start": "periodic"}, "wall: start = 'periodic': the series covers less than a day"),
        ({"lead_in": 2}, "wall: lead_in = 2: the series covers less than a day"),
        ({"start": "steady", "lead_in": -1}, "wall: lead_in = -1: too few days"),
    ],
)
def test_an_option_that_cannot_be_gets_one_line(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(InputError) as caught:
        go((BRICK,), weather(hours(5)), **changes)
    assert message in str(caught.value)


def test_a_steady_state_that_does_not_exist_is_refused() -> None:
    boundary = weather(hours(5), exterior_film=0.0, interior_film=0.0)
    with pytest.raises(InputError, match="exchanges heat with neither side; use the linear start"):
        go((BRICK,), boundary, **NO_RADIATION, start="steady")


@pytest.mark.parametrize("layers", [(), (slab(0.1, 0.0, 1000.0, 1000.0),), (slab(-0.1, 1.0, 1000.0, 1000.0),)])
def test_layers_that_cannot_conduct_are_refused(layers: tuple[Layer, ...]) -> None:
    with pytest.raises(InputError, match=r"wall: layer"):
        go(layers, weather(hours(5)))


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("air_temperature", np.nan, "air_temperature[2] = nan: not a finite number"),
        ("air_temperature", -1.0, "air_temperature[2] = -1.0: below absolute zero"),
        ("sky_temperature", 533.0, "sky_temperature[2] = 533.0: above 150 C"),
        ("beam", -2.0, "beam[2] = -2.0: a negative irradiance"),
        ("interior_film", -0.1, "interior_film[2] = -0.1: a negative film coefficient"),
    ],
)
def test_a_value_that_cannot_be_is_named_with_its_place(name: str, value: float, message: str) -> None:
    series = constant(280.0, 5)
    series[2] = value
    with pytest.raises(InputError) as caught:
        weather(hours(5), **{name: series})
    assert f"boundary: {message}" in str(caught.value)


def test_shapes_and_times_that_do_not_fit_are_refused() -> None:
    with pytest.raises(InputError, match=r"beam = \(3,\): shape does not fit times \(5,\)"):
        weather(hours(5), beam=np.zeros(3))
    with pytest.raises(InputError, match=r"time\[1\] = 0.0: does not come after"):
        weather(np.zeros(3))
    with pytest.raises(InputError, match="too few samples"):
        weather(hours(1))


def test_a_balance_without_solution_is_told_and_not_returned() -> None:
    boundary = weather(hours(5), exterior_film=1e-12, interior_film=0.0, beam=1e5)
    with pytest.raises(NumericsError, match="did not converge"):
        go((BRICK,), boundary, **NO_RADIATION, start="steady")
