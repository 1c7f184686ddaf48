"""A place on Earth and its clock."""

from dataclasses import dataclass
from datetime import timedelta, timezone


@dataclass(frozen=True, slots=True, kw_only=True)
class Site:
    """Where the weather was taken; the clock is local standard time all year, whatever the law says in summer."""

    name: str
    longitude: float  # [deg], positive east
    latitude: float  # [deg], positive north
    altitude: float  # [m] above sea level
    utc_offset: float  # [h] local standard time minus UTC

    @property
    def time_zone(self) -> timezone:
        """Local standard time as a fixed offset from UTC."""
        return timezone(timedelta(hours=self.utc_offset))
