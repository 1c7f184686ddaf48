"""Numbers that follow a sequence of frames with a time constant, so that no frame makes the picture jump.

The mean of what the last frames found, each weighed by exp(-age / time constant), over MEMORY time constants. It is a
recursive filter whose memory ends: a frame is the same whether the sequence was drawn from its beginning or from so
much before it, by one process or by several.
"""

import math

import numpy as np

from sensorsim.radiometry import FloatArray

MEMORY = 4.0  # time constants; what is older would count for less than 1 / 50


class Settling:
    """What frames of successive numbers have found. A number that does not follow begins anew."""

    def __init__(self, period: float) -> None:
        """period: least time from one frame to the next [s], for a clock that stands still."""
        self.period = period
        self.found: list[tuple[int, float, FloatArray]] = []  # number, time [s], values

    def settle(self, frame: int, time: float, values: FloatArray, time_constant: float) -> FloatArray:
        """The mean up to this frame, at a time of the day [s], of values of any one shape; a frame may come again."""
        earlier = [one for one in self.found if one[0] < frame and one[2].shape == values.shape]
        follows = bool(earlier) and earlier[-1][0] == frame - 1
        found = [*(earlier if follows else []), (frame, time, values)]
        ages = [max(abs(time - then), (frame - number) * self.period) for number, then, _ in found]
        kept = [(age, one) for age, one in zip(ages, found, strict=True) if age <= MEMORY * time_constant]
        self.found = [one for _, one in kept]
        weight = np.array([math.exp(-age / time_constant) for age, _ in kept])
        return np.asarray(np.tensordot(weight / weight.sum(), np.array([one[2] for _, one in kept]), axes=1))
