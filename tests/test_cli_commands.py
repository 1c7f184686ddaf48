"""What the commands print and write when all is well."""

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any, get_type_hints

import imageio.v3 as imageio
import numpy as np
import pytest
from small_world import LATITUDE, LONGITUDE, box, feature, town_features, write_town

from sensorsim.cli import main
from sensorsim.cli.app import app
from sensorsim.errors import InputError
from sensorsim.frames import plane_names, read_plane, require_writable
from sensorsim.sensor import load_sensor

AT = "1976-02-07T10:00"


def _run(monkeypatch: pytest.MonkeyPatch, *words: object) -> None:
    """One command as the shell gives it, in this process."""
    monkeypatch.setattr(sys, "argv", ["sensorsim", *map(str, words)])
    with pytest.raises(SystemExit) as left:
        main()
    assert left.value.code in (0, None)


@pytest.fixture
def town(tmp_path: Path) -> Path:
    return write_town(tmp_path, town_features())


def _render(monkeypatch: pytest.MonkeyPatch, town: Path, out: Path, *words: object) -> dict[str, Any]:
    """A small frame of the town; what its sidecar says."""
    _run(monkeypatch, "render", town, "--at", AT, "--out", out, "--size", "48x36", "--preset", "report", *words)
    sidecar: dict[str, Any] = json.loads(out.with_suffix(".json").read_text())
    return sidecar


def test_info_names_back_end_renderer_and_versions(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    _run(monkeypatch, "info", "--json")
    told = json.loads(capsys.readouterr().out)
    assert told["opengl"]["backend"] in ("egl", "osmesa", "x11")
    assert told["opengl"]["renderer"]
    assert {"moderngl", "numpy", "numba"} <= told["packages"].keys()
    _run(monkeypatch, "info")
    plain = capsys.readouterr().out
    assert told["opengl"]["backend"] in plain
    assert told["sensorsim"] in plain


@pytest.mark.parametrize("preset", ["draft", "report", "standard"])
@pytest.mark.parametrize("sensor", ["lltv", "sit1977"])
def test_low_light_picture_needs_no_wall_with_any_preset(
    monkeypatch: pytest.MonkeyPatch, town: Path, tmp_path: Path, sensor: str, preset: str
) -> None:
    words = ("--at", AT, "--size", "48x36", "--preset", preset, "--sensor", sensor)
    _run(monkeypatch, "render", town, *words, "--out", tmp_path / "night.png")
    ledger = json.loads((tmp_path / "night.json").read_text())["settings"]["effects"]
    assert {row["effect"]: row["on"] for row in ledger}["temperature"] is False
    assert imageio.imread(tmp_path / "night.png").std() > 10.0


@pytest.mark.parametrize(
    ("level", "counts"), [("IA", (12, 111, 188, 544)), ("IIA", (21, 131, 285, 611)), ("IIIB", (87, 684, 1155, 3203))]
)
def test_scene_counts_are_the_reports(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], level: str, counts: tuple[int, ...]
) -> None:
    _run(monkeypatch, "scene", "hospital", "--level", level, "--json")
    told = json.loads(capsys.readouterr().out)
    assert tuple(told["counts"][name] for name in ("features", "surfaces", "vertices", "edges")) == counts
    _run(monkeypatch, "scene", "hospital", "--level", level)
    plain = capsys.readouterr().out
    assert f"{counts[0]} features, {counts[1]} surfaces, {counts[2]} vertices, {counts[3]} edges" in plain


def test_scene_prints_brackets_in_a_users_words_as_they_are(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    path = tmp_path / "notes.geojson"
    shed = feature(box(0.0, 0.0, 9.0, 9.0), 5.0, number="[/b]")
    path.write_text(json.dumps({"type": "FeatureCollection", "notes": ["heights in [m] [/red]"], "features": [shed]}))
    _run(monkeypatch, "scene", path)
    plain = capsys.readouterr().out
    assert "heights in [m] [/red]" in plain
    assert "[/b]" in plain
    assert "[m2]" in plain


def test_render_writes_picture_planes_and_sidecar(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], town: Path, tmp_path: Path
) -> None:
    out = tmp_path / "made" / "deep" / "frame.png"
    names = ["radiance", "apparent_temperature", "surface_temperature", "range", "surface_id", "feature", "material"]
    sidecar = _render(monkeypatch, town, out, "--planes", ",".join(names), "--camera", "-150,-140,60,45,-18", "--json")
    told = json.loads(capsys.readouterr().out)
    assert sorted(path.name for path in out.parent.iterdir()) == ["frame.exr", "frame.json", "frame.png"]
    assert [Path(path).name for path in told["files"]] == ["frame.png", "frame.exr", "frame.json"]
    picture = imageio.imread(out)
    assert picture.shape == (36, 48)
    assert picture.dtype == np.uint8
    apparent = read_plane(out.with_suffix(".exr"), "apparent_temperature").data
    assert apparent.shape == (36, 48)
    assert 200.0 < apparent.min() < apparent.max() < 330.0
    assert {entry["name"] for entry in sidecar["planes"]} == {"display", *names}
    assert all(len(entry["sha256"]) == 64 for entry in sidecar["planes"])
    settings = sidecar["settings"]
    assert settings["scene"]["files"] == ["town.geojson"]
    assert settings["day"] == "1976-02-07"
    assert settings["time_of_day_s"] == 36000.0
    assert settings["size"] == [48, 36]
    assert settings["bake"]["orientations"] == "report26"
    assert settings["camera"]["yaw_deg"] == 45.0
    assert settings["camera"]["longitude"] == pytest.approx(LONGITUDE - 150.0 / 85_500.0, abs=2e-4)
    assert settings["camera"]["latitude"] == pytest.approx(LATITUDE - 140.0 / 111_000.0, abs=2e-4)


