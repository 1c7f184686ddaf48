"""Automatic gain and tone over the frames of a sequence: chosen from each, settled where the display asks for it."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.radiometry import FloatArray
from sensorsim.sensor.display import DisplaySettings, fix_window, window_limits
from sensorsim.sensor.settling import Settling
from sensorsim.sensor.tone import tone_curve


class AutoGain:
    """Windows and tone curves of one sensor's frames."""

    def __init__(self, period: float) -> None:
        """period: from one frame to the next [s]."""
        self.windows, self.curves = Settling(period), Settling(period)
        self.frame, self.time = 0, 0.0

    def begin(self, frame: int, time: float) -> None:
        """A frame of that number at a time of the day [s]."""
        self.frame, self.time = frame, time

    def window(self, settings: DisplaySettings, seen: NDArray[Any]) -> DisplaySettings:
        """The settings with a fixed window, from radiances [W m-2 sr-1] of the frame that has begun."""
        fixed = fix_window(settings, seen)
        if not settings.is_automatic or settings.settle == 0.0:
            return fixed
        ends = self.windows.settle(self.frame, self.time, np.array(window_limits(fixed)), settings.settle)
        return replace(
            fixed,
            level=float(ends.mean()) if settings.level is None else settings.level,
            span=float(ends[1] - ends[0]) if settings.span is None else settings.span,
        )

    def curve(self, settings: DisplaySettings, seen: NDArray[Any]) -> FloatArray | None:
        """Tone curve of a fixed window, None for a straight line."""
        if settings.is_straight:
            return None
        found = tone_curve(settings.tone, settings.gamma, seen, *window_limits(settings))
        if settings.settle == 0.0:
            return found
        return self.curves.settle(self.frame, self.time, found, settings.settle)
