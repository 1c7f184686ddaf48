"""Reading weather, whatever the kind of file: a station's CSV, an EnergyPlus weather file (EPW), a TMY3 file.

The kind is told from the file's first lines, not from its name.
"""

from pathlib import Path

from sensorsim.environment.epw_file import is_epw, read_epw
from sensorsim.environment.station_file import read_station
from sensorsim.environment.tmy3_file import is_tmy3, read_tmy3
from sensorsim.environment.weather import Weather
from sensorsim.errors import InputError
from sensorsim.resources import assets_folder


def read_weather(name_or_path: str | Path, *, typical_year: bool | None = None) -> Weather:
    """Read the weather of one file.

    Parameters
    ----------
    name_or_path : 'winter', 'summer', 'fall', or the ISO date of one of the three days, or the path of a file
    typical_year : of an EPW or TMY3 file: True if only its months and days count and it stands for any year, False if
        it is the weather of its own dates; None lets the file tell, by months from one year or from several

    Raises
    ------
    InputError : no such file; a missing column; a value that is missing, no number, not finite or out of range; a
        time without UTC offset; times that do not ascend in equal steps; a clock that cannot be that of the place.
    """
    path = _find(name_or_path)
    text = _text(path)
    if is_epw(text):
        return read_epw(path, text, typical_year)
    if is_tmy3(text):
        return read_tmy3(path, text, typical_year)
    if typical_year is not None:
        problem = "neither EPW nor TMY3: its times carry their own years"
        raise InputError(path, "typical_year", typical_year, problem, "leave it out")
    return read_station(path, text)


def _find(name_or_path: str | Path) -> Path:
    folder = assets_folder() / "weather"
    shipped = {part: path for path in sorted(folder.glob("*_*.csv")) for part in path.stem.split("_", 1)}
    path = shipped.get(str(name_or_path), Path(name_or_path))
    if not path.is_file():
        names = ", ".join(shipped)
        remedy = f"give a file (CSV, EPW or TMY3) or one of {names}"
        raise InputError("weather", "name", str(name_or_path), "no such file or name", remedy)
    return path


def _text(path: Path) -> str:
    """Text of a file; EPW and TMY3 name their places in Latin-1 at times."""
    data = path.read_bytes()
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        text = data.decode("latin-1")
        if is_epw(text) or is_tmy3(text):
            return text
        raise InputError(path, "byte", error.start, "not UTF-8 text", "save the file as UTF-8") from None
