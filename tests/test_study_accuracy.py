"""The accuracy study: errors that are known beforehand, the front and the budgets, and what is written."""

import csv
import json
import sys
from dataclasses import replace
from datetime import date
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from small_world import DAY, random_normals, town, town_features, wall_types, write_town

from sensorsim.cli import main
from sensorsim.cli.study_accuracy import KELVIN, SECONDS, read_quantity
from sensorsim.environment import Weather, build_environment, read_weather
from sensorsim.errors import InputError
from sensorsim.materials import load_catalogue
from sensorsim.render import Renderer, station_camera
from sensorsim.sensor import load_sensor
from sensorsim.study.accuracy_images import compare, true_world
from sensorsim.study.accuracy_measure import TIMES, Score, StudyDay, Worst, fitted, score_trial, solve_day, table_bytes
from sensorsim.study.accuracy_scope import scope_of
from sensorsim.study.accuracy_surfaces import Sample, catalogue_sample, facing, scene_sample
from sensorsim.study.accuracy_trials import FACTORS, Trial, plan_trials
from sensorsim.study.pareto import advise, pareto_front
from sensorsim.tables import PRESETS, BakeSettings, bake_tables, orientation_set
from sensorsim.tables.full_solve import SurfaceSet, distinct_surfaces, fine_environment, fine_settings, solve_surfaces
from sensorsim.thermal import Season


@cache
def winter() -> Weather:
    return read_weather("winter")


def trial(settings: BakeSettings, name: str = "made") -> Trial:
    return Trial(group="preset", factor="", name=name, settings=settings, truth=fine_settings(settings))


def surfaces(normal: np.ndarray, reflectance: np.ndarray, rows: int = 2) -> SurfaceSet:
    """The first of the small world's wall types in turn."""
    return SurfaceSet(
        wall_types=wall_types()[:rows],
        wall_type=np.arange(normal.shape[0]) % rows,
        normal=normal,
        reflectance=reflectance,
    )


def day_of(chosen: SurfaceSet) -> StudyDay:
    count = chosen.reflectance.size
    sample = Sample(surfaces=chosen, whole=count, row_of=np.arange(count))
    return StudyDay(day=DAY, weather=winter(), ground=wall_types()[3], sample=sample, world=None)


def at_slices(chosen: SurfaceSet, settings: BakeSettings) -> tuple[np.ndarray, np.ndarray]:
    """The fit, and the full solve from the very same environment, at those of TIMES that are slices."""
    environment = build_environment(winter(), image_day=DAY, lead_in_days=settings.lead_in_days, step=settings.step)
    tables = bake_tables(environment, chosen.wall_types, ground=wall_types()[3], settings=settings)
    common = np.isin(TIMES, tables.time_of_day)
    record = environment.image_window.start + np.round(TIMES[common] / settings.step).astype(int)
    ground = wall_types()[3]
    return fitted(tables, chosen)[common], solve_surfaces(
        environment, chosen, ground=ground, record=record, settings=settings
    )


COARSE = BakeSettings(
    orientations="report10",
    interpolation="barycentric",
    lobes=0.0,
    reflectances=(0.1, 0.5, 0.9),
    degree=2,
    step=900.0,
    slice_interval=900.0,
    lead_in_days=1.0,
)


@pytest.mark.parametrize("lobes", [0.0, 3600.0])
def test_no_error_at_the_orientations_and_reflectances_that_were_solved(lobes: float) -> None:
    """Expected: none but single precision of 300 K, at every slice; the polynomial goes through its reflectances."""
    normal = np.repeat(orientation_set("report10").normal, 3, axis=0)
    chosen = surfaces(normal, np.tile([0.1, 0.5, 0.9], 10), rows=1)
    shade, truth = at_slices(chosen, replace(COARSE, lobes=lobes, step=300.0))
    assert shade.shape == (25, 30)
    np.testing.assert_allclose(shade, truth, rtol=0.0, atol=1e-4)


