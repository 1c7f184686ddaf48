"""What the thermal model solves: layers, the faces on both sides, and the room behind them."""

from dataclasses import dataclass

from sensorsim.errors import InputError
from sensorsim.materials.construction import Construction
from sensorsim.materials.layers import Layer, ThermalPath
from sensorsim.materials.material import Material

# What the inner face sees: conditioned or enclosed air, outside air, or nothing (ground and other planes).
INTERIORS = ("heated", "cooled", "unheated", "open", "none")
ENCLOSED = ("heated", "cooled", "unheated")


@dataclass(frozen=True, slots=True, kw_only=True)
class Room:
    """A building's air as one node for each square metre of its floor."""

    # By the envelope (U A over floor area) and by air change, to the air outdoors [W m-2 K-1].
    loss_coefficient: float = 4.0  # estimate: the classes of buildings have 2.7 to 3.9, a bare metal hall 12.5
    # Of the air with what goes along with it, once heating and cooling are off [s].
    time_constant: float = 43200.0  # estimate: between a tin shed's hours and a masonry hall's day


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


def wall_type(
    material: Material,
    interior: str,
    *,
    construction: Construction | None = None,
    room: Room | None = None,
    heat_gain: float = 0.0,
) -> WallType:
    """Wall type with the surface of `material`, the given condition inside and, unless one is given, its construction.

    Raises InputError for an unknown condition and for a heat gain that is negative or has no enclosed air to warm.
    """
    where = "wall type"
    if interior not in INTERIORS:
        problem, remedy = "unknown interior condition", f"use one of {', '.join(INTERIORS)}"
        raise InputError(where, f"material {material.code} interior", interior, problem, remedy)
    if not 0.0 <= heat_gain < float("inf"):
        raise InputError(where, "heat_gain", heat_gain, "not a number of 0 or more", "give watts per m2 of floor")
    if heat_gain > 0.0 and interior not in ENCLOSED:
        problem, remedy = f"no enclosed air to warm: interior '{interior}'", f"use one of {', '.join(ENCLOSED)}"
        raise InputError(where, "heat_gain", heat_gain, problem, remedy)
    stack = material.construction if construction is None else construction
    return WallType(
        code=material.code,
        name=material.name if construction is None else f"{material.name} ({construction.name})",
        layers=stack.layers,
        emissivity=material.emissivity.value,
        interior_emissivity=material.interior_emissivity.value,
        interior=interior,
        roughness=material.roughness.value,
        characteristic_length=material.characteristic_length.value,
        paths=stack.paths,
        shape=stack.shape,
        radius=stack.radius,
        room=Room() if room is None or interior not in ENCLOSED else room,
        heat_gain=heat_gain,
    )
