"""What users ask for of the effects, how the tolerance is shared, and what the commands say."""

import json
import sys
from pathlib import Path
from typing import Any

import pytest
from small_world import town_features, write_town

from sensorsim.cli import main
from sensorsim.effects import (
    EFFECTS,
    NOT_MODELLED,
    SURFACE,
    Bound,
    Effect,
    EffectChoice,
    EffectPlan,
    Ledger,
    decide,
    read_choice,
)
from sensorsim.effects.costs import OF_WALLS, PER_PIXEL
from sensorsim.errors import InputError

AT = "1976-02-07T10:00"
PAIR = tuple(effect for effect in EFFECTS if effect.name in ("rain", "snow", "interior"))


def decided(bounds: dict[str, float], choice: str = "auto", tolerance: float = 0.025, spent: float = 0.0) -> Ledger:
    effects: tuple[Effect, ...] = tuple(effect for effect in PAIR if effect.name in bounds)
    known = {name: Bound(value=value, reason="") for name, value in bounds.items()}
    return Ledger(rows=decide(effects, known, read_choice(choice), tolerance=tolerance, unit="K", spent=spent))


@pytest.mark.parametrize(
    ("text", "wanted", "refused"),
    [
        ("auto", set(), set()),
        ("all,-rain", set(), {"rain"}),
        ("none,+rain,+snow", {"rain", "snow"}, set()),
        ("+rain, -snow", {"rain"}, {"snow"}),
    ],
)
def test_choice_is_read_and_written(text: str, wanted: set[str], refused: set[str]) -> None:
    choice = read_choice(text)
    assert (choice.wanted, choice.refused) == (wanted, refused)
    assert read_choice(choice.text) == choice


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("some", "begin with one of auto, all, none"),
        ("", "begin with one of"),
        ("auto,rain", "has no sign"),
        ("rain", r"write \+rain or -rain"),
        ("auto,nanK", "not a number from 0 on"),
        ("auto,-0.1K", "not a number from 0 on"),
        ("auto,infK", "not a number from 0 on"),
        ("auto,muchK", "not one number in kelvin"),
        ("0.1K,0.2K", "not one number in kelvin"),
        ("+shadows", "use one of .*direct_sun"),
        ("-glint", "unknown or not modelled"),
        ("+rain,-rain", "on and off at once"),
    ],
)
def test_choice_that_cannot_be_honoured_is_refused(text: str, problem: str) -> None:
    with pytest.raises(InputError, match=problem):
        read_choice(text)


@pytest.mark.parametrize(
    ("text", "sky", "mode", "missing"),
    [
        ("+sky_north", "perez", "emissive", "needs the sky 'quadrants'"),
        ("+sky_glow", "quadrants", "emissive", "needs the sky 'perez'"),
        ("+reflected_sun", "perez", "emissive", "needs a sensor in a reflective band|reflective"),
        ("+reflected_sky", "perez", "reflective", "needs a sensor in an emissive band"),
        ("-temperature", "perez", "emissive", "an emissive sensor sees nothing else"),
    ],
)
def test_effect_whose_inputs_are_missing_is_refused_by_their_name(text: str, sky: str, mode: str, missing: str) -> None:
    with pytest.raises(InputError, match=missing):
        read_choice(text).require_inputs(sky=sky, mode=mode)


@pytest.mark.parametrize("text", ["auto,0.1K", "0.1K", "0.1K,-rain", "all,+snow,-rain,0.1K"])
def test_tolerance_is_read_written_and_kept(text: str) -> None:
    choice = read_choice(text)
    assert choice.tolerance == 0.1
    assert read_choice(choice.text) == choice
    assert choice.with_refused("interior").with_wanted("rain" if "rain" not in text else "snow").tolerance == 0.1


def test_tolerance_in_kelvin_needs_a_band_that_shows_them() -> None:
    read_choice("auto,0.1K").require_inputs(sky="perez", mode="emissive")
    with pytest.raises(InputError, match="kelvin need a sensor in an emissive band"):
        read_choice("auto,0.1K").require_inputs(sky="perez", mode="reflective")


def test_smallest_bounds_go_first_until_the_tolerance_is_used_up() -> None:
    ledger = decided({"rain": 0.02, "snow": 0.004, "interior": 0.01})
    assert ledger.plan.off == EffectPlan(off=("snow", "interior")).off
    assert ledger.spent == pytest.approx(0.014)
    assert ledger.spent <= 0.025


def test_what_was_spent_before_is_not_spent_again() -> None:
    assert decided({"rain": 0.02}).plan.off == ("rain",)
    assert decided({"rain": 0.02}, spent=0.01).plan.off == ()


