"""WGS84 to the scene's local axes and back, north's direction included."""

from dataclasses import dataclass
from functools import lru_cache
from math import atan, degrees, radians, sin, tan

import numpy as np
from pyproj import Transformer

from sensorsim.scene import LocalFrame, Scene
from sensorsim.trainer.rotations import FloatArray

REACH = 5.0  # [deg] of latitude and longitude around the origin; the map knows nothing beyond


@lru_cache(maxsize=1)
def _geodetic_from_geocentric() -> Transformer:
    return Transformer.from_crs("EPSG:4978", "EPSG:4979", always_xy=True)


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalPlace:
    """The scene's map and the height of its ground above the ellipsoid [m].

    Local east and north are the map's, true to scale and to north at the origin; heights are differences of geodetic
    height. The ellipsoid's curvature is thereby left out, as in everything that is drawn: 8 cm of height 1 km away.
    """

    frame: LocalFrame
    altitude: float

    def local(self, latitude: float, longitude: float, altitude: float) -> FloatArray | None:
        """East, north, up [m] of the scene's origin, of degrees and geodetic height [m]; None off the map."""
        across = (longitude - self.frame.longitude + 180.0) % 360.0 - 180.0
        if abs(across) > REACH or abs(latitude - self.frame.latitude) > REACH:
            return None
        east, north = self.frame.east_north(longitude, latitude)
        return np.array([east, north, altitude - self.altitude])

    def geodetic(self, position: FloatArray) -> tuple[float, float, float]:
        """Latitude, longitude [deg] and geodetic height [m] of a local position."""
        east, north, up = position.tolist()
        longitude, latitude = self.frame.longitude_latitude(east, north)
        return latitude, longitude, up + self.altitude

    def convergence(self, latitude: float, longitude: float) -> float:
        """Heading of the map's north, east of true north positive [deg]; subtract it from a true heading.

        The formula is a sphere's, which on the ellipsoid is off by less than 1e-6 deg within 30 km.
        """
        return degrees(atan(tan(radians(longitude - self.frame.longitude)) * sin(radians(latitude))))


def scene_place(scene: Scene) -> LocalPlace:
    """The place of a scene; its ground's height above sea level is taken for that above the ellipsoid."""
    return LocalPlace(frame=scene.frame, altitude=scene.site.altitude)


def geodetic_from_geocentric(x: float, y: float, z: float) -> tuple[float, float, float]:
    """Latitude, longitude [deg] and height [m] on WGS84 of Earth-centred coordinates [m]."""
    longitude, latitude, height = _geodetic_from_geocentric().transform(x, y, z)
    return float(latitude), float(longitude), float(height)
