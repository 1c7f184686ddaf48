"""Vehicles of a DIS exercise heard on a port, as they are at a frame's time."""

from types import TracebackType
from typing import Self

from sensorsim.trainer.dis_listener import DisListener
from sensorsim.trainer.local_place import LocalPlace
from sensorsim.trainer.things import Thing, things_heard
from sensorsim.trainer.udp import Endpoint, UdpEndpoint

MOST_DATAGRAMS = 256  # taken in one frame


class DisFeed:
    """A port of this machine, or the address given, that hears one other address. Use it in a `with`."""

    def __init__(self, endpoint: Endpoint, place: LocalPlace) -> None:
        self._link, self._listener = UdpEndpoint(endpoint), DisListener(place)

    @property
    def port(self) -> int:
        """The port that is listened on."""
        return self._link.port

    def __call__(self, time: float) -> list[Thing]:
        """Takes what has come and gives the vehicles at an IG time [s]."""
        for _ in range(MOST_DATAGRAMS):
            data = self._link.receive(0.0)
            if data is None:
                break
            self._listener.receive(data, time)
        return things_heard(self._listener.entities(time))

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._link.close()
