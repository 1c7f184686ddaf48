"""Solve each wall type's history ahead and fit it: environment and wall types in, tables out."""

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.environment import Environment
from sensorsim.errors import InputError
from sensorsim.materials import WallType
from sensorsim.tables.coefficients import ShadeTables, fit_polynomials
from sensorsim.tables.history import wall_history
from sensorsim.tables.mixture import mix_coefficients
from sensorsim.tables.orientations import FloatArray, orientation_set
from sensorsim.tables.scope import Scope, plain_walls, whole_scope
from sensorsim.tables.settings import BakeSettings
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import Exposure, expose
from sensorsim.thermal.lead_in import lead_in_of
from sensorsim.thermal.natural import surface_boundary

Progress = Callable[[str, int, int], None]  # what was done, how many of how many


def bake_tables(
    environment: Environment,
    wall_types: Sequence[WallType],
    *,
    ground: WallType,
    settings: BakeSettings | None = None,
    progress: Progress | None = None,
    plan: EffectPlan = EVERYTHING,
    scope: Scope | None = None,
) -> ShadeTables:
    """Coefficient matrix of all `wall_types` over the environment's image day; `ground` is the plane that walls see.

    Wall types are solved in threads, because the compiled march holds no interpreter lock. Of mixed wall types the
    parts are solved, each once however many hold it. The `plan` says what acts on them, the `scope` which orientations
    and reflectances are solved; everything where there is none.
    """
    settings = BakeSettings() if settings is None else settings
    scope = whole_scope(wall_types, settings) if scope is None else scope
    own = settings.lead_in_days is None
    repeated = lead_in_of(ground, environment, own=own).repeated
    soil = ground_temperature(environment, ground, sky=settings.sky, repeated=repeated, plan=plan)
    exposure = expose(environment, scope.orientations.normal, soil, sky=settings.sky, plan=plan)
    record = _slices(environment, settings)

    def solve(wall: WallType) -> FloatArray:
        needed, reflectances = scope.of_part(wall_types, wall)
        if not np.all(needed):
            return _solve_some(environment, exposure, needed, wall, settings, reflectances, record, plan)
        return _solve_wall(environment, exposure, wall, settings, reflectances, record, plan)

    plain = list(dict.fromkeys(part for wall in wall_types for part in plain_walls(wall)))
    solved: dict[WallType, FloatArray] = {}
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        for wall, coefficients in zip(plain, pool.map(solve, plain), strict=True):
            solved[wall] = coefficients
            if progress is not None:
                progress(wall.name, len(solved), len(plain))
    reflectances = np.asarray(settings.reflectances, dtype=np.float64)
    rows = [mix_coefficients(wall, solved, reflectances) if wall.parts else solved[wall] for wall in wall_types]
    return ShadeTables(
        day=environment.image_start.date(),
        time_of_day=(record - record[0]) * environment.step,
        wall_types=tuple(wall_types),
        orientations=scope.orientations,
        coefficients=np.stack(rows, axis=1).astype(np.float32),
        ground_temperature=soil[record],
        settings=settings,
        lead_in=tuple(lead_in_of(wall, environment, own=own) for wall in wall_types),
    )


def unbaked_tables(environment: Environment, wall_types: Sequence[WallType], settings: BakeSettings) -> ShadeTables:
    """Tables in which no temperature is known (NaN): for bands that see none."""
    orientations = orientation_set("report10")
    return ShadeTables(
        day=environment.image_start.date(),
        time_of_day=np.array([0.0, SECONDS_PER_DAY]),
        wall_types=tuple(wall_types),
        orientations=orientations,
        coefficients=np.full((2, len(wall_types), orientations.normal.shape[0], 1), np.nan, dtype=np.float32),
        ground_temperature=np.full(2, np.nan),
        settings=settings,
        lead_in=(),
    )


def _slices(environment: Environment, settings: BakeSettings) -> np.ndarray:
    """Samples from midnight to midnight of the image day that are kept."""
    stride = settings.slice_interval / environment.step
    if round(stride) < 1 or abs(stride - round(stride)) > 1e-9:
        problem = f"no multiple of the environment's step of {environment.step:g} s"
        raise InputError("bake settings", "slice_interval", settings.slice_interval, problem, "give both one step")
    count = round(SECONDS_PER_DAY / settings.slice_interval)
    return np.asarray(environment.image_window.start + np.arange(count + 1) * round(stride))


def _solve_some(
    environment: Environment, exposure: Exposure, needed: NDArray[np.bool_], wall: WallType, settings: BakeSettings,
    reflectances: tuple[float, ...], record: np.ndarray, plan: EffectPlan,
) -> FloatArray:  # fmt: skip
    """Coefficients (t, o, p) [K] of one wall type, NaN for the orientations that are not needed (o,)."""
    part = Exposure(
        normal=exposure.normal[needed],
        irradiance=exposure.irradiance[:, needed],
        longwave=exposure.longwave[:, needed],
    )
    coefficients = np.full((record.size, needed.size, settings.degree + 1), np.nan)
    coefficients[:, needed] = _solve_wall(environment, part, wall, settings, reflectances, record, plan)
    return coefficients


def _solve_wall(
    environment: Environment, exposure: Exposure, wall: WallType, settings: BakeSettings,
    values: tuple[float, ...], record: np.ndarray, plan: EffectPlan,
) -> FloatArray:  # fmt: skip
    """Coefficients (t, o, p) [K] of one wall type from histories at reflectances `values`; powers beyond them are 0."""
    reflectances = np.asarray(values, dtype=np.float64)
    outside = surface_boundary(environment, exposure, wall, correlation=settings.convection, plan=plan)
    lead_in = lead_in_of(wall, environment, own=settings.lead_in_days is None)
    exterior = wall_history(environment, outside, wall, 1.0 - reflectances, record, lead_in=lead_in, plan=plan)
    fitted = fit_polynomials(exterior, reflectances, min(settings.degree, reflectances.size - 1))
    return np.pad(fitted, ((0, 0), (0, 0), (0, settings.degree + 1 - fitted.shape[-1])))
