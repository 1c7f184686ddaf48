"""Boundaries that jump, swing and vanish: films, inputs and steps."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from sensorsim.materials import Layer, load_construction
from sensorsim.study.stability_model import Case
from sensorsim.study.wall_setup import BLOCK, DARK, STEEL, FloatArray, constant, indoors, outdoors
from sensorsim.thermal import build_wall_boundary, march, march_wall


def _strong_film(film: float) -> float:
    """How much more than flux over film the face is off the air."""
    count = 100
    air = 280.0 + 10.0 * np.sin(np.arange(count) / 5.0)
    history = march(
        [BLOCK], outdoors(air, film, sun=500.0), indoors(constant(290.0, count), 5.0), np.ones(1),
        step=300.0, record=np.arange(1, count), keep_nodes=True,
    )  # fmt: skip
    cells = history.exterior if history.nodes is None else history.nodes[:, 0]
    flux = 500.0 + history.grid.conductance[0] * np.abs(cells - history.exterior)
    off = np.abs(history.exterior[:, 0, 0] - air[1:]) - flux[:, 0, 0] / film
    return max(0.0, float(off.max()))


def _gale() -> float:
    """How far a sunlit face leaves the range between its air and the still film, as wind comes and goes."""
    count = 120
    film = np.where(np.arange(count) // 20 % 2 == 0, 0.0, 5e3)
    history = march(
        [STEEL], outdoors(constant(280.0, count), film, sun=100.0, free=2.2), indoors(constant(280.0, count), 0.0),
        np.ones(1), step=300.0, record=np.arange(1, count),
    )  # fmt: skip
    still: float = (100.0 / 2.2 ** (1.0 / 3.0)) ** 0.75  # [K] that free convection alone needs for 100 W m-2
    return max(0.0, 280.0 - float(history.exterior.min()), float(history.exterior.max() - 280.0 - still))


def _free_film_returns() -> float:
    """Distance of a still wall from its air of 290 K, before that jumps to 310 K; infinite if it then stays."""
    air = np.where(np.arange(400) < 200, 290.0, 310.0)
    history = march(
        [STEEL], outdoors(air, 0.0, free=2.2), indoors(constant(290.0, 400), 0.0), DARK, step=300.0,
        record=np.array([199, 399]),
    )  # fmt: skip
    before, after = history.exterior[:, 0, 0]
    return abs(float(before) - 290.0) if 300.0 < after < 310.0 else float("inf")


def _at_hours(layers: Sequence[Layer], time: FloatArray, step: float) -> FloatArray:
    """Face (t,) [K] at the samples `time` of six hours of smooth weather, marched in steps of at most `step`."""
    turn = 2.0 * np.pi * time / 21600.0
    boundary = build_wall_boundary(
        time, air_temperature=285.0 + 5.0 * np.sin(turn), exterior_film=15.0, interior_air_temperature=290.0,
        interior_film=8.0, beam=300.0 - 300.0 * np.cos(turn),
    )  # fmt: skip
    history = march_wall(
        layers, boundary, absorptance=0.7, emissivity=0.9, interior_emissivity=0.9, sky_view=0.5, step=step,
        start="steady",
    )  # fmt: skip
    return history.exterior


def _changing_steps() -> float:
    """Difference that intervals of a second within those of a quarter make, at the quarters."""
    layers = load_construction("brick").layers
    plain = 900.0 * np.arange(25, dtype=np.float64)
    seconds = (plain[4:-4, None] + np.array([1.0, 2.0])).ravel()
    mixed = np.unique(np.concatenate([plain, seconds]))
    rows = np.searchsorted(mixed, plain)
    return float(np.abs(_at_hours(layers, mixed, 3600.0)[rows] - _at_hours(layers, plain, 60.0)).max())


def _odd_step() -> float:
    layers = load_construction("brick").layers
    hours = 600.0 * np.arange(37, dtype=np.float64)
    return float(np.abs(_at_hours(layers, hours, 420.0) - _at_hours(layers, hours, 10.0)).max())


def _series(count: int, step: float, layers: Sequence[Layer], kind: str) -> FloatArray:
    """Face (t,) [K] at steps of `step`, `count` of ten minutes each, of a sunrise or of a swinging film."""
    knots, time = np.arange(count + 1) * 600.0, np.arange(round(count * 600.0 / step) + 1) * step
    sun, film = constant(300.0, count + 1), 26.5 + 20.5 * np.sin(knots / 1200.0)
    if kind == "sunrise":
        knots, sun = np.array([0.0, 3600.0, 3660.0, knots[-1]]), np.array([0.0, 0.0, 400.0, 400.0])
        film = np.full(4, 15.0)
    history = march(
        layers,
        outdoors(285.0 + 5.0 * np.sin(time / 7200.0), np.interp(time, knots, film), sun=np.interp(time, knots, sun)),
        indoors(constant(290.0, time.size), 8.0), np.array([0.7]), step=step, record=np.arange(time.size),
    )  # fmt: skip
    return np.asarray(history.exterior[:, 0, 0])


def _input_jump(step: float) -> float:
    coarse, fine = (_series(36, each, load_construction("steel_sheet").layers, "sunrise") for each in (step, 2.0))
    return float(np.abs(coarse - fine[:: round(step / 2.0)]).max())


def _swinging_film() -> float:
    coarse, fine = (_series(72, each, load_construction("brick").layers, "film") for each in (600.0, 10.0))
    return float(abs(np.mean(coarse - fine[::60])))


CASES = (
    *(
        Case(
            name=f"film of {film:g} W m-2 K-1",
            group="films and inputs",
            stresses="rain and wet-bulb air: a boundary that is all but prescribed",
            measured="how much more than flux over film the face is off the air",
            unit="K",
            bound=1e-8,
            reason="Newton's law of cooling; the iteration ends at 1e-8 K",
            measure=partial(_strong_film, film),
        )
        for film in (1e3, 1e4, 1e6)
    ),
    Case(
        name="still air and gale in turn",
        group="films and inputs",
        stresses="a film that jumps from 0 to 5000 W m-2 K-1 and back",
        measured="how far the face leaves the range of its two films",
        unit="K",
        bound=1e-6,
        reason="maximum principle",
        measure=_gale,
    ),
    Case(
        name="still air at the wall's own temperature",
        group="films and inputs",
        stresses="the free film vanishes, and with it its slope",
        measured="distance from the air; infinite if the film does not come back",
        unit="K",
        bound=1e-9,
        reason="the exact answer is the air",
        measure=_free_film_returns,
    ),
    Case(
        name="steps of 1 s between steps of 900 s",
        group="films and inputs",
        stresses="a step that changes by 900 and back; multistep methods need new coefficients",
        measured="difference from steps of 60 s",
        unit="K",
        bound=0.05,
        reason="a second-order step of 30 min is good to 0.03-0.05 K rms against EnergyPlus's weather, 15 min to less",
        measure=_changing_steps,
    ),
    Case(
        name="step of 420 s",
        group="films and inputs",
        stresses="a step that does not divide the hour",
        measured="difference from steps of 10 s",
        unit="K",
        bound=0.01,
        reason="the accuracy that is asked of the default wall",
        measure=_odd_step,
    ),
    Case(
        name="sun that jumps within a minute, step 60 s",
        group="films and inputs",
        stresses="0 to 400 W m-2 between two samples on steel: where every code errs most",
        measured="largest difference from steps of 2 s",
        unit="K",
        bound=0.3,
        reason="the finite differences of EnergyPlus err by 0.3 K there at their best, by 1.4 K as transfer functions",
        measure=partial(_input_jump, 60.0),
    ),
    Case(
        name="film that swings from 6 to 47 W m-2 K-1",
        group="films and inputs",
        stresses="film and difference interpolated apart, multiplied at one instant",
        measured="mean difference of steps of 600 s from steps of 10 s",
        unit="K",
        bound=0.03,
        reason="what is asked of steel against EnergyPlus; mixing instants costs a solver ten times that",
        measure=_swinging_film,
    ),
)
