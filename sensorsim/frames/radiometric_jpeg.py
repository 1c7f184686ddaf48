"""Radiometric JPEG files of FLIR cameras: the raw picture and the numbers that make temperatures of it.

Segments APP1 that begin with "FLIR" hold, joined, a record directory: type 1 the raw picture (16 bits, plain or PNG),
type 32 the camera's numbers. Raw counts become the temperature of a black body by T = B / ln(R1 / (R2 (S + O)) + F) K,
which is the apparent temperature before any correction for emissivity or air. The layout is that which [ExifTool]
documents.
"""

import io
import struct
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from PIL import Image

from sensorsim.errors import InputError
from sensorsim.frames.frame import Plane

RAW, CAMERA = 1, 32  # types of records
_PLANCK = {"R1": 0x58, "B": 0x5C, "F": 0x60, "O": 0x308, "R2": 0x30C}


def is_radiometric_jpeg(path: Path) -> bool:
    """Whether a file is a JPEG by its name."""
    return path.suffix.lower() in (".jpg", ".jpeg")


def read_radiometric_jpeg(path: Path) -> Plane:
    """Apparent temperature (height, width) [K]; InputError for a file that is none, or holds none."""
    try:
        content = path.read_bytes()
    except OSError as error:
        raise InputError(path, "file", path.name, str(error.strerror), "name a file that can be read") from error
    data = b"".join(part for part in _flir_segments(content))
    records = _records(data)
    if RAW not in records or CAMERA not in records:
        raise InputError(path, "file", path.name, "no radiometric JPEG", "give one that the camera itself wrote")
    try:
        raw, camera = _raw_picture(records[RAW]), records[CAMERA]
        constants = {name: _number(camera, name, place) for name, place in _PLANCK.items()}
    except (struct.error, ValueError, OSError) as error:
        raise InputError(path, "file", path.name, f"damaged ({error})", "copy it from the camera again") from error
    signal = raw + constants["O"]
    if not (np.all(signal > 0.0) and constants["R1"] > 0.0 and constants["R2"] > 0.0):
        raise InputError(path, "planck constants", constants, "give no temperature", "copy it from the camera again")
    ratio = constants["R1"] / (constants["R2"] * signal) + constants["F"]
    kelvin = constants["B"] / np.log(ratio)
    return Plane(
        name="apparent_temperature",
        data=kelvin.astype(np.float64),
        unit="K",
        description="temperature of the blackbody with the same band radiance",
    )


def _flir_segments(content: bytes) -> Iterator[bytes]:
    """Payloads of the APP1 segments that belong to the camera."""
    place = 2
    while place + 4 <= len(content) and content[place] == 0xFF and content[place + 1] != 0xDA:
        (length,) = struct.unpack_from(">H", content, place + 2)
        body = content[place + 4 : place + 2 + length]
        if content[place + 1] == 0xE1 and body[:5] == b"FLIR\0":
            yield body[8:]
        place += 2 + max(length, 2)


def _records(data: bytes) -> dict[int, bytes]:
    """Records by type of a file that begins with "FFF"."""
    if data[:3] != b"FFF" or len(data) < 0x40:
        return {}
    order = ">" if struct.unpack_from(">I", data, 0x14)[0] < 1000 else "<"
    start, count = struct.unpack_from(order + "2I", data, 0x18)
    records = {}
    for index in range(min(count, 256)):
        place = start + 32 * index
        if place + 32 > len(data):
            break
        kind = struct.unpack_from(order + "H", data, place)[0]
        offset, length = struct.unpack_from(order + "2I", data, place + 12)
        records[kind] = data[offset : offset + length]
    return records


def _raw_picture(record: bytes) -> np.ndarray:
    order = "<" if struct.unpack_from("<H", record, 0)[0] == 2 else ">"
    width, height = struct.unpack_from(order + "2H", record, 2)
    body = record[32:]
    if body[:4] == b"\x89PNG":
        # PNG keeps the high byte first; cameras write the low one there.
        return np.asarray(Image.open(io.BytesIO(body))).astype("<u2").byteswap().astype(np.float64)
    return np.frombuffer(body, order + "u2", width * height).reshape(height, width).astype(np.float64)


def _number(camera: bytes, name: str, place: int) -> float:
    order = "<" if struct.unpack_from("<H", camera, 0)[0] == 2 else ">"
    return float(struct.unpack_from(order + ("i" if name == "O" else "f"), camera, place)[0])
