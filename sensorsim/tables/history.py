"""Temperature histories: of a wall type for many orientations and absorptances, and of surfaces one by one."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.environment import Environment
from sensorsim.materials import WallType
from sensorsim.tables.mixture import mix_temperatures, mixed_reflectances
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.tables.settings import BakeSettings
from sensorsim.thermal.boundary import Inside, Outside, inside_from, outside_from
from sensorsim.thermal.heat_balance import Exposure
from sensorsim.thermal.lead_in import LeadIn, lead_in_of, room_of
from sensorsim.thermal.natural import cool_skin, melting_depth, surface_boundary
from sensorsim.thermal.paths import GridPath, march_paths, wall_paths


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Ready:
    """A plain wall type made ready for its march in an environment."""

    wall: WallType
    paths: tuple[GridPath, ...]
    inside: Inside
    lead_in: LeadIn


def make_ready(
    environment: Environment, wall: WallType, *, own_lead_in: bool, cell_size: float = 1.0,
    plan: EffectPlan = EVERYTHING,
) -> Ready:  # fmt: skip
    """Lay out a plain wall type. Its lead-in is told by usual cells and a room that counts, whatever is marched."""
    paths, inside = wall_paths(wall, environment.step, cell_size=cell_size), room_of(wall, environment, plan)
    lead_in = lead_in_of(
        wall, environment, own=own_lead_in, paths=paths if cell_size == 1.0 else None,
        inside=inside if plan.has("interior") else None,
    )  # fmt: skip
    return Ready(wall=wall, paths=paths, inside=inside, lead_in=lead_in)


def wall_history(
    environment: Environment, outside: Outside, ready: Ready, absorptances: FloatArray, record: np.ndarray, *,
    stride: int = 1,
) -> FloatArray:  # fmt: skip
    """Surface temperature (r, o, a) [K] of a plain wall type at the samples `record`, none before its lead-in."""
    wall, lead_in = ready.wall, ready.lead_in
    water = wall.cover is not None and wall.cover.kind == "water"
    # Water remembers weeks; it starts from the mean of the air that it has mixed in.
    start = float(np.mean(environment.air_temperature)) if water else None
    history = march_paths(
        wall, outside_from(outside, lead_in.first), inside_from(ready.inside, lead_in.first), absorptances,
        step=environment.step, record=record - lead_in.first, start=start, melting_depth=melting_depth(wall),
        repeated=lead_in.repeated, paths=ready.paths, stride=stride,
    )  # fmt: skip
    if water and wall.cover is not None:
        return cool_skin(history.exterior, outside, record, wall.cover)
    return history.exterior


def solve_histories(
    environment: Environment, exposure: Exposure, wall: WallType, reflectances: FloatArray, record: IntArray, *,
    settings: BakeSettings, plan: EffectPlan = EVERYTHING,
) -> FloatArray:  # fmt: skip
    """Surface temperature (t, o, r) [K] of any wall type at the samples `record` (t,), at solar reflectances (r,).

    Of a mixed one every part is solved at the reflectances that are its own.
    """
    if wall.parts:
        parts = [
            solve_histories(environment, exposure, part.wall, own, record, settings=settings, plan=plan)
            for part, own in zip(wall.parts, mixed_reflectances(wall, reflectances), strict=True)
        ]
        return mix_temperatures(wall, parts)
    outside = surface_boundary(environment, exposure, wall, correlation=settings.convection, plan=plan)
    own = settings.lead_in_days is None
    ready = make_ready(environment, wall, own_lead_in=own, cell_size=settings.cell_size, plan=plan)
    return wall_history(environment, outside, ready, 1.0 - reflectances, record, stride=settings.lead_in_stride)


def surface_histories(
    environment: Environment,
    exposure: Exposure,
    walls: Sequence[WallType],
    reflectance: FloatArray,
    settings: BakeSettings,
    plan: EffectPlan = EVERYTHING,
) -> FloatArray:
    """Temperatures (t, m) [K] of m surfaces at all samples, each with its wall type, reflectance and exposure.

    They are solved at every sample of the environment, kept at those of the settings' slices, and linear between.
    """
    found = np.zeros(exposure.irradiance.shape)
    for wall in dict.fromkeys(walls):
        row = np.array([k for k, other in enumerate(walls) if other == wall])
        part = Exposure(
            normal=exposure.normal[row], irradiance=exposure.irradiance[:, row], longwave=exposure.longwave[:, row]
        )
        found[:, row] = _surfaces_of(environment, part, wall, reflectance[row], settings, plan)
    return found


def _surfaces_of(
    environment: Environment, exposure: Exposure, wall: WallType, reflectance: FloatArray, settings: BakeSettings,
    plan: EffectPlan,
) -> FloatArray:  # fmt: skip
    """Temperatures (t, m) [K] of surfaces of one wall type; those of a mixture are joined as `mixture` does."""
    if wall.parts:
        parts = [
            _surfaces_of(environment, exposure, part.wall, own, settings, plan)
            for part, own in zip(wall.parts, mixed_reflectances(wall, reflectance), strict=True)
        ]
        return mix_temperatures(wall, parts)
    outside = surface_boundary(environment, exposure, wall, correlation=settings.convection, plan=plan)
    outside = outside._replace(irradiance=outside.irradiance * (1.0 - reflectance))
    count, stride = environment.time.size, round(settings.slice_interval / environment.step)
    kept = np.union1d(np.arange(environment.image_window.start % stride, count, stride), [0, count - 1])
    ready = make_ready(environment, wall, own_lead_in=settings.lead_in_days is None, plan=plan)
    whole = replace(ready, lead_in=replace(ready.lead_in, first=0))
    history = wall_history(environment, outside, whole, np.ones(1), kept)[:, :, 0]
    later = np.clip(np.searchsorted(kept, np.arange(count)), 1, kept.size - 1)
    share = (np.arange(count) - kept[later - 1]) / (kept[later] - kept[later - 1])
    return np.asarray(history[later - 1] + share[:, None] * (history[later] - history[later - 1]))
