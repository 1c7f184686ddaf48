"""The image generator as a host sees it, without sockets: bytes in, bytes and frame requests out.

One frame: `start_frame` gives the message to send, Start of Frame with its answers; `receive` takes the host's; then
`frame_request` says what to draw. Time is seconds of any clock that does not go back.

Synchronous: the image generator is the clock, and what a host says holds for the frame under way; a frame whose message
did not come is the last one carried on. Asynchronous: a message holds for the time of its timestamp.
"""

from collections.abc import Sequence
from dataclasses import replace
from math import isfinite

from sensorsim.errors import InputError
from sensorsim.trainer.apply import STANDBY, apply_message, initial_state
from sensorsim.trainer.bake_request import BakeRequest, is_other_weather, wanted_bake
from sensorsim.trainer.database import DatabaseLoader, Handshake, LoadState, database_number, hear
from sensorsim.trainer.decode import Message, decode_message
from sensorsim.trainer.encode import LONGEST_TEXT
from sensorsim.trainer.fields import Value
from sensorsim.trainer.frame_request import FrameRequest, compose_frame
from sensorsim.trainer.handle_environment import moment_of
from sensorsim.trainer.host_clock import TICK, WRAP, HostClock, hear_timestamp
from sensorsim.trainer.host_state import HostState
from sensorsim.trainer.obstacles import Standing, standing_vehicles
from sensorsim.trainer.outbox import Outbox
from sensorsim.trainer.poses import Surroundings
from sensorsim.trainer.settings import ImageSettings, Moment
from sensorsim.trainer.sight import answer
from sensorsim.trainer.terrain import height_of_terrain
from sensorsim.trainer.tracker import Locks, track_sensors

REFUSED, BAKE_ASKED, BAKE_DONE, BAKE_REFUSED = 1, 2, 3, 4  # numbers of messages of text
NOMINAL, BAKE_PENDING = 0, 1  # status in Start of Frame
MOST_WAITING = 1024  # packets
COUNTS = 2**32


def _always_ready(_: int) -> LoadState:
    return "ready"


