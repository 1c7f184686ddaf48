"""Bounds of effects: above tolerance where weather and walls call for one, none where they do not, never too low."""

from dataclasses import replace

import numpy as np
import pytest
from effect_cases import (
    ASPHALT,
    BRICK,
    COARSE,
    GRASS,
    LOAM,
    METAL,
    Change,
    environment,
    measured,
    quiet,
    rainy,
    random_weather,
    situation,
    snowy,
    temperatures,
    thick,
    wall,
)  # fmt: skip

from sensorsim.effects import DEFAULT_NOISE, EFFECTS, EVERYTHING, NOISE_SHARE, SURFACE, EffectPlan, surface_bounds
from sensorsim.environment import Environment, build_environment
from sensorsim.thermal import SKIES

TOLERANCE = DEFAULT_NOISE * NOISE_SHARE
ROUNDING = 1e-9  # [K]
STEPPING = 5e-4  # [K] a march that knows the room's temperatures damps other steps, within its own error of 10 mK
QUARTERED = replace(COARSE, sky="quadrants")
NONE_SET = {
    "temperature",
    "exchange",
    "spare_orientations",
    "spare_reflectances",
    "snow",
}  # not terms of one wall's balance
TERMS = [effect.name for effect in EFFECTS if effect.stage == SURFACE and effect.name not in NONE_SET]
PLAIN = (wall(*BRICK), wall(*METAL))


def dark_quarter(k: int) -> Change:
    def change(weather: Environment) -> Environment:
        quarters = weather.quadrant_irradiance.copy()
        quarters[:, k] = 0.0
        return replace(weather, quadrant_irradiance=quarters)

    return change


QUIET = {
    "direct_sun": quiet(beam_irradiance=0.0),
    "sky_dome": quiet(diffuse_irradiance=0.0),
    "sky_glow": quiet(circumsolar_brightness=0.0),
    "sky_horizon": quiet(horizon_brightness=0.0),
    "sky_north": dark_quarter(0),
    "sky_east": dark_quarter(1),
    "sky_south": dark_quarter(2),
    "sky_west": dark_quarter(3),
    "ground_sun": quiet(ground_albedo=0.0),
    "thermal_sky": quiet(sky_temperature=0.0),
    "forced_convection": quiet(wind_speed=0.0),
    "rain": quiet(precipitation=0.0),
    "evaporation": quiet(precipitation=0.0),
}


@pytest.mark.parametrize("name", QUIET)
def test_weather_that_has_none_of_an_effect_leaves_it_out_and_nothing_changes(name: str) -> None:
    weather, ground = QUIET[name](environment()), wall(*ASPHALT)
    settings = QUARTERED if name[4:] in ("north", "east", "south", "west") else COARSE
    bound = surface_bounds(situation(weather, PLAIN, ground, settings))[name]
    assert bound.value == 0.0
    assert measured(name, weather, PLAIN, ground, settings) <= ROUNDING


@pytest.mark.parametrize("name", TERMS)
def test_weather_with_plenty_of_an_effect_calls_for_it_and_it_is_worth_less_than_its_bound(name: str) -> None:
    """On a brick and a metal wall and a lawn, over bare earth."""
    weather = rainy(environment()) if name == "rain" else environment()
    settings = QUARTERED if name[4:] in ("north", "east", "south", "west") else COARSE
    walls = (*PLAIN, wall(*GRASS))
    bound = surface_bounds(situation(weather, walls, wall(*LOAM), settings))[name]
    assert TOLERANCE < measured(name, weather, walls, wall(*LOAM), settings) <= bound.value


def test_ground_that_nothing_faces_changes_no_surface() -> None:
    up = np.array([[0.0, 0.0, 1.0]])
    flat = surface_bounds(situation(environment(), PLAIN, wall(*LOAM), COARSE, up))["ground_exchange"]
    steep = surface_bounds(situation(environment(), PLAIN, wall(*LOAM), COARSE))["ground_exchange"]
    assert flat.value == 0.0
    assert steep.value > TOLERANCE


def test_free_convection_is_no_effect_of_plants_and_soil() -> None:
    walls, ground = (wall(*GRASS),), wall(*LOAM)
    assert surface_bounds(situation(environment(), walls, ground, COARSE))["free_convection"].value == 0.0
    assert measured("free_convection", environment(), walls, ground, COARSE) == 0.0


def test_room_behind_a_wall_beyond_its_penetration_depth_is_left_out() -> None:
    walls, ground = (thick(wall(*BRICK)),), thick(wall(*ASPHALT))
    bound = surface_bounds(situation(environment(), walls, ground, COARSE))["interior"].value
    assert bound <= TOLERANCE
    assert measured("interior", environment(), walls, ground, COARSE) <= bound + STEPPING


def test_snow_is_called_for_where_it_lies() -> None:
    assert surface_bounds(situation(environment(), PLAIN, wall(*LOAM), COARSE))["snow"].value == 0.0
    assert surface_bounds(situation(snowy(environment()), PLAIN, wall(*LOAM), COARSE))["snow"].value > TOLERANCE


