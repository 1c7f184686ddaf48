"""One feature's properties, read by name and checked: every refusal names file, feature, property and remedy."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

from sensorsim.errors import InputError
from sensorsim.units import metres_from_feet


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """The properties of one GeoJSON feature, with what an error message needs to name it."""

    file: Path
    label: str  # "feature 24", or "feature at index 3" where it has no number
    properties: Mapping[str, object]

    def refuse(self, name: str, value: object, problem: str, remedy: str) -> NoReturn:
        """Raise the InputError for one property."""
        raise InputError(self.file, f"{self.label}: {name}", value, problem, remedy)

    def has(self, name: str) -> bool:
        """Whether the property is there and not null."""
        return self.properties.get(name) is not None

    def real(self, name: str) -> float | None:
        """A finite number, None where absent or null; digits in quotes count, as OpenStreetMap exports have them."""
        value = self.properties.get(name)
        if value is None:
            return None
        try:
            number = math.nan if isinstance(value, bool) else float(value)  # type: ignore[arg-type]
        except (TypeError, ValueError, OverflowError):
            number = math.nan
        if not math.isfinite(number):
            self.refuse(name, value, "not a finite number", "write a plain number")
        return number

    def percent(self, name: str) -> float | None:
        """A number from 0 to 100, None where absent or null."""
        value = self.real(name)
        if value is not None and not 0.0 <= value <= 100.0:
            self.refuse(name, value, "not a percentage", "write a number from 0 to 100")
        return value

    def whole(self, name: str) -> int | None:
        """A whole number, not negative, None where absent or null."""
        value = self.real(name)
        if value is None:
            return None
        if value != int(value) or value < 0:
            self.refuse(name, value, "not a whole number of the sheet's code", "write 0, 1, 2, ... or null")
        return int(value)

    def length(self, *names: str) -> float | None:
        """A length [m] under one of the names, or in feet under one with `_ft` added; None where there is none."""
        given = [(name, unit) for name in names for unit in ("", "_ft") if self.has(name + unit)]
        if len(given) > 1:
            twice = " and ".join(name + unit for name, unit in given)
            self.refuse(twice, [self.properties[name + unit] for name, unit in given], "given twice", "keep one")
        if not given:
            return None
        name, unit = given[0]
        value = self.real(name + unit)
        return metres_from_feet(value) if unit and value is not None else value

    def text(self, name: str) -> str:
        """A text, empty where absent or null."""
        value = self.properties.get(name)
        if value is None:
            return ""
        if not isinstance(value, str):
            self.refuse(name, value, "not a text", "write it in quotes")
        return value

    def flag(self, name: str, default: bool) -> bool:
        """True or false, the default where absent or null."""
        value = self.properties.get(name)
        if value is None:
            return default
        if not isinstance(value, bool):
            self.refuse(name, value, "neither true nor false", "write true or false without quotes")
        return value

    def word(self, name: str) -> str | None:
        """A four-digit material word, None where absent or null."""
        value = self.properties.get(name)
        if value is None:
            return None
        if not (isinstance(value, str) and len(value) == 4 and value.isascii() and value.isdigit()):
            remedy = 'write four digits in quotes, material then percent reflectance, such as "2040"'
            self.refuse(name, value, "not a material word", remedy)
        return value
