"""The catalogue: every material by its code, the standard constructions, and the readings of doubtful words."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from sensorsim.errors import InputError
from sensorsim.materials.classes import ConstructionClass, Section, read_classes
from sensorsim.materials.code import MaterialWord, parse_word
from sensorsim.materials.construction import Construction, construction_names, load_construction
from sensorsim.materials.entry import Entry, read_toml
from sensorsim.materials.layers import Layer, Substances, read_layer, read_substances
from sensorsim.materials.material import OUTDOOR_GROUPS, Material, read_material
from sensorsim.materials.mixture import Coverage, component_shares
from sensorsim.materials.readings import Reading, read_readings
from sensorsim.materials.wall_type import Room, WallPart, WallType, mixed_wall_type, wall_type
from sensorsim.resources import assets_folder

_SUBSTANCES, _READINGS, _CLASSES = "substances.toml", "readings.toml", "classes.toml"
_GLOSS = "gloss.toml"  # read by `load_gloss`
SOIL = "subsoil"  # the substance that lies below planes whose own layers have no ground in them
UNKNOWN_COVERAGE = Coverage()


@dataclass(frozen=True, slots=True, kw_only=True)
class Catalogue:
    """Materials by code, constructions and construction classes by name, readings by code, notes by word."""

    folder: Path
    materials: Mapping[int, Material]
    constructions: Mapping[str, Construction]
    classes: Mapping[str, ConstructionClass]
    readings: Mapping[int, Reading]
    word_notes: Mapping[str, str]
    soil: Layer | None  # below planes whose layers have no ground in them; None where no such substance is given

    @property
    def codes(self) -> Mapping[int, str]:
        """Name of each code."""
        return {code: material.name for code, material in self.materials.items()}

    def resolve(self, code: int) -> tuple[int, str | None]:
        """The code that `code` stands for, with the reason where it is a reading; InputError for an unknown code."""
        if code in self.materials:
            return code, None
        if code in self.readings:
            return self.readings[code].means, self.readings[code].reason
        remedy = f"use one of the {len(self.materials)} codes there, or add an entry or a reading"
        raise InputError(self.folder, "material code", code, "no such material", remedy)

    def resolve_word(self, word: str) -> tuple[MaterialWord, str | None]:
        """Word with a code of the catalogue, with the note that belongs to it; InputError as in `resolve`."""
        parsed = parse_word(word)
        code, note = self.resolve(parsed.code)
        return MaterialWord(code=code, reflectance=parsed.reflectance), note or self.word_notes.get(word)

    def material(self, code: int) -> Material:
        """Material of a code; InputError for one that the catalogue lacks, a reading included (see `resolve`)."""
        means, note = self.resolve(code)
        if note is not None:
            raise InputError(
                self.folder, "material code", code, "not a material itself", f"resolve it: read as {means}"
            )
        return self.materials[code]

    def construction_class(self, name: str) -> ConstructionClass:
        """Class of a name; InputError with the list of the classes for an unknown one."""
        if name not in self.classes:
            remedy = f"use one of {', '.join(self.classes)}" if self.classes else f"add {_CLASSES} to the folder"
            raise InputError(self.folder, "construction_class", name, "no such construction class", remedy)
        return self.classes[name]

    def wall_type(
        self,
        code: int,
        interior: str,
        *,
        section: Section | None = None,
        room: Room | None = None,
        heat_gain: float = 0.0,
        leafless: bool = False,
        coverage: Coverage = UNKNOWN_COVERAGE,
        side: bool = False,
    ) -> WallType:
        """Wall type of a code with the given interior condition; InputError where either is unknown.

        A class's `section` may bring its own construction, its `room` the numbers of the air behind; `heat_gain` is in
        watts per m2 of floor. `leafless` shows deciduous plants in their bare season; `coverage` and `side` matter for
        mixed blocks, see `component_shares`.
        """
        material, construction = self.material(code), None if section is None else section.construction
        wall = wall_type(
            material, interior, construction=construction, room=room, heat_gain=heat_gain,
            soil=None if material.mixture and construction is None else self.soil, leafless=leafless,
        )  # fmt: skip
        if not material.mixture or construction is not None:
            return wall
        shares = component_shares(material.mixture, coverage, side=side)
        parts = [
            self._part(component.code, share, wall, room=room, leafless=leafless)
            for component, share in zip(material.mixture, shares, strict=True)
        ]
        return mixed_wall_type(wall, parts)

    def _part(self, code: int, share: float, block: WallType, *, room: Room | None, leafless: bool) -> WallPart:
        """Component of a block: without a room behind where it is no building, else the block's or an unheated one."""
        own = self.material(code)
        if own.group in OUTDOOR_GROUPS:
            wall = wall_type(own, "none", soil=self.soil, leafless=leafless)
        else:
            behind = "unheated" if block.interior == "none" else block.interior
            wall = wall_type(own, behind, room=room, heat_gain=block.heat_gain, soil=self.soil, leafless=leafless)
        return WallPart(wall=wall, share=share, reflectance=own.solar_reflectance)


