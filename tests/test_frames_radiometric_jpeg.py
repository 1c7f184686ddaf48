"""Radiometric JPEG files made here byte by byte, and the temperatures read from them."""

import io
import struct
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from sensorsim.errors import InputError
from sensorsim.frames.radiometric_jpeg import read_radiometric_jpeg

R1, B, F, O, R2 = 21106.77, 1501.0, 1.0, -7340, 0.012545258  # noqa: E741


def jpeg(path: Path, raw: np.ndarray, *, as_png: bool = False, cut: int = 0) -> Path:
    """A JPEG with the records of a camera in two APP1 segments."""
    body = raw.astype("<u2").tobytes()
    if as_png:
        buffer = io.BytesIO()
        Image.fromarray(raw.astype("<u2").byteswap()).save(buffer, format="PNG")
        body = buffer.getvalue()
    picture = struct.pack("<3H", 2, raw.shape[1], raw.shape[0]) + bytes(26) + body
    camera = bytearray(0x320)
    struct.pack_into("<H", camera, 0, 2)
    struct.pack_into("<3f", camera, 0x58, R1, B, F)
    struct.pack_into("<if", camera, 0x308, O, R2)
    start = 64 + 64
    entries = b""
    for kind, content, offset in ((1, picture, start), (32, bytes(camera), start + len(picture))):
        entry = bytearray(32)
        struct.pack_into(">H", entry, 0, kind)
        struct.pack_into(">2I", entry, 12, offset, len(content))
        entries += bytes(entry)
    head = bytearray(64)
    head[:3] = b"FFF"
    struct.pack_into(">I", head, 0x14, 101)
    struct.pack_into(">2I", head, 0x18, 64, 2)
    data = bytes(head) + entries + picture + bytes(camera)
    data = data[: len(data) - cut]
    half = len(data) // 2
    segments = b""
    for index, part in enumerate((data[:half], data[half:])):
        payload = b"FLIR\0\1" + bytes([index, 1]) + part
        segments += b"\xff\xe1" + struct.pack(">H", len(payload) + 2) + payload
    buffer = io.BytesIO()
    Image.new("L", (8, 8)).save(buffer, format="JPEG")
    path.write_bytes(b"\xff\xd8" + segments + buffer.getvalue()[2:])
    return path


def raw_of(kelvin: np.ndarray) -> np.ndarray:
    """Counts of temperatures, the formula turned round."""
    return np.round(R1 / (R2 * (np.exp(B / kelvin) - F)) - O)


@pytest.mark.parametrize("as_png", [False, True])
def test_temperatures_are_those_that_were_put_in(tmp_path: Path, as_png: bool) -> None:
    kelvin = np.linspace(255.0, 340.0, 12).reshape(3, 4)
    plane = read_radiometric_jpeg(jpeg(tmp_path / "a.jpg", raw_of(kelvin), as_png=as_png))
    assert plane.unit == "K"
    assert plane.data == pytest.approx(kelvin, abs=0.05)  # a count is about 0.03 K


def test_plain_and_damaged_files_are_refused(tmp_path: Path) -> None:
    Image.new("L", (8, 8)).save(tmp_path / "plain.jpg")
    with pytest.raises(InputError, match="no radiometric JPEG"):
        read_radiometric_jpeg(tmp_path / "plain.jpg")
    with pytest.raises(InputError, match=r"damaged|no radiometric"):
        read_radiometric_jpeg(jpeg(tmp_path / "cut.jpg", np.full((3, 4), 14000), cut=0x315))
    with pytest.raises(InputError, match="No such file"):
        read_radiometric_jpeg(tmp_path / "missing.jpg")
