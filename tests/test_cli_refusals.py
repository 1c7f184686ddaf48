"""Bad input gets one line that names file, entry, value and remedy, exit code 2, and leaves no file."""

import json
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from small_world import box, feature, town_features, write_town

from sensorsim.cli import main
from sensorsim.resources import assets_folder

AT = "1976-02-07T10:00"


@pytest.fixture
def refuse(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> Callable[..., str]:
    """Runs a command that must be refused; the one line that it says."""

    def run(*words: object) -> str:
        before = sorted(path for path in tmp_path.rglob("*") if path.is_file())
        monkeypatch.setattr(sys, "argv", ["sensorsim", *map(str, words)])
        with pytest.raises(SystemExit) as left:
            main()
        told = capsys.readouterr()
        assert left.value.code == 2
        assert told.out == ""
        assert told.err.startswith("sensorsim: ")
        assert told.err.count("\n") == 1
        assert told.err.rstrip().count("; ") >= 1  # problem; remedy
        assert sorted(path for path in tmp_path.rglob("*") if path.is_file()) == before
        return told.err

    return run


Refuse = Callable[..., str]


@pytest.mark.parametrize(
    ("words", "entry", "remedy"),
    [
        (("--level", "IV"), "'IV'", "IA"),
        (("--sensor", "sonar"), "sensor = 'sonar'", "flir"),
        (("--camera", "steeple"), "camera = 'steeple'", "tower"),
        (("--camera", "1,2,3"), "--camera = '1,2,3'", "east,north,up,yaw,pitch"),
        (("--camera", "1,2,nan,0,0"), "nan", "finite"),
        (("--camera", "1,2,3,0,120"), "pitch = 120", "elevation"),
        (("--field-of-view", "0"), "horizontal_field_of_view = 0.0", "full angle"),
        (("--field-of-view", "nan"), "horizontal_field_of_view = nan", "full angle"),
        (("--size", "0x0"), "--size = '0x0'", "640x480"),
        (("--size", "640"), "--size = '640'", "640x480"),
        (("--size", "-4x4"), "--size = '-4x4'", "640x480"),
        (("--size", "4.5x4"), "--size = '4.5x4'", "640x480"),
        (("--size", "99999x2"), "--size = '99999x2'", "640x480"),
        (("--preset", "best"), "preset = 'best'", "standard"),
        (("--polarity", "purple"), "polarity = 'purple'", "white-hot"),
        (("--window", "290"), "--window = '290'", "260:300"),
        (("--window", "300:260"), "(300.0, 260.0)", "colder"),
        (("--window", "100:300"), "--window = '100:300'", "150"),
        (("--window", "nan:300"), "nan", "colder"),
        (("--weather", "monsoon"), "'monsoon'", "winter"),
        (("--backend", "vulkan"), "backend = 'vulkan'", "egl"),
        (("--at", "noon"), "--at = 'noon'", "1976-02-07T10:00"),
        (("--at", "1976-02-07T25:00"), "--at = '1976-02-07T25:00'", "1976-02-07T10:00"),
        (("--at", "1981-05-01T10:00"), "'1981-05-01'", "winter"),
        (("--at", "1976-06-01T10:00", "--weather", "winter"), "image day = '1976-06-01'", "covers"),
        (("--at", "1976-02-01T10:00", "--weather", "winter"), "image day = '1976-02-01'", "extend the file"),
    ],
)
def test_option_that_cannot_be_honoured_is_refused(
    refuse: Refuse, tmp_path: Path, words: tuple[str, ...], entry: str, remedy: str
) -> None:
    at = () if "--at" in words else ("--at", AT)
    told = refuse("render", "hospital", "--level", "IA", *at, "--out", tmp_path / "x.png", "--preset", "report", *words)
    assert entry in told
    assert remedy in told


@pytest.mark.parametrize(
    ("words", "entry", "remedy"),
    [
        (("--planes", "warmth"), "plane = 'warmth'", "apparent_temperature"),
        (("--planes", "radiance", "--plane-format", "jpg"), "plane format = 'jpg'", "exr"),
        (("--planes", "radiance", "--plane-format", "tiff"), "plane 'radiance'", "exr or npy"),
        (("--planes", "apparent_temperature", "--sensor", "lltv"), "plane = 'apparent_temperature'", "radiance"),
        (("--window", "260:300", "--sensor", "lltv"), "--window = '260:300'", "leave it out"),
    ],
)
def test_planes_and_formats_that_cannot_be_written_are_refused(
    refuse: Refuse, tmp_path: Path, words: tuple[str, ...], entry: str, remedy: str
) -> None:
    town = write_town(tmp_path, town_features())
    rest = ("--at", AT, "--size", "16x12", "--preset", "report", *words)
    told = refuse("render", town, "--out", tmp_path / "x.png", *rest)
    assert entry in told
    assert remedy in told


@pytest.mark.parametrize("name", ["x.jpg", "x", "x.npy", "x.exr"])
def test_file_that_says_no_format_for_what_is_asked_is_refused(refuse: Refuse, tmp_path: Path, name: str) -> None:
    """An .npy or .exr without a plane to hold is none either."""
    town = write_town(tmp_path, town_features())
    told = refuse("render", town, "--at", AT, "--size", "16x12", "--preset", "report", "--out", tmp_path / name)
    assert name in told
    assert "use .png" in told


def test_folder_that_cannot_be_made_is_told(refuse: Refuse, tmp_path: Path) -> None:
    town = write_town(tmp_path, town_features())
    words = ("--at", AT, "--size", "16x12", "--preset", "report")
    told = refuse("render", town, "--out", town / "deep" / "x.png", *words)
    assert "--out = " in told
    assert "cannot be made" in told
    assert "--out = " in refuse("gallery", "--out", town / "sheets", "--preset", "report")


def _ring(*corners: tuple[float, float]) -> list[list[float]]:
    east, north = box(0.0, 0.0, 1.0, 1.0)[0]
    return [[east + x * 1e-4, north + y * 1e-4] for x, y in (*corners, corners[0])]


BAD_FEATURES = {
    "unknown material": (feature(box(0, 0, 9, 9), 5.0, number="12", wall_word="7740"), "material code = 77", "codes"),
    "no word": (feature(box(0, 0, 9, 9), 5.0, number="12", wall_word="brick"), "wall_word = 'brick'", "four digits"),
    "crossing": (feature(_ring((0, 0), (1, 1), (1, 0), (0, 1)), 5.0, number="12"), "crosses", "simple outline"),
    "no height": (
        {"type": "Feature", "properties": {"number": "12"}, "geometry": feature(box(0, 0, 9, 9), 1.0)["geometry"]},
        "height = None: missing",
        "height_ft",
    ),
    "NaN height": (feature(box(0, 0, 9, 9), float("nan"), number="12"), "height = nan", "plain number"),
    "infinite height": (feature(box(0, 0, 9, 9), float("inf"), number="12"), "height = inf", "plain number"),
    "NaN corner": (feature([[float("nan"), 39.8], *box(0, 0, 9, 9)[1:]], 5.0, number="12"), "coordinates", "degrees"),
    "odd interior": (feature(box(0, 0, 9, 9), 5.0, number="12", interior="cosy"), "interior = 'cosy'", "heated"),
}


@pytest.mark.parametrize("case", BAD_FEATURES)
@pytest.mark.parametrize("command", ["render", "scene"])
def test_bad_feature_is_refused_with_file_feature_entry_and_remedy(
    refuse: Refuse, tmp_path: Path, command: str, case: str
) -> None:
    bad, entry, remedy = BAD_FEATURES[case]
    path = write_town(tmp_path, [*town_features(), bad], "village.geojson")
    words = ("--at", AT, "--out", tmp_path / "x.png", "--preset", "report") if command == "render" else ()
    told = refuse(command, path, *words)
    assert "village.geojson" in told
    assert "feature 12" in told
    assert entry in told
    assert remedy in told


@pytest.mark.parametrize("command", ["render", "scene"])
@pytest.mark.parametrize(
    ("text", "entry"),
    [("{", "line 1"), ("[]", "type"), ('{"type": "FeatureCollection", "features": []}', "features"), ("\xff", "byte")],
)
def test_file_that_is_no_scene_is_refused(refuse: Refuse, tmp_path: Path, command: str, text: str, entry: str) -> None:
    path = tmp_path / "village.geojson"
    path.write_bytes(text.encode("latin-1"))
    words = ("--at", AT, "--out", tmp_path / "x.png") if command == "render" else ()
    told = refuse(command, path, *words)
    assert "village.geojson" in told
    assert entry in told


def _spoiled(text: str, case: str) -> str:
    """The winter's weather file with one thing wrong."""
    lines = text.splitlines()
    head = next(row for row, line in enumerate(lines) if line.startswith("time,"))
    if case == "missing column":
        return text.replace("relative_humidity_percent", "humidity", 1)
    if case == "NaN":
        cells = lines[head + 5].split(",")
        lines[head + 5] = ",".join([cells[0], "nan", *cells[2:]])
    elif case == "no offset":
        lines[head + 5] = lines[head + 5].replace("-05:00", "", 1)
    elif case == "gap":
        del lines[head + 5]
    elif case == "unknown ground":
        lines[head + 5] = lines[head + 5].rsplit(",", 1)[0] + ",muddy"
    return "\n".join(lines) + "\n"


@pytest.mark.parametrize(
    ("case", "entry"),
    [
        ("missing column", "relative_humidity_percent"),
        ("NaN", "air_temperature_C = 'nan'"),
        ("no offset", "time = "),
        ("gap", "time = "),
        ("unknown ground", "ground_state = 'muddy'"),
    ],
)
def test_bad_weather_file_is_refused_with_line_and_remedy(
    refuse: Refuse, tmp_path: Path, case: str, entry: str
) -> None:
    shipped = next((assets_folder() / "weather").glob("winter_*.csv"))
    path = tmp_path / "cold.csv"
    path.write_text(_spoiled(shipped.read_text(encoding="utf-8"), case), encoding="utf-8")
    told = refuse("render", "hospital", "--level", "IA", "--at", AT, "--weather", path, "--out", tmp_path / "x.png")
    assert "cold.csv" in told
    assert entry in told


def test_error_that_holds_brackets_is_printed_as_it_is(refuse: Refuse, tmp_path: Path) -> None:
    """Not read as styles by the console."""
    told = refuse("render", "[red]town[/red]", "--at", AT, "--out", tmp_path / "x.png")
    assert "'[red]town[/red]'" in told


def test_long_value_is_cut_so_that_the_line_stays_one(refuse: Refuse, tmp_path: Path) -> None:
    value = json.dumps(list(range(500)))
    told = refuse("render", "hospital", "--at", value, "--out", tmp_path / "x.png")
    assert "..." in told
    assert len(told) < 400


@pytest.mark.parametrize(
    ("words", "entry", "remedy"),
    [
        (("--presets", "best"), "preset = 'best'", "standard"),
        (("--factors", "degree,luck"), "factor = 'luck'", "orientations"),
        (("--max-error", "0.2"), "--max-error = '0.2'", "K"),
        (("--max-error", "0.2s"), "--max-error = '0.2s'", "K"),
        (("--max-error", "-1K"), "--max-error = '-1K'", "2K"),
        (("--max-bake", "5K"), "--max-bake = '5K'", "min"),
        (("--max-bake", "0s"), "--max-bake = '0s'", "2s"),
        (("--days", "yesterday"), "--days = 'yesterday'", "1976-02-07"),
        (("--days", ""), "--days = ''", "1976-02-07"),
        (("--days", "1981-05-01"), "'1981-05-01'", "winter"),
        (("--level", "IV"), "'IV'", "IA"),
        (("--weather", "monsoon"), "'monsoon'", "winter"),
    ],
)
def test_study_of_accuracy_refuses_what_it_cannot_measure(
    refuse: Refuse, tmp_path: Path, words: tuple[str, ...], entry: str, remedy: str
) -> None:
    told = refuse("study", "accuracy", "hospital", "--out", tmp_path / "made", *words)
    assert entry in told
    assert remedy in told
    assert not (tmp_path / "made").exists()


@pytest.mark.parametrize(
    "words",
    [("--planes", "warmth"), ("--planes", "radiance", "--plane-format", "png"), ("--out", "x.jpg")],
    ids=["plane", "format", "suffix"],
)
def test_what_cannot_be_written_is_refused_before_the_scene_is_read(
    refuse: Refuse, tmp_path: Path, words: tuple[str, ...]
) -> None:
    """Rationale: a scene that is not there would be the error of a command that had begun to work."""
    out = () if "--out" in words else ("--out", tmp_path / "x.png")
    assert "nowhere" not in refuse("render", "nowhere", "--at", AT, *out, *words)
