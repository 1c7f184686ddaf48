"""Optical transfer functions against the autocorrelation of the pupil and other independent sums."""

import numpy as np
import pytest

from sensorsim.radiometry import flat_band
from sensorsim.sensor import transfer

WAVELENGTH, APERTURE = 10e-6, 0.1
CUTOFF = APERTURE / WAVELENGTH


def autocorrelation(x, waves, obscuration=0.0, points=1501):
    """Transfer function at a share `x` of the cut-off, by sums over a grid of two shifted pupils of unit radius."""
    line = np.linspace(-1.0, 1.0, points)
    across, along = np.meshgrid(line, line)

    def pupil(shift):
        square = (across + shift) ** 2 + along**2
        return ((square <= 1.0) & (square >= obscuration**2)) * np.exp(2j * np.pi * waves * square)

    return float((pupil(x) * np.conj(pupil(-x))).sum().real / np.abs(pupil(0.0)).sum())


@pytest.mark.parametrize("x", [0.05, 0.3, 0.6, 0.9])
@pytest.mark.parametrize("obscuration", [0.0, 0.4])
def test_diffraction_is_the_autocorrelation_of_the_pupil(x, obscuration):
    computed = float(transfer.diffraction(x * CUTOFF, WAVELENGTH, APERTURE, obscuration))
    assert computed == pytest.approx(autocorrelation(x, 0.0, obscuration), abs=2e-4)


@pytest.mark.parametrize("waves", [0.25, 0.5, 1.0])
@pytest.mark.parametrize("x", [0.1, 0.3, 0.6, 0.9])
def test_defocus_is_the_autocorrelation_of_a_curved_pupil(x, waves):
    frequency = np.array([x * CUTOFF])
    focused = transfer.diffraction(frequency, WAVELENGTH, APERTURE)
    computed = focused * transfer.defocus(frequency, WAVELENGTH, APERTURE, waves * WAVELENGTH)
    assert computed[0] == pytest.approx(autocorrelation(x, waves), abs=2e-4)


@pytest.mark.parametrize("obscuration", [0.0, 0.3, 0.9])
def test_diffraction_is_one_at_rest_and_nothing_from_the_cut_off_on(obscuration):
    ends = transfer.diffraction(np.array([0.0, CUTOFF, 3.0 * CUTOFF]), WAVELENGTH, APERTURE, obscuration)
    assert ends == pytest.approx([1.0, 0.0, 0.0], abs=1e-12)


def test_defocus_without_error_and_at_rest_is_one():
    frequency = np.linspace(0.0, 1.5 * CUTOFF, 40)
    assert transfer.defocus(frequency, WAVELENGTH, APERTURE, 0.0).tolist() == [1.0] * 40
    assert transfer.defocus(np.zeros(1), WAVELENGTH, APERTURE, 1e-5)[0] == 1.0


def test_band_average_of_a_narrow_band_is_that_of_its_wavelength():
    band = flat_band("narrow", 9.9999e-6, 10.0001e-6)
    frequency = np.linspace(0.0, CUTOFF, 30)
    average = transfer.band_average(band, "emissive", frequency, APERTURE, 0.2, 3e-6)
    one = transfer.diffraction(frequency, WAVELENGTH, APERTURE, 0.2)
    one = one * transfer.defocus(frequency, WAVELENGTH, APERTURE, 3e-6)
    assert average == pytest.approx(one, abs=1e-5)


@pytest.mark.parametrize(
    ("function", "profile"),
    [
        (lambda f: transfer.box(f, 0.4), lambda x: np.where(np.abs(x) <= 0.2, 1.0, 0.0)),
        (lambda f: transfer.gaussian_blur(f, 0.3), lambda x: np.exp(-np.pi * (x / 0.3) ** 2)),
        (lambda f: transfer.random_motion(f, 0.1), lambda x: np.exp(-0.5 * (x / 0.1) ** 2)),
    ],
)
def test_functions_are_the_transforms_of_their_profiles(function, profile):
    x = (np.arange(200000) + 0.5) / 200000 * 8.0 - 4.0
    shape = profile(x) / profile(x).sum()
    for frequency in (0.0, 0.7, 1.9, 4.0):
        assert float(function(frequency)) == pytest.approx(
            float((shape * np.cos(2 * np.pi * frequency * x)).sum()), abs=1e-4
        )


def test_low_pass_is_down_to_half_its_power_at_the_cut_off():
    assert float(transfer.low_pass(7.0, 7.0)) ** 2 == pytest.approx(0.5, rel=1e-12)
