"""Convection: published values, their limits, and no jump in orientation or wind."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.thermal.air_properties import air_at, pressure_at
from sensorsim.thermal.convection import (
    CORRELATIONS,
    FREE_AIR_TEMPERATURE,
    ROUGHNESS_FACTOR,
    forced_film,
    free_film_cubed,
    windward_share,
)
from sensorsim.thermal.plate_convection import (
    forced_nusselt,
    free_plate_film,
    horizontal_nusselt,
    laminar_vertical_nusselt,
    vertical_nusselt,
)

FloatArray = NDArray[np.float64]

NORTH, SOUTH, WEST = ([0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0])
UP, DOWN = [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]


def _film(normal: list[float], speed: float, direction: float = 0.0, **options: object) -> float:
    roughness = str(options.pop("roughness", "very_smooth"))
    found = forced_film(np.array([normal]), np.array([speed]), np.array([direction]), roughness, **options)  # type: ignore[arg-type]
    return float(found[0, 0])


# --- air -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("kelvin", "viscosity", "conductivity", "prandtl"),
    [
        (200.0, 132.5e-7, 18.1e-3, 0.737),
        (250.0, 159.6e-7, 22.3e-3, 0.720),
        (300.0, 184.6e-7, 26.3e-3, 0.707),
        (350.0, 208.2e-7, 30.0e-3, 0.700),
        (400.0, 230.1e-7, 33.8e-3, 0.690),
    ],
)
def test_air_is_that_of_the_tables(kelvin: float, viscosity: float, conductivity: float, prandtl: float) -> None:
    """[Incropera2007] table A.4."""
    air = air_at(kelvin)
    assert float(air.kinematic_viscosity * air.density) == pytest.approx(viscosity, rel=0.007)
    assert float(air.conductivity) == pytest.approx(conductivity, rel=0.007)
    assert float(air.prandtl) == pytest.approx(prandtl, rel=0.011)
    assert float(air.density) == pytest.approx(101325.0 / (287.05 * kelvin), rel=1e-3)


@pytest.mark.parametrize(("altitude", "pressure"), [(0.0, 101325.0), (1000.0, 89876.0), (5000.0, 54048.0)])
def test_pressure_is_that_of_the_standard_atmosphere(altitude: float, pressure: float) -> None:
    assert pressure_at(altitude) == pytest.approx(pressure, rel=1e-3)


# --- correlations against worked values ----------------------------------------------------------------------------


def test_laminar_plate_of_the_textbook() -> None:
    """[Incropera2007] example 7.1: 10 m/s of air at 437 K and 6 kPa along half a metre: Re 9597, Nu 57.4, h 4.18."""
    assert float(forced_nusselt(np.array(9597.0), np.array(0.687))) == pytest.approx(57.4, abs=0.05)
    air = air_at(437.0, 6000.0)
    nusselt = forced_nusselt(10.0 * 0.5 / air.kinematic_viscosity, air.prandtl)
    assert float(nusselt * air.conductivity / 0.5) == pytest.approx(4.18, rel=0.01)


def test_plate_turns_turbulent_without_a_step() -> None:
    reynolds = np.linspace(4.9e5, 5.1e5, 401)
    nusselt = forced_nusselt(reynolds, np.array(0.71))
    assert (np.diff(nusselt) > 0.0).all()
    assert np.diff(nusselt).max() < 0.002 * nusselt[0]
    far = forced_nusselt(np.array([1e8]), np.array(1.0))[0]
    assert far == pytest.approx(0.037 * 1e8**0.8 - 871.0)


def test_vertical_plate_of_the_textbook() -> None:
    """[Incropera2007] example 9.2: a glass door of 0.71 m before a fire, Ra 1.813e9, Pr 0.690: Nu 147, h 7.0."""
    nusselt = float(vertical_nusselt(np.array(1.813e9), np.array(0.690)))
    assert nusselt == pytest.approx(147.0, abs=0.5)
    assert nusselt * 33.8e-3 / 0.71 == pytest.approx(7.0, abs=0.05)
    film = free_plate_film(0.0, 232.0 - 23.0, 0.71, air_at(400.65))
    assert float(film) == pytest.approx(7.0, rel=0.02)


def test_duct_of_the_textbook() -> None:
    """[Incropera2007] example 9.3: sides of 0.3 m 4.23, top 5.47, bottom 2.07 W/m2K at 45 C in air of 15 C."""
    side = laminar_vertical_nusselt(np.array(7.07e7), np.array(0.71)) * 0.0265 / 0.3
    top = horizontal_nusselt(np.array(1.38e8), rising=True) * 0.0265 / 0.375
    bottom = horizontal_nusselt(np.array(1.38e8), rising=False) * 0.0265 / 0.375
    assert [float(side), float(top), float(bottom)] == pytest.approx([4.23, 5.47, 2.07], abs=0.01)
    air = air_at(303.0)
    films = [float(free_plate_film(up, 30.0, 0.375, air)) for up in (1.0, -1.0)]
    assert films == pytest.approx([5.47, 2.07], rel=0.015)


def test_churchill_and_chu_tend_to_their_limits() -> None:
    """Still air conducts, Nu 0.68 and 0.825^2; at high Rayleigh number the law is that of 1/3, 0.105 Ra^1/3 in air."""
    pr = np.array(0.71)
    assert float(vertical_nusselt(np.array(0.0), pr)) == pytest.approx(0.825**2)
    assert float(laminar_vertical_nusselt(np.array(0.0), pr)) == pytest.approx(0.68)
    assert float(vertical_nusselt(np.array(1e9), pr)) == pytest.approx(122.9, abs=0.1)
    assert float(vertical_nusselt(np.array(1e18), pr)) == pytest.approx(0.1053e6, rel=0.02)
    assert float(vertical_nusselt(np.array(1e6), pr) / laminar_vertical_nusselt(np.array(1e6), pr)) == pytest.approx(
        1.0, abs=0.1
    )


def test_windows_of_mowitt_at_five_metres_a_second() -> None:
    """2.38 V^0.89 windward and 2.86 V^0.617 leeward [Yazdanian1994]; 3.26 and 3.55 for the local wind [Booten2012]."""
    assert _film(NORTH, 5.0) == pytest.approx(9.97, abs=0.01)
    assert _film(SOUTH, 5.0) == pytest.approx(7.72, abs=0.01)
    assert _film(WEST, 5.0) == pytest.approx((9.97 + 7.72) / 2.0, abs=0.01)
    assert _film(UP, 5.0) == pytest.approx(9.97, abs=0.01)
    assert _film(NORTH, 5.0, correlation="mowitt_local") == pytest.approx(13.65, abs=0.01)
    assert _film(SOUTH, 5.0, correlation="mowitt_local") == pytest.approx(9.58, abs=0.01)


def test_plates_of_sparrow_and_of_mcadams() -> None:
    assert _film(NORTH, 4.0, correlation="tarp", length=1.0) == pytest.approx(2.537 * 4.0)
    assert _film(SOUTH, 4.0, correlation="tarp", length=1.0) == pytest.approx(2.537 * 2.0)
    assert _film(NORTH, 4.0, correlation="tarp", length=4.0, roughness="rough") == pytest.approx(1.67 * 2.537 * 2.0)
    assert _film(NORTH, 0.0, correlation="mcadams") == pytest.approx(5.62, abs=0.01)
    assert _film(WEST, 3.0, correlation="mcadams") == pytest.approx(17.4, abs=0.1)
    assert _film(UP, 10.0, correlation="mcadams") == pytest.approx(7.17 * 10.0**0.78, rel=0.002)


def test_size_and_air_act_on_the_flat_plate() -> None:
    """Laminar films go with the root of V / L; thin air of a mountain takes less; a rough wall more."""
    options = {"correlation": "flat_plate"}
    small, large = (_film(NORTH, 1.0, length=length, **options) for length in (0.2, 0.8))
    assert small / large == pytest.approx(2.0)
    thin = _film(NORTH, 5.0, length=3.0, air=air_at(293.15, pressure_at(3000.0)), **options)
    assert thin < _film(NORTH, 5.0, length=3.0, **options)
    assert _film(NORTH, 5.0, length=3.0, roughness="rough", **options) == pytest.approx(
        1.67 * _film(NORTH, 5.0, length=3.0, **options)
    )
    warm = _film(NORTH, 5.0, length=3.0, air=air_at(303.15), **options)
    assert 0.95 < warm / _film(NORTH, 5.0, length=3.0, **options) < 0.98


# --- laws of all correlations --------------------------------------------------------------------------------------


@pytest.mark.parametrize("correlation", CORRELATIONS)
@pytest.mark.parametrize("roughness", ROUGHNESS_FACTOR)
def test_films_grow_with_wind_from_a_finite_value_in_still_air(correlation: str, roughness: str) -> None:
    normal = _sphere(40)
    speed = np.concatenate([[0.0], np.geomspace(1e-6, 60.0, 600), [4.8767, 4.8768, 4.8769]])
    speed.sort()
    film = forced_film(normal, speed, np.full_like(speed, 250.0), roughness, correlation=correlation, length=2.0)
    assert np.isfinite(film).all()
    assert (film[0] >= 0.0).all()
    assert (np.diff(film, axis=0) >= 0.0).all()
    assert (film[-1] > film[0] + 15.0).all()


@pytest.mark.parametrize("correlation", CORRELATIONS)
def test_small_turns_make_small_changes(correlation: str) -> None:
    """Turning a surface or the wind by half a degree changes no film by more than 1 %."""
    normal = _sphere(400)
    turned = _turned(normal, math.radians(0.5))
    speed, direction = np.array([0.5, 4.0, 15.0]), np.array([10.0, 133.0, 350.0])
    film, other, windy = (
        forced_film(n, speed, d, "rough", correlation=correlation, length=2.0)
        for n, d in ((normal, direction), (turned, direction), (normal, direction + 0.5))
    )
    assert (np.abs(other - film) <= 0.01 * film).all()
    assert (np.abs(windy - film) <= 0.01 * film).all()
    assert (np.abs(np.cbrt(free_film_cubed(turned)) / np.cbrt(free_film_cubed(normal)) - 1.0) <= 0.01).all()


def test_wind_from_all_round_treats_walls_alike() -> None:
    walls = np.array([NORTH, SOUTH, WEST])
    direction = np.arange(0.0, 360.0, 10.0)
    share = windward_share(walls, direction)
    np.testing.assert_allclose(share.mean(axis=0), 0.5, atol=1e-12)
    assert share.max() == pytest.approx(1.0)
    assert share.min() == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        ({"correlation": "jurges"}, "use one of mowitt"),
        ({"correlation": "flat_plate"}, "needs one above 0"),
        ({"correlation": "tarp", "length": 0.0}, "needs one above 0"),
        ({"correlation": "tarp", "length": math.nan}, "needs one above 0"),
        ({"roughness": "bumpy"}, "use one of very_rough"),
    ],
)
def test_what_cannot_be_computed_is_refused(options: dict[str, object], expected: str) -> None:
    with pytest.raises(InputError, match=expected):
        _film(NORTH, 3.0, **options)


# --- free convection of the march ----------------------------------------------------------------------------------


def test_warm_air_leaves_a_roof_and_stays_under_a_ceiling() -> None:
    """[Walton1983]: 1.31 on walls, 1.52 where it rises, 0.76 where it stays; the other way round with cold air."""
    normal = np.array([NORTH, UP, DOWN])
    films = np.cbrt(free_film_cubed(normal))
    assert films == pytest.approx([1.31, 1.52, 0.76], abs=0.001)
    np.testing.assert_allclose(np.cbrt(free_film_cubed(normal, warmer=False)), films[[0, 2, 1]])


def test_free_film_follows_the_state_of_the_air() -> None:
    """As the 2/3 power of pressure; 10 % more at 255 K than at 294 K; unchanged at its reference."""
    wall = np.array([NORTH])
    base = float(np.cbrt(free_film_cubed(wall))[0])
    assert float(np.cbrt(free_film_cubed(wall, air=air_at(FREE_AIR_TEMPERATURE)))[0]) == pytest.approx(base)
    thin = float(np.cbrt(free_film_cubed(wall, air=air_at(FREE_AIR_TEMPERATURE, 0.8 * 101325.0)))[0])
    assert thin / base == pytest.approx(0.8 ** (2.0 / 3.0))
    cold = float(np.cbrt(free_film_cubed(wall, air=air_at(255.0)))[0])
    assert cold / base == pytest.approx(1.10, abs=0.01)


@pytest.mark.parametrize(
    ("length", "low", "high"), [(0.5, -0.25, -0.11), (1.0, -0.19, -0.06), (3.0, -0.11, -0.01), (10.0, -0.05, 0.03)]
)
def test_law_without_length_against_the_full_one(length: float, low: float, high: float) -> None:
    """How far c dT^(1/3) lies from [ChurchillChu1975] at a wall, 1 to 30 K: under by a quarter at half a metre, and
    within 5 % at a storey and more."""
    difference = np.array([1.0, 3.0, 10.0, 30.0])
    full = free_plate_film(0.0, difference, length, air_at(293.15 + difference / 2.0))
    short = np.cbrt(free_film_cubed(np.array([NORTH]), air=air_at(293.15)) * difference)
    assert ((short / full - 1.0) > low).all()
    assert ((short / full - 1.0) < high).all()


def test_tilted_plate_passes_from_wall_to_roof_without_a_jump() -> None:
    up = np.cos(np.linspace(0.0, math.pi, 721))
    for difference in (-15.0, 15.0):
        film = free_plate_film(up, difference, 2.0, air_at(290.0))
        assert (np.abs(np.diff(film)) < 0.05 * film[:-1]).all()
        assert film.min() > 0.5
        assert film[0 if difference > 0 else -1] > film[-1 if difference > 0 else 0]
    assert np.isfinite(free_plate_film(up, 0.0, 2.0, air_at(290.0))).all()


def _sphere(count: int) -> FloatArray:
    """Unit normals spread over the sphere, the poles and walls along the axes among them."""
    k = np.arange(count) + 0.5
    up, around = 1.0 - 2.0 * k / count, np.pi * (1.0 + 5.0**0.5) * k
    level = np.sqrt(1.0 - up**2)
    spread = np.stack([level * np.cos(around), level * np.sin(around), up], axis=-1)
    return np.concatenate([spread, [UP, DOWN, NORTH, SOUTH, WEST]])


def _turned(normal: FloatArray, angle: float) -> FloatArray:
    """Each normal turned by an angle [rad], in a direction of its own."""
    rng = np.random.default_rng(7)
    side = np.cross(normal, rng.normal(size=normal.shape))
    side /= np.linalg.norm(side, axis=-1, keepdims=True)
    return np.asarray(np.cos(angle) * normal + np.sin(angle) * side)
