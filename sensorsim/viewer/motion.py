"""How a camera moves: flying, looking around, circling a point, and its lens. No window, no OpenGL.

Every function takes a camera and gives a new one. Speeds are in metres and degrees per second, so that the same
flight comes out of few frames or many.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from sensorsim.radiometry import FloatArray
from sensorsim.render import Camera, look_at

FAST = 5.0  # times the speed, while the key for it is down
LOOK_RATE = 45.0  # [deg s-1] of keys and sticks at a field of view of 60 deg
STEEPEST = 89.0  # [deg] so that there always is an up
LOWEST = 1.5  # [m] above the scene's ground: the eye of a person
FARTHEST = 200_000.0  # [m] from the scene's origin
NARROWEST, WIDEST = 0.5, 120.0  # [deg] field of view
SPEEDS = (0.5, 5000.0)  # [m s-1]
DEAD_ZONE = 0.15  # of a stick, which never quite comes to rest


@dataclass(frozen=True, slots=True, kw_only=True)
class Motion:
    """What the pilot asks for, each from -1 to 1."""

    forward: float = 0.0
    right: float = 0.0
    up: float = 0.0
    yaw: float = 0.0
    pitch: float = 0.0
    zoom: float = 0.0  # to a narrower field
    fast: bool = False

    def __add__(self, other: "Motion") -> "Motion":
        """Both at once, no more than full."""
        names = ("forward", "right", "up", "yaw", "pitch", "zoom")
        both = {name: max(-1.0, min(1.0, getattr(self, name) + getattr(other, name))) for name in names}
        return Motion(**both, fast=self.fast or other.fast)


def fly(camera: Camera, motion: Motion, speed: float, seconds: float) -> Camera:
    """The camera after `seconds` of a motion at a speed [m s-1]: forward is where it looks, up is up."""
    forward, right, _ = camera.axes()
    way = motion.forward * forward + motion.right * right + motion.up * np.array([0.0, 0.0, 1.0])
    distance = speed * seconds * (FAST if motion.fast else 1.0)
    angle = look_step(camera, seconds)
    moved = replace(camera, position=kept_in(camera.position + distance * way))
    turned = turn(moved, motion.yaw * angle, motion.pitch * angle)
    return zoom(turned, _zoom_factor(motion, seconds))


def look_step(camera: Camera, seconds: float) -> float:
    """Angle [deg] that a key turns the camera by: less through a long lens."""
    return LOOK_RATE * seconds * min(1.0, camera.horizontal_field_of_view / 60.0)


def kept_in(position: FloatArray) -> FloatArray:
    """The position, not below a person's eye and not out of the world."""
    held = np.clip(position, -FARTHEST, FARTHEST)
    return np.array([held[0], held[1], max(float(held[2]), LOWEST)])


def turn(camera: Camera, yaw: float, pitch: float) -> Camera:
    """The camera turned clockwise and up by angles [deg]."""
    steep = max(-STEEPEST, min(STEEPEST, camera.pitch + pitch))
    return replace(camera, yaw=(camera.yaw + yaw) % 360.0, pitch=steep)


def drag(camera: Camera, right: float, down: float, width: float) -> Camera:
    """The camera after the picture, `width` pixels wide, was dragged by pixels: what is under the mouse stays."""
    half = math.radians(0.5 * camera.horizontal_field_of_view)
    angle = math.degrees(2.0 * math.tan(half) / max(width, 1.0))
    return turn(camera, -right * angle, down * angle)


def circle(camera: Camera, target: FloatArray, motion: Motion, speed: float, seconds: float) -> Camera:
    """The camera moved around `target` (3,), which stays in the middle: right and up turn, forward comes closer.

    Never through the target, never straight above it, never below the ground.
    """
    away = camera.position - target
    distance = max(float(np.linalg.norm(away)), 1.0)
    step = math.degrees(speed * seconds * (FAST if motion.fast else 1.0) / distance)
    azimuth = math.degrees(math.atan2(away[0], away[1])) - step * motion.right
    height = math.degrees(math.asin(max(-1.0, min(1.0, away[2] / distance)))) + step * motion.up
    distance *= math.exp(-motion.forward * seconds * (2.0 if motion.fast else 0.7))
    distance = max(2.0 * LOWEST, min(distance, FARTHEST))
    ground = math.degrees(math.asin(max(-1.0, min(1.0, (LOWEST - float(target[2])) / distance))))
    height = min(max(height, ground, -STEEPEST), STEEPEST - 4.0)
    a, h = math.radians(azimuth), math.radians(height)
    place = target + distance * np.array([math.sin(a) * math.cos(h), math.cos(a) * math.cos(h), math.sin(h)])
    kept = kept_in(np.asarray(place, dtype=np.float64))
    if float(np.linalg.norm(kept[:2] - target[:2])) < 1e-3:
        return camera
    return zoom(look_at(kept, target, camera.horizontal_field_of_view), _zoom_factor(motion, seconds))


def zoom(camera: Camera, factor: float) -> Camera:
    """The camera with its field of view times a factor, within what its lens does."""
    field = max(NARROWEST, min(WIDEST, camera.horizontal_field_of_view * factor))
    return replace(camera, horizontal_field_of_view=field)


def _zoom_factor(motion: Motion, seconds: float) -> float:
    """Half the field in a second."""
    return math.pow(0.5, motion.zoom * seconds)


def wheel_speed(speed: float, notches: float) -> float:
    """Speed [m s-1] after notches of the wheel: a quarter more for each."""
    return max(SPEEDS[0], min(SPEEDS[1], speed * math.pow(1.25, notches)))


def point_ahead(camera: Camera, distance: float | None) -> FloatArray:
    """The point (3,) in the picture's middle at a distance [m]; where that is None, the ground or 200 m ahead."""
    forward, _, _ = camera.axes()
    if distance is None:
        down = -float(forward[2])
        distance = float(camera.position[2]) / down if down > 0.02 else 200.0
    return np.asarray(camera.position + distance * forward)


def stick_motion(axes: Sequence[float], buttons: Sequence[int]) -> Motion:
    """Motion of a gamepad in GLFW's order: left stick moves, right stick looks, triggers sink and climb.

    axes: left x, left y, right x, right y (down is positive), left and right trigger (-1 to 1); buttons: the first
    four are A, B, X, Y. A is fast, X and Y zoom.
    """
    if len(axes) < 6 or len(buttons) < 4:
        return Motion()
    left_x, left_y, right_x, right_y = (_alive(value) for value in axes[:4])
    climb = 0.5 * ((axes[5] + 1.0) - (axes[4] + 1.0))
    return Motion(
        forward=-left_y, right=left_x, up=_alive(climb), yaw=right_x, pitch=-right_y,
        zoom=float(bool(buttons[3])) - float(bool(buttons[2])), fast=bool(buttons[0]),
    )  # fmt: skip


def _alive(value: float) -> float:
    """A stick's value beyond its dead zone, from 0 there to 1."""
    if not math.isfinite(value) or abs(value) <= DEAD_ZONE:
        return 0.0
    return math.copysign(min(1.0, (abs(value) - DEAD_ZONE) / (1.0 - DEAD_ZONE)), value)
