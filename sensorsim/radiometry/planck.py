"""Planck's law for spectral radiance and its slope in temperature [Planck1901], [Report1978] eq. 11.

The report prints c1 = 0.59544e-12 W cm2, which is h c^2 (5.9552e-17 W m2). Hemispherical exitance needs 2 pi h c^2 and
radiance, which is what a sensor collects per steradian, needs 2 h c^2 = 1.191043e-16 W m2 sr-1. This module uses the
last, `FIRST_RADIATION_CONSTANT`; the printed number taken as it stands would give half the radiance.
"""

import numpy as np
import numpy.typing as npt

from sensorsim.constants import FIRST_RADIATION_CONSTANT, SECOND_RADIATION_CONSTANT
from sensorsim.errors import NumericsError

FloatArray = npt.NDArray[np.float64]


def spectral_radiance(wavelength: npt.ArrayLike, temperature: npt.ArrayLike) -> FloatArray:
    """Blackbody spectral radiance [W m-2 sr-1 m-1]; wavelength [m] and temperature [K] broadcast. [CODATA2018]

    Raises NumericsError where a wavelength or a temperature is not finite and positive.
    """
    metres, exponent, _ = _exponent(wavelength, temperature)
    # exp(-x) / (1 - exp(-x)) in place of 1 / (exp(x) - 1): it fades to zero in Wien's limit instead of overflowing.
    occupation = np.exp(-exponent) / -np.expm1(-exponent)
    return np.asarray(FIRST_RADIATION_CONSTANT / metres**5 * occupation)


def spectral_radiance_derivative(wavelength: npt.ArrayLike, temperature: npt.ArrayLike) -> FloatArray:
    """Temperature derivative of `spectral_radiance` [W m-2 sr-1 m-1 K-1]; same shapes and errors. [CODATA2018]"""
    metres, exponent, kelvin = _exponent(wavelength, temperature)
    slope = exponent / kelvin * np.exp(-exponent) / np.expm1(-exponent) ** 2
    return np.asarray(FIRST_RADIATION_CONSTANT / metres**5 * slope)


def _exponent(wavelength: npt.ArrayLike, temperature: npt.ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Wavelength [m], c2 / (wavelength temperature) [-] and temperature [K], checked."""
    metres = _positive("wavelength [m]", wavelength)
    kelvin = _positive("temperature [K]", temperature)
    return metres, SECOND_RADIATION_CONSTANT / (metres * kelvin), kelvin


def _positive(name: str, values: npt.ArrayLike) -> FloatArray:
    array = np.asarray(values, dtype=np.float64)
    good = np.isfinite(array) & (array > 0.0)
    if not good.all():
        bad = array[~good].flat[0]
        raise NumericsError(f"{name} = {bad}: must be finite and above zero ({np.sum(~good)} of {array.size} values)")
    return array
