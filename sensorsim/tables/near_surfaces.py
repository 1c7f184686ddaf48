"""What near surfaces of a scene change in each other's temperature: an optional effect on top of the tables.

The tables know a surface by its wall type and orientation alone, under the whole sky above its tilt. Here the surfaces
of which neighbours hide more than NEAR_SHARE of the hemisphere are marched one by one, once under the whole sky and
once among their neighbours: long waves and diffuse sunlight come from what is left of sky and ground and from the
neighbours at their own temperatures, section 3.1.2 of [Report1978]. The difference of the two is what a surface differs
from the table by. The beam is not shadowed, nor the glow around the sun; the wind blows as in the open.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.environment import Environment
from sensorsim.errors import InputError
from sensorsim.materials import WallType
from sensorsim.scene import Scene
from sensorsim.tables.assign import Assignment
from sensorsim.tables.history import surface_histories
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.tables.settings import BakeSettings
from sensorsim.thermal.exchange import Exchange, build_exchange
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import Exposure, directional_irradiance, expose, reflected_irradiance
from sensorsim.thermal.lead_in import lead_in_of
from sensorsim.thermal.neighbour_radiation import change_by_neighbours, longwave_from_neighbours
from sensorsim.thermal.polygon_view_factors import outlines_of_mesh
from sensorsim.thermal.view_factors import ground_view_factor, sky_view_factor

NEAR_SHARE = 0.05  # view factor to neighbours above which a surface is marched by itself
MOST_SURFACES = 10_000  # that may see each other; their histories are held at once
SETTLED = 0.01  # [K] by which a further pass, with the neighbours' temperatures of the one before, may change any
MOST_PASSES = 12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SurfaceOffsets:
    """By how much surfaces differ from the tables, at the times of the tables' slices."""

    time_of_day: FloatArray  # (t,) [s]
    surface: IntArray  # (k,) rows of the scene's surfaces, ascending
    offset: NDArray[np.float32]  # (t, k) [K]
    passes: int  # over all surfaces until none changed any more
    left: float  # [K] largest change of the last pass

    def at(self, time_of_day: float, count: int) -> FloatArray:
        """Offsets (count,) [K] of all surfaces of the scene at a time [s], linear between slices."""
        offsets = np.zeros(count)
        later = int(np.clip(np.searchsorted(self.time_of_day, time_of_day), 1, self.time_of_day.size - 1))
        begin, end = self.time_of_day[later - 1 : later + 1]
        first, second = self.offset[later - 1 : later + 1].astype(np.float64)
        offsets[self.surface] = first + (time_of_day - begin) / (end - begin) * (second - first)
        return offsets


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Group:
    """Surfaces that see each other, rows of a scene in ascending order; arrays have one row per surface."""

    row: IntArray
    exchange: Exchange
    wall: tuple[WallType, ...]
    normal: FloatArray  # (n, 3)
    reflectance: FloatArray  # (n,) solar, of what is not absorbed [-]
    returned: FloatArray  # (n,) solar, of what goes back into the open [-]
    emissivity: FloatArray  # (n,)


