"""Transmittance from the weather against LOWTRAN7 and MODTRAN, and the laws of Beer's exponentials."""

import math

import numpy as np
import pytest

from sensorsim.environment import attenuation_coefficient, band_transmittance, saturation_vapour_pressure
from sensorsim.errors import InputError

# LOWTRAN7 horizontal paths at sea level as sums of three exponentials, each within 0.004 of the runs. Atmosphere,
# air temperature [K], vapour density [g m-3], visibility [km], band, coefficients [1/km], weights.
RANGES = np.array([0.1, 0.3, 1.0, 3.0, 10.0, 20.0])
LOWTRAN = [
    ("TRO", 299.7, 19.0, 23, "FLIR", (0.33789, 1.3821, 25.114), (0.67149, 0.27882, 0.049687)),
    ("MLS", 294.2, 14.0, 23, "FLIR", (0.21557, 0.98461, 19.282), (0.69375, 0.25508, 0.051175)),
    ("MLS", 294.2, 14.0, 5, "FLIR", (0.28496, 1.2781, 24.229), (0.74504, 0.21104, 0.043919)),
    ("MLW", 272.2, 3.5, 23, "FLIR", (0.0513, 0.52292, 11.285), (0.80212, 0.15495, 0.042935)),
    ("US76", 288.15, 5.9, 23, "FLIR", (0.074995, 0.58439, 12.647), (0.76854, 0.18244, 0.049016)),
    ("MLS", 294.2, 14.0, 23, "LLLTV", (0.091843, 0.48326, 11.929), (0.86918, 0.10879, 0.022029)),
    ("MLS", 294.2, 14.0, 5, "LLLTV", (0.40668, 1.0955, 24.215), (0.8722, 0.11366, 0.014137)),
    ("MLW", 272.2, 3.5, 23, "LLLTV", (0.088281, 0.38246, 10.18), (0.92224, 0.066879, 0.010879)),
    ("US76", 288.15, 5.9, 5, "LLLTV", (0.39269, 0.87174, 21.519), (0.86956, 0.12108, 0.009355)),
]
# MODTRAN 5.2.1 (tables of pyBSM), mid-latitude summer, rural 23 km, from 75 m down: range [km], transmittance 8-14 um.
MODTRAN = [(0.125, 0.91864), (0.5056, 0.77713), (1.0028, 0.65321), (2.0014, 0.48512), (5.0006, 0.23104)]

WINTER = {"air_temperature": 277.15, "relative_humidity": 0.55, "visibility": 23_000.0, "precipitation": 0.0}


def _humidity(temperature: float, density: float) -> float:
    return density / 1000.0 * 461.52 * temperature / float(saturation_vapour_pressure(np.array(temperature)))


@pytest.mark.parametrize("row", LOWTRAN, ids=lambda row: f"{row[0]}-{row[3]}km-{row[4]}")
def test_transmittance_is_that_of_lowtran(
    row: tuple[str, float, float, float, str, tuple[float, ...], tuple[float, ...]],
) -> None:
    _, air, density, visibility, band, coefficients, weights = row
    path = band_transmittance(
        band,
        air_temperature=air,
        relative_humidity=_humidity(air, density),
        visibility=visibility * 1000.0,
        precipitation=0.0,
    )
    expected = np.exp(-RANGES[:, None] * np.array(coefficients)) @ np.array(weights)
    assert np.abs(path.at(RANGES * 1000.0) - expected).max() <= (0.018 if band == "FLIR" else 0.015)


def test_transmittance_is_that_of_modtran() -> None:
    distance, expected = np.array(MODTRAN).T
    path = band_transmittance(
        "FLIR",
        air_temperature=294.2,
        relative_humidity=_humidity(294.2, 14.0),
        visibility=23_000.0,
        precipitation=0.0,
    )
    assert np.abs(path.at(distance * 1000.0) - expected).max() <= 0.02


@pytest.mark.parametrize("band", ["FLIR", "MWIR", "LLLTV"])
def test_single_coefficient_is_exact_at_one_kilometre_and_too_strong_beyond(band: str) -> None:
    path, alpha = band_transmittance(band, **WINTER), attenuation_coefficient(band, **WINTER)
    assert math.exp(-alpha * 1000.0) == pytest.approx(float(path.at(1000.0)), rel=1e-12)
    assert math.exp(-alpha * 5000.0) < float(path.at(5000.0))
    assert math.exp(-alpha * 200.0) > float(path.at(200.0))


@pytest.mark.parametrize("band", ["FLIR", "MWIR", "LLLTV"])
def test_transmittance_starts_at_one_and_only_falls(band: str) -> None:
    found = band_transmittance(band, **WINTER).at(np.linspace(0.0, 30_000.0, 301))
    assert found[0] == pytest.approx(1.0, abs=1e-12)
    assert (np.diff(found) < 0.0).all()
    assert found[-1] > 0.0


@pytest.mark.parametrize("band", ["FLIR", "MWIR", "LLLTV"])
@pytest.mark.parametrize(
    ("entry", "values"),
    [
        ("relative_humidity", [0.0, 0.2, 0.5, 0.8, 0.9, 0.99, 1.0]),
        ("visibility", [337_000.0, 50_000.0, 23_000.0, 5_000.0, 200.0]),
        ("precipitation", [0.0, 0.1, 1.0, 10.0, 100.0]),
    ],
)
def test_wetter_hazier_and_rainier_air_attenuates_more(band: str, entry: str, values: list[float]) -> None:
    alphas = [attenuation_coefficient(band, **{**WINTER, entry: value}) for value in values]
    assert (np.diff(alphas) > 0.0).all()
    assert alphas[0] > 0.0


def test_infrared_sees_through_haze_better_than_low_light_television() -> None:
    hazy = {**WINTER, "visibility": 3_000.0}
    assert attenuation_coefficient("FLIR", **hazy) < attenuation_coefficient("LLLTV", **hazy) / 1.5


def test_rain_attenuates_by_its_rate_alike_in_both_bands() -> None:
    for band in ("FLIR", "LLLTV"):
        dry, wet = (attenuation_coefficient(band, **{**WINTER, "precipitation": rate}) for rate in (0.0, 10.0))
        assert 1000.0 * (wet - dry) == pytest.approx(0.365 * 10.0**0.63, rel=1e-9)


@pytest.mark.parametrize(
    ("entry", "value"),
    [
        ("visibility", 0.0),
        ("visibility", 1e6),
        ("visibility", math.nan),
        ("relative_humidity", 1.2),
        ("air_temperature", 15.0),
        ("precipitation", -1.0),
    ],
)
def test_impossible_air_is_refused(entry: str, value: float) -> None:
    with pytest.raises(InputError, match=entry):
        attenuation_coefficient("FLIR", **{**WINTER, entry: value})


def test_unknown_band_is_refused() -> None:
    for band in ("SWIR", "source"):
        with pytest.raises(InputError, match="FLIR, MWIR, LLLTV"):
            attenuation_coefficient(band, **WINTER)
