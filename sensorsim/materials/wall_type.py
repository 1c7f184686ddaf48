"""What the thermal model solves: layers, the faces on both sides, and the room behind them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from sensorsim.errors import InputError
from sensorsim.materials.construction import Construction
from sensorsim.materials.cover import Cover
from sensorsim.materials.layers import Layer, ThermalPath
from sensorsim.materials.material import Material

# What the inner face sees: conditioned or enclosed air, outside air, or nothing (ground and other planes).
INTERIORS = ("heated", "cooled", "unheated", "open", "none")
ENCLOSED = ("heated", "cooled", "unheated")
SOIL_REACH = 0.6  # [m] depth that a construction with no room behind reaches; soil is put below one that does not


@dataclass(frozen=True, slots=True, kw_only=True)
class Room:
    """A building's air as one node for each square metre of its floor."""

    # By the envelope (U A over floor area) and by air change, to the air outdoors [W m-2 K-1].
    loss_coefficient: float = 4.0  # estimate: the classes of buildings have 2.7 to 3.9, a bare metal hall 12.5
    # Of the air with what goes along with it, once heating and cooling are off [s].
    time_constant: float = 43200.0  # estimate: between a tin shed's hours and a masonry hall's day


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
    layers: tuple[Layer, ...]  # exterior to interior; of the widest path where there are several
    emissivity: float  # [-], outer face
    interior_emissivity: float  # [-], inner face
    interior: str  # one of INTERIORS
    roughness: str  # one of ROUGHNESS_CLASSES
    characteristic_length: float  # [m]
    paths: tuple[ThermalPath, ...] = ()  # none where the wall is the same all over, as in `Construction`
    shape: str = "slab"  # one of SHAPES
    radius: float | None = None  # of the exterior face [m]; None for a slab
    room: Room = Room()
    heat_gain: float = 0.0  # of people, lamps and machines in the room behind [W per m2 of floor]
    cover: Cover | None = None
    parts: tuple[WallPart, ...] = ()  # of a mixture, which has no layers of its own; their shares sum to 1


def wall_type(
    material: Material,
    interior: str,
    *,
    construction: Construction | None = None,
    room: Room | None = None,
    heat_gain: float = 0.0,
    soil: Layer | None = None,
    leafless: bool = False,
) -> WallType:
    """Wall type with the surface of `material`, the given condition inside and, unless one is given, its construction.

    Where there is no room behind (interior 'none') and flat layers do not reach SOIL_REACH, a layer of `soil` lies
    below them. `leafless` shows deciduous plants in their bare season. Raises InputError for an unknown condition and
    for a heat gain that is negative or has no enclosed air to warm.
    """
    _check_inside(material, interior, heat_gain)
    stack = material.construction if construction is None else construction
    if soil is not None and interior == "none":
        stack = _on_soil(stack, soil)
    cover, emissivity = _in_season(material, leafless=leafless)
    return WallType(
        code=material.code,
        name=material.name if construction is None else f"{material.name} ({construction.name})",
        layers=stack.layers,
        emissivity=emissivity,
        interior_emissivity=material.interior_emissivity.value,
        interior=interior,
        roughness=material.roughness.value,
        characteristic_length=material.characteristic_length.value,
        paths=stack.paths,
        shape=stack.shape,
        radius=stack.radius,
        room=Room() if room is None or interior not in ENCLOSED else room,
        heat_gain=heat_gain,
        cover=cover,
    )


def mixed_wall_type(wall: WallType, parts: Sequence[WallPart]) -> WallType:
    """Wall type of a mixture: no layers, the mean emissivity of its parts, of which those without area are left out."""
    shown = tuple(part for part in parts if part.share > 0.0)
    emissivity = sum(part.share * part.wall.emissivity for part in shown)
    return replace(wall, layers=(), emissivity=emissivity, parts=shown)


def _check_inside(material: Material, interior: str, heat_gain: float) -> None:
    where = "wall type"
    if interior not in INTERIORS:
        problem, remedy = "unknown interior condition", f"use one of {', '.join(INTERIORS)}"
        raise InputError(where, f"material {material.code} interior", interior, problem, remedy)
    if not 0.0 <= heat_gain < float("inf"):
        raise InputError(where, "heat_gain", heat_gain, "not a number of 0 or more", "give watts per m2 of floor")
    if heat_gain > 0.0 and interior not in ENCLOSED:
        problem, remedy = f"no enclosed air to warm: interior '{interior}'", f"use one of {', '.join(ENCLOSED)}"
        raise InputError(where, "heat_gain", heat_gain, problem, remedy)


def _on_soil(stack: Construction, soil: Layer) -> Construction:
    """The stack with soil below the paths that end above SOIL_REACH; curved ones stand alone."""

    def deepen(layers: tuple[Layer, ...]) -> tuple[Layer, ...]:
        return (*layers, soil) if sum(layer.thickness for layer in layers) < SOIL_REACH else layers

    if stack.shape != "slab":
        return stack
    paths = tuple(replace(path, layers=deepen(path.layers)) for path in stack.paths)
    return replace(stack, layers=deepen(stack.layers), paths=paths)


def _in_season(material: Material, *, leafless: bool) -> tuple[Cover | None, float]:
    """Cover and emissivity [-] of a material, bare where it is deciduous and the season `leafless`."""
    cover = material.cover
    if not leafless or material.leafless is None or cover is None:
        return cover, material.emissivity.value
    bare = replace(cover, leaf_area_index=0.0, interception=material.leafless.interception.value)
    return bare, material.leafless.emissivity.value
