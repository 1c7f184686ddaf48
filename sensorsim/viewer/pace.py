"""How finely and how fully the next picture is drawn, so that the flight stays fluid."""

from collections import deque

import numpy as np

from sensorsim.viewer.stage import next_scale

TOLD_EVERY = 12  # pictures, of which one has all planes while the others have their display alone


class Pace:
    """What the last pictures took, and how long ago one had all planes."""

    def __init__(self) -> None:
        self.scale = 2.0  # window pixels per pixel drawn
        self._times, self._plain = deque[float](maxlen=8), 0

    def plain(self, *, moves: bool) -> bool:
        """Whether the next picture needs nothing but its display: where all moves, but for one in a few.

        That one tells the range and the histogram.
        """
        self._plain = self._plain + 1 if moves and self._plain < TOLD_EVERY else 0
        return self._plain > 0

    def took(self, seconds: float) -> None:
        """Fewer pixels from now on where pictures are slow, more where they are quick."""
        self._times.append(seconds)
        scale = next_scale(self.scale, np.array(self._times))
        if scale != self.scale:
            self.scale = scale
            self._times.clear()
