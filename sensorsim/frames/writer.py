"""Writes frames to disk, whole or not at all.

All files of a frame are first written under temporary names in their own folder and take their places only when every
one of them is complete; the JSON sidecar comes last, so that where it stands, the files it lists stand too.
"""

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from sensorsim.errors import InputError, NumericsError
from sensorsim.files import placed_whole
from sensorsim.frames import encode
from sensorsim.frames.frame import JSON, Frame, Plane, build_frame

PLANE_FORMATS = ("exr", "npy", "png", "tiff")

Write = Callable[[Path], object]


def write_frame(frame: Frame, path: Path | str, *, planes: Sequence[str] = (), plane_format: str = "exr") -> list[Path]:
    """Writes a frame and returns its files, the one named `path` first and the sidecar `<stem>.json` last.

    path `.png`: the display image, 8 bit; `planes` beside it in `plane_format`: 'exr' (all in `<stem>.exr`, float32),
    'npy' (`<stem>.<plane>_<unit>.npy`), 'png' or 'tiff' (16 bit, temperatures as `<stem>.<plane>_centikelvin.png`,
    counts as `<stem>.counts.png`).
    path `.exr`: the planes, no display; `.npy`, `.tif`, `.tiff`: the one plane. Files of the same names are replaced.

    Raises InputError for a path, plane or format that cannot be honoured or a disk that refuses, NumericsError
    where any plane of the frame holds NaN or infinity; in each case no file is left.
    """
    target = Path(path)
    if not target.parent.is_dir():
        raise InputError(target, "folder", str(target.parent), "not there", "create it first")
    _check_finite(frame)
    inputs = inputs_sha256(frame.settings)
    chosen = [frame.plane(name) for name in dict.fromkeys(planes)]
    files, entries = _plan(frame, target, chosen, plane_format, inputs)
    sidecar = target.with_suffix(".json")

    def describe(written: Mapping[Path, str]) -> bytes:
        for entry in entries:
            entry["sha256"] = written[target.with_name(entry["file"])]
        content = {"inputs_sha256": inputs, "settings": frame.settings, "planes": entries}
        return (json.dumps(content, indent=2, sort_keys=True, allow_nan=False) + "\n").encode()

    return _write_all(files, sidecar, describe)


def require_writable(
    path: Path | str, names: Sequence[str], *, planes: Sequence[str] = (), plane_format: str = "exr"
) -> None:
    """Raise what `write_frame` would raise of path, planes and format for a frame with planes of these names.

    A frame of one pixel is planned, and nothing is written: so that a command can refuse before it has worked.
    """
    frame = build_frame({name: np.full((1, 1), 255) for name in names}, {})
    _plan(frame, Path(path), [frame.plane(name) for name in dict.fromkeys(planes)], plane_format, "")


