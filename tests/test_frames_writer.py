"""Files appear whole or not at all, the same for the same input, and say what they were made from."""

import hashlib
import json
from pathlib import Path

import numpy as np
import pytest

from sensorsim.errors import InputError, NumericsError
from sensorsim.frames import PLANE_FORMATS, build_frame, encode, inputs_sha256, read_plane, read_sidecar, write_frame

ARRAYS = {
    "display": np.arange(12, dtype=np.uint8).reshape(3, 4),
    "radiance": np.linspace(30.0, 50.0, 12).reshape(3, 4),
    "apparent_temperature": np.linspace(260.0, 300.0, 12).reshape(3, 4),
}
SETTINGS = {"scene": "hospital", "size": [4, 3], "hour": 10.0, "place": "Fairborn, Ohio \N{EN DASH} strip"}


def frame(settings=SETTINGS, **arrays):
    return build_frame({**ARRAYS, **arrays}, settings)


def names(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize("plane_format", PLANE_FORMATS)
def test_equal_frames_give_equal_bytes(tmp_path, plane_format):
    contents = []
    for run in ("first", "second"):
        folder = tmp_path / run
        folder.mkdir()
        write_frame(frame(), folder / "f.png", planes=["apparent_temperature"], plane_format=plane_format)
        contents.append({path.name: path.read_bytes() for path in folder.iterdir()})
    assert contents[0] == contents[1]
    assert len(contents[0]) == 3


def test_files_are_returned_in_the_order_of_the_promise(tmp_path):
    files = write_frame(frame(), str(tmp_path / "f.png"), planes=["radiance", "apparent_temperature", "radiance"])
    assert files == [tmp_path / "f.png", tmp_path / "f.exr", tmp_path / "f.json"]
    assert names(tmp_path) == ["f.exr", "f.json", "f.png"]


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_pixel_that_is_not_finite_stops_the_whole_frame(tmp_path, bad):
    """Also in a plane that was not asked for: the frame as a whole cannot be trusted."""
    spoilt = ARRAYS["radiance"].copy()
    spoilt[1, 2] = bad
    with pytest.raises(NumericsError, match="plane 'radiance': 1 of 12 pixels are NaN or infinite"):
        write_frame(frame(radiance=spoilt), tmp_path / "f.png", planes=["apparent_temperature"])
    assert names(tmp_path) == []


def test_encoder_that_fails_halfway_leaves_nothing(tmp_path, monkeypatch):
    def half_a_file(_planes, path, _inputs):
        path.write_bytes(b"half")
        raise OSError(28, "No space left on device", str(path))

    monkeypatch.setattr(encode, "write_exr", half_a_file)
    with pytest.raises(InputError, match="No space left on device"):
        write_frame(frame(), tmp_path / "f.png", planes=["radiance"])
    assert names(tmp_path) == []


def test_failure_while_files_take_their_places_leaves_nothing(tmp_path, monkeypatch):
    placed = []
    replace = Path.replace

    def fail_on_the_second(self, target):
        if placed:
            raise KeyboardInterrupt
        placed.append(target)
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", fail_on_the_second)
    with pytest.raises(KeyboardInterrupt):
        write_frame(frame(), tmp_path / "f.png", planes=["radiance"])
    assert len(placed) == 1
    assert names(tmp_path) == []


def test_failing_encoder_leaves_an_earlier_frame_as_it_was(tmp_path, monkeypatch):
    write_frame(frame(), tmp_path / "f.png", planes=["radiance"])
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}

    def refuse(_planes, path, _inputs):
        raise OSError(5, "Input/output error", str(path))

    monkeypatch.setattr(encode, "write_exr", refuse)
    with pytest.raises(InputError):
        write_frame(frame({"hour": 13.0}), tmp_path / "f.png", planes=["radiance"])
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_a_later_frame_takes_the_place_of_an_earlier_one(tmp_path):
    write_frame(frame(), tmp_path / "f.png", planes=["radiance"])
    write_frame(frame({"hour": 13.0}), tmp_path / "f.png", planes=["radiance"])
    assert read_sidecar(tmp_path / "f.png")["settings"] == {"hour": 13.0}
    assert names(tmp_path) == ["f.exr", "f.json", "f.png"]


def test_sidecar_holds_the_hashes_of_inputs_and_files(tmp_path):
    write_frame(frame(), tmp_path / "f.png", planes=["radiance"])
    sidecar = json.loads((tmp_path / "f.json").read_text())
    canonical = json.dumps(SETTINGS, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
    assert sidecar["inputs_sha256"] == hashlib.sha256(canonical.encode()).hexdigest()
    for entry in sidecar["planes"]:
        assert entry["sha256"] == hashlib.sha256((tmp_path / entry["file"]).read_bytes()).hexdigest()


def test_hash_knows_the_values_but_not_their_order():
    assert inputs_sha256({"a": 1, "b": [1, 2]}) == inputs_sha256({"b": [1, 2], "a": 1})
    assert inputs_sha256({"a": 1}) != inputs_sha256({"a": 2})


@pytest.mark.parametrize("value", [np.nan, Path("x"), np.ones(2)])
def test_settings_that_are_no_json_are_refused(tmp_path, value):
    with pytest.raises(InputError, match="plain finite JSON"):
        write_frame(frame({"value": value}), tmp_path / "f.png")
    assert names(tmp_path) == []


@pytest.mark.parametrize(
    ("name", "options", "said"),
    [
        ("f.jpg", {}, r"cannot be written to a file \.jpg; use \.png"),
        ("f", {}, "file without suffix"),
        ("f.exr", {}, r"planes = \[\]: cannot be written"),
        ("f.npy", {"planes": ["radiance", "apparent_temperature"]}, "for one plane"),
        ("f.png", {"planes": ["temperature"]}, "not in this frame; use display, radiance, apparent_temperature"),
        ("f.png", {"planes": ["radiance"], "plane_format": "jpg"}, "use exr, npy, png, tiff"),
        ("missing/f.png", {}, "not there; create it first"),
    ],
)
def test_request_that_cannot_be_honoured_is_refused(tmp_path, name, options, said):
    with pytest.raises(InputError, match=said) as caught:
        write_frame(frame(), tmp_path / name, **options)
    assert "\n" not in str(caught.value)
    assert names(tmp_path) == []


def test_display_must_be_there_for_a_picture(tmp_path):
    with pytest.raises(InputError, match="plane = 'display': not in this frame"):
        write_frame(build_frame({"radiance": ARRAYS["radiance"]}, {}), tmp_path / "f.png")


def test_changed_or_missing_files_are_not_read(tmp_path):
    write_frame(frame(), tmp_path / "f.png", planes=["radiance"])
    with pytest.raises(InputError, match="use display, radiance"):
        read_plane(tmp_path / "f.png", "range")
    (tmp_path / "f.exr").write_bytes(b"something else")
    with pytest.raises(InputError, match="not the one that was written"):
        read_plane(tmp_path / "f.png", "radiance")
    (tmp_path / "f.exr").unlink()
    with pytest.raises(InputError, match="missing"):
        read_plane(tmp_path / "f.png", "radiance")


@pytest.mark.parametrize("content", [None, "{", "{}", "[]"])
def test_what_is_no_sidecar_is_refused(tmp_path, content):
    if content is not None:
        (tmp_path / "f.json").write_text(content)
    with pytest.raises(InputError, match=r"f\.json"):
        read_sidecar(tmp_path / "f.png")
