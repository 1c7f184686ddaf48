"""Cases in which a careless solver rings, divides by zero or runs away: thermal skins, gaps, films, bare radiation."""

import numpy as np
import pytest
from wall_cases import DARK, SIGMA, FloatArray, constant, gap, indoors, outdoors, reference_walls, slab, uniform_grid

from sensorsim.errors import NumericsError
from sensorsim.thermal import build_grid, march

STEEL = slab(0.0015, 45.28, 7824.0, 500.0, name="steel sheet")
COPPER = slab(0.0007, 386.0, 8890.0, 385.0, name="copper sheet")
BATTING = slab(0.09, 0.0458, 19.0, 960.0, name="batting")
BLOCK = slab(0.2, 1.11, 800.0, 920.0, name="block")
STEPS = [1.0, 60.0, 600.0, 3600.0]


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("layers", [[STEEL], [COPPER], [COPPER, BATTING], [STEEL, BLOCK]])
def test_metal_skin_answers_a_step_of_sun_without_overshoot(layers: list, step: float) -> None:
    """Rationale: Fourier number up to 5e5, where Crank-Nicolson rings for hours. Expected: monotone to 1e-6 K."""
    count = 400
    sun = np.where(np.arange(count) < 100, 0.0, 800.0)
    history = march(
        layers,
        outdoors(constant(280.0, count), 12.0, sun=sun, sky=280.0, emissivity=0.9),
        indoors(constant(280.0, count), 3.0),
        np.array([0.7]),
        step=step,
        record=np.arange(99, count),
    )
    face = history.exterior[:, 0, 0]
    assert face[0] == pytest.approx(280.0, abs=1e-9)
    assert np.diff(face).min() > -1e-6
    assert face[-1] > 281.0


@pytest.mark.parametrize("layers", [[STEEL], [COPPER, BATTING], [BLOCK, BATTING]])
def test_without_sources_no_face_leaves_the_range_met_so_far(layers: list) -> None:
    """Rationale: maximum principle. Expected: at any step length, to 1e-6 K, with air and sky that jump."""
    rng = np.random.default_rng(4)
    air, sky = rng.uniform(270.0, 300.0, 200), rng.uniform(270.0, 300.0, 200)
    for step in STEPS:
        history = march(
            layers, outdoors(air, 15.0, sky=sky, emissivity=0.9), indoors(constant(285.0, 200), 8.0), DARK,
            step=step, record=np.arange(1, 200), keep_nodes=True,
        )  # fmt: skip
        assert history.nodes is not None
        seen = np.concatenate([history.exterior.ravel(), history.interior.ravel(), history.nodes.ravel()])
        assert seen.min() > min(air.min(), sky.min()) - 1e-6
        assert seen.max() < max(air.max(), sky.max()) + 1e-6


@pytest.mark.parametrize("place", ["between", "outermost", "innermost", "doubled"])
def test_gap_without_capacity_is_the_limit_of_one_with_hardly_any(place: str) -> None:
    board, light = slab(0.02, 0.16, 800.0, 1090.0), slab(0.01, 0.05, 1e-6, 1e-3)  # rho c of 1e-9
    order = {
        "between": lambda air: [board, air, board],
        "outermost": lambda air: [air, board],
        "innermost": lambda air: [board, air],
        "doubled": lambda air: [board, air, air, board],
    }[place]
    count = 200
    morning = 0.5 + 0.5 * np.tanh((np.arange(count) - 120.0) / 30.0)
    outside = outdoors(280.0 + 10.0 * morning, 15.0, sun=400.0 * morning, sky=280.0, emissivity=0.9)
    inside = indoors(constant(280.0, count), 5.0)

    def faces(layers: list, cells: list[int]) -> FloatArray:
        history = march(
            layers, outside, inside, np.array([0.7]), step=600.0, record=np.arange(60, count),
            grid=uniform_grid(layers, cells),
        )  # fmt: skip
        return np.stack([history.exterior, history.interior])

    pure, hardly = order(gap(0.2)), order(light)
    counts = [8 if layer is board else 4 for layer in pure]
    np.testing.assert_allclose(faces(pure, counts), faces(hardly, counts), rtol=0.0, atol=1e-6)


