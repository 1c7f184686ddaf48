"""Layers of a wall, and how a TOML file gives a stack of them: in parallel paths or not, flat or around a centre."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

from sensorsim.materials.entry import POSITIVE, SHARE, UNSOURCED, Bounds, Entry, Quantity, read_toml

Substances = Mapping[str, Mapping[str, Any]]  # layer defaults by name

SHAPES = ("slab", "cylinder", "sphere")
STACK_KEYS = ("layer", "path", "shape", "radius")  # what `read_stack` reads

THICKEST = 50.0  # [m] of a layer: what lies above is a millimetre taken for a metre

_MASS_BOUNDS: Mapping[str, Bounds] = {
    "thickness": Bounds(low=0.0, high=THICKEST, open_low=False, text=f"a number of 0 to {THICKEST:g}, in metres"),
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
class ThermalPath:
    """A share of a wall's area with layers of its own, such as that of its studs."""

    name: str
    fraction: float  # of the wall's area [-]
    layers: tuple[Layer, ...]  # exterior to interior
    source: str = field(default=UNSOURCED, compare=False, repr=False)  # of the fraction


class Stack(NamedTuple):
    """Layers as a file gives them: in parallel paths or not, flat or around a centre."""

    layers: tuple[Layer, ...]  # of the widest path where there are several
    paths: tuple[ThermalPath, ...]  # none where the wall is the same all over
    shape: str  # one of SHAPES
    radius: float | None  # of the exterior face [m]; None for a slab


def read_layer(entry: Entry, substances: Substances) -> Layer:
    """Layer of one [[layer]] entry, its missing numbers from the substance it names."""
    entry.refuse_unknown(("name", "substance", "path", *_LAYER_BOUNDS))
    table = {key: value for key, value in entry.table.items() if key != "path"}
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
    name = whole.text("name") if "name" in table else entry.name
    return Layer(name=name, sources=sources, **values)


def _read_layers(parent: Entry, entries: Sequence[Entry], substances: Substances) -> tuple[Layer, ...]:
    layers = tuple(read_layer(entry, substances) for entry in entries)
    if not layers:
        raise parent.error("layer", "no layers", "add at least one [[layer]] with a thickness or a resistance")
    if all(layer.thermal_resistance == 0.0 for layer in layers):
        raise parent.error("layer", "every layer has thickness 0", "give at least one layer a thickness", len(layers))
    return layers


def read_stack(parent: Entry, substances: Substances) -> Stack:
    """Layers of the [[layer]] list of `parent`, exterior first, with its STACK_KEYS; InputError where one is wrong.

    Without a [path] table the wall is the same all over. With one, which gives each path a share of the area, a layer
    that names a `path` stands in that path alone, and one that names none stands in all.
    """
    entries = parent.entries("layer", "layer")
    shape, radius = _read_shape(parent)
    fractions = _read_fractions(parent, entries)
    if not fractions:
        return _within(parent, Stack(_read_layers(parent, entries, substances), (), shape, radius))
    paths = []
    for name, fraction in fractions.items():
        own = [entry for entry in entries if entry.table.get("path", name) == name]
        layers = _read_layers(parent, own, substances)
        paths.append(ThermalPath(name=name, fraction=fraction.value, layers=layers, source=fraction.source))
    widest = max(paths, key=lambda path: path.fraction)
    return _within(parent, Stack(widest.layers, tuple(paths), shape, radius))


def _within(parent: Entry, stack: Stack) -> Stack:
    """The stack itself, where its layers end before the centre or there."""
    for layers in (stack.layers, *(path.layers for path in stack.paths)):
        deepest = sum(layer.thickness for layer in layers)
        if stack.radius is not None and deepest > stack.radius * (1.0 + 1e-9):
            problem = f"layers reach {deepest:g} m deep"
            raise parent.error("radius", problem, "make the radius larger or the layers thinner", stack.radius)
    return stack


def _read_fractions(parent: Entry, entries: Sequence[Entry]) -> Mapping[str, Quantity]:
    """Share of the area by name of path; empty where there are none."""
    held = parent.table.get("path", {})
    if not isinstance(held, Mapping):
        raise parent.error("path", "not a table of shares", "write [path] with a name and a share for each")
    inner = Entry(where=parent.where, name=f"{parent.name} path".strip(), table=held)
    fractions = {name: inner.quantity(name, SHARE) for name in held}
    for entry in entries:
        if "path" in entry.table and entry.table["path"] not in fractions:
            raise entry.error("path", "no such path", f"use one of the [path] table: {', '.join(fractions) or 'none'}")
    if fractions and not any("path" in entry.table for entry in entries):
        name = next(iter(fractions))
        raise parent.error("path", "no layer names one", f'write path = "{name}" in the layers that stand there alone')
    total = sum(fraction.value for fraction in fractions.values())
    if fractions and abs(total - 1.0) > 1e-9:
        raise parent.error("path", "shares do not add up to 1", "correct one of them", round(total, 9))
    return fractions


def _read_shape(parent: Entry) -> tuple[str, float | None]:
    """Shape and exterior radius [m] of the stack; a slab where no shape is named."""
    shape = parent.choice("shape", SHAPES).value if "shape" in parent.table else "slab"
    if shape == "slab":
        if "radius" in parent.table:
            raise parent.error("radius", "a slab has none", 'leave it out, or write shape = "cylinder" or "sphere"')
        return shape, None
    radius = parent.quantity("radius", POSITIVE).value
    return shape, radius


def read_substances(path: Path) -> Substances:
    """Layer defaults by name, each number checked here so that a bad one is told with this file's name."""
    substances = read_toml(path).table
    for key, table in substances.items():
        entry = Entry(where=path, name=key, table=table if isinstance(table, Mapping) else {})
        entry.refuse_unknown(("name", *_LAYER_BOUNDS))
        entry.text("name")
        for number in entry.table.keys() & _LAYER_BOUNDS.keys():
            entry.quantity(number, _LAYER_BOUNDS[number])
    return substances
