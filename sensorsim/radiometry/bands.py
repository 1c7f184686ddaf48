"""Spectral bands, blackbody radiance within a band, and apparent temperature.

Band radiance here is the effective one, int R(l) L(l, T) dl [W m-2 sr-1], with the response R normalised to a peak of
1; it is not divided by int R(l) dl. The report weighs four bands, all with flat response [Report1978] 3.2.
"""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from sensorsim.errors import InputError, NumericsError
from sensorsim.radiometry.planck import FloatArray, spectral_radiance, spectral_radiance_derivative

_PANEL_RATIO = 1.1  # widest panel of the quadrature, end over start; with 8 nodes 1e-11 down to 150 K at 0.8 um
_PANEL_NODES = 8


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SpectralBand:
    """A sensor's relative response against wavelength, straight between its points and zero outside them.

    wavelength (n,) [m], increasing; response (n,) [-], not negative, peak 1. Both are copied and made read-only.
    Raises InputError naming the entry that is out of order.
    """

    name: str
    wavelength: FloatArray
    response: FloatArray

    def __post_init__(self) -> None:
        for entry in ("wavelength", "response"):
            array = np.array(getattr(self, entry), dtype=np.float64)
            array.setflags(write=False)
            object.__setattr__(self, entry, array)
        problem = _band_problem(self.wavelength, self.response)
        if problem is not None:
            entry, text, remedy = problem
            raise InputError(f"spectral band {self.name!r}", entry, getattr(self, entry).tolist(), text, remedy)


def _band_problem(wavelength: FloatArray, response: FloatArray) -> tuple[str, str, str] | None:
    """Entry, problem and remedy of what is wrong with a response curve, or None."""
    if wavelength.ndim != 1 or wavelength.size < 2:
        return "wavelength", "fewer than two points", "give the band's two ends at least"
    if not (np.isfinite(wavelength).all() and (wavelength > 0.0).all()):
        return "wavelength", "not finite and above zero everywhere", "give wavelengths in metres"
    if not (np.diff(wavelength) > 0.0).all():
        return "wavelength", "does not increase", "list the band from its short end to its long end"
    if response.shape != wavelength.shape:
        return "response", f"has {response.size} values for {wavelength.size} wavelengths", "give one for each"
    if not (np.isfinite(response).all() and (response >= 0.0).all()):
        return "response", "not finite and zero or above everywhere", "mend the values"
    if not response.any():
        return "response", "zero everywhere, the sensor sees nothing", "give the band a response with peak 1"
    if abs(float(response.max()) - 1.0) > 1e-9:
        return "response", f"has a peak of {response.max():g}", "divide it by its peak so that the peak is 1"
    return None


def flat_band(name: str, shortest: float, longest: float) -> SpectralBand:
    """Band of response 1 from `shortest` to `longest` [m]."""
    return SpectralBand(name=name, wavelength=np.array([shortest, longest]), response=np.ones(2))


FLIR_BAND = flat_band("FLIR", 8.0e-6, 14.0e-6)
LLLTV_BAND = flat_band("LLLTV", 0.8e-6, 1.1e-6)
THERMAL_BAND = flat_band("thermal", 3.0e-6, 15.0e-6)
SOLAR_BAND = flat_band("solar", 0.2e-6, 3.0e-6)


def band_radiance(band: SpectralBand, temperature: npt.ArrayLike) -> FloatArray:
    """Effective blackbody radiance in the band [W m-2 sr-1] at temperature [K], any shape; errors of Planck's law."""
    kelvin = np.asarray(temperature, dtype=np.float64)
    total = np.zeros(kelvin.shape)
    # One node at a time: memory stays that of the answer, also for whole images.
    for wavelength, weight in zip(*band_quadrature(band), strict=True):
        total += weight * spectral_radiance(wavelength, kelvin)
    return total


def band_radiance_derivative(band: SpectralBand, temperature: npt.ArrayLike) -> FloatArray:
    """Temperature derivative of `band_radiance` [W m-2 sr-1 K-1]; same shapes and errors."""
    kelvin = np.asarray(temperature, dtype=np.float64)
    total = np.zeros(kelvin.shape)
    for wavelength, weight in zip(*band_quadrature(band), strict=True):
        total += weight * spectral_radiance_derivative(wavelength, kelvin)
    return total


