"""Reads planes back from the files that `write_frame` made, by way of their sidecar."""

import hashlib
import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import OpenEXR
import tifffile
from PIL import Image

from sensorsim.errors import InputError
from sensorsim.frames.frame import Plane


def read_sidecar(path: Path | str) -> dict[str, Any]:
    """Content of the sidecar of a frame: 'settings', 'inputs_sha256' and 'planes'.

    path: the sidecar or any file of the same stem. Raises InputError where it is missing or no sidecar.
    """
    sidecar = Path(path).with_suffix(".json")
    try:
        content = json.loads(sidecar.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(
            sidecar, "file", sidecar.name, str(error.strerror), "give a file that has a sidecar"
        ) from error
    except ValueError as error:
        raise InputError(sidecar, "file", sidecar.name, f"no JSON ({error})", "write the frame again") from error
    if not (isinstance(content, dict) and {"settings", "inputs_sha256", "planes"} <= content.keys()):
        raise InputError(sidecar, "file", sidecar.name, "no sidecar of a frame", "give a file that write_frame made")
    return content


def read_plane(path: Path | str, name: str) -> Plane:
    """A plane of a written frame in its unit and, but for centikelvin files, its own type (EXR stores float32).

    path as for `read_sidecar`. Raises InputError where the frame has no such plane or its file is missing or changed.
    """
    sidecar = Path(path).with_suffix(".json")
    entries = {entry["name"]: entry for entry in read_sidecar(sidecar)["planes"]}
    if name not in entries:
        raise InputError(sidecar, "plane", name, "not written", f"use {', '.join(entries)}")
    entry = entries[name]
    file = sidecar.with_name(entry["file"])
    if not file.is_file():
        raise InputError(sidecar, "file", entry["file"], "missing", "write the frame again")
    if hashlib.sha256(file.read_bytes()).hexdigest() != entry["sha256"]:
        raise InputError(sidecar, "file", entry["file"], "not the one that was written", "write the frame again")
    return Plane(
        name=name,
        data=_decode(file, entry),
        unit=entry["unit"],
        description=entry["description"],
        no_surface=entry["no_surface"],
        bits=entry.get("bits"),
    )


def _decode(file: Path, entry: dict[str, Any]) -> npt.NDArray[np.generic]:
    kind = entry["format"]
    if kind == "exr":
        with OpenEXR.File(str(file), separate_channels=True) as exr:
            pixels = np.array(exr.channels()[entry["name"]].pixels)
        return pixels if np.dtype(entry["dtype"]).kind == "f" else pixels.astype(entry["dtype"])
    content = io.BytesIO(file.read_bytes())
    if kind == "npy":
        return np.asarray(np.load(content, allow_pickle=False))
    stored = tifffile.imread(content) if kind == "tiff" else np.asarray(Image.open(content))
    return stored if np.dtype(entry["dtype"]).kind == "u" else stored * np.float64(entry["scale"])
