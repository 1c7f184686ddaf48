"""Optical transfer functions in closed form: contrast that is left of a sine wave of `f` cycles per radian.

All take frequencies of any shape and are 1 at frequency 0. Obscured pupils after [ONeill1956], defocus after
[Hopkins1955]: both were put together anew and are held to sums over two shifted pupils. The rest are transforms of
their own profiles, as in [PyBSM2025].
"""

import numpy as np
import numpy.typing as npt
from scipy.special import jv

from sensorsim.radiometry import FloatArray, SpectralBand, band_quadrature, spectral_radiance

ADAPTED_TO = 300.0  # [K] blackbody that weighs wavelengths of emissive bands; it moves the function by 1e-3 in 50 K
HOPKINS_TERMS = 40
SOLAR_TEMPERATURE = 5772.0  # [K] of the spectrum that weighs reflective bands [Prsa2016]


def diffraction(frequency: npt.ArrayLike, wavelength: float, aperture: float, obscuration: float = 0.0) -> FloatArray:
    """Circular pupil, with a central stop of `obscuration` times its diameter [ONeill1956]."""
    x = np.abs(np.asarray(frequency, dtype=np.float64)) * wavelength / aperture
    if obscuration <= 0.0:
        return _overlap(x)
    o = obscuration
    both = _overlap(x) + o**2 * _overlap(x / o) - 2.0 * _lens(x, o)
    return np.asarray(both / (1.0 - o**2))


def _overlap(x: FloatArray) -> FloatArray:
    """Common area of two unit-diameter circles `x` apart over that of one."""
    inside = np.clip(x, 0.0, 1.0)
    return np.asarray(2.0 / np.pi * (np.arccos(inside) - inside * np.sqrt(1.0 - inside**2)))


def _lens(x: FloatArray, o: float) -> FloatArray:
    """Common area of circles of diameter 1 and `o`, centres `x` apart, over that of the first."""
    distance = 2.0 * x  # in radii of the first
    d = np.clip(distance, 1.0 - o + 1e-12, 1.0 + o)
    first = np.arccos(np.clip((d**2 + o**2 - 1.0) / (2.0 * d * o), -1.0, 1.0))
    second = np.arccos(np.clip((d**2 + 1.0 - o**2) / (2.0 * d), -1.0, 1.0))
    kite = np.sqrt(np.maximum((-d + o + 1.0) * (d + o - 1.0) * (d - o + 1.0) * (d + o + 1.0), 0.0))
    area = (o**2 * first + second - 0.5 * kite) / np.pi
    return np.asarray(np.where(distance <= 1.0 - o, o**2, np.where(distance >= 1.0 + o, 0.0, area)))


def defocus(frequency: npt.ArrayLike, wavelength: float, aperture: float, error: float) -> FloatArray:
    """Contrast of a defocused circular pupil over that of a focused one; `error` [m] is the wavefront's at its edge.

    [Hopkins1955]: with s = 2 f lambda / D, beta = arccos(s / 2) and a = 4 pi (w / lambda) s it is, before division,
    4 / (pi a) [cos(a s / 2) (beta J1(a) + sum_n (-1)^(n+1) sin(2 n beta) / (2 n) (J_{2n-1}(a) - J_{2n+1}(a)))
                - sin(a s / 2) sum_n (-1)^n sin((2n+1) beta) / (2n+1) (J_{2n}(a) - J_{2n+2}(a))].
    """
    f = np.abs(np.asarray(frequency, dtype=np.float64))
    s = np.clip(2.0 * f * wavelength / aperture, 0.0, 2.0)
    a = 4.0 * np.pi * error / wavelength * s
    beta = np.arccos(s / 2.0)
    even, odd = beta * jv(1, a), np.zeros_like(s)
    for n in range(1, HOPKINS_TERMS + 1):
        even += (-1.0) ** (n + 1) * np.sin(2 * n * beta) / (2 * n) * (jv(2 * n - 1, a) - jv(2 * n + 1, a))
    for n in range(HOPKINS_TERMS + 1):
        odd += (-1.0) ** n * np.sin((2 * n + 1) * beta) / (2 * n + 1) * (jv(2 * n, a) - jv(2 * n + 2, a))
    focused = _overlap(s / 2.0)
    usable = (a > 1e-6) & (focused > 1e-9)
    value = 4.0 / (np.pi * np.where(usable, a, 1.0)) * (np.cos(a * s / 2.0) * even - np.sin(a * s / 2.0) * odd)
    return np.asarray(np.where(usable, value / np.where(usable, focused, 1.0), 1.0))


def band_average(
    band: SpectralBand, mode: str, frequency: npt.ArrayLike, aperture: float, obscuration: float, error: float
) -> FloatArray:
    """Diffraction and defocus over a band, weighed by response times the light that the band is made for."""
    f = np.asarray(frequency, dtype=np.float64)
    wavelength, weight = band_quadrature(band)
    weight = weight * spectral_radiance(wavelength, ADAPTED_TO if mode == "emissive" else SOLAR_TEMPERATURE)
    total = np.zeros(f.shape)
    for length, share in zip(wavelength, weight / weight.sum(), strict=True):
        one = diffraction(f, float(length), aperture, obscuration)
        total += share * (one if error <= 0.0 else one * defocus(f, float(length), aperture, error))
    return total


def box(frequency: npt.ArrayLike, width: float) -> FloatArray:
    """Average over `width` [rad]: a detector, a drift, a sample held."""
    return np.asarray(np.sinc(width * np.asarray(frequency, dtype=np.float64)))


def gaussian_blur(frequency: npt.ArrayLike, width: float) -> FloatArray:
    """exp(-pi (f width)^2), `width` [rad]."""
    return np.asarray(np.exp(-np.pi * (np.asarray(frequency, dtype=np.float64) * width) ** 2))


def random_motion(frequency: npt.ArrayLike, deviation: float) -> FloatArray:
    """exp(-2 pi^2 s^2 f^2) of random motion with a standard deviation [rad]."""
    return np.asarray(np.exp(-2.0 * (np.pi * deviation * np.asarray(frequency, dtype=np.float64)) ** 2))


def low_pass(frequency: npt.ArrayLike, cutoff: float) -> FloatArray:
    """Amplitude of a one-pole response with a cut-off [cycles/rad] along the scan."""
    return np.asarray(1.0 / np.sqrt(1.0 + (np.asarray(frequency, dtype=np.float64) / cutoff) ** 2))
