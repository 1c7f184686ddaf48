"""State, keys' actions, clock, palettes and scripts of the viewer: no window."""

from dataclasses import replace
from datetime import date
from pathlib import Path

import numpy as np
import pytest
import small_world

from sensorsim.environment import read_weather
from sensorsim.errors import InputError
from sensorsim.radiometry import FLIR_BAND, build_band_table
from sensorsim.render import Camera
from sensorsim.sensor import DisplaySettings, display_code, window_from_temperatures
from sensorsim.viewer import Inputs, Place, Seen, ViewState, advance, press, read_script
from sensorsim.viewer.choices import choosable_days, default_day, shipped_days, weather_name
from sensorsim.viewer.clock import clock_text, day_strip, read_clock, run_clock, sun_times
from sensorsim.viewer.files import free_path
from sensorsim.viewer.palettes import PALETTES, paint, palette_table, scale_values
from sensorsim.viewer.script import due
from sensorsim.viewer.state import other_gain, with_gain, with_level, with_sensor

SHOWN = DisplaySettings(level=40.0, span=4.0)
STATIONS = tuple(
    Camera(position=np.array([float(east), 0.0, 30.0]), yaw=0.0, pitch=-10.0, horizontal_field_of_view=30.0)
    for east in (0, 100)
)
SEEN = Seen(
    sensors=("flir", "lltv", "uncooled"), own=dict.fromkeys(("flir", "lltv", "uncooled"), DisplaySettings()),
    shown={"flir": SHOWN}, distance=80.0, stations=STATIONS, days=shipped_days(), width=800.0,
)  # fmt: skip


def state(**changes: object) -> ViewState:
    place = Place(level="IIIB", weather="winter", day=date(1976, 2, 7))
    base = ViewState(camera=STATIONS[0], time_of_day=36000.0, place=place, sensors=("flir", "lltv"))
    return replace(base, **changes)  # type: ignore[arg-type]


# --- presses -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("key", "name"),
    [("V", "side_by_side"), ("N", "noise"), ("B", "blur"), ("M", "symbology"), ("I", "probe"), ("TAB", "panels"),
     ("H", "help"), ("SPACE", "playing")],
)  # fmt: skip
def test_a_switch_turns_over_and_back(key: str, name: str) -> None:
    before = state()
    once = press(before, key, SEEN)
    assert getattr(once, name) is not getattr(before, name)
    assert getattr(press(once, key, SEEN), name) is getattr(before, name)


def test_numbers_choose_sensors_and_swap_the_second() -> None:
    assert press(state(), "3", SEEN).sensors == ("uncooled", "lltv")
    assert press(state(), "2", SEEN).sensors == ("lltv", "flir")
    assert press(state(), "9", SEEN).sensors == ("flir", "lltv")
    assert with_sensor(state(), "flir").sensors == ("flir", "lltv")
    assert state().drawn == ("flir",)
    assert state(side_by_side=True).drawn == ("flir", "lltv")


def test_held_gain_shows_the_same_picture_and_lets_go_again() -> None:
    held = press(state(), "G", SEEN).displays["flir"]
    assert (held.level, held.span) == (SHOWN.level, SHOWN.span)
    assert other_gain(held, SHOWN) == DisplaySettings()


def test_gain_keeps_the_middle_and_level_keeps_the_width() -> None:
    raised = with_gain(DisplaySettings(), SHOWN, 2.0)
    assert raised.level == SHOWN.level
    assert raised.span == pytest.approx(4.0 / 1.25**2)
    shifted = with_level(DisplaySettings(), SHOWN, 3.0)
    assert shifted.span == SHOWN.span
    assert shifted.level == pytest.approx(40.0 + 3 * 0.05 * 4.0)
    assert press(press(state(), "RIGHT_BRACKET", SEEN), "LEFT_BRACKET", SEEN).displays["flir"].span == pytest.approx(4)


def test_knobs_turn_only_what_is_on_show() -> None:
    assert press(state(side_by_side=True), "P", SEEN).displays == {"flir": DisplaySettings(polarity="black-hot")}
    assert press(press(state(), "P", SEEN), "P", SEEN).displays["flir"].polarity == "white-hot"
    assert press(state(), "L", SEEN).displays["flir"].tone == "plateau"


