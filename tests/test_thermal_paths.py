"""Studs and panels: parallel paths that add up by area, as transmittance, heat and radiation."""

import numpy as np
import pytest
from wall_cases import SIGMA, constant, indoors, outdoors, slab

from sensorsim.materials import Construction, ThermalPath, load_catalogue, load_construction
from sensorsim.thermal import Inside, Outside, march, march_paths, transmittance, wall_paths

STEP = 300.0
ABSORPTANCES = np.array([0.2, 0.8])
FILMS = (0.04, 0.13)  # surface resistances [m2 K W-1] [ISO6946]
WITH_PATHS = ("insulated_wood_studs", "uninsulated_wood_studs", "curtain_wall", "wood_floor")


def _day(count: int = 289) -> tuple[Outside, Inside]:
    angle = 2.0 * np.pi * np.arange(count) / 288.0
    outside = outdoors(
        268.0 - 5.0 * np.cos(angle), 15.0, sun=np.maximum(-600.0 * np.cos(angle), 0.0), sky=250.0, emissivity=0.9
    )
    return outside, indoors(constant(293.15, count), 3.1, emissivity=0.9)


@pytest.mark.parametrize("name", WITH_PATHS)
def test_transmittance_is_the_area_weighted_sum_of_the_paths(name: str) -> None:
    construction = load_construction(name)
    exact = 0.0
    for path in construction.paths:
        exact += path.fraction / (sum(FILMS) + sum(layer.thermal_resistance for layer in path.layers))
    assert transmittance(construction, *FILMS) == pytest.approx(exact, rel=1e-12)


def test_transmittance_of_a_wall_without_paths_is_one_over_its_resistances() -> None:
    for construction in (c for c in load_catalogue().constructions.values() if not c.paths):
        exact = 1.0 / (sum(FILMS) + construction.thermal_resistance)
        assert transmittance(construction, *FILMS) == pytest.approx(exact, rel=1e-12)


def test_studs_lead_heat_past_insulation_and_hinder_it_beside_air() -> None:
    """Wood conducts more than batt and less than an air space: a quarter more heat, an eighth less."""
    ratio = {
        name: transmittance(load_construction(f"{name}_studs"), *FILMS) / transmittance(load_construction(name), *FILMS)
        for name in ("insulated_wood", "uninsulated_wood")
    }
    assert ratio["insulated_wood"] == pytest.approx(1.248, abs=1e-3)
    assert ratio["uninsulated_wood"] == pytest.approx(0.878, abs=1e-3)


@pytest.mark.parametrize("name", WITH_PATHS)
def test_wall_radiates_and_conducts_what_its_paths_do_together(name: str) -> None:
    construction = load_construction(name)
    outside, inside = _day()
    record = np.arange(0, 289, 12)
    joined = march_paths(construction, outside, inside, ABSORPTANCES, step=STEP, record=record)
    glow, heat = 0.0, 0.0
    for path in construction.paths:
        alone = march(path.layers, outside, inside, ABSORPTANCES, step=STEP, record=record)
        glow = glow + path.fraction * SIGMA * alone.exterior**4
        heat = heat + path.fraction * alone.heat
    np.testing.assert_allclose(SIGMA * joined.exterior**4, glow, rtol=1e-12)
    np.testing.assert_allclose(joined.heat, heat, rtol=1e-12, atol=1e-6)
    assert np.abs(joined.heat.sum(axis=0) - joined.stored).max() < 1e-12 * 289 * STEP * 900.0


def test_steady_wall_of_paths_conducts_by_its_transmittance() -> None:
    """With films alone the heat through all paths is U times the difference of the airs."""
    construction = load_construction("insulated_wood_studs")
    count = 400
    outside = outdoors(constant(263.0, count), 1.0 / FILMS[0])
    inside = indoors(constant(293.0, count), 1.0 / FILMS[1])
    runs = [
        march_paths(construction, outside, inside, np.zeros(1), step=3600.0, record=np.array([last])).heat[1, 0, 0]
        for last in (count - 2, count - 1)
    ]
    flux = float(runs[1] - runs[0]) / 3600.0
    assert flux == pytest.approx(30.0 * transmittance(construction, *FILMS), rel=1e-6)


