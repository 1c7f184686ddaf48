"""`sensorsim study effects`: what each effect is worth in kelvin and in milliseconds on the report's images."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from sensorsim.cli.options import AsJson, Backend, bake_progress, make_folder, read_size
from sensorsim.study import require_plot
from sensorsim.study.effects_page import HEAD, row, write_effects_page
from sensorsim.study.effects_worth import image_count, measure_effects
from sensorsim.tables import preset as bake_preset

KEYS = ("rms_K", "max_K", "bound_K", "max_of_white", "bake_ms", "frame_ms", "images")


def effects(
    out: Annotated[Path | None, typer.Option(help="HTML page with a plot; needs matplotlib.")] = None,
    size: Annotated[str, typer.Option(help="WIDTHxHEIGHT of each picture that is compared.")] = "160x120",
    preset: Annotated[str | None, typer.Option(help="How finely to bake; coarsely if left out.")] = None,
    backend: Backend = "auto",
    as_json: AsJson = False,
) -> None:
    """Leave out one effect at a time on the report's images and tell what that changes and what time it saves."""
    pixels, settings = read_size(size), None if preset is None else bake_preset(preset)
    if out is not None:
        require_plot(out.with_suffix(".png"))
        make_folder(out.parent)
    with bake_progress("effects") as progress:
        found = measure_effects(settings=settings, size=pixels, backend=backend, progress=progress)
    if out is not None:
        write_effects_page(out, found, image_count())
    if as_json:
        worths = {str(cells[0]): dict(zip(KEYS, cells[1:], strict=True)) for cells in map(row, found)}
        print(json.dumps({"images": image_count(), "effects": worths}))  # noqa: T201
        return
    table = Table(title=f"What each effect is worth on {image_count()} images of the report", title_justify="left")
    for title in HEAD:
        table.add_column(title, justify="left" if title == HEAD[0] else "right", no_wrap=title == HEAD[0])
    for worth in found:
        table.add_row(*(cell if isinstance(cell, str) else f"{cell:.3g}" for cell in row(worth)))
    Console(highlight=False, markup=False).print(table)
