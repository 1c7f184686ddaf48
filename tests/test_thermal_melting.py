"""Snow and ice: fronts, plateaus and refreezing by closed forms, and heat that is kept to the last joule."""

from math import erf, exp, pi, sqrt

import numpy as np
import pytest
from scipy.optimize import brentq
from wall_cases import DARK, constant, indoors, outdoors, slab, uniform_grid

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.errors import NumericsError
from sensorsim.thermal import History, Inside, Outside, build_grid, march

FUSION = 3.34e5  # [J kg-1]
ICE = slab(0.5, 2.2, 917.0, 2100.0, name="ice")
SNOW, SOIL = slab(0.15, 0.2, 250.0, 2090.0, name="snow"), slab(0.5, 1.0, 1500.0, 1200.0, name="soil")
THIN = slab(0.008, 0.2, 250.0, 2090.0, name="2 mm of water as snow")
STEPS = [1.0, 60.0, 600.0, 3600.0]


def _weather(samples: int, *, seed: int = 5) -> tuple[Outside, Inside]:
    """Boundary values that jump about 0 C from sample to sample, over a wet face."""
    rng = np.random.default_rng(seed)
    outside = outdoors(ZERO_CELSIUS + rng.normal(0.0, 6.0, samples), 12.0, emissivity=0.95, free=2.2)
    outside = outside._replace(
        irradiance=rng.uniform(0.0, 700.0, (samples, 2)),
        longwave=rng.uniform(200.0, 330.0, (samples, 2)),
        film=rng.uniform(0.0, 30.0, (samples, 2)),
        free=np.array([2.2, 1.0]),
        latent=rng.uniform(0.0, 0.2, (samples, 2)),
        vapour=rng.uniform(300.0, 700.0, samples),
    )
    return outside, indoors(constant(ZERO_CELSIUS + 2.0, samples), 5.0)


def _under_flux(flux: np.ndarray, step: float) -> History:
    """A thin layer of snow at 0 C that takes in a flux (t,) [W m-2], closed behind."""
    outside, inside = outdoors(constant(270.0, flux.size), 0.0, sun=flux), indoors(constant(270.0, flux.size), 0.0)
    grid = uniform_grid([THIN], [4])
    return march(
        [THIN], outside, inside, np.ones(1), step=step, record=np.arange(1, flux.size), grid=grid,
        start=constant(ZERO_CELSIUS, 4), melting_depth=1.0, keep_nodes=True,
    )  # fmt: skip


@pytest.mark.parametrize("step", [60.0, 600.0, 3600.0])
@pytest.mark.parametrize("warmer", [10.0, -10.0])
def test_front_of_melting_ice_and_of_freezing_water_follows_neumanns_solution(warmer: float, step: float) -> None:
    """Expected: 2 l sqrt(a t), sqrt(pi) l exp(l^2) erf(l) = c dT / L, to 0.2 % after five days; the issue asks 1 %."""
    count = round(5 * 86400.0 / step) + 1
    outside = outdoors(constant(ZERO_CELSIUS + warmer, count), 1e6)
    inside = indoors(constant(ZERO_CELSIUS, count), 0.0)
    start = 0.0 if warmer > 0.0 else 1e-9  # ice, or water
    history = march(
        [ICE], outside, inside, DARK, step=step, record=np.array([count - 1]), grid=uniform_grid([ICE], [250]),
        start=constant(ZERO_CELSIUS + start, 250), melting_depth=1.0, drains=False,
    )  # fmt: skip
    stefan = 2100.0 * abs(warmer) / FUSION
    root = brentq(lambda x: sqrt(pi) * x * exp(x * x) * erf(x) - stefan, 1e-3, 1.0)
    exact = 2.0 * root * sqrt(2.2 / (917.0 * 2100.0) * step * (count - 1))
    assert history.melted[0, 0] / (917.0 * FUSION) == pytest.approx(np.sign(warmer) * exact, rel=2e-3)


@pytest.mark.parametrize("step", STEPS)
def test_snow_stays_at_zero_for_as_long_as_its_latent_heat_lasts_and_then_drains(step: float) -> None:
    """Expected: m L / q = 6,680 s for 2 mm of water under 100 W m-2, within one step; later heat runs off."""
    count = max(round(10000.0 / step), 4)
    history = _under_flux(np.full(count, 100.0), step)
    assert history.nodes is not None
    np.testing.assert_array_equal(history.exterior, ZERO_CELSIUS)
    np.testing.assert_array_equal(history.nodes, ZERO_CELSIUS)
    entered = 100.0 * step * (count - 1)
    np.testing.assert_allclose(history.melted, entered, rtol=1e-12)
    np.testing.assert_allclose(history.drained, max(entered - 2.0 * FUSION, 0.0), rtol=1e-9, atol=1e-6)


