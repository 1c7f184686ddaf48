"""What the claims are held against: worlds of the hospital scene and what both sensors show of them.

A shade is what a pixel shows: apparent temperature [K] in the thermal band, radiance [W m-2 sr-1] in the reflective
one. Temperatures come from the tables for all surfaces, also those that no camera sees.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from datetime import date

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment import read_weather
from sensorsim.render import Camera, Picture, Renderer, World, build_world, look_at, station_camera
from sensorsim.scene import load_scene
from sensorsim.sensor import load_sensor
from sensorsim.study.gallery import FALL, SUMMER, WINTER
from sensorsim.tables import BakeSettings, surface_temperature

FloatArray = NDArray[np.float64]
Rows = NDArray[np.bool_]
Progress = Callable[[str, int, int], None]

DAYS: Mapping[str, date] = {"winter": WINTER, "summer": SUMMER, "fall": FALL}
HOURS = (7.0, 10.0, 13.0, 16.0, 17.0)
LOOKS = (  # level, day and the hours that the sentences speak of
    ("IIIB", "winter", HOURS),
    ("IIIB", "summer", (10.0,)),
    ("IIIB", "fall", (10.0,)),
    ("IIA", "winter", HOURS),
    ("IA", "winter", HOURS),
)
SOUTH, WEST, EAST, NORTH, SOUTH_EAST, SOUTH_WEST = 180.0, 270.0, 90.0, 0.0, 142.0, 232.0  # azimuths of walls [deg]
AZIMUTH_TOLERANCE = 15.0  # [deg]
HOSPITAL = {"IIIB": ("24",), "IIA": ("4",), "IA": ("3",)}  # feature numbers by level
HEATING_PLANT = {"IIIB": ("40",), "IIA": ("6",), "IA": ("5",)}
CEMENT_PLANT = {"IIIB": tuple(map(str, range(44, 55))), "IIA": ("13", "14"), "IA": ("9",)}
FOREGROUND = tuple(map(str, range(1, 24))) + tuple(map(str, range(25, 40)))  # at level IIIB: houses, officers' housing
BLOCK_WALL, METAL_WALL = ("45",), ("51",)  # pack house and finish mills, left-most and right-most seen from the tower
DISTANCE_BEHIND = 600.0  # [m] of the camera that sees the hospital's north and east walls


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class View:
    """A world and its pictures, by sensor, hour and camera: 'tower', or 'behind', from the hospital's north-east."""

    world: World
    pictures: Mapping[tuple[str, float, str], Picture]

    def rows(
        self, features: Iterable[str] | None = None, role: str | None = None, azimuth: float | None = None
    ) -> Rows:
        """Surfaces (s,) of the numbered features, of a role, facing an azimuth [deg]; all that is not given."""
        surfaces = self.world.scene.surfaces
        chosen = np.ones(surfaces.area.size, dtype=np.bool_)
        if features is not None:
            number = np.array([feature.number for feature in self.world.scene.features])
            chosen &= np.isin(number[surfaces.feature], list(features))
        if role is not None:
            chosen &= surfaces.role == role
        if azimuth is not None:
            off = (self.azimuths() - azimuth + 180.0) % 360.0 - 180.0
            chosen &= (np.abs(off) < AZIMUTH_TOLERANCE) & (np.abs(surfaces.normal[:, 2]) < 0.5)
        return chosen

    def building_walls(self) -> Rows:
        """Walls (s,) of whatever has an inside: no trees, no bridge."""
        surfaces = self.world.scene.surfaces
        bridge = np.array([feature.description == "Bridge" for feature in self.world.scene.features])
        return np.asarray((surfaces.role == "wall") & (surfaces.interior != "none") & ~bridge[surfaces.feature])

    def azimuths(self) -> FloatArray:
        """Azimuths (s,) that surfaces face [deg]."""
        normal = self.world.scene.surfaces.normal
        return np.asarray(np.degrees(np.arctan2(normal[:, 0], normal[:, 1])))

    def sun_cosine(self, hour: float) -> FloatArray:
        """Cosine (s,) of the angle between the sun and the normals, negative where the sun is behind."""
        direction = self.world.environment.at(hour * 3600.0).sun_direction
        return np.asarray(self.world.scene.surfaces.normal @ direction)

    def temperatures(self, hour: float) -> FloatArray:
        """Surface temperatures (s,) [K] from the tables."""
        assignment, normal = self.world.assignment, self.world.scene.surfaces.normal
        return surface_temperature(
            self.world.tables, normal, assignment.wall_type, assignment.reflectance, hour * 3600.0
        )

    def temperature(self, hour: float, rows: Rows) -> float:
        """Mean surface temperature [K] of surfaces, by area."""
        return float(np.average(self.temperatures(hour)[rows], weights=self.world.scene.surfaces.area[rows]))

    def pixels(self, sensor: str, hour: float, rows: Rows | None = None, camera: str = "tower") -> FloatArray:
        """Shades (m,) of all pixels on surfaces, or on the given ones."""
        planes = self.pictures[sensor, hour, camera].planes
        surface = planes["surface_id"]
        chosen = surface >= 0
        if rows is not None:
            chosen &= rows[np.maximum(surface, 0)]
        return planes["apparent_temperature" if sensor == "flir" else "radiance"][chosen].astype(np.float64)

    def shade(self, sensor: str, hour: float, rows: Rows | None = None, camera: str = "tower") -> float:
        """Mean shade of pixels."""
        return float(np.mean(self.pixels(sensor, hour, rows, camera)))

    def spread(self, sensor: str, hour: float, rows: Rows | None = None) -> float:
        """Standard deviation of the shades of pixels."""
        return float(np.std(self.pixels(sensor, hour, rows)))

    def column(self, hour: float, rows: Rows) -> float:
        """Mean column of surfaces in the tower's picture, from the left [pixel]."""
        surface = self.pictures["flir", hour, "tower"].planes["surface_id"]
        return float(np.mean(np.nonzero((surface >= 0) & rows[np.maximum(surface, 0)])[1]))

    def contrast(self, sensor: str, hour: float) -> float:
        """Standard deviation of band radiance over its mean, of all pixels on surfaces [-]."""
        planes = self.pictures[sensor, hour, "tower"].planes
        radiance = planes["radiance"][planes["surface_id"] >= 0].astype(np.float64)
        return float(np.std(radiance) / np.mean(radiance))


