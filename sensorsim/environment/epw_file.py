"""Reading EnergyPlus weather files (EPW) through pvlib; the format and its codes for missing values by [Crawley1999].

Sums of rain over several hours, which some rows carry, overlap with the hourly ones and are left out.
"""

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

FIRST_LINE = 9  # of the table
# Column of pvlib, the code from which on a value is missing, and the factor to the unit of our column.
COLUMNS = {
    "air_temperature_C": ("temp_air", 99.9, 1.0),
    "relative_humidity_percent": ("relative_humidity", 999.0, 1.0),
    "wind_speed_m_s": ("wind_speed", 999.0, 1.0),
    "wind_direction_deg": ("wind_direction", 999.0, 1.0),
    "cloud_cover_percent": ("opaque_sky_cover", 99.0, 10.0),
    "total_cover_percent": ("total_sky_cover", 99.0, 10.0),
    "direct_normal_W_m2": ("dni", 9999.0, 1.0),
    "diffuse_horizontal_W_m2": ("dhi", 9999.0, 1.0),
    "global_horizontal_W_m2": ("ghi", 9999.0, 1.0),
    "sky_infrared_W_m2": ("ghi_infrared", 9999.0, 1.0),
    "snow_depth_cm": ("snow_depth", 999.0, 1.0),
    "precipitation_mm_h": ("liquid_precipitation_depth", 999.0, 1.0),
}
GATHERED = ("liquid_precipitation_quantity", 99.0)  # [h] that the rain has gathered in; 0 in files that do not tell


def is_epw(text: str) -> bool:
    """Whether a text is that of an EPW file."""
    return text[:9].upper() == "LOCATION,"


def read_epw(path: Path, text: str, typical_year: bool | None) -> Weather:
    """Weather of an EPW file, its text given; errors as `read_weather`."""
    try:
        data, header = pvlib.iotools.read_epw(io.StringIO(text))
        columns = {name: _column(data[source], code) * factor for name, (source, code, factor) in COLUMNS.items()}
        gathered = np.nan_to_num(_column(data[GATHERED[0]], GATHERED[1]))
        date = pd.to_datetime(data[["year", "month", "day"]]).to_numpy(dtype="datetime64[D]")
        hour = data["hour"].to_numpy(dtype=np.float64)
        site = Site(
            name=", ".join(header[part] for part in ("city", "state-prov", "country") if header[part].strip(" -")),
            longitude=header["longitude"],
            latitude=header["latitude"],
            altitude=header["altitude"],
            utc_offset=header["TZ"],
        )
    except (KeyError, TypeError, ValueError) as error:
        problem = f"not as the format has it ({' '.join(str(error).split())[:80]})"
        raise InputError(path, "EPW table", None, problem, "take the file from its source again") from error
    rain = np.where(gathered <= 1.0, columns["precipitation_mm_h"], np.nan)
    table = HourlyYear(
        path=path,
        kind=f"EnergyPlus weather file, {header['data_type']}",
        first_line=FIRST_LINE,
        site=site,
        date=date,
        time_of_day=hour * SECONDS_PER_HOUR,
        columns={**columns, "precipitation_mm_h": rain},
        rained=np.nan_to_num(rain) > 0.0,
    )
    return weather_of_year(table, typical_year)


def _column(values: "pd.Series[float]", missing: float) -> FloatArray:
    """Numbers of a column, NaN from the code for missing on."""
    numbers = values.to_numpy(dtype=np.float64)
    return np.where(numbers < missing, numbers, np.nan)
