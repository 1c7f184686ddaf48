"""Where a scene is and from where it is looked at: `scene.toml` beside its GeoJSON files."""

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sensorsim.errors import InputError
from sensorsim.scene.features import Feature
from sensorsim.scene.projection import FloatArray, LocalFrame

PLACE_FILE = "scene.toml"


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneSite:
    """The scene's origin."""

    name: str
    longitude: float  # [deg], east positive
    latitude: float  # [deg], north positive
    altitude: float  # of the ground above sea level [m]
    utc_offset: float  # of local standard time [h]


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraStation:
    """A named place to look from. Altitudes are above the scene's ground."""

    name: str
    longitude: float  # [deg]
    latitude: float  # [deg]
    altitude: float  # [m]
    target_longitude: float  # [deg]
    target_latitude: float  # [deg]
    target_altitude: float  # [m]
    horizontal_field_of_view: float  # [deg]
    note: str

    def position(self, frame: LocalFrame) -> FloatArray:
        """Local east, north, up [m] of the camera, shape (3,)."""
        return _local(frame, self.longitude, self.latitude, self.altitude)

    def target(self, frame: LocalFrame) -> FloatArray:
        """Local east, north, up [m] of the point in the middle of its picture, shape (3,)."""
        return _local(frame, self.target_longitude, self.target_latitude, self.target_altitude)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Table:
    """A TOML table read by name, with what an error message needs."""

    file: Path
    label: str
    values: Mapping[str, object]

    def real(self, name: str, low: float, high: float) -> float:
        value = self.values.get(name)
        if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
            remedy = f"give a number from {low:g} to {high:g}"
            raise InputError(self.file, f"{self.label}: {name}", value, "missing or out of range", remedy)
        return float(value)

    def text(self, name: str, default: str | None = None) -> str:
        value = self.values.get(name, default)
        if not isinstance(value, str):
            raise InputError(self.file, f"{self.label}: {name}", value, "missing or not a text", "write it in quotes")
        return value


def read_place(file: Path) -> tuple[SceneSite, tuple[CameraStation, ...]]:
    """Site and cameras of a `scene.toml`."""
    try:
        document = tomllib.loads(file.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as problem:
        raise InputError(file, "file", file.name, str(problem), "repair it as a TOML file") from problem
    place = document.get("site")
    if not isinstance(place, dict):
        raise InputError(file, "site", place, "missing table", "add [site] with name, longitude, latitude, ...")
    site = _site(file, place)
    cameras = document.get("cameras", {})
    if not isinstance(cameras, dict) or not cameras:
        raise InputError(file, "cameras", cameras, "no camera", "add a table such as [cameras.tower]")
    return site, tuple(_camera(file, name, values) for name, values in cameras.items())


def _site(file: Path, values: Mapping[str, object]) -> SceneSite:
    table = _Table(file=file, label="site", values=values)
    return SceneSite(
        name=table.text("name"),
        longitude=table.real("longitude", -180.0, 180.0),
        latitude=table.real("latitude", -89.0, 89.0),
        altitude=table.real("altitude", -500.0, 9000.0),
        utc_offset=table.real("utc_offset", -12.0, 14.0),
    )


def _camera(file: Path, name: str, values: object) -> CameraStation:
    if not isinstance(values, dict):
        raise InputError(file, f"cameras.{name}", values, "not a table", "give longitude, latitude, altitude, ...")
    table = _Table(file=file, label=f"cameras.{name}", values=values)
    return CameraStation(
        name=name,
        longitude=table.real("longitude", -180.0, 180.0),
        latitude=table.real("latitude", -89.0, 89.0),
        altitude=table.real("altitude", 0.0, 1e5),
        target_longitude=table.real("target_longitude", -180.0, 180.0),
        target_latitude=table.real("target_latitude", -89.0, 89.0),
        target_altitude=table.real("target_altitude", 0.0, 1e5),
        horizontal_field_of_view=table.real("horizontal_field_of_view", 0.1, 150.0),
        note=table.text("note", ""),
    )


def derive_place(name: str, features: tuple[Feature, ...]) -> tuple[SceneSite, tuple[CameraStation, ...]]:
    """Site and one camera for outlines that come without a `scene.toml`.

    The origin is the middle of the outlines, the ground at sea level, the clock that of the longitude's whole hour.
    The camera 'overhead' looks down by 35 degrees from the south and holds all of it.
    """
    corners = np.concatenate([part.footprint for feature in features for part in feature.parts])
    longitude, latitude = ((corners.min(axis=0) + corners.max(axis=0)) / 2.0).tolist()
    site = SceneSite(
        name=name, longitude=longitude, latitude=latitude, altitude=0.0, utc_offset=float(round(longitude / 15.0))
    )
    frame = LocalFrame(longitude=longitude, latitude=latitude)
    radius = float(np.hypot(*frame.metres_from_degrees(corners).T).max())
    distance = 2.5 * radius + 50.0
    away, up = distance * math.cos(math.radians(35.0)), distance * math.sin(math.radians(35.0))
    south = frame.degrees_from_metres(np.array([[0.0, -away]]))[0]
    camera = CameraStation(
        name="overhead",
        longitude=float(south[0]),
        latitude=float(south[1]),
        altitude=up,
        target_longitude=longitude,
        target_latitude=latitude,
        target_altitude=0.0,
        horizontal_field_of_view=50.0,
        note="derived from the outlines",
    )
    return site, (camera,)


def _local(frame: LocalFrame, longitude: float, latitude: float, altitude: float) -> FloatArray:
    east, north = frame.metres_from_degrees(np.array([[longitude, latitude]]))[0]
    return np.array([east, north, altitude])
