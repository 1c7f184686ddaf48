"""How a picture is put together, as data: all at once, or by a detector that sweeps the scene."""

import math
from dataclasses import dataclass
from typing import Literal, get_args

from sensorsim.errors import InputError

Pattern = Literal["staring", "parallel", "raster"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Scan:
    """Pattern and electronics; zero stands for what a pattern does not have.

    staring: every element has its pixel. parallel: a column of detectors sweeps along the rows, `channels` of them
    over the picture's height, again and again a line farther where there are more rows than channels. raster: one spot
    after the other, as in a tube.
    """

    pattern: Pattern = "staring"
    frame_rate: float = 30.0  # [Hz]
    interlace: int = 1  # fields of a frame, which come in turn
    lines: int = 0  # of the raster, over the whole height; 0: as many as the picture has rows
    channels: int = 0  # of a parallel scan
    efficiency: float = 1.0  # share of the time in which a scanner looks at the scene [-]
    electronics: float = 0.0  # cut-off of the amplifier [Hz]
    ac_coupling: float = 0.0  # cut-off below which a channel forgets its level [Hz]
    equal_angle: bool = False  # columns are equally spaced in angle, as a turning mirror has it

    def __post_init__(self) -> None:
        """Refuse what no scanner does."""
        if self.pattern not in get_args(Pattern):
            remedy = f"use one of {', '.join(get_args(Pattern))}"
            raise InputError("scan", "pattern", self.pattern, "unknown", remedy)
        checks = (
            ("frame_rate", 0.01, 1e5), ("interlace", 1, 8), ("lines", 0, 10000), ("channels", 0, 10000),
            ("efficiency", 0.01, 1.0), ("electronics", 0.0, 1e9), ("ac_coupling", 0.0, 1e6),
        )  # fmt: skip
        for entry, low, high in checks:
            value = getattr(self, entry)
            whole = entry not in ("interlace", "lines", "channels") or type(value) is int
            if not (math.isfinite(value) and low <= value <= high and whole):
                raise InputError("scan", entry, value, f"not {low:g} to {high:g}", "give what the scanner has")
        if self.pattern == "parallel" and self.channels == 0:
            raise InputError("scan", "channels", 0, "none in a parallel scan", "give the number of detectors")
        swept = self.channels or self.lines or self.ac_coupling or self.electronics or self.equal_angle
        if self.pattern == "staring" and swept:
            problem = "has no channels, lines or electronics of a scan"
            raise InputError("scan", "pattern", "staring", problem, "leave them out")

    def sweep_rate(self, field_of_view: float, rows: int) -> float:
        """Angle along a row per time [rad s-1] over a horizontal field [rad] of `rows`; 0 where nothing sweeps."""
        if self.pattern == "staring":
            return 0.0
        sweeps = rows if self.pattern == "raster" else max(1.0, rows / self.channels)
        return field_of_view * sweeps * self.frame_rate / self.efficiency
