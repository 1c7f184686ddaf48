"""Error and cost of bake settings: tables are baked and held against the full solve of the very surfaces.

Errors are taken every twelve minutes of the day, on slices and between them.
"""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from datetime import date

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY, SECONDS_PER_HOUR
from sensorsim.environment import Weather, build_environment, longest_lead_in
from sensorsim.materials import WallType
from sensorsim.render import World
from sensorsim.study.accuracy_surfaces import Sample, facing
from sensorsim.study.accuracy_trials import Trial
from sensorsim.tables import BakeSettings, ShadeTables, bake_tables
from sensorsim.tables.full_solve import FINE_STEP, SurfaceSet, fine_environment, fine_settings, solve_surfaces
from sensorsim.tables.orientations import FloatArray
from sensorsim.tables.shade import shade

Progress = Callable[[str, int, int], None]

SPACING = 720.0  # [s] between the times of day that are looked at; full hours are among them
TIMES = np.linspace(0.0, SECONDS_PER_DAY, round(SECONDS_PER_DAY / SPACING) + 1)
BINS = np.geomspace(1e-4, 10.0, 51)  # [K] of the histograms; what lies beyond goes to the first and the last bin
MEBIBYTE = 2.0**20


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class StudyDay:
    """One image day with the surfaces that are looked at on it."""

    day: date
    weather: Weather
    ground: WallType
    sample: Sample
    world: World | None  # to draw frames of; None for a catalogue


@dataclass(frozen=True, slots=True, kw_only=True)
class Worst:
    """Where the largest error is."""

    wall: WallType
    orientation: str
    reflectance: float
    hour: float
    day: date

    def __str__(self) -> str:
        clock = f"{int(self.hour):02d}:{round(self.hour % 1.0 * 60.0):02d}"
        place = f"{wall_words(self.wall)}, {self.orientation}, reflectance {self.reflectance:.2f}"
        return f"{place}, {clock} on {self.day.isoformat()}"


def wall_words(wall: WallType) -> str:
    """Name of a wall type with the condition behind it."""
    return wall.name if wall.interior == "none" else f"{wall.name} ({wall.interior})"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Score:
    """What a trial costs and how far it misses."""

    trial: Trial
    rms: float  # [K]
    p99: float  # [K]
    max: float  # [K]
    worst: Worst
    bake: float  # [s] of one day and all wall types, elapsed
    bake_processor: float  # [s] of all processors together
    table: float  # [MiB] of one day and all wall types
    scope: str  # days and wall types that were measured
    count: NDArray[np.int64]  # of errors by BINS


def solve_day(day: StudyDay, surfaces: SurfaceSet, settings: BakeSettings) -> FloatArray:
    """Temperatures (t, m) [K] of surfaces at TIMES, by the full solve under the sky and film of the settings."""
    environment = fine_environment(day.weather, day.day)
    record = environment.image_window.start + np.arange(TIMES.size) * round(SPACING / FINE_STEP)
    fine = fine_settings(settings)
    return solve_surfaces(environment, surfaces, ground=day.ground, record=record, settings=fine)


def timed_bake(day: StudyDay, settings: BakeSettings) -> tuple[ShadeTables, float, float]:
    """Tables of all wall types of a day, baked anew, with elapsed and processor time [s]."""
    lead_in = longest_lead_in(day.weather, day.day) if settings.lead_in_days is None else settings.lead_in_days
    environment = build_environment(day.weather, image_day=day.day, lead_in_days=lead_in, step=settings.step)
    elapsed, processor = time.perf_counter(), time.process_time()
    tables = bake_tables(environment, day.sample.surfaces.wall_types, ground=day.ground, settings=settings)
    return tables, time.perf_counter() - elapsed, time.process_time() - processor


def fitted(tables: ShadeTables, surfaces: SurfaceSet) -> FloatArray:
    """Temperatures (t, m) [K] of surfaces at TIMES as the tables have them."""
    normal, wall_type, reflectance = surfaces.normal, surfaces.wall_type, surfaces.reflectance
    place = tables.orientations.locate(normal)
    return np.stack([shade(tables.at(float(at)), place, normal, wall_type, reflectance) for at in TIMES])


def table_bytes(tables: ShadeTables) -> int:
    """Bytes of all arrays of the tables, those of their lobes included."""
    held = [getattr(tables, field.name) for field in fields(tables)]
    held += [] if tables.lobes is None else [getattr(tables.lobes, field.name) for field in fields(tables.lobes)]
    return sum(array.nbytes for array in held if isinstance(array, np.ndarray))


def score_trial(
    trial: Trial, days: Sequence[StudyDay], truth: Mapping[date, FloatArray], *, share: float = 1.0, scope: str = ""
) -> tuple[Score, Mapping[date, ShadeTables]]:
    """The trial over the days, against the full solves (t, m) [K] of them, with the tables that were baked.

    Costs are the mean of the days, over the `share` of the wall types that the days have.
    """
    tables, cost, errors = {}, [], []
    for day in days:
        tables[day.day], elapsed, processor = timed_bake(day, trial.settings)
        cost.append((elapsed, processor, table_bytes(tables[day.day])))
        errors.append(fitted(tables[day.day], day.sample.surfaces) - truth[day.day])
    elapsed, processor, size = np.mean(cost, axis=0) / share
    every = np.abs(np.concatenate([error.ravel() for error in errors]))
    score = Score(
        trial=trial,
        rms=float(np.sqrt(np.mean(every**2))),
        p99=float(np.percentile(every, 99.0)),
        max=float(every.max()),
        worst=_worst(days, errors),
        bake=float(elapsed),
        bake_processor=float(processor),
        table=float(size / MEBIBYTE),
        scope=scope,
        count=np.histogram(np.clip(every, BINS[0], BINS[-1]), BINS)[0],
    )
    return score, tables


def _worst(days: Sequence[StudyDay], errors: Sequence[FloatArray]) -> Worst:
    day, error = max(zip(days, errors, strict=True), key=lambda pair: float(np.abs(pair[1]).max()))
    at, row = np.unravel_index(int(np.abs(error).argmax()), error.shape)
    surfaces = day.sample.surfaces
    return Worst(
        wall=surfaces.wall_types[int(surfaces.wall_type[row])],
        orientation=facing(surfaces.normal[row]),
        reflectance=float(surfaces.reflectance[row]),
        hour=float(TIMES[at] / SECONDS_PER_HOUR),
        day=day.day,
    )
