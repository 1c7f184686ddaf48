"""The page of `sensorsim study pictures`: each effect on, off, and what it changes, for an engineer's eye."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from sensorsim.effects import NOT_MODELLED
from sensorsim.study.effects_cases import WITHOUT_PICTURE
from sensorsim.study.effects_pairs import FloatArray, Pair
from sensorsim.study.effects_sensors import study_sensor
from sensorsim.study.page import Page

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEAD = ("effect", "sensor", "day and hour", "RMS", "greatest", "bound", "unit")
SHOWN = (2.0, 98.0)  # [%] of the surfaces' values that the grey scale spans
CLEAR, SLIGHT = 99.5, 1e-3  # [%] of the changes that the colour scale spans, of those above a share of the greatest


def write_pictures_page(path: Path, pairs: Iterable[Pair]) -> list[tuple[str | float, ...]]:
    """One HTML file; needs matplotlib. Returns the rows of its table, under HEAD."""
    page, figures = Page("Each effect on and off"), Page("")
    page.text(
        "The hospital of the report, level IIIB. Each row is one look at it, drawn twice with everything the same but "
        "one effect: with it, without it, and the difference, with less without it in blue and more in red. Both "
        "pictures share one grey scale. Numbers are of apparent temperature in the thermal bands, of band radiance in "
        "the others; a bound is what the ledger of effects states before anything is drawn, and must not be less than "
        "the greatest change."
    )
    rows: list[tuple[str | float, ...]] = []
    for pair in pairs:
        rows.append(row(pair))
        figures.heading(f"{pair.case.effect}, {study_sensor(pair.case.sensor).title}")
        figures.text(pair.case.look_for)
        figures.figure(_plot(pair), _caption(pair))
    page.table(HEAD, rows, alarm=[_beyond(cells) for cells in rows])
    page.text("Without a picture: " + "; ".join(f"{name}: {why}" for name, why in WITHOUT_PICTURE.items()) + ".")
    page.text("Not modelled at all: " + "; ".join(NOT_MODELLED) + ".")
    page.parts += figures.parts[1:]
    page.write(path)
    return rows


def row(pair: Pair) -> tuple[str | float, ...]:
    """Cells of one pair under HEAD."""
    case = pair.case
    bound = "" if pair.bound is None else pair.bound
    return case.effect, case.sensor, f"{case.weather}, {case.hour:g} h", pair.rms, pair.greatest, bound, pair.unit


def _beyond(cells: Sequence[str | float]) -> bool:
    greatest, bound = cells[4], cells[5]
    return isinstance(bound, float) and isinstance(greatest, float) and greatest > bound * (1.0 + 1e-6) + 1e-9


def _caption(pair: Pair) -> str:
    bound = "" if pair.bound is None else f", bound {pair.bound:.3g}"
    return (
        f"{pair.words[0].upper()}{pair.words[1:]}, {pair.case.hour:g} h. Change: {pair.rms:.3g} {pair.unit} "
        f"root mean square, {pair.greatest:.3g} at most{bound}."
    )


def _plot(pair: Pair) -> "Figure":
    from matplotlib.figure import Figure

    height, width = pair.on.shape
    figure = Figure(figsize=(13.0, 13.0 / 3.0 * height / width + 0.35), layout="constrained")
    panels = figure.subplots(1, 3)
    seen = np.concatenate([picture[pair.surface] for picture in (pair.on, pair.off)] or [pair.on.ravel()])
    low, high = np.percentile(seen, SHOWN)
    reach = _reach(np.abs(pair.change), least=1e-6 * max(abs(high), 1e-12))
    for axes, picture, title in zip(panels, (pair.on, pair.off), ("on", "off"), strict=False):
        grey = axes.imshow(picture, cmap="gray", vmin=low, vmax=max(high, low + 1e-6 * abs(low)))
        axes.set_title(title)
        figure.colorbar(grey, ax=axes, shrink=0.8, label=f"[{pair.unit}]")
    colour = panels[2].imshow(pair.change, cmap="RdBu_r", vmin=-reach, vmax=reach)
    panels[2].set_title("on less off")
    figure.colorbar(colour, ax=panels[2], shrink=0.8, label=f"[{pair.unit}]", extend="both")
    for axes in panels:
        axes.set_axis_off()
    return figure


def _reach(change: FloatArray, *, least: float) -> float:
    """End of the colour scale."""
    seen = change[change > SLIGHT * change.max()]
    return max(float(np.percentile(seen, CLEAR)), least) if seen.size else least
