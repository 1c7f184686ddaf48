"""Sun lobes: the response they are made from, what they add up to, and what they leave to the orientations."""

from dataclasses import replace
from datetime import date

import numpy as np
import pytest
from small_world import SETTINGS, environment, random_normals, tables, wall_types
from table_error import Surfaces, fit_error, full_solve, summarise

from sensorsim.environment import build_environment, read_weather
from sensorsim.materials import load_catalogue
from sensorsim.tables import bake_tables, orientation_set, surface_temperature
from sensorsim.tables.fit import fit_gain, nearby_slices
from sensorsim.tables.lobes import gain_terms, lobe_gain, lobe_sources, lobe_weights
from sensorsim.tables.spline import roughness, spline_matrix
from sensorsim.tables.straighten import UNBENT, Films, bend_back, fit_loss, straighten, tilt_terms
from sensorsim.thermal import build_grid
from sensorsim.thermal.convection import free_film_cubed, wind_share, windward_share
from sensorsim.thermal.heat_balance import directional_irradiance
from sensorsim.thermal.linear_response import linear_response

LAYERS = wall_types()[0].layers
REFLECTANCES = np.array([0.1, 0.5, 0.9])


def _record() -> np.ndarray:
    return environment().image_window.start + 6 * np.arange(49)


def test_steady_heat_warms_a_face_by_the_films_and_the_wall_in_parallel() -> None:
    """Closed form: q / (h_out + 1 / (R + 1 / h_in)); brick forgets its start in ten days."""
    grid, count = build_grid(LAYERS, 3600.0), 24 * 30
    heat, slope = np.full((count, 1), 100.0), np.full(count, 17.0)
    rise = linear_response(grid, heat, slope, 8.0, step=3600.0, record=np.array([count - 1]))
    resistance = float(np.sum(1.0 / grid.conductance))
    assert rise[0, 0] == pytest.approx(100.0 / (17.0 + 1.0 / (resistance + 1.0 / 8.0)), rel=1e-6)


def test_response_adds_up_and_knows_nothing_of_later_heat() -> None:
    grid, rng = build_grid(LAYERS, 300.0), np.random.default_rng(3)
    heat, slope = rng.uniform(0.0, 500.0, (400, 2)), rng.uniform(10.0, 25.0, 400)
    record = np.array([0, 100, 399])
    apart = linear_response(grid, heat, slope, 5.0, step=300.0, record=record)
    together = linear_response(grid, heat @ np.array([[2.0], [-1.0]]), slope, 5.0, step=300.0, record=record)
    np.testing.assert_allclose(together[:, 0], 2.0 * apart[:, 0] - apart[:, 1], rtol=1e-9, atol=1e-12)
    later = heat.copy()
    later[101:] = 0.0
    np.testing.assert_array_equal(linear_response(grid, later, slope, 5.0, step=300.0, record=record)[:2], apart[:2])


def test_late_sources_answer_as_they_would_alone_and_in_any_order() -> None:
    """Those that have not begun are passed over; one that never begins stays at nothing."""
    grid, rng = build_grid(LAYERS, 300.0), np.random.default_rng(4)
    heat, slope = rng.uniform(0.0, 500.0, (300, 4)), rng.uniform(10.0, 25.0, 300)
    for column, begin in enumerate((200, 0, 300, 37)):
        heat[:begin, column] = 0.0
    record = np.array([0, 36, 37, 199, 200, 299])
    together = linear_response(grid, heat, slope, 5.0, step=300.0, record=record)
    for column in range(4):
        alone = linear_response(grid, heat[:, column : column + 1], slope, 5.0, step=300.0, record=record)
        np.testing.assert_allclose(together[:, column : column + 1], alone, rtol=1e-12)
    np.testing.assert_array_equal(together[:, 2], 0.0)
    assert together[2, 3] > 0.0 == together[1, 3]