def _read_materials(folder: Path, substances: Substances) -> dict[int, Material]:
    materials: dict[int, Material] = {}
    for path in sorted(folder.glob("*.toml")):
        if path.name in (_SUBSTANCES, _READINGS, _CLASSES, _GLOSS):
            continue
        whole = read_toml(path)
        whole.refuse_unknown(("material",))
        for entry in whole.entries("material", "material"):
            material = read_material(entry, substances)
            if material.code in materials:
                first = materials[material.code]
                problem = f"code given twice, first for {first.name} in {first.file}"
                raise InputError(path, "material code", material.code, problem, "give one of them a free code")
            materials[material.code] = material
    _require_components(folder, materials)
    return dict(sorted(materials.items()))


def _require_components(folder: Path, materials: Mapping[int, Material]) -> None:
    """Refuse mixtures of codes that do not exist or are mixtures themselves."""
    for material in materials.values():
        for component in material.mixture:
            if component.code not in materials or materials[component.code].mixture:
                entry = f"material {material.code} mixture code"
                problem, remedy = "no plain material", "name the code of a material that is no mixture"
                raise InputError(folder / material.file, entry, component.code, problem, remedy)


def _soil(folder: Path, substances: Substances) -> Layer | None:
    if SOIL not in substances:
        return None
    return read_layer(Entry(where=folder / _SUBSTANCES, name=SOIL, table={"substance": SOIL}), substances)


def load_catalogue(folder: Path | None = None) -> Catalogue:
    """Catalogue of a folder of TOML files; without one, the package's own, assets/materials.

    Every file but substances.toml (layers that entries may name), readings.toml (codes read as others), gloss.toml
    (surfaces that mirror; the package's own is read) and classes.toml (construction classes) holds [[material]]
    entries. A folder of one's own stands alone: copy the package's and edit.
    Raises InputError.
    """
    folder = assets_folder() / "materials" if folder is None else folder
    if not folder.is_dir():
        raise InputError("catalogue", "folder", str(folder), "no such folder", "name a folder of TOML files")
    substances = read_substances(folder / _SUBSTANCES) if (folder / _SUBSTANCES).is_file() else {}
    materials = _read_materials(folder, substances)
    if not materials:
        raise InputError(folder, "material", None, "no materials", "add a TOML file with [[material]] entries")
    has_readings = (folder / _READINGS).is_file()
    readings, notes = read_readings(folder / _READINGS, materials) if has_readings else ({}, {})
    constructions = {name: load_construction(name) for name in construction_names()}
    has_classes = (folder / _CLASSES).is_file()
    return Catalogue(
        folder=folder,
        materials=MappingProxyType(materials),
        constructions=MappingProxyType(constructions),
        classes=read_classes(folder / _CLASSES, materials, constructions) if has_classes else MappingProxyType({}),
        readings=MappingProxyType(dict(readings)),
        word_notes=MappingProxyType(dict(notes)),
        soil=_soil(folder, substances),
    )
