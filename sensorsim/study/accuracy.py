"""`study accuracy`: what each setting of the baker costs and how far its tables miss the full solve."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import date
from itertools import product

import numpy as np

from sensorsim.environment import Weather, build_environment, read_weather
from sensorsim.materials import Catalogue, load_catalogue
from sensorsim.render import build_world
from sensorsim.render.survey import ground_plane
from sensorsim.scene import Scene
from sensorsim.sensor import load_sensor
from sensorsim.study.accuracy_images import ImageScore, compare, look, true_world
from sensorsim.study.accuracy_measure import Score, StudyDay, fitted, score_trial, solve_day, timed_bake, wall_words
from sensorsim.study.accuracy_scope import Scope, narrow, scope_of
from sensorsim.study.accuracy_surfaces import SEED, catalogue_sample, scene_sample
from sensorsim.study.accuracy_trials import BASELINE, Trial, plan_trials
from sensorsim.tables import BakeSettings, ShadeTables, preset
from sensorsim.tables.full_solve import SurfaceSet
from sensorsim.tables.orientations import FloatArray
from sensorsim.thermal import season_of

MOST_SURFACES = 400  # of a scene that are measured on a day; of more, as many are drawn
AZIMUTHS = np.arange(73) * 5.0  # [deg] of the error map

Progress = Callable[[str, int, int], None]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ErrorMap:
    """Error of the worst wall type's fit as a vertical wall, by time and azimuth."""

    name: str  # of the preset
    wall: str
    day: date
    error: FloatArray  # (t, 73) fit less full solve [K] at TIMES and AZIMUTHS


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Accuracy:
    """All that the study found."""

    title: str  # what was measured
    sampled: str  # how many surfaces of how many
    scores: tuple[Score, ...]
    frames: Mapping[str, float]  # median time of a frame by preset [ms]; empty for a catalogue
    images: tuple[ImageScore, ...]
    map: ErrorMap

    @property
    def candidates(self) -> list[Score]:
        """What can be recommended: presets and combinations."""
        return [score for score in self.scores if score.trial.group != "factor"]


def study_accuracy(
    days: Sequence[StudyDay],
    *,
    title: str,
    presets: Iterable[str] | None = None,
    factors: Iterable[str] | None = None,
    backend: str = "auto",
    progress: Progress | None = None,
) -> Accuracy:
    """Measure presets, factors and combinations over the days, all where None; see `plan_trials`."""
    trials = plan_trials(presets, factors)
    tell = _silent if progress is None else progress
    truth: dict[BakeSettings, dict[date, FloatArray]] = {trial.truth: {} for trial in trials}
    for number, (fine, day) in enumerate(product(truth, days)):
        tell(f"full solve of {day.day}, {fine.sky} sky", number, len(truth) * len(days))
        truth[fine][day.day] = solve_day(day, day.sample.surfaces, fine)
    timed_bake(narrow(days[0], 1)[0], preset("report"))  # so that no trial pays for compiling
    scores: list[Score] = []
    frames: dict[str, float] = {}
    images: list[ImageScore] = []
    for done, trial in enumerate(trials):
        tell(trial.name, done, len(trials))
        twin = _twin(trial, scores)
        scope = scope_of(trial, days, truth[trial.truth])
        if twin is not None:
            scores.append(replace(twin, trial=trial))
            continue
        score, tables = score_trial(trial, scope.days, scope.truth, share=scope.share, scope=scope.words)
        scores.append(score)
        if trial.group == "preset":
            frames[trial.name], seen = _look(trial, scope, tables, backend)
            images += seen
    tell("error map", len(trials), len(trials))
    return Accuracy(
        title=title, sampled=_sampled(days), scores=tuple(scores), frames=frames if images else {},
        images=tuple(images), map=_map(scores, days),
    )  # fmt: skip