def test_paths_of_equal_layers_are_a_wall_without_paths() -> None:
    plain = load_construction("brick")
    halves = tuple(ThermalPath(name=name, fraction=0.5, layers=plain.layers) for name in ("left", "right"))
    split = Construction(name="split", description="", layers=plain.layers, source="", paths=halves)
    outside, inside = _day(100)
    runs = [
        march_paths(wall, outside, inside, ABSORPTANCES, step=STEP, record=np.arange(100)) for wall in (plain, split)
    ]
    np.testing.assert_allclose(runs[0].exterior, runs[1].exterior, rtol=1e-13)
    assert transmittance(split, *FILMS) == pytest.approx(transmittance(plain, *FILMS), rel=1e-13)


def test_a_wall_without_paths_is_marched_as_its_layers() -> None:
    outside, inside = _day(50)
    brick, record = load_construction("brick"), np.arange(50)
    by_wall = march_paths(brick, outside, inside, ABSORPTANCES, step=STEP, record=record, keep_nodes=True)
    by_layers = march(brick.layers, outside, inside, ABSORPTANCES, step=STEP, record=record, keep_nodes=True)
    np.testing.assert_array_equal(by_wall.exterior, by_layers.exterior)
    assert by_wall.nodes is not None
    assert by_layers.nodes is not None
    np.testing.assert_array_equal(by_wall.nodes, by_layers.nodes)


def test_nodes_are_those_of_the_widest_path() -> None:
    wall = load_construction("insulated_wood_studs")
    outside, inside = _day(50)
    history = march_paths(wall, outside, inside, ABSORPTANCES, step=STEP, record=np.arange(50), keep_nodes=True)
    widest = wall_paths(wall, STEP)[0]
    assert widest.fraction == 0.75
    assert widest.layers == wall.layers
    assert history.nodes is not None
    assert history.nodes.shape[1] == widest.grid.capacity.size == history.grid.capacity.size


def test_studs_show_on_a_cold_night_and_the_wall_lies_between() -> None:
    """Over wood that leads more heat the siding is warmer; the wall's own temperature lies between its paths'."""
    wall = load_construction("insulated_wood_studs")
    outside, inside = _day(289)
    studs, between = (
        march(path.layers, outside, inside, np.zeros(1), step=STEP, record=np.array([288])).exterior[0, 0, 0]
        for path in wall.paths
    )
    whole = march_paths(wall, outside, inside, np.zeros(1), step=STEP, record=np.array([288])).exterior[0, 0, 0]
    assert between < whole < studs
    assert 0.2 < studs - between < 2.0


def test_mean_by_fourth_power_misses_that_by_band_radiance_by_less_than_a_hundredth_of_a_kelvin() -> None:
    """8-14 um radiance goes with the fifth power or less; a quarter of studs 5 K warmer than the rest at 280 K."""
    share, kelvin = np.array([0.25, 0.75]), np.array([285.0, 280.0])
    means = [float((share @ kelvin**power) ** (1.0 / power)) for power in (4.0, 5.0)]
    assert abs(means[0] - means[1]) < 0.01


def test_a_layer_in_no_path_is_in_all() -> None:
    wall = load_construction("curtain_wall")
    assert [path.layers[0].name for path in wall.paths] == ["glass, 1/4 in", "glass, 1/4 in"]
    assert [len(path.layers) for path in wall.paths] == [1, 4]


def test_pipe_of_paths_takes_the_shape_along() -> None:
    paths = tuple(ThermalPath(name=str(k), fraction=0.5, layers=(slab(0.02, k, 500.0, 1000.0),)) for k in (0.05, 0.5))
    pipe = Construction(
        name="pipe", description="", layers=paths[0].layers, source="", paths=paths, shape="cylinder", radius=0.03
    )
    exact = sum(0.5 / (0.1 + 0.03 * np.log(3.0) / k + 0.1 * 3.0) for k in (0.05, 0.5))
    assert transmittance(pipe, 0.1, 0.1) == pytest.approx(exact, rel=1e-12)
