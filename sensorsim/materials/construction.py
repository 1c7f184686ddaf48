"""Constructions: stacks of layers, exterior to interior, from the package's own files or a user's."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from sensorsim.errors import InputError
from sensorsim.materials.entry import NOT_NEGATIVE, POSITIVE, UNSOURCED, Bounds, Entry, read_toml
from sensorsim.resources import assets_folder

_MASS_BOUNDS: Mapping[str, Bounds] = {
    "thickness": NOT_NEGATIVE,
    "conductivity": POSITIVE,
    "density": POSITIVE,
    "specific_heat": POSITIVE,
}
_LAYER_BOUNDS: Mapping[str, Bounds] = {**_MASS_BOUNDS, "resistance": POSITIVE}


@dataclass(frozen=True, slots=True, kw_only=True)
class Layer:
    """One layer: a slab with heat capacity, or a pure resistance such as an air space.

    A slab may have thickness 0; it then adds nothing, and whoever solves the wall drops it. A pure resistance has
    `resistance` set and the four slab numbers 0.
    """

    name: str
    thickness: float = 0.0  # [m]
    conductivity: float = 0.0  # [W m-1 K-1]
    density: float = 0.0  # [kg m-3]
    specific_heat: float = 0.0  # [J kg-1 K-1]
    resistance: float | None = None  # [m2 K W-1], None for a slab
    # (number, source) pairs; no part of what a layer is, so two layers with equal numbers are equal
    sources: tuple[tuple[str, str], ...] = field(default=(), compare=False, repr=False)

    @property
    def thermal_resistance(self) -> float:
        """Resistance from face to face [m2 K W-1]."""
        return self.thickness / self.conductivity if self.resistance is None else self.resistance

    @property
    def areal_heat_capacity(self) -> float:
        """Heat capacity per area [J m-2 K-1]; 0 for a pure resistance."""
        return self.thickness * self.density * self.specific_heat


@dataclass(frozen=True, slots=True, kw_only=True)
class Construction:
    """A stack of layers, exterior to interior."""

    name: str
    description: str
    layers: tuple[Layer, ...]
    source: str  # of the stack as a whole, as in `Quantity.source`

    @property
    def thermal_resistance(self) -> float:
        """Resistance from face to face, without films [m2 K W-1]."""
        return sum(layer.thermal_resistance for layer in self.layers)


def read_layer(entry: Entry, substances: Mapping[str, Mapping[str, Any]]) -> Layer:
    """Layer of one [[layer]] entry, its missing numbers from the substance it names."""
    entry.refuse_unknown(("name", "substance", *_LAYER_BOUNDS))
    table = dict(entry.table)
    if "substance" in table:
        known = substances.get(entry.text("substance"))
        if known is None:
            remedy = "use a name of substances.toml" if substances else "give the numbers: this file has no substances"
            raise entry.error("substance", "unknown substance", remedy)
        del table["substance"]
        table = {**known, **table}
    whole = Entry(where=entry.where, name=entry.name, table=table)
    keys = ("resistance",) if "resistance" in table else tuple(_MASS_BOUNDS)
    for key in _MASS_BOUNDS:
        if key in table and key not in keys:
            raise whole.error(key, f"both resistance and {key} given", "keep the resistance or the four slab numbers")
    numbers = {key: whole.quantity(key, _LAYER_BOUNDS[key]) for key in keys}
    sources = tuple((key, number.source) for key, number in numbers.items())
    values = {key: number.value for key, number in numbers.items()}
    return Layer(name=whole.text("name"), sources=sources, **values)


def read_layers(parent: Entry, substances: Mapping[str, Mapping[str, Any]]) -> tuple[Layer, ...]:
    """Layers of the [[layer]] list of `parent`, exterior first; InputError where one is wrong or nothing is left."""
    layers = tuple(read_layer(entry, substances) for entry in parent.entries("layer", "layer"))
    if not layers:
        raise parent.error("layer", "no layers", "add at least one [[layer]] with a thickness or a resistance")
    if all(layer.thermal_resistance == 0.0 for layer in layers):
        raise parent.error("layer", "every layer has thickness 0", "give at least one layer a thickness", len(layers))
    return layers


def read_substances(path: Path) -> Mapping[str, Mapping[str, Any]]:
    """Layer defaults by name, each number checked here so that a bad one is told with this file's name."""
    substances = read_toml(path).table
    for key, table in substances.items():
        entry = Entry(where=path, name=key, table=table if isinstance(table, Mapping) else {})
        entry.refuse_unknown(("name", *_LAYER_BOUNDS))
        entry.text("name")
        for number in entry.table.keys() & _LAYER_BOUNDS.keys():
            entry.quantity(number, _LAYER_BOUNDS[number])
    return substances


def read_construction(path: Path) -> Construction:
    """Construction of one TOML file: name, description and source (each optional), then the [[layer]] list."""
    entry = read_toml(path)
    entry.refuse_unknown(("name", "description", "source", "estimate", "layer"))
    source = entry.source()
    return Construction(
        name=entry.text("name") if "name" in entry.table else path.stem,
        description=entry.text("description") if "description" in entry.table else "",
        layers=read_layers(entry, {}),
        source=f"file {path.name}" if source == UNSOURCED else source,
    )


def construction_names() -> tuple[str, ...]:
    """Names that `load_construction` knows, sorted."""
    return tuple(sorted(path.stem for path in (assets_folder() / "constructions").glob("*.toml")))


def load_construction(name_or_path: str | Path) -> Construction:
    """Construction by the name of a file in assets/constructions, or from a TOML file of one's own.

    A file holds [[layer]] tables, exterior first, each with a name and either thickness [m], conductivity
    [W m-1 K-1], density [kg m-3] and specific_heat [J kg-1 K-1], or resistance [m2 K W-1]. A number is plain or
    { value = .., source = ".." } or { value = .., estimate = "why" }. Thickness 0 is allowed. Raises InputError.
    """
    names = construction_names()
    if isinstance(name_or_path, str) and name_or_path in names:
        return read_construction(assets_folder() / "constructions" / f"{name_or_path}.toml")
    path = Path(name_or_path)
    if not path.is_file():
        remedy = f"use one of {', '.join(names)}, or the path of a TOML file"
        raise InputError("construction", "name", str(name_or_path), "no such construction or file", remedy)
    return read_construction(path)
