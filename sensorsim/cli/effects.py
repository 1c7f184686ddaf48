"""`sensorsim effects`: which effects a scene calls for, with a bound for each one that is left out."""

import json
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from sensorsim.cli.options import (
    Aerosol,
    AsJson,
    Atmosphere,
    Effects,
    Level,
    Preset,
    SceneName,
    Visibility,
    find_weather,
    local_day,
    read_moment,
    read_size,
)
from sensorsim.cli.render import read_camera
from sensorsim.effects import NOT_MODELLED, Ledger, read_choice
from sensorsim.environment import DEFAULT_VISIBILITY
from sensorsim.render import survey_ledger, survey_scene
from sensorsim.render.air import DEFAULT_ATMOSPHERE, check_atmosphere
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
    weather: Annotated[str | None, typer.Option(help="winter, summer, fall, or a CSV, TMY3 or EPW file.")] = None,
    atmosphere: Atmosphere = DEFAULT_ATMOSPHERE,
    visibility: Visibility = DEFAULT_VISIBILITY / 1000.0,
    aerosol: Aerosol = "rural",
    preset: Preset = "standard",
    effects: Effects = "auto",
    as_json: AsJson = False,
) -> None:  # fmt: skip
    """Print the ledger of effects: on or off, bound, tolerance, reason and time saved; no wall is solved for it."""
    device, moment, choice = load_sensor(sensor), read_moment(at), read_choice(effects)
    place = load_scene(scene, level=level)
    series = find_weather(weather, local_day(moment, place.site.utc_offset))
    survey = survey_scene(
        place, series, image_day=local_day(moment, series.site.utc_offset), settings=bake_preset(preset),
        visibility=1000.0 * visibility, aerosol=aerosol, choice=choice, sensor=device,
    )  # fmt: skip
    midnight = survey.environment.image_start
    seconds = ((moment if moment.tzinfo else moment.replace(tzinfo=midnight.tzinfo)) - midnight).total_seconds()
    view, pixels = read_camera(place, camera, field_of_view), device.size if size is None else read_size(size)
    ledger = survey_ledger(survey, device, view, pixels, seconds, atmosphere=check_atmosphere(atmosphere))
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
