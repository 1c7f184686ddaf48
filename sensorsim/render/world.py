"""A scene under its weather, with all tables baked: what any number of sensors can be pointed at."""

from dataclasses import dataclass
from datetime import date

from sensorsim.effects import EffectChoice, Ledger, Limits
from sensorsim.environment import Environment, Weather, place_mismatch
from sensorsim.materials import Catalogue
from sensorsim.render.survey import EVERY_EFFECT, Survey, survey_scene
from sensorsim.scene import Scene
from sensorsim.sensor import Sensor
from sensorsim.tables import BakeSettings, ShadeTables, cached_tables, unbaked_tables
from sensorsim.tables.assign import Assignment
from sensorsim.tables.bake import Progress
from sensorsim.thermal import Season


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class World:
    """Everything that does not depend on the camera."""

    scene: Scene
    weather: Weather
    environment: Environment
    season: Season
    assignment: Assignment
    tables: ShadeTables
    warnings: tuple[str, ...]  # what a user should know of the inputs
    choice: EffectChoice  # what was asked for of the effects
    ledger: Ledger  # which effects of the surface are in the tables
    limits: Limits  # temperatures that no surface leaves


def build_world(
    scene: Scene,
    weather: Weather,
    *,
    image_day: date,
    settings: BakeSettings | None = None,
    catalogue: Catalogue | None = None,
    progress: Progress | None = None,
    effects: EffectChoice = EVERY_EFFECT,
    sensor: Sensor | None = None,
) -> World:
    """Tables of a scene for one day of the weather; weather of another place or clock is used, with a warning.

    Of the `effects` all are computed unless the choice says otherwise. Those that are left to their bounds are held to
    the noise of `sensor`, or to that of one that sees surface temperatures.
    """
    settings = BakeSettings() if settings is None else settings
    survey = survey_scene(
        scene, weather, image_day=image_day, settings=settings, catalogue=catalogue, choice=effects, sensor=sensor
    )
    return world_of(survey, weather, _tables(survey, progress))


def world_of(survey: Survey, weather: Weather, tables: ShadeTables) -> World:
    """The surveyed scene with its tables."""
    site = survey.scene.site
    clock = site.utc_offset if len(survey.scene.files) > 1 else None  # outlines without a place file guess their clock
    mismatch = place_mismatch(weather.site, site.longitude, site.latitude, utc_offset=clock)
    return World(
        scene=survey.scene,
        weather=weather,
        environment=survey.environment,
        season=survey.season,
        assignment=survey.assignment,
        tables=tables,
        warnings=() if mismatch is None else (mismatch,),
        choice=survey.choice,
        ledger=survey.ledger,
        limits=survey.limits,
    )


def _tables(survey: Survey, progress: Progress | None) -> ShadeTables:
    """Tables of what is to be solved; without any number where no temperature is."""
    plan, walls = survey.ledger.plan, survey.assignment.wall_types
    if not plan.has("temperature"):
        return unbaked_tables(survey.environment, walls, survey.settings)
    return cached_tables(
        survey.environment, walls, ground=survey.ground, settings=survey.settings, progress=progress, plan=plan,
        scope=survey.scope,
    )  # fmt: skip
