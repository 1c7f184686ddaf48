"""What a wall is exposed to: rooms behind it, the ground before it, the sun on it."""

from collections.abc import Iterator
from dataclasses import replace
from datetime import date

import numpy as np
import pytest

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.environment import Environment, build_environment, read_weather
from sensorsim.errors import InputError
from sensorsim.materials import WallType, load_catalogue
from sensorsim.thermal import build_interior, expose, ground_temperature, outside_of

STEP = 600.0
CONDITIONS = ("heated", "cooled", "unheated", "open", "none")
LOWEST_HEATED, HIGHEST_COOLED = ZERO_CELSIUS + (65.0 - 32.0) / 1.8, ZERO_CELSIUS + (75.0 - 32.0) / 1.8


@pytest.fixture(scope="module")
def summer() -> Environment:
    return build_environment(read_weather("summer"), image_day=date(1976, 9, 3), lead_in_days=2.0, step=STEP)


@pytest.fixture(scope="module")
def winter() -> Environment:
    return build_environment(read_weather("winter"), image_day=date(1976, 2, 7), lead_in_days=2.0, step=STEP)


@pytest.fixture(scope="module")
def soil() -> WallType:
    return load_catalogue().wall_type(93, "none")


def _swinging_air() -> np.ndarray:
    return 290.0 + 25.0 * np.sin(2.0 * np.pi * np.arange(6 * 144) / 144)


