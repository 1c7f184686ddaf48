"""The 8-14 um sky: cold overhead, as warm as the air at the horizon."""

import numpy as np
import pytest
from numpy.typing import NDArray

from sensorsim.constants import FIRST_RADIATION_CONSTANT, SECOND_RADIATION_CONSTANT, STEFAN_BOLTZMANN_CONSTANT
from sensorsim.environment import (
    CLOUD_TEMPERATURE_DEPRESSION,
    band_sky,
    clear_sky_emissivity,
    sky_temperature,
    zenith_emissivity,
)

FloatArray = NDArray[np.float64]
WAVELENGTH = np.linspace(8e-6, 14e-6, 301)
TEMPERATURE = np.linspace(150.0, 320.0, 1701)

# Air temperature [K], vapour pressure [Pa], LOWTRAN7 apparent temperature [K] in 8-14 um, rural aerosol 23 km, at
# elevations of 90, 50, 30, 20, 10, 5, 2 and 0.5 degrees: mid-latitude winter, mid-latitude summer, US standard.
ELEVATION = np.array([90.0, 50.0, 30.0, 20.0, 10.0, 5.0, 2.0, 0.5])
LOWTRAN = [
    (272.2, 440.0, [210.64, 215.05, 222.32, 229.00, 241.18, 253.00, 264.45, 269.94]),
    (294.2, 1900.0, [248.67, 254.98, 264.81, 272.88, 284.16, 290.12, 291.92, 292.24]),
    (288.15, 785.0, [224.63, 229.86, 238.49, 246.36, 260.24, 272.46, 282.01, 285.20]),
]


def _radiance(temperature: FloatArray) -> FloatArray:
    ratio = SECOND_RADIATION_CONSTANT / (WAVELENGTH * temperature[..., None])
    return np.trapezoid(FIRST_RADIATION_CONSTANT / WAVELENGTH**5 / np.expm1(ratio), WAVELENGTH, axis=-1)


def _apparent(elevation: FloatArray, air: float, vapour: float, cover: float) -> FloatArray:
    sky = band_sky(elevation, vapour_pressure=vapour, cloud_cover=cover)
    warm, cold = _radiance(np.array(air)), _radiance(np.array(air - CLOUD_TEMPERATURE_DEPRESSION))
    return np.interp(sky.air * warm + sky.cloud * cold, _radiance(TEMPERATURE), TEMPERATURE)


@pytest.mark.parametrize(("air", "vapour", "expected"), LOWTRAN, ids=["MLW", "MLS", "US76"])
def test_clear_sky_looks_as_cold_as_lowtran_finds_it(air: float, vapour: float, expected: list[float]) -> None:
    found = _apparent(ELEVATION, air, vapour, 0.0)
    assert abs(found[0] - expected[0]) < 1.0
    assert np.abs(found - expected).max() < 1.5


# Air temperature [K], vapour pressure [Pa], and of LOWTRAN7 with rural haze of 23 km: temperature [K] of the black
# hemisphere with the same irradiance in 8-14 um, and with the same irradiance at all wavelengths.
HEMISPHERE = [
    (299.7, 2630.0, 273.70, 287.20),
    (294.2, 1900.0, 260.41, 279.29),
    (287.2, 1206.0, 245.03, 269.08),
    (288.15, 785.0, 235.46, 266.07),
    (272.2, 440.0, 219.87, 251.22),
]


@pytest.mark.parametrize(("air", "vapour", "band", "broad"), HEMISPHERE, ids=["TRO", "MLS", "SAS", "US76", "MLW"])
@pytest.mark.parametrize("cover", [0.0, 0.5, 1.0])
def test_hemisphere_is_that_of_lowtran_and_of_the_heat_balance(
    air: float, vapour: float, band: float, broad: float, cover: float
) -> None:
    """What the band leaves of the sky's heat is that of air which is nearly black outside of the window.

    Expected: 1.5 K of LOWTRAN7 when clear; outside of 8-14 um 0.92 to 1 of a black body's, clear to overcast.
    """
    sine = (np.arange(2000) + 0.5) / 2000.0
    sky = band_sky(np.degrees(np.arcsin(sine)), vapour_pressure=vapour, cloud_cover=cover)
    warm, cold = _radiance(np.array(air)), _radiance(np.array(air - CLOUD_TEMPERATURE_DEPRESSION))
    window = float(np.mean(2.0 * np.pi * sine * (sky.air * warm + sky.cloud * cold)))
    heat = float(sky_temperature(np.array(air), np.array(vapour), np.array(cover)))
    if cover == 0.0:
        assert abs(np.interp(window / np.pi, _radiance(TEMPERATURE), TEMPERATURE) - band) < 1.5
        assert abs(heat - broad) < 1.5
    outside = (STEFAN_BOLTZMANN_CONSTANT * heat**4 - window) / (STEFAN_BOLTZMANN_CONSTANT * air**4 - np.pi * warm)
    assert 0.92 < outside <= 1.0


@pytest.mark.parametrize(("air", "vapour"), [(257.2, 140.0), (272.2, 440.0), (299.7, 2600.0)])
def test_horizon_tends_to_air_temperature(air: float, vapour: float) -> None:
    horizon = _apparent(np.array([0.0]), air, vapour, 0.0)[0]
    assert air - 5.0 < horizon <= air


def test_overcast_hides_the_cold_zenith() -> None:
    """LOWTRAN7 zenith under closed cloud, air at 272.2 K: altostratus 265.6 K, cumulus and stratocumulus 270.5 K."""
    assert 265.6 - 1.0 < _apparent(np.array([90.0]), 272.2, 440.0, 1.0)[0] < 270.5


def test_emissivities_fall_from_horizon_to_zenith_and_never_sum_above_one() -> None:
    elevation = np.linspace(0.0, 90.0, 181)
    for vapour in (0.0, 50.0, 500.0, 3000.0, 9000.0):
        for cover in (0.0, 0.5, 1.0):
            sky = band_sky(elevation, vapour_pressure=vapour, cloud_cover=cover)
            assert (np.diff(sky.air) <= 0.0).all()
            assert (sky.air >= 0.0).all()
            assert (sky.air + sky.cloud <= 1.0).all()
    zenith = zenith_emissivity(np.array([440.0]))
    np.testing.assert_allclose(clear_sky_emissivity(np.array([90.0]), zenith), zenith, rtol=1e-3)


def test_zenith_emissivity_grows_with_vapour() -> None:
    grown = zenith_emissivity(np.linspace(0.0, 6000.0, 601))
    assert (np.diff(grown) >= 0.0).all()
    assert 0.15 < grown[0] < grown[-1] <= 0.95
