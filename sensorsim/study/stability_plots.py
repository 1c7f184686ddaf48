"""Pictures of stability: a metal skin at sunrise beside other methods, overshoot against step, melting snow, and the
error against exact solutions.

Needs matplotlib, which comes with the extra `study`.
"""

from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import solve_banded

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.study.manufactured import CELLS, ONE_LAYER, STEPS, TWO_LAYERS, errors_in_space, errors_in_time, order
from sensorsim.study.stability_march_skins import settled, sunrise
from sensorsim.study.stability_march_snow import HEAT_OF_MELTING, melting_day
from sensorsim.study.wall_setup import BATTING, COPPER, FloatArray
from sensorsim.thermal import WallGrid, build_grid

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SKIN = (COPPER, BATTING)
FILMS = (17.0, 3.0)  # [W m-2 K-1] exterior with radiation, interior
SUN = 560.0  # [W m-2] absorbed


def theta_method(grid: WallGrid, step: float, count: int, weight: float) -> FloatArray:
    """Exterior cell (t,) [K] above its start after the sun has risen, by a linear theta method.

    `weight` of the new time: 0.5 is the method of Crank and Nicolson, 1 backward Euler, 0 the explicit one.
    """
    link = grid.conductance.copy()
    link[0], link[-1] = 1.0 / (1.0 / link[0] + 1.0 / FILMS[0]), 1.0 / (1.0 / link[-1] + 1.0 / FILMS[1])
    source = np.zeros(grid.capacity.size)
    source[0] = SUN * link[0] / FILMS[0]
    rate, size = grid.capacity / step, grid.capacity.size
    band = np.zeros((3, size))
    band[0, 1:] = band[2, :-1] = -weight * link[1:-1]
    band[1] = rate + weight * (link[:-1] + link[1:])
    cells, face = np.zeros(size), np.zeros(count)
    for k in range(1, count):
        padded = np.concatenate([[0.0], cells, [0.0]])
        flow = link[:-1] * (padded[:-2] - cells) + link[1:] * (padded[2:] - cells)
        cells = solve_banded((1, 1), band, rate * cells + (1.0 - weight) * flow + source)
        face[k] = cells[0]
    return face


def overshoot(face: FloatArray, level: float) -> float:
    """How far a series that should rise to a level passes it or falls on its way [K]."""
    return max(0.0, float(face.max()) - level, float(-np.diff(face).min()))


def draw_sunrise() -> "Figure":
    """The skin through a step of sun in steps of a second to an hour, with Crank and Nicolson's beside it."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10.0, 4.2), layout="constrained")
    ours, other = figure.subplots(1, 2, sharey=True)
    for step, colour in ((1.0, "#0072B2"), (60.0, "#009E73"), (600.0, "#E69F00"), (3600.0, "#D55E00")):
        face = sunrise(SKIN, step)[99:]
        hours = np.arange(face.size) * step / 3600.0
        ours.plot(hours, face - 280.0, ".-", color=colour, label=f"{step:g} s")
        ringing = theta_method(build_grid(SKIN, step), step, 301, 0.5)
        other.plot(np.arange(301) * step / 3600.0, ringing, ".-", color=colour, label=f"{step:g} s", linewidth=0.8)
    for axes, title in ((ours, "this march"), (other, "Crank and Nicolson")):
        axes.set(xlim=(-0.2, 8.0), ylim=(-8.0, 75.0), xlabel="time since sunrise [h]", title=title)
        axes.grid(alpha=0.3)
    ours.set_ylabel("copper skin on batting, above start [K]")
    ours.legend(title="step")
    return figure


def draw_overshoot() -> "Figure":
    """Overshoot of the skin against the step, of this march and of three textbook methods."""
    from matplotlib.figure import Figure

    steps = np.geomspace(1.0, 3600.0, 13)
    level = settled(SKIN)
    curves = {"this march": [overshoot(sunrise(SKIN, float(step)), level) for step in steps]}
    for name, weight in (("Crank and Nicolson", 0.5), ("backward Euler", 1.0)):
        grids = [build_grid(SKIN, float(step)) for step in steps]
        faces = [theta_method(grid, float(step), 301, weight) for grid, step in zip(grids, steps, strict=True)]
        steady = float(theta_method(grids[-1], 1e6, 400, 1.0)[-1])
        curves[name] = [overshoot(face, steady) for face in faces]
    figure = Figure(figsize=(8.0, 4.2), layout="constrained")
    axes = figure.subplots()
    for (name, values), colour in zip(curves.items(), ("#D55E00", "#56B4E9", "#009E73"), strict=True):
        axes.loglog(steps, np.maximum(values, 1e-12), "o-", color=colour, label=name)
    axes.axhline(1e-6, color="k", linewidth=0.8, linestyle="--")
    axes.set(xlabel="step [s]", ylabel="overshoot after sunrise [K]", ylim=(5e-13, 100.0))
    axes.grid(alpha=0.3)
    axes.legend()
    return figure


def draw_melting() -> "Figure":
    """Face of thawing snow in steps of a minute to an hour."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 4.2), layout="constrained")
    axes = figure.subplots()
    for step, colour in ((60.0, "#0072B2"), (600.0, "#E69F00"), (3600.0, "#D55E00")):
        history = melting_day(step)
        hours, melt = history.sample * step / 3600.0, float(history.melted[0, 0]) / HEAT_OF_MELTING
        label = f"{step:g} s, {melt:.2f} kg m$^{{-2}}$ melted"
        axes.plot(hours, history.exterior[:, 0, 0] - ZERO_CELSIUS, ".-", color=colour, label=label, markersize=4)
    axes.axhline(0.0, color="k", linewidth=0.8, linestyle="--")
    axes.set(xlim=(8.0, 24.0), xlabel="time [h]", ylabel="face of the snow [°C]")
    axes.grid(alpha=0.3)
    axes.legend(title="step")
    return figure


def draw_convergence() -> "Figure":
    """Error against the exact solutions over cells and steps, with the fitted orders."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10.0, 4.2), layout="constrained")
    space, time = figure.subplots(1, 2)
    for layers, name, colour in ((ONE_LAYER, "one layer", "#0072B2"), (TWO_LAYERS, "two layers", "#D55E00")):
        cell = [1e3 * sum(layer.thickness for layer in layers) / len(layers) / count for count in CELLS]
        for axes, sizes, errors in ((space, cell, errors_in_space(layers)), (time, STEPS, errors_in_time(layers))):
            axes.loglog(sizes, errors, "o-", color=colour, label=f"{name}, order {order(sizes, errors):.2f}")
    for axes, label in ((space, "cell, mean over layers [mm]"), (time, "step [s]")):
        axes.set(xlabel=label)
        axes.grid(alpha=0.3)
        axes.legend()
    space.set_ylabel("rms error of both faces [K]")
    return figure
