"""Codes and words of the report's figure 10 that need a reading, each with its reason."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from sensorsim.materials.code import parse_word
from sensorsim.materials.entry import Entry, read_toml
from sensorsim.materials.material import Material


@dataclass(frozen=True, slots=True, kw_only=True)
class Reading:
    """A code that figure 9 does not list, the code it is taken for, and why."""

    code: int
    means: int
    words: tuple[str, ...]  # of figure 10 in which the code occurs
    reason: str


def _words(entry: Entry) -> tuple[str, ...]:
    held = entry.table.get("words")
    if not isinstance(held, list) or not held:
        raise entry.error("words", "missing or empty", 'write words = ["3430"]')
    for word in held:
        parse_word(word, where=entry.where)
    return tuple(held)


def _code(entry: Entry, key: str) -> int:
    code = entry.table.get(key)
    if isinstance(code, bool) or not isinstance(code, int) or not 0 <= code <= 99:
        raise entry.error(key, "not a whole number from 0 to 99", "give the two digits of a material word")
    return code


def _read_reading(entry: Entry, materials: Mapping[int, Material]) -> Reading:
    entry.refuse_unknown(("code", "means", "words", "reason"))
    code, means, words = _code(entry, "code"), _code(entry, "means"), _words(entry)
    if code in materials:
        raise entry.error("code", f"is {materials[code].name} in {materials[code].file}", "delete this reading")
    if means not in materials:
        raise entry.error("means", "not a code of the catalogue", "name a material that exists")
    for word in words:
        if parse_word(word).code != code:
            raise entry.error("words", f"'{word}' does not begin with {code:02d}", "list only words of this code")
    return Reading(code=code, means=means, words=words, reason=entry.text("reason"))


def read_readings(path: Path, materials: Mapping[int, Material]) -> tuple[Mapping[int, Reading], Mapping[str, str]]:
    """Readings by code, and notes by word (the reasons of the readings, and words taken as they are written)."""
    whole = read_toml(path)
    whole.refuse_unknown(("reading", "note"))
    readings: dict[int, Reading] = {}
    notes: dict[str, str] = {}
    for entry in whole.entries("reading", "reading"):
        reading = _read_reading(entry, materials)
        if reading.code in readings:
            raise entry.error("code", "read twice", "keep one reading of this code")
        readings[reading.code] = reading
        notes.update(dict.fromkeys(reading.words, reading.reason))
    for entry in whole.entries("note", "note"):
        entry.refuse_unknown(("words", "text"))
        notes.update(dict.fromkeys(_words(entry), entry.text("text")))
    return readings, notes