def test_wall_of_resistances_alone_is_in_balance_at_every_moment() -> None:
    count = 50
    air = 280.0 + 10.0 * np.sin(np.arange(count))
    history = march(
        [gap(0.1), gap(0.3)], outdoors(air, 15.0, sun=200.0), indoors(constant(290.0, count), 5.0), np.ones(1),
        step=300.0, record=np.arange(1, count),
    )  # fmt: skip
    inward = 1.0 / (0.4 + 1.0 / 5.0)
    exact = (15.0 * air[1:] + 200.0 + inward * 290.0) / (15.0 + inward)
    np.testing.assert_allclose(history.exterior[:, 0, 0], exact, rtol=0.0, atol=1e-9)
    assert np.abs(history.stored).max() == 0.0
    assert np.abs(history.heat.sum(axis=0)).max() < 1e-6


@pytest.mark.parametrize("film", [1e3, 1e4, 1e6])
def test_strong_film_holds_the_face_at_the_air(film: float) -> None:
    """Expected: within flux over film."""
    count = 100
    air = 280.0 + 10.0 * np.sin(np.arange(count) / 5.0)
    history = march(
        [BLOCK], outdoors(air, film, sun=500.0), indoors(constant(290.0, count), 5.0), np.ones(1),
        step=300.0, record=np.arange(1, count), keep_nodes=True,
    )  # fmt: skip
    assert history.nodes is not None
    flux = 500.0 + history.grid.conductance[0] * np.abs(history.nodes[:, 0] - history.exterior)
    assert np.all(np.abs(history.exterior[:, 0, 0] - air[1:]) <= flux[:, 0, 0] / film + 1e-7)


