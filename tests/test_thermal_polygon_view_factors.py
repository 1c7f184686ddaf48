"""View factors between polygons: closed forms, the laws they must obey, limits, and an independent code's numbers."""

import itertools

import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.thermal.polygon_view_factors import (
    mutual_areas,
    outlines_of_mesh,
    outlines_of_polygons,
    polygon_view_factor,
    view_factor_matrix,
)
from sensorsim.thermal.view_factors import _polygon_view_factor as factor_of_spherical_polygon

RATIOS = (0.01, 0.1, 1.0, 10.0, 100.0)


def rectangle(corner, first, second):
    """Front side where first x second points."""
    corner, first, second = (np.asarray(vector, dtype=np.float64) for vector in (corner, first, second))
    return np.array([corner, corner + first, corner + first + second, corner + second])


def any_rotation(seed):
    turn = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    return turn * np.sign(np.linalg.det(turn))


def facing_rectangles(x, y):
    """[Howell2010] C-11: equal rectangles x by y, a unit apart."""
    p, q = 1.0 + x * x, 1.0 + y * y
    logarithm = 0.5 * np.log(p * q / (p + q - 1.0))
    sides = x * np.sqrt(q) * np.arctan(x / np.sqrt(q)) + y * np.sqrt(p) * np.arctan(y / np.sqrt(p))
    return 2.0 / (np.pi * x * y) * (logarithm + sides - x * np.arctan(x) - y * np.arctan(y))


def hinged_rectangles(h, w):
    """[Howell2010] C-14: from a floor w deep to a wall h high, along a common edge of unit length."""
    h2, w2 = h * h, w * w
    both = np.sqrt(h2 + w2)
    angles = w * np.arctan(1.0 / w) + h * np.arctan(1.0 / h) - both * np.arctan(1.0 / both)
    total = 1.0 + h2 + w2
    logarithm = np.log((1.0 + w2) * (1.0 + h2) / total)
    logarithm += w2 * np.log(w2 * total / ((1.0 + w2) * (w2 + h2))) + h2 * np.log(h2 * total / ((1.0 + h2) * (h2 + w2)))
    return (angles + 0.25 * logarithm) / (np.pi * w)


def facing_disks(first, second, apart):
    """[Howell2010] C-41: coaxial disks of two radii."""
    a, b = first / apart, second / apart
    x = 1.0 + (1.0 + b * b) / (a * a)
    return 0.5 * (x - np.sqrt(x * x - 4.0 * (b / a) ** 2))


@pytest.mark.parametrize(("x", "y"), list(itertools.product(RATIOS, RATIOS)))
def test_facing_rectangles_meet_the_closed_form(x, y):
    below = rectangle((0, 0, 0), (x, 0, 0), (0, y, 0))
    above = rectangle((0, 0, 1), (0, y, 0), (x, 0, 0))
    found = polygon_view_factor(below, above)
    assert found == pytest.approx(facing_rectangles(x, y), abs=2e-12)  # the closed form's own rounding at x = 0.01


@pytest.mark.parametrize(("h", "w"), list(itertools.product(RATIOS, RATIOS)))
def test_rectangles_with_a_common_edge_meet_the_closed_form(h, w):
    floor = rectangle((0, 0, 0), (w, 0, 0), (0, 1, 0))
    wall = rectangle((0, 0, 0), (0, 1, 0), (0, 0, h))
    found = polygon_view_factor(floor, wall)
    assert found == pytest.approx(hinged_rectangles(h, w), abs=5e-11)  # the closed form's own rounding at h / w = 1e4


def test_many_sided_polygons_tend_to_the_closed_form_of_disks():
    errors = []
    for sides in (16, 32, 64):
        angle = 2.0 * np.pi * np.arange(sides) / sides
        circle = np.column_stack((np.cos(angle), np.sin(angle), np.zeros(sides)))
        circle *= np.sqrt(2.0 * np.pi / (sides * np.sin(2.0 * np.pi / sides)))  # the disk's own area
        above = (0.7 * circle + (0.0, 0.0, 0.9))[::-1]
        errors.append(abs(polygon_view_factor(circle, above) - facing_disks(1.0, 0.7, 0.9)))
    assert errors[2] < 1e-6
    assert errors[0] > 3.5 * errors[1] > 12.0 * errors[2]  # second order or better in the number of sides


