"""Air from the MODTRAN 5.2.1 tables [MODTRAN5] that come with pyBSM [PyBSM2025], for the conditions they were run for.

Mid-latitude summer, rural haze of 23 or 5 km visibility, sun 50 degrees from the zenith, seen from a height down to
the ground. The extra `sensorsim[modtran]` installs them. They are fitted by four exponentials at the camera's height;
a straight path's mean density depends on its two heights alone, so one fit serves all ranges.

Up to 1 km height the tables' path radiance is that of a layer with 294.2 K at its foot and 289.7 K at 1 km, wherever
in it the sensor stands: air at its very lens shines at 289.7 K, as opaque wavelengths show. It is passed on as the
tables have it; a target of 300 K is within 0.1 K of them to 20 km, from 32.5 m to 10 km high.
"""

from importlib.util import find_spec
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares, minimize_scalar

from sensorsim.environment.air_path import MOST_TERMS, AirPath
from sensorsim.environment.humidity import vapour_density
from sensorsim.environment.sample import EnvironmentSample
from sensorsim.errors import InputError
from sensorsim.radiometry import SpectralBand, band_radiance, spectral_radiance, spectral_radiance_derivative

FloatArray = NDArray[np.float64]

AIR_TEMPERATURE = 294.2  # [K] at the ground, mid-latitude summer
VAPOUR_DENSITY = 14e-3  # [kg m-3] at the ground
_VISIBILITIES = {23_000.0: 1, 5_000.0: 2}  # [m] and MODTRAN's IHAZE
_TEMPERATURE_MARGIN = 2.0  # [K] within which a moment counts as the tables' own
_VAPOUR_MARGIN = 2e-3  # [kg m-3]
_LOWEST, _HIGHEST, _FARTHEST = 32.5, 10_000.0, 60_000.0  # [m]; at 2 m the tables' geometry is rounded away
# Air temperature [K] at heights [m] of the mid-latitude summer, [LOWTRAN7].
_PROFILE = (
    (0.0, 1e3, 2e3, 3e3, 4e3, 6e3, 8e3, 10e3, 13e3, 20e3),
    (294.2, 289.7, 285.2, 279.2, 273.2, 261.2, 248.2, 235.3, 215.8, 218.9),
)
_LEAST_STRATIFIED = 500.0  # [m] from which on the source is let fall off with height; below, the layer's ends mislead
_SCALE_HEIGHT = 2000.0  # [m] for targets above the ground; estimate
_RIDGE = 2e-2  # pull of the terms' sources towards their mean, in units of radiance
_CONTRAST_TEMPERATURE = 290.0  # [K] at which dB/dT weighs the spectrum
_WAVELENGTH = 1e-6 * np.linspace(0.3, 14.0, 1371)  # [m]
_COLUMNS = 5  # transmission, path thermal, surface emission, sun scattered, ground reflected


def modtran_path(
    band: SpectralBand, sample: EnvironmentSample, camera_height: float, *, emissive: bool, folder: Path | None = None
) -> AirPath:
    """Air in a band from a camera's height [m]; `folder` holds the tables, that of the installed pyBSM if left out.

    In reflective bands transmittance alone is of the tables, as their sunlight is that of one hour.
    InputError where pyBSM is missing, and for weather or heights that the tables do not cover.
    """
    haze = _condition(sample)
    where = _installed() if folder is None else folder
    if not camera_height <= _HIGHEST:
        raise InputError("modtran", "camera height", camera_height, "above the tables", f"stay below {_HIGHEST:g} m")
    height = max(camera_height, _LOWEST)
    distance, spectra = _read_height(where, haze, height)
    weight, table = _band_weights(band, spectra, emissive)
    fit_weight, depth = _fit(distance, table)
    decay = 1.0 / _SCALE_HEIGHT
    thinning = (1.0 - np.exp(-height * decay)) / (height * decay)
    source, loss = np.zeros(MOST_TERMS), 0.0
    if emissive:
        radiance = _path_radiance(band, spectra, weight, table)
        source, loss = _fit_stratified(distance, radiance, fit_weight, depth, _source_loss(band, height))
    return AirPath(
        weight=fit_weight,
        coefficient=depth / thinning,
        inverse_scale_height=np.full(MOST_TERMS, decay),
        source=source,
        source_decay=-float(np.log1p(-loss)) / height,
        beam_source=np.zeros(MOST_TERMS),
        asymmetry=0.0,
    )


