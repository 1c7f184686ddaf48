"""Soil, plants, water, snow, roads and thin sheets, each held to its own limits."""

from dataclasses import replace
from datetime import date

import numpy as np
import pytest

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.constants import ZERO_CELSIUS
from sensorsim.effects import EVERYTHING
from sensorsim.environment import Environment, build_environment, read_weather, saturation_vapour_pressure
from sensorsim.materials import Catalogue, Cover, WallType, load_catalogue
from sensorsim.scene import load_scene
from sensorsim.tables.assign import SNOW_CODE, assign_wall_types
from sensorsim.thermal import (
    History,
    Outside,
    Season,
    build_interior,
    expose,
    ground_temperature,
    growing_season_index,
    march,
    season_of,
    surface_boundary,
)
from sensorsim.thermal.boundary import outside_at
from sensorsim.thermal.heat_balance import Exposure, outside_of
from sensorsim.thermal.natural import (
    aerodynamic_film,
    canopy_resistance,
    cool_skin,
    effective_wind,
    melting_depth,
)

STEP = 600.0
UP = np.array([[0.0, 0.0, 1.0]])
LAWN, MEADOW, TREES, CONIFERS, WATER = 94, 95, 96, 97, 98
DAYS = {"winter": date(1976, 2, 7), "summer": date(1976, 9, 3), "fall": date(1976, 10, 7)}


@pytest.fixture(scope="module")
def catalogue() -> Catalogue:
    return load_catalogue()


@pytest.fixture(scope="module")
def weather() -> dict[str, Environment]:
    return {
        name: build_environment(read_weather(name), image_day=day, lead_in_days=3.0, step=STEP)
        for name, day in DAYS.items()
    }


def solve(environment: Environment, wall: WallType, exposure: Exposure, reflectance: float) -> tuple[History, Outside]:
    """History of a plane at every sample, and what acted on it."""
    outside = surface_boundary(environment, exposure, wall)
    air = environment.air_temperature
    inside = build_interior(wall.interior, air, environment.wind_speed, environment.step, 0.9)
    history = march(
        wall.layers, outside, inside, np.array([1.0 - reflectance]), step=environment.step,
        record=np.arange(air.size), melting_depth=melting_depth(wall),
    )  # fmt: skip
    return history, outside


def level(environment: Environment, wall: WallType, reflectance: float) -> np.ndarray:
    """Temperature (t,) [K] of a level surface under the open sky."""
    exposure = expose(environment, UP, environment.air_temperature)
    return solve(environment, wall, exposure, reflectance)[0].exterior[:, 0, 0]


def steady(
    environment: Environment, *, celsius: float, humidity: float, wind: float, sun: float
) -> tuple[Environment, Exposure]:
    """A day that does not change, under a clear sky 20 K below the air."""
    count = environment.time.size
    air = np.full(count, celsius + ZERO_CELSIUS)
    still = replace(
        environment,
        air_temperature=air,
        vapour_pressure=humidity * saturation_vapour_pressure(air),
        relative_humidity=np.full(count, humidity),
        wind_speed=np.full(count, wind),
        sun_direction=np.tile([0.0, 0.0, 1.0], (count, 1)),
        beam_irradiance=np.full(count, 0.85 * sun),
        diffuse_irradiance=np.full(count, 0.15 * sun),
    )
    exposure = Exposure(normal=UP, irradiance=np.full((count, 1), sun), longwave=(SIGMA * (air - 20.0) ** 4)[:, None])
    return still, exposure


def with_cover(wall: WallType, **changes: float) -> WallType:
    assert wall.cover is not None
    return replace(wall, cover=replace(wall.cover, **changes))


@pytest.mark.parametrize("code", [LAWN, MEADOW, TREES, CONIFERS])
def test_transpiring_leaves_stay_near_the_air(code: int, catalogue: Catalogue, weather: dict[str, Environment]) -> None:
    """At 800 W m-2, 2 m/s, 25 C, 50 %: 0 to 8 K above the air, most heat latent; 0.23 is grass's albedo [Allen1998]."""
    environment, exposure = steady(weather["summer"], celsius=25.0, humidity=0.5, wind=2.0, sun=800.0)
    wall = catalogue.wall_type(code, "none")
    history, outside = solve(environment, wall, exposure, 0.23)
    leaf = history.exterior[-1, 0, 0]
    warmer = leaf - environment.air_temperature[-1]
    assert 0.0 < warmer < 8.0
    sensible = outside.film[-1, 0] * warmer
    latent = outside.latent[-1, 0] * (float(saturation_vapour_pressure(np.array(leaf))) - outside.vapour[-1])
    bowen = sensible / latent
    low, high = (0.1, 1.0) if code in (LAWN, MEADOW) else (0.1, 1.5)
    assert low < bowen < high, bowen
    assert latent < 800.0


