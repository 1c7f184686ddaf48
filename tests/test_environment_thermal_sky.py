"""Long-wave sky against LOWTRAN7, and laws that any sky obeys."""

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.environment import (
    clear_sky_irradiance_dilley,
    clear_sky_irradiance_prata,
    saturation_vapour_pressure,
    sky_irradiance,
    sky_temperature,
    vapour_density,
)

FloatArray = NDArray[np.float64]

# Air temperature [K], vapour density [g m-3], sky temperature [K]: LOWTRAN7 hemispheric long-wave irradiance of its
# model atmospheres TRO, MLS, MLW, SAS, SAW, US76, rural aerosol with 23 km visibility.
CLEAR = np.array(
    [
        (299.7, 19.0, 287.2),
        (294.2, 14.0, 279.29),
        (272.2, 3.5, 251.22),
        (287.2, 9.1, 269.08),
        (257.2, 1.2, 237.33),
        (288.15, 5.9, 266.07),
    ]
)
# The same under closed cloud: MLS cumulus, altostratus, stratocumulus; MLW cumulus, altostratus, stratocumulus.
OVERCAST = np.array(
    [
        (294.2, 14.0, 293.03),
        (294.2, 14.0, 291.08),
        (294.2, 14.0, 293.03),
        (272.2, 3.5, 271.15),
        (272.2, 3.5, 268.89),
        (272.2, 3.5, 271.15),
    ]
)


def _pressure(temperature: FloatArray, density: FloatArray) -> FloatArray:
    return density / 1000.0 * 461.52 * temperature


@pytest.mark.parametrize(
    ("model", "limit"), [(clear_sky_irradiance_dilley, 2.0), (clear_sky_irradiance_prata, 2.5)], ids=["dilley", "prata"]
)
def test_clear_sky_is_that_of_the_model_atmospheres(
    model: Callable[[FloatArray, FloatArray], FloatArray], limit: float
) -> None:
    air, density, sky = CLEAR.T
    found = (model(air, _pressure(air, density)) / STEFAN_BOLTZMANN_CONSTANT) ** 0.25
    assert np.sqrt(np.mean((found - sky) ** 2)) <= limit


def test_overcast_sky_is_that_of_the_model_atmospheres() -> None:
    air, density, sky = OVERCAST.T
    found = sky_temperature(air, _pressure(air, density), np.ones(air.shape))
    assert np.sqrt(np.mean((found - sky) ** 2)) <= 2.0


def test_sky_warms_with_cloud_and_vapour_and_stays_below_the_air() -> None:
    air = np.linspace(250.0, 310.0, 25)[:, None, None]
    humidity = np.linspace(0.05, 1.0, 20)[None, :, None]
    cover = np.linspace(0.0, 1.0, 11)[None, None, :]
    vapour = humidity * saturation_vapour_pressure(air)
    sky = sky_temperature(air, vapour, cover)
    assert (np.diff(sky, axis=1) > 0.0).all()
    assert (np.diff(sky, axis=2) > 0.0).all()
    assert (sky < air).all()


def test_no_cloud_leaves_the_clear_sky() -> None:
    clear, air = np.array([300.0]), np.array([290.0])
    np.testing.assert_array_equal(sky_irradiance(clear, air, np.zeros(1)), clear)


def test_saturation_pressure_and_density_are_those_of_the_steam_tables() -> None:
    """Saturation pressure of water at 0, 20 and 40 C: 611.2, 2338.8 and 7381 Pa; density at 20 C: 17.3 g m-3."""
    celsius = np.array([0.0, 20.0, 40.0])
    np.testing.assert_allclose(saturation_vapour_pressure(celsius + 273.15), [611.2, 2338.8, 7381.0], rtol=3e-3)
    assert vapour_density(np.array(293.15), np.array(1.0)) == pytest.approx(0.0173, rel=5e-3)
