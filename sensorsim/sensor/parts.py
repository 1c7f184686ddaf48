"""The parts of a sensor's chain that can be left out: which ones it has, and the sensor without some of them."""

from collections.abc import Collection
from dataclasses import replace

from sensorsim.sensor.memory import renewed_share
from sensorsim.sensor.noise import Noise
from sensorsim.sensor.sensor import Sensor

SHARP = 0.0  # energy of a blur that is none, for `blur_kernel`


def sensor_parts(sensor: Sensor) -> frozenset[str]:
    """Names of the parts that a sensor has: blur and noise with a detector, memory, streaks and halo by its kind."""
    there = {
        "blur": sensor.detector is not None,
        "noise": sensor.detector is not None,
        "memory": renewed_share(sensor) < 1.0,
        "streaks": sensor.detector is not None and sensor.scan.ac_coupling > 0.0,
        "halo": sensor.intensifier is not None,
    }
    return frozenset(name for name, held in there.items() if held)


def sensor_without(sensor: Sensor, parts: Collection[str]) -> Sensor:
    """The sensor without noise, memory, streaks or halo; blur goes with an energy of SHARP."""
    if "noise" in parts:
        sensor = replace(sensor, noise=Noise(random=0.0))
    if "memory" in parts and sensor.detector is not None:
        sensor = replace(sensor, detector=replace(sensor.detector, response_time=0.0, lag=0.0))
    if "streaks" in parts:
        sensor = replace(sensor, scan=replace(sensor.scan, ac_coupling=0.0))
    return replace(sensor, intensifier=None) if "halo" in parts else sensor
