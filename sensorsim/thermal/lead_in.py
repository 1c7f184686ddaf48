"""How long before the image day a wall of a bake begins, and how it begins where there is too little before it.

A start that is 20 K off is felt by 0.01 K after FORGOTTEN of the wall's slowest time constants: minutes for a metal
sheet, days for masonry, weeks for soil. All walls share one environment; each is marched through as much of the end of
it as it remembers. One that remembers more than there is begins periodically, see `periodic_start`.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.environment import Environment
from sensorsim.materials import WallType
from sensorsim.thermal.boundary import Inside
from sensorsim.thermal.interior import build_interior
from sensorsim.thermal.paths import GridPath, wall_paths
from sensorsim.thermal.periodic_start import mean_film
from sensorsim.thermal.wall_modes import grid_modes

FORGOTTEN = float(np.log(2000.0))  # time constants in which 20 K fall to 0.01 K
LEAST_STEPS = 12  # in which a step far longer than the time constant is forgotten too
CALM_FILM = 3.0  # [W m-2 K-1] of nearly still air: under more wind a wall forgets faster


@dataclass(frozen=True, slots=True, kw_only=True)
class LeadIn:
    """Where a wall begins."""

    time_constant: float  # [s] of its slowest mode
    first: int  # sample of the environment
    span: float  # [s] from there to the image day
    repeated: bool  # whether the first day is repeated before it, for want of a longer history


def lead_in_of(
    wall: WallType, environment: Environment, *, own: bool, paths: Sequence[GridPath] | None = None,
    inside: Inside | None = None,
) -> LeadIn:  # fmt: skip
    """Lead-in of a wall type: by its `own` time constant, else all that the environment holds.

    Of a mixture it is the longest of its parts. Melting snow has no modes and water starts from the mean of its air:
    neither is repeated. `paths` of usual cells and what is `inside`, of a plain one, are for who has them already.
    """
    if wall.parts:
        return longest([lead_in_of(part.wall, environment, own=own) for part in wall.parts])
    constant = time_constant(wall, environment, paths=paths, inside=inside)
    midnight = environment.image_window.start
    steps = max(int(np.ceil(FORGOTTEN * constant / environment.step)), LEAST_STEPS)
    first = midnight - steps if own else 0
    kept = wall.cover is not None and wall.cover.kind in ("snow", "water")
    begin = 0 if kept else max(first, 0)
    return LeadIn(
        time_constant=constant, first=begin, span=(midnight - begin) * environment.step,
        repeated=first < 0 and not kept,
    )  # fmt: skip


def longest(lead_ins: Sequence[LeadIn]) -> LeadIn:
    """Lead-in of a mixture, from those of its parts."""
    return max(lead_ins, key=lambda one: one.span)


def time_constant(
    wall: WallType, environment: Environment, *, paths: Sequence[GridPath] | None = None, inside: Inside | None = None
) -> float:
    """Time [s] in which the slowest mode of the slowest path of a plain wall type falls to 1/e, in nearly still air."""
    inside = room_of(wall, environment) if inside is None else inside
    outer = mean_film(np.array(CALM_FILM), wall.emissivity, environment.air_temperature)
    inner = mean_film(inside.film, inside.emissivity, inside.radiant)
    grids = [path.grid for path in (wall_paths(wall, environment.step) if paths is None else paths)]
    return max(grid_modes(grid, outer, grid.interior_area * inner).time_constant for grid in grids)


def room_of(wall: WallType, environment: Environment, plan: EffectPlan = EVERYTHING) -> Inside:
    """What acts on the interior face of a wall type in this weather."""
    return build_interior(
        wall.interior, environment.air_temperature, environment.wind_speed, environment.step, wall.interior_emissivity,
        room=wall.room, heat_gain=wall.heat_gain, plan=plan,
    )  # fmt: skip