def scene_days(
    scene: Scene, moments: Sequence[tuple[Weather, date]], *, limit: int = MOST_SURFACES,
    progress: Progress | None = None,
) -> list[StudyDay]:  # fmt: skip
    """A scene's own surfaces on image days under their weather."""
    catalogue, days = load_catalogue(), []
    for weather, day in moments:
        world = build_world(scene, weather, image_day=day, settings=preset("report"), progress=progress)
        days.append(
            StudyDay(
                day=day,
                weather=weather,
                ground=ground_plane(catalogue, world.season),
                sample=scene_sample(world.scene.surfaces.normal, world.assignment, limit),
                world=world,
            )
        )
    return days


def still_moment() -> tuple[Weather, date]:
    """The eve of the report's summer day, were it clear and without any wind: where walls answer the sun least evenly.

    Insulated faces then reach 90 C, and lose heat by radiation and free convection alone.
    """
    weather, none = read_weather("summer"), np.zeros_like(read_weather("summer").wind_speed)
    return replace(weather, name="still", wind_speed=none, cloud_cover=none), date(1976, 9, 2)


def catalogue_days(catalogue: Catalogue, moments: Sequence[tuple[Weather, date]]) -> list[StudyDay]:
    """All materials of the catalogue as random surfaces, others on each day, on image days under their weather."""
    days = []
    for number, (weather, day) in enumerate(moments):
        season = season_of(build_environment(weather, image_day=day))
        sample = catalogue_sample(catalogue, season, SEED + number)
        ground = ground_plane(catalogue, season)
        days.append(StudyDay(day=day, weather=weather, ground=ground, sample=sample, world=None))
    return days


def _twin(trial: Trial, scores: Sequence[Score]) -> Score | None:
    """A score of the same settings on the same scope: every knob passes through the baseline."""
    for score in scores:
        if trial.group == score.trial.group == "factor" and trial.settings == score.trial.settings:
            return score
    return None


def _look(
    trial: Trial, scope: Scope, tables: Mapping[date, ShadeTables], backend: str
) -> tuple[float, list[ImageScore]]:
    """Median time of the preset's frames [ms] and its pictures' errors on all days that have a world."""
    sensor, spent, scores = load_sensor("flir"), [], []
    for day in scope.days:
        if day.world is None:
            continue
        pictures, milliseconds = look(replace(day.world, tables=tables[day.day]), sensor, timed=True, backend=backend)
        exact, _ = look(true_world(day.world, day, scope.truth[day.day]), sensor, timed=False, backend=backend)
        spent.append(milliseconds)
        scores += compare(trial.name, day, pictures, exact)
    return float(np.median(spent)) if spent else 0.0, scores


def _map(scores: Sequence[Score], days: Sequence[StudyDay]) -> ErrorMap:
    """Of the baseline where it was measured, else of the first setting."""
    score = next((each for each in scores if each.trial.name == BASELINE), scores[0])
    day, azimuth = next(each for each in days if each.day == score.worst.day), np.radians(AZIMUTHS)
    surfaces = SurfaceSet(
        wall_types=(score.worst.wall,),
        wall_type=np.zeros(azimuth.size, dtype=np.int64),
        normal=np.column_stack([np.sin(azimuth), np.cos(azimuth), np.zeros(azimuth.size)]),
        reflectance=np.full(azimuth.size, score.worst.reflectance),
    )
    settings = score.trial.settings
    tables, _, _ = timed_bake(replace(day, sample=replace(day.sample, surfaces=surfaces)), settings)
    error = fitted(tables, surfaces) - solve_day(day, surfaces, score.trial.truth)
    return ErrorMap(name=score.trial.name, wall=wall_words(score.worst.wall), day=day.day, error=error)


def _sampled(days: Sequence[StudyDay]) -> str:
    measured = [day.sample.surfaces.reflectance.size for day in days]
    whole = [day.sample.whole for day in days]
    if measured == whole:
        return f"{' + '.join(map(str, measured))} distinct surfaces of {len(days)} day(s), all there are"
    return f"{sum(measured)} surfaces of {len(days)} day(s), drawn from {sum(whole)} distinct ones"


def _silent(name: str, done: int, total: int) -> None:
    """Progress that nobody listens to."""
