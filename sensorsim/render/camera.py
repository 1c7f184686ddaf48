"""Where the sensor is, where it looks, and the matrices that follow: the one place that knows pyrr.

Matrices are named by what they take and give (`clip_from_camera`) and act on column vectors. "Camera" space here has
its origin at the sensor and the world's axes (east, north, up), so that single precision on the GPU keeps its digits
far from the scene's origin.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from pyrr import matrix44

from sensorsim.errors import InputError
from sensorsim.scene import Scene

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Camera:
    """A sensor's place and attitude. Angles in degrees: yaw clockwise from north, pitch up, roll clockwise."""

    position: FloatArray  # (3,) east, north, up of the scene's origin [m]
    yaw: float
    pitch: float
    roll: float = 0.0
    horizontal_field_of_view: float  # [deg]

    def __post_init__(self) -> None:
        """Refuse numbers that no sensor can have."""
        values = [*np.asarray(self.position, dtype=np.float64).ravel(), self.yaw, self.pitch, self.roll]
        if len(values) != 6 or not np.all(np.isfinite(values)):
            raise InputError("camera", "position and attitude", values, "not six finite numbers", "give finite numbers")
        if not -90.0 <= self.pitch <= 90.0:
            raise InputError("camera", "pitch", self.pitch, "outside -90 to 90 deg", "use an elevation of the view")
        if not 0.0 < self.horizontal_field_of_view < 170.0:
            field = self.horizontal_field_of_view
            raise InputError("camera", "horizontal_field_of_view", field, "outside (0, 170) deg", "use a full angle")

    def axes(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Unit vectors forward, right and up of the picture."""
        yaw, pitch, roll = (math.radians(angle) for angle in (self.yaw, self.pitch, self.roll))
        sy, cy, sp, cp, sr, cr = (f(angle) for angle in (yaw, pitch, roll) for f in (math.sin, math.cos))
        forward = np.array([sy * cp, cy * cp, sp])
        level, upright = np.array([cy, -sy, 0.0]), np.array([-sy * sp, -cy * sp, cp])
        return forward, cr * level - sr * upright, sr * level + cr * upright

    def clip_from_camera(self, size: tuple[int, int], near: float, far: float) -> FloatArray:
        """Perspective projection (4, 4) of a picture of `size` (width, height), clip planes at `near` and `far` [m]."""
        forward, right, up = self.axes()
        eye_from_camera = np.eye(4)
        eye_from_camera[:3, :3] = right, up, -forward
        half_width, half_height = self.half_extent(size)
        projection = matrix44.create_perspective_projection_from_bounds(
            -half_width * near, half_width * near, -half_height * near, half_height * near, near, far, dtype=np.float64
        )
        return np.asarray(projection.T @ eye_from_camera)

    def view_rays(self, size: tuple[int, int]) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Ray through the picture's lower left corner, and the vectors along its width and height."""
        forward, right, up = self.axes()
        half_width, half_height = self.half_extent(size)
        corner = forward - half_width * right - half_height * up
        return corner, 2.0 * half_width * right, 2.0 * half_height * up

    def half_extent(self, size: tuple[int, int]) -> tuple[float, float]:
        """Half the width and height of the picture at distance 1, for pixels that are square."""
        half_width = float(np.tan(np.radians(0.5 * self.horizontal_field_of_view)))
        return half_width, half_width * size[1] / size[0]


def look_at(position: ArrayLike, target: ArrayLike, horizontal_field_of_view: float) -> Camera:
    """Camera at `position` (3,) that looks at `target` (3,) [m], its horizon level."""
    place = np.asarray(position, dtype=np.float64)
    towards = np.asarray(target, dtype=np.float64) - place
    if not np.all(np.isfinite(towards)) or not np.any(towards):
        raise InputError("camera", "target", list(np.ravel(target)), "no direction from there", "look at another point")
    return Camera(
        position=place,
        yaw=float(np.degrees(np.arctan2(towards[0], towards[1])) % 360.0),
        pitch=float(np.degrees(np.arctan2(towards[2], np.hypot(towards[0], towards[1])))),
        horizontal_field_of_view=horizontal_field_of_view,
    )


def station_camera(scene: Scene, name: str, *, horizontal_field_of_view: float | None = None) -> Camera:
    """The scene's camera of that name, with its own field of view or the one given [deg]."""
    station = scene.camera(name)
    field = station.horizontal_field_of_view if horizontal_field_of_view is None else horizontal_field_of_view
    return look_at(station.position(scene.frame), station.target(scene.frame), field)


def clip_distances(
    camera: Camera, size: tuple[int, int], lowest: FloatArray, highest: FloatArray
) -> tuple[float, float]:
    """Near and far clip plane [m] for a scene within the box `lowest` to `highest` (3,).

    The near plane is as far as the scene allows, since the depth buffer's resolution goes with it. It is square to the
    view: what lies at a distance is nearer to it at the picture's corners, by the cosine of their angle.
    """
    corner = np.where(camera.position < lowest, lowest, np.minimum(camera.position, highest))
    nearest = float(np.linalg.norm(corner - camera.position))
    farthest = float(np.linalg.norm(np.maximum(np.abs(lowest - camera.position), np.abs(highest - camera.position))))
    cosine = 1.0 / float(np.linalg.norm([1.0, *camera.half_extent(size)]))
    near = max(0.5 * cosine, 0.5 * nearest * cosine)
    return near, max(1.1 * farthest, 2.0 * near)
