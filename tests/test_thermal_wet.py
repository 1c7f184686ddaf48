"""Water at surfaces: the psychrometer, rain by orientation, the film that stays and dries."""

from dataclasses import replace
from datetime import date

import numpy as np
import pytest
from scipy.optimize import brentq
from wall_cases import DARK, constant, indoors, outdoors, slab

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.constants import ZERO_CELSIUS
from sensorsim.environment import Environment, build_environment, read_weather, saturation_vapour_pressure
from sensorsim.materials import WallType, load_catalogue
from sensorsim.thermal import Inside, expose, march, outside_of, surface_boundary
from sensorsim.thermal.air_properties import pressure_at
from sensorsim.thermal.heat_balance import Exposure
from sensorsim.thermal.rain import FILM_CAPACITY, WATER_SPECIFIC_HEAT, caught_rain, rain_film, wet_share
from sensorsim.thermal.vapour import potential_evaporation, psychrometric_constant

UP, SOUTH, NORTH, DOWN = (0.0, 0.0, 1.0), (0.0, -1.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, -1.0)
NORMALS = np.array([UP, SOUTH, NORTH, DOWN])
STEP = 600.0
LIGHT_PLATE = slab(0.01, 0.1, 30.0, 1000.0)


@pytest.fixture(scope="module")
def fall() -> Environment:
    return build_environment(read_weather("fall"), image_day=date(1976, 10, 7), lead_in_days=1.0, step=STEP)


@pytest.fixture(scope="module")
def brick() -> WallType:
    return load_catalogue().wall_type(20, "heated")


def rainy(environment: Environment, rate: float, hours: tuple[float, float], *, wind: float = 4.0) -> Environment:
    """The same weather with rain [mm/h] on its first day and a wind from the south."""
    hour = environment.time / 3600.0
    return replace(
        environment,
        precipitation=np.where((hour >= hours[0]) & (hour < hours[1]), rate, 0.0),
        wind_speed=np.full_like(hour, wind),
        wind_direction=np.full_like(hour, 180.0),
    )


def wet_bulb(air: float, vapour: float, pressure: float) -> float:
    """Temperature [K] of the psychrometer, by its law."""
    gamma = float(psychrometric_constant(np.array(air), pressure))
    return float(
        brentq(lambda t: air - t - (float(saturation_vapour_pressure(np.array(t))) - vapour) / gamma, 230.0, air)
    )


def temperature_of(environment: Environment, exposure: Exposure, wall: WallType) -> np.ndarray:
    """Exterior temperature (t, o) of a wall with outdoor air behind it."""
    air = environment.air_temperature
    inside = Inside(air, air, np.full_like(air, 5.0), 0.0, 0.9)
    return march(
        wall.layers, surface_boundary(environment, exposure, wall), inside, np.array([0.6]), step=environment.step,
        record=np.arange(air.size),
    ).exterior[:, :, 0]  # fmt: skip


@pytest.mark.parametrize(("celsius", "humidity"), [(35.0, 0.2), (20.0, 0.5), (20.0, 1.0), (5.0, 0.3)])
def test_a_shaded_wet_surface_takes_the_wet_bulb_temperature(celsius: float, humidity: float) -> None:
    """Expected: the psychrometer's law, whatever the film; 0.02 K for the two forms of the saturation pressure."""
    air, pressure = celsius + ZERO_CELSIUS, 101325.0
    vapour = humidity * float(saturation_vapour_pressure(np.array(air)))
    gamma = float(psychrometric_constant(np.array(air), pressure))
    for film in (5.0, 50.0):
        still = constant(air, 400)
        outside = outdoors(still, film)._replace(
            latent=np.full((still.size, 1), film / gamma), vapour=constant(vapour, still.size)
        )
        adiabatic = indoors(still, 0.0)
        end = march([LIGHT_PLATE], outside, adiabatic, DARK, step=600.0, record=np.array([399])).exterior[0, 0, 0]
        assert abs(end - wet_bulb(air, vapour, pressure)) < 0.02
        assert end <= air + 1e-9


def test_known_wet_bulb_of_a_psychrometric_table() -> None:
    """20 C and 50 % at sea level: 13.8 C."""
    vapour = 0.5 * float(saturation_vapour_pressure(np.array(293.15)))
    assert wet_bulb(293.15, vapour, 101325.0) == pytest.approx(13.8 + ZERO_CELSIUS, abs=0.15)


def test_water_snow_and_wet_soil_lose_vapour_as_they_lose_heat(fall: Environment) -> None:
    exposure = expose(fall, NORMALS, fall.air_temperature)
    gamma = psychrometric_constant(fall.air_temperature, pressure_at(fall.site.altitude))[:, None]
    wet = replace(fall, ground_state=np.full(fall.time.size, "wet"))
    catalogue = load_catalogue()
    for code, weather in ((98, fall), (99, fall), (90, wet)):
        outside = surface_boundary(weather, exposure, catalogue.wall_type(code, "none"))
        np.testing.assert_allclose(outside.latent, outside.film / gamma, rtol=1e-12)
        assert np.all(outside.free == 0.0)


