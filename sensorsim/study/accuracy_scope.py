"""How much of the days a trial is measured on: all of them, or what a dear setting leaves time for."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.study.accuracy_measure import StudyDay
from sensorsim.study.accuracy_trials import Trial
from sensorsim.tables import BakeSettings, orientation_set
from sensorsim.tables.orientations import FloatArray, IntArray

MOST_WORK = 4e7  # columns times steps that a preset or a combination may march: the standard's catalogue on four days
USUAL_LEAD_IN = 2.0  # [days] that walls of their own lead-in take on the mean
FACTOR_WALLS = 6  # wall types that one knob's turns are measured on


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Scope:
    """Days with the surfaces that a trial is measured on, and the full solve of those."""

    days: tuple[StudyDay, ...]
    truth: Mapping[date, FloatArray]  # (t, m) [K] by day
    share: float  # of the wall types that are baked [-]
    words: str


def scope_of(trial: Trial, days: Sequence[StudyDay], truth: Mapping[date, FloatArray]) -> Scope:
    """All days; of what would take more than MOST_WORK the first, with as many wall types as it leaves time for.

    One knob's turns are all measured on the same FACTOR_WALLS wall types of the first day.
    """
    walls, each = len(days[0].sample.surfaces.wall_types), work(trial.settings)
    if trial.group == "factor":
        days, count = days[:1], min(FACTOR_WALLS, walls)
    else:
        days = days if each * walls * len(days) <= MOST_WORK else days[:1]
        count = int(np.clip(MOST_WORK // each, 1, walls))
    words = ", ".join(day.day.isoformat() for day in days)
    if count == walls:
        return Scope(days=tuple(days), truth=truth, share=1.0, words=words)
    day, kept = narrow(days[0], count)
    words = f"{words}, {count} of {walls} wall types"
    return Scope(days=(day,), truth={day.day: truth[day.day][:, kept]}, share=count / walls, words=words)


def work(settings: BakeSettings) -> float:
    """Columns times steps of the march that a bake of one wall type takes."""
    columns = orientation_set(settings.orientations).normal.shape[0] * len(settings.reflectances)
    lead_in = USUAL_LEAD_IN if settings.lead_in_days is None else settings.lead_in_days
    return float(columns * (lead_in + 1.0) * SECONDS_PER_DAY / settings.step)


def narrow(day: StudyDay, count: int) -> tuple[StudyDay, IntArray]:
    """The day with `count` wall types, and the rows (m,) of the surfaces that are left.

    Those of the most surfaces; walls of buildings before plants and ground, whose errors are smaller.
    """
    surfaces, sample = day.sample.surfaces, day.sample
    often = np.bincount(surfaces.wall_type, minlength=len(surfaces.wall_types))
    built = np.array([wall.interior != "none" for wall in surfaces.wall_types])
    walls = np.sort(np.lexsort((-often, ~built))[:count])
    place = np.full(often.size, -1)
    place[walls] = np.arange(walls.size)
    kept = np.flatnonzero(place[surfaces.wall_type] >= 0)
    row_of = np.full(surfaces.wall_type.size + 1, -1)
    row_of[kept] = np.arange(kept.size)
    few = replace(
        surfaces,
        wall_types=tuple(surfaces.wall_types[row] for row in walls),
        wall_type=place[surfaces.wall_type[kept]],
        normal=surfaces.normal[kept],
        reflectance=surfaces.reflectance[kept],
    )
    world = day.world
    if world is not None:
        assignment = replace(
            world.assignment, wall_types=few.wall_types, wall_type=np.maximum(place[world.assignment.wall_type], 0)
        )
        world = replace(world, assignment=assignment)
    return replace(day, sample=replace(sample, surfaces=few, row_of=row_of[sample.row_of]), world=world), kept
