"""Raw counts in files: whole numbers that come back, with their depth, and are compared with their like."""

import json
from pathlib import Path

import numpy as np
import OpenEXR
import pytest
import tifffile
from PIL import Image

from sensorsim.errors import InputError
from sensorsim.frames import Frame, build_frame, read_plane, read_sidecar, require_writable, write_frame
from sensorsim.frames.capture import plane_names
from sensorsim.frames.difference import compare_frames
from sensorsim.sensor import load_sensor

COUNTS = np.random.default_rng(6).integers(0, 2**14, (12, 17)).astype(np.uint16)
COUNTS[0, :3] = (0, 2**14 - 1, 65535)
FORMATS = ("exr", "npy", "png", "tiff")


def frame(counts: np.ndarray = COUNTS, bits: int = 14) -> Frame:
    return build_frame({"display": np.zeros(counts.shape, np.uint8), "counts": counts}, {}, bits=bits)


@pytest.mark.parametrize("plane_format", FORMATS)
def test_counts_come_back_count_for_count_with_their_depth(tmp_path: Path, plane_format: str) -> None:
    write_frame(frame(), tmp_path / "a.png", planes=["counts"], plane_format=plane_format)
    plane = read_plane(tmp_path / "a.png", "counts")
    assert plane.data.dtype == np.uint16
    assert np.array_equal(plane.data, COUNTS)
    assert (plane.unit, plane.bits) == ("count", 14)
    (entry,) = (one for one in read_sidecar(tmp_path / "a.png")["planes"] if one["name"] == "counts")
    assert (entry["unit"], entry["bits"], entry["scale"]) == ("count", 14, 1.0)


def test_files_of_counts_tell_unit_and_depth_themselves(tmp_path: Path) -> None:
    for plane_format in FORMATS:
        write_frame(frame(), tmp_path / f"{plane_format}.png", planes=["counts"], plane_format=plane_format)
    with Image.open(tmp_path / "png.counts.png") as image:
        assert image.mode.startswith("I;16")
        assert (image.text["unit"], image.text["bits"], image.text["scale"]) == ("count", "14", "1.0")
    with tifffile.TiffFile(tmp_path / "tiff.counts.tiff") as file:
        told = json.loads(file.pages[0].description)
        assert file.pages[0].dtype == np.uint16
    assert (told["unit"], told["bits"]) == ("count", 14)
    with OpenEXR.File(str(tmp_path / "exr.exr")) as file:
        assert (file.header()["counts_unit"], file.header()["counts_bits"]) == ("count", 14)
    assert (tmp_path / "npy.counts.npy").is_file()


@pytest.mark.parametrize("plane_format", FORMATS)
def test_difference_of_counts_is_in_counts(tmp_path: Path, plane_format: str) -> None:
    more = np.minimum(COUNTS, 60000) + np.uint16(3)
    write_frame(frame(np.minimum(COUNTS, 60000)), tmp_path / "a.png", planes=["counts"], plane_format="npy")
    write_frame(frame(more), tmp_path / "b.png", planes=["counts"], plane_format=plane_format)
    found = compare_frames(tmp_path / "a.png", tmp_path / "b.png", "counts")
    assert (found.unit, found.mean, found.largest, found.rms) == ("count", 3.0, 3.0, 3.0)
    assert compare_frames(tmp_path / "b.png", tmp_path / "a.png", "counts").mean == -3.0


def test_counts_of_another_depth_are_not_compared(tmp_path: Path) -> None:
    for name, bits in (("a", 14), ("b", 16)):
        write_frame(frame(bits=bits), tmp_path / f"{name}.png", planes=["counts"])
    with pytest.raises(InputError, match=r"bits of counts.*14"):
        compare_frames(tmp_path / "a.png", tmp_path / "b.png", "counts")


@pytest.mark.parametrize("counts", [COUNTS.astype(np.int64) - 1, COUNTS.astype(np.int64) + 1, COUNTS / 2.0])
def test_what_is_no_count_of_sixteen_bits_is_refused(counts: np.ndarray) -> None:
    with pytest.raises(InputError, match="counts"):
        frame(counts)


def test_only_sensors_with_a_detector_have_counts() -> None:
    assert "counts" in plane_names(load_sensor("uncooled"))
    for name in ("flir", "lltv"):
        with pytest.raises(InputError, match="'counts'"):
            require_writable("x.png", plane_names(load_sensor(name)), planes=["counts"])
