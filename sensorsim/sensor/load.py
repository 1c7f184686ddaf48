"""Reads sensors from TOML files, those of assets/sensors/ by name.

A key may end in the unit that its number is given in (UNITS); without one it is in SI.
"""

import dataclasses
import tomllib
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from sensorsim.errors import InputError
from sensorsim.radiometry import SpectralBand
from sensorsim.resources import assets_folder
from sensorsim.sensor.detector import Detector
from sensorsim.sensor.display import DisplaySettings
from sensorsim.sensor.intensifier import Intensifier
from sensorsim.sensor.noise import Noise
from sensorsim.sensor.optics import Optics
from sensorsim.sensor.scan import Scan
from sensorsim.sensor.sensor import Sensor

_KINDS: Mapping[type, str] = {
    str: "text",
    float: "a number",
    int: "a whole number",
    bool: "true or false",
    list: "a list of numbers",
    dict: "a table",
}
_SENSOR_KEYS: Mapping[str, type] = {
    "name": str,
    "title": str,
    "mode": str,
    "horizontal_field_of_view": float,
    "source": str,
    "band": dict,
}
_RECORDS: Mapping[str, type] = {
    "optics": Optics,
    "detector": Detector,
    "scan": Scan,
    "noise": Noise,
    "intensifier": Intensifier,
}
_SENSOR_OPTIONS: Mapping[str, type] = {
    "size": list,
    "display": dict,
    "notes": str,
    **dict.fromkeys(_RECORDS, dict),
}
UNITS: Mapping[str, float] = {
    "_um": 1e-6, "_mm": 1e-3, "_us": 1e-6, "_ms": 1e-3, "_urad": 1e-6, "_mrad": 1e-3, "_cm_hz": 1e-2,
}  # fmt: skip
_BAND_KEYS: Mapping[str, type] = {"name": str, "wavelength_um": list, "response": list}
_DISPLAY_OPTIONS: Mapping[str, type] = {
    field.name: str if field.name in ("polarity", "tone") else float for field in dataclasses.fields(DisplaySettings)
}


def sensor_names() -> list[str]:
    """Names of the sensors that come with the package, sorted."""
    return sorted(path.stem for path in (assets_folder() / "sensors").glob("*.toml"))


def load_sensor(name_or_path: str | Path) -> Sensor:
    """Sensor of that name in assets/sensors/, or of a TOML file.

    Raises InputError, naming file, entry, value and remedy, for a file that is missing or no TOML, an unknown or
    missing key, a value of the wrong kind, and everything that Sensor, SpectralBand and DisplaySettings refuse.
    """
    path = _sensor_file(name_or_path)
    try:
        entries = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(path, "file", path.name, f"no TOML ({error})", "mend that place") from error
    except OSError as error:
        raise InputError(path, "file", path.name, f"unreadable ({error.strerror})", "check its permissions") from error
    _check_table(path, "", entries, _SENSOR_KEYS, _SENSOR_OPTIONS)
    plain = {key: value for key, value in entries.items() if key not in ("band", "display", "size", *_RECORDS)}
    if "size" in entries:
        plain["size"] = tuple(entries["size"])
    band = _read_band(path, entries["band"])
    display = _read_display(path, entries.get("display", {}))
    hardware = {name: _read_record(path, name, entries[name]) for name in _RECORDS if name in entries}
    with _errors_name(path, "", entries):
        return Sensor(band=band, display=display, **hardware, **plain)


def _sensor_file(name_or_path: str | Path) -> Path:
    if name_or_path in sensor_names():
        return assets_folder() / "sensors" / f"{name_or_path}.toml"
    path = Path(name_or_path)
    if path.suffix != ".toml" or not path.is_file():
        remedy = f"use {' or '.join(sensor_names())}, or the path of a .toml file"
        raise InputError("sensors", "sensor", str(name_or_path), "unknown", remedy)
    return path


def _read_band(path: Path, entries: dict[str, Any]) -> SpectralBand:
    _check_table(path, "band.", entries, _BAND_KEYS, {})
    wavelength = np.array(entries["wavelength_um"])
    if not ((wavelength >= 0.1) & (wavelength <= 1000.0)).all():
        remedy = "give wavelengths in micrometres"
        raise InputError(path, "band.wavelength_um", entries["wavelength_um"], "not within 0.1 to 1000 um", remedy)
    with _errors_name(path, "band.", entries):
        return SpectralBand(name=entries["name"], wavelength=wavelength * 1e-6, response=np.array(entries["response"]))


def _read_display(path: Path, entries: dict[str, Any]) -> DisplaySettings:
    _check_table(path, "display.", entries, {}, _DISPLAY_OPTIONS)
    with _errors_name(path, "display.", entries):
        return DisplaySettings(**entries)


def _read_record(path: Path, name: str, entries: dict[str, Any]) -> Any:
    """One table of hardware, its numbers in SI."""
    fields = {field.name: field for field in dataclasses.fields(_RECORDS[name])}
    kinds: dict[str, type] = {}
    plain, keys = {}, {}
    for key, value in entries.items():
        unit = next((unit for unit in UNITS if key.endswith(unit) and key.removesuffix(unit) in fields), "")
        entry = key.removesuffix(unit)
        if entry in fields:
            kinds[key] = _kind_of(fields[entry].type)
            plain[entry], keys[entry] = value * UNITS[unit] if unit and _is_kind(value, float) else value, key
    required = [name for name, field in fields.items() if field.default is dataclasses.MISSING and name not in plain]
    known = {**{name: _kind_of(field.type) for name, field in fields.items()}, **kinds}
    _check_table(path, f"{name}.", entries, {entry: known[entry] for entry in required}, known)
    with _errors_name(path, f"{name}.", {entry: entries[key] for entry, key in keys.items()}):
        return _RECORDS[name](**plain)


def _kind_of(annotation: Any) -> type:
    return annotation if annotation in (float, int, bool) else str


def _check_table(
    path: Path, prefix: str, entries: dict[str, Any], required: Mapping[str, type], optional: Mapping[str, type]
) -> None:
    """Refuses unknown and missing keys and values of the wrong kind."""
    known = {**required, **optional}
    for key, value in entries.items():
        if key not in known:
            raise InputError(path, prefix + key, value, "unknown key", f"use only {', '.join(known)}")
        if not _is_kind(value, known[key]):
            raise InputError(path, prefix + key, value, "of the wrong kind", f"give {_KINDS[known[key]]}")
    for key in required:
        if key not in entries:
            raise InputError(path, prefix + key, None, "missing", f"add {_KINDS[required[key]]}")


def _is_kind(value: object, kind: type) -> bool:
    """Whether a TOML value is text, a number (true and false are none), a list of numbers or a table."""
    if kind is float:
        return type(value) in (int, float)
    if kind is list:
        return isinstance(value, list) and all(_is_kind(item, float) for item in value)
    return type(value) is kind


@contextmanager
def _errors_name(path: Path, prefix: str, entries: dict[str, Any]) -> Iterator[None]:
    """Lets the errors of a record name the file, key and value that it was read from."""
    try:
        yield
    except InputError as error:
        key = {"wavelength": "wavelength_um"}.get(error.entry, error.entry)
        raise InputError(path, prefix + key, entries.get(key), error.problem, error.remedy) from error
