"""Laws that the march keeps whatever the weather: order, symmetry, conservation, independence of columns."""

import numpy as np
import pytest
from wall_cases import (
    DARK,
    SIGMA,
    FloatArray,
    constant,
    gap,
    indoors,
    outdoors,
    reference_walls,
    slab,
    uniform_grid,
)

from sensorsim.thermal import History, Inside, Outside, WallGrid, build_grid, march

STEP, DAY = 300.0, 288  # [s], samples of a day
ABSORPTANCES = np.array([0.1, 0.3, 0.5, 0.7, 0.9])


def _rough_weather(samples: int, orientations: int, *, seed: int = 3) -> tuple[Outside, Inside]:
    """Boundary values that jump from sample to sample, with radiation and free convection on both sides."""
    rng = np.random.default_rng(seed)
    air = 280.0 + np.cumsum(rng.normal(0.0, 0.5, samples))
    room = 290.0 + rng.normal(0.0, 1.0, samples)
    outside = Outside(
        irradiance=rng.uniform(0.0, 900.0, (samples, orientations)),
        longwave=rng.uniform(200.0, 420.0, (samples, orientations)),
        film=rng.uniform(0.0, 40.0, (samples, orientations)),
        free=rng.uniform(0.5, 4.0, orientations),
        air=air,
        emissivity=0.9,
        free_colder=rng.uniform(0.5, 4.0, orientations),
    )
    inside = Inside(air=room, radiant=room + 2.0, film=rng.uniform(0.0, 4.0, samples), free=2.2, emissivity=0.8)
    return outside, inside


def _only(outside: Outside, orientation: int) -> Outside:
    """One orientation alone."""
    one = slice(orientation, orientation + 1)
    return outside._replace(
        irradiance=np.ascontiguousarray(outside.irradiance[:, one]),
        longwave=np.ascontiguousarray(outside.longwave[:, one]),
        film=np.ascontiguousarray(outside.film[:, one]),
        free=np.ascontiguousarray(outside.free[one]),
        free_colder=np.ascontiguousarray(outside.free_colder[one]),
    )


def test_columns_solved_together_equal_each_alone_bit_for_bit() -> None:
    """Expected: no column knows its neighbours, in its block or in another one; 15 orientations fill two blocks."""
    outside, inside = _rough_weather(200, 15)
    layers = reference_walls()["roof_builtup"]
    every = np.arange(200)
    together = march(layers, outside, inside, ABSORPTANCES, step=STEP, record=every)
    for orientation in range(15):
        alone = march(layers, _only(outside, orientation), inside, ABSORPTANCES, step=STEP, record=every)
        np.testing.assert_array_equal(alone.exterior[:, 0], together.exterior[:, orientation])
        np.testing.assert_array_equal(alone.heat[:, 0], together.heat[:, orientation])
    single = march(layers, _only(outside, 4), inside, ABSORPTANCES[2:3], step=STEP, record=every)
    np.testing.assert_array_equal(single.exterior[:, 0, 0], together.exterior[:, 4, 2])


def test_recording_more_samples_changes_nothing() -> None:
    outside, inside = _rough_weather(120, 3)
    layers = reference_walls()["brick"]
    often = march(layers, outside, inside, ABSORPTANCES, step=STEP, record=np.arange(120))
    last = march(layers, outside, inside, ABSORPTANCES, step=STEP, record=np.array([50, 119]))
    np.testing.assert_array_equal(last.exterior, often.exterior[[50, 119]])
    np.testing.assert_array_equal(last.interior, often.interior[[50, 119]])
    np.testing.assert_allclose(last.heat, often.heat, rtol=1e-12)


@pytest.mark.parametrize("name", ["wood_insulated", "steel_sheet", "roof_builtup"])
@pytest.mark.parametrize("step", [1.0, 60.0, 3600.0])
def test_heat_that_enters_is_heat_that_is_stored(name: str, step: float) -> None:
    """Expected: to 1e-12 of the heat that moved, at any step, whatever the loads do."""
    outside, inside = _rough_weather(300, 4)
    history = march(reference_walls()[name], outside, inside, ABSORPTANCES, step=step, record=np.array([299]))
    moved = 300 * step * 900.0
    assert np.abs(history.heat.sum(axis=0) - history.stored).max() < 1e-12 * moved


def _face_gain(history: History, outside: Outside) -> FloatArray:
    """Heat [W m-2] that the exterior face takes from its surroundings at the recorded samples (t, o, a)."""
    face, rows = history.exterior, history.sample
    difference = outside.air[rows, None, None] - face
    free = np.where(difference < 0.0, outside.free[None, :, None], outside.free_colder[None, :, None])
    cube = outside.film[rows, :, None] ** 3 + free * np.abs(difference)
    sun = ABSORPTANCES * outside.irradiance[rows, :, None]
    glow = outside.emissivity * (outside.longwave[rows, :, None] - SIGMA * face**4)
    return np.asarray(sun + glow + np.cbrt(cube) * difference)


