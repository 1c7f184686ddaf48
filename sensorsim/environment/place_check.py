"""Does the weather belong to the scene? Place and clock compared, because a wrong file looks like a right one."""

import math

from sensorsim.environment.site import Site
from sensorsim.errors import InputError

EARTH_RADIUS = 6_371_000.0  # [m] of the sphere with the Earth's volume
FARTHEST = 100_000.0  # [m] weather and scene may be apart; the fronts of a day pass both within hours
DEGREES_PER_HOUR = 15.0
GREATEST_CLOCK_ERROR = 3.5  # [h] that standard time lies off the sun's own; 3.2 h in the west of China
POLAR_CIRCLE = 66.56  # [deg] latitude, beyond which stations keep whatever clock suits them


def great_circle_distance(longitude: float, latitude: float, other_longitude: float, other_latitude: float) -> float:
    """Distance [m] between two places [deg] on a spherical Earth."""
    here, there = math.radians(latitude), math.radians(other_latitude)
    turn = math.radians(other_longitude - longitude)
    half = math.sin((there - here) / 2.0) ** 2 + math.cos(here) * math.cos(there) * math.sin(turn / 2.0) ** 2
    return 2.0 * EARTH_RADIUS * math.asin(min(1.0, math.sqrt(half)))


def place_mismatch(
    weather_site: Site,
    longitude: float,
    latitude: float,
    *,
    utc_offset: float | None = None,
    farthest: float = FARTHEST,
) -> str | None:
    """What is wrong with using a site's weather at a place, in one line, or None where the two agree.

    Parameters
    ----------
    weather_site : where the weather was taken
    longitude, latitude : [deg] of the place where it is to be used
    utc_offset : [h] the place's standard time minus UTC, where known
    farthest : [m] that place and site may be apart
    """
    found = []
    distance = great_circle_distance(weather_site.longitude, weather_site.latitude, longitude, latitude)
    if not distance <= farthest:
        found.append(f"{distance / 1000.0:.0f} km away from {latitude:g} N, {longitude:g} E")
    if utc_offset is not None and abs(utc_offset - weather_site.utc_offset) > 1e-6:
        found.append(f"its clock is UTC{weather_site.utc_offset:+g}, that of the place UTC{utc_offset:+g}")
    return f"weather of {weather_site.name}: {'; '.join(found)}" if found else None


def check_place(
    weather_site: Site,
    longitude: float,
    latitude: float,
    *,
    utc_offset: float | None = None,
    farthest: float = FARTHEST,
) -> None:
    """Refuse weather of another place or clock; arguments as `place_mismatch`.

    Raises
    ------
    InputError : the place is too far from the site, or keeps another standard time.
    """
    mismatch = place_mismatch(weather_site, longitude, latitude, utc_offset=utc_offset, farthest=farthest)
    if mismatch is not None:
        place = f"{latitude:g} N, {longitude:g} E"
        raise InputError("weather", "place", place, mismatch, "take weather of the place, or allow a greater distance")


def require_clock(where: object, site: Site) -> None:
    """Refuse a site whose UTC offset cannot be the standard time of its longitude: a lost sign, mostly.

    Nothing is asked within the polar circles.

    Raises
    ------
    InputError : standard time and the sun's time at the site's longitude differ by more than GREATEST_CLOCK_ERROR.
    """
    solar = site.longitude / DEGREES_PER_HOUR
    error = abs((site.utc_offset - solar + 12.0) % 24.0 - 12.0)
    if abs(site.latitude) < POLAR_CIRCLE and not error <= GREATEST_CLOCK_ERROR:
        problem = f"the sun at longitude {site.longitude:g} keeps UTC{solar:+.1f}"
        raise InputError(where, "UTC offset", site.utc_offset, problem, "check both signs; east is positive")
