"""Camera motion, symbols and recorded flights: closed forms, no window."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.frames.camera_path import CameraPath, read_camera_path
from sensorsim.render import Camera
from sensorsim.scene import LocalFrame
from sensorsim.viewer import Recording, camera_at, write_camera_path
from sensorsim.viewer.keys import HELD, HELP, PRESSED, SCRUB_KEYS, known_keys, motion_of, scrub_of
from sensorsim.viewer.motion import (
    FAST,
    LOWEST,
    STEEPEST,
    Motion,
    circle,
    drag,
    fly,
    point_ahead,
    stick_motion,
    turn,
    wheel_speed,
    zoom,
)
from sensorsim.viewer.symbology import Label, Line, Status, heading_tape, pitch_ladder, polarity_text, symbols

FRAME = LocalFrame(longitude=-84.02, latitude=39.82)


def camera(**changes: object) -> Camera:
    base = Camera(position=np.array([10.0, 20.0, 50.0]), yaw=90.0, pitch=0.0, horizontal_field_of_view=40.0)
    return replace(base, **changes)  # type: ignore[arg-type]


# --- motion ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("key", "way"),
    [("W", (1, 0, 0)), ("S", (-1, 0, 0)), ("D", (0, -1, 0)), ("A", (0, 1, 0)), ("E", (0, 0, 1)), ("Q", (0, 0, -1))],
)
def test_a_key_moves_an_eastward_camera_its_way_by_speed_times_time(key: str, way: tuple[int, int, int]) -> None:
    moved = fly(camera(), motion_of({key}), 30.0, 0.5)
    assert moved.position == pytest.approx(camera().position + 15.0 * np.array(way), abs=1e-9)
    assert (moved.yaw, moved.pitch) == (90.0, 0.0)


def test_flight_does_not_depend_on_the_number_of_frames() -> None:
    motion, many = Motion(forward=1.0, right=0.5, up=-0.2), camera(pitch=-20.0)
    for _ in range(100):
        many = fly(many, motion, 40.0, 0.01)
    assert many.position == pytest.approx(fly(camera(pitch=-20.0), motion, 40.0, 1.0).position, abs=1e-9)


def test_opposite_keys_cancel_and_shift_is_fast() -> None:
    assert motion_of({"W", "S", "A", "D"}) == Motion()
    slow, quick = fly(camera(), motion_of({"W"}), 10.0, 1.0), fly(camera(), motion_of({"W", "LEFT_SHIFT"}), 10.0, 1.0)
    ratio = (quick.position[0] - 10.0) / (slow.position[0] - 10.0)
    assert ratio == pytest.approx(FAST)


def test_nobody_flies_below_the_ground_or_past_straight_up() -> None:
    assert fly(camera(), Motion(up=-1.0), 5000.0, 1.0).position[2] == LOWEST
    assert turn(camera(), 0.0, 500.0).pitch == STEEPEST
    assert turn(camera(), 0.0, -500.0).pitch == -STEEPEST
    assert turn(camera(), 300.0, 0.0).yaw == pytest.approx(30.0)


def test_what_is_under_the_mouse_stays_under_it_near_the_middle() -> None:
    width, pixels = 800.0, 4.0
    turned = drag(camera(), pixels, 0.0, width)
    middle = math.degrees(math.atan(pixels / (0.5 * width) * math.tan(math.radians(20.0))))
    assert 90.0 - turned.yaw == pytest.approx(middle, rel=1e-4)


def test_circling_keeps_distance_and_middle() -> None:
    target = np.array([110.0, 20.0, 10.0])
    start = circle(camera(), target, Motion(), 20.0, 0.0)
    around = start
    for _ in range(50):
        around = circle(around, target, Motion(right=1.0), 20.0, 0.05)
    radius = np.linalg.norm(camera().position - target)
    assert np.linalg.norm(around.position - target) == pytest.approx(radius, rel=1e-9)
    forward = around.axes()[0]
    assert forward == pytest.approx((target - around.position) / radius, abs=1e-9)
    swept = np.degrees(np.arccos(np.dot(forward, start.axes()[0])))
    assert swept > 10.0


def test_circling_never_passes_through_the_target_nor_below_the_ground() -> None:
    target, moved = np.array([110.0, 20.0, 0.0]), camera()
    for _ in range(500):
        moved = circle(moved, target, Motion(forward=1.0, up=-1.0), 50.0, 0.1)
    assert np.linalg.norm(moved.position - target) >= 2.0 * LOWEST - 1e-6
    assert moved.position[2] >= LOWEST
    above = camera(position=target + np.array([0.0, 0.0, 80.0]))
    assert np.all(np.isfinite(circle(above, target, Motion(right=1.0), 10.0, 0.1).position))


def test_field_and_speed_stay_within_what_there_is() -> None:
    assert zoom(camera(), 1e-9).horizontal_field_of_view == 0.5
    assert zoom(camera(), 1e9).horizontal_field_of_view == 120.0
    assert wheel_speed(40.0, 1.0) == pytest.approx(50.0)
    assert wheel_speed(wheel_speed(40.0, 3.0), -3.0) == pytest.approx(40.0)
    assert wheel_speed(40.0, 1000.0) == 5000.0


def test_the_point_ahead_is_on_the_surface_on_the_ground_or_just_ahead() -> None:
    assert point_ahead(camera(), 30.0) == pytest.approx([40.0, 20.0, 50.0])
    down = point_ahead(camera(pitch=-30.0), None)
    assert down == pytest.approx([10.0 + 50.0 * math.sqrt(3.0), 20.0, 0.0])
    assert point_ahead(camera(pitch=10.0), None)[2] > 50.0


def test_sticks_at_rest_do_nothing_and_full_ones_do_all() -> None:
    assert stick_motion([0.1, -0.1, 0.0, 0.05, -1.0, -1.0], [0] * 15) == Motion()
    full = stick_motion([1.0, -1.0, -1.0, 1.0, -1.0, 1.0], [1, 0, 0, 1])
    assert full == Motion(forward=1.0, right=1.0, up=1.0, yaw=-1.0, pitch=-1.0, zoom=1.0, fast=True)
    assert stick_motion([], []) == Motion()
    assert stick_motion([math.nan] * 6, [0] * 4) == Motion()


# --- keys --------------------------------------------------------------------------------------------------------


def test_no_key_has_two_meanings() -> None:
    tables = [set(HELD), set(SCRUB_KEYS), set(PRESSED)]
    assert sum(map(len, tables)) == len(set().union(*tables))
    assert set().union(*tables) < known_keys()


def test_the_help_page_names_every_letter_that_does_something() -> None:
    words = {word.strip(",") for _, rows in HELP for keys, _ in rows for word in keys.split()}
    letters = {key for key in (*HELD, *PRESSED) if len(key) == 1 and key.isalpha()}
    assert letters <= words
    assert {f"F{number}" for number in (10, 11, 12)} <= words


def test_scrub_keys_run_the_clock_both_ways() -> None:
    assert scrub_of({"COMMA"}) == -scrub_of({"PERIOD"}) == -1.0
    assert scrub_of({"COMMA", "PERIOD", "W"}) == 0.0


# --- symbols -----------------------------------------------------------------------------------------------------


def test_the_tape_has_the_heading_in_its_middle_and_north_where_north_is() -> None:
    lines, labels = heading_tape(350.0, 1000.0)
    texts = {label.text: label for label in labels}
    assert texts["350"].at[0] == 500.0
    half = 180.0
    assert texts["N"].at[0] == pytest.approx(500.0 + 10.0 / 30.0 * half)
    assert all(500.0 - half <= x <= 500.0 + half for line in lines for x in (line.start[0], line.end[0]))


def test_rungs_lie_where_a_camera_sees_their_elevation() -> None:
    looking = camera(pitch=-7.0)
    lines, labels = pitch_ladder(looking, (1280.0, 720.0))
    assert len(lines) == 2 * len(labels)
    _, right, up = looking.axes()
    half_width, _ = looking.half_extent((1280, 720))
    for label in labels:
        angle = math.radians(float(label.text))
        ray = np.array([math.cos(angle), 0.0, math.sin(angle)])  # straight ahead, to the east
        forward = looking.axes()[0]
        y = 360.0 - 640.0 / half_width * float(ray @ up) / float(ray @ forward)
        assert label.at[1] == pytest.approx(y, abs=1e-6)
        assert abs(float(ray @ right)) < 1e-12


def test_symbols_tell_range_polarity_and_field() -> None:
    status = Status(
        sensor="flir", band="8-14 um", polarity=polarity_text("black-hot", emissive=True), automatic=False,
        gain="8 K", level="280 K", range=None, clock="10:00", place=(39.8, -84.0, 50.0),
    )  # fmt: skip
    lines, labels = symbols(camera(), (640.0, 480.0), status)
    texts = [label.text for label in labels]
    assert all(isinstance(line, Line) for line in lines)
    assert all(isinstance(label, Label) for label in labels)
    assert {"RNG ---", "BLK HOT  MAN", "FOV 40.0 deg", "GAIN 8 K", "LVL 280 K"} <= set(texts)
    assert "39.80000 N  84.00000 W" in texts
    assert "RNG 123 m" in [label.text for label in symbols(camera(), (640.0, 480.0), replace(status, range=123.4))[1]]
    assert polarity_text("white-hot", emissive=False) == "POSITIVE"


def test_a_rolled_camera_has_no_ladder() -> None:
    assert pitch_ladder(camera(roll=5.0), (640.0, 480.0)) == ((), ())


# --- recordings --------------------------------------------------------------------------------------------------


def test_a_recorded_flight_is_read_back_where_it_was_flown(tmp_path: Path) -> None:
    recording = Recording()
    for step in range(5):
        moved = camera(yaw=(350.0 + 5.0 * step) % 360.0, position=np.array([10.0 * step, -3.0 * step, 50.0]))
        recording = recording.add(2.0 + 0.1 * step, moved)
    write_camera_path(tmp_path / "flight.csv", recording.path(), FRAME)
    flight = read_camera_path(tmp_path / "flight.csv", FRAME)
    assert flight.time == pytest.approx([0.0, 0.1, 0.2, 0.3, 0.4], abs=1e-4)
    for read, flown in zip(flight.camera, recording.camera, strict=True):
        assert read.position == pytest.approx(flown.position, abs=2e-3)
        assert read.yaw == pytest.approx(flown.yaw, abs=1e-4)
    assert [path.name for path in tmp_path.iterdir()] == ["flight.csv"]


def test_replay_turns_the_shorter_way_and_ends_at_the_ends() -> None:
    flight = CameraPath(time=(3.0, 5.0), camera=(camera(yaw=350.0), camera(yaw=20.0, pitch=10.0)))
    assert camera_at(flight, 1.0).yaw == pytest.approx(5.0)
    assert camera_at(flight, 1.0).pitch == pytest.approx(5.0)
    assert camera_at(flight, -1.0) is flight.camera[0]
    assert camera_at(flight, 99.0) is flight.camera[1]
    single = CameraPath(time=(0.0,), camera=(camera(),))
    assert camera_at(single, 0.5) is single.camera[0]


def test_an_empty_recording_and_a_disk_that_refuses_say_so(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="nothing was recorded"):
        Recording().path()
    recording = Recording().add(1.0, camera()).add(1.0, camera(yaw=1.0))
    assert len(recording.time) == 1
    with pytest.raises(InputError, match="cannot be written"):
        write_camera_path(tmp_path / "missing" / "flight.csv", recording.path(), FRAME)