def test_same_command_makes_the_same_bytes(monkeypatch: pytest.MonkeyPatch, town: Path, tmp_path: Path) -> None:
    frames = [tmp_path / name / "frame.png" for name in ("one", "two")]
    for frame in frames:
        _render(monkeypatch, town, frame, "--planes", "radiance", "--plane-format", "npy")
    for first in frames[0].parent.iterdir():
        assert first.read_bytes() == (frames[1].parent / first.name).read_bytes(), first.name


def test_camera_is_the_scenes_first_unless_another_is_named(
    monkeypatch: pytest.MonkeyPatch, town: Path, tmp_path: Path
) -> None:
    one = _render(monkeypatch, town, tmp_path / "a.png")
    two = _render(monkeypatch, town, tmp_path / "b.png", "--camera", "overhead")
    assert one["settings"]["camera"] == two["settings"]["camera"]
    wide = _render(monkeypatch, town, tmp_path / "c.png", "--field-of-view", "75")
    assert wide["settings"]["camera"]["horizontal_field_of_view_deg"] == 75.0


def test_window_and_polarity_are_what_was_asked_for(
    monkeypatch: pytest.MonkeyPatch, town: Path, tmp_path: Path
) -> None:
    plain = _render(monkeypatch, town, tmp_path / "a.png", "--window", "265:290")
    inverse = _render(monkeypatch, town, tmp_path / "b.png", "--window", "265:290", "--polarity", "black-hot")
    assert plain["settings"]["display"]["span"] == inverse["settings"]["display"]["span"]
    first, second = (imageio.imread(tmp_path / name).astype(int) for name in ("a.png", "b.png"))
    assert np.abs(first + second - 255).max() <= 1


def test_sensors_own_polarity_and_window_hold_unless_the_command_says_otherwise(
    monkeypatch: pytest.MonkeyPatch, town: Path, tmp_path: Path
) -> None:
    sensor = tmp_path / "mine.toml"
    sensor.write_text(
        'name = "mine"\ntitle = "mine"\nmode = "emissive"\nhorizontal_field_of_view = 20.0\nsource = "mine"\n'
        '[band]\nname = "FLIR"\nwavelength_um = [8.0, 14.0]\nresponse = [1.0, 1.0]\n'
        '[display]\npolarity = "black-hot"\nlevel = 40.0\nspan = 12.0\n'
    )
    own = _render(monkeypatch, town, tmp_path / "a.png", "--sensor", sensor)["settings"]["display"]
    assert (own["polarity"], own["level"], own["span"]) == ("black-hot", 40.0, 12.0)
    told = _render(monkeypatch, town, tmp_path / "b.png", "--sensor", sensor, "--polarity", "white-hot")
    assert (told["settings"]["display"]["polarity"], told["settings"]["display"]["span"]) == ("white-hot", 12.0)


def test_low_light_sensor_writes_no_apparent_temperature(
    monkeypatch: pytest.MonkeyPatch, town: Path, tmp_path: Path
) -> None:
    sidecar = _render(monkeypatch, town, tmp_path / "a.png", "--sensor", "lltv", "--planes", "radiance")
    assert sidecar["settings"]["sensor"]["mode"] == "reflective"
    assert [entry["name"] for entry in sidecar["planes"]] == ["display", "radiance"]


