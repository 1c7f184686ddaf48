"""What an entity's appearance in DIS says of its heat: bits that land, air and surface platforms share [IEEE1278]."""

from dataclasses import dataclass
from typing import Literal

Damage = Literal["none", "slight", "moderate", "destroyed"]

DAMAGES: tuple[Damage, ...] = ("none", "slight", "moderate", "destroyed")
PLATFORM = 1  # first number of an entity's kind


@dataclass(frozen=True, slots=True, kw_only=True)
class ThermalState:
    """What of an entity is hot. engine_on: power plant on, and able to run; plume: smoke rises from it."""

    engine_on: bool
    engine_smoke: bool
    plume: bool
    burning: bool
    damage: Damage
    frozen: bool  # held where it is: no dead reckoning
    active: bool  # False: to be taken away


def thermal_state(appearance: int, kind: int) -> ThermalState:
    """Thermal state of 32 appearance bits. What is no platform (a person, a shell) has no engine and no such bits."""
    frozen, active = bool(appearance >> 21 & 1), not appearance >> 23 & 1
    if kind != PLATFORM:
        return ThermalState(
            engine_on=False,
            engine_smoke=False,
            plume=False,
            burning=False,
            damage="none",
            frozen=frozen,
            active=active,
        )
    damage, smoke = DAMAGES[appearance >> 3 & 3], appearance >> 5 & 3
    return ThermalState(
        engine_on=bool(appearance >> 22 & 1) and damage != "destroyed" and active,
        engine_smoke=bool(smoke & 2),
        plume=bool(smoke & 1),
        burning=bool(appearance >> 15 & 1),
        damage=damage,
        frozen=frozen,
        active=active,
    )
