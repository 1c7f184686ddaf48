"""Tone curves of the display: what grey each part of the window gets, beyond the straight line.

plateau: the histogram of the window, none of its bins above a plateau, summed up, so that grey goes where pixels are;
its slope is held below a limit, so that empty sky does not turn into noise [FLIR2013]. gamma: grey to the power 1 /
gamma. Curves are given at TONE_ENTRIES equal steps of the window and are straight in between.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from sensorsim.radiometry import FloatArray

Tone = Literal["linear", "plateau"]
TONE_ENTRIES = 512


@dataclass(frozen=True, slots=True, kw_only=True)
class ToneLimits:
    """How far equalisation may go."""

    plateau: float = 3.0  # highest bin over the mean one [-]
    slope: float = 4.0  # steepest part over the straight line [-]


def tone_curve(
    tone: Tone, gamma: float, radiance: npt.ArrayLike, low: float, high: float, limits: ToneLimits | None = None
) -> FloatArray:
    """Grey (TONE_ENTRIES,) at equal steps from `low` to `high` [W m-2 sr-1], from the pixels of a frame."""
    if tone == "plateau":
        grey = _equalised(np.asarray(radiance, dtype=np.float64).ravel(), low, high, limits or ToneLimits())
    else:
        grey = np.linspace(0.0, 1.0, TONE_ENTRIES)
    return np.asarray(np.clip(grey, 0.0, 1.0) ** (1.0 / gamma))


def _equalised(pixels: FloatArray, low: float, high: float, limits: ToneLimits) -> FloatArray:
    """Grey (TONE_ENTRIES,), spread around the middle where the limits leave some unused."""
    bins = TONE_ENTRIES - 1
    count, _ = np.histogram(pixels, bins=bins, range=(low, high))
    inside = max(int(count.sum()), 1)
    share = np.minimum(count / inside, limits.plateau / bins)
    rise = share / share.sum() if share.sum() > 0.0 else np.full(bins, 1.0 / bins)
    rise = np.minimum(rise, limits.slope / bins)
    grey = np.concatenate([[0.0], np.cumsum(rise)])
    return np.asarray(grey + 0.5 * (1.0 - grey[-1]))
