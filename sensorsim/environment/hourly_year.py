"""From the hourly table of an EPW or TMY3 file to weather.

Each row tells of an hour by its end. Air, wind and cloud are of that moment; radiation is the mean of the hour before
it, and rain fell in that hour. Months may come from different years: the table is then a typical year, kept in calendar
order under one nominal year without a leap day, and stands for any year.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import date, datetime, timedelta
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY, SECONDS_PER_HOUR, ZERO_CELSIUS
from sensorsim.environment.place_check import require_clock
from sensorsim.environment.site import Site
from sensorsim.environment.typical_year import DAYS_OF_YEAR, NOMINAL_YEAR
from sensorsim.environment.weather import Weather
from sensorsim.environment.weather_columns import LIMITS, RADIATION_LIMITS, SITE_LIMITS, radiation_fields
from sensorsim.errors import InputError

FloatArray = NDArray[np.float64]

HOURS_WET = 3  # [h] that ground stays wet after rain; estimate


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HourlyYear:
    """An hourly table as it stands in the file; arrays over n rows, NaN where a value is missing."""

    path: Path
    kind: str
    first_line: int  # of the table in the file
    site: Site
    date: NDArray[np.datetime64]  # (n,) day that the row is of
    time_of_day: FloatArray  # (n,) [s] end of the row's interval, up to 24 h
    columns: Mapping[str, FloatArray]  # by name and unit as in `weather_columns`; total_cover_percent, snow_depth_cm
    rained: NDArray[np.bool_]  # (n,) whether any rain fell


def weather_of_year(table: HourlyYear, typical_year: bool | None) -> Weather:
    """Weather of the table, in SI, checked; `typical_year` as for `read_weather`."""
    _require_site(table)
    years = np.unique(table.date.astype("datetime64[Y]")).astype(int) + 1970
    typical = years.size > 1 if typical_year is None else typical_year
    time = _times(table, typical)
    sky, cloud_note = _cloud_column(table)
    rain, rain_note = _rain(table)
    columns = {**table.columns, "cloud_cover_percent": table.columns[sky], "precipitation_mm_h": rain}
    value = {column: _whole(table, columns[column], column) for column in LIMITS}
    radiation = _radiation(table)
    year = f"typical year, months from {', '.join(map(str, years))}" if typical else f"weather of {years[0]}"
    notes = (f"{table.kind}, {year}.", cloud_note, rain_note, _radiation_note(radiation))
    return Weather(
        name=table.path.stem,
        file=table.path,
        notes=tuple(note for note in notes if note),
        site=table.site,
        start=_midnight(table, typical) + timedelta(seconds=float(time[0])),
        time=time - time[0],
        air_temperature=value["air_temperature_C"] + ZERO_CELSIUS,
        relative_humidity=value["relative_humidity_percent"] / 100.0,
        wind_speed=value["wind_speed_m_s"],
        wind_direction=value["wind_direction_deg"],
        cloud_cover=value["cloud_cover_percent"] / 100.0,
        precipitation=np.roll(rain, -1) if typical else np.append(rain[1:], 0.0),
        ground_state=_ground_state(table),
        radiation_averaging=float(time[1] - time[0]),
        typical_year=typical,
        **radiation_fields(radiation),
    )


def _require_site(table: HourlyYear) -> None:
    site = table.site
    for (entry, (low, high)), value in zip(
        SITE_LIMITS.items(), (site.longitude, site.latitude, site.altitude, site.utc_offset), strict=True
    ):
        if not low <= value <= high:
            raise InputError(f"{table.path}:1", entry, value, "out of range", f"give {low:g} to {high:g}")
    require_clock(f"{table.path}:1", site)


def _times(table: HourlyYear, typical: bool) -> FloatArray:
    """Time (n,) [s] of the rows after the first midnight of the (nominal) year or of the first day."""
    day = table.date.astype("datetime64[D]")
    if typical:
        leap = (day.astype("datetime64[M]").astype(int) % 12 == 1) & (_day_of_month(day) == 29)
        if leap.any():
            where = f"{table.path}:{table.first_line + int(np.argmax(leap))}"
            problem = "a leap day in a typical year"
            raise InputError(where, "date", str(day[np.argmax(leap)]), problem, "drop the day, or keep one real year")
        month = day.astype("datetime64[M]").astype(int) % 12
        nominal = np.datetime64(f"{NOMINAL_YEAR}-01") + month
        days = (nominal.astype("datetime64[D]") - np.datetime64(f"{NOMINAL_YEAR}-01-01")).astype(float)
        time = (days + _day_of_month(day) - 1.0) * SECONDS_PER_DAY + table.time_of_day
    else:
        time = (day - day[0]).astype(float) * SECONDS_PER_DAY + table.time_of_day
    _require_uniform(table, time, typical)
    return np.asarray(time, dtype=np.float64)


def _day_of_month(day: NDArray[np.datetime64]) -> NDArray[np.int64]:
    return np.asarray((day - day.astype("datetime64[M]").astype("datetime64[D]")).astype(np.int64) + 1)


def _require_uniform(table: HourlyYear, time: FloatArray, typical: bool) -> None:
    if time.size < 2:
        raise InputError(table.path, "rows", time.size, "too few", "give at least two hours")
    steps = np.diff(time)
    wrong = np.abs(steps - steps[0]) > 1e-6
    if steps[0] <= 0.0 or wrong.any():
        row = int(np.argmax(wrong)) + 1
        text = f"{table.date[row]} hour ending {table.time_of_day[row] / SECONDS_PER_HOUR:g}"
        problem = f"{steps[row - 1] / SECONDS_PER_HOUR:g} h after the row before, where the file began with "
        problem += f"{steps[0] / SECONDS_PER_HOUR:g} h"
        remedy = "sort the rows and fill the gap, or read months of several years with typical_year=True"
        raise InputError(f"{table.path}:{table.first_line + row}", "time", text, problem, remedy)
    if typical and abs(time.size * steps[0] - DAYS_OF_YEAR * SECONDS_PER_DAY) > 1e-6:
        days = round(time.size * steps[0] / SECONDS_PER_DAY, 2)
        raise InputError(table.path, "days", days, "a typical year has 365", "give the whole year")


def _whole(table: HourlyYear, values: FloatArray, column: str) -> FloatArray:
    """The values of a column, none missing and all in their limits."""
    low, high = LIMITS[column] if column in LIMITS else RADIATION_LIMITS[column]
    wrong = ~((values >= low) & (values <= high))
    if wrong.any():
        row = int(np.argmax(wrong))
        where = f"{table.path}:{table.first_line + row}"
        missing = bool(np.isnan(values[row]))
        others = int(wrong.sum()) - 1
        problem = f"{'missing' if missing else 'out of range'} here" + (f" and in {others} more rows" if others else "")
        raise InputError(
            where, column, None if missing else float(values[row]), problem, "fill it or take another file"
        )
    return values


def _midnight(table: HourlyYear, typical: bool) -> datetime:
    """The midnight that times are counted from: of the nominal year or of the first day."""
    day = date(NOMINAL_YEAR, 1, 1) if typical else table.date[0].astype("datetime64[D]").item()
    return datetime(day.year, day.month, day.day, tzinfo=table.site.time_zone)


def _radiation(table: HourlyYear) -> dict[str, FloatArray | None]:
    """Columns of radiation; direct and diffuse only as a pair."""
    found = {column: _whole_or_none(table, column) for column in RADIATION_LIMITS}
    pair = ("direct_normal_W_m2", "diffuse_horizontal_W_m2")
    return found | dict.fromkeys(pair) if any(found[column] is None for column in pair) else found


def _whole_or_none(table: HourlyYear, column: str) -> FloatArray | None:
    """A column of radiation; None where the file has none of it, which some write as zeros."""
    values = table.columns[column]
    return None if not np.any(np.nan_to_num(values)) else _whole(table, values, column)


def _cloud_column(table: HourlyYear) -> tuple[str, str]:
    """Opaque cover rather than the total one, as thin cloud hides neither sun nor cold sky."""
    if np.isnan(table.columns["cloud_cover_percent"]).all():
        return "total_cover_percent", "Cloud cover is the total one, as the opaque one is missing."
    return "cloud_cover_percent", ""


def _rain(table: HourlyYear) -> tuple[FloatArray, str]:
    """Rain (n,) [mm/h] in the interval that ends with each row; none where it was not written down."""
    values = table.columns["precipitation_mm_h"]
    missing = int(np.isnan(values).sum())
    note = f"Precipitation by the hour is missing in {missing} of {values.size} rows: taken as none." if missing else ""
    return np.nan_to_num(values), note


def _ground_state(table: HourlyYear) -> NDArray[np.str_]:
    """Snow where some lies, wet for HOURS_WET after rain, else dry; missing depths of snow count as none."""
    recent = np.convolve(table.rained, np.ones(HOURS_WET + 1), mode="full")[: table.rained.size] > 0.0
    snow = np.nan_to_num(table.columns["snow_depth_cm"]) > 0.0
    return np.where(snow, "snow", np.where(recent, "wet", "dry")).astype(np.str_)


def _radiation_note(radiation: Mapping[str, FloatArray | None]) -> str:
    absent = [column for column, values in radiation.items() if values is None]
    return f"Not in the file, so modelled: {', '.join(absent)}." if absent else ""
