"""The baked coefficient matrix against the histories that it was fitted to."""

from dataclasses import replace

import numpy as np
import pytest
from small_world import PLAIN, SETTINGS, environment, plain_tables, random_normals, tables, wall_types

from sensorsim.errors import InputError
from sensorsim.materials import WallType
from sensorsim.tables import (
    BakeSettings,
    ShadeTables,
    bake_tables,
    evaluate_polynomial,
    fit_polynomials,
    orientation_set,
    surface_temperature,
)
from sensorsim.thermal import build_interior, expose, ground_temperature, march, surface_boundary

SINGLE = 4e-5  # [K] of a temperature near 300 K in single precision


def _history(wall: WallType, absorptances: np.ndarray) -> np.ndarray:
    """Solved exterior temperatures (t, o, a) [K] at the slices of the tables, as the march gives them."""
    weather = environment()
    soil = ground_temperature(weather, wall_types()[3], sky=PLAIN.sky)
    exposure = expose(weather, orientation_set(PLAIN.orientations).normal, soil, sky=PLAIN.sky)
    outside = surface_boundary(weather, exposure, wall, correlation=PLAIN.convection)
    inside = build_interior(
        wall.interior, weather.air_temperature, weather.wind_speed, weather.step, wall.interior_emissivity
    )
    record = weather.image_window.start + 6 * np.arange(49)
    return march(wall.layers, outside, inside, absorptances, step=weather.step, record=record).exterior


@pytest.mark.parametrize("row", [0, 1, 2, 3])
def test_shade_at_a_standard_orientation_and_solved_reflectance_is_the_solved_history(row: int) -> None:
    """Rationale: five reflectances determine a quartic, and a standard orientation is its own triangle's corner."""
    baked, reflectances = plain_tables(), np.array(PLAIN.reflectances)
    solved = _history(wall_types()[row], 1.0 - reflectances)
    normal = baked.orientations.normal
    for slice_index in (0, 14, 20, 26, 48):
        for column, reflectance in enumerate(reflectances):
            shade = surface_temperature(
                baked, normal, np.full(len(normal), row), np.full(len(normal), reflectance), 1800.0 * slice_index
            )
            np.testing.assert_allclose(shade, solved[slice_index, :, column], rtol=0.0, atol=3.0 * SINGLE)


def test_quartic_in_reflectance_stands_for_the_solved_history() -> None:
    """Between and beyond the five solved reflectances, 0.05 to 0.95, all day, every orientation.

    Expected: within 0.1 K, half of all within 1 mK. Largest on a metal skin whose inner film turns as it passes the
    temperature of the room.
    """
    baked, asked = plain_tables(), np.array([0.05, 0.2, 0.4, 0.6, 0.8, 0.95])
    for row, wall in enumerate(wall_types()):
        solved = _history(wall, 1.0 - asked)
        level = baked.level[:, row, None, None]
        powers = np.vander(asked, PLAIN.degree + 1, increasing=True)
        miss = np.abs(baked.coefficients[:, row].astype(np.float64) @ powers.T + level - solved)
        assert miss.max() < 0.1, wall.name
        assert np.median(miss) < 1e-3, wall.name


def test_polynomial_through_as_many_points_as_powers_is_exact() -> None:
    rng = np.random.default_rng(0)
    for degree in range(6):
        points = np.sort(rng.uniform(0.0, 1.0, degree + 1) * 0.2 + np.arange(degree + 1)) / (degree + 1)
        values = rng.uniform(250.0, 350.0, (7, 3, degree + 1))
        coefficient = fit_polynomials(values, points, degree)
        for column, point in enumerate(points):
            got = evaluate_polynomial(coefficient.reshape(-1, degree + 1), np.full(21, point))
            np.testing.assert_allclose(got, values[..., column].ravel(), rtol=1e-10)


def test_fit_with_fewer_powers_is_the_least_squares_one() -> None:
    rng = np.random.default_rng(1)
    points, values = np.linspace(0.1, 0.9, 5), rng.uniform(270.0, 320.0, (40, 5))
    coefficient = fit_polynomials(values, points, 2)
    residual = values - coefficient @ np.vander(points, 3, increasing=True).T
    np.testing.assert_allclose(residual @ np.vander(points, 3), 0.0, rtol=0.0, atol=1e-9)
    exact = values @ np.zeros((5, 1)) + 300.0 - 20.0 * points + 3.0 * points**2
    np.testing.assert_allclose(fit_polynomials(exact, points, 2)[0], [300.0, -20.0, 3.0], rtol=1e-9)


