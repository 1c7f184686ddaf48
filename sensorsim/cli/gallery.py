"""`sensorsim gallery`: the report's figures as contact sheets."""

import json
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from sensorsim.cli.options import AsJson, Backend, Effects, Preset, bake_progress, make_folder, read_size
from sensorsim.effects import read_choice
from sensorsim.sensor import load_sensor
from sensorsim.study import make_gallery
from sensorsim.tables import preset as bake_preset


def gallery(
    out: Annotated[Path, typer.Option(help="Folder of the sheets.")] = Path("out/gallery"),
    size: Annotated[str, typer.Option(help="WIDTHxHEIGHT of each picture.")] = "480x360",
    sensors: Annotated[
        str,
        typer.Option("--sensors", "--sensor", help="One for each band; flir1977,sit1977 are of the report's time."),
    ] = "flir,lltv",
    preset: Preset = "standard",
    effects: Effects = "auto",
    backend: Backend = "auto",
    as_json: AsJson = False,
) -> None:
    """Draw figures 19 and 21 to 27 of the report as labelled contact sheets."""
    pixels, settings, choice = read_size(size), bake_preset(preset), read_choice(effects)
    devices = [load_sensor(name) for name in sensors.split(",")]
    make_folder(out)
    with bake_progress("gallery") as progress:
        sheets = make_gallery(
            out, size=pixels, settings=settings, backend=backend, progress=progress, effects=choice, sensors=devices
        )
    if as_json:
        print(json.dumps({"files": [str(path) for path in sheets]}))  # noqa: T201
        return
    console = Console(soft_wrap=True)
    for path in sheets:
        console.print(f"wrote {path}", markup=False, highlight=False)
