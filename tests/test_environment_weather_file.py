"""Weather files are read whole and right, or refused in one line."""

import re
from collections.abc import Callable
from datetime import timedelta
from pathlib import Path

import numpy as np
import pytest

from sensorsim.environment import read_weather
from sensorsim.errors import InputError
from sensorsim.resources import assets_folder

WINTER = assets_folder() / "weather" / "winter_1976-02-07.csv"
NAMES = {"winter": "1976-02-07", "summer": "1976-09-03", "fall": "1976-10-07"}


@pytest.mark.parametrize(("name", "day"), NAMES.items())
def test_name_date_and_path_mean_the_same_file(name: str, day: str) -> None:
    by_name = read_weather(name)
    assert by_name.file == read_weather(day).file == read_weather(by_name.file).file
    assert by_name.name == name


def test_units_become_si() -> None:
    weather = read_weather("winter")
    line = next(text for text in WINTER.read_text().splitlines() if text.startswith("1976-02-07T10:00"))
    cells = line.split(",")
    at_ten = int((5 * 24 + 10) * 3600 / (weather.time[1] - weather.time[0]))
    assert weather.air_temperature[at_ten] == pytest.approx(float(cells[1]) + 273.15)
    assert weather.relative_humidity[at_ten] == pytest.approx(float(cells[2]) / 100.0)
    assert weather.start.utcoffset() == timedelta(hours=-5)


def _edited(folder: Path, edit: Callable[[str], str]) -> Path:
    path = folder / "edited.csv"
    path.write_text(edit(WINTER.read_text()))
    return path


def _replace(old: str, new: str) -> Callable[[str], str]:
    def edit(text: str) -> str:
        assert old in text
        return text.replace(old, new)

    return edit


def _without(pattern: str) -> Callable[[str], str]:
    return lambda text: re.sub(pattern, "", text, flags=re.MULTILINE)


def _cell(column: int, value: str) -> Callable[[str], str]:
    def edit(text: str) -> str:
        lines = text.splitlines()
        row = next(i for i, line in enumerate(lines) if line.startswith("1976-02-05T12:00"))
        cells = lines[row].split(",")
        cells[column] = value
        lines[row] = ",".join(cells)
        return "\n".join(lines)

    return edit


LINE_OF_NOON = 1 + next(i for i, text in enumerate(WINTER.read_text().splitlines()) if text.startswith("1976-02-05T12"))

BAD = {
    "missing column": (_replace("cloud_cover_percent", "clouds"), "cloud_cover_percent"),
    "NaN": (_cell(1, "nan"), f"edited.csv:{LINE_OF_NOON}: air_temperature_C = 'nan'"),
    "infinite": (_cell(3, "inf"), f"edited.csv:{LINE_OF_NOON}: wind_speed_m_s = 'inf'"),
    "empty cell": (_cell(3, ""), f"edited.csv:{LINE_OF_NOON}: wind_speed_m_s"),
    "humidity above 100": (_cell(2, "101"), "relative_humidity_percent = '101'"),
    "negative humidity": (_cell(2, "-1"), "relative_humidity_percent = '-1'"),
    "negative wind": (_cell(3, "-0.1"), "wind_speed_m_s = '-0.1'"),
    "cloud above 100": (_cell(5, "120"), "cloud_cover_percent = '120'"),
    "ground": (_cell(7, "frozen"), "ground_state = 'frozen'"),
    "time without offset": (_cell(0, "1976-02-05T12:00:00"), "time = '1976-02-05T12:00:00': no UTC offset"),
    "no time": (_cell(0, "noon"), "time = 'noon'"),
    "time goes back": (_cell(0, "1976-02-05T10:00:00-05:00"), "does not come after the row before"),
    "time stands still": (_cell(0, "1976-02-05T11:00:00-05:00"), "does not come after the row before"),
    "gap": (_without(r"^1976-02-05T12.*\n"), "1976-02-05T13:00:00-05:00"),
    "short row": (_cell(7, "dry,dry"), "9 cells"),
    "no site": (_without(r"^# latitude.*\n"), "latitude_deg"),
    "latitude": (_replace("latitude_deg: 39.82", "latitude_deg: 139.82"), "latitude_deg = '139.82'"),
    "one row": (lambda text: "\n".join(text.splitlines()[: text.count("#") + 2]), "at least two rows"),
    "empty file": (lambda _: "", "missing"),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_file_is_refused_in_one_line_that_names_place_value_and_remedy(case: str, tmp_path: Path) -> None:
    edit, expected = BAD[case]
    with pytest.raises(InputError) as caught:
        read_weather(_edited(tmp_path, edit))
    message = str(caught.value)
    assert expected in message
    assert "edited.csv" in message
    assert "\n" not in message
    assert caught.value.remedy


def test_file_that_is_no_text_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "picture.csv"
    path.write_bytes(b"\xff\xd8\xff\xe0")
    with pytest.raises(InputError, match="UTF-8"):
        read_weather(path)


def test_unknown_name_lists_the_known_ones() -> None:
    with pytest.raises(InputError, match=r"winter.*no such|spring.*no such.*fall.*summer.*winter"):
        read_weather("spring")


def test_offset_of_the_file_does_not_matter(tmp_path: Path) -> None:
    """The same hours written in UTC give the same weather, on the site's own clock."""
    local = read_weather("winter")

    def to_utc(text: str) -> str:
        def shift(match: re.Match[str]) -> str:
            day, hour = int(match[1]), int(match[2]) + 5
            return f"1976-02-{day + hour // 24:02d}T{hour % 24:02d}:00:00Z"

        return re.sub(r"1976-02-(\d\d)T(\d\d):00:00-05:00", shift, text)

    utc = read_weather(_edited(tmp_path, to_utc))
    assert utc.start == local.start
    assert utc.start.utcoffset() == local.start.utcoffset()
    np.testing.assert_array_equal(utc.time, local.time)


def test_other_intervals_than_an_hour_are_read(tmp_path: Path) -> None:
    every_third = read_weather(_edited(tmp_path, _without(r"^1976-\d\d-\d\dT(?:0[124578]|1[0134679]|2[0235689]).*\n")))
    assert every_third.time[1] == 3 * 3600.0