def _condition(sample: EnvironmentSample) -> int:
    """IHAZE of a moment that the tables cover."""
    remedy = "use --atmosphere standard, which follows the weather"
    vapour = float(vapour_density(np.array(sample.air_temperature), np.array(sample.relative_humidity)))
    for entry, value, good, limits in (
        ("air temperature", sample.air_temperature, _TEMPERATURE_MARGIN, AIR_TEMPERATURE),
        ("water vapour density", vapour, _VAPOUR_MARGIN, VAPOUR_DENSITY),
    ):
        if not abs(value - limits) <= good:
            raise InputError("modtran", entry, value, f"the tables hold {limits:g} within {good:g} only", remedy)
    if sample.visibility not in _VISIBILITIES or sample.aerosol != "rural":
        haze = (sample.visibility, sample.aerosol)
        raise InputError("modtran", "visibility and aerosol", haze, "the tables hold 23 and 5 km, rural", remedy)
    if sample.precipitation != 0.0 or sample.cloud_cover > 0.0:
        weather = (sample.precipitation, sample.cloud_cover)
        raise InputError("modtran", "rain and cloud cover", weather, "the tables hold clear skies", remedy)
    return _VISIBILITIES[sample.visibility]


def _installed() -> Path:
    spec = find_spec("pybsm")
    if spec is None or not spec.submodule_search_locations:
        remedy = "install it: pip install 'sensorsim[modtran]'"
        raise InputError("modtran", "atmosphere", "modtran", "pyBSM, which holds its tables, is missing", remedy)
    return Path(next(iter(spec.submodule_search_locations))) / "atms"


def _read_height(folder: Path, haze: int, height: float) -> tuple[FloatArray, FloatArray]:
    """Slant ranges (n,) [m] and spectra (n, 1371, 5), straight lines between the two nearest heights."""
    listed = np.genfromtxt(folder / "fileDecoder.csv", delimiter=",", skip_header=1)[:, :4]
    listed = listed[listed[:, 3] == haze]
    heights = 1000.0 * np.unique(listed[:, 1])
    heights = heights[(heights >= _LOWEST) & (heights <= _HIGHEST)]
    upper = int(np.clip(np.searchsorted(heights, height), 1, heights.size - 1))
    low, high = heights[upper - 1], heights[upper]
    share = (height - low) / (high - low)
    rows = [{row[2]: int(row[0]) for row in listed if np.isclose(1000.0 * row[1], level)} for level in (low, high)]
    ground = np.array(sorted(set(rows[0]) & set(rows[1])))
    ground = ground[1000.0 * ground <= _FARTHEST]
    parts = [np.stack([_read_spectrum(folder, table[distance]) for distance in ground]) for table in rows]
    return np.hypot(1000.0 * ground, height), np.asarray((1.0 - share) * parts[0] + share * parts[1])


def _read_spectrum(folder: Path, number: int) -> FloatArray:
    """One table; radiances come in W cm-2 sr-1 um-1."""
    path = folder / f"{number}.bin"
    raw = np.fromfile(path, dtype=np.float32)
    if raw.size != _WAVELENGTH.size * _COLUMNS or not np.isfinite(raw).all():
        raise InputError(path, "size", raw.size, "no table of MODTRAN", "reinstall pyBSM")
    spectrum = raw.reshape((_WAVELENGTH.size, _COLUMNS), order="F").astype(np.float64)
    spectrum[:, 1:] *= 1e10
    return spectrum


