"""Packets that wait for their message: what does not fit in one goes with the next."""

from collections import deque
from collections.abc import Iterable

from sensorsim.trainer.dialect import Dialect
from sensorsim.trainer.encode import LARGEST_MESSAGE, encode_packet, make_packet
from sensorsim.trainer.fields import ByteOrder, Value


class Outbox:
    """A queue of packets by name and values; `full` when nothing more should be asked of it."""

    def __init__(self, most: int) -> None:
        self._waiting: deque[tuple[str, dict[str, Value]]] = deque()
        self._most = most

    @property
    def is_full(self) -> bool:
        """Whether as many packets wait as may."""
        return len(self._waiting) >= self._most

    def add(self, packets: Iterable[tuple[str, dict[str, Value]]]) -> None:
        """Puts packets behind those that wait; what is beyond the limit is dropped, oldest first."""
        self._waiting.extend(packets)
        while len(self._waiting) > self._most:
            self._waiting.popleft()

    def clear(self) -> None:
        """Forgets what waits."""
        self._waiting.clear()

    def message(self, dialect: Dialect, order: ByteOrder, first: dict[str, Value]) -> bytes:
        """Start of Frame with these values and as many of the waiting packets as fit; a version's unknown ones go."""
        data = encode_packet(dialect, make_packet(dialect, "sof", **first), order)
        while self._waiting:
            name, values = self._waiting[0]
            if name in dialect.by_name:
                piece = encode_packet(dialect, make_packet(dialect, name, **values), order)
                if len(data) + len(piece) > LARGEST_MESSAGE:
                    break
                data += piece
            self._waiting.popleft()
        return data