def test_palettes_cameras_levels_and_weather_go_round() -> None:
    for key, read, count in (
        ("K", lambda s: s.palette, len(PALETTES)),
        ("C", lambda s: s.station, 2),
        ("F", lambda s: s.place.level, 4),
        ("J", lambda s: s.place.weather, 3),
    ):
        seen, now = [], state()
        for _ in range(count):
            seen.append(read(now))
            now = press(now, key, SEEN)
        assert len(set(seen)) == count
        assert read(now) == seen[0]
    assert press(state(), "C", SEEN).camera is STATIONS[1]
    assert press(state(), "J", SEEN).place.day == date(1976, 9, 3)


def test_escape_closes_the_page_first_and_quits_then() -> None:
    closed = press(state(help=True), "ESCAPE", SEEN)
    assert (closed.help, closed.quit) == (False, False)
    assert press(closed, "ESCAPE", SEEN).quit


def test_keys_without_meaning_change_nothing() -> None:
    before = state()
    assert press(before, "Y", SEEN) is before
    assert press(before, "F12", SEEN) is before
    assert press(before, "C", replace(SEEN, stations=())) is before


# --- a moment ----------------------------------------------------------------------------------------------------


def test_holding_a_key_flies_and_takes_the_hint_away() -> None:
    moved = advance(state(), Inputs(held=frozenset({"W"})), SEEN, 0.1)
    assert moved.camera.position[1] == pytest.approx(4.0 * np.cos(np.radians(10.0)))
    assert moved.moved
    still = advance(state(), Inputs(), SEEN, 0.1)
    assert not still.moved
    assert still.frame == 1
    assert still.camera is STATIONS[0]


def test_orbit_circles_what_was_in_the_middle_until_the_pilot_looks_away() -> None:
    circling = press(state(), "O", SEEN)
    assert circling.orbit is not None
    target = circling.orbit
    assert np.linalg.norm(target - STATIONS[0].position) == pytest.approx(80.0)
    around = advance(circling, Inputs(held=frozenset({"D"})), SEEN, 0.5)
    assert np.linalg.norm(target - around.camera.position) == pytest.approx(80.0)
    assert advance(around, Inputs(drag=(5.0, 0.0)), SEEN, 0.1).orbit is None
    assert press(circling, "O", SEEN).orbit is None


def test_wheel_is_speed_and_with_control_the_lens() -> None:
    assert advance(state(), Inputs(wheel=1.0), SEEN, 0.1).speed == pytest.approx(50.0)
    zoomed = advance(state(), Inputs(wheel=1.0, held=frozenset({"LEFT_CONTROL"})), SEEN, 0.1)
    assert zoomed.camera.horizontal_field_of_view == pytest.approx(27.0)
    assert zoomed.speed == 40.0


def test_the_clock_runs_when_it_plays_or_is_scrubbed() -> None:
    assert advance(state(playing=True, play_speed=600.0), Inputs(), SEEN, 2.0).time_of_day == 37200.0
    assert advance(state(), Inputs(held=frozenset({"COMMA"})), SEEN, 1.0).time_of_day == 36000.0 - 5400.0
    assert advance(state(time_of_day=86400.0), Inputs(), SEEN, 1.0).time_of_day == 86400.0


# --- clock -------------------------------------------------------------------------------------------------------


def test_midnight_is_followed_by_the_same_morning() -> None:
    assert run_clock(86000.0, 600.0, 1.0) == pytest.approx(200.0)
    assert run_clock(100.0, -600.0, 1.0) == pytest.approx(85900.0)


@pytest.mark.parametrize("minute", [0, 1, 599, 1439, 1440])
def test_clock_text_is_read_back(minute: int) -> None:
    assert read_clock(clock_text(60.0 * minute)) == 60.0 * minute


@pytest.mark.parametrize("text", ["", "10", "25:00", "24:01", "10:60", "-1:00", "10:30:99", "a:b", "1:2:3:4"])
def test_no_clock_is_refused(text: str) -> None:
    assert read_clock(text) is None


def test_the_strip_is_bright_when_the_sun_is_up() -> None:
    environment = small_world.environment()
    rise, down = sun_times(environment)
    assert rise is not None
    assert down is not None
    assert 7 * 3600 < rise < 8.5 * 3600  # February at 40 degrees north
    assert 17 * 3600 < down < 18.5 * 3600
    strip = day_strip(environment, 97).sum(axis=1)
    hours = np.linspace(0.0, 24.0, 97)
    assert strip[(hours > 9.5) & (hours < 16.0)].min() > 2.0 * strip[(hours < 5.5) | (hours > 20.5)].max()


# --- colours -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", PALETTES)
def test_a_palette_has_a_colour_of_its_own_for_almost_every_grey(name: str) -> None:
    table = palette_table(name)
    assert table.shape == (256, 3)
    assert len(np.unique(table, axis=0)) > 220


