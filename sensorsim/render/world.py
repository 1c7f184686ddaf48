"""A scene under its weather, with all tables baked: what any number of sensors can be pointed at."""

from dataclasses import dataclass
from datetime import date

from sensorsim.environment import Environment, Weather, build_environment, place_mismatch
from sensorsim.materials import Catalogue, WallType, load_catalogue
from sensorsim.scene import Scene
from sensorsim.tables import BakeSettings, ShadeTables, cached_tables, resolve_classes
from sensorsim.tables.assign import SNOW_CODE, Assignment, assign_wall_types
from sensorsim.tables.bake import Progress
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
    catalogue: Catalogue | None = None,
    progress: Progress | None = None,
) -> World:
    """Tables of a scene for one day of the weather; weather of another place or clock is used, with a warning."""
    settings = BakeSettings() if settings is None else settings
    catalogue = load_catalogue() if catalogue is None else catalogue
    environment = build_environment(
        weather, image_day=image_day, lead_in_days=settings.lead_in_days, step=settings.step
    )
    scene, season = resolve_classes(scene, catalogue), season_of(environment)
    assignment = assign_wall_types(scene, catalogue, season)
    tables = cached_tables(
        environment,
        assignment.wall_types,
        ground=ground_plane(catalogue, season),
        settings=settings,
        progress=progress,
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
        warnings=() if mismatch is None else (mismatch,),
    )
