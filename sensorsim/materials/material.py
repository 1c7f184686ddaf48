"""What one code of the report's figure 9 stands for, and what the thermal model solves."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from sensorsim.errors import InputError
from sensorsim.materials.construction import Construction, Layer, read_layers
from sensorsim.materials.cover import Cover, Leafless, read_cover, read_leafless
from sensorsim.materials.entry import FRACTION, POSITIVE, Choice, Entry, Quantity
from sensorsim.materials.mixture import Component, read_mixture

# The classes that the DOE-2 and MoWiTT convection correlations distinguish [Yazdanian1994, EnergyPlus2024].
ROUGHNESS_CLASSES = ("very_rough", "rough", "medium_rough", "medium_smooth", "smooth", "very_smooth")

# What the inner face sees: conditioned or enclosed air, outside air, or nothing (ground and other planes).
INTERIORS = ("heated", "cooled", "unheated", "open", "none")

# Plaster, board and paint; taken where an entry does not name another.
INTERIOR_EMISSIVITY = Quantity(value=0.9, source="EnergyPlus2024 default thermal absorptance of a Material")
OPAQUE = Quantity(value=0.0, source="estimate: opaque, since the entry names no transmittance")

_REQUIRED = (
    "code", "name", "group", "solar_absorptance", "emissivity", "reflectance_nir",
    "roughness", "characteristic_length", "construction", "layer",
)  # fmt: skip
_OPTIONAL = ("solar_transmittance", "interior_emissivity", "cover", "leafless", "mixture")
# Groups whose surfaces lie on the ground or grow from it: a mixed block has no room behind these components.
OUTDOOR_GROUPS = ("ground", "pavement", "vegetation", "water")
SOIL_REACH = 0.6  # [m] depth that a construction with no room behind reaches; soil is put below one that does not


@dataclass(frozen=True, slots=True, kw_only=True)
class Material:
    """One code: optical numbers of its surface and the stack that it stands for, the material itself outermost."""

    code: int
    name: str
    group: str
    solar_absorptance: Quantity  # [-], of the class; a word's last two digits say it per surface
    solar_transmittance: Quantity  # [-], 0 unless glass or screen
    emissivity: Quantity  # [-], 8-14 um
    reflectance_nir: Quantity  # [-], 0.8-1.1 um
    roughness: Choice  # one of ROUGHNESS_CLASSES
    characteristic_length: Quantity  # [m], of a typical surface, for convection
    interior_emissivity: Quantity  # [-], of the inner face
    construction: Construction  # without layers where it is a mixture
    cover: Cover | None
    leafless: Leafless | None
    mixture: tuple[Component, ...]
    file: str

    @property
    def solar_reflectance(self) -> float:
        """Solar reflectance [-] of the class, for surfaces that no word describes."""
        return 1.0 - self.solar_absorptance.value - self.solar_transmittance.value


@dataclass(frozen=True, slots=True, kw_only=True)
class WallPart:
    """One component of a mixed wall type."""

    wall: "WallType"
    share: float  # [-] of the area
    reflectance: float  # [-] solar, of its own class


@dataclass(frozen=True, slots=True, kw_only=True)
class WallType:
    """Everything but solar reflectance and orientation that decides a wall's temperature; hashable."""

    code: int
    name: str
    layers: tuple[Layer, ...]  # exterior to interior
    emissivity: float  # [-], outer face
    interior_emissivity: float  # [-], inner face
    interior: str  # one of INTERIORS
    roughness: str  # one of ROUGHNESS_CLASSES
    characteristic_length: float  # [m]
    cover: Cover | None = None
    parts: tuple[WallPart, ...] = ()  # of a mixture, which has no layers of its own; their shares sum to 1