def test_coarser_sets_of_orientations_and_no_lobes_are_worse() -> None:
    chosen, errors = surfaces(random_normals(60), np.full(60, 0.3)), []
    for name in ("icosphere162", "icosphere42", "report10"):
        shade, truth = at_slices(chosen, replace(COARSE, orientations=name))
        errors.append(np.sqrt(np.mean((shade - truth) ** 2)))
    assert errors[0] < errors[1] < errors[2]
    shade, truth = at_slices(chosen, replace(COARSE, lobes=3600.0, step=300.0))
    assert np.sqrt(np.mean((shade - truth) ** 2)) < errors[2]


def test_score_is_that_of_the_errors_and_names_the_worst_place() -> None:
    chosen = surfaces(random_normals(20), np.full(20, 0.3))
    day = day_of(chosen)
    truth = solve_day(day, chosen, COARSE)
    score, tables = score_trial(trial(COARSE), [day], {DAY: truth})
    error = np.abs(fitted(tables[DAY], chosen) - truth)
    at, row = np.unravel_index(error.argmax(), error.shape)
    assert score.max == error.max()
    assert score.rms == pytest.approx(np.sqrt(np.mean(error**2)))
    assert score.p99 == pytest.approx(np.percentile(error, 99.0))
    assert score.rms < score.p99 < score.max
    assert score.worst.hour == TIMES[at] / 3600.0
    assert score.worst.orientation == facing(chosen.normal[row])
    assert score.worst.wall is wall_types()[row % 2]
    assert f"{wall_types()[row % 2].name} ({wall_types()[row % 2].interior}), " in str(score.worst)
    assert score.count.sum() == error.size
    assert score.table == table_bytes(tables[DAY]) / 2**20
    assert score.table * 2**20 >= tables[DAY].coefficients.nbytes
    assert score.bake > 0.0


def test_full_solve_of_the_fine_grid_starts_as_early_as_the_weather_allows() -> None:
    environment = fine_environment(winter(), DAY)
    assert environment.step == 60.0
    assert (environment.image_start - environment.start).days == 5


def test_distinct_surfaces_stand_for_all_of_the_scene() -> None:
    world = town()
    normal, made = world.scene.surfaces.normal, world.assignment
    distinct = distinct_surfaces(normal, made)
    chosen, row_of = distinct.surfaces, distinct.row_of
    np.testing.assert_allclose(chosen.normal[row_of], normal, atol=1e-6)
    np.testing.assert_array_equal(chosen.wall_type[row_of], made.wall_type)
    np.testing.assert_allclose(chosen.reflectance[row_of], made.reflectance, atol=1e-6)
    twice = replace(
        made,
        wall_type=np.tile(made.wall_type, 2),
        reflectance=np.tile(made.reflectance, 2),
    )
    again = distinct_surfaces(np.vstack([normal, normal]), twice)
    np.testing.assert_array_equal(again.surfaces.normal, chosen.normal)
    np.testing.assert_array_equal(again.row_of, np.tile(row_of, 2))
    few = scene_sample(normal, made, 5)
    assert few.surfaces.reflectance.size == 5
    assert few.whole == chosen.reflectance.size
    assert set(few.row_of.tolist()) == {-1, 0, 1, 2, 3, 4}
    kept = few.row_of >= 0
    np.testing.assert_allclose(few.surfaces.normal[few.row_of[kept]], normal[kept], atol=1e-6)


def test_catalogue_sample_holds_every_material_and_is_the_same_each_time() -> None:
    catalogue, season = load_catalogue(), Season(leafless=False, snow=False)
    one, two = catalogue_sample(catalogue, season), catalogue_sample(catalogue, season)
    np.testing.assert_array_equal(one.surfaces.normal, two.surfaces.normal)
    assert {wall.code for wall in one.surfaces.wall_types} == set(catalogue.materials)
    assert set(one.surfaces.wall_type.tolist()) == set(range(len(one.surfaces.wall_types)))
    np.testing.assert_allclose(np.linalg.norm(one.surfaces.normal, axis=1), 1.0)
    assert one.surfaces.reflectance.min() >= 0.0
    assert one.surfaces.reflectance.max() <= 1.0


