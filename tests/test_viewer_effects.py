"""Effects in the window: what is listed and asked for, what bakes, and pictures without planes in flight."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
import small_world

from sensorsim.effects import EFFECTS, SURFACE, EffectChoice
from sensorsim.render import EVERY_EFFECT, Renderer, World, station_camera
from sensorsim.sensor import load_sensor
from sensorsim.viewer import Place, Stage, ViewState
from sensorsim.viewer.choices import seen
from sensorsim.viewer.effect_list import WORDS, baked_choice, effect_lines, same_bake, with_choice, with_word, word_of
from sensorsim.viewer.pace import TOLD_EVERY, Pace

SIZE = (160, 120)
PLACE = Place(level="IIIB", weather="winter", day=small_world.DAY)
OF_WALLS = [effect.name for effect in EFFECTS if effect.stage == SURFACE]


def state(**changes: object) -> ViewState:
    camera = station_camera(small_world.town().scene, "overhead")
    base = ViewState(camera=camera, time_of_day=43200.0, place=PLACE, sensors=("flir", "lltv"))
    return replace(base, **changes)  # type: ignore[arg-type]


@pytest.fixture
def stage() -> Iterator[Stage]:
    made = Stage(small_world.town(), {name: load_sensor(name) for name in ("flir", "lltv", "uncooled")})
    yield made
    made.release()


# --- choice ------------------------------------------------------------------------------------------------------


def test_words_of_one_effect_are_kept_and_taken_back() -> None:
    choice = EVERY_EFFECT
    for word in (*WORDS, "on", "off", "as all"):
        choice = with_word(choice, "rain", word)
        assert word_of(choice, "rain") == word
        assert word_of(choice, "snow") == "as all"
    assert choice == EVERY_EFFECT


def test_a_word_on_walls_bakes_and_one_on_pictures_does_not() -> None:
    for effect in EFFECTS:
        asked = replace(PLACE, choice=with_word(PLACE.choice, effect.name, "off"))
        assert same_bake(PLACE, asked) == (effect.stage != SURFACE)
    assert not same_bake(PLACE, replace(PLACE, choice=EffectChoice(base="auto")))
    assert not same_bake(PLACE, replace(PLACE, level="IA"))


def test_words_on_pictures_come_and_go_and_those_on_walls_stay_as_baked() -> None:
    world = small_world.town()
    baked = replace(world, choice=EffectChoice(base="auto", refused=frozenset({"rain"})))
    asked = EffectChoice(base="auto", wanted=frozenset({"atmosphere"}), refused=frozenset({"specular", "snow"}))
    found = with_choice(baked, asked).choice
    assert (found.wanted, found.refused) == ({"atmosphere"}, {"rain", "specular"})
    assert with_choice(with_choice(baked, asked), EffectChoice(base="auto")).choice == baked.choice
    assert baked_choice(asked).refused == {"snow"}


@pytest.mark.parametrize(("sensor", "more"), [("flir", "specular"), ("lltv", "reflected_sun"), ("uncooled", "blur")])
def test_the_list_is_the_ledger_of_the_picture(stage: Stage, sensor: str, more: str) -> None:
    (shot,) = stage.draw(state(sensors=(sensor, "flir" if sensor != "flir" else "lltv")), SIZE)
    assert shot.told.ledger is not None
    lines = {line.name: line for line in effect_lines(shot.told.ledger, EVERY_EFFECT)}
    assert [*lines] == [row.effect for row in shot.told.ledger.rows]
    assert more in lines
    assert all(line.on and line.word == "as all" and line.bound for line in lines.values() if line.name != "exchange")
    assert "bakes" in lines["rain"].hint
    assert "no bake" in lines[more].hint


def test_air_switched_off_is_gone_from_the_next_picture_without_a_bake(
    stage: Stage, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sensorsim.render.world.cached_tables", None)  # a bake would call it
    (clear,) = stage.draw(state(atmosphere="none"), SIZE)
    choice = with_word(stage.world.choice, "atmosphere", "off")
    stage.swap(with_choice(stage.world, choice))
    for plain in (False, True, True):
        (shot,) = stage.draw(state(), SIZE, plain=plain)
    assert shot.told.ledger is not None
    assert not shot.told.ledger.row("atmosphere").on
    near = clear.picture.planes["surface_id"] >= 0
    np.testing.assert_allclose(shot.told.planes["radiance"][near], clear.picture.planes["radiance"][near], rtol=1e-6)


# --- pictures without planes -------------------------------------------------------------------------------------


def test_pictures_in_flight_have_their_display_alone_and_the_facts_of_the_last_whole_one(stage: Stage) -> None:
    whole = stage.draw(state(side_by_side=True), SIZE)
    flown = state(side_by_side=True, camera=replace(state().camera, yaw=3.0))
    plain = stage.draw(flown, SIZE, plain=True)
    for shot, before in zip(plain, whole, strict=True):
        assert set(shot.picture.planes) == {"display"}
        assert shot.told is before.picture
        assert not shot.is_told
        assert before.is_told
    assert seen(stage.world, stage.sensors, plain, (), 160.0).distance is not None
    again = stage.draw(flown, SIZE)
    for shot, quick in zip(again, plain, strict=True):
        codes = shot.picture.planes["display"].astype(int)
        assert np.abs(codes - quick.picture.planes["display"]).max() <= 1


def test_the_first_picture_of_a_renderer_and_of_a_world_is_whole(stage: Stage) -> None:
    assert stage.draw(state(), SIZE, plain=True)[0].is_told
    assert not stage.draw(state(), SIZE, plain=True)[0].is_told
    assert stage.draw(state(), (80, 60), plain=True)[0].is_told
    stage.swap(small_world.town())
    assert stage.draw(state(), SIZE, plain=True)[0].is_told


def test_one_in_a_few_pictures_is_whole_in_flight_and_all_are_at_rest() -> None:
    pace = Pace()
    flying = [pace.plain(moves=True) for _ in range(3 * (TOLD_EVERY + 1))]
    assert flying == ([True] * TOLD_EVERY + [False]) * 3
    assert not any(pace.plain(moves=False) for _ in range(5))


def test_slow_pictures_make_the_pace_coarser() -> None:
    pace, began = Pace(), Pace().scale
    for _ in range(8):
        pace.took(0.2)
    assert pace.scale > began
    for _ in range(40):
        pace.took(0.001)
    assert pace.scale == 1.0


# --- clock -------------------------------------------------------------------------------------------------------


def test_scrubbing_through_the_day_solves_and_bakes_nothing(stage: Stage, monkeypatch: pytest.MonkeyPatch) -> None:
    """Both sensors, every quarter of an hour, whole pictures and plain ones, while bakes are out of order."""

    def refuse(*_: object, **__: object) -> World:
        raise AssertionError("scrubbing must not solve walls")

    for name in ("sensorsim.render.world.cached_tables", "sensorsim.tables.bake.bake_tables"):
        monkeypatch.setattr(name, refuse)
    renderers: set[Renderer] = set()
    means = []
    for plain in (False, True):
        for quarter in range(97):
            shots = stage.draw(state(side_by_side=True, time_of_day=900.0 * quarter, frame=quarter), SIZE, plain=plain)
            renderers |= {shot.renderer for shot in shots}
            means.append(shots[0].told.planes["surface_temperature"].max())
    assert len(renderers) == 2
    assert np.ptp(means[:97]) > 5.0
    assert means[0] == pytest.approx(means[96], abs=5.0)
