"""What one look yields."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.effects import Ledger
from sensorsim.errors import InputError
from sensorsim.render.camera import Camera
from sensorsim.render.illumination import Illumination
from sensorsim.sensor import DisplaySettings, Sensor, sampled_surfaces

QUANTITIES = ("radiance", "surface_temperature", "range")  # components of the float plane, in order


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Picture:
    """What one look yields: planes (height, width), row 0 at the top, and the display window they were shown with."""

    planes: Mapping[str, NDArray[Any]]
    display: DisplaySettings
    time_of_day: float  # [s]
    camera: Camera
    illumination: Illumination
    count_step: float | None = None  # band radiance of one count of the detector, where it is known [W m-2 sr-1]
    ledger: Ledger | None  # of the effects that are in it; frames for display alone have all, and none


def exposed(planes: Mapping[str, NDArray[Any]]) -> NDArray[np.float32]:
    """Radiances that an automatic gain goes by, of what the detector reports where there is one."""
    return sampled_surfaces(planes.get("signal", planes["radiance"]), planes["surface_id"] >= 0)


def wanted_planes(sensor: Sensor, planes: Collection[str] | None) -> set[str]:
    """The planes asked for, all that a sensor's frames have for None; InputError for none and for any other."""
    there = {*QUANTITIES, "surface_id", "feature", "material", "display"}
    there |= {"signal"} if sensor.detector is not None else set()
    there |= {"counts"} if sensor.has_counts else set()
    there |= {"apparent_temperature"} if sensor.mode == "emissive" else set()
    unknown = set() if planes is None else set(planes) - there
    if unknown or (planes is not None and not planes):
        where, problem = f"sensor {sensor.name!r}", "not what its frames have"
        raise InputError(where, "planes", sorted(unknown), problem, f"use {', '.join(sorted(there))}")
    return there if planes is None else set(planes)