def test_faces_are_in_balance_with_their_surroundings_at_every_sample() -> None:
    """Rationale: what the surroundings give by the laws of each flux is what conduction takes to the first cell."""
    outside, inside = _rough_weather(200, 5)
    layers = reference_walls()["brick"]
    history = march(layers, outside, inside, ABSORPTANCES, step=STEP, record=np.arange(1, 200), keep_nodes=True)
    assert history.nodes is not None
    conducted = history.grid.conductance[0] * (history.exterior - history.nodes[:, 0])
    assert np.abs(_face_gain(history, outside) - conducted).max() < 1e-5


@pytest.mark.parametrize("flux", [-60.0, -1e-3, 1e-3, 60.0])
def test_free_film_goes_by_whether_the_face_is_warmer_or_colder_than_the_air(flux: float) -> None:
    """Rationale: a roof sheds warm air and keeps cold air. Expected: q = c |dT|^(4/3) with the c of its own sign."""
    count, sheds, holds = 20, 1.5**3, 0.8**3
    sun, sky = (flux, 0.0) if flux > 0.0 else (0.0, -flux)
    outside = outdoors(constant(280.0, count), 0.0, sun=sun)._replace(
        free=np.array([sheds]), free_colder=np.array([holds])
    )
    inside = indoors(constant(280.0, count), 0.0)._replace(
        radiant=constant(0.0, count), emissivity=0.0, film=constant(1e-9, count)
    )
    if sky:  # a face that loses heat by radiation alone, to a surrounding that is short of `flux`
        outside = outside._replace(emissivity=1e-3, longwave=np.full((count, 1), SIGMA * 280.0**4 - sky / 1e-3))
    history = march([gap(1e9)], outside, inside, np.ones(1), step=STEP, record=np.array([count - 1]))
    difference = float(history.exterior[0, 0, 0]) - 280.0
    radiated = float(outside.emissivity) * SIGMA * ((280.0 + difference) ** 4 - 280.0**4)
    strength = sheds if flux > 0.0 else holds
    exact = np.sign(flux) * (np.abs(flux - radiated) / strength ** (1.0 / 3.0)) ** 0.75
    assert difference == pytest.approx(exact, rel=1e-6)


def test_a_mirrored_wall_gives_mirrored_temperatures() -> None:
    layers = reference_walls()["wood_insulated"]
    count, grid = 200, build_grid(layers, STEP)
    mirrored = WallGrid(
        capacity=grid.capacity[::-1].copy(), conductance=grid.conductance[::-1].copy(), depth=grid.depth
    )
    rng = np.random.default_rng(9)
    warm, cold = 290.0 + rng.normal(0.0, 3.0, count), 270.0 + rng.normal(0.0, 3.0, count)
    film, other = rng.uniform(1.0, 30.0, count), rng.uniform(1.0, 30.0, count)
    ahead = march(
        layers, outdoors(warm, film, sky=295.0, emissivity=0.9),
        indoors(cold, other, radiant=constant(260.0, count), emissivity=0.7), DARK,
        step=STEP, record=np.arange(count), grid=grid,
    )  # fmt: skip
    back = march(
        layers[::-1], outdoors(cold, other, sky=260.0, emissivity=0.7),
        indoors(warm, film, radiant=constant(295.0, count), emissivity=0.9), DARK,
        step=STEP, record=np.arange(count), grid=mirrored,
    )  # fmt: skip
    np.testing.assert_allclose(ahead.exterior, back.interior, rtol=1e-12)
    np.testing.assert_allclose(ahead.interior, back.exterior, rtol=1e-12)


def test_a_wall_cut_where_its_cells_meet_is_the_same_wall() -> None:
    whole = slab(0.2, 1.0, 2000.0, 900.0)
    grid = build_grid([whole], STEP)
    cut = 2.0 * float(grid.depth[0])  # end of the first cell
    parts = [slab(cut, 1.0, 2000.0, 900.0), slab(0.2 - cut, 1.0, 2000.0, 900.0)]
    outside, inside = _rough_weather(100, 2)
    runs = [march(made, outside, inside, ABSORPTANCES, step=STEP, record=np.arange(100)) for made in ([whole], parts)]
    np.testing.assert_allclose(runs[0].exterior, runs[1].exterior, rtol=1e-12)


