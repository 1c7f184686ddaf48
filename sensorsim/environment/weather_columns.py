"""What weather files may hold: columns by name and unit, with the least and greatest value that each may take."""

from collections.abc import Collection, Mapping
from typing import Any

from sensorsim.errors import InputError

LIMITS: Mapping[str, tuple[float, float]] = {
    "air_temperature_C": (-90.0, 60.0),
    "relative_humidity_percent": (0.0, 100.0),
    "wind_speed_m_s": (0.0, 120.0),
    "wind_direction_deg": (0.0, 360.0),
    "cloud_cover_percent": (0.0, 100.0),
    "precipitation_mm_h": (0.0, 400.0),
}
# Radiation may be left out. Sunlight: at most a tenth above the solar constant, as at the edge of a bright cloud.
RADIATION_LIMITS: Mapping[str, tuple[float, float]] = {
    "direct_normal_W_m2": (0.0, 1500.0),
    "diffuse_horizontal_W_m2": (0.0, 1500.0),
    "global_horizontal_W_m2": (0.0, 1500.0),
    "sky_infrared_W_m2": (30.0, 700.0),
}
_RADIATION_FIELDS = {column: column.removesuffix("_W_m2") for column in RADIATION_LIMITS}  # of `Weather`
SITE_LIMITS: Mapping[str, tuple[float, float]] = {
    "longitude_deg": (-180.0, 180.0),
    "latitude_deg": (-90.0, 90.0),
    "altitude_m": (-430.0, 9000.0),
    "utc_offset_h": (-12.0, 14.0),
}


def require_sunlight_whole(where: object, columns: Collection[str]) -> None:
    """Refuse half of the sunlight: direct and diffuse come together.

    Raises
    ------
    InputError : one of the two without the other.
    """
    pair = ("direct_normal_W_m2", "diffuse_horizontal_W_m2")
    there = [name for name in pair if name in columns]
    if len(there) == 1:
        missing = next(name for name in pair if name not in columns)
        raise InputError(where, "columns", there[0], f"{missing} is missing", "give both, or global radiation alone")


def radiation_fields(columns: Mapping[str, Any]) -> dict[str, Any]:
    """Radiation columns under the names that `Weather` has for them; None for those that are not there."""
    return {field: columns.get(column) for column, field in _RADIATION_FIELDS.items()}
