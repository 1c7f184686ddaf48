"""Sensors of the pictures of effects: those that come with the package, and some with a fault or a coarse raster."""

from collections.abc import Callable, Mapping
from dataclasses import replace

from sensorsim.sensor import Sensor, load_sensor


def _blind(sensor: Sensor) -> Sensor:
    return replace(sensor, noise=replace(sensor.noise, dead=0.003))


def _repaired(sensor: Sensor) -> Sensor:
    return replace(sensor, noise=replace(sensor.noise, dead=0.003, replaced=True))


def _coarse(sensor: Sensor) -> Sensor:
    return replace(sensor, scan=replace(sensor.scan, lines=80))


def _blooming(sensor: Sensor) -> Sensor:
    if sensor.detector is None:
        return sensor
    return replace(sensor, detector=replace(sensor.detector, blooming=0.5))


VARIANTS: Mapping[str, tuple[str, Callable[[Sensor], Sensor], str]] = {
    "uncooled, blind": ("uncooled", _blind, "with 0.3 % of its elements dead"),
    "uncooled, repaired": ("uncooled", _repaired, "with 0.3 % of its elements dead and replaced"),
    "emccd, blooming": ("emccd", _blooming, "whose wells spill half of what they cannot hold"),
    "sit1977, coarse": ("sit1977", _coarse, "with a raster of 80 lines"),
}


def study_sensor(name: str) -> Sensor:
    """A sensor by its name, or one of VARIANTS, whose title says what was changed."""
    if name not in VARIANTS:
        return load_sensor(name)
    base, change, words = VARIANTS[name]
    sensor = change(load_sensor(base))
    return replace(sensor, title=f"{sensor.title}, {words}")
