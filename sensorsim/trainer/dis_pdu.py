"""The Entity State packet of DIS [IEEE1278], read liberally and written strictly: 144 bytes and 16 per moving part.

Positions are Earth-centred [m], angles radians about z, y and x from Earth-centred axes to the body's. Other packets
and articulated parts are skipped by their length.
"""

import struct
from dataclasses import dataclass
from math import isfinite

from sensorsim.errors import InputError
from sensorsim.trainer.host_state import Triple

ENTITY_STATE, ENTITY_FAMILY = 1, 1
SHORTEST_HEADER, PART_SIZE = 12, 16  # [bytes]
OLDEST_VERSION, NEWEST_VERSION = 4, 7
NEAREST, FARTHEST = 6.2e6, 1e8  # [m] from the Earth's centre
FASTEST = 1e5  # [m s-1], [m s-2]
FASTEST_TURN = 1e3  # [rad s-1]
LAST_ALGORITHM = 9  # of dead reckoning
LAYOUT = struct.Struct(">BBBBIHBB HHHBB BBHBBBB 8s 3f 3d 3f I B15s 3f 3f B11s I")


@dataclass(frozen=True, slots=True, kw_only=True)
class EntityState:
    """What one packet says of one entity."""

    exercise: int
    identity: tuple[int, int, int]  # site, application, entity
    force: int
    kind: tuple[int, int, int, int, int, int, int]  # kind, domain, country, category, subcategory, specific, extra
    velocity: Triple  # [m s-1] Earth-centred, or of the body for algorithms 6 to 9
    location: Triple  # [m] Earth-centred
    orientation: Triple  # psi, theta, phi [rad]
    appearance: int
    algorithm: int  # of dead reckoning
    acceleration: Triple  # [m s-2], in the axes of the velocity
    angular_velocity: Triple  # [rad s-1] about the body's axes
    marking: str = ""
    timestamp: int = 0


def decode_dis(data: bytes) -> tuple[tuple[EntityState, ...], tuple[str, ...]]:
    """Entity states of a datagram of one or more packets, and what was refused; never raises."""
    states: list[EntityState] = []
    faults: list[str] = []
    at = 0
    while at < len(data):
        if len(data) - at < SHORTEST_HEADER:
            return tuple(states), (*faults, f"byte {at}: {len(data) - at} bytes left over")
        version, _, number, family, _, length = struct.unpack_from(">BBBBIH", data, at)
        if length < SHORTEST_HEADER or at + length > len(data):
            return tuple(states), (*faults, f"byte {at}: packet claims {length} of {len(data) - at} bytes")
        if (number, family) == (ENTITY_STATE, ENTITY_FAMILY):
            found = _entity_state(version, data[at : at + length])
            if isinstance(found, str):
                faults.append(f"byte {at}: {found}")
            else:
                states.append(found)
        at += length
    return tuple(states), tuple(faults)


def encode_dis(state: EntityState) -> bytes:
    """One packet of version 7 without moving parts; InputError for what it cannot hold."""
    if (problem := _problem(state)) is not None or len(state.marking) > 11 or not state.marking.isascii():
        entry = problem or "marking"
        raise InputError("Entity State", "value", entry, "cannot be sent", "give finite values and 11 ASCII letters")
    try:
        return LAYOUT.pack(
            *(NEWEST_VERSION, state.exercise, ENTITY_STATE, ENTITY_FAMILY, state.timestamp, LAYOUT.size, 0, 0),
            *(*state.identity, state.force, 0),
            *state.kind,
            bytes(8),
            *state.velocity,
            *state.location,
            *state.orientation,
            state.appearance,
            state.algorithm,
            bytes(15),
            *state.acceleration,
            *state.angular_velocity,
            1,
            state.marking.encode("ascii"),
            0,
        )
    except (struct.error, OverflowError) as error:
        raise InputError("Entity State", "value", state.identity, str(error), "give numbers that fit") from error


def _entity_state(version: int, data: bytes) -> EntityState | str:
    if not OLDEST_VERSION <= version <= NEWEST_VERSION:
        return f"version {version}"
    if len(data) < LAYOUT.size:
        return f"Entity State of {len(data)} bytes, not {LAYOUT.size} at least"
    numbers = LAYOUT.unpack_from(data)
    if len(data) < LAYOUT.size + PART_SIZE * numbers[12]:
        return f"Entity State of {len(data)} bytes with {numbers[12]} parts"
    state = EntityState(
        exercise=numbers[1],
        timestamp=numbers[4],
        identity=numbers[8:11],
        force=numbers[11],
        kind=numbers[13:20],
        velocity=numbers[21:24],
        location=numbers[24:27],
        orientation=numbers[27:30],
        appearance=numbers[30],
        algorithm=numbers[31],
        acceleration=numbers[33:36],
        angular_velocity=numbers[36:39],
        marking=numbers[40].split(b"\0", 1)[0].decode("ascii", "replace"),
    )
    return _problem(state) or state


def _problem(state: EntityState) -> str | None:
    """What no entity can have."""
    bounds = (
        ("velocity", state.velocity, FASTEST),
        ("location", state.location, FARTHEST),
        ("orientation", state.orientation, FASTEST_TURN),
        ("acceleration", state.acceleration, FASTEST),
        ("angular velocity", state.angular_velocity, FASTEST_TURN),
    )
    for name, triple, most in bounds:
        if not all(isfinite(value) and abs(value) <= most for value in triple):
            return f"{name} {triple}"
    if sum(value * value for value in state.location) < NEAREST**2:
        return f"location {state.location} inside the Earth"
    return None if state.algorithm <= LAST_ALGORITHM else f"dead reckoning algorithm {state.algorithm}"
