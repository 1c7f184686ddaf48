"""Deviates of the rows and columns of frame after frame: `read_out.frame_noise`, what stays computed once."""

import numpy as np
from numpy.typing import NDArray

from sensorsim.sensor.read_out import frame_noise, stream_seed
from sensorsim.sensor.row_kernels import deviate_row
from sensorsim.sensor.sensor import Sensor

Single = NDArray[np.float32]
CHANGING = ("t", "tv", "th")  # streams that are drawn anew for each frame


class LineNoise:
    """Noise of the lines of one sensor at one size."""

    def __init__(self, sensor: Sensor, size: tuple[int, int], deviates: Single) -> None:
        self.sensor, self.deviates = sensor, deviates
        noise = sensor.noise
        first = frame_noise(sensor, size, 0)
        self.row, self.line = np.zeros(size[1]), np.zeros(size[0])
        t, tv, th = self._drawn(0)
        self.row, self.line = first.row - noise.t * t[0] - noise.tv * tv, first.line - noise.th * th

    def at(self, frame: int) -> tuple[Single, Single]:
        """Deviates (height,) and (width,) of the frame of that number."""
        noise = self.sensor.noise
        t, tv, th = self._drawn(frame)
        row, line = self.row + noise.t * t[0] + noise.tv * tv, self.line + noise.th * th
        return row.astype(np.float32), line.astype(np.float32)

    def _drawn(self, frame: int) -> list[Single]:
        drawn = [np.zeros(count, np.float32) for count in (1, self.row.size, self.line.size)]
        for name, out in zip(CHANGING, drawn, strict=True):
            deviate_row(0, frame, stream_seed(self.sensor, name), self.deviates, out)
        return drawn
