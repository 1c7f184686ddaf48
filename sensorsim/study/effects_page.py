"""The page of `sensorsim study effects`: a table and a plot of what each effect is worth."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sensorsim.effects import DEFAULT_NOISE, NOISE_SHARE, NOT_MODELLED
from sensorsim.study.effects_worth import EffectWorth
from sensorsim.study.page import Page

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = (
    "effect",
    "RMS [K]",
    "greatest [K]",
    "bound [K]",
    "of white [-]",
    "bakes [ms]",
    "frame [ms]",
    "images that call for it",
)


def write_effects_page(path: Path, found: Sequence[EffectWorth], images: int) -> None:
    """One HTML file with the table, the plot and what is not modelled; needs matplotlib."""
    page = Page("What each effect is worth")
    page.text(
        f"The {images} images of the report's figures 19 and 21 to 27, drawn again with one effect left out at a time. "
        "Kelvin are of apparent temperature in the images of the FLIR; a change in an image of the LLLTV is told as a "
        "share of a white surface that faces the sun. Times are processor times, the best of "
        "several: of the bakes of all worlds that the figures need, and of one frame of 640 by 480 pixels drawn in "
        "software; their differences are as noisy as the machine is busy. The bound is the greatest that a ledger "
        "tells of leaving the effect out; a row is coloured where an image changed by more than its own."
    )
    page.table(HEAD, [row(worth) for worth in found], alarm=[not worth.holds for worth in found])
    page.figure(_plot(found), "Greatest and root-mean-square change of apparent temperature; dashed: the tolerance.")
    page.heading("Not modelled at all")
    page.text("; ".join(NOT_MODELLED) + ".")
    page.write(path)


def row(worth: EffectWorth) -> tuple[str | float, ...]:
    """Cells of one effect under HEAD."""
    seen = worth.kelvin_rms, worth.kelvin_max, worth.kelvin_bound, worth.white_max
    return worth.effect, *seen, worth.bake_ms, worth.frame_ms, worth.called


def _plot(found: Sequence[EffectWorth]) -> "Figure":
    from matplotlib.figure import Figure

    shown = sorted((worth for worth in found if worth.kelvin_max > 0.0), key=lambda worth: worth.kelvin_max)
    figure = Figure(figsize=(9.0, 0.4 * len(shown) + 1.2), layout="constrained")
    axes = figure.subplots()
    place = np.arange(len(shown))
    axes.barh(place + 0.2, [worth.kelvin_max for worth in shown], 0.4, label="greatest", color="#0072B2")
    axes.barh(place - 0.2, [worth.kelvin_rms for worth in shown], 0.4, label="root mean square", color="#E69F00")
    axes.axvline(DEFAULT_NOISE * NOISE_SHARE, color="black", linestyle="--")
    axes.set(xscale="log", xlabel="change of apparent temperature [K]", yticks=place)
    axes.set_yticklabels([worth.effect for worth in shown])
    axes.legend(frameon=False)
    return figure
