"""Reads the boundary series of a wall from a CSV file; see `COLUMNS` for what it holds.

The first row names the columns, in any order; lines that begin with # are notes. A column that is constant may be left
out and given as a number instead.
"""

import csv
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from datetime import datetime
from difflib import get_close_matches
from pathlib import Path

import numpy as np

from sensorsim.constants import SECONDS_PER_HOUR, ZERO_CELSIUS
from sensorsim.errors import InputError
from sensorsim.thermal.boundary import FloatArray
from sensorsim.thermal.wall_boundary import FILMS, IRRADIANCES, TEMPERATURES, WallBoundary, find_fault

UNITS: Mapping[str, str] = {
    **dict.fromkeys(TEMPERATURES, "C"),
    **dict.fromkeys(IRRADIANCES, "W m-2"),
    **dict.fromkeys(FILMS, "W m-2 K-1"),
}
COLUMNS = ("time", *UNITS)
LONGEST_GAP = 3.0 * SECONDS_PER_HOUR  # [s] across which a line between samples is taken for weather


@dataclass(frozen=True, slots=True, kw_only=True)
class BoundaryFile:
    """A boundary series as a file tells it."""

    boundary: WallBoundary  # time from the first sample on
    time_text: tuple[str, ...]  # (t,) as it stands in the file
    start: datetime | None  # of the first sample, with its offset; None where times are seconds
    notes: tuple[str, ...]  # what was assumed of columns that are left out


@dataclass(frozen=True, slots=True, kw_only=True)
class _Table:
    """Cells of a file as text, by column."""

    path: Path
    line: tuple[int, ...]  # of each row
    column: Mapping[str, tuple[str, ...]]

    def error(self, name: str, row: int, problem: str, remedy: str) -> InputError:
        return InputError(f"{self.path} line {self.line[row]}", name, self.column[name][row], problem, remedy)


def read_boundary(
    path: Path,
    *,
    constants: Mapping[str, float] | None = None,
    emissivity: float = 1.0,
    sky_view: float = 0.5,
    longest_gap: float = LONGEST_GAP,
) -> BoundaryFile:
    """Boundary series of a CSV file, with constant columns by name in the units of `UNITS`.

    Left out and not given: irradiances are 0; interior_radiant_temperature is interior_air_temperature; the sky or the
    ground is at air temperature where an emissivity of 0 or `sky_view` makes it count for nothing. All else is needed.
    Raises InputError naming file, line, column, value and remedy.
    """
    constants = constants or {}
    table = _read_table(path, constants)
    time, start = _read_time(table, longest_gap)
    series = {name: _read_numbers(table, name) for name in table.column if name != "time"}
    series |= {name: _constant(name, value, time.size) for name, value in constants.items()}
    notes = _fill(path, series, emissivity, sky_view, time.size)
    return BoundaryFile(
        boundary=WallBoundary(time=time, **series), time_text=table.column["time"], start=start, notes=tuple(notes)
    )


def _read_table(path: Path, constants: Mapping[str, float]) -> _Table:
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            rows = list(_rows(file))
    except OSError as error:
        raise InputError(path, "file", path.name, error.strerror or "cannot be read", "name a CSV file") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise InputError(path, "file", path.name, f"no CSV text: {error}", "save it as CSV in UTF-8") from error
    if not rows:
        remedy = f"begin with a row of column names: {', '.join(COLUMNS)}"
        raise InputError(path, "file", path.name, "empty", remedy)
    (line, header), *body = rows
    _check_header(f"{path} line {line}", header, constants)
    if len(body) < 2:
        raise InputError(path, "rows", len(body), "too few", "give two or more, one for each time")
    for line, cells in body:
        if len(cells) != len(header):
            where = f"{path} line {line}"
            problem = f"{len(cells)} cells under {len(header)} columns"
            raise InputError(where, "row", ",".join(cells), problem, "give one cell for each column")
    columns = zip(*(cells for _, cells in body), strict=True)
    return _Table(
        path=path, line=tuple(line for line, _ in body), column=dict(zip(header, map(tuple, columns), strict=True))
    )


def _rows(file: Iterator[str]) -> Iterator[tuple[int, list[str]]]:
    """Line number and cells of all rows that are neither blank nor notes."""
    reader = csv.reader(file)
    for cells in reader:
        stripped = [cell.strip() for cell in cells]
        if any(stripped) and not stripped[0].startswith("#"):
            yield reader.line_num, stripped


