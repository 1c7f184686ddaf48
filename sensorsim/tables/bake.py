"""Solve each wall type's history ahead and fit it: environment and wall types in, tables out."""

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.environment import Environment
from sensorsim.errors import InputError
from sensorsim.materials import WallType
from sensorsim.tables.coefficients import ShadeTables, fit_polynomials, lookup_orientations
from sensorsim.tables.fit import FittedWall, fit_lobes, fit_plain
from sensorsim.tables.history import solve_histories
from sensorsim.tables.lobes import Lobes, LobeSources, lobe_sources, lobe_weights
from sensorsim.tables.mixture import mix_rises, mix_temperatures, mixed_reflectances
from sensorsim.tables.orientations import FloatArray, IntArray, orientation_set
from sensorsim.tables.settings import BakeSettings
from sensorsim.tables.sun_response import sun_response
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import Exposure, expose
from sensorsim.thermal.lead_in import lead_in_of

Progress = Callable[[str, int, int], None]  # what was done, how many of how many


def bake_tables(
    environment: Environment,
    wall_types: Sequence[WallType],
    *,
    ground: WallType,
    settings: BakeSettings | None = None,
    progress: Progress | None = None,
) -> ShadeTables:
    """Tables of all `wall_types` over the environment's image day; `ground` is the plane that walls see.

    Wall types are solved in threads, because the compiled march holds no interpreter lock. Of mixed wall types the
    parts are solved, each once however many hold it.
    """
    settings = BakeSettings() if settings is None else settings
    normal = orientation_set(settings.orientations).normal
    own = settings.lead_in_days is None
    repeated = lead_in_of(ground, environment, own=own).repeated
    soil = ground_temperature(environment, ground, sky=settings.sky, repeated=repeated)
    record = _slices(environment, settings)
    bake = _Bake(
        environment=environment,
        exposure=expose(environment, normal, soil, sky=settings.sky),
        settings=settings,
        reflectances=np.asarray(settings.reflectances, dtype=np.float64),
        record=record,
        sources=_sources(environment, settings, record),
    )
    rows = _bake_walls(bake, wall_types, progress)
    kept = np.dtype(settings.precision)
    return ShadeTables(
        day=environment.image_start.date(),
        time_of_day=(record - record[0]) * environment.step,
        wall_types=tuple(wall_types),
        orientations=lookup_orientations(settings),
        coefficients=np.stack([row.coefficients for row in rows], axis=1).astype(kept),
        level=np.stack([row.level for row in rows], axis=1),
        bend=np.stack([row.bend for row in rows], axis=1),
        lobes=_lobes(bake.sources, rows, kept),
        ground_temperature=soil[record],
        settings=settings,
        lead_in=tuple(lead_in_of(wall, environment, own=own) for wall in wall_types),
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Solved:
    """Histories of a plain wall type at the slices."""

    temperature: FloatArray  # (t, o, r) [K]
    weight: FloatArray | None  # (t, k + 1) of the lobes on a black surface [K]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Bake:
    """What all wall types of a bake share."""

    environment: Environment
    exposure: Exposure
    settings: BakeSettings
    reflectances: FloatArray  # (r,)
    record: IntArray  # (t,) samples of the slices
    sources: LobeSources | None

    def solve(self, wall: WallType) -> _Solved:
        """March one plain wall type."""
        temperature = solve_histories(
            self.environment, self.exposure, wall, self.reflectances, self.record, settings=self.settings
        )
        if self.sources is None:
            return _Solved(temperature=temperature, weight=None)
        response = sun_response(
            self.environment, self.exposure, wall, temperature.mean(axis=2), self.record, light=self.sources.light,
            first=self.sources.first, settings=self.settings,
        )  # fmt: skip
        return _Solved(temperature=temperature, weight=lobe_weights(self.sources, response))

    def fit(self, wall: WallType, solved: Mapping[WallType, _Solved]) -> FittedWall:
        """Fit any wall type, from its parts where it is mixed."""
        refl, degree = self.reflectances, self.settings.degree
        own = mixed_reflectances(wall, refl) if wall.parts else refl[None]
        plain = [solved[part] for part in _plain_walls(wall)]
        parts = [
            _at(history.temperature, refl, row) if wall.parts else history.temperature
            for history, row in zip(plain, own, strict=True)
        ]
        temperature = mix_temperatures(wall, parts) if wall.parts else parts[0]
        if self.sources is None:
            return fit_plain(temperature, refl, degree)
        rises = [
            history.weight[..., None] * (1.0 - row)
            for history, row in zip(plain, own, strict=True)
            if history.weight is not None
        ]
        courses = [part.mean(axis=1, keepdims=True) for part in parts]
        rise = mix_rises(wall, courses, rises) if wall.parts else rises[0]
        return fit_lobes(temperature, rise, self.sources, self.exposure.normal, refl, degree)


def _bake_walls(bake: _Bake, wall_types: Sequence[WallType], progress: Progress | None) -> list[FittedWall]:
    """Solve what the wall types are made of, and fit them."""
    plain = list(dict.fromkeys(part for wall in wall_types for part in _plain_walls(wall)))
    solved: dict[WallType, _Solved] = {}
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        for wall, history in zip(plain, pool.map(bake.solve, plain), strict=True):
            solved[wall] = history
            if progress is not None:
                progress(wall.name, len(solved), len(plain))
        return list(pool.map(lambda wall: bake.fit(wall, solved), wall_types))


def _plain_walls(wall: WallType) -> tuple[WallType, ...]:
    """The wall types that have to be solved for one: itself, or the parts of a mixture."""
    return tuple(part.wall for part in wall.parts) or (wall,)


def _at(temperature: FloatArray, reflectances: FloatArray, asked: FloatArray) -> FloatArray:
    """Temperature (t, o, a) [K] at reflectances (a,) on the polynomial through those (t, o, r) at `reflectances`."""
    powers = np.vander(asked, reflectances.size, increasing=True)
    return np.asarray(fit_polynomials(temperature, reflectances, reflectances.size - 1) @ powers.T)


def _sources(environment: Environment, settings: BakeSettings, record: IntArray) -> LobeSources | None:
    """Sources of the lobes, if the settings ask for any and the sun shines at all."""
    if settings.lobes == 0.0:
        return None
    return lobe_sources(environment, record, interval=settings.lobes, sky=settings.sky)


def _lobes(sources: LobeSources | None, rows: Sequence[FittedWall], kept: np.dtype[np.floating]) -> Lobes | None:
    if sources is None:
        return None
    weight = np.stack([row.weight for row in rows if row.weight is not None], axis=1)
    return Lobes(sun=sources.sun, direction=sources.direction, weight=weight.astype(kept))


def _slices(environment: Environment, settings: BakeSettings) -> IntArray:
    """Samples from midnight to midnight of the image day that are kept."""
    stride = settings.slice_interval / environment.step
    if round(stride) < 1 or abs(stride - round(stride)) > 1e-9:
        problem = f"no multiple of the environment's step of {environment.step:g} s"
        raise InputError("bake settings", "slice_interval", settings.slice_interval, problem, "give both one step")
    count = round(SECONDS_PER_DAY / settings.slice_interval)
    return np.asarray(environment.image_window.start + np.arange(count + 1) * round(stride))
