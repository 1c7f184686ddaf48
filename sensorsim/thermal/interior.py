"""The interior condition of a feature as air and radiant temperature: section 3.1.3 of [Report1978].

Heated: kept above 65 F. Cooled: kept within 65 to 75 F. Unheated: enclosed air that finds its own temperature.
Open: outdoor air. None: no room behind, but deep ground (or the far side of a canopy) at the mean of the weather.

The air of a closed room is one node for each square metre of floor, with everything that warms and cools along with it:

    time_constant dT/dt = T_outdoor + heat_gain / loss_coefficient - T

in which the loss coefficient sums up the envelope and the change of air. It is solved exactly for outdoor air that is
linear between samples, from the steady state of the mean weather, and a thermostat holds what it leaves within its
limits. The node hears of the sun only through the outdoor air: with the walls' own heat it would couple all walls of a
feature. In full sun a hall of sheet metal is 5 to 10 K warmer inside than this (estimate), its outer faces a third of
that or less, those of masonry a seventh.

The inside faces of a room see each other at the temperature of its air. A cold wall really sees other cold walls among
partitions and furniture. Where those bring the mean down by 3 K, at -10 C and a moderate wind, the outer face is colder
than here by 0.05 K through the insulated wall, 0.25 K through brick and 0.55 K through bare sheet metal.
"""

import numpy as np
from numba import njit

from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.errors import InputError
from sensorsim.materials import INTERIORS, Room
from sensorsim.thermal.boundary import Inside
from sensorsim.thermal.convection import INTERIOR_FREE
from sensorsim.thermal.grid import FloatArray
from sensorsim.units import kelvin_from_fahrenheit

HEATED_ABOVE = kelvin_from_fahrenheit(65.0)  # [K]
COOLED_BELOW = kelvin_from_fahrenheit(75.0)  # [K]
STILL_AIR_FILM = 0.5  # [W m-2 K-1] draught in a closed room, estimate; free convection does the rest
DEEP_FILM = 1000.0  # [W m-2 K-1] holds the inner face at the deep temperature


def build_interior(
    condition: str,
    air: FloatArray,
    wind_speed: FloatArray,
    step: float,
    emissivity: float,
    *,
    room: Room | None = None,
    heat_gain: float = 0.0,
    plan: EffectPlan = EVERYTHING,
) -> Inside:
    """Interior boundary of a wall for outdoor air (t,) [K] and wind (t,) [m s-1], samples `step` [s] apart.

    `heat_gain` is what people, lamps and machines give off [W per m2 of floor]; a closed `room` needs it and its own
    numbers. Where the plan leaves the interior out, no heat passes the inner face, and its air only shapes the start.
    Raises InputError for an unknown condition.
    """
    if condition not in INTERIORS:
        raise InputError("wall type", "interior", condition, "unknown condition", f"use one of {', '.join(INTERIORS)}")
    inside = _behind(condition, air, wind_speed, step, emissivity, room, heat_gain)
    if plan.has("interior"):
        return inside
    return inside._replace(film=np.zeros_like(air), free=0.0, emissivity=0.0)


def _behind(
    condition: str, air: FloatArray, wind_speed: FloatArray, step: float, emissivity: float, room: Room | None,
    heat_gain: float,
) -> Inside:  # fmt: skip
    """What lies behind the wall."""
    free = INTERIOR_FREE**3
    if condition == "open":
        return Inside(air, air, 2.0 + wind_speed, free, emissivity)
    if condition == "none":
        deep = np.full_like(air, float(np.mean(air)))
        return Inside(deep, deep, np.full_like(air, DEEP_FILM), 0.0, emissivity)
    indoors = room_air(condition, air, step, room=Room() if room is None else room, heat_gain=heat_gain)
    return Inside(indoors, indoors, np.full_like(air, STILL_AIR_FILM), free, emissivity)


def room_air(condition: str, air: FloatArray, step: float, *, room: Room, heat_gain: float = 0.0) -> FloatArray:
    """Air (t,) [K] of a heated, cooled or unheated room under outdoor air (t,) [K]."""
    indoors = _lagged(air, step, room.time_constant) + heat_gain / room.loss_coefficient
    if condition in ("heated", "cooled"):
        indoors = np.maximum(indoors, HEATED_ABOVE)
    if condition == "cooled":
        indoors = np.minimum(indoors, COOLED_BELOW)
    return indoors


def _lagged(air: FloatArray, step: float, time_constant: float) -> FloatArray:
    """First-order lag of air that is linear between samples, started from its mean."""
    ratio = step / time_constant
    keep, level = float(np.exp(-ratio)), float(-np.expm1(-ratio) / ratio)
    newest, last = 1.0 - level, level - keep
    return _filtered(newest * air[1:] + last * air[:-1], keep, float(np.mean(air)))


@njit(cache=True, nogil=True)
def _filtered(drive: FloatArray, keep: float, start: float) -> FloatArray:
    """What `keep` of each value and the next of `drive` (n,) add up to, (n + 1,)."""
    out = np.full(drive.size + 1, start)
    for k in range(drive.size):
        out[k + 1] = drive[k] + keep * out[k]
    return out
