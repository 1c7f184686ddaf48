"""Laws that no step length may break: conservation, the maximum principle, independence of what is solved beside."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.materials import Layer, load_construction
from sensorsim.study.stability_march_skins import STEPS
from sensorsim.study.stability_model import Case
from sensorsim.study.wall_setup import (
    BATTING,
    BLOCK,
    CONCRETE,
    COPPER,
    DARK,
    STEEL,
    FloatArray,
    constant,
    indoors,
    outdoors,
    uniform_grid,
)
from sensorsim.thermal import Inside, Outside, build_grid, march

DAY = 86400.0


def rough_weather(count: int, orientations: int, seed: int = 3) -> tuple[Outside, Inside]:
    """Boundary values that jump from sample to sample, with radiation and free convection on both sides."""
    rng = np.random.default_rng(seed)
    air = 280.0 + np.cumsum(rng.normal(0.0, 0.5, count))
    room = 290.0 + rng.normal(0.0, 1.0, count)
    outside = Outside(
        irradiance=rng.uniform(0.0, 900.0, (count, orientations)),
        longwave=rng.uniform(200.0, 420.0, (count, orientations)),
        film=rng.uniform(0.0, 40.0, (count, orientations)),
        free=rng.uniform(0.5, 4.0, orientations),
        free_colder=rng.uniform(0.1, 4.0, orientations),
        air=air,
        emissivity=0.9,
    )
    return outside, Inside(air=room, radiant=room + 2.0, film=rng.uniform(0.0, 4.0, count), free=2.2, emissivity=0.8)


def _closure(construction: str, step: float) -> float:
    """Heat that entered less heat stored, over what moved."""
    outside, inside = rough_weather(300, 4)
    history = march(
        load_construction(construction).layers, outside, inside, np.array([0.1, 0.9]), step=step, record=np.array([299])
    )
    return float(np.abs(history.heat.sum(axis=0) - history.stored).max()) / (300.0 * step * 900.0)


def _outside_of_range(layers: Sequence[Layer]) -> float:
    """How far any cell or face leaves the range of air and sky met so far, at any step."""
    rng = np.random.default_rng(4)
    air, sky = rng.uniform(270.0, 300.0, 200), rng.uniform(270.0, 300.0, 200)
    low, high, worst = min(air.min(), sky.min()), max(air.max(), sky.max()), 0.0
    for step in STEPS:
        history = march(
            layers, outdoors(air, 15.0, sky=sky, emissivity=0.9), indoors(constant(285.0, 200), 8.0), DARK,
            step=step, record=np.arange(1, 200), keep_nodes=True,
        )  # fmt: skip
        for seen in (history.exterior, history.interior, history.nodes):
            if seen is not None:
                worst = max(worst, float(low - seen.min()), float(seen.max() - high))
    return worst


def _closed_wall() -> float:
    """Distance of all cells, after a week without any exchange, from the mean that they began with."""
    layers, count = load_construction("insulated_wood").layers, 2000
    grid = build_grid(layers, 300.0)
    start = 280.0 + 20.0 * np.random.default_rng(1).uniform(size=grid.capacity.size)
    history = march(
        layers, outdoors(constant(280.0, count), 0.0), indoors(constant(280.0, count), 0.0), DARK,
        step=300.0, record=np.array([count - 1]), grid=grid, start=start, keep_nodes=True,
    )  # fmt: skip
    mean = float(grid.capacity @ start / grid.capacity.sum())
    return float(np.abs(history.nodes - mean).max()) if history.nodes is not None else np.inf


def _blind_face() -> float:
    """What sun of 900 W m-2 and a sky of 100 K do to a face of absorptance and emissivity 0."""
    faces = []
    for sun, sky in ((0.0, 300.0), (900.0, 100.0)):
        outside = outdoors(constant(285.0, 200), 15.0, sun=sun, sky=sky)
        inside = indoors(constant(290.0, 200), 8.0)
        faces.append(march([BLOCK], outside, inside, DARK, step=600.0, record=np.arange(200)).exterior)
    return float(np.abs(faces[0] - faces[1]).max())


def _imbalance() -> float:
    """What the surroundings give the exterior face less what conduction takes, with a film that jumps every step."""
    outside, inside = rough_weather(200, 5)
    absorptances = np.array([0.1, 0.5, 0.9])
    history = march(
        load_construction("brick").layers, outside, inside, absorptances, step=300.0, record=np.arange(1, 200),
        keep_nodes=True,
    )  # fmt: skip
    cells = history.exterior if history.nodes is None else history.nodes[:, 0]
    face, difference = history.exterior, outside.air[1:, None, None] - history.exterior
    free = np.where(difference < 0.0, outside.free[None, :, None], outside.free_colder[None, :, None])
    film = np.cbrt(outside.film[1:, :, None] ** 3 + free * np.abs(difference))
    sun = absorptances * outside.irradiance[1:, :, None]
    glow = outside.emissivity * (outside.longwave[1:, :, None] - SIGMA * face**4)
    conducted = history.grid.conductance[0] * (face - cells)
    return float(np.abs(sun + glow + film * difference - conducted).max())


def _in_a_batch() -> float:
    """Difference between walls solved ten thousand at once and each alone."""
    outside, inside = rough_weather(24, 10_000)
    worst = 0.0
    for layers in (load_construction("builtup_roof").layers, (STEEL,)):
        every = np.arange(24)
        together = march(layers, outside, inside, np.array([0.7]), step=600.0, record=every)
        for row in (0, 31, 32, 5000, 9999):
            one = slice(row, row + 1)
            single = outside._replace(
                irradiance=outside.irradiance[:, one], longwave=outside.longwave[:, one], film=outside.film[:, one],
                free=outside.free[one], free_colder=outside.free_colder[one],
            )  # fmt: skip
            alone = march(layers, single, inside, np.array([0.7]), step=600.0, record=every)
            worst = max(worst, float(np.abs(alone.exterior[:, 0] - together.exterior[:, row]).max()))
    return worst


def _concrete(cells: int | None) -> FloatArray:
    """Face (t,) [K] of a metre of concrete over its fifth day, in 5-minute steps; its back at the mean."""
    angle = 2.0 * np.pi * np.arange(5 * 288 + 1) * 300.0 / DAY
    history = march(
        [CONCRETE], outdoors(285.0 - 5.0 * np.cos(angle), 15.0, sun=np.maximum(-700.0 * np.cos(angle), 0.0)),
        indoors(constant(285.0, angle.size), 1000.0), np.array([0.7]), step=300.0,
        record=np.arange(4 * 288, angle.size), grid=None if cells is None else uniform_grid([CONCRETE], [cells]),
    )  # fmt: skip
    return np.asarray(history.exterior[:, 0, 0])


def _thick_concrete() -> float:
    return float(np.sqrt(np.mean((_concrete(None) - _concrete(2000)) ** 2)))


def _single_precision() -> float:
    """What storing a wall's cells in float32 kelvin every quarter of an hour for a week does to its face."""
    layers, count = load_construction("brick").layers, 7 * 1440
    grid = build_grid(layers, 60.0)
    angle = 2.0 * np.pi * np.arange(count + 1) * 60.0 / DAY
    air, sun = 285.0 - 5.0 * np.cos(angle), np.maximum(-700.0 * np.cos(angle), 0.0)
    room = constant(290.0, count + 1)

    def go(first: int, last: int, start: FloatArray) -> tuple[FloatArray, float]:
        rows = slice(first, last + 1)
        history = march(
            layers, outdoors(air[rows], 15.0, sun=sun[rows]), indoors(room[rows], 8.0),
            np.array([0.7]), step=60.0, record=np.array([last - first]), grid=grid, start=start, keep_nodes=True,
        )  # fmt: skip
        cells = start if history.nodes is None else history.nodes[0, :, 0, 0]
        return cells, float(history.exterior[0, 0, 0])

    stored, worst = constant(290.0, grid.capacity.size), 0.0
    exact = stored
    for first in range(0, count, 15):
        exact, face = go(first, first + 15, exact)
        cells, rounded = go(first, first + 15, stored)
        stored, worst = cells.astype(np.float32).astype(np.float64), max(worst, abs(rounded - face))
    return worst


