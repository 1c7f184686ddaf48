"""Laws that Planck's function has to obey."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from sensorsim.constants import (
    BOLTZMANN_CONSTANT,
    FIRST_RADIATION_CONSTANT,
    SECOND_RADIATION_CONSTANT,
    SPEED_OF_LIGHT,
)
from sensorsim.errors import NumericsError
from sensorsim.radiometry import spectral_radiance, spectral_radiance_derivative

WIEN_DISPLACEMENT = 2.897771955e-3  # [m K], CODATA 2018


@pytest.mark.parametrize("temperature", [150.0, 300.0, 5772.0])
def test_radiance_peaks_where_wien_says(temperature):
    expected = WIEN_DISPLACEMENT / temperature
    found = minimize_scalar(
        lambda wavelength: -np.log(spectral_radiance(wavelength * expected, temperature)),
        bounds=(0.5, 2.0),
        method="bounded",
        options={"xatol": 1e-10},
    )
    assert found.x == pytest.approx(1.0, abs=1e-7)


def test_long_waves_follow_rayleigh_and_jeans():
    wavelength, temperature = 1.0, np.array([150.0, 300.0, 700.0])
    classical = 2.0 * SPEED_OF_LIGHT * BOLTZMANN_CONSTANT * temperature / wavelength**4
    first_order = classical * (1.0 - SECOND_RADIATION_CONSTANT / (2.0 * wavelength * temperature))
    assert spectral_radiance(wavelength, temperature) == pytest.approx(first_order, rel=1e-8)


def test_short_waves_follow_wien():
    wavelength, temperature = 0.9e-6, np.array([150.0, 300.0, 400.0])
    wien = FIRST_RADIATION_CONSTANT / wavelength**5 * np.exp(-SECOND_RADIATION_CONSTANT / (wavelength * temperature))
    assert spectral_radiance(wavelength, temperature) == pytest.approx(wien, rel=1e-12)


def test_extremes_neither_overflow_nor_warn():
    assert spectral_radiance(1e-9, 1.0) == 0.0
    assert spectral_radiance_derivative(1e-9, 1.0) == 0.0
    assert np.isfinite(spectral_radiance(1e3, 1e6))
    assert np.isfinite(spectral_radiance_derivative(1e3, 1e6))


def test_derivative_is_the_slope():
    wavelength = np.geomspace(0.8e-6, 100e-6, 40)[:, None]
    temperature = np.array([150.0, 290.0, 700.0])
    step = 1e-3
    rise = spectral_radiance(wavelength, temperature + step) - spectral_radiance(wavelength, temperature - step)
    assert spectral_radiance_derivative(wavelength, temperature) == pytest.approx(rise / (2.0 * step), rel=1e-6)


def test_printed_constant_of_the_report_is_half_that_of_radiance():
    printed = 0.59544e-12 * 1e-4  # W cm2 -> W m2, [Report1978] eq. 11
    assert pytest.approx(2.0 * printed, rel=2e-4) == FIRST_RADIATION_CONSTANT


def test_wavelength_and_temperature_broadcast():
    assert spectral_radiance(np.full((4, 1), 1e-5), np.full((2, 1, 3), 300.0)).shape == (2, 4, 3)


@pytest.mark.parametrize("temperature", [0.0, -1.0, np.nan, np.inf])
def test_impossible_temperature_is_refused(temperature):
    with pytest.raises(NumericsError, match=r"temperature \[K\] = .* \(1 of 2 values\)"):
        spectral_radiance(1e-5, [300.0, temperature])


def test_impossible_wavelength_is_refused():
    with pytest.raises(NumericsError, match=r"wavelength \[m\] = -1e-05"):
        spectral_radiance_derivative(-1e-5, 300.0)
