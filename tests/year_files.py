"""Small synthetic EPW and TMY3 files: a year of hours in which every number can be told from its date."""

from collections.abc import Sequence
from datetime import date, timedelta
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment import Site, clear_sunlight, sun_position

FloatArray = NDArray[np.float64]

SITE = Site(name="Testville, OH, USA", longitude=-84.02, latitude=39.82, altitude=255.0, utc_offset=-5.0)
EPW_HEAD = """LOCATION,Testville,OH,USA,Test,724290,39.82,-84.02,-5.0,255.0
DESIGN CONDITIONS,0
TYPICAL/EXTREME PERIODS,0
GROUND TEMPERATURES,0
HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0
COMMENTS 1,synthetic
COMMENTS 2,synthetic
DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31
"""
TMY3_HEAD = '724290,"TESTVILLE",OH,-5.0,39.820,-84.020,255\n'
TMY3_COLUMNS = (
    "Date (MM/DD/YYYY)", "Time (HH:MM)", "GHI (W/m^2)", "DNI (W/m^2)", "DHI (W/m^2)", "TotCld (tenths)",
    "OpqCld (tenths)", "Dry-bulb (C)", "Dew-point (C)", "RHum (%)", "Pressure (mbar)", "Wdir (degrees)",
    "Wspd (m/s)", "Lprecip depth (mm)", "Lprecip quantity (hr)",
)  # fmt: skip


def days_of(year: int) -> list[date]:
    first = date(year, 1, 1)
    return [first + timedelta(days=k) for k in range((date(year + 1, 1, 1) - first).days)]


def temperature_of(day: date, hour: int) -> float:
    """Air temperature [C] at the end of an hour: day of the month whole, month and hour behind the point."""
    return round(day.day + day.month / 100.0 + hour / 10_000.0, 4)


@cache
def clear_means(days: tuple[date, ...]) -> tuple[FloatArray, FloatArray]:
    """Means of clear beam and diffuse sunlight [W m-2] over the hours that end at 1 to 24 h, per day (d, 24)."""
    start = np.array([day.isoformat() for day in days], dtype="datetime64[s]")
    inside = (np.arange(24 * 12) * 300 + 150).astype("timedelta64[s]")
    local = (start[:, None] + inside).ravel()
    light = clear_sunlight(SITE, sun_position(SITE, local + np.timedelta64(5 * 3600, "s")), local)
    return light.beam.reshape(-1, 24, 12).mean(axis=-1), light.diffuse.reshape(-1, 24, 12).mean(axis=-1)


def _sunlight(days: Sequence[date]) -> tuple[FloatArray, FloatArray]:
    """Clear-sky means of the days of February; no sun shines in the other months, to save time."""
    beam, diffuse = np.zeros((len(days), 24)), np.zeros((len(days), 24))
    february = [k for k, day in enumerate(days) if day.month == 2]
    if february:
        beam[february], diffuse[february] = clear_means(tuple(days[k] for k in february))
    return beam, diffuse


def epw_text(days: Sequence[date], years: Sequence[int] | None = None, share: float = 0.8) -> str:
    """An EPW file of the given days; `years` per month instead of their own; sunlight a share of the clear one."""
    beam, diffuse = _sunlight(days)
    rows = []
    for k, day in enumerate(days):
        year = day.year if years is None else years[day.month - 1]
        for hour in range(1, 25):
            snow = 3 if day.month == 1 else 0
            rain = 2.0 if (day.month, day.day, hour) == (2, 6, 10) else 0.0
            dni, dhi = share * beam[k, hour - 1], share * diffuse[k, hour - 1]
            rows.append(
                f"{year},{day.month},{day.day},{hour},60,?9,{temperature_of(day, hour):.4f},-5.0,60,99000,0,0,"
                f"{200 + day.month},{dni:.2f},{dni:.2f},{dhi:.2f},0,0,0,0,{(10 * hour) % 360},3.5,9,4,20,77777,9,0,10,"
                f"0.1,{snow},88,0.2,{rain},1.0"
            )
    return EPW_HEAD + "\n".join(rows) + "\n"


def tmy3_text(days: Sequence[date], years: Sequence[int] | None = None, share: float = 0.8) -> str:
    """A TMY3 file of the given days, with the columns that are read."""
    beam, diffuse = _sunlight(days)
    rows = [",".join(TMY3_COLUMNS)]
    for k, day in enumerate(days):
        year = day.year if years is None else years[day.month - 1]
        for hour in range(1, 25):
            rain = 20 if (day.month, day.day, hour) == (2, 6, 10) else 0
            dni, dhi = share * beam[k, hour - 1], share * diffuse[k, hour - 1]
            rows.append(
                f"{day.month:02d}/{day.day:02d}/{year},{hour:02d}:00,{dni:.2f},{dni:.2f},{dhi:.2f},9,4,"
                f"{temperature_of(day, hour):.4f},-5.0,60,990,{(10 * hour) % 360},3.5,{rain},1"
            )
    return TMY3_HEAD + "\n".join(rows) + "\n"


def written(folder: Path, name: str, text: str) -> Path:
    path = folder / name
    path.write_text(text)
    return path