@pytest.mark.parametrize("step", [1.0, 60.0, 600.0])
def test_what_has_melted_freezes_again_at_zero_before_it_gets_colder(step: float) -> None:
    """3000 s of 100 W m-2 in and then out, within a step of a plateau as long, at any depth of the layer."""
    there = round(3000.0 / step)
    flux = np.concatenate([np.full(there + 1, 100.0), np.full(2 * there, -100.0)])
    history = _under_flux(flux, step)
    assert history.nodes is not None
    deepest = history.nodes[:, -1, 0, 0]  # the last to freeze
    plateau = np.flatnonzero(deepest >= ZERO_CELSIUS - 1e-9)
    chilled = 0.008 * 250.0 * 2090.0 * 100.0 * 0.008 / 0.2 / 2.0 / 100.0  # [s] that cooling frozen layers takes up
    assert plateau[-1] + 1 == pytest.approx(2 * there, abs=chilled / step + 1.0)
    assert history.melted[0, 0] == pytest.approx(0.0, abs=1e-6)
    assert np.all(np.diff(deepest[there:]) <= 1e-12)
    assert deepest[-1] < ZERO_CELSIUS - 1.0


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("drains", [True, False])
def test_heat_that_enters_is_stored_melts_or_drains(step: float, drains: bool) -> None:
    """Expected: to 1e-12 of the heat that moved, at any step; snow never above 0 C, latent heat within its bounds."""
    outside, inside = _weather(400)
    history = march(
        [SNOW, SOIL], outside, inside, np.array([0.2, 0.9]), step=step, record=np.arange(1, 400),
        melting_depth=0.15, drains=drains, keep_nodes=True,
    )  # fmt: skip
    moved = 400 * step * 700.0
    assert np.abs(history.heat.sum(axis=0) - history.stored - history.melted).max() < 1e-12 * moved
    assert history.melted.max() > 0.0
    latent = 0.15 * 250.0 * FUSION
    assert np.all(history.melted - history.drained <= latent * (1.0 + 1e-12))
    assert np.all(history.melted - history.drained > -1e-6)
    assert history.nodes is not None
    if drains:
        assert history.exterior.max() <= ZERO_CELSIUS
        assert history.nodes[:, history.grid.depth < 0.15].max() <= ZERO_CELSIUS
    else:
        assert np.all(history.drained == 0.0)


@pytest.mark.parametrize("air", [0.0, 1e-9, 1e-3, -1e-3])
def test_nothing_chatters_about_the_threshold(air: float) -> None:
    """Snow that warms from -2 C in air at its melting point rises all the way, to 0 C at most, at any step."""
    for step in STEPS:
        outside = outdoors(constant(ZERO_CELSIUS + air, 500), 20.0, emissivity=0.9, sky=ZERO_CELSIUS + air)
        history = march(
            [SNOW], outside, indoors(constant(ZERO_CELSIUS + air, 500), 20.0), DARK, step=step,
            record=np.arange(1, 500), start=constant(ZERO_CELSIUS - 2.0, build_grid([SNOW], step).capacity.size),
            melting_depth=1.0, keep_nodes=True,
        )  # fmt: skip
        assert history.nodes is not None
        assert np.diff(history.nodes, axis=0).min() > -1e-12
        assert history.nodes.max() <= ZERO_CELSIUS
        assert history.melted.min() >= -1e-6


def test_snow_that_stays_cold_is_a_dry_wall() -> None:
    """Expected: the second-order march within the first-order error of steps of 10 s, nothing melted."""
    count = 2000
    air = ZERO_CELSIUS - 12.0 + 6.0 * np.sin(np.arange(count) / 200.0)
    outside = outdoors(air, 15.0, sky=250.0, emissivity=0.95, free=2.0)
    runs = [
        march(
            [SNOW, SOIL], outside, indoors(constant(ZERO_CELSIUS - 3.0, count), 5.0), DARK, step=10.0,
            record=np.arange(1, count), melting_depth=depth,
        )
        for depth in (0.15, 0.0)
    ]  # fmt: skip
    assert runs[0].melted[0, 0] == 0.0
    assert np.abs(runs[0].exterior - runs[1].exterior)[100:].max() < 0.01


def test_melting_columns_solved_together_equal_each_alone_bit_for_bit() -> None:
    outside, inside = _weather(150)
    options = {"step": 600.0, "record": np.arange(150), "melting_depth": 0.15}
    together = march([SNOW, SOIL], outside, inside, np.array([0.2, 0.9]), **options)
    one = outside._replace(
        irradiance=outside.irradiance[:, 1:], longwave=outside.longwave[:, 1:], film=outside.film[:, 1:],
        free=outside.free[1:], latent=outside.latent[:, 1:],
    )  # fmt: skip
    alone = march([SNOW, SOIL], one, inside, np.array([0.9]), **options)
    np.testing.assert_array_equal(alone.exterior[:, 0, 0], together.exterior[:, 1, 1])
    np.testing.assert_array_equal(alone.melted[0, 0], together.melted[1, 1])
    last = march([SNOW, SOIL], outside, inside, np.array([0.2, 0.9]), **(options | {"record": np.array([149])}))
    np.testing.assert_allclose(last.exterior[0], together.exterior[-1], rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("drains", [True, False])
def test_many_melting_columns_equal_each_alone_bit_for_bit(drains: bool) -> None:
    """More columns than one block holds, which melt, turn and settle at different steps; heat and drained water too."""
    outside, inside = _weather(300, seed=11)
    absorptances = np.linspace(0.05, 0.95, 23)
    options = {"step": 600.0, "record": np.arange(300), "melting_depth": 0.15, "drains": drains}
    together = march([SNOW, SOIL], outside, inside, absorptances, **options)
    assert np.unique(together.heat[0]).size == 46
    assert np.unique(together.melted).size > 10
    for place in (0, 8, 9, 22):
        alone = march([SNOW, SOIL], outside, inside, absorptances[[place]], **options)
        for name in ("exterior", "interior", "heat", "melted", "drained"):
            np.testing.assert_array_equal(getattr(alone, name)[..., 0], getattr(together, name)[..., place])


def test_nan_over_snow_is_told() -> None:
    outside, inside = _weather(50)
    outside.longwave[20] = np.nan
    with pytest.raises(NumericsError, match="did not converge"):
        march([SNOW], outside, inside, np.ones(1), step=60.0, record=np.array([49]), melting_depth=0.15)
