"""Solve each wall type's history ahead and fit it: environment and wall types in, tables out."""

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.environment import Environment
from sensorsim.errors import InputError
from sensorsim.materials import WallType
from sensorsim.tables.coefficients import ShadeTables, fit_polynomials
from sensorsim.tables.histories import solve_histories
from sensorsim.tables.mixture import mix_temperatures, part_reflectances
from sensorsim.tables.orientations import FloatArray, orientation_set
from sensorsim.tables.settings import BakeSettings
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import expose

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

    Wall types are solved in threads, because the compiled march holds no interpreter lock. Of mixed wall types the
    parts are solved, each once however many hold it.
    """
    settings = BakeSettings() if settings is None else settings
    orientations = orientation_set(settings.orientations)
    soil = ground_temperature(environment, ground, sky=settings.sky)
    exposure = expose(environment, orientations.normal, soil, sky=settings.sky)
    record = _slices(environment, settings)

    reflectances = np.asarray(settings.reflectances, dtype=np.float64)

    def solve(wall: WallType) -> FloatArray:
        return solve_histories(environment, exposure, wall, reflectances, record, convection=settings.convection)

    plain = list(dict.fromkeys(part for wall in wall_types for part in _plain_walls(wall)))
    solved: dict[WallType, FloatArray] = {}
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        for wall, temperature in zip(plain, pool.map(solve, plain), strict=True):
            solved[wall] = temperature
            if progress is not None:
                progress(wall.name, len(solved), len(plain))
    rows = [
        fit_polynomials(_temperature(wall, solved, reflectances), reflectances, settings.degree) for wall in wall_types
    ]
    return ShadeTables(
        day=environment.image_start.date(),
        time_of_day=(record - record[0]) * environment.step,
        wall_types=tuple(wall_types),
        orientations=orientations,
        coefficients=np.stack(rows, axis=1).astype(np.float32),
        ground_temperature=soil[record],
        settings=settings,
    )


def _plain_walls(wall: WallType) -> tuple[WallType, ...]:
    """The wall types that have to be solved for one: itself, or the parts of a mixture."""
    return tuple(part.wall for part in wall.parts) or (wall,)


def _temperature(wall: WallType, solved: Mapping[WallType, FloatArray], reflectances: FloatArray) -> FloatArray:
    """Temperature (t, o, r) [K] of any wall type at the reflectances (r,) from those of its plain ones there."""
    if not wall.parts:
        return solved[wall]
    own = part_reflectances(wall, reflectances)
    return mix_temperatures(
        wall, [_at(solved[part.wall], reflectances, row) for part, row in zip(wall.parts, own, strict=True)]
    )


def _at(temperature: FloatArray, reflectances: FloatArray, asked: FloatArray) -> FloatArray:
    """Temperature (t, o, a) [K] at reflectances (a,) on the polynomial through those (t, o, r) at `reflectances`."""
    powers = np.vander(asked, reflectances.size, increasing=True)
    return np.asarray(fit_polynomials(temperature, reflectances, reflectances.size - 1) @ powers.T)


def _slices(environment: Environment, settings: BakeSettings) -> np.ndarray:
    """Samples from midnight to midnight of the image day that are kept."""
    stride = settings.slice_interval / environment.step
    if round(stride) < 1 or abs(stride - round(stride)) > 1e-9:
        problem = f"no multiple of the environment's step of {environment.step:g} s"
        raise InputError("bake settings", "slice_interval", settings.slice_interval, problem, "give both one step")
    count = round(SECONDS_PER_DAY / settings.slice_interval)
    return np.asarray(environment.image_window.start + np.arange(count + 1) * round(stride))
