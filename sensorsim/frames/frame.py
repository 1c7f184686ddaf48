"""A frame: named planes of the same shape with their units, and the settings that they were made with.

A pixel that sees no surface (the sky) has a finite stand-in in the planes that describe surfaces: `surface_id` and
`feature` -1, `range` 0 m, `surface_temperature` 0 K, `fit_error` -1 K. No visible surface has any of them. Radiance,
apparent temperature and display hold the sky's own values.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from sensorsim.errors import InputError

JSON: TypeAlias = str | int | float | bool | Sequence["JSON"] | Mapping[str, "JSON"] | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Plane:
    """One quantity of every pixel.

    data (height, width), row 0 at the top; unit as text, '1' for pure numbers; no_surface: the value of pixels that
    see no surface, None where they have a value of their own; bits: of counts, None of all else. Raises InputError for
    data that are no image of numbers.
    """

    name: str
    data: npt.NDArray[np.generic]
    unit: str
    description: str
    no_surface: float | None = None
    bits: int | None = None  # of raw counts

    def __post_init__(self) -> None:
        if self.data.ndim != 2 or self.data.size == 0:
            raise InputError("frame", f"plane {self.name!r}", self.data.shape, "no image", "give (height, width)")
        if self.data.dtype.kind not in "iuf":
            raise InputError("frame", f"plane {self.name!r}", str(self.data.dtype), "no numbers", "give int or float")

    @property
    def limits(self) -> tuple[float, float] | None:
        """Least and greatest value, over the pixels that see a surface where the plane tells them apart."""
        seen = self.data if self.no_surface is None else self.data[self.data != self.no_surface]
        return (float(seen.min()), float(seen.max())) if seen.size else None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Frame:
    """Planes by name, and the settings that made them as plain JSON values.

    Raises InputError for no planes, a plane filed under another name, or planes of different shapes.
    """

    planes: Mapping[str, Plane]
    settings: Mapping[str, JSON]

    def __post_init__(self) -> None:
        if not self.planes:
            raise InputError("frame", "planes", {}, "empty", "give one plane at least")
        for name, plane in self.planes.items():
            if plane.name != name:
                raise InputError("frame", f"plane {name!r}", plane.name, "filed under another name", "use its own")
            if plane.data.shape != self.shape:
                shape = f"not the {self.shape} of the others"
                raise InputError("frame", f"plane {name!r}", plane.data.shape, shape, "give all planes one size")

    @property
    def shape(self) -> tuple[int, ...]:
        """Height and width [pixels]."""
        return next(iter(self.planes.values())).data.shape

    def plane(self, name: str) -> Plane:
        """The plane of that name; InputError listing what there is where the frame has none."""
        if name not in self.planes:
            raise InputError("frame", "plane", name, "not in this frame", f"use {', '.join(self.planes)}")
        return self.planes[name]


def build_frame(
    arrays: Mapping[str, npt.NDArray[np.generic]], settings: Mapping[str, JSON], *, bits: int | None = None
) -> Frame:
    """Frame of images (height, width) under the standard names, with their units and descriptions.

    Names: those of STANDARD_PLANES. Display becomes uint8, counts uint16, of that many `bits`, and ids int32; the rest
    stays float32 or becomes float64. InputError for any other name and for data that the plane's type cannot hold.
    """
    planes = {}
    for name, data in arrays.items():
        if name not in STANDARD_PLANES:
            raise InputError("frame", "plane", name, "unknown", f"use {', '.join(STANDARD_PLANES)}")
        kind, unit, description, no_surface = STANDARD_PLANES[name]
        stored = _stored(name, data, np.dtype(kind))
        planes[name] = Plane(
            name=name, data=stored, unit=unit, description=description, no_surface=no_surface,
            bits=bits if name == "counts" else None,
        )  # fmt: skip
    return Frame(planes=planes, settings=settings)


def _stored(name: str, data: npt.NDArray[np.generic], kind: np.dtype[np.generic]) -> npt.NDArray[np.generic]:
    """Data in the type that the plane has, never with other values."""
    if kind.kind == "f":
        return data if data.dtype == np.float32 else data.astype(kind)
    if data.dtype.kind in "iu":
        stored = data.astype(kind)
        if np.array_equal(stored, data):
            return stored
    raise InputError("frame", f"plane {name!r}", str(data.dtype), f"does not fit {kind}", f"give {kind}")


STANDARD_PLANES: Mapping[str, tuple[type[np.generic], str, str, float | None]] = {
    "display": (np.uint8, "1", "display code, 0 black to 255 white", None),
    "radiance": (np.float64, "W m-2 sr-1", "band radiance at the sensor", None),
    "signal": (np.float64, "W m-2 sr-1", "what the detector reports, as band radiance in whole counts", None),
    "counts": (np.uint16, "count", "raw counts of the detector", None),
    "apparent_temperature": (np.float64, "K", "temperature of the blackbody with the same band radiance", None),
    "surface_temperature": (np.float64, "K", "temperature of the surface seen, 0 where there is none", 0.0),
    "surface_id": (np.int32, "1", "row of the surface seen, -1 where there is none", -1.0),
    "feature": (np.int32, "1", "row of the feature seen, -1 where there is none", -1.0),
    "material": (np.int32, "1", "code of the material seen, -1 where there is none", -1.0),
    "fit_error": (np.float64, "K", "the tables' error for the surface seen at the time, -1 where there is none", -1.0),
    "range": (np.float64, "m", "distance from the sensor to the surface seen, 0 where there is none", 0.0),
}
