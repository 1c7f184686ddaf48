"""Solve each wall type's history ahead and fit it: environment and wall types in, tables out."""

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.environment import Environment
from sensorsim.materials import WallType
from sensorsim.tables.coefficients import UNKNOTTED, ShadeTables, fit_polynomials, reflectance_powers
from sensorsim.tables.fit import FitFrame, FittedWall, Powers, fit_frame, fit_lobes, fit_plain
from sensorsim.tables.history import make_ready, wall_history
from sensorsim.tables.lobes import Lobes, LobeSources, facing_lobes, lobe_sources, lobe_weights
from sensorsim.tables.mixture import mix_rises, mix_temperatures, mixed_reflectances
from sensorsim.tables.orientations import FloatArray, IntArray, orientation_set
from sensorsim.tables.scope import Scope, plain_walls, wants_lobes, whole_scope
from sensorsim.tables.settings import BakeSettings
from sensorsim.tables.slices import kept_samples
from sensorsim.tables.straighten import COLUMNS, UNBENT, Films, films_of, mix_films
from sensorsim.tables.sun_response import sun_response
from sensorsim.thermal.boundary import Outside, outside_at
from sensorsim.thermal.convection import MOWITT, wind_towards
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import Exposure, expose, outside_of
from sensorsim.thermal.lead_in import LeadIn, lead_in_of, longest
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
    begin = lead_in_of(ground, environment, own=settings.lead_in_days is None)
    soil = ground_temperature(environment, ground, sky=settings.sky, repeated=begin.repeated, plan=plan)
    bake = _prepare(environment, wall_types, soil, settings, plan, scope)
    record, kept = bake.record, np.dtype(settings.precision)
    rows, lead_ins = _bake_walls(bake, progress)
    return ShadeTables(
        day=environment.image_start.date(),
        time_of_day=(record - record[0]) * environment.step,
        wall_types=tuple(wall_types),
        orientations=scope.lookup,
        coefficients=np.stack([row.coefficients for row in rows], axis=1).astype(kept),
        level=np.stack([row.level for row in rows], axis=1),
        loss=np.stack([row.loss for row in rows], axis=1),
        towards=bake.towards,
        lobes=_lobes(bake.sources, rows, kept),
        ground_temperature=soil[record],
        settings=settings,
        lead_in=lead_ins,
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Solved:
    """Histories of a plain wall type at the slices."""

    lead_in: LeadIn
    temperature: FloatArray  # (t, o, r) [K]
    weight: FloatArray | None  # (t, k + 1) of the lobes on a black surface [K]
    films: Films | None  # of its face


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Bake:
    """What all wall types of a bake share."""

    environment: Environment
    exposure: Exposure
    smooth: Outside | None  # see `surface_boundary`
    settings: BakeSettings
    plan: EffectPlan
    scope: Scope
    wall_types: tuple[WallType, ...]
    record: IntArray  # (t,) samples of the slices
    sources: LobeSources | None
    towards: FloatArray  # (t, 2) where the wind comes from, east and north
    frame: FitFrame | None  # with lobes

    @property
    def degree(self) -> int:
        """Degree of the polynomials that are kept."""
        return min(self.settings.degree, self.scope.most - 1)

    def powers(self, wall: WallType) -> Powers:
        """Reflectances that are solved of a wall type, and the powers that are fitted to them."""
        reflectances = self.scope.reflectances_of(self.wall_types, wall)
        degree = min(self.degree, reflectances.size - 1)
        return Powers(reflectances, degree, self.settings.knot if degree == self.degree >= UNKNOTTED else 0.0)

    def cost(self, wall: WallType) -> tuple[bool, float]:
        """By which plain wall types are sorted so that no thread is left with a dear one at the end."""
        return melting_depth(wall) > 0.0, sum(layer.thickness for layer in wall.layers)

    def solve(self, wall: WallType) -> _Solved:
        """March one plain wall type; orientations that no wall type needs of it are NaN."""
        settings, environment = self.settings, self.environment
        ready = make_ready(
            environment, wall, own_lead_in=settings.lead_in_days is None, cell_size=settings.cell_size, plan=self.plan
        )
        needed, outside = self._outside(wall)
        temperature = wall_history(
            environment,
            outside,
            ready,
            1.0 - self.powers(wall).reflectances,
            self.record,
            stride=settings.lead_in_stride,
        )
        if not np.all(needed):
            solved = temperature
            temperature = np.full((solved.shape[0], needed.size, solved.shape[2]), np.nan)
            temperature[:, needed] = solved
        weight, films = None, None
        if self.sources is not None:
            response = sun_response(
                ready, outside, temperature.mean(axis=2), self.record, light=self.sources.light,
                first=self.sources.first, step=environment.step,
            )  # fmt: skip
            weight = lobe_weights(self.sources, response)
            films = films_of(outside, self.record, self.exposure.normal, self.towards)
        return _Solved(lead_in=ready.lead_in, temperature=temperature, weight=weight, films=films)

    def _outside(self, wall: WallType) -> tuple[NDArray[np.bool_], Outside]:
        """Which orientations (o,) are needed of a plain wall type, and what acts on those."""
        needed, part, smooth = self.scope.of_part(self.wall_types, wall), self.exposure, self.smooth
        if not np.all(needed):
            part = Exposure(
                normal=part.normal[needed], irradiance=part.irradiance[:, needed], longwave=part.longwave[:, needed]
            )
            smooth = None if smooth is None else outside_at(smooth, needed)
        outside = surface_boundary(
            self.environment, part, wall, correlation=self.settings.convection, plan=self.plan, smooth=smooth
        )
        return needed, outside

    def fit(self, wall: WallType, solved: Mapping[WallType, _Solved]) -> FittedWall:
        """Fit any wall type, from its parts where it is mixed; with as many powers as any of them has."""
        fitted = self._fit(wall, solved)
        spare = self.degree + 1 - fitted.coefficients.shape[-1]
        return replace(fitted, coefficients=np.pad(fitted.coefficients, ((0, 0), (0, 0), (0, spare))))

    def _fit(self, wall: WallType, solved: Mapping[WallType, _Solved]) -> FittedWall:
        """Fit any wall type by a polynomial through its own reflectances."""
        powers = self.powers(wall)
        own = mixed_reflectances(wall, powers.reflectances) if wall.parts else powers.reflectances[None]
        plain = [solved[part] for part in plain_walls(wall)]
        parts = [
            _at(history.temperature, powers, row) if wall.parts else history.temperature
            for history, row in zip(plain, own, strict=True)
        ]
        temperature = mix_temperatures(wall, parts) if wall.parts else parts[0]
        if self.frame is None:
            return self._fit_needed(wall, temperature, powers)
        rises = [
            history.weight[..., None] * (1.0 - row)
            for history, row in zip(plain, own, strict=True)
            if history.weight is not None
        ]
        films = [history.films for history in plain if history.films is not None]
        if not wall.parts:
            return fit_lobes(temperature, rises[0], films[0], self.frame, powers)
        rise = mix_rises(wall, [part.mean(axis=1, keepdims=True) for part in parts], rises)
        return fit_lobes(temperature, rise, mix_films(wall, films), self.frame, powers)

    def _fit_needed(self, wall: WallType, temperature: FloatArray, powers: Powers) -> FittedWall:
        """Fit temperatures (t, o, r) [K] without lobes, at the orientations that the wall type needs."""
        needed = self.scope.needed[self.wall_types.index(wall)]
        fitted = fit_plain(temperature[:, needed], powers)
        coefficients = np.full((*temperature.shape[:2], powers.degree + 1), np.nan)
        coefficients[:, needed] = fitted.coefficients
        return replace(fitted, coefficients=coefficients)


def _prepare(
    environment: Environment, wall_types: Sequence[WallType], soil: FloatArray, settings: BakeSettings,
    plan: EffectPlan, scope: Scope,
) -> _Bake:  # fmt: skip
    """What all wall types of a bake share, over a ground plane of temperature `soil` (t,) [K]."""
    record, lit = kept_samples(environment, settings), wants_lobes(settings, scope, plan)
    sources = lobe_sources(environment, record, interval=settings.lobes, sky=settings.sky, plan=plan) if lit else None
    exposure = expose(environment, scope.solved, soil, sky=settings.sky, plan=plan)
    return _Bake(
        environment=environment,
        exposure=exposure,
        smooth=None
        if settings.convection not in MOWITT
        else outside_of(
            environment, exposure, emissivity=1.0, roughness="very_smooth", correlation=settings.convection, plan=plan
        ),
        settings=settings,
        plan=plan,
        scope=scope,
        wall_types=tuple(wall_types),
        record=record,
        sources=sources,
        towards=wind_towards(environment.wind_direction[record]),
        frame=None
        if sources is None
        else fit_frame(environment, record, settings.orientations, facing_lobes(sources, scope.solved)),
    )


def _bake_walls(bake: _Bake, progress: Progress | None) -> tuple[list[FittedWall], tuple[LeadIn, ...]]:
    """Solve what the wall types are made of, and fit them; tells their lead-ins too."""
    wall_types = bake.wall_types
    plain = list(dict.fromkeys(part for wall in wall_types for part in plain_walls(wall)))
    solved: dict[WallType, _Solved] = {}
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        tasks = {wall: pool.submit(bake.solve, wall) for wall in sorted(plain, key=bake.cost, reverse=True)}
        for wall in plain:
            solved[wall] = tasks[wall].result()
            if progress is not None:
                progress(wall.name, len(solved), len(plain))
        rows = list(pool.map(lambda wall: bake.fit(wall, solved), wall_types))
    return rows, tuple(longest([solved[part].lead_in for part in plain_walls(wall)]) for wall in wall_types)


def _at(temperature: FloatArray, powers: Powers, asked: FloatArray) -> FloatArray:
    """Temperature (t, o, a) [K] at reflectances (a,) on the polynomial through all those (t, o, r) that are solved."""
    solved, knot = powers.reflectances, powers.knot
    through = reflectance_powers(asked, solved.size, knot)
    return np.asarray(fit_polynomials(temperature, solved, solved.size - 1, knot=knot) @ through.T)


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
        loss=np.broadcast_to(UNBENT, (2, len(wall_types), COLUMNS)),
        towards=np.zeros((2, 2)),
        lobes=None,
        settings=settings,
        lead_in=(),
    )
