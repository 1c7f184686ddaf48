"""What each effect is worth on the images of [Report1978], in kelvin and in milliseconds, by leaving out one at a time.

All others stay as they are, so that what two effects do together is in both rows. The pictures are those of the figures
of `gallery`; times are processor times over all cores, of bakes summed over the worlds that the figures need.
"""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date

import numpy as np

from sensorsim.constants import PI
from sensorsim.effects import EFFECTS, EffectChoice, Ledger
from sensorsim.environment import read_weather
from sensorsim.render import Picture, Renderer, Survey, World, station_camera, survey_scene, world_of
from sensorsim.scene import load_scene
from sensorsim.sensor import load_sensor
from sensorsim.study.effects_pairs import OF_FRAMES, SPARE
from sensorsim.study.gallery import FIGURES
from sensorsim.tables import BakeSettings, ShadeTables, bake_tables

Progress = Callable[[str, int, int], None]

SENSORS = ("flir", "lltv")
BASE = EffectChoice(base="all", refused=SPARE)  # all but the same pictures as with them, and much sooner
# Coarser than a frame would be baked, since only differences count, and with as many orientations as scenes show.
STUDY = BakeSettings(
    orientations="icosphere42", interpolation="barycentric", lobes=0.0, reflectances=(0.1, 0.5, 0.9), degree=2,
    step=900.0, slice_interval=3600.0, lead_in_days=2.0,
)  # fmt: skip
ROUNDING = 1e-6  # of single precision, relative
FRAME_SIZE, FRAMES, BAKES = (640, 480), 8, 3  # size of frames that are timed, and how many the best is taken of


@dataclass(slots=True, kw_only=True)
class EffectWorth:
    """One effect over all images; grows from world to world."""

    effect: str
    kelvin_max: float = 0.0  # greatest change of apparent temperature in an emissive image [K]
    white_max: float = 0.0  # of radiance in a reflective image, over that of a white surface facing the sun [-]
    bake_ms: float = 0.0  # processor time of the bakes that it takes [ms]
    frame_ms: float = 0.0  # processor time of a frame of FRAME_SIZE that it takes [ms]
    called: int = 0  # images that call for it by its bound
    kelvin_bound: float = 0.0  # greatest bound of that change [K]
    holds: bool = True  # whether no image changes by more than its bound
    squares: list[float] = field(default_factory=list)  # mean square of each emissive image [K2]

    @property
    def kelvin_rms(self) -> float:
        """Root mean square over the pixels of all emissive images [K]."""
        return float(np.sqrt(np.mean(self.squares))) if self.squares else 0.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Place:
    """One level on one day."""

    level: str
    day: date
    settings: BakeSettings
    size: tuple[int, int]
    backend: str
    bakes: int  # of which the fastest counts

    def hours(self, sensor: str) -> list[float]:
        """Hours of the day that figures of a sensor show."""
        return sorted({
            hour for figure in FIGURES if (figure.level, figure.sensor) == (self.level, sensor)
            for day, hour in figure.moments if day == self.day
        })  # fmt: skip

    def survey(self, choice: EffectChoice, sensor: str = "flir") -> Survey:
        return survey_scene(
            load_scene("hospital", level=self.level), read_weather(self.day.isoformat()), image_day=self.day,
            settings=self.settings, choice=choice, sensor=load_sensor(sensor),
        )  # fmt: skip

    def look(self, survey: Survey, tables: ShadeTables, sensor: str) -> list[Picture]:
        """All pictures of a sensor."""
        camera = station_camera(survey.scene, "tower")
        with Renderer(
            self.world(survey, tables), load_sensor(sensor), size=self.size, backend=self.backend
        ) as renderer:
            return [renderer.render(camera, hour * 3600.0) for hour in self.hours(sensor)]

    def world(self, survey: Survey, tables: ShadeTables) -> World:
        return world_of(survey, read_weather(self.day.isoformat()), tables)


def measure_effects(
    *, settings: BakeSettings | None = None, size: tuple[int, int] = (160, 120), backend: str = "auto",
    progress: Progress | None = None, places: Sequence[tuple[str, date]] | None = None, bakes: int = BAKES,
) -> list[EffectWorth]:  # fmt: skip
    """Worth of each effect that the settings' sky has, at all levels and days of the figures or at some `places`."""
    settings = STUDY if settings is None else settings
    drawn = [effect for effect in EFFECTS if not effect.part]  # the images are those of ideal sensors
    found = [EffectWorth(effect=effect.name) for effect in drawn if effect.sky in (None, settings.sky)]
    every = sorted({(figure.level, day) for figure in FIGURES for day, _ in figure.moments}, reverse=True)
    worlds = every if places is None else places
    for done, (level, day) in enumerate(worlds):
        place = _Place(level=level, day=day, settings=settings, size=size, backend=backend, bakes=bakes)
        for step, worth in enumerate(_add(place, found, timed=done == 0)):
            if progress is not None:
                progress(
                    f"{worth.effect}, level {level}, {day}", done * len(found) + step + 1, len(worlds) * len(found)
                )
    return found


def image_count() -> int:
    """Different images that the figures show."""
    return len({(figure.level, figure.sensor, *moment) for figure in FIGURES for moment in figure.moments})


