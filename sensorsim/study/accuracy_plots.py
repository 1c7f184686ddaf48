"""Plots of the accuracy study, drawn with matplotlib, which comes with the extra `study`."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from sensorsim.constants import SECONDS_PER_HOUR
from sensorsim.study.accuracy import AZIMUTHS, ErrorMap
from sensorsim.study.accuracy_measure import BINS, TIMES, Score
from sensorsim.study.pareto import pareto_front

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

COLOURS = {"combination": "#0072B2", "preset": "#D55E00"}  # that all colour vision tells apart
LINES = ("#D55E00", "#0072B2", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
WORDS = {"preset": "presets", "combination": "combinations"}


def pareto_figure(scores: Sequence[Score]) -> "Figure":
    """Error (p99 and, by a thin line above it, the largest) against bake time and against the tables' size."""
    figure = _figure(10.0, 4.6)
    time, size = figure.subplots(1, 2, sharey=True)
    _pareto(time, scores, [score.bake_processor for score in scores], "bake of one day [s of processor time]")
    _pareto(size, scores, [score.table for score in scores], "tables [MiB]")
    time.set_ylabel("error [K]: p99, line to the largest")
    time.legend(frameon=False, fontsize="small")
    return figure


def factor_figure(title: str, scores: Sequence[Score]) -> "Figure":
    """Errors, and the bake's cost, of the values of one knob."""
    figure = _figure(6.4, 3.4)
    left, places = figure.subplots(), np.arange(len(scores))
    for label, colour, errors in (
        ("largest", LINES[0], [score.max for score in scores]),
        ("p99", LINES[1], [score.p99 for score in scores]),
        ("RMS", LINES[2], [score.rms for score in scores]),
    ):
        left.plot(places, errors, "o-", color=colour, label=label)
    left.set_yscale("log")
    _plain_numbers(left.yaxis)
    left.set_xticks(places, [score.trial.name.split(" ", 1)[1] for score in scores])
    left.set_xlabel(title)
    left.set_ylabel("error [K]")
    left.grid(alpha=0.3)
    right = left.twinx()
    right.bar(places, [score.bake_processor for score in scores], width=0.3, color="#00000022")
    right.set_ylabel("bake [s of processor time]")
    left.legend(frameon=False, fontsize="small")
    return figure


def map_figure(found: ErrorMap) -> "Figure":
    """Error by hour and azimuth of a vertical wall."""
    figure = _figure(8.0, 4.0)
    axes = figure.subplots()
    most = float(np.abs(found.error).max())
    shown = axes.pcolormesh(
        TIMES / SECONDS_PER_HOUR, AZIMUTHS, found.error.T, cmap="RdBu_r", vmin=-most, vmax=most, shading="nearest"
    )
    axes.set_yticks(np.arange(0, 361, 90), ["N", "E", "S", "W", "N"])
    axes.set_xticks(np.arange(0, 25, 3))
    axes.set_xlabel("hour")
    axes.set_ylabel("wall faces")
    figure.colorbar(shown, ax=axes, label="fit less full solve [K]")
    return figure


def histogram_figure(scores: Sequence[Score]) -> "Figure":
    """Share of surfaces and times whose error is above a bound, for each preset."""
    figure = _figure(7.0, 3.8)
    axes = figure.subplots()
    for score, colour in zip(scores, LINES * len(scores), strict=False):
        above = 100.0 * (1.0 - np.cumsum(score.count) / score.count.sum())
        axes.plot(BINS[1:], above, color=colour, label=score.trial.name)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.xaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_major_formatter("{x:g}")
    axes.set_ylim(1e-3, 100.0)
    axes.set_xlabel("error [K]")
    axes.set_ylabel("surfaces and times beyond it [%]")
    axes.grid(alpha=0.3)
    axes.legend(frameon=False, fontsize="small")
    return figure


def _pareto(axes: "Axes", scores: Sequence[Score], cost: Sequence[float], label: str) -> None:
    p99 = np.array([score.p99 for score in scores])
    for group, colour in COLOURS.items():
        rows = [row for row, score in enumerate(scores) if score.trial.group == group]
        if not rows:
            continue
        x, low, high = ([values[row] for row in rows] for values in (cost, p99, [score.max for score in scores]))
        axes.vlines(x, low, high, color=colour, linewidth=0.7, alpha=0.5)
        axes.plot(x, low, "o", color=colour, markersize=6 if group == "preset" else 4, label=WORDS[group])
        if group == "preset":
            for row in rows:
                left = cost[row] > np.sqrt(min(cost) * max(cost))  # so that no name leaves the plot
                axes.annotate(
                    scores[row].trial.name, (cost[row], p99[row]), textcoords="offset points",
                    xytext=(-6 if left else 6, 5), ha="right" if left else "left",
                )  # fmt: skip
    front = pareto_front(np.asarray(cost, dtype=np.float64), p99)
    axes.step(np.asarray(cost)[front], p99[front], where="post", color="black", linewidth=1.0, label="front")
    axes.set_xscale("log")
    axes.set_yscale("log")
    _plain_numbers(axes.xaxis)
    _plain_numbers(axes.yaxis)
    axes.margins(x=0.15)
    axes.set_xlabel(label)
    axes.grid(alpha=0.3)


def _plain_numbers(axis: "Axis") -> None:
    """Ticks of a logarithmic axis at 1, 2 and 5 of each decade; of decades alone there may be none."""
    from matplotlib.ticker import LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter("{x:g}")
    axis.set_minor_formatter(NullFormatter())


def _figure(width: float, height: float) -> "Figure":
    from matplotlib.figure import Figure

    return Figure(figsize=(width, height), layout="constrained")