CASES = (
    *(
        Case(
            name=f"heat balance of {words}, step {step:g} s",
            group="laws",
            stresses="sun, sky, film and air that jump at every sample",
            measured="heat that entered less heat stored, over what moved",
            unit="-",
            bound=1e-12,
            reason="conservation, to rounding",
            measure=partial(_closure, construction, step),
        )
        for construction, words in (
            ("insulated_wood", "insulated wood"),
            ("steel_sheet", "sheet steel"),
            ("builtup_roof", "a built-up roof"),
        )
        for step in (1.0, 60.0, 3600.0)
    ),
    *(
        Case(
            name=f"range of {words}",
            group="laws",
            stresses="air and sky that jump by up to 30 K, steps of 1 s to 1 h",
            measured="how far any cell or face leaves the range met so far",
            unit="K",
            bound=1e-6,
            reason="maximum principle",
            measure=partial(_outside_of_range, layers),
        )
        for words, layers in (
            ("steel", (STEEL,)),
            ("copper on batting", (COPPER, BATTING)),
            ("block on batting", (BLOCK, BATTING)),
        )
    ),
    Case(
        name="wall closed on both sides",
        group="laws",
        stresses="the steady matrix is singular",
        measured="distance of all cells from their mean after a week",
        unit="K",
        bound=1e-8,
        reason="the heat is kept and evens out",
        measure=_closed_wall,
    ),
    Case(
        name="absorptance and emissivity 0",
        group="laws",
        stresses="the fourth power drops out of the balance",
        measured="what sun and sky do to such a face",
        unit="K",
        bound=0.0,
        reason="it takes nothing from them",
        measure=_blind_face,
    ),
    Case(
        name="one factored wall under films that jump",
        group="laws",
        stresses="the stored elimination knows no film; both faces are condensed and solved anew",
        measured="what the surroundings give less what conduction takes",
        unit="W m-2",
        bound=1e-5,
        reason="1e-8 K times a face conductance of up to 1000 W m-2 K-1",
        measure=_imbalance,
    ),
    Case(
        name="ten thousand walls at once",
        group="laws",
        stresses="blocks of columns that share one iteration",
        measured="difference from each alone, thick and thin walls",
        unit="K",
        bound=0.0,
        reason="bit for bit: no wall knows its neighbours",
        measure=_in_a_batch,
    ),
    Case(
        name="a metre of concrete",
        group="laws",
        stresses="a day reaches 0.15 m, memory lasts for months: the grid has to be graded",
        measured="rms difference from 0.5 mm cells over the fifth day, steps of 300 s",
        unit="K",
        bound=0.02,
        reason="what is asked of a wall against EnergyPlus",
        measure=_thick_concrete,
    ),
    Case(
        name="cells stored in single precision",
        group="laws",
        stresses="near 300 K float32 has steps of 3e-5 K: a slow layer could stall",
        measured="change of the face over a week of steps of 60 s, stored anew every quarter of an hour",
        unit="K",
        bound=0.01,
        reason="a tenth of what the fit of the tables may cost",
        measure=_single_precision,
    ),
)
