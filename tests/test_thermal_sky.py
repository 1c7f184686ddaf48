"""Daylight and thermal radiation of the sky on tilted surfaces, for both skies."""

import math
import time
from dataclasses import replace
from datetime import date

import numpy as np
import pytest
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.environment import (
    Environment,
    Sunlight,
    SunPosition,
    build_environment,
    perez_irradiance,
    read_weather,
    sky_brightness,
)
from sensorsim.errors import InputError
from sensorsim.tables.orientations import orientation_set
from sensorsim.thermal import expose, ground_view_factor, sky_view_factor
from sensorsim.thermal.heat_balance import (
    SKIES,
    directional_irradiance,
    longwave_irradiance,
    reflected_irradiance,
    sky_irradiance,
    solar_irradiance,
)

FloatArray = NDArray[np.float64]

WALLS = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0]])  # N, E, S, W
UP, DOWN = np.array([[0.0, 0.0, 1.0]]), np.array([[0.0, 0.0, -1.0]])
EVERYWHERE = np.concatenate([orientation_set("icosphere162").normal, WALLS, UP, DOWN])

# pvlib 0.16.1 at Fairborn, Ohio, clear sky of [Ineichen2002]: apparent elevation and azimuth of the sun [deg],
# extraterrestrial, beam and diffuse irradiance [W m-2], diffuse irradiance of the N, E, S and W wall by pvlib's
# irradiance.perez. Winter, summer and fall day of the report.
PVLIB = [
    (22.046, 135.317, 1405.261, 749.321, 56.966, (32.308, 78.047, 78.557, 32.308)),
    (34.748, 182.860, 1405.261, 871.405, 75.315, (42.607, 42.607, 86.658, 44.807)),
    (10.057, 240.222, 1405.261, 459.644, 30.765, (19.303, 19.303, 50.702, 74.178)),
    (9.546, 88.213, 1342.724, 225.082, 36.748, (20.529, 84.457, 18.470, 18.470)),
    (57.030, 191.320, 1342.724, 805.615, 137.536, (51.270, 51.270, 108.849, 62.797)),
    (22.885, 260.035, 1342.724, 553.393, 84.895, (42.093, 42.093, 57.731, 131.100)),
    (3.472, 100.141, 1368.550, 49.622, 6.797, (3.713, 26.680, 7.821, 3.713)),
    (43.685, 192.501, 1368.550, 817.658, 108.625, (48.605, 48.605, 113.688, 63.035)),
]


def _sun(elevation: float, azimuth: float) -> SunPosition:
    up, around = math.radians(elevation), math.radians(azimuth)
    direction = [math.cos(up) * math.sin(around), math.cos(up) * math.cos(around), math.sin(up)]
    level = np.array([elevation])
    return SunPosition(
        direction=np.array([direction]), elevation=level, true_elevation=level, azimuth=np.array([azimuth])
    )


def _light(beam: float, diffuse: float, extraterrestrial: float = 1400.0) -> Sunlight:
    return Sunlight(beam=np.array([beam]), diffuse=np.array([diffuse]), extraterrestrial=np.array([extraterrestrial]))


def _perez(sun: SunPosition, light: Sunlight, normal: FloatArray) -> FloatArray:
    return perez_irradiance(light.diffuse, sky_brightness(light, sun), sun.direction, normal)[0]


@pytest.fixture(scope="module")
def winter() -> Environment:
    return build_environment(read_weather("winter"), image_day=date(1976, 2, 7), lead_in_days=1)


# --- daylight ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("row", PVLIB, ids=lambda row: f"{row[0]:.0f}deg")
def test_walls_get_what_pvlib_gives_them(
    row: tuple[float, float, float, float, float, tuple[float, float, float, float]],
) -> None:
    elevation, azimuth, extraterrestrial, beam, diffuse, expected = row
    found = _perez(_sun(elevation, azimuth), _light(beam, diffuse, extraterrestrial), WALLS)
    assert found == pytest.approx(expected, abs=0.02 * diffuse)


def test_winter_day_has_the_diffuse_walls_of_pvlib(winter: Environment) -> None:
    """The whole road from weather to wall: rows of 10, 13 and 17 h."""
    for hour, expected in ((10, PVLIB[0][5]), (13, PVLIB[1][5]), (17, PVLIB[2][5])):
        sample = winter.image_window.start + 12 * hour
        assert sky_irradiance(winter, WALLS)[sample] == pytest.approx(expected, abs=0.3)


