"""Histories of surfaces as the tables have them solved: a wall type, its exposure, the weather, the room behind."""

import numpy as np

from sensorsim.environment import Environment
from sensorsim.materials import WallType
from sensorsim.tables.mixture import mix_temperatures, part_reflectances
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.thermal.boundary import Inside
from sensorsim.thermal.heat_balance import Exposure
from sensorsim.thermal.interior import build_interior
from sensorsim.thermal.linear_response import exterior_slope, interior_slope, linear_response
from sensorsim.thermal.natural import AERODYNAMIC, cool_skin, melting_depth, surface_boundary
from sensorsim.thermal.paths import march_paths, wall_paths


def solve_histories(
    environment: Environment, exposure: Exposure, wall: WallType, reflectances: FloatArray, record: IntArray, *,
    convection: str, cell_size: float = 1.0,
) -> FloatArray:  # fmt: skip
    """Surface temperature (t, o, r) [K] of a wall type at the samples `record` (t,), at solar reflectances (r,).

    Of a mixed one every part is solved at the reflectances that are its own.
    """
    if wall.parts:
        parts = [
            solve_histories(environment, exposure, part.wall, own, record, convection=convection, cell_size=cell_size)
            for part, own in zip(wall.parts, part_reflectances(wall, reflectances), strict=True)
        ]
        return mix_temperatures(wall, parts)
    outside = surface_boundary(environment, exposure, wall, correlation=convection)
    water = wall.cover is not None and wall.cover.kind == "water"
    # Water remembers weeks; it starts from the mean of the air that it has mixed in.
    start = float(np.mean(environment.air_temperature)) if water else None
    history = march_paths(
        wall, outside, inside_of(environment, wall), 1.0 - reflectances, step=environment.step, record=record,
        start=start, melting_depth=melting_depth(wall), cell_size=cell_size,
    )  # fmt: skip
    if water and wall.cover is not None:
        return cool_skin(history.exterior, outside, record, wall.cover)
    return history.exterior


def sun_response(
    environment: Environment, exposure: Exposure, wall: WallType, temperature: FloatArray, record: IntArray, *,
    light: FloatArray, first: int, convection: str, cell_size: float = 1.0,
) -> FloatArray:  # fmt: skip
    """Rise (t, m) [K] of a plain wall type, black to the sun, by light (s, m) [W m-2] from sample `first` on.

    Linear about its course (t, o) [K] at the samples `record` (t,), meant over all orientations; before the first of
    them as at the same clock time later.
    """
    cover = wall.cover
    outside = surface_boundary(environment, exposure, wall, correlation=convection)
    at_record = outside._replace(
        film=outside.film[record], air=outside.air[record],
        latent=outside.latent[record] if outside.latent.shape[0] > 1 else outside.latent,
    )  # fmt: skip
    course = exterior_slope(at_record, temperature).mean(axis=1)
    clock = (np.arange(first, record[-1] + 1) - record[0]) % max(int(record[-1] - record[0]), 1)
    slope = np.interp(clock, record - record[0], course)
    share = cover.interception if cover is not None and cover.kind in AERODYNAMIC else 1.0
    inside, rise = inside_of(environment, wall), np.zeros((record.size, light.shape[1]))
    for path in wall_paths(wall, environment.step, cell_size=cell_size):
        inner = interior_slope(inside, path.grid.interior_area)
        rise += path.fraction * linear_response(
            path.grid, share * light, slope, inner, step=environment.step, record=record - first
        )
    return rise


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