def test_a_sheet_of_metal_forgets_wholly() -> None:
    """Rises fade to nothing at all and not to numbers that processors take a hundred times as long for."""
    sheet = build_grid(load_catalogue().wall_type(12, "unheated").layers, 300.0)
    heat = np.zeros((400, 2))
    heat[1, 0], heat[1:, 1] = 500.0, 500.0
    rise = linear_response(sheet, heat, np.full(400, 20.0), 5.0, step=300.0, record=np.array([1, 2, 100, 399]))
    assert rise[0, 0] == rise[0, 1] > rise[1, 0] > 0.0
    np.testing.assert_array_equal(rise[2:, 0], 0.0)
    assert rise[3, 1] == pytest.approx(500.0 / (20.0 + 1.0 / (float(np.sum(1.0 / sheet.conductance)) + 0.2)))


def test_sources_of_the_lobes_are_all_the_light_of_the_sun_and_no_more() -> None:
    sources = lobe_sources(environment(), _record(), interval=1800.0, sky="perez")
    light = directional_irradiance(environment())[sources.first :]
    begun = int(np.count_nonzero(sources.node < 48))
    np.testing.assert_allclose(sources.light[:, :begun].sum(axis=1) + sources.light[:, 2 * begun :].sum(axis=1), light)


def test_weights_hold_the_whole_response_whatever_lobes_they_are_handed_to() -> None:
    """Light through which a surface faces all lobes alike warms it by the response to all of it: nothing is lost."""
    sources = lobe_sources(environment(), _record(), interval=1800.0, sky="perez")
    begun = int(np.count_nonzero(sources.node < 48))
    response = np.abs(np.random.default_rng(0).normal(1.0, 0.3, (49, sources.light.shape[1])))
    position = sources.clock / 1800.0
    gone = np.clip(position[:, None] - sources.node[sources.node < 48], 0.0, 1.0)
    response[:, :begun] *= gone
    response[:, begun : 2 * begun] = 0.4 * gone * response[:, :begun]
    whole = response[:, :begun].sum(axis=1) + response[:, 2 * begun :].sum(axis=1)
    np.testing.assert_allclose(lobe_weights(sources, response).sum(axis=1), whole, atol=0.05)


def test_no_temperature_jumps_in_time_with_lobes_that_come_and_go() -> None:
    baked, normal = tables(), random_normals(60)
    wall, reflectance = np.zeros(60, dtype=np.int64), np.full(60, 0.2)
    for time in np.arange(1800.0, 86400.0, 3600.0):
        before, after = (surface_temperature(baked, normal, wall, reflectance, time + late) for late in (-1e-3, 1e-3))
        assert np.abs(after - before).max() < 1e-4


def test_lobe_that_a_surface_did_not_see_leaves_it_colder_and_others_alone() -> None:
    """A black wall shaded in the morning: colder at noon, never below what it is without any sun."""
    baked, normal = tables(), random_normals(200)
    wall, reflectance = np.zeros(200, dtype=np.int64), np.full(200, 0.1)
    count = baked.at(43200.0).direction.shape[0]
    lit = surface_temperature(baked, normal, wall, reflectance, 43200.0)
    all_seen = surface_temperature(baked, normal, wall, reflectance, 43200.0, visibility=np.ones((200, count)))
    np.testing.assert_array_equal(lit, all_seen)
    unlit = surface_temperature(baked, normal, wall, reflectance, 43200.0, visibility=np.zeros((200, count)))
    for lobe in range(count):
        seen = np.ones((200, count))
        seen[:, lobe] = 0.0
        shaded = surface_temperature(baked, normal, wall, reflectance, 43200.0, visibility=seen)
        facing = normal @ baked.at(43200.0).direction[lobe] > 0.0
        np.testing.assert_array_equal(shaded[~facing], lit[~facing])
        assert np.all(shaded <= lit + 1e-9)
        assert np.all(shaded >= unlit - 1e-9)


def test_lobes_take_out_most_of_what_the_orientations_miss() -> None:
    """Winter daylight, random normals against their full solve: 99 of 100 within 0.06 K, a twentieth of the plain."""
    hours = np.array([7.0, 8.0, 10.0, 12.5, 15.0, 16.5, 20.0]) * 3600.0
    surfaces = Surfaces(
        wall_types=wall_types(), normal=random_normals(80), reflectance=np.array([0.05, 0.5, 0.95]), time_of_day=hours
    )
    ground = wall_types()[3]
    solved = full_solve(environment(), surfaces, ground=ground, settings=SETTINGS)
    with_lobes = summarise(surfaces, fit_error(tables(), surfaces, solved))
    plain = bake_tables(environment(), wall_types(), ground=ground, settings=replace(SETTINGS, lobes=0.0))
    without = summarise(surfaces, fit_error(plain, surfaces, solved))
    assert with_lobes.p99 < 0.06
    assert with_lobes.max < 0.3
    assert with_lobes.p99 < without.p99 / 20.0