def _band_weights(band: SpectralBand, spectra: FloatArray, emissive: bool) -> tuple[FloatArray, FloatArray]:
    """Weights of the wavelengths [m] and band transmittance (n,), by contrast or by what the ground reflects."""
    if band.wavelength[-1] > _WAVELENGTH[-1] + 1e-12:
        edge = band.wavelength[-1]
        raise InputError("modtran", "band", edge, "beyond the tables' 14 um", "use --atmosphere standard")
    response = np.interp(_WAVELENGTH, band.wavelength, band.response, left=0.0, right=0.0)
    ends = np.isclose(_WAVELENGTH, band.wavelength[0]) | np.isclose(_WAVELENGTH, band.wavelength[-1])
    response = np.where(ends, 0.5 * np.interp(_WAVELENGTH, band.wavelength, band.response), response)
    weight = response * (_WAVELENGTH[1] - _WAVELENGTH[0])
    through = spectra[:, :, 0]
    if emissive:
        seen = weight * spectral_radiance_derivative(_WAVELENGTH, _CONTRAST_TEMPERATURE)
    else:
        seen = weight * spectra[0, :, 4] / np.maximum(through[0], 1e-6)
    return weight, np.asarray(through @ seen / seen.sum())


def _path_radiance(band: SpectralBand, spectra: FloatArray, weight: FloatArray, table: FloatArray) -> FloatArray:
    """Path radiance (n,) [W m-2 sr-1], with what contrast transmittance misses of a surface at air temperature."""
    surface = (spectra[:, :, 0] * spectral_radiance(_WAVELENGTH, AIR_TEMPERATURE)) @ weight
    return np.asarray(spectra[:, :, 1] @ weight + surface - table * band_radiance(band, AIR_TEMPERATURE))


def _fit(distance: FloatArray, table: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Weights (4,) and coefficients (4,) [m-1] of the exponentials nearest to a transmittance."""

    def terms(unknown: FloatArray) -> tuple[FloatArray, FloatArray]:
        share = np.exp(np.append(unknown[: MOST_TERMS - 1], 0.0))
        return share / share.sum(), np.exp(unknown[MOST_TERMS - 1 :])

    def miss(unknown: FloatArray) -> FloatArray:
        share, depth = terms(unknown)
        return np.asarray(np.exp(-distance[:, None] * depth) @ share - table)

    start = np.concatenate([np.linspace(2.5, 0.8, MOST_TERMS - 1), np.log(np.geomspace(1e-4, 2e-2, MOST_TERMS))])
    limits = (np.concatenate([np.full(MOST_TERMS - 1, -12.0), np.full(MOST_TERMS, -20.0)]), np.full(start.size, 12.0))
    return terms(least_squares(miss, start, bounds=limits, xtol=1e-12, ftol=1e-12, gtol=1e-12).x)


def _source_loss(band: SpectralBand, height: float) -> float:
    """Share by which air at the sensor's height shines less than that at the ground."""
    if height < _LEAST_STRATIFIED:
        return 0.0
    here, ground = band_radiance(band, np.array([np.interp(max(height, 1000.0), *_PROFILE), AIR_TEMPERATURE]))
    return float(1.0 - here / ground)


def _fit_stratified(
    distance: FloatArray, radiance: FloatArray, share: FloatArray, depth: FloatArray, expected: float
) -> tuple[FloatArray, float]:
    """Sources as `_fit_source`, and the loss of them up to the sensor, about `expected`, that comes nearest."""

    def miss(loss: float) -> float:
        return _fit_source(distance, radiance, share, depth, loss)[1]

    loss = float(minimize_scalar(miss, bounds=(0.0, 2.0 * expected), method="bounded").x) if expected > 0.0 else 0.0
    return _fit_source(distance, radiance, share, depth, loss)[0], loss


def _fit_source(
    distance: FloatArray, radiance: FloatArray, share: FloatArray, depth: FloatArray, loss: float
) -> tuple[FloatArray, float]:
    """Source at the ground (4,) [W m-2 sr-1] of each term that comes nearest to a path radiance, and the worst miss.

    The terms are alike at long range; a term that nothing tells from the others keeps the source of all.
    """
    gone = distance[:, None] * depth
    part = np.exp(-gone)
    grown = share * ((1.0 - part) * (1.0 - loss) + ((1.0 - part) / gone - part) * loss)
    typical = (grown.sum(axis=1) @ radiance) / (grown.sum(axis=1) @ grown.sum(axis=1))
    rows = np.vstack([grown, _RIDGE * np.diag(share)])
    found = np.linalg.lstsq(rows, np.append(radiance - grown.sum(axis=1) * typical, np.zeros(MOST_TERMS)), rcond=None)
    source = np.maximum(typical + found[0], 0.0)
    return np.asarray(source), float(np.abs(grown @ source - radiance).max())