def test_without_transpiration_a_canopy_is_the_dry_solution(
    catalogue: Catalogue, weather: dict[str, Environment]
) -> None:
    environment = weather["summer"]
    exposure = expose(environment, UP, environment.air_temperature)
    wall = catalogue.wall_type(LAWN, "none")
    closed, outside = solve(environment, with_cover(wall, stomatal_resistance=1e15), exposure, 0.2)
    dry = outside._replace(latent=np.zeros((1, 1)), vapour=np.zeros(0))
    air = environment.air_temperature
    inside = build_interior("none", air, environment.wind_speed, STEP, 0.9)
    bare = march(wall.layers, dry, inside, np.array([0.8]), step=STEP, record=np.arange(air.size))
    np.testing.assert_allclose(closed.exterior, bare.exterior, rtol=0.0, atol=1e-6)
    open_leaves = level(environment, wall, 0.2)
    warmest = int(np.argmax(bare.exterior[:, 0, 0]))
    assert bare.exterior[warmest, 0, 0] - open_leaves[warmest] > 3.0


def test_vegetation_of_the_three_days_stays_near_the_air_by_day(
    catalogue: Catalogue, weather: dict[str, Environment]
) -> None:
    """11 K at most for grass, on a sunny day with hardly a wind, 8 K on the two others; 4.5 K for crowns."""
    for name, environment in weather.items():
        season = season_of(environment)
        sun = environment.image_window
        grass = 11.0 if name == "fall" else 8.0
        for code, limit in ((LAWN, grass), (MEADOW, grass), (TREES, 4.5), (CONIFERS, 4.5)):
            wall = catalogue.wall_type(code, "none", leafless=season.leafless)
            over = level(environment, wall, 0.15)[sun] - environment.air_temperature[sun]
            assert over.max() < limit, (name, code)
            assert over.min() > -6.0, (name, code)


def test_stomata_close_in_the_dark_the_cold_and_dry_air(catalogue: Catalogue, weather: dict[str, Environment]) -> None:
    cover = catalogue.wall_type(TREES, "none").cover
    assert cover is not None

    def resistance(celsius: float, humidity: float, sun: float) -> float:
        environment, _ = steady(weather["fall"], celsius=celsius, humidity=humidity, wind=2.0, sun=sun)
        dark = np.zeros_like(environment.beam_irradiance)
        lit = replace(environment, beam_irradiance=dark, diffuse_irradiance=dark + sun)
        return float(canopy_resistance(lit, cover)[0])

    best = resistance(25.0, 1.0, 1000.0)
    assert best == pytest.approx(cover.stomatal_resistance / cover.leaf_area_index, rel=0.1)
    for worse in ((25.0, 1.0, 100.0), (5.0, 1.0, 1000.0), (25.0, 0.2, 1000.0)):
        assert resistance(*worse) > 1.3 * best
    assert resistance(25.0, 1.0, 0.0) > 10.0 * best


def test_the_seasons_of_the_three_days(weather: dict[str, Environment]) -> None:
    seasons = {name: season_of(environment) for name, environment in weather.items()}
    assert {name: season.leafless for name, season in seasons.items()} == {
        "winter": True, "summer": False, "fall": False,
    }  # fmt: skip
    assert not any(season.snow for season in seasons.values())
    assert growing_season_index(weather["summer"]) == pytest.approx(1.0, abs=0.02)
    warm = replace(weather["winter"], air_temperature=weather["winter"].air_temperature + 3.0)
    assert growing_season_index(weather["winter"]) < growing_season_index(warm) < 0.5, "the day is still short"


def test_bare_trees_show_bark_near_the_temperature_of_the_air(
    catalogue: Catalogue, weather: dict[str, Environment]
) -> None:
    """Expected: no vapour, the emissivity of bark, 0 to 4 K above a windy winter day's air."""
    bare = catalogue.wall_type(TREES, "none", leafless=True)
    leaves = catalogue.wall_type(TREES, "none")
    material = catalogue.material(TREES)
    assert material.leafless is not None
    assert bare.emissivity == material.leafless.emissivity.value != leaves.emissivity
    environment = weather["winter"]
    exposure = expose(environment, UP, environment.air_temperature)
    outside = surface_boundary(environment, exposure, bare)
    assert not np.any(outside.latent)
    np.testing.assert_allclose(outside.irradiance, exposure.irradiance * material.leafless.interception.value)
    over = (level(environment, bare, 0.14) - environment.air_temperature)[environment.image_window]
    assert -2.0 < over.min() < over.max() < 4.0
    conifer = catalogue.wall_type(CONIFERS, "none", leafless=True)
    assert conifer == catalogue.wall_type(CONIFERS, "none"), "conifers keep their needles"


