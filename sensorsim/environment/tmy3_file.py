"""Reading TMY3 files of the National Renewable Energy Laboratory through pvlib; the format by [Wilcox2008]."""

import io
from pathlib import Path

import numpy as np
import pandas as pd
import pvlib

from sensorsim.constants import SECONDS_PER_HOUR
from sensorsim.environment.hourly_year import FloatArray, HourlyYear, weather_of_year
from sensorsim.environment.site import Site
from sensorsim.environment.weather import Weather
from sensorsim.errors import InputError

FIRST_LINE = 3  # of the table
MISSING = -9900.0
DATE, TIME = "Date (MM/DD/YYYY)", "Time (HH:MM)"
# Column of pvlib and the factor to the unit of our column.
COLUMNS = {
    "air_temperature_C": ("temp_air", 1.0),
    "relative_humidity_percent": ("relative_humidity", 1.0),
    "wind_speed_m_s": ("wind_speed", 1.0),
    "wind_direction_deg": ("wind_direction", 1.0),
    "cloud_cover_percent": ("OpqCld (tenths)", 10.0),
    "total_cover_percent": ("TotCld (tenths)", 10.0),
    "direct_normal_W_m2": ("dni", 1.0),
    "diffuse_horizontal_W_m2": ("dhi", 1.0),
    "global_horizontal_W_m2": ("ghi", 1.0),
}
RAIN = "Lprecip depth (mm)"


def is_tmy3(text: str) -> bool:
    """Whether a text is that of a TMY3 file."""
    return text.partition("\n")[2].startswith(DATE)


def read_tmy3(path: Path, text: str, typical_year: bool | None) -> Weather:
    """Weather of a TMY3 file, its text given; errors as `read_weather`.

    The format has neither infrared radiation nor a depth of snow: the sky's infrared is modelled, and the ground is
    dry or wet. That it rained is read, how much is not: some editions seem to write tenths of a millimetre where the
    heading says millimetres, and sums of several hours overlap.
    """
    try:
        data, header = pvlib.iotools.read_tmy3(io.StringIO(text), map_variables=True)
        columns = {name: _column(data[source]) * factor for name, (source, factor) in COLUMNS.items()}
        rained = np.nan_to_num(_column(data[RAIN])) > 0.0
        date = pd.to_datetime(data[DATE], format="%m/%d/%Y").to_numpy(dtype="datetime64[D]")
        clock = data[TIME].str.split(":", expand=True).to_numpy(dtype=np.float64)
        site = Site(
            name=", ".join(header[part].strip('" ') for part in ("Name", "State")),
            longitude=header["longitude"],
            latitude=header["latitude"],
            altitude=header["altitude"],
            utc_offset=header["TZ"],
        )
    except (KeyError, TypeError, ValueError) as error:
        problem = f"not as the format has it ({' '.join(str(error).split())[:80]})"
        raise InputError(path, "TMY3 table", None, problem, "take the file from its source again") from error
    absent = np.full(date.shape, np.nan)
    table = HourlyYear(
        path=path,
        kind="TMY3",
        first_line=FIRST_LINE,
        site=site,
        date=date,
        time_of_day=(clock[:, 0] + clock[:, 1] / 60.0) * SECONDS_PER_HOUR,
        columns={**columns, **dict.fromkeys(("sky_infrared_W_m2", "snow_depth_cm", "precipitation_mm_h"), absent)},
        rained=rained,
    )
    return weather_of_year(table, typical_year)


def _column(values: "pd.Series[float]") -> FloatArray:
    """Numbers of a column, NaN where missing."""
    numbers = values.to_numpy(dtype=np.float64)
    return np.where(numbers > MISSING, numbers, np.nan)