@pytest.mark.parametrize("seed", range(4))
def test_bound_of_each_effect_is_above_what_it_changes_in_random_weather(seed: int) -> None:
    weather = build_environment(
        random_weather(seed), image_day=environment().image_start.date(), lead_in_days=1.0, step=COARSE.step
    )
    settings = replace(COARSE, sky=SKIES[seed % 2])
    walls, ground = (*PLAIN, wall(*GRASS)), wall(*LOAM)
    alone = situation(weather, walls, ground, settings)
    bounds, windy = surface_bounds(alone), surface_bounds(replace(alone, film_kept=True))
    whole = temperatures(weather, walls, ground, settings)
    for name in TERMS:
        changed = temperatures(weather, walls, ground, settings, EVERYTHING.without(name))
        assert np.abs(changed - whole).max() <= windy[name].value * (1.0 + 1e-6) + 1e-6, name
        assert windy[name].value <= bounds[name].value, name


@pytest.mark.parametrize("seed", range(3))
def test_no_surface_leaves_the_limits_of_its_temperature_whatever_is_left_out(seed: int) -> None:
    rng = np.random.default_rng(seed)
    weather = build_environment(
        random_weather(seed), image_day=environment().image_start.date(), lead_in_days=1.0, step=COARSE.step
    )
    walls, ground = (*PLAIN, wall(*GRASS)), wall(*LOAM)
    alone = situation(weather, walls, ground, COARSE)
    for film_kept in (False, False, True, True, True):
        limits = replace(alone, film_kept=film_kept).limits
        left = [name for name in TERMS if not (film_kept and name == "forced_convection")]
        plan = EffectPlan(off=tuple(rng.choice(left, size=5, replace=False).tolist()))
        found = temperatures(weather, walls, ground, COARSE, plan)
        assert limits.coldest - 1e-3 <= found.min()
        assert found.max() <= limits.greatest + 1e-3


def test_wind_that_is_kept_holds_surfaces_and_bounds_closer_to_the_air() -> None:
    """In the windy winter: no surface is warmer than half as far from the air as emission alone would leave it.

    The dew point stays the lower limit.
    """
    alone = situation(environment(), PLAIN, wall(*ASPHALT), COARSE)
    windy = replace(alone, film_kept=True)
    air = environment().air_temperature
    assert windy.limits.greatest - air.max() < 0.5 * (alone.limits.greatest - air.max())
    assert alone.limits.coldest <= windy.limits.coldest < air.min()
    loose, tight = surface_bounds(alone), surface_bounds(windy)
    for name in ("direct_sun", "ground_sun", "thermal_sky", "ground_exchange", "interior"):
        assert tight[name].value < 0.5 * loose[name].value, name
    assert tight["forced_convection"] == loose["forced_convection"]


def test_bounds_that_trust_the_wind_are_bounds_of_all_left_out_together() -> None:
    weather, ground = environment(), wall(*ASPHALT)
    names = ("direct_sun", "sky_dome", "sky_glow", "sky_horizon", "ground_sun", "thermal_sky", "ground_exchange")
    bounds = surface_bounds(replace(situation(weather, PLAIN, ground, COARSE), film_kept=True))
    whole = temperatures(weather, PLAIN, ground, COARSE)
    changed = temperatures(weather, PLAIN, ground, COARSE, EVERYTHING.without(*names))
    assert 5.0 < np.abs(changed - whole).max() <= sum(bounds[name].value for name in names)


def test_several_effects_left_out_together_change_no_more_than_the_sum_of_their_bounds() -> None:
    """In a weak sun: a thousandth of the day's light and a sky all but as warm as the air."""
    day = environment()
    weather = replace(
        day,
        beam_irradiance=day.beam_irradiance * 1e-3,
        diffuse_irradiance=day.diffuse_irradiance * 1e-3,
        sky_temperature=day.air_temperature - 0.01,
    )
    names = ("direct_sun", "sky_dome", "sky_glow", "sky_horizon", "ground_sun", "thermal_sky")
    ground = wall(*ASPHALT)
    bounds = surface_bounds(situation(weather, PLAIN, ground, COARSE))
    whole = temperatures(weather, PLAIN, ground, COARSE)
    changed = temperatures(weather, PLAIN, ground, COARSE, EVERYTHING.without(*names))
    total = sum(bounds[name].value for name in names)
    assert 0.02 < np.abs(changed - whole).max() <= total < 5.0


def test_all_effects_are_todays_tables_bit_for_bit() -> None:
    """A plan that leaves nothing out computes the sums in the order of the plain functions."""
    walls, ground = (*PLAIN, wall(*GRASS)), wall(*LOAM)
    for weather in (environment(), rainy(environment()), snowy(environment())):
        plain = temperatures(weather, walls, ground, COARSE)
        assert np.array_equal(plain, temperatures(weather, walls, ground, COARSE, EffectPlan(off=())))