@pytest.mark.parametrize("seed", range(8))
def test_exchange_is_reciprocal(seed):
    draw = np.random.default_rng(seed)
    polygons = [draw.normal(size=3) * 2 + rectangle((0, 0, 0), *any_rotation(seed * 100 + k)[:2]) for k in range(12)]
    polygons[0] = polygons[0] * 7.0
    for first, second in itertools.combinations(polygons, 2):
        forth = polygon_view_factor(first, second) * outlines_of_polygons([first]).area[0]
        back = polygon_view_factor(second, first) * outlines_of_polygons([second]).area[0]
        assert forth == pytest.approx(back, abs=1e-12)


@pytest.mark.parametrize("seed", range(6))
def test_factors_within_a_closed_box_add_up_to_one(seed):
    edges = np.random.default_rng(seed).normal(size=(3, 3)) * (0.05, 1.0, 20.0)[seed % 3]
    edges *= np.sign(np.linalg.det(edges))
    faces = []
    for a, b, c in (np.roll(edges, -k, axis=0) for k in range(3)):
        faces += [rectangle((0, 0, 0), a, b), rectangle(c, b, a)]
    np.testing.assert_allclose(view_factor_matrix(faces).sum(axis=1), 1.0, atol=1e-12)


def test_factors_within_a_flat_tetrahedron_add_up_to_one():
    corners = np.array([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.3, 0.9, 0.0), (0.4, 0.3, 1e-3)])
    faces = [corners[[0, 1, 2]], corners[[0, 3, 1]], corners[[1, 3, 2]], corners[[2, 3, 0]]]
    np.testing.assert_allclose(view_factor_matrix(faces).sum(axis=1), 1.0, atol=1e-8)


def test_a_concave_room_is_closed_too_where_nothing_stands_between():
    """The ceiling of an L-shaped room sees floor and walls, though not all at once from the walls' side."""
    plan = np.array([(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (0, 2)], dtype=np.float64)
    floor = np.column_stack((plan, np.zeros(6)))
    ceiling = np.column_stack((plan, np.full(6, 1.3)))[::-1]
    convex_parts = [rectangle((0, 0, 0), (3, 0, 0), (0, 1, 0)), rectangle((0, 1, 0), (1, 0, 0), (0, 1, 0))]
    areas = np.array([3.0, 1.0])
    whole = polygon_view_factor(floor, ceiling)
    assert whole == pytest.approx(sum(areas * [polygon_view_factor(part, ceiling) for part in convex_parts]) / 4.0)


SKEW = [(0, 0, 0), (2, 0, 0), (2.5, 1, 0), (0.5, 1, 0)]
SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
TRIANGLE = [(0, 0, 0), (2, 0, 0), (0.5, 1.5, 0)]
# What pyviewfactor 1.1.0 (its semi-analytic kernel) answered for first to second and second to first. It keeps outlines
# with a common edge or corner apart only to about 1e-7 (0.20004386856510523 for C-14 at 1, 1: exact 0.200043776075403).
PEER = [
    (SQUARE, [(0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1)], 0.19982489569838724, 0.19982489569838724, 1e-14),
    (
        TRIANGLE,
        [(0.2, 0.1, 1), (0.4, 1.2, 1.3), (1.6, 1.1, 1), (1.4, 0, 0.7)],
        0.22739147875852742,
        0.2375314470752,
        1e-13,
    ),
    (SQUARE, [(8, 3, 6), (8, 4, 6), (8, 4, 5), (8, 3, 5)], 0.0014360866740328999, 0.0014360866740329705, 1e-14),
    (SKEW, [(0, 0, 0), (-0.5, 0.3, 1.1), (1.5, 0.3, 1.1), (2, 0, 0)], 0.31439077370859203, 0.2757389430127947, 3e-7),
    (SQUARE, [(1, 1, 0), (2, 1, 0), (2, 0.4, 1), (1, 0.4, 1)], 0.06715783847129166, 0.05758736761642514, 1e-7),
]


@pytest.mark.parametrize(("first", "second", "forth", "back", "tolerance"), PEER)
def test_an_independent_code_agrees(first, second, forth, back, tolerance):
    first, second = np.array(first, dtype=np.float64), np.array(second, dtype=np.float64)
    assert polygon_view_factor(first, second) == pytest.approx(forth, abs=tolerance)
    assert polygon_view_factor(second, first) == pytest.approx(back, abs=tolerance)


@pytest.mark.parametrize("cut", [0.001, 0.3, 0.5])
def test_factors_of_the_parts_of_a_surface_add_up(cut):
    turn = any_rotation(3)
    first = rectangle((0, 0, 0), (1, 0, 0), (0, 1, 0))
    second = rectangle((1, 0, 0), (0, 1, 0), (-0.4, 0, 0.8))[::-1]
    one, two = second[1] + cut * (second[0] - second[1]), second[2] + cut * (second[3] - second[2])
    parts = [np.array([second[0], one, two, second[3]]), np.array([one, second[1], second[2], two])]
    whole = polygon_view_factor(first @ turn.T, second @ turn.T)
    assert whole > 0.1
    assert sum(polygon_view_factor(first @ turn.T, part @ turn.T) for part in parts) == pytest.approx(whole, abs=1e-13)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e7])