def inputs_sha256(settings: Mapping[str, JSON]) -> str:
    """SHA-256 of settings as canonical JSON: keys sorted, no blanks, UTF-8; InputError where they are not JSON."""
    try:
        canonical = json.dumps(settings, sort_keys=True, separators=(",", ":"), ensure_ascii=False, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise InputError("frame", "settings", sorted(settings), str(error), "give plain finite JSON values") from error
    return hashlib.sha256(canonical.encode()).hexdigest()


def _check_finite(frame: Frame) -> None:
    for name, plane in frame.planes.items():
        bad = int(np.sum(~np.isfinite(plane.data.astype(np.float64, copy=False))))
        if bad:
            raise NumericsError(
                f"plane {name!r}: {bad} of {plane.data.size} pixels are NaN or infinite; nothing written"
            )


def _plan(
    frame: Frame, target: Path, chosen: list[Plane], plane_format: str, inputs: str
) -> tuple[dict[Path, Write], list[dict[str, Any]]]:
    """How to write each file, and the sidecar's entries of the planes in them."""
    files: dict[Path, Write] = {}
    entries: list[dict[str, Any]] = []

    def add(kind: str, path: Path, held: Sequence[Plane]) -> None:
        files[path] = _encoder(kind, held, inputs)
        entries.extend(_entry(kind, path, plane) for plane in held)

    suffix = target.suffix.lower()
    if suffix == ".png":
        display = frame.plane("display")
        add("display", target, [display])
        _plan_beside(target, [plane for plane in chosen if plane is not display], plane_format, add)
    elif suffix == ".exr" and chosen:
        add("exr", target, chosen)
    elif suffix in (".npy", ".tif", ".tiff") and len(chosen) == 1:
        add("npy" if suffix == ".npy" else "tiff", target, chosen)
    else:
        names = [plane.name for plane in chosen]
        remedy = "use .png for the display with any planes beside it, .exr for planes, .npy or .tiff for one plane"
        raise InputError(target, "planes", names, f"cannot be written to a file {suffix or 'without suffix'}", remedy)
    return files, entries


def _plan_beside(
    target: Path, chosen: list[Plane], plane_format: str, add: Callable[[str, Path, Sequence[Plane]], None]
) -> None:
    """Files of planes beside a display image."""
    if plane_format not in PLANE_FORMATS:
        raise InputError(target, "plane format", plane_format, "unknown", f"use {', '.join(PLANE_FORMATS)}")
    if plane_format == "exr" and chosen:
        add("exr", target.with_suffix(".exr"), chosen)
    elif plane_format == "npy":
        for plane in chosen:
            unit = "" if plane.unit in ("1", "count") else "_" + plane.unit.replace(" ", "_")
            add("npy", target.with_name(f"{target.stem}.{plane.name}{unit}.npy"), [plane])
    elif plane_format in ("png", "tiff"):
        for plane in chosen:
            unit = "" if plane.unit == "count" else "_centikelvin"
            add(plane_format, target.with_name(f"{target.stem}.{plane.name}{unit}.{plane_format}"), [plane])


def _encoder(kind: str, planes: Sequence[Plane], inputs: str) -> Write:
    """Function that writes the planes to a path. Encoding in memory raises before any file is opened."""
    if kind == "exr":
        return lambda path: encode.write_exr(planes, path, inputs)
    (plane,) = planes
    if kind == "display":
        content = encode.display_bytes(plane, inputs)
    elif kind == "npy":
        content = encode.npy_bytes(plane)
    elif kind == "png":
        content = encode.png16_bytes(plane, inputs)
    else:
        content = encode.tiff16_bytes(plane, inputs)
    return lambda path: path.write_bytes(content)


def _entry(kind: str, path: Path, plane: Plane) -> dict[str, Any]:
    """Sidecar entry of a plane; min and max are those of `Plane.limits`."""
    limits = plane.limits
    return {
        "name": plane.name,
        "unit": plane.unit,
        "scale": encode.scale16(plane) if kind in ("png", "tiff") else 1.0,
        "description": plane.description,
        "no_surface": plane.no_surface,
        "bits": plane.bits,
        "file": path.name,
        "format": kind,
        "shape": list(plane.data.shape),
        "dtype": str(plane.data.dtype),
        "min": None if limits is None else limits[0],
        "max": None if limits is None else limits[1],
    }


def _write_all(
    files: Mapping[Path, Write], sidecar: Path, describe: Callable[[Mapping[Path, str]], bytes]
) -> list[Path]:
    """Writes all files and the sidecar that describes them, given the SHA-256 of each, or none of them."""
    try:
        with placed_whole(*files, sidecar) as (*written, described):
            for path, write in zip(written, files.values(), strict=True):
                write(path)
            digests = (hashlib.sha256(path.read_bytes()).hexdigest() for path in written)
            described.write_bytes(describe(dict(zip(files, digests, strict=True))))
    except OSError as error:
        remedy = "check the folder's permissions and free space"
        raise InputError(sidecar.parent, "file", str(error.filename), str(error.strerror), remedy) from error
    return [*files, sidecar]
