"""What a sensor is to the rest of the package: its band, its mode, its field of view, its hardware and its display."""

import math
from dataclasses import dataclass, field
from typing import Literal, get_args

from sensorsim.errors import InputError
from sensorsim.radiometry import SpectralBand
from sensorsim.sensor.detector import Detector
from sensorsim.sensor.display import DisplaySettings
from sensorsim.sensor.intensifier import Intensifier
from sensorsim.sensor.noise import Noise
from sensorsim.sensor.optics import Optics
from sensorsim.sensor.scan import Scan

Mode = Literal["emissive", "reflective"]

WIDEST_FIELD_OF_VIEW = 170.0  # [deg]; a plane image grows with tan(half the field) and has no use beyond


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensor:
    """A passive imaging sensor; one without optics and detector is ideal: sharp, free of noise, of any depth.

    mode: 'emissive' sees what surfaces emit and reflect of the thermal sky, 'reflective' sees reflected sunlight.
    horizontal_field_of_view [deg]; size (width, height) [pixels]; source: where its numbers come from.
    Raises InputError naming the entry that cannot be honoured.
    """

    name: str
    title: str
    mode: Mode
    band: SpectralBand
    horizontal_field_of_view: float
    size: tuple[int, int] = (640, 480)
    display: DisplaySettings = field(default_factory=DisplaySettings)
    optics: Optics | None = None
    detector: Detector | None = None
    scan: Scan = field(default_factory=Scan)
    noise: Noise = field(default_factory=Noise)
    intensifier: Intensifier | None = None
    notes: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        where = f"sensor {self.name!r}"
        if self.mode not in get_args(Mode):
            raise InputError(where, "mode", self.mode, "unknown", f"use {' or '.join(get_args(Mode))}")
        angle = self.horizontal_field_of_view
        if not (math.isfinite(angle) and 0.0 < angle < WIDEST_FIELD_OF_VIEW):
            limits = f"outside (0, {WIDEST_FIELD_OF_VIEW:g}) deg"
            raise InputError(where, "horizontal_field_of_view", angle, limits, "give the full angle in degrees")
        if len(self.size) != 2 or any(type(pixels) is not int or pixels < 1 for pixels in self.size):
            remedy = "give width and height in whole pixels, for example [640, 480]"
            raise InputError(where, "size", self.size, "not two counts of at least 1", remedy)
        if (self.optics is None) != (self.detector is None):
            missing = "detector" if self.detector is None else "optics"
            raise InputError(where, missing, None, "missing beside the other", "describe both or neither")
        self._check_field()
        if self.detector is not None and self.mode == "reflective" and self.detector.kind != "photon":
            raise InputError(where, "detector.kind", self.detector.kind, "knows heat only", "use photon")
        if self.detector is not None and self.detector.blooming > 0.0 and self.intensifier is not None:
            problem = "behind an intensifier, whose halo takes what is too bright"
            raise InputError(where, "detector.blooming", self.detector.blooming, problem, "describe one of the two")

    @property
    def has_counts(self) -> bool:
        """Whether it gives raw counts that 16 bits hold."""
        return self.detector is not None and self.detector.bits <= 16

    def _check_field(self) -> None:
        """The field of view must be the detector's behind its lens, to a hundredth."""
        if self.optics is None or self.detector is None:
            return
        angle = self.size[0] * self.detector.pitch / self.optics.focal_length
        own = math.degrees(angle if self.scan.equal_angle else 2.0 * math.atan(0.5 * angle))
        if abs(own - self.horizontal_field_of_view) > 0.01 * own:
            problem = f"but pitch, size and focal length give {own:.4g} deg"
            where = f"sensor {self.name!r}"
            raise InputError(
                where, "horizontal_field_of_view", self.horizontal_field_of_view, problem, "make them agree"
            )
