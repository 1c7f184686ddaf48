"""A scene under its weather, with all tables baked: what any number of sensors can be pointed at."""

import hashlib
from dataclasses import dataclass, fields
from datetime import date

import numpy as np

from sensorsim.effects import EffectChoice, Ledger, Limits
from sensorsim.environment import DEFAULT_VISIBILITY, Environment, Weather, place_mismatch
from sensorsim.errors import InputError
from sensorsim.materials import Catalogue
from sensorsim.render.survey import EVERY_EFFECT, Survey, survey_scene
from sensorsim.scene import Scene
from sensorsim.sensor import Sensor
from sensorsim.tables import (
    BakeSettings,
    ShadeTables,
    SurfaceOffsets,
    cached_tables,
    near_surface_offsets,
    unbaked_tables,
)
from sensorsim.tables.assign import Assignment
from sensorsim.tables.bake import Progress
from sensorsim.tables.cache import inputs_digest
from sensorsim.thermal import Season


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
    choice: EffectChoice  # what was asked for of the effects
    ledger: Ledger  # which effects of the surface are in the tables
    limits: Limits  # temperatures that no surface leaves


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
    effects: EffectChoice = EVERY_EFFECT,
    sensor: Sensor | None = None,
) -> World:
    """Tables of a scene for one day of the weather; weather of another place or clock is used, with a warning.

    visibility [m] and aerosol, the kind of haze or fog, are those of the air that the scene is seen through. Of the
    `effects` all are computed unless the choice says otherwise. Those that are left to their bounds are held to the
    noise of `sensor`, or to that of one that sees surface temperatures.
    """
    settings = BakeSettings() if settings is None else settings
    survey = survey_scene(
        scene, weather, image_day=image_day, settings=settings, visibility=visibility, aerosol=aerosol,
        catalogue=catalogue, choice=effects, sensor=sensor,
    )  # fmt: skip
    return world_of(survey, weather, _tables(survey, progress))


def world_of(survey: Survey, weather: Weather, tables: ShadeTables) -> World:
    """The surveyed scene with its tables, and with the exchange of its near surfaces where that is asked for."""
    site, settings, environment = survey.scene.site, survey.settings, survey.environment
    plan, offsets = survey.ledger.plan, None
    if plan.has("exchange") and plan.has("temperature"):
        offsets = near_surface_offsets(
            survey.scene, survey.assignment, environment, ground=survey.ground, settings=settings,
            time_of_day=tables.time_of_day, plan=plan,
        )  # fmt: skip
    tabled = inputs_digest(
        environment, survey.assignment.wall_types, survey.ground, settings, plan=plan, scope=survey.scope
    )
    clock = site.utc_offset if len(survey.scene.files) > 1 else None  # outlines without a place file guess their clock
    mismatch = place_mismatch(weather.site, site.longitude, site.latitude, utc_offset=clock)
    return World(
        scene=survey.scene,
        weather=weather,
        environment=environment,
        season=survey.season,
        assignment=survey.assignment,
        tables=tables,
        offsets=offsets,
        inputs_sha256=_digest(survey.scene, survey.assignment, f"{tabled} exchange {plan.has('exchange')}"),
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


def require_temperature(world: World, sensor: Sensor) -> None:
    """Refuse an emissive sensor in a world that was built without temperatures."""
    if sensor.mode == "emissive" and not world.ledger.plan.has("temperature"):
        problem = "needs surface temperatures, which this world was built without"
        raise InputError("renderer", "sensor", sensor.name, problem, "build the world for this sensor, or with them")


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