def test_windless_sun_bends_the_response_and_the_tables_follow_it() -> None:
    """The hardest there is: roof and sheet metal by day under a clear summer sky without any wind, 60 K apart.

    Expected: 99 of 100 within 0.22 K. Farthest off are roofs near the edge of the sun of the morning.
    """
    weather, day = read_weather("summer"), date(1976, 9, 2)
    none = np.zeros_like(weather.wind_speed)
    calm = build_environment(
        replace(weather, wind_speed=none, cloud_cover=none), image_day=day, lead_in_days=1.0, step=300.0
    )
    surfaces = Surfaces(
        wall_types=wall_types()[1:3], normal=random_normals(40), reflectance=np.array([0.05, 0.3, 0.6, 0.9]),
        time_of_day=np.array([9.0, 11.0, 12.5, 14.0, 17.0]) * 3600.0,
    )  # fmt: skip
    ground = wall_types()[3]
    solved = full_solve(calm, surfaces, ground=ground, settings=SETTINGS)
    baked = bake_tables(calm, surfaces.wall_types, ground=ground, settings=SETTINGS)
    miss = summarise(surfaces, fit_error(baked, surfaces, solved))
    assert np.ptp(np.stack(solved)) > 60.0
    assert miss.rms < 0.06
    assert miss.p99 < 0.22
    assert miss.max < 0.45


def test_melting_snow_is_as_exact_as_walls() -> None:
    """The fall day thaws: all of it stays at 0 C however the sun stands, and no lobe is believed."""
    weather = read_weather("fall")
    thaw = build_environment(weather, image_day=date(1976, 10, 7), lead_in_days=1.0, step=300.0)
    snow = load_catalogue().wall_type(99, "none")
    surfaces = Surfaces(
        wall_types=(snow,), normal=random_normals(30), reflectance=np.array([0.1, 0.8]),
        time_of_day=np.array([9.0, 12.0, 15.0]) * 3600.0,
    )  # fmt: skip
    solved = full_solve(thaw, surfaces, ground=wall_types()[3], settings=SETTINGS)
    baked = bake_tables(thaw, (snow,), ground=wall_types()[3], settings=SETTINGS)
    np.testing.assert_allclose(solved[0], 273.15, atol=1e-6)
    assert summarise(surfaces, fit_error(baked, surfaces, solved)).max < 0.1


def test_shade_at_a_standard_orientation_and_solved_reflectance_is_the_full_solve() -> None:
    """Nothing counted twice or lost: orientations are kept by the spline, reflectances by the quadratic."""
    normal = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
    octahedral = replace(SETTINGS, orientations="octahedron66")  # has these three among its corners
    mixed = load_catalogue().wall_type(30, "heated")
    surfaces = Surfaces(
        wall_types=(*wall_types(), mixed), normal=normal, reflectance=np.array(SETTINGS.reflectances),
        time_of_day=np.array([0.0, 36000.0, 43200.0, 61200.0]),
    )  # fmt: skip
    solved = full_solve(environment(), surfaces, ground=wall_types()[3], settings=octahedral)
    baked = bake_tables(environment(), surfaces.wall_types, ground=wall_types()[3], settings=octahedral)
    errors = fit_error(baked, surfaces, solved)
    assert max(np.abs(error).max() for error in errors[:4]) < 2e-4
    assert np.abs(errors[4]).max() < 0.05  # its parts are solved at reflectances of their own


