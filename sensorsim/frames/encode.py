"""Files of planes: 8-bit PNG, OpenEXR, NPY, and centikelvin or raw counts in 16-bit PNG and TIFF.

Every file but NPY, which has no place for it, carries each plane's name, unit, scale and description: value = stored
times scale, in that unit. NPY files carry the unit in their name. No file holds a time of writing, so equal frames give
equal bytes.
"""

import io
import json
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt
import OpenEXR
import tifffile
from PIL import Image, PngImagePlugin

from sensorsim.errors import InputError
from sensorsim.frames.frame import Plane

CENTIKELVIN = 0.01  # [K] per count of the 16-bit formats
WARMEST_CENTIKELVIN = 655.35  # [K]; 65535 counts
LARGEST_EXACT_INTEGER = 2**24  # of float32, in which EXR stores ids


def display_bytes(plane: Plane, inputs: str) -> bytes:
    """8-bit grey PNG of a display plane; inputs is the SHA-256 of the frame's settings."""
    if plane.data.dtype != np.uint8:
        raise InputError("frame", f"plane {plane.name!r}", str(plane.data.dtype), "no display codes", "give uint8")
    return _png_bytes(plane.data, _labels(plane, 1.0, inputs))


def npy_bytes(plane: Plane) -> bytes:
    """NPY of the plane's own type."""
    stream = io.BytesIO()
    np.save(stream, plane.data, allow_pickle=False)
    return stream.getvalue()


def png16_bytes(plane: Plane, inputs: str) -> bytes:
    """16-bit grey PNG of temperatures in centikelvin or of raw counts; errors of `sixteen_bits`."""
    return _png_bytes(sixteen_bits(plane), _labels(plane, scale16(plane), inputs))


def tiff16_bytes(plane: Plane, inputs: str) -> bytes:
    """16-bit grey TIFF of temperatures in centikelvin or of raw counts, its labels as JSON in ImageDescription."""
    stream = io.BytesIO()
    description = json.dumps(_labels(plane, scale16(plane), inputs), sort_keys=True)
    counts = sixteen_bits(plane)
    # metadata=None: else tifffile adds a description of its own after ours.
    tifffile.imwrite(
        stream, counts, photometric="minisblack", description=description, metadata=None, software="sensorsim"
    )
    return stream.getvalue()


def scale16(plane: Plane) -> float:
    """What one step of a 16-bit file is worth, in the plane's unit."""
    return 1.0 if plane.unit == "count" else CENTIKELVIN


def sixteen_bits(plane: Plane) -> npt.NDArray[np.uint16]:
    """Raw counts, or temperatures in steps of 0.01 K; InputError for another unit and outside 0 to 655.35 K."""
    where, entry = "16-bit file", f"plane {plane.name!r}"
    if plane.unit == "count" and plane.data.dtype == np.uint16:
        return plane.data.astype(np.uint16)
    if plane.unit != "K":
        raise InputError(where, entry, plane.unit, "no temperature in K and no counts", "write it as exr or npy")
    kelvin = plane.data.astype(np.float64)
    bad = kelvin[(kelvin < 0.0) | (kelvin > WARMEST_CENTIKELVIN)]
    if bad.size:
        limits = f"outside 0 to {WARMEST_CENTIKELVIN} K in {bad.size} pixels"
        raise InputError(where, entry, float(bad[0]), limits, "write it as exr or npy")
    return np.rint(kelvin / CENTIKELVIN).astype(np.uint16)


def write_exr(planes: Sequence[Plane], path: Path, inputs: str) -> None:
    """OpenEXR of float32 channels named after the planes; header attributes `<plane>_unit`, `_scale`, `_note`.

    Raises InputError for integers that float32 cannot hold and values beyond its range.
    """
    header: dict[str, object] = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    header["inputs_sha256"] = inputs
    channels = {}
    for plane in planes:
        header[f"{plane.name}_unit"] = plane.unit
        header[f"{plane.name}_scale"] = 1.0
        header[f"{plane.name}_note"] = plane.description
        if plane.bits is not None:
            header[f"{plane.name}_bits"] = plane.bits
        channels[plane.name] = _single_precision(plane)
    with OpenEXR.File(header, channels) as file:
        try:
            file.write(str(path))
        except RuntimeError as error:  # the library's word for a file that it cannot open or fill
            raise InputError(path.parent, "file", path.name, str(error), "check the folder and free space") from error


def _single_precision(plane: Plane) -> npt.NDArray[np.float32]:
    largest = float(np.abs(plane.data.astype(np.float64)).max())
    limit = float(np.finfo(np.float32).max) if plane.data.dtype.kind == "f" else float(LARGEST_EXACT_INTEGER)
    if largest > limit:
        raise InputError("exr file", f"plane {plane.name!r}", largest, "beyond float32", "write it as npy")
    return np.ascontiguousarray(plane.data, dtype=np.float32)


def _labels(plane: Plane, scale: float, inputs: str) -> dict[str, str | float]:
    labels = {"plane": plane.name, "unit": plane.unit, "description": plane.description, "inputs_sha256": inputs}
    return {**labels, "scale": scale, **({} if plane.bits is None else {"bits": plane.bits})}


def _png_bytes(image: npt.NDArray[np.generic], labels: Mapping[str, str | float]) -> bytes:
    text = PngImagePlugin.PngInfo()
    for key, value in labels.items():
        text.add_text(key, str(value))
    stream = io.BytesIO()
    Image.fromarray(image).save(stream, format="PNG", pnginfo=text)
    return stream.getvalue()