@pytest.mark.parametrize(
    ("normal", "words"),
    [
        ((0.0, 0.0, 1.0), "level, facing up"),
        ((0.0, 0.0, -1.0), "level, facing down"),
        ((0.0, 1.0, 0.0), "wall facing N"),
        ((np.sin(np.radians(157.5)), np.cos(np.radians(157.5)), 0.0), "wall facing SSE"),
        ((-1.0, 0.0, 0.0), "wall facing W"),
        ((-0.01, 0.99995, 0.0), "wall facing N"),
        ((0.0, -np.sqrt(0.5), np.sqrt(0.5)), "slope facing S"),
        ((np.sqrt(0.5), 0.0, -np.sqrt(0.5)), "overhang facing E"),
    ],
)
def test_orientations_are_told_in_words(normal: tuple[float, float, float], words: str) -> None:
    assert facing(np.array(normal)) == words


def score(name: str, error: float, bake: float) -> Score:
    worst = Worst(wall=wall_types()[0], orientation="wall facing N", reflectance=0.5, hour=9.75, day=DAY)
    return Score(
        trial=trial(COARSE, name), rms=0.1 * error, p99=0.5 * error, max=error, worst=worst, bake=bake,
        bake_processor=bake, table=1.0, scope="", count=np.zeros(50, dtype=np.int64),
    )  # fmt: skip


SCORES = (score("cheap", 2.0, 0.1), score("middle", 0.5, 1.0), score("waste", 0.6, 3.0), score("dear", 0.05, 20.0))


def test_advice_keeps_the_budget_and_takes_no_more_than_it_needs() -> None:
    assert advise(SCORES, max_error=1.0).score.trial.name == "middle"
    assert advise(SCORES, max_error=0.5).score.trial.name == "middle"
    assert advise(SCORES, max_error=0.2).score.trial.name == "dear"
    assert advise(SCORES, max_bake=5.0).score.trial.name == "middle"
    assert advise(SCORES, max_bake=0.1).score.trial.name == "cheap"
    assert advise(SCORES, max_error=0.6, max_bake=4.0).score.trial.name == "middle"
    assert all(advise(SCORES, max_error=budget).meets for budget in (0.05, 0.5, 9.0))


def test_advice_says_when_nothing_keeps_the_budget_and_what_is_nearest() -> None:
    for budget, nearest in (
        ({"max_error": 0.01}, "dear"), ({"max_bake": 0.01}, "cheap"), ({"max_error": 0.1, "max_bake": 2.0}, "middle")
    ):  # fmt: skip
        told = advise(SCORES, **budget)
        assert not told.meets
        assert told.score.trial.name == nearest
        assert "none of 4 settings" in told.text
        assert nearest in told.text


@pytest.mark.parametrize("budget", [0.0, -1.0, float("nan"), float("inf")])
def test_budget_that_is_none_is_refused(budget: float) -> None:
    with pytest.raises(InputError, match=r"max error = .*not a number above zero"):
        advise(SCORES, max_error=budget)
    with pytest.raises(InputError, match=r"max bake = .*not a number above zero"):
        advise(SCORES, max_bake=budget)


def test_advice_without_a_budget_or_settings_is_refused() -> None:
    with pytest.raises(InputError, match="neither max error nor max bake"):
        advise(SCORES)
    with pytest.raises(InputError, match="none were measured"):
        advise((), max_error=1.0)


def test_nothing_on_the_front_is_beaten_and_all_else_is() -> None:
    cost, error = np.random.default_rng(3).uniform(size=(2, 60))
    front = set(pareto_front(cost, error).tolist())
    for row in range(60):
        beaten = np.any((cost <= cost[row]) & (error <= error[row]) & ((cost < cost[row]) | (error < error[row])))
        assert beaten == (row not in front)
    np.testing.assert_array_equal(pareto_front(np.array([1.0, 1.0, 2.0]), np.array([3.0, 2.0, 2.0])), [1])


