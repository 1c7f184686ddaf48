"""What a detector remembers of the last picture: bolometers warm slowly, tubes keep a share of their charge."""

import math

from sensorsim.radiometry import FloatArray
from sensorsim.sensor.sensor import Sensor

KEPT_TOGETHER = 4.0  # frame periods, beyond which a picture is not one of the same run


def follows_in_time(sensor: Sensor, before: float, now: float) -> bool:
    """Whether a picture may remember one of another time of the day [s]: both within a few frames of the sensor."""
    return abs(now - before) * sensor.scan.frame_rate <= KEPT_TOGETHER


def renewed_share(sensor: Sensor) -> float:
    """Share [-] of a picture that is new one frame later: 1 - exp(-dt / tau) of a bolometer, 1 - lag of a tube."""
    if sensor.detector is None:
        return 1.0
    share = 1.0 - sensor.detector.lag
    if sensor.detector.response_time > 0.0:
        share *= -math.expm1(-1.0 / (sensor.scan.frame_rate * sensor.detector.response_time))
    return share


def remember(last: FloatArray, light: FloatArray, share: float) -> FloatArray:
    """The picture that is held [W m-2 sr-1] after a new one; the NumPy twin of shaders/sensor/remember.frag."""
    return last + share * (light - last)