def _rooms(air: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    for condition in CONDITIONS:
        yield condition, build_interior(condition, air, np.full_like(air, 3.0), STEP, 0.9).air


def test_conditioned_rooms_stay_within_the_reports_limits() -> None:
    """Heated above 65 F, cooled within 65 to 75 F, whatever the weather: section 3.1.3 of the report."""
    for offset in (-40.0, 0.0, 25.0):
        rooms = dict(_rooms(_swinging_air() + offset))
        assert rooms["heated"].min() >= LOWEST_HEATED - 1e-9
        assert rooms["cooled"].min() >= LOWEST_HEATED - 1e-9
        assert rooms["cooled"].max() <= HIGHEST_COOLED + 1e-9


def test_open_room_is_outdoor_air_and_deep_ground_its_mean() -> None:
    air = _swinging_air()
    rooms = dict(_rooms(air))
    np.testing.assert_array_equal(rooms["open"], air)
    np.testing.assert_allclose(rooms["none"], air.mean(), rtol=0.0, atol=1e-9)


def test_closed_room_follows_the_outdoors_later_and_less() -> None:
    """Rationale: first-order lag of half a day. Expected: amplitude and delay of its transfer function."""
    air = _swinging_air()
    room = build_interior("unheated", air, np.zeros_like(air), STEP, 0.9).air
    angle = 2.0 * np.pi * np.arange(air.size) / 144
    swing = 2.0 * np.mean((room[-144:] - 290.0) * np.exp(-1j * angle[-144:])) / (-25.0j)
    exact = 1.0 / (1.0 + 1j * 2.0 * np.pi / 86400.0 * 43200.0)
    assert abs(swing - exact) < 0.01


def test_lag_of_a_room_does_not_depend_on_the_step() -> None:
    fine = 290.0 + 10.0 * np.sin(np.arange(2 * 1440) * 60.0 / 86400.0 * 2.0 * np.pi)
    rooms = [
        build_interior("unheated", fine[::stride].copy(), np.zeros(fine[::stride].size), 60.0 * stride, 0.9).air
        for stride in (1, 10)
    ]
    assert np.abs(rooms[0][::10] - rooms[1]).max() < 0.1


def test_steady_outdoors_make_a_steady_room() -> None:
    for condition, room in _rooms(np.full(100, 294.0)):
        np.testing.assert_allclose(room, 294.0, rtol=0.0, atol=1e-9, err_msg=condition)


def test_unknown_condition_is_refused_with_those_that_are_known() -> None:
    with pytest.raises(InputError, match=r"interior = 'lukewarm'.*heated, cooled, unheated, open, none"):
        build_interior("lukewarm", np.full(3, 290.0), np.zeros(3), STEP, 0.9)


def test_ground_under_snow_never_gets_above_freezing(summer: Environment, soil: WallType) -> None:
    """A warm September day under snow, so that the limit is at work, and the same day dry, so that it is not."""
    snow = replace(summer, ground_state=np.full(summer.time.size, "snow"))
    assert ground_temperature(snow, soil).max() <= ZERO_CELSIUS
    assert ground_temperature(summer, soil).max() > ZERO_CELSIUS + 10.0


def test_snow_that_lies_for_part_of_the_day_limits_that_part_only(summer: Environment, soil: WallType) -> None:
    half = summer.time.size // 2
    state = np.where(np.arange(summer.time.size) < half, "snow", "dry")
    ground = ground_temperature(replace(summer, ground_state=state), soil)
    assert ground[:half].max() <= ZERO_CELSIUS
    assert ground[half:].max() > ZERO_CELSIUS


def test_ground_is_warmer_by_day_than_by_night_and_brighter_ground_is_colder(
    winter: Environment, soil: WallType
) -> None:
    ground = ground_temperature(winter, soil)
    by_day = winter.sun_elevation > 20.0
    assert ground[by_day].mean() > ground[winter.sun_elevation < -20.0].mean() + 2.0
    brighter = ground_temperature(replace(winter, ground_albedo=np.full_like(winter.ground_albedo, 0.8)), soil)
    assert np.all(brighter[by_day] < ground[by_day])


def _normals(count: int) -> np.ndarray:
    vector = np.random.default_rng(8).normal(size=(count, 3))
    return vector / np.linalg.norm(vector, axis=1, keepdims=True)


@pytest.mark.parametrize("sky", ["perez", "quadrants"])
def test_level_surface_gets_the_global_irradiance_and_a_floor_the_grounds(summer: Environment, sky: str) -> None:
    up_and_down = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
    exposure = expose(summer, up_and_down, summer.air_temperature, sky=sky)
    height = np.maximum(summer.sun_direction[:, 2], 0.0)
    total = summer.beam_irradiance * height + summer.diffuse_irradiance
    by_day = summer.sun_elevation > 6.0
    np.testing.assert_allclose(exposure.irradiance[by_day, 0], total[by_day], rtol=1e-9)
    np.testing.assert_allclose(exposure.irradiance[:, 1], summer.ground_albedo * total, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize("sky", ["perez", "quadrants"])
def test_no_light_falls_at_night_and_none_is_negative(winter: Environment, sky: str) -> None:
    exposure = expose(winter, _normals(200), winter.air_temperature, sky=sky)
    assert exposure.irradiance.min() >= 0.0
    assert exposure.irradiance[winter.sun_elevation < -1.0].max() == 0.0


def test_surroundings_at_one_temperature_send_its_blackbody_flux(winter: Environment) -> None:
    """Rationale: isothermal enclosure. Expected: sigma T^4 whatever the tilt, under either sky."""
    same = np.full(winter.time.size, 280.0)
    isothermal = replace(winter, sky_temperature=same, air_temperature=same)
    for sky in ("perez", "quadrants"):
        exposure = expose(isothermal, _normals(100), same, sky=sky)
        np.testing.assert_allclose(exposure.longwave, 5.670374419e-8 * 280.0**4, rtol=1e-12)


def test_roof_sheds_warm_air_and_keeps_cold_air_while_a_wall_does_neither(winter: Environment) -> None:
    """Expected: the cubes of 9.482 / 6.238 and 1.810 / 2.382 for a level surface [Walton1983], whatever the air."""
    normal = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]])
    exposure = expose(winter, normal, winter.air_temperature)
    outside = outside_of(winter, exposure, emissivity=0.9, roughness="rough")
    ratio = np.cbrt(outside.free_colder / outside.free)
    sheds, keeps = 9.482 / 6.238, 1.810 / 2.382
    np.testing.assert_allclose(ratio, [keeps / sheds, sheds / keeps, 1.0], rtol=1e-3)
