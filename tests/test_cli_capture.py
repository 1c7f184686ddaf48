"""Sequences on disk: whole, resumed, the same from one process or several; differences judged in kelvin."""

import hashlib
import json
import sys
from dataclasses import replace
from pathlib import Path

import imageio.v3 as imageio
import numpy as np
import pytest
from small_world import LATITUDE, LONGITUDE, town, town_features, write_town

from sensorsim.cli import main
from sensorsim.errors import InputError
from sensorsim.frames import read_plane
from sensorsim.frames.difference import compare_frames, difference
from sensorsim.frames.frame import Plane
from sensorsim.frames.sequence import SequenceOptions, Shot, draw_block, frame_path, sequence_blocks, warm_up
from sensorsim.frames.side_by_side import beside, join_frames
from sensorsim.frames.video import write_video
from sensorsim.render import Renderer, look_at
from sensorsim.sensor import DisplaySettings, load_sensor

AT = "1976-02-07T10:00"
SIZE = (32, 24)
VIEWS = [look_at([-60.0 + 3.0 * k, -80.0, 40.0], [20.0, 20.0, 5.0], 40.0) for k in range(4)]
SHOTS = tuple(Shot(number=k, time_of_day=36000.0 + k / 30.0, camera=view) for k, view in enumerate(VIEWS))


def run(monkeypatch: pytest.MonkeyPatch, *words: object) -> int:
    monkeypatch.setattr(sys, "argv", ["sensorsim", *map(str, words)])
    with pytest.raises(SystemExit) as left:
        main()
    return int(left.value.code or 0)


def digests(folder: Path) -> dict[str, str]:
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in sorted(folder.iterdir())}


def draw(folder: Path, name: str, numbers: range = range(4), **options: object) -> int:
    folder.mkdir(exist_ok=True)
    with Renderer(town(), load_sensor(name), size=SIZE) as renderer:
        return draw_block(renderer, SHOTS, numbers, SequenceOptions(folder=folder, **options))


def test_blocks_cover_every_frame_once() -> None:
    shots = tuple(Shot(number=k, time_of_day=k / 30.0, camera=VIEWS[0]) for k in range(75))
    for display, size in (
        (DisplaySettings(), 32),
        (DisplaySettings(settle=0.1), 48),
        (DisplaySettings(settle=9.0), 75),
    ):
        sensor = replace(load_sensor("flir"), display=display)
        blocks = sequence_blocks(sensor, shots)
        assert [number for block in blocks for number in block] == list(range(75))
        assert len(blocks[0]) == size
        assert sequence_blocks(sensor, ()) == []


@pytest.mark.parametrize("name", ["flir", "uncooled"])
def test_cut_off_sequence_goes_on_without_redoing_or_losing_frames(tmp_path: Path, name: str) -> None:
    assert draw(tmp_path / "whole", name, planes=("radiance",)) == 4
    assert draw(tmp_path / "cut", name, planes=("radiance",)) == 4
    times = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "cut").iterdir()}
    (tmp_path / "cut" / f"{name}_000002.json").unlink()  # as a run leaves it that is ended while it writes
    (tmp_path / "cut" / f"{name}_000003.png").unlink()
    assert draw(tmp_path / "cut", name, planes=("radiance",)) == 2
    assert digests(tmp_path / "cut") == digests(tmp_path / "whole")
    kept = [path for path in (tmp_path / "cut").iterdir() if path.stem.endswith(("000000", "000001"))]
    assert kept
    assert all(path.stat().st_mtime_ns == times[path.name] for path in kept)


def test_frames_of_a_detector_that_remembers_do_not_depend_on_where_work_is_cut(tmp_path: Path) -> None:
    assert warm_up(load_sensor("uncooled"), SHOTS, 3) >= 2
    assert warm_up(load_sensor("flir"), SHOTS, 3) == 0
    draw(tmp_path / "one", "uncooled")
    draw(tmp_path / "two", "uncooled", range(3, 4))
    name = frame_path(SequenceOptions(folder=tmp_path), load_sensor("uncooled"), 3).name
    assert digests(tmp_path / "two")[name] == digests(tmp_path / "one")[name]


