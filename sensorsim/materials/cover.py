"""What nature does at a surface: soil that dries, plants that transpire, water, snow; and traffic on a road."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from sensorsim.materials.entry import FRACTION, NOT_NEGATIVE, POSITIVE, Bounds, Entry, Quantity

# Numbers that each kind of cover needs.
KINDS: Mapping[str, Mapping[str, Bounds]] = {
    "soil": {"roughness_length": POSITIVE, "moisture": FRACTION},
    "plants": {
        "height": POSITIVE,
        "leaf_area_index": POSITIVE,
        "stomatal_resistance": POSITIVE,
        "deficit_sensitivity": NOT_NEGATIVE,
    },
    "water": {"roughness_length": POSITIVE, "skin": NOT_NEGATIVE},
    "snow": {"roughness_length": POSITIVE},
    "road": {"traffic_heat": NOT_NEGATIVE},
}
SOLID = 1.0  # [-] interception of all that lets no light through


@dataclass(frozen=True, slots=True, kw_only=True)
class Cover:
    """Numbers of a natural surface; those that its kind does not need are 0."""

    kind: str  # one of KINDS
    roughness_length: float = 0.0  # [m] for momentum; plants have theirs from their height
    moisture: float = 0.0  # [-] evaporation of dry weather over that of a water surface
    height: float = 0.0  # [m] of plants
    leaf_area_index: float = 0.0  # [-] one-sided
    stomatal_resistance: float = 0.0  # [s m-1] of a leaf at its least
    deficit_sensitivity: float = 0.0  # [Pa-1] how fast stomata close with the air's vapour pressure deficit
    skin: float = 0.0  # [m] thickness of the cool skin of water
    traffic_heat: float = 0.0  # [W m-2] on a road by day
    interception: float = SOLID  # [-] share of the sunlight that is held back; the rest passes through a bare crown
    sources: tuple[tuple[str, str], ...] = field(default=(), compare=False, repr=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Leafless:
    """What a deciduous plant shows in its bare season."""

    emissivity: Quantity  # [-] 8-14 um, of bark
    reflectance_nir: Quantity  # [-] 0.8-1.1 um, of bark
    interception: Quantity  # [-] share of the sunlight that the bare crown holds back


def read_cover(parent: Entry) -> Cover | None:
    """Cover of a material's `cover` table, None without one; InputError for what is missing or outside its bounds."""
    entry = _inner(parent, "cover")
    if entry is None:
        return None
    kind = entry.choice("kind", KINDS).value
    bounds = KINDS[kind]
    entry.refuse_unknown(("kind", *bounds))
    numbers = {key: entry.quantity(key, bound) for key, bound in bounds.items()}
    sources = tuple((key, number.source) for key, number in numbers.items())
    return Cover(kind=kind, sources=sources, **{key: number.value for key, number in numbers.items()})


def read_leafless(parent: Entry) -> Leafless | None:
    """Bare season of a material's `leafless` table, None without one."""
    entry = _inner(parent, "leafless")
    if entry is None:
        return None
    keys = ("emissivity", "reflectance_nir", "interception")
    entry.refuse_unknown(keys)
    return Leafless(**{key: entry.quantity(key, FRACTION) for key in keys})


def _inner(parent: Entry, key: str) -> Entry | None:
    held = parent.table.get(key)
    if held is None:
        return None
    if not isinstance(held, Mapping):
        raise parent.error(key, "not a table", f"write {key} = {{ .. }}")
    return Entry(where=parent.where, name=f"{parent.name} {key}", table=held)