def _add(place: _Place, found: Sequence[EffectWorth], *, timed: bool) -> Iterator[EffectWorth]:
    """Add what each effect is worth at one place; frames are `timed` at one, the one with most in view."""
    survey = place.survey(BASE)
    _bake(survey)  # compiled code is loaded, and memory warm
    tables, spent = _bake(survey)
    whole = {sensor: place.look(survey, tables, sensor) for sensor in SENSORS}
    frame = {sensor: _frame_time(place, survey, tables, sensor) for sensor in SENSORS if timed}
    called = _called(place, tables)
    for worth in found:
        name = worth.effect
        worth.called += called.get(name, 0)
        if name == "temperature":
            worth.bake_ms += spent
        elif name in OF_FRAMES:
            without = replace(survey, choice=BASE.with_refused(name))
            for sensor in _seen_by(name):
                _compare(worth, whole[sensor], place.look(without, tables, sensor))
            for sensor in _seen_by(name) if timed else ():
                less = _frame_time(place, without, tables, sensor)
                worth.frame_ms = max(worth.frame_ms, frame[sensor] - less)
        else:
            _add_of_surface(place, worth, survey, tables, whole["flir"])
        yield worth


def _add_of_surface(
    place: _Place, worth: EffectWorth, survey: Survey, tables: ShadeTables, whole: Sequence[Picture]
) -> None:
    """Add what a term of the heat balance is worth, or what the survey leaves out, if that is computed."""
    name = worth.effect
    if name == "exchange":
        near = place.survey(BASE.with_wanted(name))
        begin = time.process_time()
        place.world(near, tables)
        worth.bake_ms += 1000.0 * (time.process_time() - begin)
        _compare(worth, place.look(near, tables, "flir"), whole)
    elif name in SPARE:
        more = place.survey(EffectChoice(base="all", refused=SPARE - {name}))
        every, saved = _costs(place, survey, more)
        worth.bake_ms -= saved
        _compare(worth, place.look(more, every, "flir"), whole)
    elif survey.ledger.row(name).on and survey.ledger.row(name).bound > 0.0:  # else nothing is left out
        without = _left_out(survey, name)
        left, saved = _costs(place, survey, without)
        worth.bake_ms += saved
        _compare(worth, whole, place.look(without, left, "flir"))


def _seen_by(name: str) -> tuple[str, ...]:
    """Sensors that an effect of the frame has a place in."""
    modes = {effect.name: effect.mode for effect in EFFECTS}
    return tuple(sensor for sensor in SENSORS if modes[name] in (None, load_sensor(sensor).mode))


def _left_out(survey: Survey, name: str) -> Survey:
    """The survey with one term of the heat balance left out as well, which changes nothing else of it."""
    rows = (replace(row, on=row.on and row.effect != name) for row in survey.ledger.rows)
    return replace(survey, choice=survey.choice.with_refused(name), ledger=Ledger(rows=tuple(rows)))


def _frame_time(place: _Place, survey: Survey, tables: ShadeTables, sensor: str) -> float:
    """Processor time [ms] of the fastest of FRAMES frames at the first hour."""
    camera, moment = station_camera(survey.scene, "tower"), place.hours(sensor)[0] * 3600.0
    times = []
    with Renderer(place.world(survey, tables), load_sensor(sensor), size=FRAME_SIZE, backend=place.backend) as renderer:
        for _ in range(FRAMES):
            begin = time.process_time()
            renderer.render(camera, moment)
            times.append(time.process_time() - begin)
    return 1000.0 * min(times)


def _bake(survey: Survey) -> tuple[ShadeTables, float]:
    """Tables of a survey and the processor time [ms] that they take."""
    begin = time.process_time()
    tables = bake_tables(
        survey.environment, survey.assignment.wall_types, ground=survey.ground, settings=survey.settings,
        plan=survey.ledger.plan, scope=survey.scope,
    )  # fmt: skip
    return tables, 1000.0 * (time.process_time() - begin)


def _costs(place: _Place, whole: Survey, left: Survey) -> tuple[ShadeTables, float]:
    """Tables of the survey that leaves something out, and the time [ms] that this saves: bakes of both in turn."""
    longer, shorter = [], []
    for _ in range(place.bakes):
        longer.append(_bake(whole)[1])
        tables, spent = _bake(left)
        shorter.append(spent)
    return tables, min(longer) - min(shorter)


def _called(place: _Place, tables: ShadeTables) -> Mapping[str, int]:
    """How many of the images at a place call for each effect."""
    count: dict[str, int] = {}
    for sensor in SENSORS:
        survey = place.survey(EffectChoice(base="auto"), sensor)
        for picture in place.look(survey, tables, sensor):
            for row in () if picture.ledger is None else picture.ledger.rows:
                count[row.effect] = count.get(row.effect, 0) + int(row.on)
    return count


def _compare(worth: EffectWorth, whole: Sequence[Picture], left: Sequence[Picture]) -> None:
    for one, other in zip(whole, left, strict=True):
        assert other.ledger is not None
        bound, plane = other.ledger.row(worth.effect).bound, "radiance"
        if "apparent_temperature" in one.planes:
            plane, worth.kelvin_bound = "apparent_temperature", max(worth.kelvin_bound, bound)
        change = np.abs(one.planes[plane] - other.planes[plane])
        greatest = float(change.max())
        worth.holds = worth.holds and greatest <= bound * (1.0 + ROUNDING) + ROUNDING * float(one.planes[plane].max())
        if plane == "apparent_temperature":
            worth.kelvin_max = max(worth.kelvin_max, greatest)
            worth.squares.append(float(np.mean(np.square(change))))
        else:
            light = one.illumination
            white = (light.beam + float(np.sum(light.quadrant))) / PI
            worth.white_max = max(worth.white_max, greatest / white)
