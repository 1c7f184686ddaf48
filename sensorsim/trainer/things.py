"""What moves in the scene, from CIGI or DIS alike: which vehicle, where, and what it does."""

from collections.abc import Iterable
from dataclasses import dataclass

from sensorsim.trainer.articulation import Posture, posture_of
from sensorsim.trainer.dis_listener import HeardEntity
from sensorsim.trainer.frame_request import EntityRequest
from sensorsim.trainer.host_state import Triple
from sensorsim.trainer.rotations import Angles

# Numbers of Entity Control's type and of Component Control's component, class 0 (entity)
TYPES = {1: "truck", 2: "tank", 3: "car"}
ENGINE, FIRE = 1, 2
LAND = (1, 1)  # platform, land: the first two numbers of an entity's kind in DIS
# Categories of land platforms [SISO010]; others are trucks
CATEGORIES = {1: "tank", 2: "tank", 3: "tank", 4: "tank", 5: "tank", 6: "car"}


@dataclass(frozen=True, slots=True, kw_only=True)
class Thing:
    """One vehicle. key: the same from frame to frame; engine_on and speed [m s-1]: None where nobody said.

    posture: how its articulated parts stand.
    """

    key: tuple[int, ...]
    model: str
    position: Triple
    angles: Angles
    engine_on: bool | None
    speed: float | None
    burning: bool
    posture: Posture = ()


def things_asked(entities: Iterable[EntityRequest]) -> list[Thing]:
    """Entities of the host whose type is a vehicle; an ownship of type 0 is none."""
    return [
        Thing(
            key=(entity.number,),
            model=TYPES[entity.type_number],
            position=entity.position,
            angles=entity.angles,
            engine_on=bool(entity.components[ENGINE].state) if ENGINE in entity.components else None,
            speed=None,
            burning=FIRE in entity.components and bool(entity.components[FIRE].state),
            posture=posture_of(entity.parts),
        )
        for entity in entities
        if entity.type_number in TYPES
    ]


def things_heard(entities: Iterable[HeardEntity]) -> list[Thing]:
    """Land vehicles of a DIS exercise, by their appearance."""
    return [
        Thing(
            key=(*entity.identity, 0),
            model=CATEGORIES.get(entity.kind[3], "truck"),
            position=entity.position,
            angles=entity.angles,
            engine_on=entity.thermal.engine_on,
            speed=0.0 if entity.thermal.frozen else entity.speed,
            burning=entity.thermal.burning,
        )
        for entity in entities
        if entity.kind[:2] == LAND
    ]