class ImageGenerator:
    """What the host has said, which frame it is, and what is still to be answered."""

    def __init__(
        self, settings: ImageSettings, around: Surroundings, *, utc_offset: float, load: DatabaseLoader = _always_ready
    ) -> None:
        """utc_offset [h]: of the site's local standard time; load: asked for the databases that the host wants."""
        self.settings, self.around = settings, around
        self.state: HostState = initial_state(settings)
        self.frame = -1
        self.late_frames = 0  # frames whose message did not come in time
        self.refused = 0  # messages and packets that were not acted upon
        self._utc_offset, self._load = utc_offset, load
        self._dialect = settings.dialect
        self._time, self._fresh, self._heard = 0.0, False, False
        self._handshake, self._clock = Handshake(), HostClock()
        self._locks: Locks = {}
        self._outbox = Outbox(MOST_WAITING)
        self._baked = self._asked = wanted_bake(self.state, settings.start, utc_offset)
        self._pending = False
        height_of_terrain(around.terrain, 0.0, 0.0)  # rays are compiled now, not within a frame

    @property
    def is_fresh(self) -> bool:
        """Whether the host's message for the frame under way has come."""
        return self._fresh

    def start_frame(self, time: float) -> bytes:
        """Begins a frame at an IG time [s]: Start of Frame, and the answers that are due."""
        if not isfinite(time) or (self.frame >= 0 and time < self._time):
            raise InputError("image generator", "time", time, f"before {self._time} or not finite", "use one clock")
        if self._heard and not self._fresh:
            self.late_frames += 1
        self._time, self._fresh, self.frame = time, False, (self.frame + 1) % COUNTS
        if self.state.mode != STANDBY:
            vehicles = standing_vehicles(self.state, time, self.around) if self._looks() else ()
            self._answer_queries(vehicles)
            responses, self._locks = track_sensors(self.state, time, self.around, self._locks, vehicles)
            self._outbox.add(responses)
        first: dict[str, Value] = {
            "ig_mode": self.state.mode,
            "db_number": database_number(self._handshake, self._load) if self.state.mode != STANDBY else 0,
            "timestamp_valid": 1,
            "timestamp": round(time / TICK) % WRAP,
            "ig_frame_number": self.frame,
            "last_host_frame_number": self.state.host_frame,
        }
        if "ig_status" in {field.name for _, field in self._dialect.kind("sof").fields}:
            first["ig_status"] = BAKE_PENDING if self._pending else NOMINAL
        return self._outbox.message(self._dialect, self.settings.order, first)

    def receive(self, data: bytes, time: float) -> tuple[str, ...]:
        """Takes a datagram that arrived at an IG time [s]; what of it was not acted upon, in words. Never raises."""
        message = decode_message(data)
        before = self.state
        moment = Moment(frame=self.frame, time=self._true_at(message, time), settings=self.settings)
        self.state, faults = apply_message(self.state, message, moment)
        self.refused += len(faults)
        if self.state is before:
            return faults
        self._dialect = message.dialect or self._dialect
        self._heard = True
        self._fresh = not self.settings.synchronous or self.state.last_image_frame == self.frame
        self._after_mode(before)
        if faults and self.state.mode != STANDBY:
            self._say(REFUSED, f"{len(faults)} refused: {faults[0]}")
        return faults

    def frame_request(self) -> FrameRequest:
        """What to draw for the frame under way; in standby a frame without views."""
        moment = moment_of(self.state.clock, self._time)
        wanted = wanted_bake(self.state, moment, self._utc_offset)
        self._pending = is_other_weather(wanted, self._baked)
        if self._pending and is_other_weather(wanted, self._asked):
            self._asked = wanted
            self._say(BAKE_ASKED, f"bake asked for: {wanted.day}, frames show the last one until it is done")
        state = self.state if self.state.mode != STANDBY else replace(self.state, views={}, entities={})
        return compose_frame(
            state,
            self.around,
            frame=self.frame,
            time=self._time,
            fresh=self._fresh,
            bake=self._asked if self._pending else None,
        )

    def bake_done(self, done: BakeRequest) -> None:
        """Says that the tables now hold this weather."""
        self._baked = done
        self._asked, self._pending = done, False
        self._say(BAKE_DONE, f"bake done: {done.day}")

    def bake_refused(self, reason: str) -> None:
        """Says why the weather that was asked for cannot be had; frames go on showing the last one."""
        self._say(BAKE_REFUSED, f"bake refused: {reason}")

    def _true_at(self, message: Message, arrived: float) -> float:
        """IG time at which a message holds [s]."""
        if self.settings.synchronous:
            return self._time
        first = message.packets[0] if message.sound and message.packets else None
        if first is None or first.name != "ig_control" or not first.values["timestamp_valid"]:
            return arrived
        self._clock, true_at = hear_timestamp(self._clock, int(first.values["timestamp"]), arrived)
        return true_at

    def _after_mode(self, before: HostState) -> None:
        if self.state.mode == STANDBY:
            if before.mode != STANDBY:
                self._handshake, self._clock, self._locks = Handshake(), HostClock(), {}
                self._outbox.clear()
            return
        self._handshake = hear(self._handshake, self.state.database)

    def _looks(self) -> bool:
        """Whether a line of sight may be asked for in this frame."""
        return bool(self.state.queries) or any(one.track_mode != "off" for one in self.state.sensors.values())

    def _answer_queries(self, vehicles: Sequence[Standing]) -> None:
        """Answers what is due, up to the limit of a frame; questions asked once are then forgotten."""
        due = [key for key, query in self.state.queries.items() if query.due <= self.frame]
        if not due or self._outbox.is_full:
            return
        queries = dict(self.state.queries)
        for key in due[: self.settings.queries_per_frame]:
            query = queries.pop(key)
            self._outbox.add(answer(self.state, query, self._time, self.around, vehicles))
            if query.period > 0:  # behind the others, so that all have their turn
                queries[key] = replace(query, due=self.frame + query.period)
        self.state = replace(self.state, queries=queries)

    def _say(self, number: int, text: str) -> None:
        plain = "".join(letter if " " <= letter <= "~" else "?" for letter in text)
        self._outbox.add([("image_generator_message", {"message_id": number, "message": plain[:LONGEST_TEXT]})])
