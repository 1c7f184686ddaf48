"""`sensorsim study sensitivity`: what the uncertainty of each input is worth in kelvin, beside the solver's error."""

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
from sensorsim.study.sensitivity import Sensitivity, study_sensitivity
from sensorsim.study.sensitivity_page import LIMITS, sensitivity_json, sentence, write_sensitivity_page


def sensitivity(
    out: Annotated[Path, typer.Option(help="HTML page that is written.")] = Path("out/sensitivity.html"),
    as_json: AsJson = False,
) -> None:
    """Change one input at a time by its uncertainty, on six surfaces and three days, and rank what it is worth."""
    require_plot(Path("sensitivity.png"))
    make_folder(out.parent)
    with bake_progress("sensitivity") as progress:
        study = study_sensitivity(progress=progress)
    write_sensitivity_page(out, study)
    if as_json:
        print(json.dumps({"page": str(out), "surfaces": sensitivity_json(study)}, indent=2))  # noqa: T201
        return
    _show(study, out)


def _show(study: Sequence[Sensitivity], out: Path) -> None:
    console = Console(highlight=False, soft_wrap=True)
    table = Table(title="rms change of surface temperature [K]", title_justify="left", box=None, padding=(0, 1, 0, 0))
    table.add_column("input", no_wrap=True)
    for found in study:
        table.add_column(escape(found.specimen.name), justify="right")
    rows = [{effect.input.name: effect.rms for effect in (*found.effects, found.solver, found.fit)} for found in study]
    for name in sorted(rows[0], key=lambda name: -max(row[name] for row in rows)):
        table.add_row(escape(name), *(f"{row[name]:.3f}" for row in rows))
    console.print(table)
    for found in study:
        console.print(escape(sentence(found)))
    console.print(LIMITS)
    console.print(f"wrote {escape(str(out))}")