def test_size_place_and_attitude_do_not_matter(scale):
    first = rectangle((0, 0, 0), (1, 0, 0), (0, 2, 0))
    second = rectangle((0.5, 1, 0.3), (0, 1, 0.2), (1, 0, 0))[::-1][[1, 2, 3, 0]]
    plain = polygon_view_factor(first, second[::-1])
    turn, shift = scale * any_rotation(5).T, scale * np.array([10.0, -20.0, 30.0])
    assert plain > 0.1
    assert polygon_view_factor(first @ turn + shift, second[::-1] @ turn + shift) == pytest.approx(plain, abs=1e-13)


@pytest.mark.parametrize("distance", [30.0, 300.0, 3000.0])
def test_far_surfaces_follow_the_inverse_square(distance):
    towards = np.array([0.48, 0.6, 0.64])
    turn = any_rotation(11)
    turn *= np.sign(turn[2] @ towards)  # the front must look back
    first = rectangle((-0.5, -0.5, 0), (1, 0, 0), (0, 1, 0))
    second = distance * towards + rectangle(-0.5 * (turn[0] + turn[1]), turn[0], turn[1])
    normal = np.cross(turn[0], turn[1])
    if normal @ towards > 0.0:
        second, normal = second[::-1], -normal
    limit = towards[2] * -(normal @ towards) / (np.pi * distance**2)
    assert polygon_view_factor(first, second) == pytest.approx(limit, rel=2.0 / distance**2 + 1e-8)


def test_a_small_surface_meets_the_closed_form_of_a_point():
    polygon = np.array([(1.0, -1.0, 0.4), (1.0, 2.0, 0.4), (2.0, 2.0, 3.0), (2.0, -1.0, 3.0)])
    directions = polygon / np.linalg.norm(polygon, axis=1, keepdims=True)
    up = np.array([(0.0, 0.0, 1.0)])
    expected = max(factor_of_spherical_polygon(way, up)[0] for way in (directions, directions[::-1]))
    small = 1e-3 * rectangle((-0.5, -0.5, 0), (1, 0, 0), (0, 1, 0))
    found = max(polygon_view_factor(small, polygon), polygon_view_factor(small, polygon[::-1]))
    assert expected > 0.05
    assert found == pytest.approx(expected, rel=1e-6)


def test_the_integral_over_points_is_the_factor():
    """Eq. 5 with the point's closed form inside and a Gauss rule outside, by way of another module."""
    wall = np.array([(1.5, 0.0, 0.0), (1.5, 1.0, 0.0), (1.5, 1.0, 2.0), (1.5, 0.0, 2.0)])[::-1]
    node, weight = np.polynomial.legendre.leggauss(12)
    total = 0.0
    for (x, a), (y, b) in itertools.product(zip(node, weight, strict=True), repeat=2):
        sight = wall - (0.5 + 0.5 * x, 0.5 + 0.5 * y, 0.0)
        sight /= np.linalg.norm(sight, axis=1, keepdims=True)
        total += 0.25 * a * b * factor_of_spherical_polygon(sight[::-1], np.array([(0.0, 0.0, 1.0)]))[0]
    assert polygon_view_factor(rectangle((0, 0, 0), (1, 0, 0), (0, 1, 0)), wall) == pytest.approx(total, abs=1e-9)


