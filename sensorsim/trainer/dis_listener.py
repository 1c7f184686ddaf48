"""Entities of a DIS exercise as they are now: heard, carried on, and forgotten when they fall silent."""

from dataclasses import dataclass
from math import cos, radians, sin

import numpy as np

from sensorsim.trainer.appearance import ThermalState, thermal_state
from sensorsim.trainer.dead_reckoning import reckoned
from sensorsim.trainer.dis_pdu import EntityState, decode_dis
from sensorsim.trainer.host_state import Triple
from sensorsim.trainer.local_place import LocalPlace, geodetic_from_geocentric
from sensorsim.trainer.rotations import ENU_FROM_NED, Angles, FloatArray, angles_of, attitude

SILENCE = 12.0  # [s] after which an entity is gone: 2.4 heartbeats of 5 s [IEEE1278]
MOST_ENTITIES = 4096

Identity = tuple[int, int, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class HeardEntity:
    """One entity at one time: position [m], yaw from the map's north, pitch, roll [deg], speed [m s-1]."""

    identity: Identity
    kind: tuple[int, int, int, int, int, int, int]
    marking: str
    position: Triple
    angles: Angles
    speed: float
    thermal: ThermalState


class DisListener:
    """Takes datagrams of one exercise; 0 is every exercise."""

    def __init__(self, place: LocalPlace, *, exercise: int = 0, most_entities: int = MOST_ENTITIES) -> None:
        self.refused = 0  # packets that were not acted upon
        self._place, self._exercise, self._most = place, exercise, most_entities
        self._heard: dict[Identity, tuple[EntityState, float]] = {}

    def receive(self, data: bytes, time: float) -> tuple[str, ...]:
        """Takes a datagram that arrived at a time [s]; what of it was not acted upon, in words. Never raises."""
        states, faults = decode_dis(data)
        told = list(faults)
        for state in states:
            if self._exercise not in (0, state.exercise):
                told.append(f"exercise {state.exercise}")
            elif state.identity not in self._heard and len(self._heard) >= self._most:
                told.append(f"entity {state.identity}: more than {self._most} entities")
            elif thermal_state(state.appearance, state.kind[0]).active:
                self._heard[state.identity] = state, time
            else:
                self._heard.pop(state.identity, None)
        self.refused += len(told)
        return tuple(told)

    def entities(self, time: float) -> tuple[HeardEntity, ...]:
        """All that are on the map at a time [s], in order of identity; the silent are forgotten."""
        self._heard = {key: heard for key, heard in self._heard.items() if time - heard[1] <= SILENCE}
        found = (self._entity(*heard, time) for _, heard in sorted(self._heard.items()))
        return tuple(entity for entity in found if entity is not None)

    def _entity(self, state: EntityState, since: float, time: float) -> HeardEntity | None:
        thermal = thermal_state(state.appearance, state.kind[0])
        centred, axes = reckoned(state, 0.0 if thermal.frozen else time - since)
        latitude, longitude, height = geodetic_from_geocentric(*centred.tolist())
        position = self._place.local(latitude, longitude, height)
        if position is None:
            return None
        east, north, up = position.tolist()
        heading = -self._place.convergence(latitude, longitude)
        map_ned = attitude((heading, 0.0, 0.0)) @ _ned_from_centred(latitude, longitude)
        return HeardEntity(
            identity=state.identity,
            kind=state.kind,
            marking=state.marking,
            position=(east, north, up),
            angles=angles_of(np.asarray(map_ned @ axes)),
            speed=float(np.linalg.norm(state.velocity)),
            thermal=thermal,
        )


def _ned_from_centred(latitude: float, longitude: float) -> FloatArray:
    """North, east, down axes at a place, as rows of Earth-centred components."""
    phi, lam = radians(latitude), radians(longitude)
    east = np.array([-sin(lam), cos(lam), 0.0])
    up = np.array([cos(phi) * cos(lam), cos(phi) * sin(lam), sin(phi)])
    return np.asarray(ENU_FROM_NED.T @ np.array([east, np.cross(up, east), up]))
