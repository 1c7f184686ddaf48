"""False colours: tables of 256 colours from black to white display code, and the scale that belongs to a picture."""

from collections.abc import Mapping

import numpy as np
import numpy.typing as npt

from sensorsim.radiometry import BandTable, FloatArray
from sensorsim.sensor import DisplaySettings, window_limits

Colours = npt.NDArray[np.uint8]

# Stops: grey from 0 to 1, then red, green, blue.
_STOPS: Mapping[str, tuple[tuple[float, float, float, float], ...]] = {
    "grey": ((0.0, 0.0, 0.0, 0.0), (1.0, 1.0, 1.0, 1.0)),
    "iron": (
        *((0.0, 0.0, 0.0, 0.0), (0.15, 0.13, 0.0, 0.45), (0.4, 0.60, 0.05, 0.60), (0.6, 0.90, 0.30, 0.25)),
        *((0.8, 1.0, 0.65, 0.0), (0.93, 1.0, 0.92, 0.4), (1.0, 1.0, 1.0, 0.95)),
    ),
    "rainbow": (
        *((0.0, 0.0, 0.0, 0.35), (0.15, 0.0, 0.2, 0.9), (0.35, 0.0, 0.75, 0.85), (0.5, 0.1, 0.75, 0.2)),
        *((0.7, 0.95, 0.9, 0.1), (0.87, 0.95, 0.35, 0.0), (1.0, 0.75, 0.0, 0.1)),
    ),
    "cold-warm": ((0.0, 0.1, 0.3, 0.85), (0.5, 0.93, 0.93, 0.93), (1.0, 0.8, 0.1, 0.1)),
    "hottest red": ((0.0, 0.0, 0.0, 0.0), (0.94, 0.94, 0.94, 0.94), (0.941, 0.8, 0.0, 0.0), (1.0, 1.0, 0.35, 0.1)),
}
PALETTES = tuple(_STOPS)


def palette_table(name: str) -> Colours:
    """Colours (256, 3) of display codes under one of PALETTES."""
    stops = np.array(_STOPS[name])
    grey = np.linspace(0.0, 1.0, 256)
    mixed = np.column_stack([np.interp(grey, stops[:, 0], stops[:, channel]) for channel in (1, 2, 3)])
    return np.asarray(np.floor(255.0 * mixed + 0.5), dtype=np.uint8)


def paint(codes: npt.NDArray[np.uint8], table: Colours) -> Colours:
    """Picture (height, width, 3) of display codes (height, width)."""
    return np.ascontiguousarray(table[codes])


def scale_values(
    display: DisplaySettings, table: BandTable | None, count: int, curve: FloatArray | None = None
) -> FloatArray:
    """What grey means at `count` equal steps from display code 0 to 255, under a fixed window.

    Apparent temperature [K] through the table of an emissive band, else band radiance [W m-2 sr-1]. `curve` is the
    tone curve of the picture where its greys are no straight line. Values outside the table are those of its ends.
    """
    low, high = window_limits(display)
    grey = np.linspace(0.0, 1.0, count)
    if display.polarity == "black-hot":
        grey = 1.0 - grey
    if curve is not None:
        grey = _inverse(curve, grey)
    radiance = low + grey * (high - low)
    if table is None:
        return np.asarray(radiance)
    return table.apparent_temperature(np.clip(radiance, table.radiance[0], table.radiance[-1]))


def _inverse(curve: FloatArray, grey: FloatArray) -> FloatArray:
    """Place in the window, 0 to 1, where a curve that never falls has a grey: the middle of where it stands still."""
    steps = np.linspace(0.0, 1.0, curve.size)
    first = np.minimum(np.searchsorted(curve, grey - 1e-9, side="left"), curve.size - 1)
    last = np.maximum(np.searchsorted(curve, grey + 1e-9, side="right") - 1, 0)
    return np.where(first <= last, 0.5 * (steps[first] + steps[last]), np.interp(grey, curve, steps))
