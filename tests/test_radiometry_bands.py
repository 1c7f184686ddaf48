"""Band radiance against Planck's function, and the lookup table against band radiance."""

import time

import numpy as np
import pytest
from scipy.integrate import quad

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.errors import InputError, NumericsError
from sensorsim.radiometry import (
    FLIR_BAND,
    LLLTV_BAND,
    SOLAR_BAND,
    THERMAL_BAND,
    SpectralBand,
    band_radiance,
    band_radiance_derivative,
    build_band_table,
    flat_band,
    spectral_radiance,
)

TEMPERATURES = [150.0, 290.0, 700.0]
MWIR_BAND = flat_band("MWIR", 3e-6, 5e-6)


@pytest.fixture(scope="module")
def table():
    return build_band_table(FLIR_BAND)


def error_in_kelvin(table):
    """Error of the straight lines, taken midway between entries where it is greatest, as a temperature [K]."""
    between = (table.temperature[:-1] + table.temperature[1:]) / 2.0
    missed = table.radiance_at(between) - band_radiance(table.band, between)
    return np.abs(missed / band_radiance_derivative(table.band, between)).max()


def test_all_wavelengths_together_give_stefan_boltzmann():
    temperature = np.array([150.0, 300.0, 700.0, 5772.0])
    everything = flat_band("everything", 0.05e-6, 1.0)
    expected = STEFAN_BOLTZMANN_CONSTANT * temperature**4
    assert np.pi * band_radiance(everything, temperature) == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("shortest", "longest", "radiance", "slope"),
    [
        (8.0, 12.0, 32.517, 0.56724),
        (8.0, 14.0, 46.935, 0.76202),
        (7.5, 13.5, 47.096, 0.79701),
        (3.0, 5.0, 1.28310, 0.049602),
    ],
)
def test_flat_bands_at_290_kelvin(shortest, longest, radiance, slope):
    """Values of an independent integration, to the digits they were given with."""
    band = flat_band("flat", shortest * 1e-6, longest * 1e-6)
    assert band_radiance(band, 290.0) == pytest.approx(radiance, rel=3e-5)
    assert band_radiance_derivative(band, 290.0) == pytest.approx(slope, rel=3e-5)


@pytest.mark.parametrize("band", [FLIR_BAND, LLLTV_BAND, THERMAL_BAND, SOLAR_BAND, MWIR_BAND], ids=lambda b: b.name)
def test_quadrature_has_converged(band):
    shortest, longest = band.wavelength
    for temperature in TEMPERATURES:
        # In the logarithm of the wavelength and relative to the band's end, where quad's tolerance bites everywhere.
        scale = float(spectral_radiance(longest, temperature)) * longest
        expected, _ = quad(
            lambda u, t=temperature, s=scale: float(spectral_radiance(np.exp(u), t)) * np.exp(u) / s,
            np.log(shortest),
            np.log(longest),
            epsabs=0.0,
            epsrel=1e-11,
            limit=200,
        )
        assert band_radiance(band, temperature) == pytest.approx(expected * scale, rel=1e-9)


def test_tabulated_response_weighs_the_radiance():
    band = SpectralBand(name="tent", wavelength=np.array([8e-6, 9e-6, 13e-6]), response=np.array([0.0, 1.0, 0.25]))
    expected, _ = quad(
        lambda um: float(spectral_radiance(um * 1e-6, 290.0)) * 1e-6 * np.interp(um, [8, 9, 13], [0, 1, 0.25]),
        8.0,
        13.0,
        points=[9.0],
        epsrel=1e-12,
    )
    assert band_radiance(band, 290.0) == pytest.approx(expected, rel=1e-10)


def test_neighbouring_bands_add_up():
    parts = band_radiance(flat_band("a", 8e-6, 10.3e-6), TEMPERATURES) + band_radiance(
        flat_band("b", 10.3e-6, 14e-6), TEMPERATURES
    )
    assert parts == pytest.approx(band_radiance(FLIR_BAND, TEMPERATURES), rel=1e-12)


def test_default_table_is_good_to_a_third_of_a_millikelvin(table):
    assert (table.temperature[0], table.temperature[-1]) == (150.0, 700.0)
    assert error_in_kelvin(table) <= 0.3e-3


def test_table_error_falls_with_the_square_of_the_step():
    coarse, fine = (error_in_kelvin(build_band_table(FLIR_BAND, step=step)) for step in (1.0, 0.5))
    assert coarse / fine == pytest.approx(4.0, rel=0.02)


