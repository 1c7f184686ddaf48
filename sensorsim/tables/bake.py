"""Solve each wall type's history ahead and fit it: environment and wall types in, tables out."""

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.environment import Environment
from sensorsim.materials import WallType
from sensorsim.tables.coefficients import ShadeTables, fit_polynomials
from sensorsim.tables.fit import FittedWall, fit_lobes, fit_plain
from sensorsim.tables.history import wall_history
from sensorsim.tables.lobes import Lobes, LobeSources, facing_lobes, lobe_sources, lobe_weights
from sensorsim.tables.mixture import mix_rises, mix_temperatures, mixed_reflectances
from sensorsim.tables.orientations import FloatArray, IntArray, orientation_set
from sensorsim.tables.scope import Scope, plain_walls, wants_lobes, whole_scope
from sensorsim.tables.settings import BakeSettings
from sensorsim.tables.slices import kept_samples
from sensorsim.tables.sun_response import sun_response
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import Exposure, expose
from sensorsim.thermal.lead_in import lead_in_of
from sensorsim.thermal.natural import melting_depth, surface_boundary

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
    """Tables of all `wall_types` over the environment's image day; `ground` is the plane that walls see.

    Wall types are solved in threads, because the compiled march holds no interpreter lock. Of mixed wall types the
    parts are solved, each once however many hold it. The `plan` says what acts on them, the `scope` which orientations
    and reflectances are solved; everything where there is none.
    """
    settings = BakeSettings() if settings is None else settings
    scope = whole_scope(wall_types, settings) if scope is None else scope
    own = settings.lead_in_days is None
    begin = lead_in_of(ground, environment, own=own)
    soil = ground_temperature(environment, ground, sky=settings.sky, repeated=begin.repeated, plan=plan)
    bake = _prepare(environment, wall_types, soil, settings, plan, scope)
    record = bake.record
    rows, kept = _bake_walls(bake, progress), np.dtype(settings.precision)
    return ShadeTables(
        day=environment.image_start.date(),
        time_of_day=(record - record[0]) * environment.step,
        wall_types=tuple(wall_types),
        orientations=scope.lookup,
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
    plan: EffectPlan
    scope: Scope
    wall_types: tuple[WallType, ...]
    record: IntArray  # (t,) samples of the slices
    sources: LobeSources | None
    facing: FloatArray | None  # (t, k + 1, o) of the solved orientations to the lobes

    def reflectances(self, wall: WallType) -> FloatArray:
        """Reflectances (r,) that are solved of a wall type."""
        return self.scope.reflectances_of(self.wall_types, wall)

    def cost(self, wall: WallType) -> tuple[bool, float]:
        """By which plain wall types are sorted so that no thread is left with a dear one at the end."""
        return melting_depth(wall) > 0.0, sum(layer.thickness for layer in wall.layers)

    def solve(self, wall: WallType) -> _Solved:
        """March one plain wall type; orientations that no wall type needs of it are NaN."""
        needed, whole = self.scope.of_part(self.wall_types, wall), self.exposure
        part = Exposure(
            normal=whole.normal[needed], irradiance=whole.irradiance[:, needed], longwave=whole.longwave[:, needed]
        )
        own = self.settings.lead_in_days is None
        outside = surface_boundary(self.environment, part, wall, correlation=self.settings.convection, plan=self.plan)
        solved = wall_history(
            self.environment, outside, wall, 1.0 - self.reflectances(wall), self.record, plan=self.plan,
            lead_in=lead_in_of(wall, self.environment, own=own), cell_size=self.settings.cell_size,
            stride=self.settings.lead_in_stride,
        )  # fmt: skip
        temperature = np.full((solved.shape[0], needed.size, solved.shape[2]), np.nan)
        temperature[:, needed] = solved
        if self.sources is None:
            return _Solved(temperature=temperature, weight=None)
        response = sun_response(
            self.environment, outside, wall, temperature.mean(axis=2), self.record, light=self.sources.light,
            first=self.sources.first, settings=self.settings, plan=self.plan,
        )  # fmt: skip
        return _Solved(temperature=temperature, weight=lobe_weights(self.sources, response))

    def fit(self, wall: WallType, solved: Mapping[WallType, _Solved]) -> FittedWall:
        """Fit any wall type, from its parts where it is mixed; with as many powers as any of them has."""
        fitted = self._fit(wall, solved)
        spare = min(self.settings.degree, self.scope.most - 1) + 1 - fitted.coefficients.shape[-1]
        return replace(fitted, coefficients=np.pad(fitted.coefficients, ((0, 0), (0, 0), (0, spare))))

    def _fit(self, wall: WallType, solved: Mapping[WallType, _Solved]) -> FittedWall:
        """Fit any wall type by a polynomial through its own reflectances."""
        refl = self.reflectances(wall)
        degree = min(self.settings.degree, refl.size - 1)
        own = mixed_reflectances(wall, refl) if wall.parts else refl[None]
        plain = [solved[part] for part in plain_walls(wall)]
        parts = [
            _at(history.temperature, refl, row) if wall.parts else history.temperature
            for history, row in zip(plain, own, strict=True)
        ]
        temperature = mix_temperatures(wall, parts) if wall.parts else parts[0]
        if self.facing is None:
            return self._fit_needed(wall, temperature, degree)
        rises = [
            history.weight[..., None] * (1.0 - row)
            for history, row in zip(plain, own, strict=True)
            if history.weight is not None
        ]
        courses = [part.mean(axis=1, keepdims=True) for part in parts]
        rise = mix_rises(wall, courses, rises) if wall.parts else rises[0]
        return fit_lobes(temperature, rise, self.facing, self.settings.orientations, refl, degree)

    def _fit_needed(self, wall: WallType, temperature: FloatArray, degree: int) -> FittedWall:
        """Fit temperatures (t, o, r) [K] without lobes, at the orientations that the wall type needs."""
        needed = self.scope.needed[self.wall_types.index(wall)]
        fitted = fit_plain(temperature[:, needed], self.reflectances(wall), degree)
        coefficients = np.full((*temperature.shape[:2], degree + 1), np.nan)
        coefficients[:, needed] = fitted.coefficients
        return replace(fitted, coefficients=coefficients)


def _prepare(
    environment: Environment, wall_types: Sequence[WallType], soil: FloatArray, settings: BakeSettings,
    plan: EffectPlan, scope: Scope,
) -> _Bake:  # fmt: skip
    """What all wall types of a bake share, over a ground plane of temperature `soil` (t,) [K]."""
    record, lit = kept_samples(environment, settings), wants_lobes(settings, scope, plan)
    sources = lobe_sources(environment, record, interval=settings.lobes, sky=settings.sky, plan=plan) if lit else None
    return _Bake(
        environment=environment,
        exposure=expose(environment, scope.solved, soil, sky=settings.sky, plan=plan),
        settings=settings,
        plan=plan,
        scope=scope,
        wall_types=tuple(wall_types),
        record=record,
        sources=sources,
        facing=None if sources is None else facing_lobes(sources, scope.solved),
    )


def _bake_walls(bake: _Bake, progress: Progress | None) -> list[FittedWall]:
    """Solve what the wall types are made of, and fit them."""
    wall_types = bake.wall_types
    plain = list(dict.fromkeys(part for wall in wall_types for part in plain_walls(wall)))
    solved: dict[WallType, _Solved] = {}
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        tasks = {wall: pool.submit(bake.solve, wall) for wall in sorted(plain, key=bake.cost, reverse=True)}
        for wall in plain:
            solved[wall] = tasks[wall].result()
            if progress is not None:
                progress(wall.name, len(solved), len(plain))
        return list(pool.map(lambda wall: bake.fit(wall, solved), wall_types))


def _at(temperature: FloatArray, reflectances: FloatArray, asked: FloatArray) -> FloatArray:
    """Temperature (t, o, a) [K] at reflectances (a,) on the polynomial through those (t, o, r) at `reflectances`."""
    powers = np.vander(asked, reflectances.size, increasing=True)
    return np.asarray(fit_polynomials(temperature, reflectances, reflectances.size - 1) @ powers.T)


def _lobes(sources: LobeSources | None, rows: Sequence[FittedWall], kept: np.dtype[np.floating]) -> Lobes | None:
    if sources is None:
        return None
    weight = np.stack([row.weight for row in rows if row.weight is not None], axis=1)
    gain = np.stack([row.gain for row in rows if row.gain is not None], axis=1)
    return Lobes(sun=sources.sun, direction=sources.direction, weight=weight.astype(kept), gain=gain)


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
        level=np.full((2, len(wall_types)), np.nan),
        bend=np.zeros((2, len(wall_types))),
        lobes=None,
        settings=settings,
        lead_in=(),
    )
