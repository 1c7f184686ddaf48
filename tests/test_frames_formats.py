"""Every file format returns what was written, to the precision it states, and carries unit and scale."""

import json

import numpy as np
import OpenEXR
import pytest
import tifffile
from PIL import Image

from sensorsim.errors import InputError
from sensorsim.frames import build_frame, read_plane, read_sidecar, write_frame

RANDOM = np.random.default_rng(3)
SHAPE = (12, 17)
ARRAYS = {
    "display": RANDOM.integers(0, 256, SHAPE),
    "radiance": RANDOM.uniform(10.0, 60.0, SHAPE).astype(np.float32),
    "apparent_temperature": RANDOM.uniform(200.0, 340.0, SHAPE),
    "surface_id": RANDOM.integers(-1, 700, SHAPE),
    "range": RANDOM.uniform(0.0, 4000.0, SHAPE).astype(np.float32),
}
FLOATS = ["radiance", "apparent_temperature", "surface_id", "range"]


@pytest.fixture
def frame():
    return build_frame(ARRAYS, {"scene": "hospital", "level": "IIIB", "weather": {"file": "winter", "hour": 10.0}})


def test_display_comes_back_code_for_code(frame, tmp_path):
    write_frame(frame, tmp_path / "frame.png")
    assert np.array_equal(read_plane(tmp_path / "frame.png", "display").data, ARRAYS["display"])
    image = Image.open(tmp_path / "frame.png")
    assert image.mode == "L"
    assert np.array_equal(np.asarray(image), ARRAYS["display"])


@pytest.mark.parametrize("name", FLOATS)
def test_npy_comes_back_bit_for_bit(frame, tmp_path, name):
    files = write_frame(frame, tmp_path / "frame.png", planes=FLOATS, plane_format="npy")
    back = read_plane(tmp_path / "frame.json", name)
    expected = frame.plane(name)
    assert back.data.dtype == expected.data.dtype
    assert np.array_equal(back.data, expected.data)
    assert (back.unit, back.description, back.no_surface) == (
        expected.unit,
        expected.description,
        expected.no_surface,
    )
    unit = "" if expected.unit == "1" else "_" + expected.unit.replace(" ", "_")
    assert tmp_path / f"frame.{name}{unit}.npy" in files


@pytest.mark.parametrize("name", FLOATS)
def test_exr_comes_back_in_single_precision(frame, tmp_path, name):
    write_frame(frame, tmp_path / "frame.png", planes=FLOATS)
    back = read_plane(tmp_path / "frame.png", name)
    assert np.array_equal(back.data.astype(np.float64), ARRAYS[name].astype(np.float32).astype(np.float64))
    assert back.data.dtype == (np.int32 if name == "surface_id" else np.float32)


def test_exr_names_its_channels_and_their_units(frame, tmp_path):
    write_frame(frame, tmp_path / "frame.exr", planes=FLOATS)
    with OpenEXR.File(str(tmp_path / "frame.exr"), separate_channels=True) as file:
        assert sorted(file.channels()) == sorted(FLOATS)
        assert {channel.pixels.dtype for channel in file.channels().values()} == {np.dtype(np.float32)}
        header = dict(file.header())
    assert max(map(len, header)) <= 31  # longer attribute names are unreadable to older readers
    assert header["radiance_unit"] == "W m-2 sr-1"
    assert header["apparent_temperature_unit"] == "K"
    assert header["range_scale"] == 1.0


@pytest.mark.parametrize("plane_format", ["png", "tiff"])
def test_centikelvin_comes_back_to_half_a_count(frame, tmp_path, plane_format):
    write_frame(frame, tmp_path / "frame.png", planes=["apparent_temperature"], plane_format=plane_format)
    back = read_plane(tmp_path / "frame.png", "apparent_temperature")
    assert back.unit == "K"
    assert np.abs(back.data - ARRAYS["apparent_temperature"]).max() <= 0.005 + 1e-9


def test_centikelvin_files_tell_unit_and_scale(frame, tmp_path):
    planes = ["apparent_temperature"]
    expected = np.rint(100.0 * ARRAYS["apparent_temperature"])
    write_frame(frame, tmp_path / "a.png", planes=planes, plane_format="png")
    with Image.open(tmp_path / "a.apparent_temperature_centikelvin.png") as image:
        assert image.mode.startswith("I;16")
        assert np.array_equal(np.asarray(image), expected)
        assert (image.info["unit"], float(image.info["scale"])) == ("K", 0.01)
    write_frame(frame, tmp_path / "b.tiff", planes=planes)
    with tifffile.TiffFile(tmp_path / "b.tiff") as file:
        labels = json.loads(file.pages[0].tags["ImageDescription"].value)
        stored = file.asarray()
    assert stored.dtype == np.uint16
    assert np.array_equal(stored, expected)
    assert (labels["unit"], labels["scale"]) == ("K", 0.01)


def test_one_plane_may_be_the_named_file(frame, tmp_path):
    assert write_frame(frame, tmp_path / "t.npy", planes=["range"]) == [tmp_path / "t.npy", tmp_path / "t.json"]
    assert np.array_equal(np.load(tmp_path / "t.npy"), ARRAYS["range"])


def test_limits_of_the_centikelvin_formats(tmp_path):
    ends = np.array([[0.0, 655.35]])
    write_frame(build_frame({"apparent_temperature": ends}, {}), tmp_path / "t.tif", planes=["apparent_temperature"])
    assert read_plane(tmp_path / "t.tif", "apparent_temperature").data == pytest.approx(ends, abs=1e-9)


@pytest.mark.parametrize("kelvin", [-0.001, 655.351, 1e6])
def test_temperature_beyond_centikelvin_is_refused(tmp_path, kelvin):
    frame = build_frame({"apparent_temperature": np.array([[280.0, kelvin]])}, {})
    with pytest.raises(InputError, match=r"outside 0 to 655.35 K in 1 pixels; write it as exr or npy"):
        write_frame(frame, tmp_path / "t.tiff", planes=["apparent_temperature"])
    assert list(tmp_path.iterdir()) == []


def test_only_temperatures_become_centikelvin(frame, tmp_path):
    with pytest.raises(InputError, match="no temperature in K"):
        write_frame(frame, tmp_path / "f.png", planes=["apparent_temperature", "radiance"], plane_format="tiff")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(("name", "data"), [("surface_id", [[2**24 + 1]]), ("radiance", [[1e39]])])
def test_what_single_precision_cannot_hold_is_refused(tmp_path, name, data):
    with pytest.raises(InputError, match="beyond float32; write it as npy"):
        write_frame(build_frame({name: np.array(data)}, {}), tmp_path / "f.exr", planes=[name])
    assert list(tmp_path.iterdir()) == []


def test_sidecar_describes_every_plane(frame, tmp_path):
    write_frame(frame, tmp_path / "frame.png", planes=FLOATS)
    sidecar = read_sidecar(tmp_path / "frame.png")
    assert sidecar["settings"] == frame.settings
    entries = {entry["name"]: entry for entry in sidecar["planes"]}
    assert sorted(entries) == sorted(["display", *FLOATS])
    entry = entries["radiance"]
    assert (entry["unit"], entry["scale"], entry["file"]) == ("W m-2 sr-1", 1.0, "frame.exr")
    assert entry["shape"] == list(SHAPE)
    assert (entry["min"], entry["max"]) == (ARRAYS["radiance"].min(), ARRAYS["radiance"].max())
    ids = ARRAYS["surface_id"]
    assert entries["surface_id"]["no_surface"] == -1.0
    assert entries["surface_id"]["min"] == ids[ids != -1].min()
