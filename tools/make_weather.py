"""Write the weather files of the three days of [Report1978] section IV into assets/weather/.

The report gives words, not measurements; every number chosen for them is below. Run it again and the files come out
the same, byte for byte:

    python tools/make_weather.py [FOLDER]
"""

import math
import sys
from dataclasses import dataclass
from datetime import date, datetime, timedelta, timezone
from pathlib import Path

UTC_OFFSET_HOURS = -5.0
LEAD_IN_DAYS = 5
WARMEST_HOUR = 15.0  # of the day, local standard time
COOLING_SHAPE = 0.8  # below 1: the air cools faster in the evening than before dawn

HEADER = """\
# site: Fairborn, Ohio
# longitude_deg: -84.02
# latitude_deg: 39.82
# altitude_m: 255
# utc_offset_h: -5
# note: Reconstruction from the words of [Report1978] section IV, not a measurement. Made by tools/make_weather.py.
# note: Times are Eastern Standard Time all year. Ohio's clocks were an hour ahead in summer; that is not used here.
# note: Where table 1 and sections 4.1 to 4.3 of the report disagree, the text of the sections is followed.
"""
COLUMNS = (
    "time,air_temperature_C,relative_humidity_percent,wind_speed_m_s,wind_direction_deg,"
    "cloud_cover_percent,precipitation_mm_h,ground_state"
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Day:
    """A kind of day: the image day itself and, with small offsets, the days before it."""

    name: str
    image_day: date
    sunrise: float  # [h] local standard time, when the air is coldest
    coldest: float  # [C]
    at_ten: float  # [C] at 10 h; the warmest follows
    dew_point: float  # [C] all day
    wind_by_night: float  # [m/s]
    wind_by_day: float  # [m/s]
    wind_from: float  # [deg]
    cloud: tuple[int, ...]  # [percent] day by day, the image day last
    warmer: tuple[float, ...]  # [K] against the image day, day by day
    notes: tuple[str, ...]


DAYS = (
    Day(
        name="winter",
        image_day=date(1976, 2, 7),
        sunrise=7.65,
        coldest=3.0,
        at_ten=4.0,
        dew_point=-4.0,
        wind_by_night=5.0,
        wind_by_day=7.0,
        wind_from=240.0,
        cloud=(10, 0, 20, 5, 0, 0),
        warmer=(0.5, -0.8, 0.4, 0.8, -0.4, 0.0),
        notes=(
            "The report: clear, cold, windy; air near 40 F (4.4 C).",
            "Chosen: 3.0 C at sunrise, 4.0 C at 10 h, 7.3 C at 15 h; dew point -4 C; wind 5 to 7 m/s from the WSW.",
            "Why WSW: no direction is given. The prevailing wind of the region lets the south and west walls of the",
            "heating plant change places by 17 h, as the report has it; under a WNW wind they only draw level.",
            "Chosen: no cloud on the image day, 0 to 20 % before; dry ground, no precipitation.",
        ),
    ),
    Day(
        name="summer",
        image_day=date(1976, 9, 3),
        sunrise=6.1,
        coldest=14.5,
        at_ten=18.3,
        dew_point=13.5,
        wind_by_night=0.5,
        wind_by_day=1.0,
        wind_from=200.0,
        cloud=(85, 90, 95, 85, 90, 90),
        warmer=(0.3, -0.5, 0.5, -0.3, 0.2, 0.0),
        notes=(
            "The report: hot, overcast, still; about 65 F (18.3 C) at 10 h.",
            "The report names 2 September once and 3 September twice: the 3rd is used.",
            "Chosen: 14.5 C at sunrise, 18.3 C at 10 h, 23.9 C at 15 h; dew point 13.5 C; wind 0.5 to 1 m/s, SSW.",
            "Chosen: 90 % cloud, 85 to 95 % before; dry ground, no precipitation.",
            "Why 90 %: the report has summer warmest of the three and, in near infrared, darker than winter. Denser",
            "cover leaves the scene colder than on the fall day, thinner cover makes it brighter than in winter.",
        ),
    ),
    Day(
        name="fall",
        image_day=date(1976, 10, 7),
        sunrise=6.6,
        coldest=10.0,
        at_ten=14.0,
        dew_point=8.0,
        wind_by_night=0.5,
        wind_by_day=1.0,
        wind_from=190.0,
        cloud=(45, 55, 50, 65, 60, 60),
        warmer=(-0.4, 0.3, 0.6, -0.3, 0.2, 0.0),
        notes=(
            "The report: mild, relatively clear to partly cloudy, still; air slightly cooler than on the summer day.",
            "Chosen: 10.0 C at sunrise, 14.0 C (57 F) at 10 h, 21.3 C at 15 h; dew point 8 C; wind 0.5 to 1 m/s, S.",
            "Chosen: 60 % cloud, 45 to 65 % before; dry ground, no precipitation.",
            "Why: the sections call the day relatively clear, partly cloudy and warm, its air slightly below summer's;",
            "table 1 calls it cloudy and cool. With more sun or warmer air the ground would be warmer than in summer,",
            "which the report has warmest.",
        ),
    ),
)


def warmth(day: Day, hour: float) -> float:
    """Place between the coldest (0) and the warmest (1) of the day at an hour of it."""
    if day.sunrise <= hour <= WARMEST_HOUR:
        return 0.5 - 0.5 * math.cos(math.pi * (hour - day.sunrise) / (WARMEST_HOUR - day.sunrise))
    passed = (hour - WARMEST_HOUR) % 24.0 / (24.0 + day.sunrise - WARMEST_HOUR)
    return 0.5 + 0.5 * math.cos(math.pi * passed**COOLING_SHAPE)


def by_day(values: tuple[float, ...], hours: float) -> float:
    """Value that each day has at noon, joined by straight lines; `hours` since the first midnight."""
    place = min(max((hours - 12.0) / 24.0, 0.0), len(values) - 1.0)
    low = min(int(place), len(values) - 2)
    return values[low] + (place - low) * (values[low + 1] - values[low])


def saturation(celsius: float) -> float:
    """Saturation vapour pressure over water [hPa], Magnus form of [Alduchov1996]."""
    return 6.1094 * math.exp(17.625 * celsius / (celsius + 243.04))


def row(day: Day, hours: int) -> str:
    """One line of the file, `hours` since the first midnight."""
    start = datetime.combine(day.image_day, datetime.min.time(), timezone(timedelta(hours=UTC_OFFSET_HOURS)))
    now = start + timedelta(hours=hours - 24 * LEAD_IN_DAYS)
    level = warmth(day, hours % 24)
    range_ = (day.at_ten - day.coldest) / warmth(day, 10.0)
    air = round(day.coldest + range_ * level + by_day(day.warmer, hours), 1)
    humidity = 100.0 * min(saturation(day.dew_point) / saturation(air), 1.0)
    wind = day.wind_by_night + (day.wind_by_day - day.wind_by_night) * level
    veer = day.wind_from + 10.0 * math.sin(2.0 * math.pi * hours / 30.0)
    cloud = by_day(tuple(map(float, day.cloud)), hours)
    return f"{now.isoformat()},{air:.1f},{humidity:.0f},{wind:.1f},{veer:.0f},{cloud:.0f},0.0,dry"


def text(day: Day) -> str:
    """The whole file: header, columns and an hour a row from the first lead-in midnight to an hour past the last."""
    notes = "".join(f"# note: {note}\n" for note in day.notes)
    rows = [row(day, hours) for hours in range(24 * (LEAD_IN_DAYS + 1) + 2)]
    return HEADER + notes + "\n".join([COLUMNS, *rows]) + "\n"


def main(folder: Path) -> None:
    for day in DAYS:
        path = folder / f"{day.name}_{day.image_day.isoformat()}.csv"
        path.write_text(text(day), encoding="utf-8")
        print(path)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent / "assets" / "weather")