def test_grey_is_grey_and_iron_grows_brighter() -> None:
    assert np.array_equal(palette_table("grey"), np.repeat(np.arange(256)[:, None], 3, axis=1))
    brightness = palette_table("iron") @ np.array([0.30, 0.59, 0.11])
    assert np.all(np.diff(brightness) > -1.0)
    picture = paint(np.array([[0, 255]], dtype=np.uint8), palette_table("iron"))
    assert picture.shape == (1, 2, 3)


@pytest.mark.parametrize("polarity", ["white-hot", "black-hot"])
def test_the_scale_says_what_a_black_body_of_that_grey_is(polarity: str) -> None:
    table = build_band_table(FLIR_BAND)
    level, span = window_from_temperatures(table, 270.0, 300.0)
    display = DisplaySettings(level=level, span=span, polarity=polarity)  # type: ignore[arg-type]
    values = scale_values(display, table, 6)
    codes = display_code(table.radiance_at(values), display)
    assert codes == pytest.approx([0, 51, 102, 153, 204, 255], abs=1)
    assert sorted((values[0], values[-1])) == pytest.approx([270.0, 300.0], abs=1e-3)


def test_the_scale_follows_a_bent_tone_curve() -> None:
    display = DisplaySettings(level=10.0, span=4.0)
    bent = scale_values(display, None, 5, np.linspace(0.0, 1.0, 512) ** 0.5)
    assert bent == pytest.approx([8.0, 8.25, 9.0, 10.25, 12.0], abs=0.02)


# --- choices and files -------------------------------------------------------------------------------------------


def test_shipped_days_are_the_three_of_the_report() -> None:
    days = (("winter", date(1976, 2, 7)), ("summer", date(1976, 9, 3)), ("fall", date(1976, 10, 7)))
    assert shipped_days() == days
    assert weather_name(None, date(1976, 9, 3)) == "summer"
    assert weather_name("1976-10-07", date(1976, 10, 7)) == "fall"
    assert weather_name("mine.csv", date(2001, 1, 1)) == "mine.csv"
    assert choosable_days("mine.csv", date(2001, 1, 1))[0] == ("mine.csv", date(2001, 1, 1))
    assert choosable_days("fall", date(1976, 10, 7)) == days


def test_the_default_day_of_a_file_is_its_last_whole_one() -> None:
    assert default_day(read_weather("winter")) == date(1976, 2, 7)


def test_files_never_take_a_name_that_is_there(tmp_path: Path) -> None:
    (tmp_path / "a_001.json").write_text("{}")
    assert free_path(tmp_path, "a", ".png").name == "a_002.png"
    assert free_path(tmp_path / "new", "a", ".png").name == "a_001.png"
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="--out"):
        free_path(tmp_path / "file", "a", ".png")


# --- scripts -----------------------------------------------------------------------------------------------------


def test_a_script_is_read_with_notes_and_empty_lines(tmp_path: Path) -> None:
    path = tmp_path / "flight.txt"
    path.write_text("# a flight\n\n0 hold W\n0.5 release W  # stop\n0.5 time 13:30\n1 drag 10 -5\n2 quit\n")
    steps = read_script(path)
    assert [step.command for step in steps] == ["hold", "release", "time", "drag", "quit"]
    assert steps[3].numbers == (10.0, -5.0)
    assert [step.command for step in due(steps, 0.4, 1.0)] == ["release", "time"]
    assert [step.command for step in due(steps, 1.0, 1.1)] == ["drag"]


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("x press W", "no time"), ("nan press W", "no time"), ("1 press W\n0 quit", "line 2"), ("-1 quit", "no time"),
        ("0 jump", "unknown"), ("0", "unknown"), ("0 press", "write: press KEY"), ("0 press ANY", "write: press KEY"),
        ("0 drag 1", "write: drag"), ("0 drag 1 inf", "write: drag"), ("0 drag 1 x", "write: drag"),
        ("0 time 25:00", "write: time"), ("0 wait forever", "write: wait bake"), ("0 quit now", "write: quit"),
    ],
)  # fmt: skip
def test_a_line_that_is_no_step_is_refused_by_name(tmp_path: Path, text: str, problem: str) -> None:
    path = tmp_path / "flight.txt"
    path.write_text(text)
    with pytest.raises(InputError, match=problem):
        read_script(path)


def test_a_script_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cannot be read"):
        read_script(tmp_path / "none.txt")