@pytest.mark.parametrize(
    ("text", "units", "value"),
    [
        ("0.2K", KELVIN, 0.2), ("0.2 K", KELVIN, 0.2), ("200mK", KELVIN, 0.2), ("2e-1K", KELVIN, 0.2),
        (".5K", KELVIN, 0.5), ("5s", SECONDS, 5.0), ("500ms", SECONDS, 0.5), ("1.5min", SECONDS, 90.0),
    ],
)  # fmt: skip
def test_budgets_are_read_with_their_units(text: str, units: dict[str, float], value: float) -> None:
    assert read_quantity(text, "--budget", units) == pytest.approx(value, rel=1e-12)


@pytest.mark.parametrize(
    "text", ["0.2", "K", "", "0.2C", "0.2s", "-1K", "0K", "nanK", "infK", "1e999K", "one K", "1,5K"]
)
def test_budgets_that_say_nothing_are_refused_by_name(text: str) -> None:
    with pytest.raises(InputError, match=r"command line: --max-error = .*K"):
        read_quantity(text, "--max-error", KELVIN)


def test_plan_measures_every_preset_and_turns_every_knob_from_the_default() -> None:
    trials = plan_trials()
    assert len({each.name for each in trials}) == len(trials)
    assert [each.name for each in trials if each.group == "preset"] == list(PRESETS)
    for factor in FACTORS:
        turned = [each.settings for each in trials if each.factor == factor]
        assert len(turned) >= 2
        assert len(set(turned)) == len(turned)
        assert PRESETS["standard"] in turned or factor == "degree"
    assert any(each.group == "combination" for each in trials)
    assert [each.name for each in plan_trials(["report"], [])] == ["report"]


def test_unknown_presets_and_factors_are_refused_by_name() -> None:
    with pytest.raises(InputError, match="preset = 'best': unknown preset; use one of"):
        plan_trials(["best"])
    with pytest.raises(InputError, match="factor = 'luck': unknown factor; use orientations"):
        plan_trials([], ["luck"])


def test_settings_that_cannot_be_are_refused_by_name() -> None:
    with pytest.raises(InputError, match=r"degree = 3: cannot be used; .*number of reflectances less one"):
        replace(COARSE, degree=3)
    with pytest.raises(InputError, match=r"slice_interval = 0\.0: cannot be used"):
        replace(COARSE, slice_interval=0.0)


def test_frames_of_the_full_solve_have_its_temperatures_and_miss_themselves_by_nothing() -> None:
    world = town()
    sample = scene_sample(world.scene.surfaces.normal, world.assignment, 100)
    day = StudyDay(day=DAY, weather=winter(), ground=wall_types()[3], sample=sample, world=world)
    truth = 270.0 + 20.0 * np.random.default_rng(2).uniform(size=(TIMES.size, sample.whole))
    camera, at = station_camera(world.scene, "overhead"), 36000.0
    with Renderer(true_world(world, day, truth), load_sensor("flir"), size=(160, 120)) as renderer:
        picture = renderer.render(camera, at)
    surface = picture.planes["surface_id"]
    seen = surface >= 0
    expected = truth[np.searchsorted(TIMES, at), sample.row_of[surface[seen]]]
    np.testing.assert_allclose(picture.planes["surface_temperature"][seen], expected, rtol=0.0, atol=1e-3)
    pictures = dict.fromkeys((7.0, 10.0, 13.0, 17.0), picture)
    for told in compare("itself", day, pictures, pictures):
        assert (told.rms, told.max, told.spearman, told.kendall) == (0.0, 0.0, 1.0, 1.0)
        assert told.surfaces > 3


