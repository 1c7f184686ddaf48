"""Wall types in the numbers that bounds of effects are made of: their films in the weather at hand, with no solve."""

import numpy as np

from sensorsim.effects import EVERYTHING, Face
from sensorsim.environment import Environment
from sensorsim.materials import WallType
from sensorsim.tables.assign import Assignment
from sensorsim.tables.orientations import FloatArray
from sensorsim.tables.scope import Scope, plain_walls
from sensorsim.tables.settings import BakeSettings
from sensorsim.thermal.air_properties import pressure_at
from sensorsim.thermal.boundary import Outside
from sensorsim.thermal.heat_balance import expose, solar_irradiance
from sensorsim.thermal.interior import build_interior
from sensorsim.thermal.lead_in import lead_in_of
from sensorsim.thermal.natural import FREE_DIFFERENCE, STILL_WATER_CONDUCTIVITY, surface_boundary
from sensorsim.thermal.rain import caught_rain, rain_film
from sensorsim.thermal.vapour import psychrometric_constant

UP = np.array([[0.0, 0.0, 1.0]])


def scene_faces(
    environment: Environment, assignment: Assignment, scope: Scope, settings: BakeSettings
) -> tuple[Face, ...]:
    """One face for each wall type that is solved."""
    walls = assignment.wall_types
    faces = []
    for wall in dict.fromkeys(part for whole in walls for part in plain_walls(whole)):
        needed = scope.of_part(walls, wall)
        own = [assignment.reflectance[assignment.wall_type == row] for row, whole in enumerate(walls) if whole == wall]
        brightest = 1.0 if not own else 1.0 - min(*settings.reflectances, float(np.min(own[0], initial=1.0)), 1.0)
        faces.append(wall_face(environment, wall, scope.solved[needed], brightest, settings))
    return tuple(faces)


def ground_face(environment: Environment, ground: WallType, settings: BakeSettings) -> Face:
    """The ground plane."""
    return wall_face(environment, ground, UP, float(1.0 - environment.ground_albedo.min()), settings)


def wall_face(
    environment: Environment, wall: WallType, normal: FloatArray, absorptance: float, settings: BakeSettings
) -> Face:
    """Face of a plain wall type with orientations (m, 3) and its greatest solar absorptance [-]."""
    # Films do not depend on the ground's temperature, which is not known yet.
    exposure = expose(environment, normal, environment.air_temperature, sky=settings.sky)
    # A dark horizon takes light away, which a surface has without it.
    lighter = solar_irradiance(environment, normal, sky=settings.sky, plan=EVERYTHING.without("sky_horizon"))
    outside = surface_boundary(
        environment, exposure, wall, correlation=settings.convection, plan=EVERYTHING.without("rain")
    )
    rain = float(rain_film(caught_rain(environment, normal)).max(initial=0.0))
    cover, lead_in = wall.cover, lead_in_of(wall, environment, own=settings.lead_in_days is None)
    by_light = rain > 0.0 or (cover is not None and cover.leaf_area_index > 0.0)
    return Face(
        name=wall.name,
        normal=normal,
        absorptance=absorptance,
        light=max(float(exposure.irradiance.max(initial=0.0)), float(lighter.max(initial=0.0))),
        emissivity=wall.emissivity,
        forced=float(outside.film.max(initial=0.0)),
        least_film=float(outside.film.min()) if outside.film.size else 0.0,
        free=float(max(outside.free.max(initial=0.0), outside.free_colder.max(initial=0.0))),
        rain=rain,
        latent=_latent(environment, outside, rain) if by_light else float(outside.latent.max(initial=0.0)),
        latent_by_light=by_light,
        snow=cover is not None and cover.kind == "snow",
        traffic=0.0 if cover is None else cover.traffic_heat,
        skin=0.0 if cover is None else cover.skin / STILL_WATER_CONDUCTIVITY,
        memory=np.inf if lead_in.repeated else float(environment.time[-1]),
        indoors=_indoors(environment, wall),
        paths=tuple(path.layers for path in wall.paths) or (wall.layers,),
    )


def _latent(environment: Environment, outside: Outside, rain: float) -> float:
    """Vapour exchange [W m-2 Pa-1] of the surface if it were all wet."""
    film = np.cbrt((outside.film + rain) ** 3 + FREE_DIFFERENCE * outside.free).max(initial=0.0)
    pressure = pressure_at(environment.site.altitude)
    return float(film / psychrometric_constant(environment.air_temperature, pressure).min())


def _indoors(environment: Environment, wall: WallType) -> tuple[float, float]:
    inside = build_interior(
        wall.interior, environment.air_temperature, environment.wind_speed, environment.step,
        wall.interior_emissivity, room=wall.room, heat_gain=wall.heat_gain,
    )  # fmt: skip
    return float(inside.air.min()), float(inside.air.max())
