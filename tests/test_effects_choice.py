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
    Bound,
    Effect,
    EffectChoice,
    EffectPlan,
    Ledger,
    decide,
    read_choice,
)
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


def test_effects_prints_a_table(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setenv("COLUMNS", "200")
    run(monkeypatch, "effects", write_town(tmp_path, town_features()), "--at", AT, "--preset", "report")
    told = capsys.readouterr().out
    assert all(word in told for word in ("direct_sun", "tolerance", "none in the history", "Not modelled at all"))
