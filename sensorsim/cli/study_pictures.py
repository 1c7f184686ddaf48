"""`sensorsim study pictures`: each effect on and off, side by side."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from sensorsim.cli.options import AsJson, Backend, Preset, bake_progress, make_folder, read_size
from sensorsim.study import require_plot
from sensorsim.study.effects_pairs import take_pairs
from sensorsim.study.effects_pictures import HEAD, write_pictures_page
from sensorsim.tables import preset as bake_preset


def pictures(
    out: Annotated[Path, typer.Option(help="HTML page that is written.")] = Path("out/pictures.html"),
    size: Annotated[str, typer.Option(help="WIDTHxHEIGHT of each picture.")] = "320x240",
    preset: Preset = "standard",
    backend: Backend = "auto",
    as_json: AsJson = False,
) -> None:
    """Draw one pair of pictures per effect, on and off, with the difference, to be checked by eye."""
    pixels, settings = read_size(size), bake_preset(preset)
    require_plot(Path("pictures.png"))
    make_folder(out.parent)
    with bake_progress("pictures") as progress:
        rows = write_pictures_page(
            out, take_pairs(settings=settings, size=pixels, backend=backend, progress=progress)
        )  # fmt: skip
    if as_json:
        told = [dict(zip(HEAD, cells, strict=True)) for cells in rows]
        print(json.dumps({"page": str(out), "pictures": told}))  # noqa: T201
        return
    console = Console(highlight=False, markup=False)
    table = Table(title="What each effect changes in its picture", title_justify="left")
    for title in HEAD:
        table.add_column(title, justify="right" if title in ("RMS", "greatest", "bound") else "left", no_wrap=True)
    for cells in rows:
        table.add_row(*(cell if isinstance(cell, str) else f"{cell:.3g}" for cell in cells))
    console.print(table)
    console.print(f"wrote {out}", soft_wrap=True)
