"""Metal skins and bare radiation: walls that answer within milliseconds, marched in steps of up to an hour."""

from collections.abc import Sequence
from functools import partial

import numpy as np
from scipy.optimize import brentq

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.materials import Layer
from sensorsim.study.stability_model import Case
from sensorsim.study.wall_setup import BATTING, BLOCK, COPPER, DARK, STEEL, FloatArray, constant, gap, indoors, outdoors
from sensorsim.thermal import march

STEPS = (1.0, 60.0, 600.0, 3600.0)  # [s]
SKINS = {"steel": [STEEL], "copper": [COPPER], "copper on batting": [COPPER, BATTING], "steel on block": [STEEL, BLOCK]}


def sunrise(layers: Sequence[Layer], step: float, count: int = 400) -> FloatArray:
    """Exterior face (t,) [K] of a wall at 280 K all round on which the sun, 800 W m-2, rises after 100 samples."""
    sun = np.where(np.arange(count) < 100, 0.0, 800.0)
    history = march(
        layers, outdoors(constant(280.0, count), 12.0, sun=sun, sky=280.0, emissivity=0.9),
        indoors(constant(280.0, count), 3.0), np.array([0.7]), step=step, record=np.arange(count),
    )  # fmt: skip
    return np.asarray(history.exterior[:, 0, 0])


def settled(layers: Sequence[Layer]) -> float:
    """Temperature [K] at which the face of `sunrise` is in balance."""
    inward = 1.0 / (sum(layer.thermal_resistance for layer in layers) + 1.0 / 3.0)

    def lack(face: float) -> float:
        return 560.0 + (12.0 + inward) * (280.0 - face) + 0.9 * SIGMA * (280.0**4 - face**4)

    return float(brentq(lack, 280.0, 400.0, xtol=1e-12))


def _retreat(layers: Sequence[Layer], step: float) -> float:
    """Largest fall while the sun stands, and how far the balance is passed."""
    face = sunrise(layers, step)
    return max(0.0, float(-np.diff(face).min()), float(face.max()) - settled(layers))


def _unsettled(layers: Sequence[Layer], step: float) -> float:
    return abs(float(sunrise(layers, step)[-1]) - settled(layers))


def _below_sky(sky: float, step: float) -> float:
    """How far a plate that only radiates passes below its sky, or warms."""
    count = 2000 if step < 60.0 else round(3.0 * 86400.0 / step)
    history = march(
        [STEEL], outdoors(constant(300.0, count), 0.0, sky=sky, emissivity=0.98), indoors(constant(300.0, count), 0.0),
        DARK, step=step, record=np.arange(count),
    )  # fmt: skip
    face = history.exterior[:, 0, 0]
    return max(0.0, sky - float(face.min()), float(np.diff(face).max()))


def _newton_miss(sun: float, sky: float) -> float:
    """Distance from the balance of a face that starts at its air, 250 K, and belongs elsewhere."""
    history = march(
        [gap(1e6)], outdoors(constant(250.0, 4), 0.0, sun=sun, sky=sky, emissivity=0.9),
        indoors(constant(250.0, 4), 1.0), np.ones(1), step=60.0, record=np.array([1, 3]),
    )  # fmt: skip

    def lack(face: float) -> float:
        return sun + 0.9 * SIGMA * (sky**4 - face**4) + (250.0 - face) / (1e6 + 1.0)

    exact = brentq(lack, 0.0, 1000.0, xtol=1e-12)
    return float(np.abs(history.exterior - exact).max())


CASES = (
    *(
        Case(
            name=f"sunrise on {name}, step {step:g} s",
            group="metal skins",
            stresses="Fourier number up to 5e5, where Crank-Nicolson rings for hours",
            measured="fall of the face under a steady sun, or rise past its balance",
            unit="K",
            bound=1e-6,
            reason="the exact answer is monotone",
            measure=partial(_retreat, layers, step),
        )
        for name, layers in SKINS.items()
        for step in STEPS
    ),
    *(
        Case(
            name=f"balance of {name}, step {step:g} s",
            group="metal skins",
            stresses="a face conductance of 1e5 to 1e6 W m-2 K-1 beside films of 10",
            measured="distance from the steady heat balance, solved apart",
            unit="K",
            bound=1e-8,
            reason="a steady wall balances to 1e-8 K",
            measure=partial(_unsettled, SKINS[name], step),
        )
        for name in ("steel", "copper")
        for step in (600.0, 3600.0)
    ),
    *(
        Case(
            name=f"plate under a sky of {sky:g} K, step {step:g} s",
            group="radiation alone",
            stresses="a lagged radiative film overshoots at large steps",
            measured="how far the face passes below the sky, or warms",
            unit="K",
            bound=1e-7,
            reason="what only radiates cools towards its sky and never passes it",
            measure=partial(_below_sky, sky, step),
        )
        for sky in (0.0, 200.0)
        for step in STEPS
    ),
    *(
        Case(
            name=f"first balance {words}",
            group="radiation alone",
            stresses="Newton's start is more than 100 K off and its first move overshoots",
            measured="distance from the root of the balance",
            unit="K",
            bound=1e-8,
            reason="the iteration ends at 1e-8 K, and its last step squares the error",
            measure=partial(_newton_miss, sun, sky),
        )
        for words, sun, sky in (
            ("under 4000 W m-2", 4000.0, 400.0),
            ("under a sky of 100 K", 0.0, 100.0),
            ("under nothing at all", 0.0, 0.0),
        )
    ),
)
