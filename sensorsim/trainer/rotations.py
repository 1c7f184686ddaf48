"""Attitudes as matrices. Body axes are forward, right, down; local axes are east, north, up; both are right-handed.

An attitude is a matrix (3, 3) that takes body axes into the axes it stands in. Angles are yaw about down, then pitch
about right, then roll about forward [deg]: heading, nose up, right wing down of a body in north, east, down axes.
"""

import math
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray: TypeAlias = NDArray[np.float64]
Angles: TypeAlias = tuple[float, float, float]  # yaw, pitch, roll [deg]

ENU_FROM_NED: FloatArray = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
SMALL_TURN = 1e-3  # [rad]: below it two terms of each series are good to 1e-11


def attitude(angles: Angles) -> FloatArray:
    """Body axes in the axes they stand in (forward, right, down or north, east, down), of yaw, pitch, roll [deg]."""
    yaw, pitch, roll = (math.radians(angle) for angle in angles)
    sy, cy, sp, cp, sr, cr = (f(angle) for angle in (yaw, pitch, roll) for f in (math.sin, math.cos))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def angles_of(matrix: FloatArray) -> Angles:
    """Yaw 0 to 360, pitch -90 to 90 and roll -180 to 180 [deg] of an attitude; straight up or down, roll is 0."""
    pitch = math.degrees(math.asin(max(-1.0, min(1.0, -float(matrix[2, 0])))))
    if math.hypot(float(matrix[0, 0]), float(matrix[1, 0])) < 1e-12:
        return math.degrees(math.atan2(-matrix[0, 1], matrix[1, 1])) % 360.0, pitch, 0.0
    yaw = math.degrees(math.atan2(matrix[1, 0], matrix[0, 0])) % 360.0
    return yaw, pitch, math.degrees(math.atan2(matrix[2, 1], matrix[2, 2]))


def turned(rate: FloatArray, time: float) -> FloatArray:
    """Rotation (3, 3) after `time` [s] of a steady angular velocity (3,) [rad s-1] in the axes that turn."""
    cross, angle = _cross(rate, time)
    if angle < SMALL_TURN:
        return np.asarray(np.eye(3) + (1.0 - angle**2 / 6.0) * cross + (0.5 - angle**2 / 24.0) * cross @ cross)
    half = math.sin(0.5 * angle)
    return np.asarray(np.eye(3) + math.sin(angle) / angle * cross + 2.0 * (half / angle) ** 2 * cross @ cross)


def travelled(rate: FloatArray, time: float) -> FloatArray:
    """Integral (3, 3) [s] of `turned` over time: it takes a steady velocity of the turning axes into the way made."""
    cross, angle = _cross(rate, time)
    if angle < SMALL_TURN:
        return np.asarray(time * (np.eye(3) + (0.5 - angle**2 / 24.0) * cross + (1.0 / 6.0) * cross @ cross))
    half = math.sin(0.5 * angle)
    lag = (angle - math.sin(angle)) / angle**3
    return np.asarray(time * (np.eye(3) + 2.0 * (half / angle) ** 2 * cross + lag * cross @ cross))


def travelled_faster(rate: FloatArray, time: float) -> FloatArray:
    """Integral (3, 3) [s2] of time times `turned`: it takes a steady acceleration of the turning axes into a way."""
    cross, angle = _cross(rate, time)
    if angle < SMALL_TURN:
        first, second = 1.0 / 3.0 - angle**2 / 30.0, 0.125
    else:
        sine, cosine = math.sin(angle), math.cos(angle)
        first = (sine - angle * cosine) / angle**3
        second = (0.5 * angle**2 + 1.0 - cosine - angle * sine) / angle**4
    return np.asarray(time**2 * (0.5 * np.eye(3) + first * cross + second * cross @ cross))


def _cross(rate: FloatArray, time: float) -> tuple[FloatArray, float]:
    """Cross-product matrix of the turn made, and its angle [rad]."""
    x, y, z = (float(part) * time for part in rate)
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]), math.sqrt(x * x + y * y + z * z)