def test_film_may_jump_from_still_air_to_a_gale_and_back() -> None:
    count = 120
    film = np.where(np.arange(count) // 20 % 2 == 0, 0.0, 5e3)
    history = march(
        [STEEL], outdoors(constant(280.0, count), film, sun=100.0, free=2.2), indoors(constant(280.0, count), 0.0),
        np.ones(1), step=300.0, record=np.arange(1, count),
    )  # fmt: skip
    assert history.exterior.min() >= 280.0 - 1e-9
    still = (100.0 / 2.2 ** (1.0 / 3.0)) ** 0.75  # 100 W m-2 carried off by free convection alone
    assert history.exterior.max() < 280.0 + still + 1e-6


def test_still_air_at_the_temperature_of_the_wall_and_then_not() -> None:
    """The free film vanishes for hours and must come back."""
    air = np.where(np.arange(400) < 200, 290.0, 310.0)
    history = march(
        [STEEL], outdoors(air, 0.0, free=2.2), indoors(constant(290.0, 400), 0.0), DARK,
        step=300.0, record=np.array([199, 399]),
    )  # fmt: skip
    assert history.exterior[0, 0, 0] == pytest.approx(290.0, abs=1e-9)
    assert 300.0 < history.exterior[1, 0, 0] < 310.0


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("sky", [0.0, 200.0])
def test_plate_that_only_radiates_never_passes_below_the_sky(sky: float, step: float) -> None:
    count = 2000 if step < 60.0 else round(3.0 * 86400.0 / step)
    history = march(
        [STEEL], outdoors(constant(300.0, count), 0.0, sky=sky, emissivity=0.98), indoors(constant(300.0, count), 0.0),
        DARK, step=step, record=np.arange(count),
    )  # fmt: skip
    face = history.exterior[:, 0, 0]
    assert face.min() > sky - 1e-6
    assert np.diff(face).max() < 1e-7


def test_newton_finds_the_face_from_a_hundred_kelvin_off() -> None:
    """The march starts its faces at the air; here sun and sky put them far from it."""
    count = 4
    for sun, sky in ((4000.0, 400.0), (0.0, 100.0)):
        history = march(
            [gap(1e6)], outdoors(constant(250.0, count), 0.0, sun=sun, sky=sky, emissivity=0.9),
            indoors(constant(250.0, count), 1.0), np.ones(1), step=60.0, record=np.array([1, 3]),
        )  # fmt: skip
        exact = (sun / (0.9 * SIGMA) + sky**4) ** 0.25
        assert history.exterior[-1, 0, 0] == pytest.approx(exact, abs=1e-3)


def test_wall_closed_on_both_sides_keeps_its_heat() -> None:
    count, layers = 2000, reference_walls()["wood_insulated"]
    grid = build_grid(layers, 300.0)
    start = 280.0 + 20.0 * np.random.default_rng(1).uniform(size=grid.capacity.size)
    history = march(
        layers, outdoors(constant(280.0, count), 0.0), indoors(constant(280.0, count), 0.0), DARK,
        step=300.0, record=np.array([count - 1]), grid=grid, start=start, keep_nodes=True,
    )  # fmt: skip
    assert history.nodes is not None
    mean = float(grid.capacity @ start / grid.capacity.sum())
    np.testing.assert_allclose(history.nodes[0, :, 0, 0], mean, rtol=0.0, atol=1e-5)
    assert grid.capacity @ history.nodes[0, :, 0, 0] == pytest.approx(grid.capacity @ start, rel=1e-8)


def test_neighbours_of_unlike_conductivity_share_one_flux() -> None:
    """Ratios of 1e-6 to 1e9: the steady flux is that of the resistances in series."""
    for better, worse in ((386.0, 0.0386), (1e3, 1e-6), (1e-3, 1e3)):
        layers, count = [slab(0.01, better, 1000.0, 1000.0), slab(0.01, worse, 1000.0, 1000.0)], 4000
        history = march(
            layers, outdoors(constant(300.0, count), 20.0), indoors(constant(280.0, count), 8.0), DARK,
            step=3600.0, record=np.array([count - 1]), grid=uniform_grid(layers, [5, 5]),
        )  # fmt: skip
        resistance = 1.0 / 20.0 + 0.01 / better + 0.01 / worse + 1.0 / 8.0
        through = 8.0 * (history.interior[0, 0, 0] - 280.0)
        assert through == pytest.approx(20.0 / resistance, rel=1e-6, abs=1e-7)


def test_thinnest_and_thickest_layers_are_solved_together() -> None:
    count = 300
    layers = [slab(1e-9, 0.2, 1000.0, 1000.0), slab(10.0, 1.5, 2000.0, 900.0), slab(0.0, 1.0, 1.0, 1.0)]
    plain = [slab(10.0, 1.5, 2000.0, 900.0)]
    air = 280.0 + 10.0 * np.tanh(np.arange(count) / 100.0)
    runs = [
        march(
            made,
            outdoors(air, 15.0, sky=280.0, emissivity=0.9),
            indoors(constant(280.0, count), 1000.0),
            DARK,
            step=600.0,
            record=np.arange(1, count),
        ).exterior
        for made in (layers, plain)
    ]
    np.testing.assert_allclose(runs[0], runs[1], rtol=0.0, atol=0.01)


def test_ten_thousand_cells_in_one_wall_agree_with_a_thousand() -> None:
    layer = [slab(1.0, 1.0, 1000.0, 1000.0)]
    count = 25
    air = 290.0 + 5.0 * np.sin(np.arange(count) / 10.0)
    runs = [
        march(
            layer,
            outdoors(air, 10.0),
            indoors(constant(290.0, count), 10.0),
            DARK,
            step=3600.0,
            record=np.arange(1, count),
            grid=uniform_grid(layer, [cells]),
        ).exterior
        for cells in (1000, 10_000)
    ]
    assert np.abs(runs[0] - runs[1]).max() < 1e-3


@pytest.mark.parametrize("entry", ["air", "irradiance", "longwave", "film"])
def test_nan_in_a_boundary_value_is_told_and_not_marched_through(entry: str) -> None:
    outside = outdoors(constant(280.0, 20), 10.0, sun=100.0, sky=260.0, emissivity=0.9)
    getattr(outside, entry)[10] = np.nan
    with pytest.raises(NumericsError, match="did not converge"):
        march([BLOCK], outside, indoors(constant(290.0, 20), 5.0), np.ones(1), step=60.0, record=np.array([19]))