def test_what_lies_behind_a_surface_is_not_seen():
    floor = rectangle((0, 0, 0), (1, 0, 0), (0, 1, 0))
    wall = rectangle((1.2, 0, 0), (0, 0, 1), (0, 1, 0))
    sunk = rectangle((1.2, 0, -5), (0, 0, 6), (0, 1, 0))
    assert polygon_view_factor(floor, wall) > 0.05
    assert polygon_view_factor(floor, sunk) == pytest.approx(polygon_view_factor(floor, wall), abs=1e-14)
    assert polygon_view_factor(floor, wall[::-1]) == 0.0
    assert polygon_view_factor(floor, wall - (0, 0, 1)) == 0.0
    assert polygon_view_factor(floor, floor + np.array((3, 0, 0))) == 0.0  # in one plane


def test_surfaces_that_cross_each_other_count_what_stands_in_front():
    """A floor that runs through below a wall, and a wall through the floor: only the front quarter of each matters."""
    floor = rectangle((-1, 0, 0), (3, 0, 0), (0, 1, 0))
    wall = rectangle((0, 0, -1), (0, 1, 0), (0, 0, 2.5))
    front, upper = rectangle((0, 0, 0), (2, 0, 0), (0, 1, 0)), rectangle((0, 0, 0), (0, 1, 0), (0, 0, 1.5))
    assert 3.0 * polygon_view_factor(floor, wall) == pytest.approx(2.0 * polygon_view_factor(front, upper), abs=1e-14)


@pytest.mark.parametrize("tilt", [1e-3, 1e-6, 1e-9, 1e-12])
def test_nearly_parallel_edges_do_not_spoil_the_sum(tilt):
    """A box out of square by a hair is still closed, whichever formula its edges call for."""
    corners = np.array(list(itertools.product((0.0, 1.0), repeat=3)))
    corners[:, 0] += tilt * corners[:, 2]
    corners[:, 1] += 2.0 * tilt * corners[:, 0]
    faces = [(0, 2, 6, 4), (1, 5, 7, 3), (0, 4, 5, 1), (2, 3, 7, 6), (0, 1, 3, 2), (4, 6, 7, 5)]
    inward = [corners[list(face)] for face in faces]
    middle = corners.mean(axis=0)
    fronts = outlines_of_polygons(inward)
    looks_in = np.sum(fronts.normal * (middle - fronts.centre), axis=1) > 0.0
    inward = [face if good else face[::-1] for face, good in zip(inward, looks_in, strict=True)]
    np.testing.assert_allclose(view_factor_matrix(inward).sum(axis=1), 1.0, atol=1e-10)


def test_a_window_in_a_wall_is_a_hole():
    """The outline of a mesh with a hole sees what the wall less the window sees."""
    outer, inner = rectangle((0, 2, 0), (4, 0, 0), (0, 0, 3)), rectangle((1, 2, 1), (1, 0, 0), (0, 0, 1))
    floor = rectangle((0, 0, 0), (4, 0, 0), (0, 2, 0))
    position = np.concatenate((outer, inner, floor))
    ring = [(a, b, 4 + a) for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))]
    ring += [(b, 4 + b, 4 + a) for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))]
    triangle = np.array([*ring, (8, 9, 10), (8, 10, 11)], dtype=np.int32)
    outlines = outlines_of_mesh(position, triangle, np.repeat([0, 1], (8, 4)).astype(np.int32))
    np.testing.assert_allclose(outlines.area, (11.0, 8.0))
    np.testing.assert_array_equal(np.diff(outlines.start), (8, 4))
    found = mutual_areas(outlines, np.array([1]), np.array([0]))[0] / 8.0
    assert found == pytest.approx(polygon_view_factor(floor, outer) - polygon_view_factor(floor, inner), abs=1e-14)


@pytest.mark.parametrize(
    "polygon",
    [
        [(0, 0, 0), (1, 0, 0)],
        [(0, 0, 0), (1, 0, 0), (2, 0, 0)],
        [(0, 0, 0), (1, 0, 0), (1, 1, 0.1), (0, 1, 0)],
        [(0, 0, 0), (1, 0, 0), (np.nan, 1, 0)],
        [(0, 0, 0), (1, 0, 0), (np.inf, 1, 0)],
        [(0, 0), (1, 0), (1, 1)],
    ],
)
def test_what_is_no_plane_polygon_is_refused(polygon):
    with pytest.raises(InputError, match="polygon 1"):
        polygon_view_factor(rectangle((0, 0, 0), (1, 0, 0), (0, 1, 0)), np.array(polygon, dtype=np.float64))