def _check_header(where: str, header: list[str], constants: Mapping[str, float]) -> None:
    if "time" not in header:
        remedy = "begin with a row of names with commas between; `time` holds ISO 8601 times with offset, or seconds"
        raise InputError(where, "columns", ",".join(header), "no column `time`", remedy)
    for name in header:
        if name not in COLUMNS:
            raise InputError(where, "column", name, "unknown", _closest(name))
        if header.count(name) > 1:
            raise InputError(where, "column", name, "there twice", "remove one")
        if name in constants:
            raise InputError(where, "column", name, "given as a constant too", f"drop the column or {option(name)}")


def _closest(name: str) -> str:
    """What to do about an unknown column: names stand without units."""
    plain = name.lower().split("[")[0].split("(")[0].strip().replace(" ", "_")
    near = [known for known in COLUMNS if known == plain] or get_close_matches(plain, COLUMNS, 1)
    if not near:
        return f"rename or remove it; known are {', '.join(COLUMNS)}"
    return f"rename it to {near[0]}{f', in {UNITS[near[0]]}' if near[0] in UNITS else ''}, or remove it"


def option(name: str) -> str:
    """Option that gives a column as a constant."""
    return "--" + name.replace("_", "-")


def _read_time(table: _Table, longest_gap: float) -> tuple[FloatArray, datetime | None]:
    """Seconds since the first sample (t,), and when that was."""
    texts = table.column["time"]
    if _number(texts[0]) is not None:
        start = None
        time = _read_numbers(table, "time")
        time = time - time[0]
    else:
        moments = [_read_moment(table, row) for row in range(len(texts))]
        start = moments[0]
        time = np.array([(moment - start).total_seconds() for moment in moments])
    fault = find_fault({"time": time})
    if fault is not None:
        raise table.error("time", fault.row, fault.problem, fault.remedy)
    gaps = np.diff(time) > longest_gap
    if np.any(gaps):
        row = int(np.argmax(gaps)) + 1
        problem = f"{(time[row] - time[row - 1]) / SECONDS_PER_HOUR:g} h after the row before"
        remedy = (
            f"fill the gap, check that seconds are seconds, or raise --longest-gap above {longest_gap / 3600.0:g} h"
        )
        raise table.error("time", row, problem, remedy)
    return time, start


def _read_moment(table: _Table, row: int) -> datetime:
    text = table.column["time"][row]
    remedy = "write 1976-02-07T10:00:00-05:00, or seconds in every row"
    try:
        moment = datetime.fromisoformat(text)
    except ValueError as error:
        raise table.error("time", row, "no ISO 8601 date and time", remedy) from error
    if moment.utcoffset() is None:
        raise table.error("time", row, "no UTC offset", remedy)
    return moment


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _read_numbers(table: _Table, name: str) -> FloatArray:
    """A column of numbers (t,), in kelvin where it is a temperature."""
    texts = table.column[name]
    try:
        values = np.array([float(text) for text in texts])
    except ValueError as error:
        row = next(row for row, text in enumerate(texts) if _number(text) is None)
        problem = "not a number" if texts[row] else "empty"
        comma = _number(texts[row].replace(",", ".")) is not None
        remedy = "write a point for the comma" if comma else "fill the gap or drop the row"
        raise table.error(name, row, problem, remedy) from error
    if name in TEMPERATURES:
        values += ZERO_CELSIUS
    fault = find_fault({name: values})
    if fault is not None:
        raise table.error(name, fault.row, fault.problem, fault.remedy)
    return values


def _constant(name: str, value: float, size: int) -> FloatArray:
    values = np.full(size, value + ZERO_CELSIUS if name in TEMPERATURES else value)
    fault = find_fault({name: values})
    if fault is not None:
        raise InputError("constant", option(name), value, fault.problem, f"give another, in {UNITS[name]}")
    return values


def _fill(path: Path, series: dict[str, FloatArray], emissivity: float, sky_view: float, size: int) -> list[str]:
    """Put in the columns that may be left out; returns what was assumed."""
    notes = []
    dark = [name for name in IRRADIANCES if name not in series]
    series |= {name: np.zeros(size) for name in dark}
    if dark:
        notes.append(f"not given, taken as 0: {', '.join(dark)}")
    weights = {"sky_temperature": emissivity * sky_view, "ground_temperature": emissivity * (1.0 - sky_view)}
    for name in UNITS:
        if name in series:
            continue
        if name == "interior_radiant_temperature" and "interior_air_temperature" in series:
            series[name] = series["interior_air_temperature"]
            notes.append(f"{name} not given, taken as interior_air_temperature")
        elif weights.get(name) == 0.0 and "air_temperature" in series:
            series[name] = series["air_temperature"]
        else:
            remedy = f"add the column [{UNITS[name]}], or give {option(name)} where it is constant"
            raise InputError(path, "column", name, "missing", remedy)
    return notes
