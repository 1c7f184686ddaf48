"""How a picture is put together line by line: lines that cover several rows, and fields that come in turn.

A raster of fewer lines than the picture has rows shows each line in all rows that it covers. An interlaced frame of
number n brings the lines n, n + fields, n + 2 fields and so on; the others stay as the frames before have left them, so
that what moves has a comb. A picture that follows no other has all its lines at once.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.sensor.scan import Scan

HELD = -1  # of a row that stays


def is_plain(scan: Scan) -> bool:
    """Whether each row is a line of its own and all come with every frame."""
    return scan.interlace == 1 and scan.lines == 0


def source_rows(scan: Scan, rows: int, frame: int, *, follows: bool) -> NDArray[np.int64]:
    """Row (rows,) of the report that each row shows as that frame, counted from the top; HELD where it stays."""
    lines = min(scan.lines, rows) if scan.lines else rows
    line = (2 * np.arange(rows, dtype=np.int64) + 1) * lines // (2 * rows)
    middle = (2 * line + 1) * rows // (2 * lines)
    fresh = (line - frame) % scan.interlace == 0
    return np.where(fresh | (not follows), middle, HELD)


def weave(shown: NDArray[Any], reported: NDArray[Any], rows: NDArray[np.int64]) -> None:
    """Bring a report into the picture shown, both (height, width); the twin of shaders/sensor/raster.frag."""
    fresh = rows != HELD
    shown[fresh] = reported[rows[fresh]]
