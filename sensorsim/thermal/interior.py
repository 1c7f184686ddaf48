"""The interior condition of a feature as air and radiant temperature: section 3.1.3 of [Report1978].

Heated: kept above 65 F. Cooled: kept within 65 to 75 F. Unheated: enclosed air that follows the outdoors with a lag.
Open: outdoor air. None: no room behind, but deep ground (or the far side of a canopy) at the mean of the weather.
Without heating or cooling a closed room follows the running mean of the outdoor air, with a time constant of half a
day (estimate: between a tin shed's hours and a masonry hall's day).
"""

import numpy as np
from scipy.signal import lfilter

from sensorsim.errors import InputError
from sensorsim.thermal.boundary import Inside
from sensorsim.thermal.convection import INTERIOR_FREE
from sensorsim.thermal.grid import FloatArray
from sensorsim.units import kelvin_from_fahrenheit

HEATED_ABOVE = kelvin_from_fahrenheit(65.0)  # [K]
COOLED_BELOW = kelvin_from_fahrenheit(75.0)  # [K]
ROOM_TIME_CONSTANT = 12.0 * 3600.0  # [s]
STILL_AIR_FILM = 0.5  # [W m-2 K-1] draught in a closed room, estimate; free convection does the rest
DEEP_FILM = 1000.0  # [W m-2 K-1] holds the inner face at the deep temperature
CONDITIONS = ("heated", "cooled", "unheated", "open", "none")


def build_interior(condition: str, air: FloatArray, wind_speed: FloatArray, step: float, emissivity: float) -> Inside:
    """Interior boundary of a wall for outdoor air (t,) [K] and wind (t,) [m s-1], samples `step` [s] apart."""
    if condition not in CONDITIONS:
        raise InputError("wall type", "interior", condition, "unknown condition", f"use one of {', '.join(CONDITIONS)}")
    still = np.full_like(air, STILL_AIR_FILM)
    free = INTERIOR_FREE**3
    if condition == "open":
        return Inside(air, air, 2.0 + wind_speed, free, emissivity)
    if condition == "none":
        deep = np.full_like(air, float(np.mean(air)))
        return Inside(deep, deep, np.full_like(air, DEEP_FILM), 0.0, emissivity)
    room = _lagged(air, step)
    if condition in ("heated", "cooled"):
        room = np.maximum(room, HEATED_ABOVE)
    if condition == "cooled":
        room = np.minimum(room, COOLED_BELOW)
    return Inside(room, room, still, free, emissivity)


def _lagged(air: FloatArray, step: float) -> FloatArray:
    """First-order lag of the outdoor air, started from its mean."""
    keep = float(np.exp(-step / ROOM_TIME_CONSTANT))
    lagged, _ = lfilter([1.0 - keep], [1.0, -keep], air, zi=[keep * float(np.mean(air))])
    return np.asarray(lagged)