def test_dear_settings_are_measured_on_fewer_walls_and_one_knobs_turns_on_one_day() -> None:
    world = town()
    sample = scene_sample(world.scene.surfaces.normal, world.assignment, 100)
    one = StudyDay(day=DAY, weather=winter(), ground=wall_types()[3], sample=sample, world=world)
    days, truth = (one, replace(one, day=date(1976, 2, 6))), np.arange(sample.whole)[None, :] + np.zeros((3, 1))
    cheap = trial(COARSE)
    all_of_it = scope_of(cheap, days, {DAY: truth})
    assert (len(all_of_it.days), all_of_it.share) == (2, 1.0)
    assert len(scope_of(replace(cheap, group="factor"), days, {DAY: truth}).days) == 1
    dear = trial(replace(COARSE, orientations="icosphere2562", step=60.0))
    part = scope_of(dear, days, {DAY: truth})
    (left,), total = part.days, len(sample.surfaces.wall_types)
    few = left.sample.surfaces
    assert part.share == len(few.wall_types) / total < 1.0
    assert f"{len(few.wall_types)} of {total} wall types" in part.words
    rows = part.truth[DAY][0].astype(int)
    np.testing.assert_array_equal(sample.surfaces.normal[rows], few.normal)
    for row, old in enumerate(rows):
        assert few.wall_types[few.wall_type[row]] is sample.surfaces.wall_types[sample.surfaces.wall_type[old]]
    for surface, row in enumerate(left.sample.row_of):
        assert row == -1 or rows[row] == sample.row_of[surface]


@pytest.fixture(scope="module")
def measured(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, object], str]:
    """The command on the town, one day, one preset and one knob: its folder and what it printed."""
    folder = tmp_path_factory.mktemp("accuracy")
    place = write_town(folder, town_features())
    words = [
        "study", "accuracy", str(place), "--out", str(folder / "made"), "--days", DAY.isoformat(), "--presets",
        "report", "--factors", "", "--max-error", "100K", "--json",
    ]  # fmt: skip
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(sys, "argv", ["sensorsim", *words])
        told: list[str] = []
        patch.setattr("builtins.print", lambda text: told.append(text))
        with pytest.raises(SystemExit) as left:
            main()
    assert left.value.code in (0, None)
    return folder / "made", json.loads(told[0]), told[0]


def test_json_has_the_presets_figures(measured: tuple[Path, dict[str, object], str]) -> None:
    told = measured[1]
    assert list(told["presets"]) == ["report"]
    figures = told["presets"]["report"]
    assert list(figures) == ["rms", "p99", "max", "bake_s", "table_mib", "frame_ms"]
    assert all(isinstance(value, float) and value > 0.0 for value in figures.values())
    assert figures["rms"] < figures["p99"] < figures["max"] < 20.0
    assert told["recommended"] == {"setting": "report", "meets": True}


def test_page_and_tables_are_written_whole(measured: tuple[Path, dict[str, object], str]) -> None:
    folder = measured[0]
    assert sorted(path.name for path in folder.iterdir()) == ["accuracy.csv", "accuracy.html", "accuracy_images.csv"]
    page = (folder / "accuracy.html").read_text(encoding="utf-8")
    for heading in ("Presets", "Recommendations", "Where the fit is worst", "One knob at a time", "Pictures"):
        assert f"<h2>{heading}</h2>" in page
    assert page.endswith("</body></html>\n")
    assert page.count("data:image/png;base64,") == 3
    with (folder / "accuracy.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["setting"] for row in rows] == ["report"]
    assert float(rows[0]["max [K]"]) == measured[1]["presets"]["report"]["max"]
    with (folder / "accuracy_images.csv").open(encoding="utf-8") as file:
        images = list(csv.DictReader(file))
    assert [float(row["hour"]) for row in images] == [7.0, 10.0, 13.0, 17.0]
    for row in images:
        assert 0.0 < float(row["RMS [K]"]) <= float(row["max [K]"])
        assert -1.0 <= float(row["Kendall"]) <= float(row["Spearman"]) <= 1.0
