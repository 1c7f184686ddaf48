"""The three levels of detail of the 1974 Defense Mapping Agency specification that [Report1978] 2.1 uses."""

from collections.abc import Mapping
from types import MappingProxyType

from sensorsim.errors import InputError
from sensorsim.units import metres_from_feet

RESOLUTION: Mapping[str, float] = MappingProxyType(
    {"IA": metres_from_feet(500.0), "IIA": metres_from_feet(200.0), "IIIB": metres_from_feet(50.0)}
)  # smallest object kept [m]

LEVELS: tuple[str, ...] = tuple(RESOLUTION)
ALL_LEVELS = "auto"  # of a scene that holds all of them, to choose from while it is drawn


def check_level(where: object, level: object) -> str:
    """The level's name; InputError where there is none of that name."""
    if not isinstance(level, str) or level not in RESOLUTION:
        raise InputError(where, "level", level, "no such level of detail", f"use one of {', '.join(LEVELS)}")
    return level
