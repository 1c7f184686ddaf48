"""From band radiance to the grey of the display: gain, level and polarity.

The detector is linear: its signal is the band radiance x [W m-2 sr-1]. The operator's window is `span` wide with
`level` in its middle:

    grey = clip((x - (level - span / 2)) / span, 0, 1), or 1 - grey when black is hot
    display code = floor(255 grey + 1/2)

Gain is 1 / span. The clip is the display's own black and white, what lies outside the window is saturated there.
A tone curve may bend the line before the polarity (see `tone`).
`display_code` is the reference that the display shader is held to.
"""

import math
from dataclasses import dataclass, replace
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from sensorsim.errors import InputError, NumericsError
from sensorsim.radiometry import BandTable, FloatArray
from sensorsim.sensor.tone import Tone

Polarity = Literal["white-hot", "black-hot"]

RELATIVE_SPAN_FLOOR = (
    1e-3  # of the level: 60 mK at 290 K in 8-14 um, so that no automatic gain shows rounding as a scene
)
ABSOLUTE_SPAN_FLOOR = 1e-9  # [W m-2 sr-1]; for a frame of no radiance at all
TAIL = 0.01  # share of the pixels that an automatic window saturates at each end
LIMITS = {
    "gamma": (0.2, 5.0, "use 1 for a straight line"),
    "tail": (0.0, 0.49, "give the share of pixels to saturate at each end"),
    "detail": (0.0, 20.0, "use 1 for the picture as it is"),
    "settle": (0.0, 60.0, "give seconds, or 0 for a gain that follows at once"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class DisplaySettings:
    """Polarity, window and tone of the display; a level or span [W m-2 sr-1] of None is chosen for each frame.

    Raises InputError for an unknown polarity or tone, a level that is not finite, a span that is not finite and above
    zero, and numbers outside of LIMITS.
    """

    polarity: Polarity = "white-hot"
    level: float | None = None
    span: float | None = None
    tone: Tone = "linear"
    gamma: float = 1.0  # of the screen: grey to the power 1 / gamma
    tail: float = TAIL  # share of the pixels that an automatic window leaves below it, and above [-]
    detail: float = 1.0  # gain of what differs from a smooth base [-]; 1: as it is
    settle: float = 0.0  # time constant with which automatic window and tone follow the frames [s]; 0: at once

    def __post_init__(self) -> None:
        where = "display settings"
        if self.polarity not in get_args(Polarity):
            raise InputError(where, "polarity", self.polarity, "unknown", f"use {' or '.join(get_args(Polarity))}")
        if self.level is not None and not math.isfinite(self.level):
            raise InputError(where, "level", self.level, "not finite", "give a band radiance in W m-2 sr-1")
        if self.span is not None and not (math.isfinite(self.span) and self.span > 0.0):
            raise InputError(where, "span", self.span, "not finite and above zero", "give a width in W m-2 sr-1")
        if self.tone not in get_args(Tone):
            raise InputError(where, "tone", self.tone, "unknown", f"use {' or '.join(get_args(Tone))}")
        for entry, (low, high, remedy) in LIMITS.items():
            if not low <= getattr(self, entry) <= high:
                raise InputError(where, entry, getattr(self, entry), f"outside of {low:g} to {high:g}", remedy)

    @property
    def gain(self) -> float | None:
        """Grey per band radiance [W-1 m2 sr], 1 / span, or None where the span is automatic."""
        return None if self.span is None else 1.0 / self.span

    @property
    def is_straight(self) -> bool:
        """Whether grey is a straight line in radiance."""
        return self.tone == "linear" and self.gamma == 1.0

    @property
    def is_automatic(self) -> bool:
        """Whether level or span still has to be chosen from a frame."""
        return self.level is None or self.span is None


def auto_window(radiance: npt.ArrayLike, *, tail: float = TAIL) -> tuple[float, float]:
    """Level and span [W m-2 sr-1] that leave the share `tail` of the pixels below the window and as many above it.

    radiance: any shape, at least one pixel, finite. The span is never below `RELATIVE_SPAN_FLOOR` of the level nor
    below `ABSOLUTE_SPAN_FLOOR`, so a frame of one radiance becomes middle grey.
    Raises InputError for a tail outside [0, 0.5), NumericsError for a frame that is empty or not finite.
    """
    if not 0.0 <= tail < 0.5:
        raise InputError("automatic window", "tail", tail, "outside [0, 0.5)", "give the share of pixels to saturate")
    pixels = np.asarray(radiance).ravel()
    if pixels.size == 0 or not np.isfinite(pixels).all():
        raise NumericsError(f"automatic window: {pixels.size} pixels, all of which must be finite")
    low, high = _quantiles(pixels, (tail, 1.0 - tail))
    level = (low + high) / 2.0
    return level, max(high - low, RELATIVE_SPAN_FLOOR * abs(level), ABSOLUTE_SPAN_FLOOR)


def _quantiles(values: npt.NDArray[Any], shares: tuple[float, ...]) -> tuple[float, ...]:
    """Quantiles of values (n,), linear between two of them, in double precision.

    All are sorted, in the precision that they come in: processors do that four times as fast as they pick out a few.
    """
    ordered, found = np.sort(values), []
    for share in shares:
        place = (values.size - 1) * share
        row = math.floor(place)
        low, high = float(ordered[row]), float(ordered[min(row + 1, values.size - 1)])
        found.append(low + (high - low) * (place - row))
    return tuple(found)


def window_from_temperatures(table: BandTable, low: float, high: float) -> tuple[float, float]:
    """Level and span [W m-2 sr-1] of the window between two blackbody temperatures [K].

    Raises InputError where low is not below high, NumericsError outside the table.
    """
    if not low < high:
        raise InputError(
            "display window", "temperatures [K]", (low, high), "not increasing", "give the colder one first"
        )
    darkest, brightest = (float(value) for value in table.radiance_at((low, high)))
    return (darkest + brightest) / 2.0, brightest - darkest


def fix_window(settings: DisplaySettings, radiance: npt.ArrayLike) -> DisplaySettings:
    """The same settings with an automatic level or span chosen by `auto_window` from this radiance [W m-2 sr-1]."""
    if not settings.is_automatic:
        return settings
    level, span = auto_window(radiance, tail=settings.tail)
    return replace(
        settings,
        level=level if settings.level is None else settings.level,
        span=span if settings.span is None else settings.span,
    )


def window_limits(settings: DisplaySettings) -> tuple[float, float]:
    """Band radiances [W m-2 sr-1] at the two ends of a fixed window; InputError for an automatic or vanishing one."""
    if settings.level is None or settings.span is None:
        window = (settings.level, settings.span)
        raise InputError("display settings", "level, span", window, "automatic", "choose them with fix_window first")
    darkest, brightest = settings.level - settings.span / 2.0, settings.level + settings.span / 2.0
    if not darkest < brightest:
        problem = f"lost in the rounding of the level {settings.level:g}"
        raise InputError("display settings", "span", settings.span, problem, "give a wider one")
    return darkest, brightest


def grey_level(radiance: npt.ArrayLike, settings: DisplaySettings, curve: FloatArray | None = None) -> FloatArray:
    """Grey in [0, 1] of band radiance [W m-2 sr-1], any shape; NumericsError where it is not finite.

    curve (n,): grey at equal steps of the window; a straight line where it is left out.
    """
    darkest, brightest = window_limits(settings)
    signal = np.asarray(radiance, dtype=np.float64)
    if not np.isfinite(signal).all():
        raise NumericsError(f"display: {np.sum(~np.isfinite(signal))} of {signal.size} pixels are not finite")
    grey = np.clip((signal - darkest) / (brightest - darkest), 0.0, 1.0)
    if curve is not None:
        grey = np.interp(grey, np.linspace(0.0, 1.0, curve.size), curve)
    return np.asarray(grey if settings.polarity == "white-hot" else 1.0 - grey)


def display_code(
    radiance: npt.ArrayLike, settings: DisplaySettings, curve: FloatArray | None = None
) -> npt.NDArray[np.uint8]:
    """Display code 0 (black) to 255 (white) of band radiance [W m-2 sr-1]; errors of `grey_level`."""
    return np.floor(255.0 * grey_level(radiance, settings, curve) + 0.5).astype(np.uint8)
