"""TOML tables read with complaints that name file, entry, value and remedy."""

import math
import tomllib
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sensorsim.errors import InputError

UNSOURCED = "unsourced"


@dataclass(frozen=True, slots=True, kw_only=True)
class Quantity:
    """A number with where it comes from."""

    value: float
    source: str  # "Key locator; Key locator" with keys of references.bib, "estimate: why", or "unsourced"


@dataclass(frozen=True, slots=True, kw_only=True)
class Choice:
    """One word of a closed list with where it comes from."""

    value: str
    source: str  # as in `Quantity`


@dataclass(frozen=True, slots=True, kw_only=True)
class Bounds:
    """What a number may be, in numbers and in words."""

    low: float
    high: float
    open_low: bool  # True where `low` itself is refused
    text: str

    def hold(self, value: float) -> bool:
        """Whether `value` lies inside; NaN never does."""
        return (
            math.isfinite(value) and value <= self.high and (value > self.low if self.open_low else value >= self.low)
        )


POSITIVE = Bounds(low=0.0, high=math.inf, open_low=True, text="a number above 0")
NOT_NEGATIVE = Bounds(low=0.0, high=math.inf, open_low=False, text="a number of 0 or more")
SHARE = Bounds(low=0.0, high=1.0, open_low=True, text="a number above 0, up to 1")
FRACTION = Bounds(low=0.0, high=1.0, open_low=False, text="a number from 0 to 1")


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """One TOML table, with the words needed to complain about it."""

    where: Path
    name: str
    table: Mapping[str, Any]

    def error(self, key: str, problem: str, remedy: str, value: object = None) -> InputError:
        """Complaint about `key`; `value` defaults to what the file holds there."""
        held = self.table.get(key) if value is None else value
        return InputError(self.where, f"{self.name} {key}".strip(), held, problem, remedy)

    def refuse_unknown(self, known: Collection[str]) -> None:
        """Raise InputError at the first key that is not in `known`, so that a misspelt one is not passed over."""
        for key in self.table:
            if key not in known:
                raise self.error(key, "unknown key", f"use one of {', '.join(known)}")

    def text(self, key: str) -> str:
        """Non-empty text under `key`; InputError where it is missing or something else."""
        value = self.table.get(key)
        if not isinstance(value, str) or not value.strip():
            raise self.error(key, "missing or not a text", f'write {key} = "..."')
        return value

    def source(self) -> str:
        """The table's own `source` or `estimate`, as one text in the manner of `Quantity.source`."""
        has_source, has_estimate = "source" in self.table, "estimate" in self.table
        if has_source and has_estimate:
            raise self.error("source", "both source and estimate given", "keep one of them")
        if has_estimate:
            return f"estimate: {self.text('estimate')}"
        return self.text("source") if has_source else UNSOURCED

    def sourced(self, key: str) -> tuple[Any, str]:
        """Value and source under `key`, from a plain value or from { value = .., source | estimate = ".." }."""
        if key not in self.table:
            raise self.error(key, "missing", f"add {key}")
        held = self.table[key]
        if not isinstance(held, Mapping):
            return held, UNSOURCED
        inner = Entry(where=self.where, name=f"{self.name} {key}", table=held)
        inner.refuse_unknown(("value", "source", "estimate"))
        if "value" not in held:
            raise inner.error("value", "missing", 'write { value = .., source = ".." }')
        return held["value"], inner.source()

    def quantity(self, key: str, bounds: Bounds) -> Quantity:
        """Number under `key` inside `bounds`; InputError where it is missing, no number, NaN, infinite or outside."""
        value, source = self.sourced(key)
        if isinstance(value, bool) or not isinstance(value, int | float) or not bounds.hold(value):
            raise self.error(key, f"not {bounds.text}", "correct the number (SI units)", value)
        return Quantity(value=float(value), source=source)

    def choice(self, key: str, allowed: Collection[str]) -> Choice:
        """Word under `key`; InputError unless it is one of `allowed`."""
        value, source = self.sourced(key)
        if value not in allowed:
            raise self.error(key, "not a word of the list", f"use one of {', '.join(allowed)}", value)
        return Choice(value=value, source=source)

    def entries(self, key: str, name: str) -> tuple["Entry", ...]:
        """The tables of the list under `key`, named `name` 1, 2, ...; empty where the key is absent."""
        held = self.table.get(key, [])
        if not isinstance(held, list) or not all(isinstance(table, Mapping) for table in held):
            raise self.error(key, "not a list of tables", f"write [[{key}]] entries")
        prefix = f"{self.name} {name}".strip()
        return tuple(Entry(where=self.where, name=f"{prefix} {n}", table=table) for n, table in enumerate(held, 1))


def read_toml(path: Path) -> Entry:
    """The whole file as one nameless entry; InputError where it is missing, unreadable or no TOML."""
    try:
        with path.open("rb") as file:
            return Entry(where=path, name="", table=tomllib.load(file))
    except OSError as error:
        raise InputError(path, "file", path.name, error.strerror or "cannot be read", "name a TOML file") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        problem = " ".join(str(error).split())
        raise InputError(path, "file", path.name, f"no valid TOML: {problem}", "correct that line") from error
