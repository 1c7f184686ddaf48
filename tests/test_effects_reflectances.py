"""Wall types that show few reflectances are solved at those alone, by polynomials of a lower degree."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from effect_cases import BRICK, COARSE, DAYS, GRASS, LOAM, METAL, environment, random_weather, situation, wall
from small_world import town_features, write_town

from sensorsim.effects import read_choice, reflectance_bound
from sensorsim.environment import build_environment, read_weather
from sensorsim.render import Survey, survey_scene
from sensorsim.scene import load_scene
from sensorsim.sensor import load_sensor
from sensorsim.tables import BakeSettings, ShadeTables, bake_tables, surface_temperature
from sensorsim.tables.scope import polynomial_miss, shown_reflectances

FIVE = replace(COARSE, reflectances=(0.1, 0.3, 0.5, 0.7, 0.9), degree=4)
LOBED = BakeSettings(orientations="icosphere42", step=1200.0, slice_interval=3600.0, lead_in_days=1.0)


def surveyed(folder: Path, choice: str, settings: BakeSettings = FIVE) -> Survey:
    return survey_scene(
        load_scene(write_town(folder, town_features())), read_weather("winter"), image_day=DAYS["winter"],
        settings=settings, choice=read_choice(choice), sensor=load_sensor("flir"),
    )  # fmt: skip


def baked(survey: Survey) -> ShadeTables:
    return bake_tables(
        survey.environment, survey.assignment.wall_types, ground=survey.ground, settings=survey.settings,
        plan=survey.ledger.plan, scope=survey.scope,
    )  # fmt: skip


def shown(survey: Survey, tables: ShadeTables) -> np.ndarray:
    """Temperatures [K] of all surfaces of the scene over the day."""
    normal, own = survey.scene.surfaces.normal, survey.assignment
    return np.array([
        surface_temperature(tables, normal, own.wall_type, own.reflectance, 3600.0 * hour) for hour in range(0, 24, 3)
    ])  # fmt: skip


def test_few_reflectances_are_solved_themselves_and_pass_through_the_solve(tmp_path: Path) -> None:
    """Expected: what tables of one reflectance alone have there, to single precision."""
    survey = surveyed(tmp_path, "all,-spare_reflectances")
    lean, own = shown(survey, baked(survey)), survey.assignment
    assert set(survey.scope.reflectances) != {FIVE.reflectances}
    for row, held in enumerate(survey.scope.reflectances):
        surface = np.flatnonzero(own.wall_type == row)
        if held == FIVE.reflectances:
            continue
        for value in held:
            alone = replace(survey, settings=replace(FIVE, reflectances=(value,), degree=0))
            single = replace(alone, assignment=replace(own, reflectance=np.full_like(own.reflectance, value)))
            found = shown(single, baked(single))[:, surface][:, own.reflectance[surface] == value]
            assert np.abs(found - lean[:, surface][:, own.reflectance[surface] == value]).max() < 2e-4


def test_fewer_histories_are_solved_and_fewer_powers_kept(tmp_path: Path) -> None:
    whole, lean = (surveyed(tmp_path, text) for text in ("all", "all,-spare_reflectances"))
    assert lean.scope.columns < 0.5 * whole.scope.columns
    assert lean.ledger.row("spare_reflectances").saves > 0.0
    degree = lean.scope.most - 1
    assert baked(lean).coefficients.shape[-1] == degree + 1 < baked(whole).coefficients.shape[-1]


@pytest.mark.parametrize(("settings", "allowed"), [(FIVE, 0.1), (LOBED, 0.3)])
def test_surfaces_of_a_lean_bake_are_as_warm_as_of_a_whole_one(
    settings: BakeSettings, allowed: float, tmp_path: Path
) -> None:
    """To what a fit may miss nearly everywhere; with lobes, which are fitted to fewer, to what it may at most."""
    found = [
        shown(one, baked(one)) for one in (surveyed(tmp_path, c, settings) for c in ("all", "all,-spare_reflectances"))
    ]
    assert 0.0 < np.abs(found[0] - found[1]).max() < allowed


def test_auto_keeps_them_in_the_sun_and_the_user_decides(tmp_path: Path) -> None:
    ledger = surveyed(tmp_path, "auto").ledger
    assert ledger.row("spare_reflectances").on
    assert ledger.row("spare_reflectances").bound > ledger.row("spare_reflectances").tolerance
    assert "wall types have fewer" in ledger.row("spare_reflectances").reason
    assert surveyed(tmp_path, "all,-spare_reflectances").scope.lit


@pytest.mark.parametrize("settings", [FIVE, LOBED])
def test_polar_night_calls_for_no_light_no_lobe_and_a_polynomial_of_degree_zero(
    settings: BakeSettings, tmp_path: Path
) -> None:
    """And is as warm as with all that, to single precision; in the sun of the same winter none of it is left out."""
    weather = read_weather("winter")
    night = replace(weather, site=replace(weather.site, latitude=84.0))
    scene = load_scene(write_town(tmp_path, town_features()))
    found = {
        (place.site.latitude, text): survey_scene(
            scene, place, image_day=DAYS["winter"], settings=settings, choice=read_choice(text),
            sensor=load_sensor("flir"),
        )
        for place in (weather, night) for text in ("all", "auto")
    }  # fmt: skip
    lean, whole = (found[84.0, text] for text in ("auto", "all"))
    off = {row.effect for row in lean.ledger.rows if not row.on}
    assert off >= {"direct_sun", "sky_dome", "sky_glow", "sky_horizon", "ground_sun", "spare_reflectances"}
    sunny = {row.effect for row in found[weather.site.latitude, "auto"].ledger.rows if not row.on}
    assert not sunny & {"direct_sun", "sky_dome", "ground_sun", "spare_reflectances"}
    assert lean.scope.columns * len(settings.reflectances) <= whole.scope.columns
    tables = baked(lean)
    assert tables.coefficients.shape[-1] == 1
    assert tables.lobes is None
    assert np.abs(shown(lean, tables) - shown(whole, baked(whole))).max() < 1e-3


def test_parts_of_mixtures_and_wall_types_with_many_reflectances_keep_all(tmp_path: Path) -> None:
    survey = surveyed(tmp_path, "all")
    own, count = survey.assignment, survey.assignment.reflectance.size
    many = replace(own, reflectance=np.linspace(0.1, 0.9, count))
    few = replace(own, reflectance=np.full(count, 0.4))
    rows = [row for row in range(len(own.wall_types)) if np.sum(own.wall_type == row) >= 5]
    plain = [row for row, one in enumerate(own.wall_types) if not one.parts]
    assert rows
    assert all(shown_reflectances(many, FIVE)[row] == FIVE.reflectances for row in rows)
    assert all(shown_reflectances(few, FIVE)[row] == (0.4,) for row in plain)
    mixed = replace(few, wall_types=(wall(30, "none"), *own.wall_types[1:]))
    assert mixed.wall_types[0].parts
    assert shown_reflectances(mixed, FIVE)[0] == FIVE.reflectances


@pytest.mark.parametrize("seed", range(3))
def test_polynomial_is_within_its_bound_of_a_solve_at_the_very_reflectance(seed: int) -> None:
    weather = build_environment(
        random_weather(seed), image_day=environment().image_start.date(), lead_in_days=1.0, step=COARSE.step
    )
    walls, own = (wall(*BRICK), wall(*METAL), wall(*GRASS)), 0.45
    line = bake_tables(weather, walls, ground=wall(*LOAM), settings=COARSE)
    through = replace(COARSE, reflectances=(own,), degree=0)
    exact = bake_tables(weather, walls, ground=wall(*LOAM), settings=through)
    normal = np.tile(line.orientations.normal, (3, 1))
    row = np.repeat(np.arange(3), line.orientations.normal.shape[0])
    apart = []
    for hour in range(24):
        found = [surface_temperature(t, normal, row, np.full(row.size, own), 3600.0 * hour) for t in (line, exact)]
        apart.append(np.abs(found[0] - found[1]).max())
    bound = reflectance_bound(situation(weather, walls, wall(*LOAM), COARSE), [polynomial_miss((own,), COARSE)] * 3)
    assert 0.0 < max(apart) <= bound


def test_reflectances_that_are_solved_anyway_miss_nothing() -> None:
    assert polynomial_miss((0.1, 0.7), FIVE) == pytest.approx(0.0, abs=1e-12)
    assert polynomial_miss((0.2,), FIVE) > 0.1