def test_bound_of_nothing_goes_even_without_tolerance() -> None:
    assert decided({"rain": 0.0, "snow": 1e-9}, tolerance=0.0).plan.off == ("rain",)


def test_request_decides_whatever_the_bound_and_uses_no_tolerance() -> None:
    ledger = decided({"rain": 5.0, "snow": 0.02, "interior": 0.0}, "auto,-rain,+interior")
    assert set(ledger.plan.off) == {"rain", "snow"}
    assert ledger.row("interior").on
    assert ledger.spent == pytest.approx(0.02)
    assert "on request" in ledger.row("rain").reason


def test_all_and_none_are_all_and_none() -> None:
    bounds = {"rain": 0.0, "snow": 9.0, "interior": 1.0}
    assert decided(bounds, "all").plan == EffectPlan()
    assert set(decided(bounds, "none").plan.off) == set(bounds)


def test_plans_are_equal_whatever_the_order_and_refuse_unknown_names() -> None:
    assert EffectPlan(off=("snow", "rain")) == EffectPlan(off=("rain", "snow", "rain"))
    with pytest.raises(InputError, match="unknown or not modelled"):
        EffectPlan().has("shadows")


def test_choice_of_a_base_that_is_none_is_refused() -> None:
    with pytest.raises(InputError, match="begin with one of"):
        EffectChoice(base="some")


def run(monkeypatch: pytest.MonkeyPatch, *words: object) -> None:
    monkeypatch.setattr(sys, "argv", ["sensorsim", *map(str, words)])
    with pytest.raises(SystemExit) as left:
        main()
    assert left.value.code == 0


def test_effects_prints_the_ledger_that_the_frame_has(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    town, out = write_town(tmp_path, town_features()), tmp_path / "a.png"
    common = ("--at", AT, "--preset", "report", "--camera", "-150,-140,60,45,-18", "--size", "48x36")
    run(monkeypatch, "effects", town, *common, "--json")
    told: dict[str, Any] = json.loads(capsys.readouterr().out)
    run(monkeypatch, "render", town, *common, "--out", out)
    settings = json.loads(out.with_suffix(".json").read_text())["settings"]
    assert [(row["effect"], row["on"]) for row in told["effects"]] == [
        (row["effect"], row["on"]) for row in settings["effects"]
    ]
    assert settings["not_modelled"] == told["not_modelled"] == list(NOT_MODELLED)
    assert {row["effect"]: row["on"] for row in told["effects"]}["direct_sun"]
    assert not {row["effect"]: row["on"] for row in told["effects"]}["rain"]


def test_effects_go_by_the_tolerance_that_the_user_gives(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """Of none everything goes that changes nothing, of a million kelvin all but what is kept on request."""
    told, town = {}, write_town(tmp_path, town_features())
    for text in ("auto,0K", "auto", "auto,1000000K"):
        run(monkeypatch, "effects", town, "--at", AT, "--preset", "report", "--effects", text, "--json")
        told[text] = json.loads(capsys.readouterr().out)["effects"]
    on = {text: {row["effect"] for row in rows if row["on"]} for text, rows in told.items()}
    assert on["auto,0K"] >= on["auto"] > on["auto,1000000K"] == set()
    assert {row["tolerance"] for row in told["auto,1000000K"]} == {1e6}
    exchange = next(row for row in told["auto"] if row["effect"] == "exchange")
    assert not exchange["on"]
    assert "on request" not in exchange["reason"]


def test_band_without_temperature_tells_that_the_bake_is_what_it_saves(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    town = write_town(tmp_path, town_features())
    run(monkeypatch, "effects", town, "--at", AT, "--preset", "report", "--sensor", "lltv", "--json")
    rows = {row["effect"]: row for row in json.loads(capsys.readouterr().out)["effects"]}
    assert not any(rows[name]["on"] for name in ("temperature", "spare_reflectances", "spare_orientations", "interior"))
    assert rows["temperature"]["saves_ms"] > 10.0
    assert rows["interior"]["saves_ms"] == 0.0


def test_effects_prints_a_table(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    run(monkeypatch, "effects", write_town(tmp_path, town_features()), "--at", AT, "--preset", "report")
    told = capsys.readouterr().out
    assert all(word in told for word in ("direct_sun", "tolerance", "none in the history", "Not modelled at all"))


def test_costs_are_told_of_effects_that_there_are() -> None:
    """A name that no effect has would cost nothing, and nobody would know."""
    of_surfaces = {effect.name for effect in EFFECTS if effect.stage == SURFACE}
    assert of_surfaces >= OF_WALLS
    assert {effect.name for effect in EFFECTS} - of_surfaces >= PER_PIXEL.keys()
