"""The grey bar of a contact sheet: which radiance or apparent temperature each grey stands for."""

import math
from dataclasses import dataclass

from sensorsim.errors import InputError
from sensorsim.radiometry import BandTable
from sensorsim.sensor import DisplaySettings, window_limits


@dataclass(frozen=True, slots=True, kw_only=True)
class ScaleBar:
    """A bar over the display's window, its low end on the left.

    ticks: (position in [0, 1] from the low end, label) pairs. Raises InputError for a position outside the bar.
    """

    title: str
    ticks: tuple[tuple[float, str], ...]
    black_hot: bool = False

    def __post_init__(self) -> None:
        for position, label in self.ticks:
            if not 0.0 <= position <= 1.0:
                raise InputError("scale bar", f"tick {label!r}", position, "outside [0, 1]", "place it on the bar")


def radiance_scale(settings: DisplaySettings, *, band: str) -> ScaleBar:
    """Bar in band radiance of a fixed window; `band` names it in the title. InputError for an automatic window."""
    low, high = window_limits(settings)
    values, labels = _round_values(low, high)
    positions = [(value - low) / (high - low) for value in values]
    title = f"Band radiance, {band}: {low:.4g} to {high:.4g} W m-2 sr-1"
    return _bar(title, positions, labels, settings)


def temperature_scale(settings: DisplaySettings, table: BandTable, *, band: str) -> ScaleBar:
    """Bar in apparent temperature [K] of a fixed window; grey is linear in radiance, so its ticks are not even.

    Raises InputError for an automatic window, NumericsError for one that reaches beyond the table.
    """
    low, high = window_limits(settings)
    coldest, warmest = (float(value) for value in table.apparent_temperature((low, high)))
    values, labels = _round_values(coldest, warmest)
    positions = [(float(radiance) - low) / (high - low) for radiance in table.radiance_at(values)]
    title = f"Apparent temperature, {band}: {coldest:.1f} to {warmest:.1f} K"
    return _bar(title, positions, labels, settings)


def _bar(title: str, positions: list[float], labels: list[str], settings: DisplaySettings) -> ScaleBar:
    # A tick at the window's very end may land a rounding error beyond it.
    on_bar = [min(max(position, 0.0), 1.0) for position in positions]
    ticks = tuple(zip(on_bar, labels, strict=True))
    return ScaleBar(title=title, ticks=ticks, black_hot=settings.polarity == "black-hot")


def _round_values(low: float, high: float, most: int = 9) -> tuple[list[float], list[str]]:
    """At most `most` multiples of 1, 2 or 5 times a power of ten from low to high, and their labels."""
    power = math.floor(math.log10((high - low) / most))
    factor = next(factor for factor in (1, 2, 5, 10, 20) if (high - low) / (factor * 10.0**power) <= most - 1)
    step = factor * 10.0**power
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    values = [count * step for count in range(first, last + 1)]
    decimals = max(0, -power)
    if decimals <= 4:
        return _within(values, low, high), [f"{value:.{decimals}f}" for value in values]
    largest = max(abs(value) for value in values)
    digits = max(1, math.floor(math.log10(largest or 1.0)) + decimals + 1)
    return _within(values, low, high), [f"{value:.{digits}g}" for value in values]


def _within(values: list[float], low: float, high: float) -> list[float]:
    return [min(max(value, low), high) for value in values]
