"""Sensors: the band they see, their mode, field of view and size, and the display that turns radiance into grey."""

from sensorsim.sensor.display import (
    DisplaySettings,
    auto_window,
    display_code,
    fix_window,
    grey_level,
    window_from_temperatures,
    window_limits,
)
from sensorsim.sensor.load import load_sensor, sensor_names
from sensorsim.sensor.sensor import Sensor

__all__ = [
    "DisplaySettings",
    "Sensor",
    "auto_window",
    "display_code",
    "fix_window",
    "grey_level",
    "load_sensor",
    "sensor_names",
    "window_from_temperatures",
    "window_limits",
]
