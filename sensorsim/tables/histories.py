"""Histories of surfaces as the tables have them solved: a wall type, its exposure, the weather, the room behind."""

import numpy as np

from sensorsim.environment import Environment
from sensorsim.materials import WallType
from sensorsim.tables.mixture import mix_temperatures, part_reflectances
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.thermal.boundary import Inside
from sensorsim.thermal.heat_balance import Exposure
from sensorsim.thermal.interior import build_interior
from sensorsim.thermal.natural import cool_skin, melting_depth, surface_boundary
from sensorsim.thermal.paths import march_paths


def solve_histories(
    environment: Environment, exposure: Exposure, wall: WallType, reflectances: FloatArray, record: IntArray, *,
    convection: str,
) -> FloatArray:  # fmt: skip
    """Surface temperature (t, o, r) [K] of a wall type at the samples `record` (t,), at solar reflectances (r,).

    Of a mixed one every part is solved at the reflectances that are its own.
    """
    if wall.parts:
        parts = [
            solve_histories(environment, exposure, part.wall, own, record, convection=convection)
            for part, own in zip(wall.parts, part_reflectances(wall, reflectances), strict=True)
        ]
        return mix_temperatures(wall, parts)
    outside = surface_boundary(environment, exposure, wall, correlation=convection)
    water = wall.cover is not None and wall.cover.kind == "water"
    # Water remembers weeks; it starts from the mean of the air that it has mixed in.
    start = float(np.mean(environment.air_temperature)) if water else None
    history = march_paths(
        wall, outside, inside_of(environment, wall), 1.0 - reflectances, step=environment.step, record=record,
        start=start, melting_depth=melting_depth(wall),
    )  # fmt: skip
    if water and wall.cover is not None:
        return cool_skin(history.exterior, outside, record, wall.cover)
    return history.exterior


def inside_of(environment: Environment, wall: WallType) -> Inside:
    """What acts on the interior face of a wall type in this weather."""
    return build_interior(
        wall.interior,
        environment.air_temperature,
        environment.wind_speed,
        environment.step,
        wall.interior_emissivity,
        room=wall.room,
        heat_gain=wall.heat_gain,
    )
