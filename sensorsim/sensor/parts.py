"""The parts of a sensor's chain that can be left out: which ones it has, and the sensor without some of them."""

from collections.abc import Collection
from dataclasses import replace

from sensorsim.sensor.memory import renewed_share
from sensorsim.sensor.noise import Noise
from sensorsim.sensor.sensor import Sensor

SHARP = 0.0  # energy of a blur that is none, for `blur_kernel`


def sensor_parts(sensor: Sensor) -> frozenset[str]:
    """Names of the parts that a sensor has: blur and noise with a detector, the others by what its file says."""
    there = {
        "blur": sensor.detector is not None,
        "noise": sensor.detector is not None,
        "memory": renewed_share(sensor) < 1.0,
        "streaks": sensor.detector is not None and sensor.scan.ac_coupling > 0.0,
        "halo": sensor.intensifier is not None,
        "blooming": sensor.detector is not None and sensor.detector.blooming > 0.0,
        "dead_elements": sensor.detector is not None and sensor.noise.dead > 0.0,
        "replacement": sensor.detector is not None and sensor.noise.dead > 0.0 and sensor.noise.replaced,
        "interlace": sensor.detector is not None and sensor.scan.interlace > 1,
        "raster_lines": sensor.detector is not None and sensor.scan.lines > 0,
    }
    return frozenset(name for name, held in there.items() if held)


def sensor_without(sensor: Sensor, parts: Collection[str]) -> Sensor:
    """The sensor without parts of those names but blur, which goes with an energy of SHARP."""
    noise, scan = sensor.noise, sensor.scan
    if "noise" in parts:
        noise = Noise(random=0.0, dead=noise.dead, replaced=noise.replaced, seed=noise.seed)
    noise = replace(noise, dead=0.0) if "dead_elements" in parts else noise
    noise = replace(noise, replaced=False) if "replacement" in parts else noise
    scan = replace(scan, ac_coupling=0.0) if "streaks" in parts else scan
    scan = replace(scan, interlace=1) if "interlace" in parts else scan
    scan = replace(scan, lines=0) if "raster_lines" in parts else scan
    if "memory" in parts and sensor.detector is not None:
        sensor = replace(sensor, detector=replace(sensor.detector, response_time=0.0, lag=0.0))
    if "blooming" in parts and sensor.detector is not None:
        sensor = replace(sensor, detector=replace(sensor.detector, blooming=0.0))
    sensor = replace(sensor, intensifier=None) if "halo" in parts else sensor
    return replace(sensor, noise=noise, scan=scan)