def test_resistances_in_a_row_are_one_resistance() -> None:
    outside, inside = _rough_weather(100, 2)
    wood, board = reference_walls()["wood_insulated"][0], reference_walls()["wood_insulated"][4]
    one, two = [wood, gap(0.2), board], [wood, gap(0.05), gap(0.15), board]
    runs = [march(made, outside, inside, ABSORPTANCES, step=STEP, record=np.arange(100)) for made in (one, two)]
    np.testing.assert_allclose(runs[0].exterior, runs[1].exterior, rtol=1e-12)


def _sunny_weather(days: int) -> tuple[Outside, Inside]:
    """Days with a sunrise, a sunset and wind, in 300 s samples, the same every day."""
    angle = 2.0 * np.pi * np.arange(days * DAY + 1) / DAY
    outside = Outside(
        irradiance=np.maximum(-700.0 * np.cos(angle), 0.0)[:, None],
        longwave=(300.0 + 20.0 * np.sin(angle))[:, None],
        film=(12.0 + 6.0 * np.sin(2.0 * angle))[:, None],
        free=np.array([2.2]),
        air=280.0 - 6.0 * np.cos(angle - 0.5),
        emissivity=0.9,
    )
    room = np.full(angle.size, 293.15)
    return outside, Inside(air=room, radiant=room, film=np.full(angle.size, 0.5), free=2.2, emissivity=0.9)


def test_over_a_periodic_day_as_much_heat_enters_as_leaves() -> None:
    """Rationale: the same day again and again. Expected: heat in less heat out less storage below 1e-6 of the flux."""
    days = 14
    outside, inside = _sunny_weather(days)
    for name, layers in reference_walls().items():
        until = [
            march(layers, outside, inside, ABSORPTANCES, step=STEP, record=np.array([whole * DAY]))
            for whole in (days - 1, days)
        ]
        entered, stored = until[1].heat - until[0].heat, until[1].stored - until[0].stored
        assert np.abs(entered.sum(axis=0) - stored).max() < 1e-12 * 700.0 * 86400.0, name
        assert np.abs(stored).max() < 1e-6 * np.abs(entered).max(), name
        assert np.abs(until[1].exterior - until[0].exterior).max() < 1e-5, name


def test_brightness_and_warmth_go_together() -> None:
    """More absorbed sun or a warmer sky never makes a face colder, but for the millikelvin of a change of method."""
    outside, inside = _sunny_weather(2)
    every = np.arange(1, 2 * DAY)
    warmer = outside._replace(longwave=outside.longwave + 5.0)
    for name, layers in reference_walls().items():
        plain = march(layers, outside, inside, ABSORPTANCES, step=STEP, record=every).exterior
        assert np.diff(plain, axis=2).min() > -1e-3, name
        warm = march(layers, warmer, inside, ABSORPTANCES, step=STEP, record=every).exterior
        assert (warm - plain).min() > -1e-3, name


def _smooth_answer(step: float, cells: int) -> FloatArray:
    """Both faces [K] on the hour through a smooth half day of sun, air and radiation on a two-layer wall."""
    layers = [slab(0.04, 0.6, 1500.0, 900.0), slab(0.05, 0.1, 500.0, 1200.0)]
    count = round(43200.0 / step) + 1
    swell = np.sin(np.pi * np.arange(count) / (count - 1)) ** 4
    history = march(
        layers,
        outdoors(290.0 + 10.0 * swell, 15.0 + 5.0 * swell, sun=600.0 * swell, sky=260.0, emissivity=0.9),
        indoors(constant(290.0, count), 5.0),
        np.array([0.7]),
        step=step,
        record=np.arange(0, count, round(3600.0 / step))[1:],
        grid=uniform_grid(layers, [cells, cells]),
        start=constant(290.0, 2 * cells),
    )
    return np.stack([history.exterior[:, 0, 0], history.interior[:, 0, 0]])


def test_error_falls_with_the_square_of_the_cell() -> None:
    finest, answers = _smooth_answer(60.0, 192), [_smooth_answer(60.0, cells) for cells in (6, 12, 24)]
    errors = [np.sqrt(np.mean((answer - finest) ** 2)) for answer in answers]
    slopes = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(np.abs(slopes - 2.0) < 0.1), slopes


def test_error_falls_with_the_square_of_the_step() -> None:
    """The wall's cells are coarse, so that no mode is faster than a step and the second-order method is at work."""
    finest, answers = _smooth_answer(14.0625, 2), [_smooth_answer(step, 2) for step in (450.0, 225.0, 112.5)]
    errors = [np.sqrt(np.mean((answer - finest) ** 2)) for answer in answers]
    slopes = np.log2(np.array(errors[:-1]) / errors[1:])
    assert np.all(np.abs(slopes - 2.0) < 0.2), slopes