def test_potential_evaporation_is_that_of_the_full_balance() -> None:
    """Expected: the root of net + h (Ta - T) - s (T^4 - Ta^4) = h / gamma (es(T) - e), within 6 %."""
    pressure = 101325.0
    for net, film, celsius, humidity in ((0.0, 10.0, 20.0, 0.5), (400.0, 20.0, 25.0, 0.4), (-50.0, 8.0, 10.0, 0.8)):
        air = np.array(celsius + ZERO_CELSIUS)
        vapour = humidity * saturation_vapour_pressure(air)
        conductance = film / psychrometric_constant(air, pressure)

        def lost(t: float, c: float = float(conductance), e: float = float(vapour)) -> float:
            return c * (float(saturation_vapour_pressure(np.array(t))) - e)

        def balance(t: float, a: float = float(air), h: float = film, n: float = net) -> float:
            return n + h * (a - t) - SIGMA * (t**4 - a**4) - lost(t)

        exact = lost(brentq(balance, 240.0, 340.0))
        ahead = float(potential_evaporation(np.array(net), np.array(film), air, vapour, pressure))
        assert abs(ahead - exact) < 0.06 * abs(exact) + 2.0


def test_rain_falls_on_tops_and_is_driven_on_walls_that_face_the_wind(fall: Environment) -> None:
    caught = caught_rain(rainy(fall, 8.0, (0.0, 24.0), wind=3.0), NORMALS)[10] * 3600.0
    driven = 2.0 / 9.0 * 3.0 * 8.0 ** (8.0 / 9.0)
    np.testing.assert_allclose(caught, [8.0, driven, 0.0, 0.0], rtol=1e-12, atol=1e-9)
    calm = caught_rain(rainy(fall, 8.0, (0.0, 24.0), wind=0.0), NORMALS)[10] * 3600.0
    np.testing.assert_allclose(calm, [8.0, 0.0, 0.0, 0.0], atol=1e-12)
    cold = replace(rainy(fall, 8.0, (0.0, 24.0)), air_temperature=np.full_like(fall.air_temperature, 270.0))
    assert caught_rain(cold, NORMALS).max() == 0.0


def test_rain_takes_up_the_heat_of_its_own_warming() -> None:
    """10 mm an hour, 1 K: 10 kg m-2 times 4186 J kg-1 in an hour."""
    assert rain_film(np.array(10.0 / 3600.0)) == pytest.approx(10.0 * WATER_SPECIFIC_HEAT / 3600.0)


def test_the_film_of_water_fills_holds_and_dries(fall: Environment) -> None:
    weather = rainy(fall, 2.0, (6.0, 8.0))
    exposure = expose(weather, NORMALS, weather.air_temperature)
    caught = caught_rain(weather, NORMALS)
    film = np.full(caught.shape, 15.0)
    share = wet_share(weather, exposure, caught, film, FILM_CAPACITY, 98000.0)
    hour = weather.time / 3600.0
    assert share.min() >= 0.0
    assert share.max() <= 1.0
    assert np.all(share[hour <= 6.0] == 0.0)
    np.testing.assert_allclose(share[(hour > 6.5) & (hour < 8.0), 0], 1.0)
    assert np.all(share[hour > 15.0, 0] == 0.0), "a roof dries by the afternoon"
    assert np.all(share[:, 2:] == 0.0), "no rain on the lee wall nor below"
    lost = np.maximum(np.diff(share[:, 0]), -1.0)
    assert np.all(lost[hour[1:] > 8.5] <= 1e-12), "it only dries after the rain"


def test_dry_weather_leaves_a_wall_as_it_was(fall: Environment, brick: WallType) -> None:
    exposure = expose(fall, NORMALS, fall.air_temperature)
    plain = outside_of(fall, exposure, emissivity=brick.emissivity, roughness=brick.roughness)
    full = surface_boundary(fall, exposure, brick)
    for name in plain._fields:
        np.testing.assert_array_equal(getattr(full, name), getattr(plain, name))


def test_a_shower_cools_a_sunlit_roof_and_leaves_it_dry_again(fall: Environment, brick: WallType) -> None:
    wet_weather = rainy(fall, 5.0, (11.0, 12.0))
    dry_weather = replace(wet_weather, precipitation=np.zeros_like(fall.time))
    exposure = expose(wet_weather, NORMALS, fall.air_temperature)
    dry, wet = (temperature_of(weather, exposure, brick) for weather in (dry_weather, wet_weather))
    hour = fall.time / 3600.0
    np.testing.assert_array_equal(dry[hour <= 10.9], wet[hour <= 10.9])
    during = np.argmin(np.abs(hour - 11.9))
    assert dry[during, 0] - wet[during, 0] > 3.0, "the roof"
    assert dry[during, 1] - wet[during, 1] > 1.0, "the wall that faces the wind"
    np.testing.assert_allclose(dry[during, 3], wet[during, 3], atol=1e-9)
    assert np.abs(dry[-1] - wet[-1]).max() < 1.0
