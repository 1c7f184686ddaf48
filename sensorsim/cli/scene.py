"""`sensorsim scene`: the audit of a scene's data base."""

import json

import numpy as np
from rich.console import Console
from rich.table import Table

from sensorsim.cli.options import AnyLevel, AsJson, SceneName, read_scene
from sensorsim.materials import load_catalogue
from sensorsim.scene import Audit, audit_scene
from sensorsim.scene.audit import LevelKin
from sensorsim.tables import resolve_classes
from sensorsim.tables.assign import resolve_surface_word


def scene(name: SceneName, level: AnyLevel = "IIIB", as_json: AsJson = False) -> None:
    """Print a scene's counts, its materials, and missing or ambiguous words with the reading chosen."""
    catalogue = load_catalogue()
    place = resolve_classes(read_scene(name, level)[0], catalogue)
    names = dict(catalogue.codes)
    notes = {}
    for word, row in zip(*np.unique(place.surfaces.word, return_index=True), strict=True):
        resolved, note = resolve_surface_word(place, catalogue, int(row))
        names.setdefault(int(word[:2]), f"read as {catalogue.codes[resolved.code]}")
        if note:
            notes[str(word)] = note
    audit = audit_scene(place, names, notes)
    if as_json:
        print(json.dumps(audit.to_dict(), indent=2))  # noqa: T201
        return
    _show(audit)


def _show(audit: Audit) -> None:
    console = Console(highlight=False, markup=False)  # brackets in titles and notes are units, not styles
    counts = audit.counts
    console.print(f"{audit.scene}, level {audit.level}: {audit.place}", style="bold")
    console.print(
        f"{counts.features} features, {counts.surfaces} surfaces, {counts.vertices} vertices, {counts.edges} edges; "
        f"{audit.solids} solids, {audit.planes} planes; cameras: {', '.join(audit.cameras)}"
    )
    words = Table(title="Material words", title_justify="left")
    for title in ("word", "material", "surfaces", "area [m2]", "roofs and planes", "walls", "reading"):
        words.add_column(title, justify="right" if title in ("surfaces", "area [m2]") else "left")
    for use in audit.words:
        words.add_row(
            use.word, use.material or "unknown", str(use.surfaces), f"{use.area:,.0f}", _short(use.roofs),
            _short(use.walls), use.note,
        )  # fmt: skip
    console.print(words)
    readings = Table(
        title="Features that figure 10 omits, repeats or contradicts, or that go by class", title_justify="left"
    )
    for title in ("features", "description", "printed roof / wall", "used roof / wall", "why"):
        readings.add_column(title)
    for reading in audit.readings:
        printed = f"{reading.roof_word or 'none'} / {reading.wall_word or 'none'}"
        used = f"{reading.roof_word_used} / {reading.wall_word_used}"
        readings.add_row(_short(reading.numbers), reading.description, printed, used, reading.note)
    console.print(readings)
    interiors = (f"interior {condition}: {_short(numbers)}" for condition, numbers in audit.interiors.items())
    for line in (*map(_kin, audit.levels), *interiors):
        console.print(line)
    for note in audit.notes:
        console.print(f"- {note}", style="dim")


def _kin(kin: LevelKin) -> str:
    """How one level stands in the next coarser one."""
    parts = {"beside one": kin.near, "not at the coarser level": kin.none, "not at the finer level": kin.childless}
    told = "".join(f"; {name}: {', '.join(numbers)}" for name, numbers in parts.items() if numbers)
    return (
        f"level {kin.level}: {kin.features} features, {kin.ground} of the ground, {kin.overlap} in a coarser one{told}"
    )


def _short(numbers: tuple[str, ...]) -> str:
    """Feature numbers with runs joined: 1-22, 25."""
    runs: list[list[int]] = []
    if not all(number.isdigit() for number in numbers):
        return ", ".join(numbers)
    for number in sorted(int(number) for number in numbers):
        if runs and number == runs[-1][1] + 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    return ", ".join(str(a) if a == b else f"{a}-{b}" for a, b in runs)