def test_time_with_an_offset_is_the_same_moment(monkeypatch: pytest.MonkeyPatch, town: Path, tmp_path: Path) -> None:
    _render(monkeypatch, town, tmp_path / "a.png")
    words = ("render", town, "--at", "1976-02-07T15:00+00:00", "--out", tmp_path / "b.png", "--size", "48x36")
    _run(monkeypatch, *words, "--preset", "report")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_level_of_detail_chosen_by_the_picture_is_a_choice_of_the_command(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    _run(monkeypatch, "scene", "hospital", "--level", "auto", "--json")
    levels = json.loads(capsys.readouterr().out)["levels"]
    assert [(row["level"], row["features"], row["ground"], row["overlap"]) for row in levels] == [
        ("IA", 12, 2, 0), ("IIA", 21, 7, 11), ("IIIB", 87, 13, 64)
    ]  # fmt: skip
    _run(monkeypatch, "scene", "hospital", "--level", "auto")
    assert "not at the finer level: IA 10" in " ".join(capsys.readouterr().out.split())
    shown = {}
    for level in ("IIIB", "auto", "auto:400"):
        out = tmp_path / f"{level.replace(':', '_')}.png"
        words = ("--at", AT, "--size", "48x36", "--preset", "report", "--level", level, "--planes", "range")
        _run(monkeypatch, "render", "hospital", "--out", out, *words)
        told = json.loads(out.with_suffix(".json").read_text())["settings"]
        shown[level] = imageio.imread(out)
        assert told["scene"]["level"] == level.split(":")[0]
        assert told["detail_pixels"] == {"IIIB": None, "auto": 1.0, "auto:400": 400.0}[level]
    np.testing.assert_array_equal(shown["auto"], shown["IIIB"])  # near by all is of the finest level
    assert not np.array_equal(shown["auto:400"], shown["IIIB"])
    for level in ("auto:", "auto:many", "auto:0", "automatic"):
        with pytest.raises(InputError, match="level"):
            app(["render", "hospital", "--at", AT, "--out", "a.png", "--level", level], standalone_mode=False)


def test_module_runs_as_a_program() -> None:
    """From a shell, with its exit code: the one test that starts another Python."""
    command = [sys.executable, "-m", "sensorsim", "render", "nowhere", "--at", AT, "--out", "x.png"]
    result = subprocess.run(command, capture_output=True, text=True, check=False, timeout=120)
    assert result.returncode == 2
    assert result.stdout == ""
    assert result.stderr.startswith("sensorsim: nowhere: scene = 'nowhere': no such scene or file; use one of hospital")
    assert result.stderr.count("\n") == 1


COMMANDS = sorted(str(command.callback.__name__) for command in app.registered_commands if command.callback)


@pytest.mark.parametrize("command", COMMANDS)
def test_help_keeps_what_stands_in_brackets(
    command: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Every bracket of a command's own help texts is on its page: markup would take units for styles."""
    monkeypatch.setenv("COLUMNS", "400")
    entry = next(one for one in app.registered_commands if one.callback and one.callback.__name__ == command)
    hints = get_type_hints(entry.callback, include_extras=True).values()
    texts = [str(option.help or "") for hint in hints for option in getattr(hint, "__metadata__", ())]
    wanted = [mark for text in texts for mark in re.findall(r"\[[^\]]*\]", text)]
    _run(monkeypatch, command, "--help")
    page = capsys.readouterr().out
    assert all(page.count(mark) >= wanted.count(mark) for mark in wanted)
    if command == "render":
        assert {"[deg]", "[K]"} <= set(wanted)


@pytest.mark.parametrize(
    ("at", "day", "hour"),
    [
        ("1976-02-07T23:30", "1976-02-07", 23.5),
        ("1976-02-08T04:30+00:00", "1976-02-07", 23.5),
        ("1976-02-06T23:30-06:00", "1976-02-07", 0.5),
        ("1976-02-07T14:00+09:00", "1976-02-07", 0.0),
    ],
)
def test_a_moment_of_another_clock_falls_on_the_sites_day(
    at: str, day: str, hour: float, monkeypatch: pytest.MonkeyPatch, town: Path, tmp_path: Path
) -> None:
    out = tmp_path / "frame.png"
    words = ("--at", at, "--out", out, "--size", "16x12", "--preset", "report")
    _run(monkeypatch, "render", town, *words, "--weather", "winter")
    settings = json.loads(out.with_suffix(".json").read_text())["settings"]
    assert settings["day"] == day
    assert settings["time_of_day_s"] == 3600.0 * hour


def test_planes_known_ahead_are_those_of_the_frame(monkeypatch: pytest.MonkeyPatch, town: Path, tmp_path: Path) -> None:
    with pytest.raises(InputError) as refused:
        require_writable("x.png", plane_names(load_sensor("lltv")), planes=["apparent_temperature"])
    assert "radiance" in refused.value.remedy
    for sensor in ("flir", "lltv", "uncooled", "emccd"):
        names = [name for name in plane_names(load_sensor(sensor)) if name != "display"]
        sidecar = _render(
            monkeypatch, town, tmp_path / f"{sensor}.png", "--sensor", sensor, "--planes", ",".join(names)
        )
        assert sorted(plane["name"] for plane in sidecar["planes"]) == sorted(plane_names(load_sensor(sensor)))
