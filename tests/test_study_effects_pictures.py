"""Pictures of effects on and off: every effect has one or a reason, each shows what it is said to, on one page."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from sensorsim.effects import EFFECTS
from sensorsim.sensor import sensor_parts
from sensorsim.study.effects_cases import CASES, WITHOUT_PICTURE, Case, all_cases
from sensorsim.study.effects_pairs import Pair, take_pairs
from sensorsim.study.effects_pictures import HEAD, row, write_pictures_page
from sensorsim.study.effects_sensors import study_sensor
from sensorsim.study.effects_weather import DAYS, study_weather
from sensorsim.tables import BakeSettings

COARSE = BakeSettings(
    interpolation="barycentric", lobes=0.0, orientations="report10", reflectances=(0.1, 0.5, 0.9), degree=2,
    step=1800.0, slice_interval=3600.0, lead_in_days=1.0,
)  # fmt: skip
LOOKED_AT = (
    "direct_sun",
    "sky_horizon",
    "reflected_sun",
    "atmosphere",
    "noise",
    "memory",
    "halo",
    "specular",
    "interlace",
    "dead_elements",
    "replacement",
    "blooming",
)


@cache
def pairs() -> Mapping[tuple[str, str], Pair]:
    """A few of the pairs, small and coarse."""
    cases = [case for case in CASES if case.effect in LOOKED_AT]
    found = take_pairs(settings=COARSE, size=(96, 72), cases=cases)
    return {(pair.case.effect, pair.case.sensor): pair for pair in found}


def test_every_effect_has_a_picture_or_a_reason_why_not() -> None:
    shown = {case.effect for case in all_cases()} | set(WITHOUT_PICTURE)
    assert shown == {effect.name for effect in EFFECTS}


def test_effects_of_both_bands_have_a_picture_in_both() -> None:
    for effect in ("atmosphere", "snow", "blur", "noise", "memory", "interlace"):
        modes = {study_sensor(case.sensor).mode for case in CASES if case.effect == effect}
        assert modes == {"emissive", "reflective"}, effect


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.effect}-{case.sensor}")
def test_case_names_a_sensor_that_has_the_effect_and_a_day_that_there_is(case: Case) -> None:
    effect, sensor = next(one for one in EFFECTS if one.name == case.effect), study_sensor(case.sensor)
    assert effect.mode in (None, sensor.mode)
    assert not effect.part or effect.name in sensor_parts(sensor)
    assert effect.sky in (None, case.sky)
    assert case.weather in DAYS


@pytest.mark.parametrize("effect", LOOKED_AT)
def test_effect_changes_its_picture_and_by_no_more_than_its_bound(effect: str) -> None:
    for (name, _), pair in pairs().items():
        if name == effect:
            assert pair.rms > 0.0
            assert pair.greatest >= pair.rms
            assert pair.bound is None or pair.greatest <= pair.bound * (1.0 + 1e-6)


def test_what_the_sentences_say_is_what_is_seen() -> None:
    sun, rim, mirror = (pairs()[name, "flir"] for name in ("direct_sun", "sky_horizon", "specular"))
    assert np.all(sun.change[sun.surface] > -0.2), "the sun warms"
    assert 0.2 < np.mean(np.abs(rim.change[rim.surface]) < 1e-3) < 0.95, "level surfaces do not see the rim"
    assert 0.0 < np.mean(np.abs(mirror.change[mirror.surface]) > 1.0) < 0.2, "only sheds mirror"
    light = pairs()["reflected_sun", "lltv"]
    assert light.change.min() >= -1e-5
    assert light.unit == "W m-2 sr-1"


def test_days_are_those_of_the_report_with_one_thing_changed() -> None:
    winter, still, snow = (study_weather(name)[0] for name in ("winter", "still winter", "snow"))
    assert not still.wind_speed.any()
    assert winter.wind_speed.all()
    assert set(snow.ground_state) == {"snow"}
    assert np.array_equal(snow.air_temperature, winter.air_temperature)
    rain = study_weather("rain")[0]
    assert set(np.unique(rain.precipitation)) == {0.0, 4.0}
    assert np.sum(rain.precipitation[-24:] > 0.0) == 3


def test_page_holds_all_pictures_and_loads_nothing(tmp_path: Path) -> None:
    page = tmp_path / "pictures.html"
    shown = list(pairs().values())[:2]
    rows = write_pictures_page(page, shown)
    text = page.read_text()
    assert text.count("<img") == len(shown)
    assert "http" not in text
    assert rows == [row(pair) for pair in shown]
    assert {len(cells) for cells in rows} == {len(HEAD)}
    assert "alarm" not in text.split("</style>")[1]
