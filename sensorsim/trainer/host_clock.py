"""When a host's message was true, on the image generator's clock: timestamps freed of the network's jitter.

Host and image generator count from moments of their own. The least delay between sending and arriving that was seen is
taken for none; it is let grow slowly, so that two clocks that drift apart are followed.
"""

from dataclasses import dataclass

TICK = 1e-5  # [s]
WRAP = 2**32  # ticks: 11.93 h
DRIFT = 1e-4  # [s s-1] by which the host's clock may lag behind ours
LONGEST_DELAY = 1.0  # [s]; a greater step is a new start of the host


@dataclass(frozen=True, slots=True, kw_only=True)
class HostClock:
    """The last timestamp [ticks], and the time to add to a host's to have ours [s]; None before the first."""

    ticks: int = 0
    arrived: float = 0.0
    offset: float | None = None
    unwrapped: float = 0.0


def hear_timestamp(clock: HostClock, ticks: int, arrived: float) -> tuple[HostClock, float]:
    """The clock after a message with that timestamp that arrived at that IG time [s], and when it was true [s]."""
    step = ((ticks - clock.ticks + WRAP // 2) % WRAP - WRAP // 2) * TICK  # the shorter way around
    host = clock.unwrapped + step
    offset = arrived - host
    if clock.offset is not None and abs(offset - clock.offset) <= LONGEST_DELAY:
        offset = min(offset, clock.offset + DRIFT * max(0.0, arrived - clock.arrived))
    return HostClock(ticks=ticks, arrived=arrived, offset=offset, unwrapped=host), min(arrived, host + offset)
