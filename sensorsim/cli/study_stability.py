"""`sensorsim study stability`: every hard case with its bound, its result and the margin between them."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from sensorsim.cli.options import AsJson, bake_progress, make_folder
from sensorsim.study import require_plot
from sensorsim.study.stability import evaluate_cases
from sensorsim.study.stability_model import Outcome
from sensorsim.study.stability_page import margin_text, write_stability_page


def stability(
    out: Annotated[Path, typer.Option(help="HTML page that is written.")] = Path("out/stability.html"),
    as_json: AsJson = False,
) -> None:
    """Measure every hard case of solver, tables and frames against its bound; exit code 1 if one fails."""
    require_plot(Path("stability.png"))
    make_folder(out.parent)
    with bake_progress("stability") as progress:
        outcomes = evaluate_cases(progress)
    write_stability_page(out, outcomes)
    failed = sum(not outcome.holds for outcome in outcomes)
    if as_json:
        cases = [outcome.to_dict() for outcome in outcomes]
        print(json.dumps({"page": str(out), "failed": failed, "cases": cases}, indent=2))  # noqa: T201
    else:
        _show(outcomes, failed, out)
    if failed:
        raise typer.Exit(1)


def _show(outcomes: Sequence[Outcome], failed: int, out: Path) -> None:
    console = Console(highlight=False)
    table = Table(title=f"{len(outcomes)} hard cases, {failed} fail", title_justify="left")
    for head in ("group", "case", "result", "bound", "unit", "margin"):
        table.add_column(head, justify="right" if head in ("result", "bound", "margin") else "left")
    for outcome in outcomes:
        case = outcome.case
        cells = (case.group, case.name, f"{outcome.result:.2g}", f"{case.bound:.2g}", case.unit, margin_text(outcome))
        table.add_row(*map(escape, cells), style=None if outcome.holds else "red")
    console.print(table)
    console.print(f"wrote {escape(str(out))}", soft_wrap=True)
