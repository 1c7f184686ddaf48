"""What the tables miss: their shade of many surfaces against the full solve of those very surfaces."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sensorsim.environment import Environment
from sensorsim.errors import InputError
from sensorsim.materials import WallType
from sensorsim.tables import BakeSettings, ShadeTables
from sensorsim.tables.full_solve import SurfaceSet, solve_surfaces
from sensorsim.tables.orientations import FloatArray
from sensorsim.tables.shade import shade


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Surfaces:
    """Surfaces that tables are tried on: every wall type at every normal, reflectance and time."""

    wall_types: tuple[WallType, ...]
    normal: FloatArray  # (n, 3) unit
    reflectance: FloatArray  # (r,) solar [-]
    time_of_day: FloatArray  # (t,) [s]


@dataclass(frozen=True, slots=True, kw_only=True)
class Miss:
    """How far tables are from the full solve [K], and where they are farthest."""

    rms: float
    p99: float  # of the absolute error
    max: float
    wall: str
    normal: tuple[float, float, float]
    reflectance: float
    time_of_day: float  # [s]


def full_solve(
    environment: Environment, surfaces: Surfaces, *, ground: WallType, settings: BakeSettings
) -> list[FloatArray]:
    """Temperature (t, n, r) [K] of each wall type's surfaces by the march itself, sky and film as in `settings`.

    The environment's own step and lead-in are those of the march; InputError for a time between its samples.
    """
    sample = surfaces.time_of_day / environment.step
    if np.any(np.abs(sample - np.round(sample)) > 1e-6):
        problem, remedy = "between the samples of the environment", f"use multiples of {environment.step:g} s"
        raise InputError("fit error", "time", surfaces.time_of_day[np.argmax(sample % 1.0)], problem, remedy)
    record, order = np.unique(environment.image_window.start + np.round(sample).astype(np.int64), return_inverse=True)
    walls, count, several = len(surfaces.wall_types), surfaces.normal.shape[0], surfaces.reflectance.size
    each = SurfaceSet(
        wall_types=surfaces.wall_types,
        wall_type=np.repeat(np.arange(walls), count * several),
        normal=np.tile(surfaces.normal, (walls * several, 1)),
        reflectance=np.tile(np.repeat(surfaces.reflectance, count), walls),
    )
    solved = solve_surfaces(environment, each, ground=ground, record=record, settings=settings)[order]
    return list(solved.reshape(-1, walls, several, count).transpose(1, 0, 3, 2))


def fit_error(tables: ShadeTables, surfaces: Surfaces, solved: Sequence[FloatArray]) -> list[FloatArray]:
    """Shade less `solved` (t, n, r) [K] for each wall type of the surfaces; the tables must hold all of them."""
    count, several = surfaces.normal.shape[0], surfaces.reflectance.size
    normal = np.repeat(surfaces.normal, several, axis=0)
    reflectance = np.tile(surfaces.reflectance, count)
    place = tables.orientations.locate(normal)
    rows = [np.full(normal.shape[0], tables.wall_types.index(wall)) for wall in surfaces.wall_types]
    errors = [np.zeros(truth.shape) for truth in solved]
    for index, time in enumerate(surfaces.time_of_day):
        moment = tables.at(float(time))
        for error, truth, row in zip(errors, solved, rows, strict=True):
            shaded = shade(moment, place, normal, row, reflectance)
            error[index] = shaded.reshape(truth.shape[1:]) - truth[index]
    return errors


def summarise(surfaces: Surfaces, errors: Sequence[FloatArray]) -> Miss:
    """RMS, 99th percentile and maximum over all wall types, with the place of the maximum."""
    absolute = np.abs(np.stack(errors))
    wall, time, normal, reflectance = np.unravel_index(int(np.argmax(absolute)), absolute.shape)
    east, north, up = (float(value) for value in surfaces.normal[normal])
    return Miss(
        rms=float(np.sqrt(np.mean(absolute**2))),
        p99=float(np.quantile(absolute, 0.99)),
        max=float(absolute.max()),
        wall=f"{surfaces.wall_types[wall].name}, {surfaces.wall_types[wall].interior}",
        normal=(east, north, up),
        reflectance=float(surfaces.reflectance[reflectance]),
        time_of_day=float(surfaces.time_of_day[time]),
    )
