"""The full solve: histories of given surfaces themselves, each with its own normal, wall type and reflectance.

What a table's fit is measured against: nothing is interpolated between orientations, reflectances or recorded times.
"""

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from datetime import date, time

import numpy as np

from sensorsim.environment import Environment, Weather, build_environment
from sensorsim.materials import WallType, part_reflectance
from sensorsim.tables.assign import Assignment
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import Exposure, expose
from sensorsim.thermal.interior import build_interior
from sensorsim.thermal.natural import cool_skin, melting_depth, surface_boundary
from sensorsim.thermal.paths import march_paths

FINE_STEP = 60.0  # [s]
LONGEST_LEAD_IN = 4.0  # [days]


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
    """Environment of the full solve: steps of FINE_STEP after LONGEST_LEAD_IN, less where the weather begins later."""
    before = (day - weather.start.date()).days - (weather.start.time() != time())
    lead_in = LONGEST_LEAD_IN if weather.typical_year else min(before, LONGEST_LEAD_IN)
    return build_environment(weather, image_day=day, lead_in_days=lead_in, step=FINE_STEP)


def solve_surfaces(
    environment: Environment,
    surfaces: SurfaceSet,
    *,
    ground: WallType,
    record: np.ndarray,
    sky: str = "perez",
    convection: str = "mowitt",
) -> FloatArray:
    """Temperatures (r, m) [K] of the surfaces at the samples `record` (r,), marched at the environment's step.

    `ground` is the plane that the surfaces see. Wall types are solved in threads.
    """
    soil = ground_temperature(environment, ground, sky=sky)
    temperature = np.zeros((record.size, surfaces.normal.shape[0]))

    def solve(row: int) -> None:
        chosen = np.flatnonzero(surfaces.wall_type == row)
        exposure = expose(environment, surfaces.normal[chosen], soil, sky=sky)
        wall, reflectance = surfaces.wall_types[row], surfaces.reflectance[chosen]
        temperature[:, chosen] = _solve_wall(environment, exposure, wall, reflectance, convection, record)

    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        list(pool.map(solve, np.unique(surfaces.wall_type).tolist()))
    return temperature


def _solve_wall(
    environment: Environment, exposure: Exposure, wall: WallType, reflectance: FloatArray, convection: str,
    record: np.ndarray,
) -> FloatArray:  # fmt: skip
    """Temperatures (r, m) [K] of surfaces of one wall type; of a mixture as in `mix_coefficients`."""
    if not wall.parts:
        return _solve_plain(environment, exposure, wall, reflectance, convection, record)
    mean = sum(part.share * part.reflectance for part in wall.parts)
    total = sum(part.share * part.wall.emissivity for part in wall.parts)
    fourth = np.zeros(())
    for part in wall.parts:
        own = np.array([part_reflectance(part.reflectance, mean, float(value)) for value in reflectance])
        solved = _solve_plain(environment, exposure, part.wall, own, convection, record)
        fourth = fourth + part.share * part.wall.emissivity / total * solved**4
    return np.asarray(fourth**0.25)


def _solve_plain(
    environment: Environment, exposure: Exposure, wall: WallType, reflectance: FloatArray, convection: str,
    record: np.ndarray,
) -> FloatArray:  # fmt: skip
    """Temperatures (r, m) [K]; each surface's irradiance carries its own absorptance, so that the march's is one."""
    outside = surface_boundary(environment, exposure, wall, correlation=convection)
    inside = build_interior(
        wall.interior,
        environment.air_temperature,
        environment.wind_speed,
        environment.step,
        wall.interior_emissivity,
        room=wall.room,
        heat_gain=wall.heat_gain,
    )
    water = wall.cover is not None and wall.cover.kind == "water"
    start = float(np.mean(environment.air_temperature)) if water else None
    absorbed = outside._replace(irradiance=(1.0 - reflectance) * outside.irradiance)
    history = march_paths(
        wall, absorbed, inside, np.ones(1), step=environment.step, record=record, start=start,
        melting_depth=melting_depth(wall),
    )  # fmt: skip
    exterior = history.exterior
    if water and wall.cover is not None:
        exterior = cool_skin(exterior, outside, record, wall.cover)
    return np.asarray(exterior[:, :, 0])
