"""What one code of the report's figure 9 stands for: the optical numbers of a surface and the layers behind it."""

from collections.abc import Mapping
from dataclasses import dataclass

from sensorsim.materials.construction import Construction
from sensorsim.materials.cover import Cover, Leafless, read_cover, read_leafless
from sensorsim.materials.entry import FRACTION, POSITIVE, Choice, Entry, Quantity
from sensorsim.materials.layers import STACK_KEYS, Stack, Substances, read_stack
from sensorsim.materials.mixture import Component, read_mixture

# The classes that the DOE-2 and MoWiTT convection correlations distinguish [Yazdanian1994, EnergyPlus2024].
ROUGHNESS_CLASSES = ("very_rough", "rough", "medium_rough", "medium_smooth", "smooth", "very_smooth")

# Plaster, board and paint; taken where an entry does not name another.
INTERIOR_EMISSIVITY = Quantity(value=0.9, source="EnergyPlus2024 default thermal absorptance of a Material")
OPAQUE = Quantity(value=0.0, source="estimate: opaque, since the entry names no transmittance")

_REQUIRED = (
    "code", "name", "group", "solar_absorptance", "emissivity", "reflectance_nir",
    "roughness", "characteristic_length", "construction", "layer",
)  # fmt: skip
_OPTIONAL = ("solar_transmittance", "interior_emissivity", "cover", "leafless", "mixture", *STACK_KEYS[1:])
# Groups whose surfaces lie on the ground or grow from it: a mixed block has no room behind these components.
OUTDOOR_GROUPS = ("ground", "pavement", "vegetation", "water")


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


def _read_code(entry: Entry) -> int:
    code = entry.table.get("code")
    if isinstance(code, bool) or not isinstance(code, int) or not 0 <= code <= 99:
        raise entry.error("code", "not a whole number from 0 to 99", "give the two digits of a material word")
    return code


def _read_construction(entry: Entry, substances: Substances, *, mixed: bool) -> Construction:
    held = entry.table.get("construction")
    if not isinstance(held, Mapping):
        raise entry.error("construction", "missing or not a table", 'write { description = "..", source = ".." }')
    inner = Entry(where=entry.where, name=f"{entry.name} construction", table=held)
    inner.refuse_unknown(("description", "source", "estimate"))
    stack = Stack((), (), "slab", None) if mixed else read_stack(entry, substances)
    return Construction(
        name=entry.text("name"),
        description=inner.text("description"),
        layers=stack.layers,
        source=inner.source(),
        paths=stack.paths,
        shape=stack.shape,
        radius=stack.radius,
    )


def read_material(entry: Entry, substances: Substances) -> Material:
    """Material of one [[material]] entry; InputError for what is missing, unknown or outside its physical bounds."""
    code = _read_code(entry)
    entry = Entry(where=entry.where, name=f"material {code}", table=entry.table)
    entry.refuse_unknown((*_REQUIRED, *_OPTIONAL))
    mixture = read_mixture(entry)
    for key in STACK_KEYS:
        if mixture and key in entry.table:
            raise entry.error(key, "both layers and a mixture given", "keep one of them", len(mixture))
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
