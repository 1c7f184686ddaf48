"""The page of what the model's inputs are worth: a ranked bar chart and a sentence for each surface."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.study.page import Page
from sensorsim.study.sensitivity import Sensitivity
from sensorsim.study.sensitivity_model import Effect

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LIMITS = (
    "Within one class of material, properties differ from sample to sample: solar absorptance by 0.05 to 0.15, which "
    "costs 2 to 8 K in full sun. No solver takes that back, and a finer mesh, step or table does not either: what they "
    "leave stands at the foot of each chart. Where absolute temperatures matter, measure the absorptance of the "
    "surfaces and the cloud of the day; where contrasts do, most inputs shift neighbours together."
)
METHOD = (
    "One input at a time is changed by its standard uncertainty, up and down, and the surface marched anew with its "
    "ground and sky; the larger change counts. Rms and largest are over the days and hours named. Inputs of different "
    "origin add up by their squares."
)


def where_worst(found: Sensitivity, effect: Effect) -> str:
    """Day and hour of an effect's largest value."""
    day, hour = np.unravel_index(int(np.argmax(effect.kelvin)), effect.kelvin.shape)
    return f"{found.days[day].isoformat()} at {found.hours[hour]:g} h"


def together(found: Sensitivity) -> float:
    """Root of the sum of squares of all inputs' rms [K]."""
    return float(np.sqrt(sum(effect.rms**2 for effect in found.effects)))


def sentence(found: Sensitivity) -> str:
    """What matters most on one surface."""
    first, second, third = found.effects[:3]
    own = max(found.solver.max, found.fit.max)
    return (
        f"{found.specimen.name[0].upper()}{found.specimen.name[1:]}: {first.input.name} ({first.input.amount}) is "
        f"worth {first.rms:.1f} K rms and {first.max:.1f} K at most, on {where_worst(found, first)}; then come "
        f"{second.input.name} ({second.rms:.1f} K) and {third.input.name} ({third.rms:.1f} K). All inputs together: "
        f"{together(found):.1f} K; solver and fit: {own:.2g} K at most."
    )


def write_sensitivity_page(path: Path, study: Sequence[Sensitivity]) -> None:
    """All surfaces as one HTML file."""
    page = Page("Sensitivity: what each input is worth in kelvin")
    page.text(LIMITS)
    page.text(METHOD)
    for found in study:
        page.heading(found.specimen.name[0].upper() + found.specimen.name[1:])
        page.text(sentence(found))
        page.figure(_chart(found), "Bars: rms over days and hours; dots: the largest. Logarithmic.")
        page.table(
            ("input", "standard uncertainty", "rms [K]", "largest [K]", "at", "source of the uncertainty"),
            [_row(found, effect) for effect in (*found.effects, found.solver, found.fit)],
        )
        celsius = found.temperature - ZERO_CELSIUS
        page.table(
            ("surface temperature [C]", *(f"{hour:g} h" for hour in found.hours)),
            [(day.isoformat(), *map(float, row)) for day, row in zip(found.days, celsius, strict=True)],
        )
    page.write(path)


def _row(found: Sensitivity, effect: Effect) -> tuple[Any, ...]:
    given = effect.input
    return given.name, given.amount, effect.rms, effect.max, where_worst(found, effect), given.source


def _chart(found: Sensitivity) -> "Figure":
    from matplotlib.figure import Figure

    rows = [effect for effect in found.effects if effect.max > 0.0] + [found.fit, found.solver]
    height = np.arange(len(rows))[::-1]
    figure = Figure(figsize=(8.0, 0.3 * len(rows) + 0.8), layout="constrained")
    axes = figure.subplots()
    colours = ["#0072B2"] * (len(rows) - 2) + ["#999999"] * 2
    axes.barh(height, [max(row.rms, 1e-3) for row in rows], color=colours)
    axes.plot([max(row.max, 1e-3) for row in rows], height, "o", color="#D55E00", markersize=5)
    axes.set_yticks(height, [f"{row.input.name} ({row.input.amount})" for row in rows])
    axes.set(xscale="log", xlim=(1e-3, 20.0), xlabel="change of surface temperature [K]")
    axes.grid(alpha=0.3, axis="x")
    return figure


def sensitivity_json(study: Sequence[Sensitivity]) -> list[dict[str, Any]]:
    """All figures as plain values."""
    return [
        {
            "surface": found.specimen.name,
            "days": [day.isoformat() for day in found.days],
            "hours": found.hours.tolist(),
            "surface_temperature_K": found.temperature.tolist(),
            "sentence": sentence(found),
            "inputs": [
                {
                    "name": effect.input.name, "amount": effect.input.amount, "source": effect.input.source,
                    "rms_K": effect.rms, "max_K": effect.max, "change_K": effect.kelvin.tolist(),
                }
                for effect in (*found.effects, found.solver, found.fit)
            ],
        }
        for found in study
    ]  # fmt: skip
