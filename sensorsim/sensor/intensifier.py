"""What an intensifier or a tube does to bright lights, as data."""

import math
from dataclasses import dataclass

from sensorsim.errors import InputError


@dataclass(frozen=True, slots=True, kw_only=True)
class Intensifier:
    """Halo: a share of the light beyond saturation comes back as a disc around it, of one size for all lights.

    Raises InputError for a share or a radius that no tube has.
    """

    halo_share: float  # of the light above saturation [-]
    halo_radius: float  # [rad]

    def __post_init__(self) -> None:
        """Refuse what no tube has."""
        for entry, high in (("halo_share", 1.0), ("halo_radius", 0.2)):
            value = getattr(self, entry)
            if not (math.isfinite(value) and 0.0 < value <= high):
                raise InputError("intensifier", entry, value, f"not above 0 and up to {high:g}", "leave the table out")
