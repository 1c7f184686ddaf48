"""A scene under its weather, with all tables baked: what any number of sensors can be pointed at."""

import hashlib
from dataclasses import dataclass, fields
from datetime import date

import numpy as np

from sensorsim.environment import (
    DEFAULT_VISIBILITY,
    Environment,
    Weather,
    build_environment,
    longest_lead_in,
    place_mismatch,
)
from sensorsim.materials import Catalogue, WallType, load_catalogue
from sensorsim.scene import Scene
from sensorsim.tables import (
    BakeSettings,
    ShadeTables,
    SurfaceOffsets,
    cached_tables,
    near_surface_offsets,
    resolve_classes,
)
from sensorsim.tables.assign import SNOW_CODE, Assignment, assign_wall_types
from sensorsim.tables.bake import Progress
from sensorsim.tables.cache import inputs_digest
from sensorsim.thermal import Season, season_of

GROUND_CODE = 93  # loam: the ground plane that walls see


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class World:
    """Everything that does not depend on the sensor."""

    scene: Scene
    weather: Weather
    environment: Environment
    season: Season
    assignment: Assignment
    tables: ShadeTables
    offsets: SurfaceOffsets | None  # of near surfaces, where the settings ask for their exchange
    inputs_sha256: str  # of all that decides its frames: weather, walls, settings, code, geometry, surfaces
    warnings: tuple[str, ...]  # what a user should know of the inputs


def ground_plane(catalogue: Catalogue, season: Season) -> WallType:
    """The plane that walls see: loam, or snow where it lies."""
    return catalogue.wall_type(SNOW_CODE if season.snow else GROUND_CODE, "none")


def build_world(
    scene: Scene,
    weather: Weather,
    *,
    image_day: date,
    settings: BakeSettings | None = None,
    visibility: float = DEFAULT_VISIBILITY,
    aerosol: str = "rural",
    catalogue: Catalogue | None = None,
    progress: Progress | None = None,
) -> World:
    """Tables of a scene for one day of the weather; weather of another place or clock is used, with a warning.

    visibility [m] and aerosol, the kind of haze or fog, are those of the air that the scene is seen through.
    """
    settings = BakeSettings() if settings is None else settings
    catalogue = load_catalogue() if catalogue is None else catalogue
    lead_in = longest_lead_in(weather, image_day) if settings.lead_in_days is None else settings.lead_in_days
    environment = build_environment(
        weather, image_day=image_day, lead_in_days=lead_in, step=settings.step, visibility=visibility, aerosol=aerosol
    )
    scene, season = resolve_classes(scene, catalogue), season_of(environment)
    assignment = assign_wall_types(scene, catalogue, season)
    ground = ground_plane(catalogue, season)
    tables = cached_tables(environment, assignment.wall_types, ground=ground, settings=settings, progress=progress)
    tabled = inputs_digest(environment, assignment.wall_types, ground, settings)
    offsets = None
    if settings.exchange:
        offsets = near_surface_offsets(
            scene, assignment, environment, ground=ground, settings=settings, time_of_day=tables.time_of_day
        )
    site = scene.site
    clock = site.utc_offset if len(scene.files) > 1 else None  # outlines without a place file have a guessed clock
    mismatch = place_mismatch(weather.site, site.longitude, site.latitude, utc_offset=clock)
    return World(
        scene=scene,
        weather=weather,
        environment=environment,
        season=season,
        assignment=assignment,
        tables=tables,
        offsets=offsets,
        inputs_sha256=_digest(scene, assignment, f"{tabled} exchange {settings.exchange}"),
        warnings=() if mismatch is None else (mismatch,),
    )


def _digest(scene: Scene, assignment: Assignment, tables: str) -> str:
    """SHA-256 of the tables' inputs with the geometry and what its surfaces are made of."""
    digest = hashlib.sha256(tables.encode())
    for part in (scene.mesh, scene.surfaces, assignment):
        for field in fields(part):
            value = getattr(part, field.name)
            if isinstance(value, np.ndarray):
                digest.update(f"{field.name}{value.dtype}{value.shape}".encode())
                digest.update(np.ascontiguousarray(value).tobytes())
    return digest.hexdigest()
