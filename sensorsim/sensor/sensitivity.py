"""What the detector makes of radiance: electrons, noise, and the temperature difference that equals the noise.

A band's response is per unit of energy, so that the electrons of a photon detector are proportional to band radiance
exactly: N = t A Omega eta lambda_p / (h c) L, with the quantum efficiency eta at the peak's wavelength lambda_p. The
variance of one look, referred to radiance, is a straight line in radiance: shot noise over what is always there.
Photon detectors as in [PyBSM2025]; D* by its definition, sqrt(area bandwidth) over the power that equals the noise.
"""

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from sensorsim.constants import PLANCK_CONSTANT, SPEED_OF_LIGHT
from sensorsim.errors import InputError
from sensorsim.radiometry import FloatArray, band_radiance, band_radiance_derivative
from sensorsim.sensor.sensor import Sensor

STATED_AT = 300.0  # [K] of a NETD


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensitivity:
    """One look at band radiance L [W m-2 sr-1]: variance constant + shot L [W2 m-4 sr-2], then counts up to `full`."""

    constant: float  # [W2 m-4 sr-2]
    shot: float  # [W m-2 sr-1]
    full: float  # band radiance of the highest count [W m-2 sr-1]
    step: float  # from one count to the next [W m-2 sr-1]

    def deviation(self, radiance: npt.ArrayLike) -> FloatArray:
        """Standard deviation [W m-2 sr-1] of one look at a band radiance, any shape, before it is rounded to counts."""
        light = np.maximum(np.asarray(radiance, dtype=np.float64), 0.0)
        return np.asarray(np.sqrt(self.constant + self.shot * light))

    def stopped(self, exposure: float) -> "Sensitivity":
        """The same with a share of the light, as an iris, a shorter exposure or a lower gain has it."""
        return Sensitivity(
            constant=self.constant / exposure**2,
            shot=self.shot / exposure,
            full=self.full / exposure,
            step=self.step / exposure,
        )


def sensitivity(sensor: Sensor) -> Sensitivity:
    """What the sensor's detector makes of radiance; InputError for an ideal sensor, which has none."""
    if sensor.detector is None or sensor.optics is None:
        raise InputError(f"sensor {sensor.name!r}", "detector", None, "not described", "add [optics] and [detector]")
    detector, optics, variance = sensor.detector, sensor.optics, sensor.noise.random**2
    area = detector.width * detector.height
    highest = 2**detector.bits - 1
    if detector.kind == "photon":
        peak = float(sensor.band.wavelength[np.argmax(sensor.band.response)])
        per_energy = detector.quantum_efficiency * peak / (PLANCK_CONSTANT * SPEED_OF_LIGHT)
        electrons = detector.integration_time * area * optics.light_share * per_energy  # [W-1 m2 sr]
        dark = detector.excess_noise * detector.dark_current * detector.integration_time
        constant, full = (dark + detector.read_noise**2) / electrons**2, detector.well / electrons
        shot = detector.excess_noise / electrons
        return Sensitivity(constant=variance * constant, shot=variance * shot, full=full, step=full / highest)
    if detector.kind == "detectivity":
        equivalent = math.sqrt(detector.bandwidth / area) / (optics.light_share * detector.detectivity)
    else:
        equivalent = detector.netd * float(band_radiance_derivative(sensor.band, STATED_AT))
    full = float(band_radiance(sensor.band, detector.saturation))
    return Sensitivity(constant=variance * equivalent**2, shot=0.0, full=full, step=full / highest)


def netd(sensor: Sensor, temperature: float = STATED_AT) -> float:
    """Noise-equivalent temperature difference [K] of one look, counts and all, at a black body of a temperature [K]."""
    look = sensitivity(sensor)
    deviation = look.deviation(band_radiance(sensor.band, temperature))
    total = np.hypot(deviation, look.step / math.sqrt(12.0))
    return float(total / band_radiance_derivative(sensor.band, temperature))