def test_frames_of_other_settings_are_drawn_anew(tmp_path: Path) -> None:
    draw(tmp_path, "flir")
    assert draw(tmp_path, "flir") == 0
    assert draw(tmp_path, "flir", planes=("range",)) == 4  # a plane more
    moved = tuple(Shot(number=s.number, time_of_day=s.time_of_day + 1.0, camera=s.camera) for s in SHOTS)
    with Renderer(town(), load_sensor("flir"), size=SIZE) as renderer:
        assert draw_block(renderer, moved, range(4), SequenceOptions(folder=tmp_path)) == 4


def test_capture_is_the_same_from_one_process_and_from_two(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = write_town(tmp_path, town_features())
    route = tmp_path / "route.csv"
    rows = [f"{k / 2},{LATITUDE - 1e-3},{LONGITUDE + 1e-4 * k},40,10,-12,0,50" for k in range(3)]
    route.write_text("\n".join(["t,lat,lon,alt,yaw,pitch,roll,hfov", *rows]), encoding="utf-8")
    common = ("capture", scene, "--at", AT, "--path", route, "--sensors", "uncooled", "--size", "32x24")
    for jobs in (1, 2):
        assert run(monkeypatch, *common, "--preset", "report", "--out", tmp_path / str(jobs), "--jobs", jobs) == 0
    assert digests(tmp_path / "1") == digests(tmp_path / "2")
    assert len(digests(tmp_path / "1")) == 6


def test_capture_goes_on_with_the_same_effects_and_draws_anew_with_others(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = write_town(tmp_path, town_features())
    words = ("--at", AT, "--camera", "-60,-80,40,40,-12", "--size", "32x24", "--preset", "report")
    told = []
    for effects in ("auto", "auto", "all,-atmosphere", "all,-atmosphere"):
        assert run(monkeypatch, "capture", scene, *words, "--effects", effects, "--out", tmp_path / "kept") == 0
        told.append(capsys.readouterr().err.split()[0])
    assert told == ["1", "0", "1", "0"]
    settings = json.loads((tmp_path / "kept" / "flir_000000.json").read_text())["settings"]
    assert not {row["effect"]: row["on"] for row in settings["effects"]}["atmosphere"]
    assert settings["atmosphere"]["coefficient_per_m"] == [0.0]


def test_capture_through_the_day_makes_a_video(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = write_town(tmp_path, town_features())
    words = ("--at", AT, "--until", "1976-02-07T11:00", "--every", "1200", "--size", "32x24", "--preset", "report")
    assert run(monkeypatch, "capture", scene, *words, "--video", "gif", "--out", tmp_path / "day") == 0
    assert imageio.imread(tmp_path / "day" / "flir.gif", index=None).shape[:3] == (4, 24, 32)
    hours = [
        json.loads(path.read_text())["settings"]["time_of_day_s"] for path in sorted((tmp_path / "day").glob("*.json"))
    ]
    assert hours == [36000.0, 37200.0, 38400.0, 39600.0]


def test_pictures_become_an_mp4_of_the_same_greys(tmp_path: Path) -> None:
    draw(tmp_path, "flir")
    pictures = [frame_path(SequenceOptions(folder=tmp_path), load_sensor("flir"), number) for number in range(4)]
    write_video(pictures, tmp_path / "flir.mp4", 25.0)
    frames = imageio.imread(tmp_path / "flir.mp4", plugin="pyav")
    assert frames.shape[:3] == (4, 24, 32)
    drawn = np.stack([imageio.imread(path) for path in pictures])
    assert np.abs(frames[..., 0].astype(float) - drawn).mean() < 12.0  # compression, and a narrower range of greys
    assert not list(tmp_path.glob(".*partial*"))


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--until", "1976-02-07T09:00"), "before --at"),
        (("--until", "1976-02-08T09:00"), "leaves the day"),
        (("--every", "0"), "--every = 0.0: not above 0"),
        (("--jobs", "0"), "--jobs = 0"),
        (("--format", "bmp"), "--format = 'bmp': unknown"),
        (("--video", "avi"), "--video = 'avi'"),
        (("--sensors", "flir,radar"), "sensor = 'radar': unknown"),
    ],
)
def test_capture_refuses_what_it_cannot_do(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: tuple[str, ...],
    said: str,
) -> None:
    scene = write_town(tmp_path, town_features())
    common = ("capture", scene, "--at", AT, "--size", "32x24", "--preset", "report", "--out", tmp_path / "out")
    assert run(monkeypatch, *common, *words) == 2
    assert said in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_diff_judges_by_its_tolerance(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = write_town(tmp_path, town_features())
    for name, at in (("a", "1976-02-07T10:00"), ("b", "1976-02-07T10:30")):
        words = ("--at", at, "--size", "32x24", "--preset", "report", "--planes", "apparent_temperature")
        assert run(monkeypatch, "render", scene, *words, "--out", tmp_path / f"{name}.png") == 0
    a, b = tmp_path / "a.png", tmp_path / "b.png"
    assert run(monkeypatch, "diff", a, a, "--tolerance", "0") == 0
    assert run(monkeypatch, "diff", a, b, "--tolerance", "0.001") == 3
    assert "failed: allowed 0.001 K" in capsys.readouterr().out
    found = compare_frames(a, b)
    assert run(monkeypatch, "diff", a, b, "--tolerance", found.largest + 1e-6, "--json") == 0
    told = json.loads(capsys.readouterr().out)
    assert told["passed"]
    assert told["largest"] == pytest.approx(found.largest)
    assert found.mean > 0.0  # the morning warms the town
    assert run(monkeypatch, "diff", a, b, "--plane", "range") == 2


def test_difference_counts_what_only_one_frame_sees() -> None:
    one = Plane(name="range", data=np.array([[0.0, 5.0, 7.0]]), unit="m", description="", no_surface=0.0)
    other = Plane(name="range", data=np.array([[3.0, 5.5, 7.0]]), unit="m", description="", no_surface=0.0)
    found = difference(one, other)
    assert (found.pixels, found.unmatched, found.largest, found.mean) == (2, 1, 0.5, 0.25)


def test_diff_refuses_what_has_no_plane_in_common(tmp_path: Path) -> None:
    draw(tmp_path, "flir", suffix=".npy", planes=("range",))
    with pytest.raises(InputError, match="none in common"):
        compare_frames(tmp_path / "flir_000000.npy", tmp_path / "flir_000001.npy")
    with pytest.raises(InputError, match=r"missing|No such file"):
        compare_frames(tmp_path / "flir_000000.npy", tmp_path / "nothing.png")


def test_frames_do_not_depend_on_where_work_is_cut_whatever_shows_in_them(tmp_path: Path) -> None:
    """Fields of an interlaced sensor, a tube's lag, and a gain that settles over many frames."""
    slow = DisplaySettings(settle=0.02)
    for name in ("flir1977", "sit1977"):
        draw(tmp_path / "one", name, display=slow)
        draw(tmp_path / "two", name, range(3, 4), display=slow)
        draw(tmp_path / "quick", name)
        file = frame_path(SequenceOptions(folder=tmp_path), load_sensor(name), 3).name
        assert digests(tmp_path / "two")[file] == digests(tmp_path / "one")[file]
        assert digests(tmp_path / "quick")[file] != digests(tmp_path / "one")[file]


def test_frames_that_show_in_others_are_those_of_the_last_moments() -> None:
    steps = {"quick": 1.0 / 30.0, "slow": 0.2, "rare": 900.0}
    shots = {
        name: [Shot(number=k, time_of_day=step * k, camera=VIEWS[0]) for k in range(90)] for name, step in steps.items()
    }
    flir, sit, still = load_sensor("flir1977"), load_sensor("sit1977"), DisplaySettings(settle=0.5)
    assert warm_up(flir, shots["quick"], 80) == 1  # the other field
    assert warm_up(flir, shots["quick"], 0) == 0
    assert warm_up(sit, shots["quick"], 80) > 2
    assert warm_up(sit, shots["slow"], 80) == warm_up(flir, shots["rare"], 80) == 0
    assert warm_up(load_sensor("flir"), shots["quick"], 80, still) == 60  # MEMORY times half a second
    assert warm_up(load_sensor("flir"), shots["slow"], 80, still) == 10
    assert warm_up(load_sensor("flir"), shots["rare"], 80, still) == 0
    assert warm_up(flir, shots["quick"], 80, still) == 61


def test_frames_far_apart_are_drawn_alone(tmp_path: Path) -> None:
    """An hour's timelapse of a bolometer: the one that is missing, and no other."""
    shots = tuple(Shot(number=s.number, time_of_day=36000.0 + 900.0 * s.number, camera=s.camera) for s in SHOTS)
    with Renderer(town(), load_sensor("uncooled"), size=SIZE) as renderer:
        assert draw_block(renderer, shots, range(4), SequenceOptions(folder=tmp_path)) == 4
        (tmp_path / "uncooled_000003.json").unlink()
        before = digests(tmp_path)
        looks: list[int] = []
        renderer.watch = lambda stage: looks.append(1) if stage == "moment" else None
        assert draw_block(renderer, shots, range(4), SequenceOptions(folder=tmp_path)) == 1
    assert len(looks) == 1
    assert {**before, "uncooled_000003.json": digests(tmp_path)["uncooled_000003.json"]} == digests(tmp_path)


def test_two_sensors_side_by_side_show_the_same_moments_from_the_same_place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene, out = write_town(tmp_path, town_features()), tmp_path / "both"
    words = ("--at", AT, "--until", "1976-02-07T10:30", "--every", "900", "--size", "32x24", "--preset", "report")
    both = ("--sensors", "flir,lltv", "--side-by-side", "--video", "gif")
    assert run(monkeypatch, "capture", scene, *words, *both, "--out", out) == 0
    for number in range(3):
        pictures = [imageio.imread(out / f"{name}_{number:06d}.png") for name in ("flir", "lltv", "flir_lltv")]
        assert np.array_equal(np.hstack(pictures[:2]), pictures[2])
        told = [json.loads((out / f"{name}_{number:06d}.json").read_text())["settings"] for name in ("flir", "lltv")]
        assert [told[0][name] == told[1][name] for name in ("time_of_day_s", "frame", "camera")] == [True] * 3
    assert imageio.imread(out / "flir_lltv.gif", index=None).shape[:3] == (3, 24, 64)


def test_frames_that_are_not_locked_are_not_joined(tmp_path: Path) -> None:
    draw(tmp_path, "flir", range(2))
    draw(tmp_path, "lltv", range(2))
    name = "{}_{:06d}.png".format
    with pytest.raises(InputError, match="time_of_day_s"):
        join_frames([tmp_path / name("flir", 0), tmp_path / name("lltv", 1)], tmp_path / "both.png")
    assert not (tmp_path / "both.png").exists()


def test_lower_pictures_stand_in_the_middle_between_black() -> None:
    joined = beside([np.full((4, 3), 9, np.uint8), np.full((2, 1), 7, np.uint8)])
    assert joined[:, 3].tolist() == [0, 7, 7, 0]
    assert (joined[:, :3] == 9).all()


@pytest.mark.parametrize("words", [("--sensors", "flir"), ("--sensors", "flir,lltv", "--format", "npy")])
def test_side_by_side_of_one_sensor_or_of_no_pictures_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], words: tuple[str, ...]
) -> None:
    scene = write_town(tmp_path, town_features())
    assert run(monkeypatch, "capture", scene, "--at", AT, "--side-by-side", *words, "--out", tmp_path / "both") == 2
    assert "needs pictures of two sensors" in capsys.readouterr().err


def test_capture_through_another_air_draws_anew(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = write_town(tmp_path, town_features())
    words = (
        "--at",
        AT,
        "--camera",
        "-60,-80,40,40,-12",
        "--size",
        "32x24",
        "--preset",
        "report",
        "--planes",
        "radiance",
    )
    planes, told = [], []
    for air in ((), ("--visibility", "0.3"), ("--atmosphere", "report"), ("--radiance", "source")):
        assert run(monkeypatch, "capture", scene, *words, *air, "--planes", "radiance", "--out", tmp_path / "kept") == 0
        told.append(capsys.readouterr().err.split()[0])
        planes.append(read_plane(tmp_path / "kept" / "flir_000000.png", "radiance").data)
    assert told == ["1"] * 4
    assert all(np.abs(planes[0] - other).max() > 1e-3 for other in planes[1:])
