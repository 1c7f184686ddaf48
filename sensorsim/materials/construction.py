"""Constructions: stacks of layers, exterior to interior, from the package's own files or a user's."""

from dataclasses import dataclass
from pathlib import Path

from sensorsim.errors import InputError
from sensorsim.materials.entry import UNSOURCED, read_toml
from sensorsim.materials.layers import STACK_KEYS, Layer, ThermalPath, read_stack
from sensorsim.resources import assets_folder


@dataclass(frozen=True, slots=True, kw_only=True)
class Construction:
    """A stack of layers, exterior to interior: in parallel paths or not, flat or around a centre."""

    name: str
    description: str
    layers: tuple[Layer, ...]  # of the widest path where there are several
    source: str  # of the stack as a whole, as in `Quantity.source`
    paths: tuple[ThermalPath, ...] = ()  # none where the wall is the same all over; else all, their shares adding to 1
    shape: str = "slab"  # one of SHAPES
    radius: float | None = None  # of the exterior face [m]; None for a slab

    @property
    def thermal_resistance(self) -> float:
        """Resistance of `layers` as a flat stack from face to face, without films [m2 K W-1]."""
        return sum(layer.thermal_resistance for layer in self.layers)


def read_construction(path: Path) -> Construction:
    """Construction of one TOML file: name, description and source (each optional), then the [[layer]] list."""
    entry = read_toml(path)
    entry.refuse_unknown(("name", "description", "source", "estimate", *STACK_KEYS))
    source = entry.source()
    stack = read_stack(entry, {})
    return Construction(
        name=entry.text("name") if "name" in entry.table else path.stem,
        description=entry.text("description") if "description" in entry.table else "",
        layers=stack.layers,
        source=f"file {path.name}" if source == UNSOURCED else source,
        paths=stack.paths,
        shape=stack.shape,
        radius=stack.radius,
    )


def construction_names() -> tuple[str, ...]:
    """Names that `load_construction` knows, sorted."""
    return tuple(sorted(path.stem for path in (assets_folder() / "constructions").glob("*.toml")))


def load_construction(name_or_path: str | Path) -> Construction:
    """Construction by the name of a file in assets/constructions, or from a TOML file of one's own.

    A file holds [[layer]] tables, exterior first, each with either thickness [m], conductivity
    [W m-1 K-1], density [kg m-3] and specific_heat [J kg-1 K-1], or resistance [m2 K W-1]. A number is plain or
    { value = .., source = ".." } or { value = .., estimate = "why" }. Thickness 0 is allowed.

    Studs: a [path] table names parallel paths with their shares of the area, `path = "studs"` puts a layer into one of
    them. Pipes and tanks: shape = "cylinder" or "sphere" with the radius [m] of the exterior face. Raises InputError.
    """
    names = construction_names()
    if isinstance(name_or_path, str) and name_or_path in names:
        return read_construction(assets_folder() / "constructions" / f"{name_or_path}.toml")
    path = Path(name_or_path)
    if not path.is_file():
        remedy = f"use one of {', '.join(names)}, or the path of a TOML file"
        raise InputError("construction", "name", str(name_or_path), "no such construction or file", remedy)
    return read_construction(path)
