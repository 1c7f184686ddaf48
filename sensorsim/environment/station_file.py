"""Reading weather from a station's CSV: a commented header that names the site, then one row per sample.

Header lines begin with `#`. Lines `# key: value` with the keys of SITE_KEYS describe the site, `# note: ...` lines
are kept as notes, all others are remarks for the reader. Units are in the column names.

Measured radiation may be added in the columns of RADIATION_LIMITS: sunlight as direct and diffuse, or as global
alone, and the sky's infrared. It is of the moment of its row, or, with a line `# radiation_averaging_s: 3600`, the
mean of so many seconds that end with it.
"""

import csv
import math
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime, timedelta
from pathlib import Path

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.environment.place_check import require_clock
from sensorsim.environment.site import Site
from sensorsim.environment.weather import GROUND_STATES, FloatArray, Weather
from sensorsim.environment.weather_columns import (
    LIMITS,
    RADIATION_LIMITS,
    SITE_LIMITS,
    radiation_fields,
    require_sunlight_whole,
)
from sensorsim.errors import InputError
from sensorsim.resources import assets_folder
from sensorsim.units import kelvin_from_celsius

SITE_KEYS = ("site", "longitude_deg", "latitude_deg", "altitude_m", "utc_offset_h")
COLUMNS = ("time", *LIMITS, "ground_state")


@dataclass(frozen=True, slots=True)
class _Row:
    line: int
    cells: Mapping[str, str]


def read_station(path: Path, text: str) -> Weather:
    """Weather of a station's CSV file, its text given; errors as `read_weather`."""
    header, rows = _split(path, text)
    site = _site(path, header)
    require_clock(path, site)
    times = [_time(path, row).astimezone(site.time_zone) for row in rows]
    _require_uniform(path, rows, times)
    numbers = {column: _numbers(path, rows, column, limits) for column, limits in LIMITS.items()}
    radiation = {
        column: _numbers(path, rows, column, limits)
        for column, limits in RADIATION_LIMITS.items()
        if column in rows[0].cells
    }
    require_sunlight_whole(path, radiation)
    return Weather(
        name=path.stem.split("_")[0] if path.parent == assets_folder() / "weather" else path.stem,
        file=path,
        notes=tuple(value for key, value in header if key == "note"),
        site=site,
        start=times[0],
        time=_seconds(times),
        air_temperature=np.vectorize(kelvin_from_celsius, otypes=[np.float64])(numbers["air_temperature_C"]),
        relative_humidity=numbers["relative_humidity_percent"] / 100.0,
        wind_speed=numbers["wind_speed_m_s"],
        wind_direction=numbers["wind_direction_deg"],
        cloud_cover=numbers["cloud_cover_percent"] / 100.0,
        precipitation=numbers["precipitation_mm_h"],
        ground_state=np.array([_ground_state(path, row) for row in rows], dtype=np.str_),
        radiation_averaging=_averaging(path, header),
        **radiation_fields(radiation),
    )


def _split(path: Path, content: str) -> tuple[list[tuple[str, str]], list[_Row]]:
    """Header as (key, value) pairs and rows as texts by column, with the line each stands on."""
    header: list[tuple[str, str]] = []
    table: list[tuple[int, str]] = []
    for line, text in enumerate(content.splitlines(), start=1):
        if text.startswith("#"):
            key, found, value = text.lstrip("# ").partition(":")
            header += [(key.strip(), value.strip())] if found else []
        elif text.strip():
            table.append((line, text))
    columns = [cell.strip() for cell in next(csv.reader([table[0][1]]))] if table else []
    for column in COLUMNS:
        if column not in columns:
            raise InputError(path, "columns", columns, f"column {column} is missing", "add it to every row")
    rows = [_row(path, line, text, columns) for line, text in table[1:]]
    if len(rows) < 2:
        raise InputError(path, "rows", len(rows), "too few samples", "give at least two rows")
    return header, rows


def _row(path: Path, line: int, text: str, columns: list[str]) -> _Row:
    cells = [cell.strip() for cell in next(csv.reader([text]))]
    if len(cells) != len(columns):
        raise InputError(f"{path}:{line}", "row", text, f"{len(cells)} cells", f"give {len(columns)}, one per column")
    return _Row(line, dict(zip(columns, cells, strict=True)))


def _site(path: Path, header: list[tuple[str, str]]) -> Site:
    found = dict(header)
    for key in SITE_KEYS:
        if key not in found:
            raise InputError(path, key, None, "the header lacks it", f"add a line '# {key}: ...'")
    value = {key: _bounded(str(path), key, found[key], SITE_LIMITS[key]) for key in SITE_LIMITS}
    return Site(
        name=found["site"],
        longitude=value["longitude_deg"],
        latitude=value["latitude_deg"],
        altitude=value["altitude_m"],
        utc_offset=value["utc_offset_h"],
    )


def _time(path: Path, row: _Row) -> datetime:
    text, where = row.cells["time"], f"{path}:{row.line}"
    try:
        time = datetime.fromisoformat(text)
    except ValueError:
        raise InputError(where, "time", text, "not an ISO 8601 time", "write it as 1976-02-07T10:00:00-05:00") from None
    if time.tzinfo is None:
        raise InputError(where, "time", text, "no UTC offset", f"append one, as in {text}-05:00")
    return time


def _require_uniform(path: Path, rows: list[_Row], times: list[datetime]) -> None:
    interval = times[1] - times[0]
    for row, before, now in zip(rows[1:], times, times[1:], strict=False):
        where, shown = f"{path}:{row.line}", row.cells["time"]
        if now <= before:
            raise InputError(where, "time", shown, "does not come after the row before", "sort the rows by time")
        if now - before != interval:
            step = f"{now - before} after the row before, where the file began with {interval}"
            raise InputError(where, "time", shown, step, "fill the gap or use one interval")


def _seconds(times: list[datetime]) -> FloatArray:
    return np.array([(time - times[0]) / timedelta(seconds=1) for time in times])


def _numbers(path: Path, rows: list[_Row], column: str, limits: tuple[float, float]) -> FloatArray:
    return np.array([_bounded(f"{path}:{row.line}", column, row.cells[column], limits) for row in rows])


def _averaging(path: Path, header: list[tuple[str, str]]) -> float:
    text = dict(header).get("radiation_averaging_s", "0")
    return _bounded(str(path), "radiation_averaging_s", text, (0.0, SECONDS_PER_DAY))


def _bounded(where: str, entry: str, text: str, limits: tuple[float, float]) -> float:
    low, high = limits
    try:
        value = float(text)
    except ValueError:
        raise InputError(where, entry, text, "not a number", f"give one from {low:g} to {high:g}") from None
    if not math.isfinite(value):
        raise InputError(where, entry, text, "not finite", f"give a number from {low:g} to {high:g}")
    if not low <= value <= high:
        raise InputError(where, entry, text, "out of range", f"give a number from {low:g} to {high:g}")
    return value


def _ground_state(path: Path, row: _Row) -> str:
    text = row.cells["ground_state"]
    if text not in GROUND_STATES:
        raise InputError(
            f"{path}:{row.line}", "ground_state", text, "unknown", f"give one of {', '.join(GROUND_STATES)}"
        )
    return text