def test_quarters_underestimate_walls_under_a_clear_sky(winter: Environment) -> None:
    """By 25 to 60 % with the sun well up: the horizon is brighter than a quarter's mean."""
    sunny = winter.sun_elevation > 10.0
    ratio = sky_irradiance(winter, WALLS, sky="quadrants")[sunny] / sky_irradiance(winter, WALLS)[sunny]
    lost = 1.0 - ratio
    assert lost.min() > 0.15
    assert lost.max() < 0.75
    assert 0.25 < lost.mean() < 0.60


@pytest.mark.parametrize("sky", SKIES)
def test_level_surface_gets_the_diffuse_irradiance(winter: Environment, sky: str) -> None:
    high = winter.sun_elevation > 5.0
    np.testing.assert_allclose(sky_irradiance(winter, UP, sky=sky)[high, 0], winter.diffuse_irradiance[high], rtol=1e-9)
    assert sky_irradiance(winter, UP, sky=sky).max() < 1.001 * winter.diffuse_irradiance.max()
    np.testing.assert_allclose(sky_irradiance(winter, DOWN, sky=sky), 0.0, atol=1e-9)


@pytest.mark.parametrize("diffuse", [40.0, 100.0, 150.0])
def test_overcast_sky_is_all_but_uniform(diffuse: float) -> None:
    """No beam: a tenth of the diffuse irradiance at most beside (1 + cos tilt) / 2 at any tilt, by a dim horizon.

    Twice as bright a sky is thin cloud, through which the sun still glows.
    """
    found = _perez(_sun(35.0, 150.0), _light(0.0, diffuse), EVERYWHERE)
    np.testing.assert_allclose(found / diffuse, sky_view_factor(EVERYWHERE), atol=0.10)


def test_overcast_quarters_are_uniform(winter: Environment) -> None:
    quarter = np.repeat(winter.diffuse_irradiance[:, None] / 4.0, 4, axis=1)
    overcast = replace(winter, quadrant_irradiance=quarter)
    found = sky_irradiance(overcast, EVERYWHERE, sky="quadrants")
    expected = np.outer(winter.diffuse_irradiance, sky_view_factor(EVERYWHERE))
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("elevation", [-90.0, -10.0, -0.1, 0.0, 1e-6, 0.5, 4.999, 5.0, 45.0, 89.999, 90.0])
@pytest.mark.parametrize(("beam", "diffuse"), [(0.0, 0.0), (0.0, 1e-9), (1e-9, 0.0), (900.0, 1.0), (0.0, 500.0)])
def test_no_height_of_the_sun_and_no_light_breaks_the_sky(elevation: float, beam: float, diffuse: float) -> None:
    found = _perez(_sun(elevation, 200.0), _light(beam, diffuse), EVERYWHERE)
    assert np.isfinite(found).all()
    assert (found >= 0.0).all()
    assert found.max() <= 20.0 * diffuse


@pytest.mark.parametrize("sky", SKIES)
def test_whole_days_are_finite_and_never_negative(winter: Environment, sky: str) -> None:
    found = solar_irradiance(winter, EVERYWHERE, sky=sky)
    assert np.isfinite(found).all()
    assert (found >= 0.0).all()
    night = winter.sun_elevation < -1.0
    np.testing.assert_allclose(found[night], 0.0, atol=1e-12)
    assert found.max() < 1400.0


@pytest.mark.parametrize("sky", SKIES)
def test_small_turns_make_small_changes(winter: Environment, sky: str) -> None:
    """A hundredth of a degree changes no surface's daylight by more than a thousandth of the greatest."""
    rng = np.random.default_rng(5)
    side = np.cross(EVERYWHERE, rng.normal(size=EVERYWHERE.shape))
    side /= np.linalg.norm(side, axis=-1, keepdims=True)
    turned = EVERYWHERE + math.radians(0.01) * side
    turned /= np.linalg.norm(turned, axis=-1, keepdims=True)
    before, after = (sky_irradiance(winter, normal, sky=sky) for normal in (EVERYWHERE, turned))
    assert np.abs(after - before).max() < 1e-3 * before.max()


@pytest.mark.parametrize("sky", SKIES)
def test_what_is_left_without_the_suns_direction_has_no_terminator(winter: Environment, sky: str) -> None:
    """Walls at one tilt differ only by what comes from the sun's direction, and by the quarter that they face."""
    direct = directional_irradiance(winter, sky=sky)[:, None] * np.maximum(winter.sun_direction @ WALLS.T, 0.0)
    ground = np.outer(reflected_irradiance(winter), ground_view_factor(WALLS))
    rest = solar_irradiance(winter, WALLS, sky=sky) - direct - ground
    if sky == "perez":
        np.testing.assert_allclose(rest, rest[:, :1] * np.ones(4), atol=1e-9)
    else:
        np.testing.assert_allclose(rest, sky_irradiance(winter, WALLS, sky=sky), atol=1e-9)


