"""Exchange between near surfaces: crossed strings, horizons, obstacles, balance, and the bound on its effect."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.errors import InputError, NumericsError
from sensorsim.scene import load_scene
from sensorsim.thermal.exchange import build_exchange
from sensorsim.thermal.neighbour_radiation import largest_possible_change, longwave_from_neighbours, radiosity
from sensorsim.thermal.polygon_view_factors import outlines_of_mesh, outlines_of_polygons, view_factor_matrix
from sensorsim.thermal.view_factors import _polygon_view_factor as factor_of_spherical_polygon
from sensorsim.thermal.view_factors import ground_view_factor, sky_view_factor


def rectangle(corner, first, second):
    """Front side where first x second points."""
    corner, first, second = (np.asarray(vector, dtype=np.float64) for vector in (corner, first, second))
    return np.array([corner, corner + first, corner + first + second, corner + second])


def wall(x, y, length, height, *, looks_east, base=0.0):
    """An upright wall that starts at (x, y) and runs north."""
    corner, along, up = (x, y, base), (0, length, 0), (0, 0, height)
    return rectangle(corner, along, up) if looks_east else rectangle(corner, up, along)


def box(x, y, size, height):
    """Roof and walls of a house, fronts outside."""
    a, b = np.array((size, 0.0, 0.0)), np.array((0.0, size, 0.0))
    corner, up = np.array((x, y, 0.0)), np.array((0.0, 0.0, height))
    walls = [rectangle(corner, a, up), rectangle(corner + a, b, up)]
    walls += [rectangle(corner + a + b, -a, up), rectangle(corner + b, -b, up)]
    return [*walls, rectangle(corner + up, a, b)]


def canyon(height, width, *, half_length=2e4):
    """A metre of floor and of both walls in the middle of a long street, then the rest of the street."""
    pieces = []
    for start, length in ((-0.5, 1.0), (0.5, half_length), (-0.5 - half_length, half_length)):
        pieces.append(rectangle((0, start, 0), (width, 0, 0), (0, length, 0)))
        pieces.append(wall(0, start, length, height, looks_east=True))
        pieces.append(wall(width, start, length, height, looks_east=False))
    return pieces


@pytest.mark.parametrize("ratio", [0.2, 1.0, 3.0])
def test_a_long_street_meets_the_crossed_strings(ratio):
    """[Hottel1967]: floor and walls of a canyon of any height to width."""
    exchange = build_exchange(outlines_of_polygons(canyon(ratio * 12.0, 12.0)), threshold=1e-12)
    floor_sky = np.hypot(1.0, ratio) - ratio
    across = np.hypot(1.0, 1.0 / ratio) - 1.0 / ratio  # from wall to wall
    assert exchange.sky_share[0] == pytest.approx(floor_sky, abs=1e-7)
    assert exchange.ground_share[0] == 0.0
    for row in (1, 2):
        assert exchange.sky_share[row] == pytest.approx(0.5 * (1.0 - across), abs=1e-7)
        assert exchange.sky_taken[row] == pytest.approx(0.5 * across, abs=1e-7)
        assert exchange.ground_share[row] == pytest.approx(0.0, abs=1e-7)  # the street's floor is all there is
    assert np.all(exchange.kept > 1.0 - 1e-9)


def test_where_the_floor_is_the_ground_it_does_not_count_as_a_neighbour():
    polygons = canyon(12.0, 12.0)
    acting = np.array([k % 3 > 0 for k in range(9)])
    exchange = build_exchange(outlines_of_polygons(polygons), acting=acting, threshold=1e-12)
    across = np.sqrt(2.0) - 1.0
    assert exchange.sky_share[:3] == pytest.approx([across, 0.5 - 0.5 * across, 0.5 - 0.5 * across], abs=1e-7)
    assert exchange.ground_share[:3] == pytest.approx([0.0, 0.5 - 0.5 * across, 0.5 - 0.5 * across], abs=1e-7)
    assert not np.isin(exchange.columns, [0, 3, 6]).any()


def factor_above(receiver, emitter, order=10):
    """View factor to what of an upright rectangle stands above each point of another: a Gauss rule over points.

    The rule is split at the heights where the part that is seen changes its shape.
    """
    rule = list(zip(*np.polynomial.legendre.leggauss(order), strict=True))
    normal = np.cross(receiver[1] - receiver[0], receiver[3] - receiver[0])
    normal = (normal / np.linalg.norm(normal))[None]
    corner, side, rise = receiver[0], receiver[1] - receiver[0], receiver[3] - receiver[0]
    levels = np.clip((np.unique(emitter[:, 2]) - corner[2]) / rise[2], 0.0, 1.0)
    total = 0.0
    for low, high in itertools.pairwise([0.0, *levels]):
        for (s, a), (t, b) in itertools.product(rule, repeat=2):
            point = corner + 0.5 * (1 + s) * side + (low + 0.5 * (1 + t) * (high - low)) * rise
            part = emitter.copy()
            part[:, 2] = np.maximum(part[:, 2], point[2])
            sight = (part - point) / np.linalg.norm(part - point, axis=1, keepdims=True)
            ways = (factor_of_spherical_polygon(way, normal)[0] for way in (sight, sight[::-1]))
            total += 0.25 * a * b * (high - low) * max(ways)
    return total


@pytest.mark.parametrize(("base", "height"), [(0.0, 3.0), (0.0, 9.0), (1.0, 1.0), (-2.0, 4.0), (3.5, 2.0), (-3.0, 2.5)])
def test_the_horizon_divides_what_a_wall_sees(base, height):
    low = wall(0, 0, 4.0, 3.0, looks_east=True)
    other = wall(5, 1, 6.0, height, looks_east=False, base=base)
    exchange = build_exchange(outlines_of_polygons([low, other]), threshold=1e-9)
    assert exchange.factor[0] == pytest.approx(view_factor_matrix([low, other])[0, 1], abs=1e-14)
    assert exchange.sky_taken[0] == pytest.approx(factor_above(low, other), abs=1e-9)
    assert exchange.sky_taken[0] + exchange.ground_taken[0] == pytest.approx(exchange.factor[0], abs=1e-14)


def test_a_sloping_surface_sees_the_horizon_to_second_order():
    slope = rectangle((0, 0, 0), (0, 4, 0), (-2, 0, 2))
    other = wall(3, 0, 4.0, 3.0, looks_east=False)
    exchange = build_exchange(outlines_of_polygons([slope, other]), threshold=1e-9)
    assert exchange.sky_taken[0] == pytest.approx(factor_above(slope, other), rel=0.02)


@pytest.mark.parametrize("rise", [1e-6, 0.02, 0.3])
def test_a_gentle_slope_keeps_all_of_a_high_wall(rise):
    """Hardly any ground is in view, so an error in dividing the wall at the horizon must not cost the wall."""
    roof = rectangle((0, 0, 5), (0, 4, 0), (-4, 0, 4 * rise))
    high = wall(0.5, -10, 24.0, 15.0, looks_east=False)
    exchange = build_exchange(outlines_of_polygons([roof, high]), threshold=1e-9)
    assert exchange.kept[0] == 1.0
    assert exchange.factor[0] == pytest.approx(view_factor_matrix([roof, high])[0, 1], abs=1e-14)
    assert exchange.ground_taken[0] <= ground_view_factor(outlines_of_polygons([roof]).normal)[0]


@pytest.mark.parametrize("rays", [0, 8])
def test_sky_ground_and_neighbours_fill_every_hemisphere(rays):
    draw = np.random.default_rng(7)
    polygons = []
    for k in range(16):
        polygons += box(12.0 * (k % 4), 12.0 * (k // 4), 8.0, draw.uniform(3.0, 20.0))
    polygons.append(rectangle((-10, -10, 0), (70, 0, 0), (0, 70, 0)))
    outlines = outlines_of_polygons(polygons)
    acting = np.arange(81) < 80
    exchange = build_exchange(outlines, acting=acting, rays=rays)
    shares = exchange.sky_share + exchange.ground_share + exchange.neighbour_share
    np.testing.assert_allclose(shares, 1.0, atol=1e-14)
    np.testing.assert_allclose(exchange.matrix().sum(axis=1), exchange.neighbour_share, atol=1e-13)
    np.testing.assert_allclose(exchange.sky_share + exchange.sky_taken, sky_view_factor(outlines.normal), atol=1e-15)
    np.testing.assert_allclose(
        exchange.ground_share + exchange.ground_taken, ground_view_factor(outlines.normal), atol=1e-15
    )
    assert np.min(exchange.sky_share) >= 0.0
    assert np.min(exchange.ground_share) >= 0.0
    assert np.max(exchange.neighbour_share) > 0.3


def test_an_obstacle_hides_what_stands_behind_it():
    near, far = wall(4, -20, 40.0, 10.0, looks_east=False), wall(8, -20, 40.0, 10.0, looks_east=False)
    seen = wall(0, -1, 2.0, 3.0, looks_east=True)
    blind = build_exchange(outlines_of_polygons([seen, near, far]), rays=0)
    sighted = build_exchange(outlines_of_polygons([seen, near, far]))
    alone = build_exchange(outlines_of_polygons([seen, near]))
    assert list(blind.columns[: blind.rows[1]]) == [1, 2]
    assert blind.kept[0] < 1.0  # two walls, one behind the other, filled more than there is
    assert list(sighted.columns[: sighted.rows[1]]) == [1]
    assert sighted.sky_share[0] == pytest.approx(alone.sky_share[0], abs=1e-15)
    assert sighted.kept[0] == 1.0


def test_half_an_obstacle_hides_about_half():
    """A screen midway between two equal walls and over half of their length."""
    first, second = wall(0, 0, 4.0, 4.0, looks_east=True), wall(20, 0, 4.0, 4.0, looks_east=False)
    screen = wall(10, -20, 22.0, 30.0, looks_east=True)
    clear = build_exchange(outlines_of_polygons([first, second]), threshold=1e-4)
    screened = build_exchange(outlines_of_polygons([first, second, screen]), threshold=1e-4, rays=12)
    assert screened.matrix()[0, 1] == pytest.approx(0.5 * clear.matrix()[0, 1], rel=0.1)
    assert screened.matrix()[0, 1] == pytest.approx(screened.matrix()[1, 0], rel=1e-12)


def test_no_pair_above_the_threshold_is_lost():
    draw = np.random.default_rng(1)
    polygons = [draw.uniform(-6, 6, 3) + draw.uniform(0.1, 3) * face for face in (box(0, 0, 1, 1) * 8)]
    outlines = outlines_of_polygons(polygons)
    full = view_factor_matrix(polygons)
    exchange = build_exchange(outlines, threshold=0.01, rays=0)
    wanted = full >= 0.01
    assert 50 < wanted.sum() < 0.5 * full.size
    found = exchange.matrix().toarray()
    np.testing.assert_array_equal(found > 0.0, wanted)
    np.testing.assert_allclose(found, np.where(wanted, full, 0.0) * exchange.kept[:, None], atol=1e-13)


def test_the_hospital_scene_is_reciprocal_and_balanced():
    scene = load_scene("hospital", level="IIIB")
    outlines = outlines_of_mesh(scene.mesh.position, scene.mesh.triangle, scene.mesh.surface)
    np.testing.assert_allclose(outlines.area, scene.surfaces.area, rtol=1e-9)
    np.testing.assert_allclose(outlines.normal, scene.surfaces.normal, atol=1e-9)
    exchange = build_exchange(outlines, acting=scene.surfaces.role != "plane")
    shares = exchange.sky_share + exchange.ground_share + exchange.neighbour_share
    np.testing.assert_allclose(shares, 1.0, atol=1e-13)
    mutual = outlines.area[:, None] * exchange.matrix().toarray()
    both = (mutual > 0.0) & (mutual.T > 0.0) & (exchange.kept == 1.0)[:, None] & (exchange.kept == 1.0)
    assert both.sum() > 500
    np.testing.assert_allclose(mutual[both], mutual.T[both], rtol=1e-12)
    assert np.all(exchange.sky_share[scene.surfaces.role == "bottom"] == 0.0)


@pytest.fixture(scope="module")
def court():
    polygons = canyon(8.0, 10.0, half_length=30.0)
    return build_exchange(outlines_of_polygons(polygons), acting=np.array([k % 3 > 0 for k in range(9)]))


def test_an_isothermal_scene_is_left_as_it_is(court):
    black = STEFAN_BOLTZMANN_CONSTANT * 285.0**4
    for emissivity in (0.0, 0.3, 0.9, 1.0):
        change = longwave_from_neighbours(court, np.full(9, 285.0), np.full(9, emissivity), sky=black, ground=black)
        np.testing.assert_allclose(change, 0.0, atol=1e-10)


def test_black_neighbours_replace_the_sky_by_their_own_emission(court):
    black = STEFAN_BOLTZMANN_CONSTANT * 290.0**4
    change = longwave_from_neighbours(court, np.full(9, 290.0), np.ones(9), sky=250.0, ground=black)
    np.testing.assert_allclose(change, court.sky_taken * (black - 250.0), atol=1e-10)
    assert change[0] > 30.0  # [W m-2] on the floor of a street under a clear sky


def test_a_mirror_shows_what_it_sees_itself(court):
    """Neighbours of no emissivity have no temperature: they hand on what comes in, mirror after mirror."""
    ground, dull = STEFAN_BOLTZMANN_CONSTANT * 280.0**4, np.zeros(9)
    still = longwave_from_neighbours(court, np.full(9, 280.0), dull, sky=250.0, ground=ground)
    left = 250.0 * court.sky_share + ground * court.ground_share
    seen = left.copy()
    for _ in range(400):
        seen = left + court.matrix() @ seen
    hidden = 250.0 * court.sky_taken + ground * court.ground_taken
    np.testing.assert_allclose(still, court.matrix() @ seen - hidden, atol=1e-9)
    cold = longwave_from_neighbours(court, np.full(9, 200.0), dull, sky=250.0, ground=ground)
    np.testing.assert_array_equal(cold, still)


@pytest.mark.parametrize("seed", range(5))
def test_what_surfaces_give_each_other_sums_to_nothing(court, seed):
    """All heat that grey surfaces gain in long waves comes from sky and ground: A_i F_ij = A_j F_ji."""
    draw = np.random.default_rng(seed)
    area = outlines_of_polygons(canyon(8.0, 10.0, half_length=30.0)).area
    court = build_exchange(outlines_of_polygons(canyon(8.0, 10.0, half_length=30.0)), threshold=1e-9, rays=0)
    emissivity, sent_by_sky, sent_by_ground = draw.uniform(0.05, 1.0, 9), 240.0, 390.0
    black = STEFAN_BOLTZMANN_CONSTANT * draw.uniform(260.0, 320.0, 9) ** 4
    sent = radiosity(court, emissivity * black, 1.0 - emissivity, sky=sent_by_sky, ground=sent_by_ground)
    received = court.matrix() @ sent + sent_by_sky * court.sky_share + sent_by_ground * court.ground_share
    gained = area @ (emissivity * (received - black))
    outside = court.sky_share * (sent_by_sky - sent) + court.ground_share * (sent_by_ground - sent)
    assert gained == pytest.approx(area @ outside, rel=1e-9)
    assert np.max(np.abs(court.matrix() @ sent - court.neighbour_share * sent)) > 5.0  # [W m-2] they do give


def test_surfaces_that_absorb_nothing_and_see_nothing_else_are_refused():
    shut = build_exchange(
        outlines_of_polygons(
            [rectangle((0, 0, 0), (9e6, 0, 0), (0, 9e6, 0)), rectangle((0, 0, 1), (0, 9e6, 0), (9e6, 0, 0))]
        )
    )
    with pytest.raises(NumericsError):
        radiosity(replace(shut, factor=np.ones(2)), np.ones(2), np.ones(2), sky=1.0, ground=1.0)


def test_a_series_of_times_equals_its_moments(court):
    draw = np.random.default_rng(2)
    temperature, emissivity = draw.uniform(260, 320, (5, 9)), draw.uniform(0.7, 1.0, 9)
    sky, ground = draw.uniform(200, 300, 5), draw.uniform(300, 400, 5)
    series = longwave_from_neighbours(court, temperature, emissivity, sky=sky, ground=ground)
    for k in range(5):
        moment = longwave_from_neighbours(court, temperature[k], emissivity, sky=sky[k], ground=ground[k])
        np.testing.assert_allclose(series[k], moment, rtol=1e-13)


@pytest.mark.parametrize("seed", range(20))
def test_no_temperatures_break_the_bound(court, seed):
    draw = np.random.default_rng(seed)
    sky, ground = draw.uniform(230.0, 290.0), draw.uniform(270.0, 310.0)
    temperature = draw.uniform(260.0, 320.0, 9) if seed % 2 else draw.choice([260.0, 320.0], 9)
    emissivity = draw.uniform(0.0, 1.0, 9)
    power = STEFAN_BOLTZMANN_CONSTANT * np.array([sky, ground]) ** 4
    change = longwave_from_neighbours(court, temperature, emissivity, sky=power[0], ground=power[1])
    radiant = np.concatenate((temperature, [sky, ground]))
    bound = largest_possible_change(
        court,
        sky_difference=np.max(np.abs(radiant - sky)),
        ground_difference=np.max(np.abs(radiant - ground)),
        greatest_temperature=float(radiant.max()),
        emissivity=emissivity,
    )
    assert np.all(emissivity * np.abs(change) <= bound)


def test_the_bound_is_met_to_first_order(court):
    """Black neighbours a little warmer than a sky and ground of one temperature come as near to it as one likes."""
    power = STEFAN_BOLTZMANN_CONSTANT * 300.0**4
    change = longwave_from_neighbours(court, np.full(9, 301.0), np.ones(9), sky=power, ground=power)
    bound = largest_possible_change(court, sky_difference=1.0, ground_difference=1.0, greatest_temperature=301.0)
    np.testing.assert_allclose(change, bound, rtol=0.006)


@pytest.mark.parametrize(
    "options", [{"threshold": 0.0}, {"threshold": np.nan}, {"acting": np.ones(2, dtype=bool)}, {"rays": -1}]
)
def test_options_that_make_no_sense_are_refused(options):
    with pytest.raises(InputError):
        build_exchange(outlines_of_polygons(box(0, 0, 1, 1)), **options)


@pytest.mark.parametrize(("temperature", "emissivity"), [(np.nan, 0.9), (-1.0, 0.9), (280.0, 1.1), (280.0, np.nan)])
def test_surfaces_that_cannot_be_are_refused(court, temperature, emissivity):
    with pytest.raises(InputError):
        longwave_from_neighbours(court, np.full(9, temperature), np.full(9, emissivity), sky=300.0, ground=380.0)


def test_a_bound_needs_a_temperature(court):
    with pytest.raises(InputError):
        largest_possible_change(court, sky_difference=np.nan, ground_difference=1.0, greatest_temperature=300.0)