def test_spline_keeps_what_it_knows_and_reproduces_its_own_forms() -> None:
    """Quadratics of the normal, the cone at the zenith and the edge at the horizon come through exactly."""
    matrix = spline_matrix("octahedron66", "octahedron578")
    solved, dense = orientation_set("octahedron66").normal, orientation_set("octahedron578")
    for form in (lambda n: n[:, 0] * n[:, 2], lambda n: np.hypot(n[:, 0], n[:, 1]), lambda n: np.abs(n[:, 2])):
        np.testing.assert_allclose(matrix @ form(solved), form(dense.normal), atol=1e-9)
    values = np.random.default_rng(1).normal(size=66)
    same = np.argmin(np.linalg.norm(dense.normal[None] - solved[:, None], axis=2), axis=1)
    np.testing.assert_allclose((matrix @ values)[same], values, atol=1e-9)


def _one_sun(gain: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rise (1, o, 3) [K] by one lobe and the same with a gain, at reflectances 0.1, 0.5 and 0.9."""
    normal = orientation_set("octahedron66").normal
    sun = np.array([0.5, -0.6, 0.62])
    rise = 30.0 * np.maximum(normal @ sun, 0.0)[None, :, None] * np.array([0.9, 0.5, 0.1])
    return rise, rise * lobe_gain(gain, normal)[:, :, None]


def test_gain_of_the_lobes_is_found_whatever_smooth_field_lies_under_them() -> None:
    """The forms that the spline knows cost it nothing, so they do not mislead: gains come out within a percent."""
    normal, gain = orientation_set("octahedron66").normal, np.array([[0.9, 0.05, -0.04, -0.1, 0.08]])
    rise, gained = _one_sun(gain)
    field = 280.0 + 9.0 * normal[:, 2] + 5.0 * normal[:, 0] * normal[:, 1] + 3.0 * np.abs(normal[:, 2])
    found = fit_gain(field[None, :, None] + gained, rise, "octahedron66", REFLECTANCES, np.eye(1))
    np.testing.assert_allclose(found, gain, atol=0.015)
    asked = random_normals(200)
    np.testing.assert_allclose(lobe_gain(found, asked), lobe_gain(gain, asked), atol=0.02)


def test_lobes_that_do_not_show_have_hardly_any_gain_and_no_lobes_a_gain_of_one() -> None:
    """Melting snow stays at 0 C in any sun; without sun nothing can be told and nothing is made up."""
    rise, _ = _one_sun(np.array([[1.0, 0.0, 0.0, 0.0, 0.0]]))
    hidden = fit_gain(np.full(rise.shape, 273.15), rise, "octahedron66", REFLECTANCES, np.eye(1))
    np.testing.assert_allclose(hidden, 0.0, atol=0.02)
    dark = fit_gain(np.full(rise.shape, 280.0), np.zeros_like(rise), "octahedron66", REFLECTANCES, np.eye(1))
    np.testing.assert_allclose(dark, [[1.0, 0.0, 0.0, 0.0, 0.0]], atol=1e-9)
    assert gain_terms(np.array([[0.0, 0.0, -1.0]])).tolist() == [[1.0, 0.0, 0.0, -1.0, 1.0]]


def test_roughness_is_nothing_for_known_forms_and_positive_for_a_kink() -> None:
    for name in ("octahedron66", "report26", "icosphere42", "octahedron18"):
        energy, normal = roughness(name), orientation_set(name).normal
        assert np.linalg.eigvalsh(energy).min() > -1e-9
        assert abs(normal[:, 2] @ energy @ normal[:, 2]) < 1e-9
        kink = np.maximum(normal @ np.array([0.36, 0.48, 0.8]), 0.0)
        assert kink @ energy @ kink > 1e-3


def _films() -> tuple[Films, np.ndarray, tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Films of a light wind from the south-west, normals (o, 3) and what the films go by."""
    normal, towards = orientation_set("octahedron66").normal, np.array([[-0.6, -0.8]])
    films = Films(emissivity=0.9, leeward=np.array([3.0]), windward=np.array([4.0]), free=2.0)
    return films, normal, (wind_share(normal, towards), *tilt_terms(normal))


def _lost(kelvin: np.ndarray, air: float, films: Films, normal: np.ndarray) -> np.ndarray:
    """Heat (o, r) [W m-2] that a face loses beyond that at the temperature of the air, by the laws of its films."""
    windward = windward_share(normal, np.array([np.degrees(np.arctan2(-0.6, -0.8))]))[0]
    forced = films.leeward[0] + films.windward[0] * windward
    free = np.stack([free_film_cubed(normal, warmer=warm) for warm in (False, True)])
    free *= films.free / free_film_cubed(np.array([[1.0, 0.0, 0.0]]))[0]
    rise = kelvin - air
    film = np.cbrt(forced[:, None] ** 3 + np.where(rise > 0.0, free[1][:, None], free[0][:, None]) * np.abs(rise))
    return film * rise + films.emissivity * 5.670374419e-8 * (kelvin**4 - air**4)


def test_what_a_face_without_mass_absorbs_is_straight_in_the_straightened_temperature() -> None:
    """Closed form: all that it absorbs is lost by films and radiation, so the value is one multiple of the heat."""
    films, normal, terms = _films()
    kelvin = 290.0 + np.random.default_rng(5).uniform(-20.0, 60.0, (1, 66, 3))
    heat = _lost(kelvin[0], 290.0, films, normal)
    whole = np.array([[0.0, films.emissivity * 5.670374419e-8, 3.0, 4.0, 2.0]])
    straight, slope = straighten(kelvin, np.array([290.0]), whole, terms)
    np.testing.assert_allclose(straight[0], heat, rtol=1e-9, atol=1e-9)
    around = straighten(kelvin + 1e-4, np.array([290.0]), whole, terms)[0]
    np.testing.assert_allclose(slope, (around - straight) / 1e-4, rtol=1e-4)


def test_loss_is_believed_as_far_as_it_straightens_and_comes_back() -> None:
    """Faces without mass at three reflectances, 60 K apart: curvature falls tenfold, temperatures come back."""
    films, normal, terms = _films()
    reflectance, facing = np.array([0.07, 0.5, 0.93]), np.maximum(normal @ np.array([0.36, -0.48, 0.8]), 0.0)
    heat = 900.0 * np.outer(facing, 1.0 - reflectance) - 60.0
    low, high = np.full(heat.shape, 200.0), np.full(heat.shape, 500.0)
    for _ in range(60):
        middle = 0.5 * (low + high)
        above = _lost(middle, 290.0, films, normal) > heat
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    kelvin, air = low[None], np.array([290.0])
    straight, loss = fit_loss(kelvin, air, reflectance, films, terms)
    np.testing.assert_allclose(straighten(kelvin, air, loss, terms)[0], straight, rtol=1e-9)
    flat = tuple(np.repeat(term.reshape(-1), 3) for term in terms)
    back = bend_back(straight.ravel(), np.full(198, 290.0), np.repeat(loss, 198, axis=0), flat)
    np.testing.assert_allclose(back, kelvin.ravel(), atol=1e-4)
    curved = [np.abs(v[..., 0] - 2.0 * v[..., 1] + v[..., 2]).max() for v in (kelvin, straight)]
    assert curved[1] < 0.1 * curved[0]


def test_night_without_sun_in_the_tables_has_no_loss_to_speak_of() -> None:
    films, _, terms = _films()
    _, loss = fit_loss(np.full((1, 66, 3), 270.0), np.array([275.0]), np.array([0.1, 0.5, 0.9]), films, terms)
    np.testing.assert_allclose(loss, UNBENT[None], atol=1e-12)


def test_slices_around_are_weighted_by_the_time_that_they_stand_for() -> None:
    """A straight course comes through in the middle of the day, however slices are spaced there; ends fold back."""
    clock = np.concatenate([np.arange(0.0, 40000.0, 300.0), np.arange(40200.0, 86401.0, 900.0)])
    nearby = nearby_slices(clock)
    np.testing.assert_allclose(nearby.sum(axis=1), 1.0, atol=1e-12)
    middle = (clock > 20000.0) & (clock < 66000.0)
    np.testing.assert_allclose((nearby @ clock)[middle], clock[middle], atol=60.0)


def test_there_are_as_many_lobes_as_matter_and_no_more() -> None:
    lobes = tables().lobes
    assert lobes is not None
    assert 1 <= lobes.at(20, 0.5)[0].shape[0] <= lobes.most <= lobes.direction.shape[0] + 1
    assert lobes.at(0, 0.0)[0].shape[0] < lobes.most, "at midnight only yesterday's sun is left"
