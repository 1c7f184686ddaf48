"""`sensorsim effects`: which effects a scene calls for, with a bound for each one that is left out."""

import json
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from sensorsim.cli.options import AsJson, Effects, Level, Preset, SceneName, find_weather, read_moment, read_size
from sensorsim.cli.render import read_camera
from sensorsim.effects import NOT_MODELLED, Ledger, read_choice
from sensorsim.render import survey_ledger, survey_scene
from sensorsim.scene import load_scene
from sensorsim.sensor import load_sensor
from sensorsim.tables import preset as bake_preset


def effects(
    scene: SceneName,
    at: Annotated[str, typer.Option(help="Local standard time, ISO 8601: 1976-02-07T10:00.")],
    level: Level = "IIIB",
    sensor: Annotated[str, typer.Option(help="Sensor that comes with the package, or a TOML file.")] = "flir",
    camera: Annotated[str | None, typer.Option(help="Camera as `render` takes it.")] = None,
    field_of_view: Annotated[float | None, typer.Option(help="Horizontal field of view [deg].")] = None,
    size: Annotated[str | None, typer.Option(help="WIDTHxHEIGHT in pixels; the sensor's own if left out.")] = None,
    weather: Annotated[str | None, typer.Option(help="winter, summer, fall or a CSV file.")] = None,
    preset: Preset = "standard",
    effects: Effects = "auto",
    as_json: AsJson = False,
) -> None:  # fmt: skip
    """Print the ledger of effects: on or off, bound, tolerance, reason and time saved; no wall is solved for it."""
    device, moment, choice = load_sensor(sensor), read_moment(at), read_choice(effects)
    place = load_scene(scene, level=level)
    survey = survey_scene(
        place, find_weather(weather, moment.date()), image_day=moment.date(), settings=bake_preset(preset),
        choice=choice, sensor=device,
    )  # fmt: skip
    seconds = moment.hour * 3600.0 + moment.minute * 60.0 + moment.second
    view = read_camera(place, camera, field_of_view)
    ledger = survey_ledger(survey, device, view, device.size if size is None else read_size(size), seconds)
    if as_json:
        print(json.dumps({"effects": ledger.to_list(), "not_modelled": list(NOT_MODELLED)}, indent=2))  # noqa: T201
        return
    _show(ledger)


def _show(ledger: Ledger) -> None:
    console = Console(highlight=False, markup=False)  # brackets are units, not styles
    table = Table(title="Effects, and what leaving each of them out would change at most", title_justify="left")
    for title, right in (("effect", 0), ("", 0), ("bound", 1), ("tolerance", 1), ("unit", 0), ("saves [ms]", 1)):
        table.add_column(title, justify="right" if right else "left", no_wrap=True)
    table.add_column("reason")
    for row in ledger.rows:
        table.add_row(
            row.effect, "on" if row.on else "off", f"{row.bound:.3g}", f"{row.tolerance:.3g}", row.unit,
            f"{row.saves:.3g}", row.reason,
        )  # fmt: skip
    console.print(table)
    console.print("Not modelled at all: " + "; ".join(NOT_MODELLED) + ".")
