import numpy as np
import pytest

from sensorsim.thermal import ground_view_factor, quadrant_view_factors, sky_view_factor

NORTH, EAST, SOUTH, WEST = range(4)


def _normals(count: int, seed: int = 7) -> np.ndarray:
    vector = np.random.default_rng(seed).normal(size=(count, 3))
    return vector / np.linalg.norm(vector, axis=1, keepdims=True)


def _special_normals() -> np.ndarray:
    """Poles, the horizon, borders between quarters, and directions a hair off all of them."""
    steps = np.array([-1.0, 0.0, 1.0])
    cube = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
    cube = cube[np.any(cube != 0.0, axis=1)]
    azimuth = np.radians(np.arange(0.0, 360.0, 15.0))
    ring = np.stack([np.sin(azimuth), np.cos(azimuth), np.zeros_like(azimuth)], axis=1)
    up = np.array([0.0, 0.0, 1.0])
    exact = np.vstack([cube, ring, ring + 1e-9 * up, ring - 1e-9 * up, 0.2 * ring + up])
    near = exact + 1e-8 * np.random.default_rng(3).normal(size=exact.shape)
    both = np.vstack([exact, near])
    return both / np.linalg.norm(both, axis=1, keepdims=True)


NORMALS = {"random": _normals(2000), "special": _special_normals()}


@pytest.mark.parametrize("kind", NORMALS)
def test_quarters_of_the_sky_add_up_to_the_sky_and_the_sky_and_ground_to_one(kind: str) -> None:
    normal = NORMALS[kind]
    quarters = quadrant_view_factors(normal)
    np.testing.assert_allclose(quarters.sum(axis=1), sky_view_factor(normal), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(sky_view_factor(normal) + ground_view_factor(normal), 1.0, rtol=0.0, atol=1e-15)
    assert quarters.min() >= 0.0


def test_quarters_agree_with_rays_of_a_monte_carlo() -> None:
    """Expected: within four standard errors of 200,000 cosine-weighted rays, for nine normals."""
    normals, count = np.vstack([_normals(6, seed=11), np.eye(3)]), 200_000
    rng = np.random.default_rng(5)
    height = np.sqrt(rng.uniform(size=count))
    around = rng.uniform(0.0, 2.0 * np.pi, count)
    local = np.stack([np.sqrt(1.0 - height**2) * np.cos(around), np.sqrt(1.0 - height**2) * np.sin(around), height])
    exact = quadrant_view_factors(normals)
    for normal, factors in zip(normals, exact, strict=True):
        helper = np.array([1.0, 0.0, 0.0]) if abs(normal[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
        first = np.cross(normal, helper) / np.linalg.norm(np.cross(normal, helper))
        ray = np.stack([first, np.cross(normal, first), normal], axis=1) @ local
        azimuth = np.degrees(np.arctan2(ray[0], ray[1])) % 360.0
        quarter = np.where(ray[2] > 0.0, ((azimuth + 45.0) // 90.0).astype(int) % 4, -1)
        share = np.array([np.mean(quarter == index) for index in range(4)])
        error = np.sqrt(np.maximum(factors * (1.0 - factors), 1e-7) / count)
        assert np.all(np.abs(share - factors) < 4.0 * error + 1e-9)


def test_quarters_of_a_roof_are_equal_and_a_floor_sees_none() -> None:
    factors = quadrant_view_factors(np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]))
    np.testing.assert_allclose(factors, [[0.25] * 4, [0.0] * 4], rtol=0.0, atol=1e-15)


def test_a_wall_sees_the_quarter_before_it_most_and_the_one_behind_it_not_at_all() -> None:
    """A vertical wall's factor of the quarter that it faces is (1 + 1) / (4 sqrt(2)), by the contour integral."""
    factors = quadrant_view_factors(np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0]]))
    for row, front in zip(factors, (NORTH, EAST), strict=True):
        assert row[front] == pytest.approx(np.sqrt(2.0) / 4.0, abs=1e-12)
        assert row[(front + 2) % 4] == pytest.approx(0.0, abs=1e-15)
        assert row[(front + 1) % 4] == pytest.approx(row[(front - 1) % 4], abs=1e-12)


def test_turning_a_surface_by_a_right_angle_turns_its_quarters() -> None:
    normal = NORMALS["random"]
    turned = np.stack([normal[:, 1], -normal[:, 0], normal[:, 2]], axis=1)  # clockwise: north to east
    np.testing.assert_allclose(
        quadrant_view_factors(turned), np.roll(quadrant_view_factors(normal), 1, axis=1), rtol=0.0, atol=1e-12
    )


def test_mirroring_a_surface_in_the_meridian_swaps_east_and_west() -> None:
    normal = NORMALS["random"]
    mirrored = normal * [-1.0, 1.0, 1.0]
    swapped = quadrant_view_factors(normal)[:, [NORTH, WEST, SOUTH, EAST]]
    np.testing.assert_allclose(quadrant_view_factors(mirrored), swapped, rtol=0.0, atol=1e-12)


def test_a_surface_and_its_back_see_each_quarter_as_a_roof_weighs_it() -> None:
    """Cosines of both sides differ by a signed projection: F(n) - F(-n) is linear in n, here known at the axes."""
    normal = NORMALS["random"]
    difference = quadrant_view_factors(normal) - quadrant_view_factors(-normal)
    axes = quadrant_view_factors(np.eye(3)) - quadrant_view_factors(-np.eye(3))
    np.testing.assert_allclose(difference, normal @ axes, rtol=0.0, atol=1e-12)


def test_quarters_change_without_a_step_where_the_horizon_passes_a_corner() -> None:
    """Unit rotation changes a factor by at most pi / pi: small turns make small changes, also at special normals."""
    normal, turn = NORMALS["special"], 1e-7
    rng = np.random.default_rng(2)
    moved = normal + turn * rng.normal(size=normal.shape)
    moved /= np.linalg.norm(moved, axis=1, keepdims=True)
    step = np.linalg.norm(moved - normal, axis=1, keepdims=True)
    assert np.all(np.abs(quadrant_view_factors(moved) - quadrant_view_factors(normal)) <= 1.01 * step + 1e-12)