@pytest.mark.parametrize("layout", ["icosphere162", "icosphere642"])
def test_sky_costs_little(layout: str) -> None:
    weather = read_weather("winter")
    environment = build_environment(weather, image_day=date(1976, 2, 7), lead_in_days=4)
    normal = orientation_set(layout).normal
    sky_irradiance(environment, normal)
    begun = time.perf_counter()
    sky_irradiance(environment, normal)
    assert time.perf_counter() - begun < 0.2


def test_unknown_sky_is_refused(winter: Environment) -> None:
    with pytest.raises(InputError, match="use one of perez, quadrants"):
        expose(winter, UP, winter.air_temperature, sky="isotropic")


# --- thermal radiation ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("sky", SKIES)
def test_closed_isothermal_world_exchanges_nothing(winter: Environment, sky: str) -> None:
    """Sky, ground and air at one temperature send every surface what it radiates itself."""
    for kelvin in (210.0, 273.15, 320.0):
        same = np.full_like(winter.time, kelvin)
        world = replace(winter, sky_temperature=same, air_temperature=same)
        received = longwave_irradiance(world, EVERYWHERE, same, sky=sky)
        np.testing.assert_allclose(received, STEFAN_BOLTZMANN_CONSTANT * kelvin**4, rtol=1e-12)


@pytest.mark.parametrize("sky", SKIES)
def test_level_surfaces_see_the_sky_or_the_ground_alone(winter: Environment, sky: str) -> None:
    ground = np.full_like(winter.time, 290.0)
    received = longwave_irradiance(winter, np.concatenate([UP, DOWN]), ground, sky=sky)
    np.testing.assert_allclose(received[:, 0], STEFAN_BOLTZMANN_CONSTANT * winter.sky_temperature**4, rtol=1e-12)
    np.testing.assert_allclose(received[:, 1], STEFAN_BOLTZMANN_CONSTANT * 290.0**4, rtol=1e-12)


# LOWTRAN7, rural aerosol 23 km or closed altostratus: air temperature [K], irradiance [W m-2] of a level surface and
# of surfaces tilted by 60, 90 and 120 degrees, by the sky alone; radiances between 4 and 100 um integrated over it.
LOWTRAN = [
    (299.7, 385.8, (297.4, 203.0, 104.4)),
    (294.2, 345.0, (267.5, 183.4, 94.9)),
    (288.15, 284.2, (221.4, 152.3, 79.3)),
    (272.2, 225.9, (175.8, 120.8, 62.8)),
    (257.2, 180.0, (140.3, 96.6, 50.3)),
    (294.2, 407.1, (306.8, 205.4, 103.3)),
    (272.2, 296.4, (223.2, 149.3, 75.0)),
]


@pytest.mark.parametrize("row", LOWTRAN, ids=lambda row: f"{row[0]:.0f}K")
def test_walls_see_the_warm_horizon_that_lowtran_finds(row: tuple[float, float, tuple[float, float, float]]) -> None:
    """Within 3 W/m2 at any tilt; a sky that is the same all over gives a wall 7 to 11 W/m2 less when it is clear."""
    air, level, expected = row
    sky_alone = np.full(1, 1e-3)
    tilt = np.radians([60.0, 90.0, 120.0])
    normal = np.stack([np.sin(tilt), np.zeros(3), np.cos(tilt)], axis=-1)
    environment = build_environment(read_weather("winter"), image_day=date(1976, 2, 7), lead_in_days=0)
    world = replace(
        environment,
        air_temperature=np.full(1, air),
        sky_temperature=np.full(1, (level / STEFAN_BOLTZMANN_CONSTANT) ** 0.25),
    )
    found = longwave_irradiance(world, normal, sky_alone)[0]
    uniform = longwave_irradiance(world, normal, sky_alone, sky="quadrants")[0]
    assert np.abs(found - expected).max() < 3.0
    assert np.abs(found - expected).max() < np.abs(uniform - expected).max()
    if level < 0.9 * STEFAN_BOLTZMANN_CONSTANT * air**4:
        assert 6.0 < expected[1] - uniform[1] < 11.5
