"""Construction classes: what a building or a piece of ground is made of where only its kind is known.

Section 3.5 of [Report1978]: classify a feature, then give each of its components the standard cross-section of the
class. A class of buildings has sections for wall, roof, window and floor; one of grounds or pavements a single surface.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from sensorsim.materials.code import MaterialWord
from sensorsim.materials.construction import Construction
from sensorsim.materials.entry import FRACTION, POSITIVE, Entry, read_toml
from sensorsim.materials.material import Material
from sensorsim.materials.wall_type import INTERIORS, Room

COMPONENTS = ("wall", "roof", "window", "floor")
GROUPS = ("building", "ground", "pavement")
# Section by the role of a surface in a scene.
_COMPONENT_OF = {"wall": "wall", "roof": "roof", "plane": "roof", "bottom": "floor"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """The standard cross-section of one component."""

    word: MaterialWord
    construction: Construction | None  # instead of the material's own
    reason: str  # source or estimate, as in `Quantity.source`


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ConstructionClass:
    """One class of the tree: its components' sections, and how its rooms are kept unless a feature says so."""

    name: str
    group: str  # one of GROUPS
    description: str
    interior: str  # one of INTERIORS
    room: Room
    sections: Mapping[str, Section]  # by COMPONENTS; all of them the same for ground and pavement

    def section_of(self, role: str) -> Section:
        """Section of a surface of the role 'wall', 'roof', 'bottom' or 'plane'."""
        return self.sections[_COMPONENT_OF[role]]


def read_classes(
    path: Path, materials: Mapping[int, Material], constructions: Mapping[str, Construction]
) -> Mapping[str, ConstructionClass]:
    """Classes by name, from the [[class]] entries of a TOML file; InputError where one names what does not exist."""
    whole = read_toml(path)
    whole.refuse_unknown(("class",))
    classes: dict[str, ConstructionClass] = {}
    for entry in whole.entries("class", "class"):
        read = _read_class(entry, materials, constructions)
        if read.name in classes:
            raise entry.error("name", "class given twice", "rename one of them")
        classes[read.name] = read
    return MappingProxyType(classes)


def _read_class(
    entry: Entry, materials: Mapping[int, Material], constructions: Mapping[str, Construction]
) -> ConstructionClass:
    name, group = entry.text("name"), entry.choice("group", GROUPS).value
    entry = Entry(where=entry.where, name=f"class {name}", table=entry.table)
    keys = COMPONENTS if group == "building" else ("surface",)
    entry.refuse_unknown(("name", "group", "description", "interior", "room", *keys))
    sections = {key: _read_section(_inner(entry, key), materials, constructions) for key in keys}
    if group != "building":
        sections = dict.fromkeys(COMPONENTS, sections["surface"])
    return ConstructionClass(
        name=name,
        group=group,
        description=entry.text("description"),
        interior=entry.choice("interior", INTERIORS).value,
        room=_read_room(_inner(entry, "room")) if "room" in entry.table else Room(),
        sections=MappingProxyType(sections),
    )


def _read_section(
    entry: Entry, materials: Mapping[int, Material], constructions: Mapping[str, Construction]
) -> Section:
    entry.refuse_unknown(("material", "reflectance", "construction", "source", "estimate"))
    code = entry.table.get("material")
    if isinstance(code, bool) or not isinstance(code, int) or code not in materials:
        raise entry.error("material", "not a code of the catalogue", "name a material that exists")
    name = entry.text("construction") if "construction" in entry.table else None
    if name is not None and name not in constructions:
        raise entry.error("construction", "no such construction", f"use one of {', '.join(constructions)}")
    given = "reflectance" in entry.table
    reflectance = entry.quantity("reflectance", FRACTION).value if given else materials[code].solar_reflectance
    return Section(
        word=MaterialWord(code=code, reflectance=round(100.0 * reflectance) / 100.0),
        construction=None if name is None else constructions[name],
        reason=entry.source(),
    )


def _read_room(entry: Entry) -> Room:
    entry.refuse_unknown(("loss_coefficient", "time_constant"))
    return Room(
        loss_coefficient=entry.quantity("loss_coefficient", POSITIVE).value,
        time_constant=entry.quantity("time_constant", POSITIVE).value,
    )


def _inner(entry: Entry, key: str) -> Entry:
    held = entry.table.get(key)
    if not isinstance(held, Mapping):
        raise entry.error(key, "missing or not a table", f"write {key} = {{ .. }}")
    return Entry(where=entry.where, name=f"{entry.name} {key}", table=held)
