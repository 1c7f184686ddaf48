"""What can be chosen at the window: weather with its day, the scene's cameras, and what the last picture tells."""

from collections.abc import Mapping, Sequence
from datetime import date, timedelta
from pathlib import Path

from sensorsim.environment import Weather
from sensorsim.render import Camera, World, look_at
from sensorsim.resources import assets_folder
from sensorsim.sensor import Sensor
from sensorsim.viewer.actions import Seen
from sensorsim.viewer.stage import Shot

Days = tuple[tuple[str, date], ...]


def shipped_days() -> Days:
    """Weather that comes with the package, with its image day, in the order of the calendar."""
    stems = (path.stem.split("_", 1) for path in (assets_folder() / "weather").glob("*_????-??-??.csv"))
    return tuple(sorted(((name, date.fromisoformat(day)) for name, day in stems), key=lambda pair: pair[1]))


def choosable_days(weather: str, day: date) -> Days:
    """The shipped days, and before them the weather asked for where it is a file of the user's."""
    shipped = shipped_days()
    return shipped if weather in dict(shipped) else ((weather, day), *shipped)


def weather_name(weather: str | None, day: date) -> str:
    """Name of the shipped weather for what was asked, which may be its ISO date or nothing; else what was asked."""
    asked = day.isoformat() if weather is None else weather
    return next((name for name, own in shipped_days() if asked == own.isoformat()), asked)


def default_day(weather: Weather) -> date:
    """The last whole day that a weather file covers, which leaves the days before for the lead-in."""
    end = weather.start + timedelta(seconds=float(weather.time[-1]))
    return (end - timedelta(days=1)).date()


def stations(world: World) -> tuple[Camera, ...]:
    """The scene's cameras."""
    frame = world.scene.frame
    return tuple(
        look_at(station.position(frame), station.target(frame), station.horizontal_field_of_view)
        for station in world.scene.cameras
    )


def seen(world: World, sensors: Mapping[str, Sensor], shots: Sequence[Shot], days: Days, width: float) -> Seen:
    """The choices there are, and what the last pictures tell."""
    return Seen(
        sensors=tuple(sensors),
        own={name: sensor.display for name, sensor in sensors.items()},
        shown={shot.sensor.name: shot.picture.display for shot in shots},
        distance=None if not shots else centre_range(shots[0]),
        stations=stations(world),
        days=days,
        width=width,
    )


def centre_range(shot: Shot) -> float | None:
    """Distance [m] to the surface in the middle of a picture, None where the sky is."""
    distance = shot.told.planes["range"]
    row, column = distance.shape[0] // 2, distance.shape[1] // 2
    return float(distance[row, column]) if shot.told.planes["surface_id"][row, column] >= 0 else None


def named(path_or_name: str) -> str:
    """A short name of a weather or a scene that may be a file."""
    return Path(path_or_name).stem or path_or_name
