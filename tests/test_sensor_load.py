"""Sensor files: those of the package, and refusals that name file, entry, value and remedy in one line."""

import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.radiometry import FLIR_BAND, LLLTV_BAND
from sensorsim.sensor import DisplaySettings, Sensor, load_sensor, sensor_names

SENSOR = {
    "name": '"probe"',
    "title": '"Probe, 8-12 um"',
    "mode": '"emissive"',
    "horizontal_field_of_view": "40",
    "source": '"estimate: a test"',
}
BAND = {"name": '"probe"', "wavelength_um": "[8, 10.5, 12]", "response": "[0, 1, 0.5]"}


def write_sensor(folder, *, sensor=None, band=None, **others):
    tables = {"": {**SENSOR, **(sensor or {})}, "band": {**BAND, **(band or {})}, "display": {}, **others}
    lines = []
    for table, entries in tables.items():
        if table:
            lines.append(f"[{table}]")
        lines += [f"{key} = {value}" for key, value in entries.items() if value is not None]
    path = folder / "probe.toml"
    path.write_text("\n".join(lines), encoding="utf-8")
    return path


def test_package_has_both_sensors_of_the_report_and_five_with_hardware():
    assert sensor_names() == ["cooled_mwir", "emccd", "flir", "flir1977", "lltv", "sit1977", "uncooled"]
    assert [name for name in sensor_names() if load_sensor(name).detector is None] == ["flir", "lltv"]


@pytest.mark.parametrize(
    ("name", "mode", "band"), [("flir", "emissive", FLIR_BAND), ("lltv", "reflective", LLLTV_BAND)]
)
def test_sensor_of_the_package_sees_the_band_of_the_report(name, mode, band):
    sensor = load_sensor(name)
    assert (sensor.name, sensor.mode, sensor.size) == (name, mode, (640, 480))
    assert sensor.band.name == band.name
    assert sensor.band.wavelength == pytest.approx(band.wavelength, rel=1e-12)
    assert sensor.band.response.tolist() == band.response.tolist()
    limits = "-".join(f"{wavelength * 1e6:g}" for wavelength in band.wavelength)
    assert f"{limits} um" in sensor.title
    assert "Report1978" in sensor.source


def test_file_becomes_a_sensor_in_si(tmp_path):
    display = {"polarity": '"black-hot"', "level": "45", "span": "10.0"}
    sensor = load_sensor(write_sensor(tmp_path, sensor={"size": "[320, 240]"}, display=display))
    assert sensor.band.wavelength == pytest.approx([8e-6, 10.5e-6, 12e-6], rel=1e-12)
    assert sensor.band.response.tolist() == [0.0, 1.0, 0.5]
    assert (sensor.size, sensor.horizontal_field_of_view) == ((320, 240), 40)
    assert sensor.display == DisplaySettings(polarity="black-hot", level=45.0, span=10.0)


def test_size_and_display_may_be_left_out(tmp_path):
    sensor = load_sensor(str(write_sensor(tmp_path)))
    assert (sensor.size, sensor.display, sensor.notes) == ((640, 480), DisplaySettings(), "")


@pytest.mark.parametrize(
    ("where", "key", "value", "said"),
    [
        ("sensor", "aperture", "0.1", "aperture = 0.1: unknown key; use only name, title"),
        ("sensor", "mode", '"thermal"', "mode = 'thermal': unknown; use emissive or reflective"),
        ("sensor", "mode", None, "mode = None: missing; add text"),
        ("sensor", "title", "3", "title = 3: of the wrong kind; give text"),
        ("sensor", "horizontal_field_of_view", "0", r"horizontal_field_of_view = 0: outside \(0, 170\) deg"),
        ("sensor", "horizontal_field_of_view", "170.0", r"outside \(0, 170\) deg"),
        ("sensor", "horizontal_field_of_view", "nan", r"outside \(0, 170\) deg"),
        ("sensor", "horizontal_field_of_view", "true", "of the wrong kind; give a number"),
        ("sensor", "size", "[0, 480]", r"size = \[0, 480\]: not two counts of at least 1"),
        ("sensor", "size", "[640]", "not two counts"),
        ("sensor", "size", "[640.5, 480]", "not two counts"),
        ("band", "wavelength_um", "[12, 10.5, 8]", r"band.wavelength_um = \[12, 10.5, 8\]: does not increase"),
        ("band", "wavelength_um", "[8e-6, 1e-5, 12e-6]", "give wavelengths in micrometres"),
        ("band", "wavelength_um", "[8, nan, 12]", "give wavelengths in micrometres"),
        ("band", "wavelength_um", '["8", "9", "12"]', "give a list of numbers"),
        ("band", "wavelength_um", "[]", r"band.wavelength_um = \[\]: fewer than two points"),
        ("band", "response", "[0, 0, 0]", r"band.response = .*zero everywhere"),
        ("band", "response", "[0, 1]", "has 2 values for 3 wavelengths"),
        ("band", "response", "[0, 80, 40]", "divide it by its peak"),
        ("band", "response", None, "band.response = None: missing"),
        ("band", "gain", "2", "band.gain = 2: unknown key"),
        ("display", "polarity", '"hot"', "display.polarity = 'hot': unknown; use white-hot or black-hot"),
        ("display", "span", "0.0", "display.span = 0.0: not finite and above zero"),
        ("display", "detail", "-1", "display.detail = -1: outside of 0 to 20"),
        ("display", "tail", "0.5", "display.tail = 0.5: outside of 0 to 0.49"),
        ("display", "settle", "nan", "display.settle = nan: outside of 0 to 60"),
        ("noise", "replaced", "1", "noise.replaced = 1: of the wrong kind; give true or false"),
        ("noise", "dead", "0.6", r"noise.dead = 0.6: not 0 to 0.5"),
        ("scan", "lines", "100", "scan.pattern = .*has no channels, lines or electronics"),
        ("scan", "lines", "1.5", "scan.lines = 1.5: of the wrong kind; give a whole number"),
        ("scan", "interlace", "0", "scan.interlace = 0: not 1 to 8"),
        ("display", "gain", "2", "display.gain = 2: unknown key; use only polarity, level, span"),
    ],
)
def test_bad_entry_is_refused_in_one_line(tmp_path, where, key, value, said):
    path = write_sensor(tmp_path, **{where: {key: value}})
    with pytest.raises(InputError, match=said) as caught:
        load_sensor(path)
    assert str(caught.value).startswith(f"{path}: ")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("content", [b"name = ", b"\xff\xfe"])
def test_file_that_is_no_toml_is_refused(tmp_path, content):
    path = tmp_path / "broken.toml"
    path.write_bytes(content)
    with pytest.raises(InputError, match="no TOML"):
        load_sensor(path)


@pytest.mark.parametrize("name", ["radar", "missing.toml", "", "../sensors/flir"])
def test_unknown_sensor_is_refused_with_the_known_ones(name):
    with pytest.raises(InputError, match=r"use cooled_mwir or .*flir or .*lltv .*or the path of a"):
        load_sensor(name)


def test_numpy_size_is_refused_where_json_could_not_hold_it():
    with pytest.raises(InputError, match="size"):
        Sensor(
            name="probe",
            title="probe",
            mode="emissive",
            band=FLIR_BAND,
            horizontal_field_of_view=40.0,
            size=(np.int64(640), np.int64(480)),
        )
