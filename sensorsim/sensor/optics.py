"""The optics of a sensor as data: what gathers the light and how sharply."""

import math
from dataclasses import dataclass, fields

from sensorsim.errors import InputError


@dataclass(frozen=True, slots=True, kw_only=True)
class Optics:
    """A lens or mirror and what moves or blurs its image; angles as seen from outside.

    Raises InputError naming the entry that no optics can have.
    """

    aperture: float  # diameter of the entrance pupil [m]
    focal_length: float  # [m]
    obscuration: float = 0.0  # diameter of the central stop over that of the pupil [-]
    transmission: float = 1.0  # [-]
    defocus: float = 0.0  # wavefront error at the edge of the pupil [m]
    blur: float = 0.0  # of aberrations and phosphors: Gaussian exp(-pi (f blur)^2) [rad]
    jitter: float = 0.0  # r.m.s. of random motion within an exposure [rad]
    drift: float = 0.0  # steady motion within an exposure, along the rows [rad]

    def __post_init__(self) -> None:
        """Refuse what no optics can have."""
        limits = {"aperture": (1e-5, 100.0), "focal_length": (1e-4, 1000.0), "obscuration": (0.0, 0.95)}
        limits |= {"transmission": (1e-3, 1.0), "defocus": (0.0, 1e-3)}
        for field in fields(self):
            low, high = limits.get(field.name, (0.0, 0.1))
            value = getattr(self, field.name)
            if not (math.isfinite(value) and low <= value <= high):
                raise InputError("optics", field.name, value, f"not {low:g} to {high:g}", "give it in SI units")
        if self.f_number < 0.5:
            remedy = "make the aperture smaller or the focal length longer"
            raise InputError("optics", "aperture", self.aperture, f"an f-number of {self.f_number:.2g}", remedy)

    @property
    def f_number(self) -> float:
        """Focal length over aperture [-]."""
        return self.focal_length / self.aperture

    @property
    def light_share(self) -> float:
        """Irradiance on the focal plane over radiance [sr]: pi tau (1 - o^2) / (1 + 4 F^2) [PyBSM2025]."""
        return math.pi * self.transmission * (1.0 - self.obscuration**2) / (1.0 + 4.0 * self.f_number**2)
