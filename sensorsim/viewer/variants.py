"""The same sensor with its noise or its blur switched off, as another description of a sensor."""

from dataclasses import replace

from sensorsim.sensor import Sensor
from sensorsim.sensor.detector import LIMITS, Detector
from sensorsim.sensor.noise import Noise

QUIET_NOISE = Noise()


def varied(sensor: Sensor, *, noise: bool, blur: bool) -> Sensor:
    """The sensor with or without noise and blur; an ideal sensor has neither to begin with.

    Without noise its detector is the quietest there can be, with the same full signal and the same counts, and all
    its elements are alike. Without blur the lens is free of faults and motion and the electronics are fast: what is
    left is diffraction and the size of the elements.
    """
    if sensor.detector is None or sensor.optics is None:
        return sensor
    if not noise:
        quiet = replace(QUIET_NOISE, seed=sensor.noise.seed, corrected_at=sensor.noise.corrected_at)
        sensor = replace(sensor, noise=quiet, detector=_quiet(sensor.detector))
    if not blur and sensor.optics is not None and sensor.detector is not None:
        sensor = replace(
            sensor,
            optics=replace(sensor.optics, defocus=0.0, blur=0.0, jitter=0.0, drift=0.0),
            scan=replace(sensor.scan, electronics=0.0),
            detector=replace(sensor.detector, response_time=0.0, lag=0.0),
        )
    return sensor


def _quiet(detector: Detector) -> Detector:
    """The detector with as little noise as a description may have."""
    if detector.kind == "thermal":
        return replace(detector, netd=LIMITS["netd"][0])
    if detector.kind == "detectivity":
        return replace(detector, detectivity=LIMITS["detectivity"][1])
    longer = min(LIMITS["well"][1] / detector.well, LIMITS["integration_time"][1] / detector.integration_time)
    return replace(
        detector,
        integration_time=longer * detector.integration_time,  # with the well, so that what fills it stays
        well=longer * detector.well,
        read_noise=0.0,
        dark_current=0.0,
    )
