"""What is known of a scene under its weather before anything is solved, and which effects that calls for."""

from dataclasses import dataclass, replace
from datetime import date

from sensorsim.effects import (
    DEFAULT_NOISE,
    EFFECTS,
    NOISE_SHARE,
    SURFACE,
    Bound,
    EffectChoice,
    EffectPlan,
    Ledger,
    Limits,
    Situation,
    apparent_factor,
    applicable,
    decide,
    film_bound,
    march_cost,
    reflectance_bound,
    surface_bounds,
    term_cost,
)
from sensorsim.environment import DEFAULT_VISIBILITY, Environment, Weather, build_environment, longest_lead_in
from sensorsim.errors import InputError
from sensorsim.materials import Catalogue, WallType, load_catalogue
from sensorsim.radiometry import build_band_table
from sensorsim.scene import Scene
from sensorsim.sensor import Sensor, netd, sensor_parts
from sensorsim.tables import BakeSettings, resolve_classes
from sensorsim.tables.assign import SNOW_CODE, Assignment, assign_wall_types
from sensorsim.tables.faces import ground_face, scene_faces
from sensorsim.tables.scope import Scope, plain_walls, polynomial_miss, scene_scope, whole_scope
from sensorsim.thermal import Season, season_of

GROUND_CODE = 93  # loam: the ground plane that walls see
EVERY_EFFECT = EffectChoice(base="all")
UNSEEN = "the band shows reflected light, not temperature"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Survey:
    """A scene under its weather, with nothing solved yet."""

    scene: Scene
    environment: Environment
    season: Season
    assignment: Assignment
    ground: WallType
    settings: BakeSettings
    choice: EffectChoice
    ledger: Ledger  # of the effects of the surface
    limits: Limits  # temperatures that no surface leaves

    @property
    def scope(self) -> Scope:
        """What the bake has to solve."""
        return _scope(self.environment, self.assignment, self.scene, self.settings, self.ledger.plan)


def survey_scene(
    scene: Scene,
    weather: Weather,
    *,
    image_day: date,
    settings: BakeSettings,
    visibility: float = DEFAULT_VISIBILITY,
    aerosol: str = "rural",
    catalogue: Catalogue | None = None,
    choice: EffectChoice = EVERY_EFFECT,
    sensor: Sensor | None = None,
) -> Survey:
    """Survey of a scene for one day; effects by the user's choice and, where that is left open, by their bounds.

    With a `sensor` bounds are in its apparent temperature, without one in surface temperature.
    """
    catalogue = load_catalogue() if catalogue is None else catalogue
    _require_one_level(scene, settings, choice)
    mode = "emissive" if sensor is None else sensor.mode
    choice = _with_exchange(choice, settings)
    choice.require_inputs(sky=settings.sky, mode=mode, parts=None if sensor is None else sensor_parts(sensor))
    lead_in = longest_lead_in(weather, image_day) if settings.lead_in_days is None else settings.lead_in_days
    environment = build_environment(
        weather, image_day=image_day, lead_in_days=lead_in, step=settings.step, visibility=visibility, aerosol=aerosol
    )
    scene, season = resolve_classes(scene, catalogue), season_of(environment)
    if choice.asked("snow") is False:
        season = replace(season, snow=False)
    assignment = assign_wall_types(scene, catalogue, season)
    ground = ground_plane(catalogue, season)
    situation = _held(
        _situation(environment, scene, assignment, ground, settings), choice, tolerance_of(sensor, choice)
    )
    effects = applicable((effect for effect in EFFECTS if effect.stage == SURFACE), sky=settings.sky, mode=mode)
    bounds = _worth(situation, choice, sensor, _spared(situation, assignment, scene, settings))
    return Survey(
        scene=scene,
        environment=environment,
        season=season,
        assignment=assignment,
        ground=ground,
        settings=settings,
        choice=choice,
        ledger=Ledger(rows=decide(effects, bounds, choice, tolerance=tolerance_of(sensor, choice), unit="K")),
        limits=situation.limits,
    )


def _require_one_level(scene: Scene, settings: BakeSettings, choice: EffectChoice) -> None:
    """Refuse exchange between near surfaces where all levels of detail stand together."""
    if scene.lineage is not None and (settings.exchange or "exchange" in choice.wanted):
        problem = "its levels stand within each other, so what is near there is not near in a picture"
        raise InputError(scene.name, "level", scene.level, problem, "name one level, or leave exchange out")


def ground_plane(catalogue: Catalogue, season: Season) -> WallType:
    """The plane that walls see: loam, or snow where it lies."""
    return catalogue.wall_type(SNOW_CODE if season.snow else GROUND_CODE, "none")


def tolerance_of(sensor: Sensor | None, choice: EffectChoice) -> float:
    """What effects that bounds leave out may change together [K].

    What the user says, else a share of the sensor's NETD, or of a usual one.
    """
    if choice.tolerance is not None:
        return choice.tolerance
    stated = sensor is not None and sensor.mode == "emissive" and sensor.detector is not None
    return NOISE_SHARE * (netd(sensor) if stated and sensor is not None else DEFAULT_NOISE)