def test_radiance_grows_with_temperature(table):
    temperature = np.linspace(150.0, 700.0, 20001)
    assert (np.diff(table.radiance_at(temperature)) > 0.0).all()
    assert (np.diff(band_radiance(LLLTV_BAND, temperature)) > 0.0).all()


def test_apparent_temperature_of_a_blackbody_is_its_own(table):
    temperature = np.random.default_rng(5).uniform(150.0, 700.0, (60, 80))
    assert np.abs(table.apparent_temperature(band_radiance(FLIR_BAND, temperature)) - temperature).max() <= 1e-3


def test_inverse_undoes_the_table_exactly(table):
    temperature = np.random.default_rng(6).uniform(150.0, 700.0, 10000)
    assert np.abs(table.apparent_temperature(table.radiance_at(temperature)) - temperature).max() <= 1e-9


def test_table_ends_belong_to_it(table):
    assert table.radiance_at([150.0, 700.0]).tolist() == table.radiance[[0, -1]].tolist()
    assert table.apparent_temperature(table.radiance[[0, -1]]).tolist() == [150.0, 700.0]


@pytest.mark.parametrize("radiance", [0.0, -1.0, 1e9, np.nan, np.inf])
def test_radiance_beyond_the_table_is_refused(table, radiance):
    with pytest.raises(NumericsError, match=r"outside the band table's .* W m-2 sr-1"):
        table.apparent_temperature([45.0, radiance])


@pytest.mark.parametrize("temperature", [149.9, 700.1, np.nan])
def test_temperature_beyond_the_table_is_refused(table, temperature):
    with pytest.raises(NumericsError, match="150 to 700 K"):
        table.radiance_at(temperature)


def test_whole_image_is_inverted_within_a_frame(table):
    noise = np.random.default_rng(7).normal(0.0, 1.0, (480, 640))
    radiance = table.radiance_at(np.linspace(250.0, 320.0, 640) + noise)
    spent = []
    for _ in range(5):
        start = time.process_time()
        table.apparent_temperature(radiance)
        spent.append(time.process_time() - start)
    assert min(spent) < 0.05  # [s]


@pytest.mark.parametrize(
    ("wavelength", "response", "said"),
    [
        ([8e-6], [1.0], "fewer than two points"),
        ([14e-6, 8e-6], [1.0, 1.0], "does not increase"),
        ([8e-6, 8e-6], [1.0, 1.0], "does not increase"),
        ([0.0, 8e-6], [1.0, 1.0], "not finite and above zero"),
        ([8e-6, np.nan], [1.0, 1.0], "not finite and above zero"),
        ([8e-6, 14e-6], [1.0, 1.0, 1.0], "has 3 values for 2 wavelengths"),
        ([8e-6, 14e-6], [1.0, -0.1], "not finite and zero or above"),
        ([8e-6, 14e-6], [1.0, np.inf], "not finite and zero or above"),
        ([8e-6, 14e-6], [0.0, 0.0], "zero everywhere"),
        ([8e-6, 14e-6], [0.5, 0.4], "divide it by its peak"),
    ],
)
def test_impossible_band_is_refused(wavelength, response, said):
    with pytest.raises(InputError, match=said) as caught:
        SpectralBand(name="bad", wavelength=np.array(wavelength), response=np.array(response))
    assert "\n" not in str(caught.value)
    assert "'bad'" in str(caught.value)


def test_band_does_not_change_with_the_arrays_it_was_made_from():
    wavelength = np.array([8e-6, 14e-6])
    band = SpectralBand(name="kept", wavelength=wavelength, response=np.ones(2))
    wavelength[1] = 9e-6
    assert band.wavelength[1] == 14e-6
    with pytest.raises(ValueError, match="read-only"):
        band.response[0] = 0.5


@pytest.mark.parametrize("limits", [(0.0, 700.0, 0.2), (700.0, 150.0, 0.2), (150.0, 700.0, -1.0), (150.0, np.nan, 0.2)])
def test_impossible_table_is_refused(limits):
    lowest, highest, step = limits
    with pytest.raises(InputError, match="lowest < highest"):
        build_band_table(FLIR_BAND, lowest=lowest, highest=highest, step=step)


def test_step_that_does_not_divide_the_table_is_refused():
    with pytest.raises(InputError, match="does not divide 550 K"):
        build_band_table(FLIR_BAND, step=0.3)


def test_table_without_radiance_is_refused():
    with pytest.raises(NumericsError, match="start the table warmer"):
        build_band_table(flat_band("ultraviolet", 0.01e-6, 0.02e-6))