def test_moist_soil_is_cooler_than_dry_and_wet_coolest(catalogue: Catalogue, weather: dict[str, Environment]) -> None:
    environment, soil = weather["summer"], catalogue.wall_type(90, "none")
    noon = environment.image_window.start + round(13.0 * 3600.0 / STEP)
    dry = level(environment, with_cover(soil, moisture=0.0), 0.25)[noon]
    moist = level(environment, soil, 0.25)[noon]
    wet = replace(environment, ground_state=np.full(environment.time.size, "wet"))
    soaked = level(wet, soil, 0.25)[noon]
    assert dry - 0.5 > moist > soaked + 2.0
    exposure = expose(environment, UP, environment.air_temperature)
    assert not np.any(surface_boundary(environment, exposure, with_cover(soil, moisture=0.0)).latent)


def test_water_hardly_follows_the_day_and_has_a_cool_skin(
    catalogue: Catalogue, weather: dict[str, Environment]
) -> None:
    """Expected: amplitude below 2 K; 0.02 to 0.6 K colder than just below, in the mean near 0.2 K [Fairall1996]."""
    wall, environment = catalogue.wall_type(WATER, "none"), weather["summer"]
    exposure = expose(environment, UP, environment.air_temperature)
    history, outside = solve(environment, wall, exposure, 0.07)
    day = environment.image_window
    below = history.exterior[day]
    assert 0.5 * np.ptp(below) < 2.0
    assert wall.cover is not None
    samples = np.arange(day.start, day.stop)
    cooler = below - cool_skin(below, outside, samples, wall.cover)
    assert 0.02 < cooler.min() < cooler.max() < 0.6
    assert abs(float(cooler.mean()) - 0.2) < 0.15
    thin = cool_skin(below, outside, samples, replace(wall.cover, skin=0.0))
    np.testing.assert_array_equal(thin, below)


def test_snow_never_gets_above_freezing_and_its_melt_is_counted(
    catalogue: Catalogue, weather: dict[str, Environment]
) -> None:
    """Expected: heat through both faces equals heat stored and heat melted, to rounding."""
    environment, snow = weather["winter"], catalogue.wall_type(SNOW_CODE, "none")
    exposure = expose(environment, UP, environment.air_temperature)
    history, _ = solve(environment, snow, exposure, 0.7)
    assert history.exterior[1:].max() <= ZERO_CELSIUS
    assert history.melted[0, 0] > 0.0
    balance = history.heat.sum(axis=0) - history.stored - history.melted
    assert np.abs(balance).max() < 1e-9 * np.abs(history.heat).max()
    cold = replace(environment, air_temperature=environment.air_temperature - 25.0)
    frozen, _ = solve(cold, snow, expose(cold, UP, cold.air_temperature), 0.7)
    assert frozen.melted.max() == 0.0
    covered = replace(environment, ground_state=np.full(environment.time.size, "snow"))
    assert ground_temperature(covered, snow).max() <= ZERO_CELSIUS


def test_ground_of_snow_is_held_at_freezing_by_its_melting_alone(
    weather: dict[str, Environment], catalogue: Catalogue
) -> None:
    """In air of 15 K more, from the first step on, without the cap that other ground has under snow."""
    snow, mild = catalogue.wall_type(SNOW_CODE, "none"), weather["winter"]
    state = np.full(mild.time.size, "snow")
    mild = replace(mild, air_temperature=mild.air_temperature + 15.0, ground_state=state)
    alone = ground_temperature(mild, snow, plan=EVERYTHING.without("snow"))[1:]
    assert alone.max() <= ZERO_CELSIUS + 1e-9
    assert np.mean(alone >= ZERO_CELSIUS - 1e-9) > 0.5
    np.testing.assert_array_equal(ground_temperature(mild, snow)[1:], alone)


def test_snow_lies_on_every_ground_of_the_scene_but_not_on_trees_blocks_and_roofs(catalogue: Catalogue) -> None:
    scene = load_scene("hospital", level="IIIB")
    assignment = assign_wall_types(scene, catalogue, Season(leafless=True, snow=True))
    codes = np.array([assignment.wall_types[row].code for row in assignment.wall_type])
    ground = scene.surfaces.role == "plane"
    outdoor = {"9420", "9523", "9020", "8038"}
    for word in outdoor:
        assert np.all(codes[ground & (scene.surfaces.word == word)] == SNOW_CODE)
    assert not np.any(codes[~ground] == SNOW_CODE)
    assert np.all(assignment.reflectance[codes == SNOW_CODE] == pytest.approx(0.7))


