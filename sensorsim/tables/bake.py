"""Solve each wall type's history ahead and fit it: environment and wall types in, tables out."""

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.environment import Environment
from sensorsim.errors import InputError
from sensorsim.materials import WallType
from sensorsim.tables.coefficients import ShadeTables, fit_polynomials
from sensorsim.tables.orientations import FloatArray, orientation_set
from sensorsim.tables.settings import BakeSettings
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import Exposure, expose, outside_of
from sensorsim.thermal.interior import build_interior
from sensorsim.thermal.paths import march_paths

Progress = Callable[[str, int, int], None]  # what was done, how many of how many


def bake_tables(
    environment: Environment,
    wall_types: Sequence[WallType],
    *,
    ground: WallType,
    settings: BakeSettings | None = None,
    progress: Progress | None = None,
) -> ShadeTables:
    """Coefficient matrix of all `wall_types` over the environment's image day; `ground` is the plane that walls see.

    Wall types are solved in threads, because the compiled march holds no interpreter lock.
    """
    settings = BakeSettings() if settings is None else settings
    orientations = orientation_set(settings.orientations)
    soil = ground_temperature(environment, ground, sky=settings.sky)
    exposure = expose(environment, orientations.normal, soil, sky=settings.sky)
    record = _slices(environment, settings)

    def solve(wall: WallType) -> FloatArray:
        return _solve_wall(environment, exposure, wall, settings, record)

    solved = []
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        for done, coefficients in enumerate(pool.map(solve, wall_types), start=1):
            solved.append(coefficients)
            if progress is not None:
                progress(wall_types[done - 1].name, done, len(wall_types))
    return ShadeTables(
        day=environment.image_start.date(),
        time_of_day=(record - record[0]) * environment.step,
        wall_types=tuple(wall_types),
        orientations=orientations,
        coefficients=np.stack(solved, axis=1).astype(np.float32),
        ground_temperature=soil[record],
        settings=settings,
    )


def _slices(environment: Environment, settings: BakeSettings) -> np.ndarray:
    """Samples from midnight to midnight of the image day that are kept."""
    stride = settings.slice_interval / environment.step
    if round(stride) < 1 or abs(stride - round(stride)) > 1e-9:
        problem = f"no multiple of the environment's step of {environment.step:g} s"
        raise InputError("bake settings", "slice_interval", settings.slice_interval, problem, "give both one step")
    count = round(SECONDS_PER_DAY / settings.slice_interval)
    return np.asarray(environment.image_window.start + np.arange(count + 1) * round(stride))


def _solve_wall(
    environment: Environment, exposure: Exposure, wall: WallType, settings: BakeSettings, record: np.ndarray
) -> FloatArray:
    """Coefficients (t, o, p) [K] of one wall type."""
    reflectances = np.asarray(settings.reflectances, dtype=np.float64)
    outside = outside_of(
        environment, exposure, emissivity=wall.emissivity, roughness=wall.roughness,
        correlation=settings.convection, length=wall.characteristic_length,
    )  # fmt: skip
    inside = build_interior(
        wall.interior,
        environment.air_temperature,
        environment.wind_speed,
        environment.step,
        wall.interior_emissivity,
        room=wall.room,
        heat_gain=wall.heat_gain,
    )
    history = march_paths(wall, outside, inside, 1.0 - reflectances, step=environment.step, record=record)
    return fit_polynomials(history.exterior, reflectances, settings.degree)
