"""Every hard case of solver, tables and frames holds; and each group of cases can tell a broken model."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from sensorsim.cli import study_stability
from sensorsim.cli.app import app
from sensorsim.errors import NumericsError
from sensorsim.study import (
    stability,
    stability_march_laws,
    stability_march_layers,
    stability_march_skins,
    stability_march_snow,
    stability_pixel_frames,
    stability_pixel_normals,
    stability_pixel_tables,
)
from sensorsim.study.stability import CASES
from sensorsim.study.stability_model import Case, Outcome, evaluate_case
from sensorsim.study.stability_plots import SKIN, overshoot, theta_method
from sensorsim.tables import OrientationSet
from sensorsim.thermal import build_grid, march

PLAIN = Case(
    name="a <case>", group="group", stresses="s", measured="m", unit="K", bound=1.0, reason="r", measure=lambda: 0.5
)


@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_hard_case_holds(case: Case) -> None:
    outcome = evaluate_case(case)
    assert outcome.holds, f"{outcome.result:g} {case.unit} > {case.bound:g}: {case.measured} {outcome.problem}"


def test_every_case_is_told_apart_and_says_all_that_the_page_shows() -> None:
    assert len({case.name for case in CASES}) == len(CASES)
    for case in CASES:
        assert all((case.group, case.stresses, case.measured, case.unit, case.reason)), case.name
        assert case.bound >= 0.0


@pytest.mark.parametrize(
    ("result", "holds", "margin"), [(0.5, True, 2.0), (1.0, True, 1.0), (2.0, False, 0.5), (np.inf, False, 0.0)]
)
def test_case_holds_up_to_its_bound(result: float, holds: bool, margin: float) -> None:
    outcome = evaluate_case(replace(PLAIN, measure=lambda: result))
    assert outcome.holds is holds
    assert outcome.margin == margin


def test_what_is_no_number_and_what_raises_fails() -> None:
    def broken() -> float:
        raise NumericsError("did not converge")

    assert not evaluate_case(replace(PLAIN, measure=lambda: float("nan"))).holds
    outcome = evaluate_case(replace(PLAIN, measure=broken))
    assert not outcome.holds
    assert outcome.problem == "did not converge"
    assert outcome.to_dict()["result"] is None


def _fails(module: Any, start: str) -> bool:
    """Whether any case of a module whose name begins so fails."""
    cases = [case for case in module.CASES if case.name.startswith(start)]
    assert cases
    return any(not evaluate_case(case).holds for case in cases)


def test_skins_tell_a_method_that_rings(monkeypatch: pytest.MonkeyPatch) -> None:
    """Crank and Nicolson's method in the march's place fails them by kelvins; backward Euler's does not."""
    grid = build_grid(SKIN, 600.0)
    steady = float(theta_method(grid, 1e6, 400, 1.0)[-1])
    assert overshoot(theta_method(grid, 600.0, 300, 0.5), steady) > 1.0
    assert overshoot(theta_method(grid, 600.0, 300, 1.0), steady) < 1e-6
    ringing = theta_method(grid, 600.0, 300, 0.5)
    monkeypatch.setattr(stability_march_skins, "sunrise", lambda *_: 280.0 + ringing)
    assert _fails(stability_march_skins, "sunrise on copper on batting")


def _tampered(change: float) -> Any:
    """A march whose exterior face drifts by `change` [K] over each 100 records, and whose heats are off by it."""

    def marched(*args: Any, **options: Any) -> Any:
        history = march(*args, **options)
        drift = change * np.arange(1, history.exterior.shape[0] + 1)[:, None, None] / 100.0
        return replace(history, exterior=history.exterior + drift, heat=history.heat * (1.0 + change))

    return marched


@pytest.mark.parametrize(
    ("module", "start"),
    [
        (stability_march_layers, "air space between"),
        (stability_march_layers, "wall of resistances"),
        (stability_march_laws, "heat balance of sheet steel"),
        (stability_march_laws, "range of steel"),
        (stability_march_laws, "one factored wall"),
        (stability_march_snow, "thaw"),
        (stability_march_snow, "heat of the thaw"),
    ],
)
def test_a_march_that_is_off_by_a_hundredth_is_found(module: Any, start: str, monkeypatch: pytest.MonkeyPatch) -> None:
    calls = iter((0.01, 0.1) * 50)
    monkeypatch.setattr(module, "march", lambda *args, **options: _tampered(next(calls))(*args, **options))
    if start.startswith("range"):
        monkeypatch.setattr(module, "march", _tampered(20.0))
    assert _fails(module, start)


def test_chatter_is_counted_as_turns_of_the_face() -> None:
    assert stability_march_snow.turns(np.array([1.0, 2.0, 2.0, 3.0])) == 0
    assert stability_march_snow.turns(np.array([1.0, 2.0, 2.0, 1.0])) == 1
    assert stability_march_snow.turns(np.array([0.0, 1.0, 0.0, 1.0])) == 2
    assert stability_march_snow.turns(np.array([0.0, 1e-7, 0.0, 1e-7])) == 0


def test_normals_tell_an_interpolation_by_the_three_closest_orientations(monkeypatch: pytest.MonkeyPatch) -> None:
    """By distance, as the report has it: the third counts on an edge too, and what is no normal goes through."""

    def closest(self: OrientationSet, normal: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        cosine = np.nan_to_num(normal) @ self.normal.T
        corner = np.argsort(-cosine, axis=1)[:, :3]
        nearness = 1.0 / np.abs(1.0 - np.take_along_axis(cosine, corner, axis=1)).clip(1e-12, 1e12)
        return corner, nearness / nearness.sum(axis=1, keepdims=True)

    monkeypatch.setattr(OrientationSet, "locate", closest)
    assert _fails(stability_pixel_normals, "normal on every edge")
    assert _fails(stability_pixel_normals, "normals of length 0")


def test_float16_would_break_the_bound_of_the_tables() -> None:
    (case,) = (case for case in stability_pixel_tables.CASES if case.name == "coefficients in float32")
    assert stability_pixel_tables.rounding(np.float16) > case.bound


def test_depth_tells_walls_that_no_buffer_of_24_bits_could() -> None:
    """A millimetre at 50 km is below the resolution of 6 mm: the wrong wall is seen, and counted."""
    assert stability_pixel_frames._hidden(5e4, 1e-3, None) == 1.0


def test_page_and_command_show_every_case_and_fail_with_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stability, "CASES", (PLAIN, replace(PLAIN, name="bad", measure=lambda: 3.0)))
    page = tmp_path / "new" / "page.html"
    result = CliRunner().invoke(app, ["study", "stability", "--out", str(page), "--json"])
    assert result.exit_code == 1
    told = json.loads(result.stdout)
    assert told["failed"] == 1
    assert [case["holds"] for case in told["cases"]] == [True, False]
    text = page.read_text(encoding="utf-8")
    assert text.count('class="alarm"') == 1
    assert "a &lt;case&gt;" in text
    assert text.count("<img") >= 3
    monkeypatch.setattr(stability, "CASES", (PLAIN,))
    shown = CliRunner().invoke(app, ["study", "stability", "--out", str(page)])
    assert shown.exit_code == 0
    assert "1 hard cases, 0 fail" in shown.stdout


def test_outcome_is_named_in_the_terminal_by_its_margin() -> None:
    assert study_stability.margin_text(Outcome(case=PLAIN, result=0.0)) == "exact"
    assert study_stability.margin_text(Outcome(case=PLAIN, result=0.1)) == "10"