def test_tables_are_exact_at_their_slices_and_straight_between_them() -> None:
    baked = plain_tables()
    for index in (0, 1, 20, 47, 48):
        expected = baked.coefficients[index].astype(np.float64)
        expected[..., 0] += baked.level[index][:, None]
        np.testing.assert_array_equal(baked.at(1800.0 * index).coefficients, expected)
    first, second = baked.at(1800.0 * 20).coefficients, baked.at(1800.0 * 21).coefficients
    between = baked.at(1800.0 * 20.25).coefficients
    np.testing.assert_allclose(between, 0.75 * first + 0.25 * second, rtol=1e-12, atol=1e-12)
    assert baked.time_of_day[0] == 0.0
    assert baked.time_of_day[-1] == 86400.0


def test_time_runs_on_without_a_jump_through_every_slice() -> None:
    baked, normal = tables(), random_normals(50)
    wall, reflectance = np.zeros(50, dtype=np.int64), np.full(50, 0.4)

    def at(time: float) -> np.ndarray:
        return surface_temperature(baked, normal, wall, reflectance, time)

    for time in np.arange(1800.0, 86400.0, 1800.0):
        assert np.abs(at(time + 1e-3) - at(time - 1e-3)).max() < 1e-4


@pytest.mark.parametrize("time", [-1.0, 86400.001, float("nan"), float("inf")])
def test_time_outside_of_the_day_is_refused(time: float) -> None:
    with pytest.raises(InputError, match=r"tables of 1976-02-07: time = .*outside of the day"):
        tables().at(time)


def test_walls_baked_together_equal_each_alone_and_a_second_bake_equals_the_first() -> None:
    """Bit for bit, whatever the threads do."""
    ground, baked = wall_types()[3], tables()
    again = bake_tables(environment(), wall_types()[::-1], ground=ground, settings=SETTINGS)
    np.testing.assert_array_equal(again.coefficients[:, ::-1], baked.coefficients)
    alone = bake_tables(environment(), wall_types()[1:2], ground=ground, settings=SETTINGS)
    np.testing.assert_array_equal(alone.coefficients[:, 0], baked.coefficients[:, 1])


def test_progress_names_every_wall_once_in_order() -> None:
    told: list[tuple[str, int, int]] = []
    bake_tables(
        environment(), wall_types(), ground=wall_types()[3],
        settings=replace(SETTINGS, orientations="report26"),
        progress=lambda name, done, total: told.append((name, done, total)),
    )  # fmt: skip
    assert told == [(wall.name, row, 4) for row, wall in enumerate(wall_types(), start=1)]


def test_darker_surfaces_are_warmer_at_noon_and_none_is_colder_at_night() -> None:
    baked, normal = tables(), random_normals(300)
    for row in range(4):
        walls = np.full(300, row)
        dark, light = (
            surface_temperature(baked, normal, walls, np.full(300, reflectance), 43200.0) for reflectance in (0.1, 0.8)
        )
        assert np.all(dark > light)


def test_ground_of_the_tables_is_the_ground_plane_at_the_slices() -> None:
    soil = ground_temperature(environment(), wall_types()[3], sky=SETTINGS.sky)
    window = environment().image_window
    np.testing.assert_array_equal(tables().ground_temperature, soil[window][::6])


def test_slices_that_fall_between_the_environments_samples_are_refused() -> None:
    settings = BakeSettings(lobes=0.0, step=200.0, slice_interval=400.0, lead_in_days=1.0)
    with pytest.raises(InputError, match=r"slice_interval = 400\.0: no multiple of the environment's step of 300 s"):
        bake_tables(environment(), wall_types()[:1], ground=wall_types()[3], settings=settings)


def test_shade_is_continuous_over_the_sphere() -> None:
    """A turn of 1e-6 changes no temperature by more than a hundredth of a millikelvin, also across triangles."""
    baked, normal = tables(), random_normals(4000)
    moved = normal + 1e-6 * random_normals(4000, seed=5)
    moved /= np.linalg.norm(moved, axis=1, keepdims=True)
    wall, reflectance = np.zeros(4000, dtype=np.int64), np.full(4000, 0.2)

    def shade(directions: np.ndarray, made: ShadeTables) -> np.ndarray:
        return surface_temperature(made, directions, wall, reflectance, 43200.0)

    assert np.abs(shade(moved, baked) - shade(normal, baked)).max() < 2e-4