def wall_type(material: Material, interior: str, *, soil: Layer | None = None, leafless: bool = False) -> WallType:
    """Wall type of `material` with the given condition inside; InputError for an unknown condition.

    Where there is no room behind (interior 'none') and the layers do not reach SOIL_REACH, a layer of `soil` lies
    below them. `leafless` shows deciduous plants in their bare season.
    """
    if interior not in INTERIORS:
        problem, remedy = "unknown interior condition", f"use one of {', '.join(INTERIORS)}"
        raise InputError("wall type", f"material {material.code} interior", interior, problem, remedy)
    layers, cover, emissivity = material.construction.layers, material.cover, material.emissivity.value
    if soil is not None and interior == "none" and sum(layer.thickness for layer in layers) < SOIL_REACH:
        layers = (*layers, soil)
    if leafless and material.leafless is not None and cover is not None:
        cover = replace(cover, leaf_area_index=0.0, interception=material.leafless.interception.value)
        emissivity = material.leafless.emissivity.value
    return WallType(
        code=material.code,
        name=material.name,
        layers=layers,
        emissivity=emissivity,
        interior_emissivity=material.interior_emissivity.value,
        interior=interior,
        roughness=material.roughness.value,
        characteristic_length=material.characteristic_length.value,
        cover=cover,
    )


def mixed_wall_type(material: Material, interior: str, parts: Sequence[WallPart]) -> WallType:
    """Wall type of a mixture: no layers, the mean emissivity of its parts, of which those without area are left out."""
    shown = tuple(part for part in parts if part.share > 0.0)
    emissivity = sum(part.share * part.wall.emissivity for part in shown)
    return replace(wall_type(material, interior), layers=(), emissivity=emissivity, parts=shown)


def _read_code(entry: Entry) -> int:
    code = entry.table.get("code")
    if isinstance(code, bool) or not isinstance(code, int) or not 0 <= code <= 99:
        raise entry.error("code", "not a whole number from 0 to 99", "give the two digits of a material word")
    return code


def _read_construction(entry: Entry, substances: Mapping[str, Mapping[str, Any]], *, mixed: bool) -> Construction:
    held = entry.table.get("construction")
    if not isinstance(held, Mapping):
        raise entry.error("construction", "missing or not a table", 'write { description = "..", source = ".." }')
    inner = Entry(where=entry.where, name=f"{entry.name} construction", table=held)
    inner.refuse_unknown(("description", "source", "estimate"))
    return Construction(
        name=entry.text("name"),
        description=inner.text("description"),
        layers=() if mixed else read_layers(entry, substances),
        source=inner.source(),
    )


def read_material(entry: Entry, substances: Mapping[str, Mapping[str, Any]]) -> Material:
    """Material of one [[material]] entry; InputError for what is missing, unknown or outside its physical bounds."""
    code = _read_code(entry)
    entry = Entry(where=entry.where, name=f"material {code}", table=entry.table)
    entry.refuse_unknown((*_REQUIRED, *_OPTIONAL))
    mixture = read_mixture(entry)
    if mixture and "layer" in entry.table:
        raise entry.error("layer", "both layers and a mixture given", "keep one of them", len(mixture))
    material = Material(
        code=code,
        name=entry.text("name"),
        group=entry.text("group"),
        solar_absorptance=entry.quantity("solar_absorptance", FRACTION),
        solar_transmittance=_optional(entry, "solar_transmittance", OPAQUE),
        emissivity=entry.quantity("emissivity", FRACTION),
        reflectance_nir=entry.quantity("reflectance_nir", FRACTION),
        roughness=entry.choice("roughness", ROUGHNESS_CLASSES),
        characteristic_length=entry.quantity("characteristic_length", POSITIVE),
        interior_emissivity=_optional(entry, "interior_emissivity", INTERIOR_EMISSIVITY),
        construction=_read_construction(entry, substances, mixed=bool(mixture)),
        cover=read_cover(entry),
        leafless=read_leafless(entry),
        mixture=mixture,
        file=entry.where.name,
    )
    if material.solar_reflectance < -1e-9:
        problem = "absorptance and transmittance add up to more than 1"
        raise entry.error("solar_transmittance", problem, "correct one of them", material.solar_transmittance.value)
    return material


def _optional(entry: Entry, key: str, default: Quantity) -> Quantity:
    return entry.quantity(key, FRACTION) if key in entry.table else default
