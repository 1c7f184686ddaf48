"""The full solve: histories of given surfaces themselves, each with its own normal, wall type and reflectance.

What a table's fit is measured against: nothing is interpolated between orientations, reflectances or recorded times.
"""

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from datetime import date

import numpy as np

from sensorsim.environment import Environment, Weather, build_environment, longest_lead_in
from sensorsim.materials import WallType
from sensorsim.tables.assign import Assignment
from sensorsim.tables.history import solve_histories
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.tables.settings import BakeSettings
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import expose
from sensorsim.thermal.lead_in import lead_in_of

FINE_STEP = 60.0  # [s]
FINE_CELLS = 0.5  # size of the walls' finite volumes over the usual [-]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SurfaceSet:
    """Surfaces by what decides their temperature; arrays have one row per surface."""

    wall_types: tuple[WallType, ...]
    wall_type: IntArray  # (m,) row in wall_types
    normal: FloatArray  # (m, 3) unit
    reflectance: FloatArray  # (m,) solar [-]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Distinct:
    """The different surfaces of a scene."""

    surfaces: SurfaceSet
    row_of: IntArray  # (s,) row of every surface of the scene among them


def distinct_surfaces(normal: FloatArray, assignment: Assignment) -> Distinct:
    """Surfaces (s, 3) that differ in normal, wall type or reflectance, each once."""
    key = np.column_stack([np.round(normal, 6), assignment.wall_type, np.round(assignment.reflectance, 6)])
    _, first, inverse = np.unique(key, axis=0, return_index=True, return_inverse=True)
    surfaces = SurfaceSet(
        wall_types=assignment.wall_types,
        wall_type=assignment.wall_type[first],
        normal=normal[first],
        reflectance=assignment.reflectance[first],
    )
    return Distinct(surfaces=surfaces, row_of=inverse.ravel())


def fine_environment(weather: Weather, day: date) -> Environment:
    """Environment of the full solve: steps of FINE_STEP, and all the history that the weather has."""
    return build_environment(weather, image_day=day, lead_in_days=longest_lead_in(weather, day), step=FINE_STEP)


def fine_settings(settings: BakeSettings) -> BakeSettings:
    """Settings of the full solve that a bake with `settings` stands for: its sky and film, the rest fine."""
    return replace(
        BakeSettings(), sky=settings.sky, convection=settings.convection, step=FINE_STEP, cell_size=FINE_CELLS,
        lead_in_stride=1,
    )  # fmt: skip


def solve_surfaces(
    environment: Environment, surfaces: SurfaceSet, *, ground: WallType, record: IntArray, settings: BakeSettings
) -> FloatArray:
    """Temperatures (r, m) [K] of the surfaces at the samples `record` (r,), marched at the environment's step.

    Of the settings sky, film, cells and lead-in count; `ground` is the plane that the surfaces see. Surfaces of one
    wall type and reflectance are solved together, the groups in threads.
    """
    repeated = lead_in_of(ground, environment, own=settings.lead_in_days is None).repeated
    soil = ground_temperature(environment, ground, sky=settings.sky, repeated=repeated)
    temperature = np.zeros((record.size, surfaces.normal.shape[0]))
    alike, group = np.unique(np.column_stack([surfaces.wall_type, surfaces.reflectance]), axis=0, return_inverse=True)

    def solve(row: int) -> None:
        chosen = np.flatnonzero(group.ravel() == row)
        exposure = expose(environment, surfaces.normal[chosen], soil, sky=settings.sky)
        wall, reflectance = surfaces.wall_types[int(alike[row, 0])], alike[row, 1:]
        solved = solve_histories(environment, exposure, wall, reflectance, record, settings=settings)
        temperature[:, chosen] = solved[:, :, 0]

    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        list(pool.map(solve, range(alike.shape[0])))
    return temperature
