"""Charge above a full well: it spills along the column, and fills the wells that it comes to until it is used up.

Half of what spills goes up, half goes down; a drain may take the rest. What reaches the picture's edge is gone, and so
is what two streaks bring to one well beyond its brim. The NumPy twin of shaders/sensor/bloom.frag.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray


def bloomed(light: NDArray[Any], full: float, share: float) -> NDArray[Any]:
    """Light (height, width) [W m-2 sr-1] with its wells filled up to `full`, and a share of the rest in others."""
    kind = light.dtype.type
    excess = np.maximum(light - kind(full), kind(0.0))
    room = np.maximum(kind(full) - light, kind(0.0))
    spills = kind(0.5 * share) * excess
    return np.asarray(light - excess + _caught(spills, room) + _caught(spills[::-1], room[::-1])[::-1])


def _caught(spills: NDArray[Any], room: NDArray[Any]) -> NDArray[Any]:
    """What each well catches of the charge that comes down the column to it."""
    caught, carried = np.zeros_like(room), np.zeros_like(room[0])
    for row in range(len(room)):
        caught[row] = np.minimum(carried, room[row])
        carried = carried - caught[row] + spills[row]
    return caught
