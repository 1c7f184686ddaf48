import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.tables import LAYOUTS, OrientationSet, orientation_set

SETS = [name for name in LAYOUTS if name != "icosphere2562"]


def _directions(count: int, seed: int = 12) -> np.ndarray:
    vector = np.random.default_rng(seed).normal(size=(count, 3))
    return vector / np.linalg.norm(vector, axis=1, keepdims=True)


def _dense(layout: OrientationSet, normal: np.ndarray) -> np.ndarray:
    """Weights of all orientations (m, o)."""
    corner, weight = layout.locate(normal)
    dense = np.zeros((normal.shape[0], layout.normal.shape[0]))
    np.add.at(dense, (np.arange(normal.shape[0])[:, None], corner), weight)
    return dense


@pytest.mark.parametrize("name", LAYOUTS)
def test_layout_has_the_count_it_is_named_for_and_its_triangles_close_the_sphere(name: str) -> None:
    """Rationale: Euler's formula and solid angle. Expected: 2 n - 4 triangles that cover 4 pi, wound outward."""
    layout = orientation_set(name)
    count = int("".join(filter(str.isdigit, name)))
    assert layout.normal.shape == (count, 3)
    np.testing.assert_allclose(np.linalg.norm(layout.normal, axis=1), 1.0, rtol=0.0, atol=1e-14)
    assert layout.triangle.shape == (2 * count - 4, 3)
    a, b, c = np.moveaxis(layout.normal[layout.triangle], 1, 0)
    volume = np.sum(a * np.cross(b, c), axis=1)
    assert volume.min() > 0.0
    cosines = 1.0 + np.sum(a * b, axis=1) + np.sum(b * c, axis=1) + np.sum(c * a, axis=1)
    assert (2.0 * np.arctan2(volume, cosines)).sum() == pytest.approx(4.0 * np.pi, rel=1e-12)


@pytest.mark.parametrize("name", SETS)
def test_layout_holds_both_poles_and_every_edge_twice(name: str) -> None:
    layout = orientation_set(name)
    for pole in ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]):
        assert np.abs(layout.normal - pole).sum(axis=1).min() < 1e-12
    edges = np.sort(layout.triangle[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    assert np.all(np.unique(edges, axis=0, return_counts=True)[1] == 2)


@pytest.mark.parametrize("name", LAYOUTS)
def test_weights_are_shares_that_give_the_direction_back(name: str) -> None:
    layout, normal = orientation_set(name), _directions(5000 if name != "icosphere2562" else 500)
    corner, weight = layout.locate(normal)
    assert weight.min() >= 0.0
    np.testing.assert_allclose(weight.sum(axis=1), 1.0, rtol=0.0, atol=1e-14)
    blend = np.einsum("mk,mki->mi", weight, layout.normal[corner])
    blend /= np.linalg.norm(blend, axis=1, keepdims=True)
    np.testing.assert_allclose(blend, normal, rtol=0.0, atol=1e-12)
    known = {tuple(row) for row in np.sort(layout.triangle, axis=1).tolist()}
    assert {tuple(row) for row in np.sort(corner, axis=1).tolist()} <= known


@pytest.mark.parametrize("name", SETS)
def test_a_standard_orientation_is_itself_alone(name: str) -> None:
    layout = orientation_set(name)
    np.testing.assert_allclose(_dense(layout, layout.normal), np.eye(layout.normal.shape[0]), rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("name", SETS)
def test_between_two_corners_only_those_two_count(name: str) -> None:
    layout = orientation_set(name)
    first, second = layout.normal[layout.triangle[:, 0]], layout.normal[layout.triangle[:, 1]]
    middle = (first + second) / np.linalg.norm(first + second, axis=1, keepdims=True)
    dense = _dense(layout, middle)
    rows = np.arange(middle.shape[0])
    pair = dense[rows, layout.triangle[:, 0]], dense[rows, layout.triangle[:, 1]]
    np.testing.assert_allclose(pair, 0.5, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("name", SETS)
def test_weights_are_continuous_across_every_edge(name: str) -> None:
    """Expected: a step of 1e-7 across an edge changes no weight by more than the set's finest spacing allows."""
    layout, rng = orientation_set(name), np.random.default_rng(6)
    share = rng.uniform(0.05, 0.95, (layout.triangle.shape[0], 1))
    on_edge = share * layout.normal[layout.triangle[:, 0]] + (1.0 - share) * layout.normal[layout.triangle[:, 1]]
    on_edge /= np.linalg.norm(on_edge, axis=1, keepdims=True)
    inward = layout.normal[layout.triangle[:, 2]] - on_edge
    step = 1e-7 * inward / np.linalg.norm(inward, axis=1, keepdims=True)
    here, there = _dense(layout, on_edge + step), _dense(layout, on_edge - step)
    assert np.abs(here - there).max() < 1e-4


@pytest.mark.parametrize("name", ["icosphere42", "octahedron66"])
def test_weights_do_not_depend_on_what_is_located_with_them(name: str) -> None:
    """Nor where triangles meet, as for upright walls among octahedral orientations."""
    layout, normal = orientation_set(name), _directions(1500)
    normal[::100, 2] = 0.0
    together = layout.locate(normal)
    alone = [layout.locate(normal[row : row + 1]) for row in range(0, 1500, 50)]
    np.testing.assert_array_equal(together[0][::50], np.concatenate([corner for corner, _ in alone]))
    np.testing.assert_array_equal(together[1][::50], np.concatenate([weight for _, weight in alone]))


def test_report_sets_are_the_cubes_directions_and_the_eight_azimuths() -> None:
    twenty_six = {tuple(np.sign(np.round(row, 9)).astype(int)) for row in orientation_set("report26").normal}
    assert len(twenty_six) == 26
    azimuth = np.radians(45.0 * np.arange(8))
    walls = np.stack([np.sin(azimuth), np.cos(azimuth), np.zeros(8)], axis=1)
    for name in ("report10", "report26"):
        distance = np.abs(walls[:, None] - orientation_set(name).normal[None]).sum(axis=2)
        assert distance.min(axis=1).max() < 1e-12


def test_unknown_layout_is_refused_with_those_that_are_known() -> None:
    with pytest.raises(InputError, match=r"orientations = 'cube'.*report10.*icosphere2562"):
        orientation_set("cube")