def _with_exchange(choice: EffectChoice, settings: BakeSettings) -> EffectChoice:
    """Near surfaces exchange only if asked to, by the settings or by name: that takes longer than all the rest."""
    asked = settings.exchange or "exchange" in choice.wanted
    return choice.with_wanted("exchange") if asked else choice.with_refused("exchange")


def _situation(
    environment: Environment, scene: Scene, assignment: Assignment, ground: WallType, settings: BakeSettings
) -> Situation:
    """Faces of all orientations that the scene shows; others do not matter to it."""
    shown = _scope(environment, assignment, scene, settings, EffectPlan(off=("spare_orientations",)))
    return Situation(
        environment=environment,
        faces=scene_faces(environment, assignment, shown, settings),
        ground=ground_face(environment, ground, settings),
    )


def _held(situation: Situation, choice: EffectChoice, tolerance: float) -> Situation:
    """The situation with the wind's film, where neither the user nor the bounds can leave it out.

    Near surfaces that see each other may be warmer than any alone: limits then go by emission.
    """
    kept = choice.asked("forced_convection")
    kept = film_bound(situation).value > tolerance if kept is None else kept
    return replace(situation, film_kept=kept and choice.asked("exchange") is not True)


def _scope(
    environment: Environment, assignment: Assignment, scene: Scene, settings: BakeSettings, plan: EffectPlan
) -> Scope:
    return scene_scope(environment, assignment, scene.surfaces.normal, settings, plan)


def _worth(
    situation: Situation, choice: EffectChoice, sensor: Sensor | None, spared: dict[str, Bound]
) -> dict[str, Bound]:
    """Bounds of the terms of the heat balance: in apparent temperature for an emissive sensor, else as they are."""
    bounds, limits = _priced(situation), situation.limits
    apart = limits.greatest - limits.coldest
    bounds["exchange"] = Bound(value=apart, reason="computed where asked for alone: it takes longer than all the rest")
    if sensor is not None and sensor.mode == "reflective":
        if not choice.wants_temperature:
            unseen = {name: Bound(value=0.0, reason=UNSEEN) for name in (*bounds, *spared)}
            baked = replace(spared["temperature"], value=0.0, reason=UNSEEN)  # their time is in its
            return {**unseen, "snow": bounds["snow"], "temperature": baked}
        return bounds | spared
    factor = 1.0
    if sensor is not None:
        table = build_band_table(sensor.band)
        factor = apparent_factor(table, coldest=limits.coldest, warmest=limits.greatest)
    return {name: replace(bound, value=factor * bound.value) for name, bound in (bounds | spared).items()}


def _priced(situation: Situation) -> dict[str, Bound]:
    """Bounds with the time that each term takes; one that the history has none of takes none."""
    counts, samples = [face.normal.shape[0] for face in situation.faces], situation.environment.time.size
    shared, all_walls = max(counts, default=0), sum(counts)
    return {
        name: replace(bound, saves=term_cost(name, shared, all_walls, samples) if bound.value > 0.0 else 0.0)
        for name, bound in surface_bounds(situation).items()
    }


def _spared(situation: Situation, assignment: Assignment, scene: Scene, settings: BakeSettings) -> dict[str, Bound]:
    """What need not be solved because no surface shows it, or no band: most of the time that a bake takes."""
    environment, whole = situation.environment, whole_scope(assignment.wall_types, settings).columns
    turned = EffectPlan(off=("spare_orientations",))
    seen = _scope(environment, assignment, scene, settings, turned).columns
    shown = _scope(environment, assignment, scene, settings, turned.without("spare_reflectances"))
    samples, all_needed = environment.time.size, "a spline, the closest three and lobes are made from all of them"
    value, reason = _reflectance_worth(situation, assignment, settings, shown)
    apart = situation.limits.greatest - situation.limits.coldest
    return {
        "temperature": Bound(
            value=apart, reason="asked for by name or by a plane of the frame", saves=march_cost(seen, samples)
        ),
        "spare_orientations": Bound(
            value=0.0,
            reason=f"surfaces show {seen} of {whole} histories" if seen < whole else all_needed,
            saves=march_cost(whole - seen, samples),
        ),
        "spare_reflectances": Bound(
            value=value if shown.columns < seen else 0.0,
            reason=reason if shown.columns < seen else "surfaces have as many as are solved",
            saves=march_cost(seen - shown.columns, samples),
        ),
    }


def _reflectance_worth(
    situation: Situation, assignment: Assignment, settings: BakeSettings, shown: Scope
) -> tuple[float, str]:
    """What a bake of the scene's own reflectances differs by from one of all [K], at most, and why."""
    if not shown.lit:
        return 0.0, "no light to reflect"
    limits = situation.limits
    if settings.lobes > 0.0 or settings.interpolation == "spline":
        return limits.greatest - limits.coldest, "lobes and splines are fitted to all of them together"
    misses = {
        wall: polynomial_miss(own, settings)
        for wall, own in zip(assignment.wall_types, shown.reflectances, strict=True)
        if own != settings.reflectances
    }
    plain = dict.fromkeys(part for wall in assignment.wall_types for part in plain_walls(wall))
    value = reflectance_bound(situation, [misses.get(wall, 0.0) for wall in plain])
    return value, f"{len(misses)} of {len(assignment.wall_types)} wall types have fewer than are solved"
