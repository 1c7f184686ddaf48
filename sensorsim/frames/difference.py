"""How far two frames are apart, in the unit of a plane: the judge of a build that guards its pictures."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sensorsim.errors import InputError
from sensorsim.frames.frame import Plane
from sensorsim.frames.radiometric_jpeg import is_radiometric_jpeg, read_radiometric_jpeg
from sensorsim.frames.reader import read_plane, read_sidecar

PREFERRED = ("apparent_temperature", "radiance", "display")


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """Of a plane of two frames, over the pixels in which both see a surface where the plane tells them apart."""

    plane: str
    unit: str
    mean: float  # second less first
    rms: float
    p99: float  # of the absolute difference
    largest: float
    pixels: int  # compared
    unmatched: int  # where only one sees a surface


def compare_frames(first: Path | str, second: Path | str, plane: str | None = None) -> Difference:
    """Difference of one plane, the first of PREFERRED that both hold where none is named.

    Each is a frame with its sidecar or a radiometric JPEG. Raises InputError for planes that are missing, of different
    units or of different sizes.
    """
    name = _common_plane(Path(first), Path(second)) if plane is None else plane
    one, other = _plane(Path(first), name), _plane(Path(second), name)
    if one.unit != other.unit:
        raise InputError(
            str(second), f"unit of {name}", other.unit, f"the other's is {one.unit}", "compare like with like"
        )
    if one.bits != other.bits:
        problem = f"the other's has {one.bits}"
        raise InputError(str(second), f"bits of {name}", other.bits, problem, "compare counts of one depth")
    if one.data.shape != other.data.shape:
        raise InputError(
            str(second),
            f"size of {name}",
            other.data.shape,
            f"the other's is {one.data.shape}",
            "draw both in one size",
        )
    return difference(one, other)


def difference(one: Plane, other: Plane) -> Difference:
    """Difference of two planes of one unit and shape."""
    a, b = one.data.astype(np.float64), other.data.astype(np.float64)
    seen_a = np.ones(a.shape, bool) if one.no_surface is None else a != one.no_surface
    seen_b = np.ones(b.shape, bool) if other.no_surface is None else b != other.no_surface
    apart = (b - a)[seen_a & seen_b]
    size = np.abs(apart) if apart.size else np.zeros(1)
    return Difference(
        plane=one.name,
        unit=one.unit,
        mean=float(apart.mean()) if apart.size else 0.0,
        rms=float(np.sqrt(np.mean(size**2))),
        p99=float(np.quantile(size, 0.99)),
        largest=float(size.max()),
        pixels=int(apart.size),
        unmatched=int(np.sum(seen_a != seen_b)),
    )


def _names(path: Path) -> list[str]:
    if is_radiometric_jpeg(path):
        return ["apparent_temperature"]
    return [str(entry["name"]) for entry in read_sidecar(path)["planes"]]


def _common_plane(first: Path, second: Path) -> str:
    names = [_names(first), _names(second)]
    for name in PREFERRED:
        if name in names[0] and name in names[1]:
            return name
    remedy = "write one of " + ", ".join(PREFERRED) + " with both"
    raise InputError(str(second), "planes", names[1], f"none in common with {', '.join(names[0])}", remedy)


def _plane(path: Path, name: str) -> Plane:
    if is_radiometric_jpeg(path) and name == "apparent_temperature":
        return read_radiometric_jpeg(path)
    return read_plane(path, name)
