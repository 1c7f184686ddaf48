"""What an input is worth, on a tiny set, against derivatives that are known otherwise."""

import json
from dataclasses import replace
from datetime import date
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from sensorsim.cli import study_sensitivity as command
from sensorsim.cli.app import app
from sensorsim.materials import load_catalogue
from sensorsim.study.sensitivity import SPECIMENS, Sensitivity, setup_of, study_sensitivity
from sensorsim.study.sensitivity_inputs import AIR, INPUTS
from sensorsim.study.sensitivity_model import Effect, Setup, at_hours, change_of, surface_history
from sensorsim.study.sensitivity_page import sentence, together, write_sensitivity_page
from sensorsim.tables import BakeSettings

WINTER = date(1976, 2, 7)
HOURS = np.array([7.0, 13.0])
CHANGES = {each.name: each for each in INPUTS}
COARSE = BakeSettings(orientations="report10", reflectances=(0.2, 0.5, 0.8), degree=2)


@pytest.fixture(scope="module")
def roof() -> Setup:
    return setup_of(SPECIMENS[3], WINTER, load_catalogue(), step=600.0)


@pytest.fixture(scope="module")
def wall() -> Setup:
    return setup_of(SPECIMENS[1], WINTER, load_catalogue(), step=600.0)


@pytest.fixture(scope="module")
def study() -> tuple[Sensitivity, ...]:
    chosen = [CHANGES[name] for name in ("solar absorptance", "air temperature", "evaporation", "orientation")]
    return study_sensitivity(SPECIMENS[1:2], inputs=chosen, days=(WINTER,), hours=HOURS, settings=COARSE)


def _worth(setup: Setup, name: str) -> np.ndarray:
    plain = at_hours(setup, surface_history(setup), HOURS)
    return change_of(setup, CHANGES[name].change, HOURS, plain)


def test_sun_inputs_are_worth_nothing_before_sunrise_and_kelvins_at_noon(roof: Setup) -> None:
    for name in ("solar absorptance", "beam", "diffuse light"):
        night, noon = _worth(roof, name)
        assert noon > 0.2, name
        assert night < 0.3 * noon, name
    assert 2.0 < _worth(roof, "solar absorptance")[1] < 8.0  # spread within a class in full sun


def test_air_moves_a_surface_by_less_than_itself(wall: Setup, roof: Setup) -> None:
    """Rationale: a film shares the balance with radiation and conduction. Expected: 0.3 to 1.2 K per kelvin."""
    for setup in (wall, roof):
        worth = _worth(setup, "air temperature")
        assert np.all((worth > 0.3 * AIR) & (worth < 1.2 * AIR))


def test_sky_is_worth_its_flux_over_the_films_on_an_insulated_roof_by_night(roof: Setup) -> None:
    """Rationale: dT = eps dL / (h + 4 eps sigma T^3), h from the exchange of a night in light wind, 5 to 25."""
    night = _worth(roof, "sky radiation")[0]
    assert 0.93 * 20.0 / (25.0 + 5.0) < night < 0.93 * 20.0 / (3.0 + 4.0)


def test_doubling_a_change_about_doubles_its_worth(wall: Setup) -> None:
    plain = at_hours(wall, surface_history(wall), HOURS)
    once = change_of(wall, lambda setup, sign: replace(setup, room=1.0 * sign), HOURS, plain)
    twice = change_of(wall, lambda setup, sign: replace(setup, room=2.0 * sign), HOURS, plain)
    np.testing.assert_allclose(twice, 2.0 * once, rtol=0.05)
    assert np.all(once > 0.1)


def test_change_that_cannot_be_counts_on_one_side_or_not_at_all(wall: Setup) -> None:
    black = replace(wall, reflectance=0.05)
    assert CHANGES["solar absorptance"].change(black, 1.0) is None
    assert CHANGES["solar absorptance"].change(black, -1.0) is not None
    assert np.all(_worth(wall, "evaporation") == 0.0)
    clear = replace(wall, weather=replace(wall.weather, cloud_cover=np.zeros_like(wall.weather.cloud_cover)))
    assert CHANGES["cloud cover"].change(clear, -1.0) is None


def test_larger_of_both_signs_counts(wall: Setup) -> None:
    plain = at_hours(wall, surface_history(wall), HOURS)
    lopsided = change_of(wall, lambda setup, sign: replace(setup, room=3.0 if sign > 0 else -1.0), HOURS, plain)
    one = change_of(wall, lambda setup, sign: replace(setup, room=3.0) if sign > 0 else None, HOURS, plain)
    np.testing.assert_array_equal(lopsided, one)


def test_inputs_come_ranked_beside_solver_and_fit(study: tuple[Sensitivity, ...]) -> None:
    (found,) = study
    worth = [effect.rms for effect in found.effects]
    assert worth == sorted(worth, reverse=True)
    assert found.effects[-1].input.name == "evaporation"
    assert 0.0 < found.solver.max < 0.05
    assert 0.0 < found.fit.max < 3.0  # ten orientations and three reflectances on sheet metal
    assert together(found) == pytest.approx(np.sqrt(np.sum(np.square(worth))))
    assert found.temperature.shape == (1, 2)


def test_error_of_the_fit_has_no_start_in_it_even_over_soil() -> None:
    """Rationale: soil remembers weeks; what it began with is no matter of orientations or reflectances.

    Expected: under the goal of tables, 0.1 K, where a start that is not the bake's costs a kelvin on asphalt.
    """
    (found,) = study_sensitivity(SPECIMENS[4:5], inputs=(), days=(WINTER,), hours=HOURS)
    assert found.fit.max < 0.1


def test_effect_is_summed_up_by_rms_and_largest() -> None:
    effect = Effect(input=INPUTS[0], kelvin=np.array([[3.0, 4.0], [0.0, 0.0]]))
    assert effect.rms == pytest.approx(2.5)
    assert effect.max == 4.0


def test_every_input_names_the_source_of_its_amount() -> None:
    assert len({each.name for each in INPUTS}) == len(INPUTS)
    for each in INPUTS:
        assert each.amount
        assert each.source.startswith("estimate") or "[" in each.source, each.name


def test_page_and_command_tell_the_same(
    study: tuple[Sensitivity, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "page.html"
    write_sensitivity_page(path, study)
    text = path.read_text(encoding="utf-8")
    assert "costs 2 to 8 K in full sun" in text
    assert text.count("<img") == 1
    assert sentence(study[0]) in text
    monkeypatch.setattr(command, "study_sensitivity", lambda **_: study)
    result = CliRunner().invoke(app, ["study", "sensitivity", "--out", str(path), "--json"])
    assert result.exit_code == 0
    told = json.loads(result.stdout)["surfaces"][0]
    assert told["inputs"][0]["rms_K"] == study[0].effects[0].rms
    shown = CliRunner().invoke(app, ["study", "sensitivity", "--out", str(path)])
    assert "orientation" in shown.stdout