Evidence = Mapping[tuple[str, str], View]  # by level and day


def views_by_day(evidence: Evidence) -> dict[str, View]:
    """Views of the finest level by day."""
    return {day: view for (level, day), view in evidence.items() if level == "IIIB"}


def gather_evidence(
    *,
    settings: BakeSettings | None = None,
    size: tuple[int, int] = (480, 360),
    backend: str = "auto",
    progress: Progress | None = None,
) -> Evidence:
    """Bake the worlds that the sentences speak of and take their pictures."""
    evidence = {}
    for done, (level, day, hours) in enumerate(LOOKS):
        if progress is not None:
            progress(f"level {level}, {day}", done, len(LOOKS))
        scene = load_scene("hospital", level=level)
        world = build_world(scene, read_weather(day), image_day=DAYS[day], settings=settings)
        evidence[level, day] = View(world=world, pictures=_pictures(world, hours, size, backend))
    return evidence


def _pictures(
    world: World, hours: tuple[float, ...], size: tuple[int, int], backend: str
) -> dict[tuple[str, float, str], Picture]:
    cameras = {"tower": station_camera(world.scene, "tower")}
    if world.scene.level == "IIIB":
        cameras["behind"] = _behind_the_hospital(world)
    pictures = {}
    for sensor in ("flir", "lltv"):
        with Renderer(world, load_sensor(sensor), size=size, backend=backend) as renderer:
            for hour in hours:
                for name, camera in cameras.items():
                    pictures[sensor, hour, name] = renderer.render(camera, hour * 3600.0)
    return pictures


def _behind_the_hospital(world: World) -> Camera:
    """From the north-east, where the tower never looks from."""
    scene = world.scene
    hospital = next(index for index, feature in enumerate(scene.features) if feature.description == "Hospital")
    corners = scene.mesh.position[scene.surfaces.feature[scene.mesh.surface] == hospital]
    middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
    return look_at(middle + DISTANCE_BEHIND * np.array([0.6, 0.6, 0.5]), middle, 30.0)