def band_quadrature(band: SpectralBand) -> tuple[FloatArray, FloatArray]:
    """Nodes [m] and weights [m] of int R(l) f(l) dl: Gauss-Legendre in panels that end at the response's points."""
    node, weight = np.polynomial.legendre.leggauss(_PANEL_NODES)
    edges = [band.wavelength[:1]]
    for start, end in zip(band.wavelength[:-1], band.wavelength[1:], strict=True):
        panels = int(np.ceil(np.log(end / start) / np.log(_PANEL_RATIO)))
        edges.append(np.geomspace(start, end, panels + 1)[1:])
    edge = np.concatenate(edges)
    half = np.diff(edge)[:, None] / 2.0
    wavelength = (edge[:-1, None] + half * (node + 1.0)).ravel()
    response = np.interp(wavelength, band.wavelength, band.response)
    return wavelength, (half * weight).ravel() * response


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BandTable:
    """Band radiance tabulated uniformly in temperature, straight between the entries, as the shader looks it up.

    temperature (m,) [K]; radiance (m,) [W m-2 sr-1], increasing. `apparent_temperature` inverts this piecewise
    linear function exactly, so a round trip loses rounding only.
    """

    band: SpectralBand
    temperature: FloatArray
    radiance: FloatArray

    def radiance_at(self, temperature: npt.ArrayLike) -> FloatArray:
        """Band radiance [W m-2 sr-1] at temperature [K], any shape; NumericsError for NaN or outside the table."""
        return _lookup("temperature", "K", temperature, self.temperature, self.radiance)

    def apparent_temperature(self, radiance: npt.ArrayLike) -> FloatArray:
        """Blackbody temperature [K] that has this band radiance; NumericsError for NaN or outside the table."""
        return _lookup("band radiance", "W m-2 sr-1", radiance, self.radiance, self.temperature)


def build_band_table(
    band: SpectralBand, *, lowest: float = 150.0, highest: float = 700.0, step: float = 0.2
) -> BandTable:
    """Table of `band_radiance` from `lowest` to `highest` in steps of `step` [K].

    Straight lines over 0.2 K miss the band radiance by at most 0.22 mK in 8-14 um and 0.65 mK in 3-5 um, worst at
    150 K; the error goes with the square of the step. Raises InputError where the limits hold no whole steps.
    """
    where = f"table of band {band.name!r}"
    if not (np.isfinite([lowest, highest, step]).all() and 0.0 < lowest < highest and step > 0.0):
        limits = (lowest, highest, step)
        raise InputError(where, "limits and step [K]", limits, "not 0 < lowest < highest, step > 0", "mend them")
    steps = round((highest - lowest) / step)
    if steps < 1 or not np.isclose(steps * step, highest - lowest, rtol=1e-9):
        raise InputError(where, "step [K]", step, f"does not divide {highest - lowest:g} K", "choose one that does")
    temperature = np.linspace(lowest, highest, steps + 1)
    radiance = band_radiance(band, temperature)
    if not (np.diff(radiance) > 0.0).all():
        raise NumericsError(f"{where}: radiance does not grow from {lowest:g} K on; start the table warmer")
    for array in (temperature, radiance):
        array.setflags(write=False)
    return BandTable(band=band, temperature=temperature, radiance=radiance)


def _lookup(quantity: str, unit: str, values: npt.ArrayLike, x: FloatArray, y: FloatArray) -> FloatArray:
    """Piecewise linear y(x) within the table; x increases."""
    array = np.asarray(values, dtype=np.float64)
    good = (array >= x[0]) & (array <= x[-1])
    if not good.all():
        bad = array[~good].flat[0]
        limits = f"{x[0]:.6g} to {x[-1]:.6g} {unit}"
        raise NumericsError(f"{quantity} = {bad} {unit}: outside the band table's {limits}; tabulate a wider range")
    return np.asarray(np.interp(array, x, y))