def test_wind_has_gusts_by_day_and_hardly_any_by_night(weather: dict[str, Environment]) -> None:
    for environment in weather.values():
        gust = np.sqrt(effective_wind(environment) ** 2 - environment.wind_speed**2)
        night = environment.sun_elevation < -6.0
        np.testing.assert_allclose(gust[night], 0.2, atol=1e-9)
        assert 1.0 < gust.max() < 2.5


def test_the_taller_the_plants_the_closer_to_the_air(weather: dict[str, Environment]) -> None:
    films = [float(aerodynamic_film(weather["fall"], Cover(kind="plants", height=h)).mean()) for h in (0.1, 0.4, 12.0)]
    assert films[0] < films[1] < films[2]
    environment, _ = steady(weather["fall"], celsius=15.0, humidity=0.5, wind=2.0, sun=0.0)
    reference = Cover(kind="plants", height=0.12)
    wind_at_two = 2.0 * np.log((2.0 - 0.08) / 0.01476) / np.log((10.04) / 0.01476)
    expected = 1.19 * 1006.0 / (208.0 / wind_at_two)
    assert aerodynamic_film(environment, reference)[0] == pytest.approx(expected, rel=0.06), "[Allen1998] 208 / u"


def test_traffic_warms_a_road_by_day_only(catalogue: Catalogue, weather: dict[str, Environment]) -> None:
    road, environment = catalogue.wall_type(81, "none"), weather["fall"]
    assert road.cover is not None
    assert road.cover.traffic_heat == 0.0
    quiet, busy = (level(environment, with_cover(road, traffic_heat=heat), 0.1) for heat in (0.0, 20.0))
    hour = np.arange(quiet.size) * STEP / 3600.0
    assert np.all(quiet[hour < 6.0] == busy[hour < 6.0])
    warmer = (busy - quiet)[(hour % 24.0 > 12.0) & (hour % 24.0 < 20.0)]
    assert 0.5 < warmer.min() < warmer.max() < 3.0


def test_a_sheet_on_the_ground_has_soil_below_it(catalogue: Catalogue, weather: dict[str, Environment]) -> None:
    sheet = catalogue.wall_type(12, "none")
    assert sheet.layers == (*catalogue.wall_type(12, "heated").layers, catalogue.soil)
    for code in (80, 81, *range(90, 100)):
        assert catalogue.wall_type(code, "none").layers == catalogue.wall_type(code, "heated").layers
    swing = np.ptp(level(weather["fall"], sheet, 0.2)[weather["fall"].image_window])
    assert swing > 10.0, "the deep ground does not hold it"


def test_air_passes_below_the_bridges_of_the_hospital_scene() -> None:
    for name in ("IIA", "IIIB"):
        bridges = [
            feature for feature in load_scene("hospital", level=name).features if feature.description == "Bridge"
        ]
        assert [feature.interior for feature in bridges] == ["open"]
        assert bridges[0].interior_note


@pytest.mark.parametrize("correlation", ["mowitt", "mowitt_local"])
def test_all_wall_types_share_what_acts_on_smooth_buildings(
    catalogue: Catalogue, weather: dict[str, Environment], correlation: str
) -> None:
    """By these correlations a rough wall's film is so many times a smooth one's, dry or wet, and on any ground."""
    environment = replace(weather["fall"], precipitation=np.where(np.arange(weather["fall"].time.size) < 50, 2.0, 0.0))
    normal = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, -0.6, 0.8]])
    exposure = expose(environment, normal, environment.air_temperature)
    smooth = outside_of(environment, exposure, emissivity=1.0, roughness="very_smooth", correlation=correlation)
    for code in (12, 20, 25, 91, 92, 94, 96, 98, 99):
        wall = catalogue.wall_type(code, "none")
        own = surface_boundary(environment, exposure, wall, correlation=correlation)
        shared = surface_boundary(environment, exposure, wall, correlation=correlation, smooth=smooth)
        for mine, its in zip(own, shared, strict=True):
            np.testing.assert_allclose(mine, its, rtol=1e-13, atol=1e-300)
        chosen = np.array([True, False, True])
        part = Exposure(
            normal=normal[chosen], irradiance=exposure.irradiance[:, chosen], longwave=exposure.longwave[:, chosen]
        )
        some = surface_boundary(environment, part, wall, correlation=correlation, smooth=outside_at(smooth, chosen))
        for mine, its in zip(outside_at(shared, chosen), some, strict=True):
            np.testing.assert_allclose(mine, its, rtol=1e-13, atol=1e-300)
