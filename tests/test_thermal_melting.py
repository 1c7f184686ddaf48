"""Snow and ice: fronts, plateaus and refreezing by closed forms, and heat that is kept to the last joule."""

from math import erf, exp, pi, sqrt

import numpy as np
import pytest
from scipy.optimize import brentq
from wall_cases import DARK, constant, indoors, outdoors, slab, uniform_grid

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.errors import NumericsError
from sensorsim.thermal import History, Inside, Outside, march

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


def _under_flux(flux: np.ndarray, step: float, *, start: float = 0.0) -> History:
    """A thin layer of snow at `start` [C] that takes in a flux (t,) [W m-2], closed behind."""
    outside, inside = outdoors(constant(270.0, flux.size), 0.0, sun=flux), indoors(constant(270.0, flux.size), 1e-9)
    grid = uniform_grid([THIN], [4])
    return march(
        [THIN], outside, inside, np.ones(1), step=step, record=np.arange(1, flux.size), grid=grid,
        start=constant(ZERO_CELSIUS + start, 4), melting_depth=1.0, keep_nodes=True,
    )  # fmt: skip


@pytest.mark.parametrize("step", [60.0, 600.0, 3600.0])
@pytest.mark.parametrize("warmer", [10.0, -10.0])
def test_front_of_melting_ice_and_of_freezing_water_follows_neumanns_solution(warmer: float, step: float) -> None:
    """Expected: 2 l sqrt(a t), sqrt(pi) l exp(l^2) erf(l) = c dT / L, to 0.2 % after five days; the issue asks 1 %."""
    count = round(5 * 86400.0 / step) + 1
    outside = outdoors(constant(ZERO_CELSIUS + warmer, count), 1e6)
    inside = indoors(constant(ZERO_CELSIUS, count), 1e-9)
    grid = uniform_grid([ICE], [250])
    runs = {}
    for start in (ZERO_CELSIUS - 1e-12, ZERO_CELSIUS + 10.0):
        runs[start] = march(
            [ICE], outside, inside, DARK, step=step, record=np.array([count - 1]), grid=grid,
            start=constant(start, 250), melting_depth=1.0, drains=False, keep_nodes=True,
        )  # fmt: skip
        if warmer > 0.0:
            break
    stefan = 2100.0 * abs(warmer) / FUSION
    root = brentq(lambda x: sqrt(pi) * x * exp(x * x) * erf(x) - stefan, 1e-3, 1.0)
    exact = 2.0 * root * sqrt(2.2 / (917.0 * 2100.0) * step * (count - 1))
    if warmer > 0.0:
        melted = next(iter(runs.values())).melted[0, 0] / (917.0 * FUSION)
        assert melted == pytest.approx(exact, rel=2e-3)
