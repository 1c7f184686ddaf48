"""EPW and TMY3 files: hours, years, places and missing values end up where they belong, or are refused."""

import re
from collections.abc import Callable
from datetime import date, datetime, timedelta
from pathlib import Path

import numpy as np
import pytest
from year_files import SITE, clear_means, days_of, epw_text, temperature_of, tmy3_text, written

from sensorsim.environment import Environment, Weather, build_environment, read_weather
from sensorsim.errors import InputError
from sensorsim.units import kelvin_from_celsius

YEARS = (1986, 1979, 2002, 1976, 1999, 1980, 1987, 1985, 1978, 1981, 1977, 2004)  # two of them leap years
KINDS: dict[str, Callable[..., str]] = {"year.epw": epw_text, "year.csv": tmy3_text}


@pytest.fixture(scope="module", params=list(KINDS))
def typical(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Weather:
    text = KINDS[request.param](days_of(2001), YEARS)
    return read_weather(written(tmp_path_factory.mktemp("typical"), request.param, text))


def _celsius(environment: Environment, time_of_day: float) -> float:
    return environment.at(time_of_day).air_temperature - kelvin_from_celsius(0.0)


def test_place_clock_and_altitude_come_from_the_header(typical: Weather) -> None:
    for entry in ("longitude", "latitude", "altitude", "utc_offset"):
        assert getattr(typical.site, entry) == getattr(SITE, entry)
    assert typical.site.name.lower().startswith("testville, oh")
    assert typical.start.utcoffset() == timedelta(hours=-5)


def test_months_of_different_years_make_a_typical_year(typical: Weather) -> None:
    assert typical.typical_year
    assert typical.time.size == 8760
    assert "1976" in typical.notes[0]
    assert "typical year" in typical.notes[0]


@pytest.mark.parametrize("day", [date(1976, 2, 7), date(2024, 3, 1), date(2023, 1, 2), date(1999, 12, 31)])
def test_image_day_of_any_year_finds_its_month_and_day(typical: Weather, day: date) -> None:
    environment = build_environment(typical, image_day=day)
    assert environment.image_start.date() == day
    for hour in (1, 10, 24):
        assert _celsius(environment, hour * 3600.0) == pytest.approx(temperature_of(day, hour), abs=1e-9)
    half = (temperature_of(day, 10) + temperature_of(day, 11)) / 2.0
    assert _celsius(environment, 10.5 * 3600.0) == pytest.approx(half, abs=1e-9)


def test_values_at_the_stamp_hold_at_the_end_of_the_hour_and_wind_turns_with_it(typical: Weather) -> None:
    environment = build_environment(typical, image_day=date(1976, 2, 7))
    at_ten = environment.image_window.start + 120
    assert environment.wind_direction[at_ten] == pytest.approx(100.0)
    assert environment.cloud_cover[at_ten] == pytest.approx(0.4)
    assert environment.wind_speed[at_ten] == pytest.approx(3.5)


@pytest.mark.parametrize("image_day", [date(2023, 1, 2), date(2024, 3, 1)])
def test_lead_in_runs_back_over_new_year_and_over_the_missing_leap_day(typical: Weather, image_day: date) -> None:
    environment = build_environment(typical, image_day=image_day)
    found = environment.air_temperature[::288] - kelvin_from_celsius(0.0)  # midnights: the 24th hour of the day before
    days = {1: [(12, 29), (12, 30), (12, 31), (1, 1), (1, 2)], 3: [(2, 25), (2, 26), (2, 27), (2, 28), (3, 1)]}
    expected = [temperature_of(date(2001, *day), 24) for day in days[image_day.month]]
    np.testing.assert_allclose(found, expected, atol=1e-9)


def test_leap_day_of_a_typical_year_is_refused(typical: Weather) -> None:
    with pytest.raises(InputError, match="no leap day; take 28 February or 1 March"):
        build_environment(typical, image_day=date(2024, 2, 29))


def test_sunlight_is_that_of_the_hour_before_the_stamp(typical: Weather) -> None:
    """Hour means of 0.8 of a clear sky come back as 0.8 of the clear sky at every moment: an hour's shift would not."""
    day = date(2001, 2, 7)
    environment = build_environment(typical, image_day=day, lead_in_days=1, step=60.0)
    window = environment.image_window
    beam, diffuse = clear_means((day,))
    for found, expected in ((environment.beam_irradiance, beam), (environment.diffuse_irradiance, diffuse)):
        middle = (found[window][1:] + found[window][:-1]) / 2.0
        np.testing.assert_allclose(middle.reshape(24, 60).mean(axis=-1), 0.8 * expected[0], atol=1.0)
    lit = environment.sun_elevation[window] > 0.0
    assert (environment.beam_irradiance[window][~lit] == 0.0).all()
    assert (environment.beam_irradiance[window][lit] > 0.0).all()


def test_sky_infrared_is_used_where_the_file_has_it(tmp_path: Path) -> None:
    weather = read_weather(written(tmp_path, "year.epw", epw_text(days_of(2001), YEARS)))
    environment = build_environment(weather, image_day=date(1976, 2, 7), lead_in_days=1)
    np.testing.assert_allclose(environment.sky_temperature, (202.0 / 5.670374419e-8) ** 0.25, rtol=1e-9)
    assert read_weather(written(tmp_path, "year.csv", tmy3_text(days_of(2001)))).sky_infrared is None


def test_snow_rain_and_what_stays_wet(tmp_path: Path) -> None:
    """Rain of the tenth hour falls from 9 to 10 h; the ground stays wet for three hours more."""
    weather = read_weather(written(tmp_path, "year.epw", epw_text(days_of(2001), YEARS)))
    january = build_environment(weather, image_day=date(1976, 1, 20), lead_in_days=0)
    assert (january.ground_state == "snow").all()
    february = build_environment(weather, image_day=date(1976, 2, 6), lead_in_days=0)
    rain = [february.at(hour * 3600.0).precipitation for hour in (8.9, 9.0, 9.9, 10.0)]
    assert rain == [0.0, 2.0, 2.0, 0.0]
    state = [february.at(hour * 3600.0).ground_state for hour in (9.9, 10.0, 13.9, 14.0)]
    assert state == ["dry", "wet", "wet", "dry"]
    tmy3 = read_weather(written(tmp_path, "year.csv", tmy3_text(days_of(2001), YEARS)))
    assert np.count_nonzero(tmy3.ground_state == "wet") == 4
    assert (tmy3.precipitation == 0.0).all()
    assert any("Precipitation" in note for note in tmy3.notes)


@pytest.mark.parametrize("kind", KINDS)
def test_file_of_one_year_keeps_its_own_dates_unless_told_otherwise(kind: str, tmp_path: Path) -> None:
    path = written(tmp_path, kind, KINDS[kind](days_of(2003)))
    own = read_weather(path)
    assert not own.typical_year
    assert own.start == datetime(2003, 1, 1, 1, tzinfo=SITE.time_zone)
    assert _celsius(build_environment(own, image_day=date(2003, 2, 7)), 36000.0) == pytest.approx(7.021)
    with pytest.raises(InputError, match="the file covers 2003"):
        build_environment(own, image_day=date(1976, 2, 7))
    told = build_environment(read_weather(path, typical_year=True), image_day=date(1976, 2, 7))
    assert _celsius(told, 36000.0) == pytest.approx(7.021)


def test_leap_year_of_its_own_dates_has_its_leap_day(tmp_path: Path) -> None:
    weather = read_weather(written(tmp_path, "leap.epw", epw_text(days_of(2004))))
    environment = build_environment(weather, image_day=date(2004, 2, 29))
    assert _celsius(environment, 36000.0) == pytest.approx(temperature_of(date(2004, 2, 29), 10))
    with pytest.raises(InputError, match="leap day in a typical year"):
        read_weather(weather.file, typical_year=True)


def _line(text: str, number: int, edit: Callable[[str], str]) -> str:
    lines = text.splitlines()
    lines[number - 1] = edit(lines[number - 1])
    return "\n".join(lines) + "\n"


def _cell(column: int, value: str) -> Callable[[str], str]:
    def edit(text: str) -> str:
        def change(line: str) -> str:
            cells = line.split(",")
            cells[column] = value
            return ",".join(cells)

        return _line(text, 200, change)

    return edit


EPW_BAD: dict[str, tuple[Callable[[str], str], str]] = {
    "temperature 99.9": (_cell(6, "99.9"), "bad.epw:200: air_temperature_C = None: missing here"),
    "humidity 999": (_cell(8, "999"), "bad.epw:200: relative_humidity_percent = None: missing here"),
    "wind 999": (_cell(21, "999"), "bad.epw:200: wind_speed_m_s = None: missing here"),
    "direction 999": (_cell(20, "999"), "bad.epw:200: wind_direction_deg = None"),
    "cover 99": (_cell(23, "99"), "bad.epw:200: cloud_cover_percent = None"),
    "direct 9999": (_cell(14, "9999"), "bad.epw:200: direct_normal_W_m2 = None"),
    "infrared 9999": (_cell(12, "9999"), "bad.epw:200: sky_infrared_W_m2 = None"),
    "too hot": (_cell(6, "75"), "bad.epw:200: air_temperature_C = 75.0: out of range"),
    "negative wind": (_cell(21, "-1"), "bad.epw:200: wind_speed_m_s = -1.0: out of range"),
    "no number": (_cell(6, "warm"), "EPW table"),
    "empty cell": (_cell(6, ""), "air_temperature_C = None: missing here"),
    "gap": (lambda text: "\n".join(line for k, line in enumerate(text.splitlines()) if k != 300), "2 h after the row"),
    "twice": (lambda text: _line(text, 200, lambda line: f"{line}\n{line}"), "0 h after the row before"),
    "half a year": (lambda text: "\n".join(text.splitlines()[:4000]), "a typical year has 365"),
    "sign of longitude": (lambda text: text.replace("-84.02", "84.02", 1), "check both signs"),
    "latitude": (lambda text: text.replace("39.82", "139.82", 1), "latitude_deg = 139.82"),
    "header": (lambda text: text.replace("39.82", "north", 1), "EPW table"),
}


@pytest.fixture(scope="module")
def epw() -> str:
    return epw_text(days_of(2001), YEARS)


@pytest.mark.parametrize("case", EPW_BAD)
def test_bad_epw_is_refused_in_one_line(case: str, epw: str, tmp_path: Path) -> None:
    edit, expected = EPW_BAD[case]
    path = written(tmp_path, "bad.epw", edit(epw))
    with pytest.raises(InputError) as caught:
        read_weather(path)
    message = str(caught.value)
    assert expected in message
    assert str(path) in message
    assert "\n" not in message
    assert caught.value.remedy


def test_missing_rain_and_snow_count_as_none_and_a_note_says_so(epw: str, tmp_path: Path) -> None:
    text = re.sub(r",(\d+),88,0\.2,[\d.]+,1\.0$", ",999,88,0.2,999.0,99.0", epw, flags=re.MULTILINE)
    weather = read_weather(written(tmp_path, "dry.epw", text))
    assert (weather.ground_state == "dry").all()
    assert (weather.precipitation == 0.0).all()
    assert any("missing in 8760 of 8760" in note for note in weather.notes)


def test_sum_of_six_hours_is_not_the_rain_of_one(epw: str, tmp_path: Path) -> None:
    weather = read_weather(written(tmp_path, "six.epw", epw.replace(",0.2,2.0,1.0", ",0.2,2.0,6.0")))
    assert (weather.precipitation == 0.0).all()


def test_file_without_radiation_leaves_it_to_the_model(epw: str, tmp_path: Path) -> None:
    def dark(match: re.Match[str]) -> str:
        cells = match[0].split(",")
        cells[12:16] = ["9999", "9999", "9999", "9999"]
        return ",".join(cells)

    path = written(tmp_path, "dark.epw", re.sub(r"^\d{4},.*$", dark, epw, flags=re.MULTILINE))
    weather = read_weather(path)
    assert weather.direct_normal is None
    assert weather.sky_infrared is None
    assert any("modelled" in note and "direct_normal" in note for note in weather.notes)
    environment = build_environment(weather, image_day=date(1976, 2, 7))
    assert environment.beam_irradiance.max() > 300.0


def test_tmy3_missing_value_is_refused(tmp_path: Path) -> None:
    text = _cell(7, "-9900")(tmy3_text(days_of(2001)))
    with pytest.raises(InputError, match=r"bad\.csv:200: air_temperature_C = None: missing here"):
        read_weather(written(tmp_path, "bad.csv", text))


def test_opaque_cover_gives_way_to_the_total_one_only_where_all_of_it_is_missing(tmp_path: Path) -> None:
    text = tmy3_text(days_of(2001)).replace(",9,4,", ",9,-9900,")
    weather = read_weather(written(tmp_path, "cover.csv", text))
    np.testing.assert_allclose(weather.cloud_cover, 0.9)
    assert any("total" in note for note in weather.notes)


def test_name_in_latin_script_is_read(tmp_path: Path) -> None:
    path = tmp_path / "latin.epw"
    path.write_bytes(epw_text(days_of(2001)[:3]).replace("Testville", "Montréal").encode("latin-1"))
    assert read_weather(path).site.name.startswith("Montréal")


def test_typical_year_is_no_matter_of_a_station_file() -> None:
    with pytest.raises(InputError, match="neither EPW nor TMY3"):
        read_weather("winter", typical_year=True)
