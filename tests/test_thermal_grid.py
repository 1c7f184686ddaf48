import numpy as np
import pytest
from wall_cases import gap, reference_walls, slab

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.materials import Layer, load_catalogue, load_construction
from sensorsim.thermal import WallGrid, build_grid
from sensorsim.thermal.grid import DAY_FRACTION, GROWTH, STEP_FRACTION


def _stacks() -> dict[str, tuple[Layer, ...]]:
    """Every construction that the package ships, and some that it does not."""
    materials = load_catalogue().materials.items()
    stacks = {f"material {code}": entry.construction.layers for code, entry in materials if not entry.mixture}
    stacks |= {name: load_construction(name).layers for name in ("brick", "steel_sheet", "insulated_wood")}
    stacks |= reference_walls()
    stacks["thick soil"] = (slab(10.0, 1.5, 2000.0, 900.0),)
    stacks["skin on batting"] = (slab(7e-4, 386.0, 8890.0, 385.0), slab(0.1, 0.04, 20.0, 900.0))
    stacks["gaps about"] = (gap(0.1), slab(0.05, 1.0, 2000.0, 900.0), gap(0.2), gap(0.1))
    return stacks


STACKS = _stacks()
STEPS = (1.0, 60.0, 300.0, 3600.0)


def _resistance(layers: tuple[Layer, ...]) -> float:
    return sum(layer.thermal_resistance for layer in layers)


@pytest.mark.parametrize("step", STEPS)
def test_cells_hold_exactly_the_layers_heat_and_resistance(step: float) -> None:
    for name, layers in STACKS.items():
        grid = build_grid(layers, step)
        assert grid.capacity.sum() == pytest.approx(sum(layer.areal_heat_capacity for layer in layers), rel=1e-12), name
        assert (1.0 / grid.conductance).sum() == pytest.approx(_resistance(layers), rel=1e-12), name
        assert grid.conductance.size == grid.capacity.size + 1, name
        assert np.all(grid.capacity > 0.0), name
        assert np.all(np.diff(grid.depth) > 0.0), name


@pytest.mark.parametrize("thickness", [0.1, 0.4, 10.0])
def test_cells_grow_from_both_faces_in_the_diffusive_coordinate_and_are_finer_for_shorter_steps(
    thickness: float,
) -> None:
    root, day = np.sqrt(1.0 / (2000.0 * 900.0)), np.sqrt(SECONDS_PER_DAY / np.pi)
    counts = []
    for step in STEPS:
        size = build_grid([slab(thickness, 1.0, 2000.0, 900.0)], step).capacity / (2000.0 * 900.0) / root  # [s^0.5]
        outer = np.concatenate([[0.0], np.cumsum(size)])
        inner = outer[-1] - outer
        finest, coarsest = min(STEP_FRACTION * np.sqrt(step), DAY_FRACTION * day), DAY_FRACTION * day
        assert np.all(size <= 1.000001 * np.minimum(finest + GROWTH * outer[1:], coarsest + GROWTH * inner[:-1]))
        assert np.sum(np.diff(np.sign(np.diff(size))) != 0) <= 2  # one largest cell, or two
        counts.append(size.size)
    assert counts == sorted(counts, reverse=True)
    assert counts[-1] <= np.log(thickness / root / (DAY_FRACTION * day)) * 2.0 / GROWTH + 1.0  # not with the thickness


def _same(one: WallGrid, other: WallGrid) -> None:
    for entry in ("capacity", "conductance", "depth"):
        np.testing.assert_allclose(getattr(one, entry), getattr(other, entry), rtol=1e-12)


def test_layers_of_no_thickness_are_dropped_wherever_they_stand() -> None:
    board, brick, none = slab(0.02, 0.16, 800.0, 1090.0), slab(0.1, 0.9, 1900.0, 800.0), slab(0.0, 5.0, 1.0, 1.0)
    plain = build_grid([board, brick], 300.0)
    for layers in ([none, board, brick], [board, none, brick], [board, brick, none], [none, board, none, none, brick]):
        _same(build_grid(layers, 300.0), plain)


def test_layer_without_capacity_counts_as_its_resistance_and_keeps_its_depth() -> None:
    massless = slab(0.03, 0.06, 0.0, 1000.0)
    board = slab(0.02, 0.16, 800.0, 1090.0)
    grid, plain = build_grid([massless, board], 300.0), build_grid([gap(0.5), board], 300.0)
    np.testing.assert_allclose(grid.conductance, plain.conductance, rtol=1e-12)
    np.testing.assert_allclose(grid.depth, plain.depth + 0.03, rtol=1e-12)


def test_resistance_lies_where_its_layer_lies() -> None:
    board = slab(0.02, 0.16, 800.0, 1090.0)
    bare = 1.0 / build_grid([board], 300.0).conductance
    for layers, where in (([gap(0.3), board], 0), ([board, gap(0.3)], -1)):
        with_gap = 1.0 / build_grid(layers, 300.0).conductance
        bare_too = bare.copy()
        bare_too[where] += 0.3
        np.testing.assert_allclose(with_gap, bare_too, rtol=1e-12)


def test_wall_of_resistances_has_no_cells() -> None:
    grid = build_grid([gap(0.1), gap(0.3)], 300.0)
    assert grid.capacity.size == 0
    np.testing.assert_allclose(grid.conductance, [2.5], rtol=1e-12)


def test_finer_settings_refine_everywhere() -> None:
    layers = STACKS["brick"]
    coarse = build_grid(layers, 300.0)
    fine = build_grid(layers, 300.0, cell_size=0.5)
    assert fine.capacity.size >= 2 * coarse.capacity.size - len(layers)
    assert fine.capacity.max() < 0.6 * coarse.capacity.max()
