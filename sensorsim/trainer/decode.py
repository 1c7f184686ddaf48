"""Messages read: whatever the bytes, a result and never an exception.

A message is sound when its packets fill it from end to end, each known one has its size, and every number is finite.
What an unsound one held up to its fault is given too, but nothing should be done on its word. A packet of a sound
message that says what no host can mean (an hour of 25, a gain of 1.2) is left out and reported; unknown packets are
skipped.
"""

import struct
from dataclasses import dataclass
from math import isfinite

from sensorsim.trainer.dialect import FIRST_PACKETS, Dialect, detect
from sensorsim.trainer.fields import ByteOrder, Packet, PacketKind, Value

LONGEST_MESSAGE = 65507  # [bytes] of a UDP datagram


@dataclass(frozen=True, slots=True, kw_only=True)
class Message:
    """What a datagram held. faults: what was wrong or left out, in words; unknown: numbers of packets skipped."""

    dialect: Dialect | None
    order: ByteOrder
    packets: tuple[Packet, ...]
    faults: tuple[str, ...]
    unknown: tuple[int, ...]
    sound: bool


def decode_message(data: bytes) -> Message:
    """Reads a datagram of either version and byte order; never raises."""
    found = detect(data) if len(data) <= LONGEST_MESSAGE else f"{len(data)} bytes: more than a datagram holds"
    if isinstance(found, str):
        return Message(dialect=None, order="<", packets=(), faults=(found,), unknown=(), sound=False)
    dialect, order = found
    packets: list[Packet] = []
    left_out: list[str] = []
    unknown: list[int] = []
    fault = _read_packets(data, dialect, order, packets, left_out, unknown)
    return Message(
        dialect=dialect,
        order=order,
        packets=tuple(packets),
        faults=tuple(left_out) if fault is None else (*left_out, fault),
        unknown=tuple(unknown),
        sound=fault is None,
    )


def _read_packets(
    data: bytes, dialect: Dialect, order: ByteOrder, packets: list[Packet], left_out: list[str], unknown: list[int]
) -> str | None:
    """Appends what it reads; what is structurally wrong, or None."""
    header = struct.Struct(order + 2 * dialect.header)
    at, end = 0, len(data)
    while at < end:
        if end - at < header.size:
            return f"byte {at}: {end - at} bytes left over"
        first, second = header.unpack_from(data, at)
        number, size = (second, first) if dialect.size_first else (first, second)
        if size < header.size or at + size > end:
            return f"byte {at}: packet {number} claims {size} of {end - at} bytes"
        kind = dialect.by_number.get(number)
        if kind is None:
            unknown.append(number)
        elif at > 0 and kind.name in FIRST_PACKETS:
            return f"byte {at}: a second {kind.name}"
        elif kind.size not in (size, 0):
            return f"byte {at}: {kind.name} of {size} bytes, not {kind.size}"
        else:
            values, fault = _read_values(data[at + header.size : at + size], kind, order)
            if values is None:
                return f"byte {at}: {kind.name}: {fault}"
            if fault is None:
                packets.append(Packet(kind=kind, values=values))
            elif at == 0:
                return f"{kind.name}: {fault}"
            else:
                left_out.append(f"{kind.name}: {fault}")
        at += size
    return None


def _read_values(body: bytes, kind: PacketKind, order: ByteOrder) -> tuple[dict[str, Value] | None, str | None]:
    """Values by name and the first that is out of its limits; no values where a number is not finite."""
    layout = kind.layouts[order]
    if len(body) < layout.size:
        return None, f"{len(body)} bytes are too few"
    numbers = layout.unpack_from(body)
    values: dict[str, Value] = {}
    fault = None
    for at, field in kind.fields:
        number = numbers[at]
        if field.width:
            number = (number >> field.shift) & ((1 << field.width) - 1)
        if not field.low <= number <= field.high:
            if not isfinite(number):
                return None, f"{field.name} is {number}"
            fault = f"{field.name} of {number:g} is outside {field.low:g} to {field.high:g}"
        values[field.name] = number
    if kind.text:
        values[kind.text] = body[layout.size :].split(b"\0", 1)[0].decode("ascii", "replace")
    return values, fault
