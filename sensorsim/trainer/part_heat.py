"""How much warmer than its sunlit skin each part of a vehicle is, from what the vehicle does.

A part goes to the excess of its vehicle's state, dx/dt = (goal - x) / time constant, with one constant for warming and
a longer one for cooling; steps are exact for any length. Excesses and constants are estimates.
"""

from dataclasses import dataclass

import numpy as np

from sensorsim.trainer.rotations import FloatArray
from sensorsim.trainer.vehicle_shape import PARTS

FULL_SPEED = 15.0  # [m s-1] at which parts are as hot as they get
BURNING = 300.0  # [K] excess of every part of a vehicle on fire
FIRE_SPREADS = 60.0  # [s]
# By the rows of PARTS: skin, engine, exhaust, tracks, wheels, cabin
IDLE = np.array([0.0, 25.0, 90.0, 0.0, 0.0, 8.0])  # [K] engine running, vehicle standing
MOVING = np.array([0.0, 20.0, 110.0, 30.0, 18.0, 0.0])  # [K] more at full speed
WARMING = np.array([300.0, 600.0, 60.0, 600.0, 900.0, 600.0])  # [s]
COOLING = np.array([300.0, 2400.0, 300.0, 900.0, 1200.0, 1200.0])  # [s]


@dataclass(frozen=True, slots=True, kw_only=True)
class Doing:
    """What a vehicle does. speed [m s-1]; one that moves has its engine on."""

    engine_on: bool
    speed: float = 0.0
    burning: bool = False


def steady_excess(doing: Doing) -> FloatArray:
    """Excess of each part (p,) [K] of a vehicle that has long been doing this."""
    if doing.burning:
        return np.full(len(PARTS), BURNING)
    share = min(doing.speed / FULL_SPEED, 1.0)
    return IDLE * doing.engine_on + MOVING * share


def excess_after(excess: FloatArray, doing: Doing, elapsed: float) -> FloatArray:
    """Excess (p,) [K] after a time [s] of this; as it is for a time that is not above 0."""
    if elapsed <= 0.0:
        return excess
    goal = steady_excess(doing)
    constant = np.where(goal > excess, FIRE_SPREADS if doing.burning else WARMING, COOLING)
    return np.asarray(goal + (excess - goal) * np.exp(-elapsed / constant))
