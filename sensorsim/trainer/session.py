"""The loop that joins host, image generator and whatever draws: frames at a steady rate, each with its answer.

A frame: Start of Frame goes out; the host's message is awaited for a share of the period (synchronous), or what has
come is taken (asynchronous); the picture is drawn and delivered. A frame that takes too long delays the next ones,
which then start at the next whole period.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from time import monotonic, sleep
from typing import Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.trainer.frame_request import FrameRequest, PictureSource
from sensorsim.trainer.image_generator import ImageGenerator

MOST_DATAGRAMS = 64  # taken in one frame
KEPT = 100_000  # of the last intervals and latencies, for the report

Deliver: TypeAlias = Callable[[FrameRequest, Mapping[int, Mapping[str, NDArray[np.generic]]]], None]


class HostLink(Protocol):
    """What brings the host's datagrams and takes ours: `UdpEndpoint`, or a stand-in."""

    def receive(self, timeout: float) -> bytes | None:
        """The next datagram, None when none came in `timeout` seconds."""

    def send(self, data: bytes) -> bool:
        """Whether the datagram went out."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SessionReport:
    """How a session went; times [s]. late: frames drawn without their message; overrun: periods that were lost.

    interval: median and 99th percentile between frames. latency: the same from the host's message to the picture
    delivered. NaN where there were none.
    """

    frames: int
    late: int
    overrun: int
    refused: int
    interval: tuple[float, float]
    latency: tuple[float, float]


def run_session(
    ig: ImageGenerator,
    link: HostLink,
    draw: PictureSource,
    deliver: Deliver,
    *,
    rate: float = 60.0,
    frames: int,
    wait_share: float = 0.5,
    stop: Callable[[], bool] = lambda: False,
) -> SessionReport:
    """Runs so many frames at a rate [Hz], or until `stop` says so; wait_share of a period is given to the host.

    Raises InputError for a rate, count or share that cannot be, and whatever `draw` and `deliver` raise.
    """
    _check(rate, frames, wait_share)
    period, start = 1.0 / rate, monotonic()
    due, late, overrun, count = 0.0, 0, 0, 0
    begun, intervals, latencies = None, _Times(), _Times()
    while count < frames and not stop():
        sleep(max(0.0, start + due - monotonic()))
        now = monotonic() - start
        if begun is not None:
            intervals.add(now - begun)
        begun = now
        link.send(ig.start_frame(now))
        arrived = _listen(ig, link, start, now + wait_share * period)
        request = ig.frame_request()
        deliver(request, draw(request))
        if arrived is not None:
            latencies.add(monotonic() - start - arrived)
        late += not request.fresh
        lost = max(0, int((monotonic() - start - due) / period - 1.0))
        overrun, due, count = overrun + lost, due + (1 + lost) * period, count + 1
    return SessionReport(
        frames=count,
        late=late,
        overrun=overrun,
        refused=ig.refused,
        interval=intervals.spread(),
        latency=latencies.spread(),
    )


class _Times:
    """The last times [s], in memory that is there from the beginning and does not grow."""

    def __init__(self) -> None:
        self._values, self._count = np.full(KEPT, np.nan), 0

    def add(self, value: float) -> None:
        self._values[self._count % KEPT] = value
        self._count += 1

    def spread(self) -> tuple[float, float]:
        """Median and 99th percentile, NaN where there were none."""
        if self._count == 0:
            return float("nan"), float("nan")
        median, high = np.percentile(self._values[: min(self._count, KEPT)], [50.0, 99.0])
        return float(median), float(high)


def _listen(ig: ImageGenerator, link: HostLink, start: float, deadline: float) -> float | None:
    """Takes the host's datagrams: until the frame's own has come, or the deadline; when the last one came."""
    arrived = None
    for _ in range(MOST_DATAGRAMS):
        left = deadline - (monotonic() - start) if ig.settings.synchronous else 0.0
        data = link.receive(max(0.0, left))
        if data is None:
            break
        arrived = monotonic() - start
        ig.receive(data, arrived)
        if ig.settings.synchronous and ig.is_fresh:
            break
    return arrived


def _check(rate: float, frames: int, wait_share: float) -> None:
    for name, value, low, high in (
        ("rate", rate, 0.1, 1000.0),
        ("frames", frames, 1, 10**9),
        ("wait_share", wait_share, 0.0, 1.0),
    ):
        if not low <= value <= high:
            raise InputError("session", name, value, f"not {low:g} to {high:g}", "give another")