def near_surface_offsets(
    scene: Scene,
    assignment: Assignment,
    environment: Environment,
    *,
    ground: WallType,
    settings: BakeSettings,
    time_of_day: FloatArray,
    plan: EffectPlan = EVERYTHING,
) -> SurfaceOffsets:
    """Offsets of a scene's near surfaces at times (t,) [s] of the image day that are samples of the environment.

    Raises InputError for a scene of which more than MOST_SURFACES see each other.
    """
    group = _group(scene, assignment)
    near = group.exchange.neighbour_share > NEAR_SHARE
    if not np.any(near):
        return _offsets(time_of_day, group.row[near], np.zeros((time_of_day.size, 0)), 0, 0.0)
    repeated = lead_in_of(ground, environment, own=settings.lead_in_days is None).repeated
    soil = ground_temperature(environment, ground, sky=settings.sky, repeated=repeated, plan=plan)
    open_air = expose(environment, group.normal, soil, sky=settings.sky, plan=plan)
    alone = surface_histories(environment, open_air, group.wall, group.reflectance, settings, plan)
    sunlight = open_air.irradiance + _sunlight_change(environment, open_air, group, settings.sky, plan)
    soil_power = STEFAN_BOLTZMANN_CONSTANT * soil**4
    sky_power = _over_sky(open_air.longwave - np.outer(soil_power, ground_view_factor(group.normal)), group.normal)
    walls = [wall for wall, wanted in zip(group.wall, near, strict=True) if wanted]
    among, left, passes = alone.copy(), np.inf, 0
    while left > SETTLED and passes < MOST_PASSES:
        change = longwave_from_neighbours(group.exchange, among, group.emissivity, sky=sky_power, ground=soil_power)
        longwave = (open_air.longwave + change)[:, near]
        hemmed = Exposure(normal=group.normal[near], irradiance=sunlight[:, near], longwave=longwave)
        found = surface_histories(environment, hemmed, walls, group.reflectance[near], settings, plan)
        left, passes = float(np.max(np.abs(found - among[:, near]))), passes + 1
        among[:, near] = found
    record = environment.image_window.start + np.rint(time_of_day / environment.step).astype(np.int64)
    return _offsets(time_of_day, group.row[near], (among - alone)[record][:, near], passes, left)


def _offsets(time_of_day: FloatArray, row: IntArray, offset: FloatArray, passes: int, left: float) -> SurfaceOffsets:
    return SurfaceOffsets(
        time_of_day=time_of_day, surface=row, offset=offset.astype(np.float32), passes=passes, left=left
    )


def _group(scene: Scene, assignment: Assignment) -> _Group:
    """The surfaces that see any other; planes are the ground itself and hide nothing."""
    mesh = scene.mesh
    outlines = outlines_of_mesh(mesh.position, mesh.triangle, mesh.surface)
    exchange = build_exchange(outlines, acting=scene.surfaces.role != "plane")
    sees = np.diff(exchange.rows) > 0
    sees[exchange.columns] = True
    row = np.flatnonzero(sees)
    if row.size > MOST_SURFACES:
        problem = f"more than {MOST_SURFACES} surfaces see each other"
        remedy = "leave the exchange out, or take a coarser level of detail"
        raise InputError(scene.files[0], "exchange", row.size, problem, remedy)
    return _Group(
        row=row,
        exchange=_part(exchange, row),
        wall=tuple(assignment.wall_types[kind] for kind in assignment.wall_type[row]),
        normal=scene.surfaces.normal[row],
        reflectance=assignment.reflectance[row],
        returned=assignment.reflectance[row] - assignment.transmittance[row],
        emissivity=assignment.emissivity[row],
    )


def _part(exchange: Exchange, row: IntArray) -> Exchange:
    """Exchange of some surfaces that see no others than these."""
    matrix = exchange.matrix()[row][:, row]
    names = ("sky_share", "ground_share", "sky_taken", "ground_taken", "kept")
    shares = {name: getattr(exchange, name)[row] for name in names}
    return replace(exchange, rows=matrix.indptr, columns=matrix.indices, factor=matrix.data, **shares)


def _sunlight_change(
    environment: Environment, exposure: Exposure, group: _Group, sky: str, plan: EffectPlan
) -> FloatArray:
    """Change (t, n) [W m-2] of the sunlight: less of sky and ground, more from neighbours that the sun shines on."""
    facing = np.maximum(environment.sun_direction @ group.normal.T, 0.0)
    straight = directional_irradiance(environment, sky=sky, plan=plan)[:, None] * facing
    ground = reflected_irradiance(environment) * float(plan.has("ground_sun"))
    diffuse = exposure.irradiance - straight - np.outer(ground, ground_view_factor(group.normal))
    sky_power = _over_sky(diffuse, group.normal)
    own = group.returned * straight
    return change_by_neighbours(group.exchange, own, group.returned, sky=sky_power, ground=ground)


def _over_sky(irradiance: FloatArray, normal: FloatArray) -> FloatArray:
    """Radiosity (t, n) of the mean sky before each surface [W m-2] from what it gets of the whole of it."""
    share = sky_view_factor(normal)
    return np.asarray(np.divide(irradiance, share, out=np.zeros_like(irradiance), where=share > 1e-12))
