"""Messages written: exactly what the standard allows, or a refusal that names the field."""

import struct
from collections.abc import Mapping, Sequence
from math import isfinite

from sensorsim.errors import InputError
from sensorsim.trainer.dialect import BYTE_SWAP, FIRST_PACKETS, Dialect
from sensorsim.trainer.fields import ByteOrder, Packet, Value

LARGEST_MESSAGE = 1472  # [bytes]: what one Ethernet frame holds of a UDP datagram
LONGEST_TEXT = 100  # characters of a message of text


def make_packet(dialect: Dialect, name: str, **values: Value) -> Packet:
    """A packet to be written; fields that are not given are 0. InputError for a field it does not have or cannot hold.

    The fields that say the version, and the byte-swap word, are the codec's own and are filled in.
    """
    kind = dialect.kind(name)
    known = [field.name for _, field in kind.fields] + ([kind.text] if kind.text else [])
    for field_name in values:
        if field_name not in known:
            raise InputError(name, "field", field_name, "unknown", f"use {', '.join(known)}")
    own = {"version": dialect.major, "minor_version": dialect.minor, "byte_swap": BYTE_SWAP}
    filled: dict[str, Value] = {key: own.get(key, 0) for key in known}
    if kind.text:
        filled[kind.text] = ""
    made = Packet(kind=kind, values={**filled, **values})
    _check(made)
    return made


def encode_packet(dialect: Dialect, packet: Packet, order: ByteOrder = "<") -> bytes:
    """Bytes of one packet; InputError for a value that its field cannot hold."""
    _check(packet)
    kind = packet.kind
    numbers: list[Value] = []
    for slot in kind.slots:
        number: Value = 0
        for field in slot.fields:
            value = packet.values[field.name]
            number = int(value) << field.shift | int(number) if field.width else value
        numbers.append(number)
    body = kind.layouts[order].pack(*numbers)
    if kind.text:
        body += _text_bytes(str(packet.values[kind.text]), dialect.header_size + len(body))
    size = dialect.header_size + len(body)
    start = (size, kind.number) if dialect.size_first else (kind.number, size)
    return struct.pack(order + 2 * dialect.header, *start) + body


def encode_message(
    dialect: Dialect, packets: Sequence[Packet], order: ByteOrder = "<", largest: int = LARGEST_MESSAGE
) -> bytes:
    """Bytes of a whole message.

    Raises InputError unless it begins with IG Control or Start of Frame, holds no other, and fits in `largest` bytes.
    """
    where = f"CIGI {dialect.major}.{dialect.minor} message"
    firsts = [at for at, packet in enumerate(packets) if packet.name in FIRST_PACKETS]
    if firsts != [0]:
        names = [packet.name for packet in packets]
        raise InputError(where, "packets", names, "not one of IG Control and Start of Frame, first", "begin with it")
    data = b"".join(encode_packet(dialect, packet, order) for packet in packets)
    if len(data) > largest:
        raise InputError(where, "size", len(data), f"more than {largest} bytes", "send fewer packets")
    return data


def _text_bytes(text: str, before: int) -> bytes:
    """ASCII with a closing zero, padded so that the packet is a multiple of 8 bytes."""
    if len(text) > LONGEST_TEXT or not text.isascii() or not text.isprintable():
        limits = f"not printable ASCII of {LONGEST_TEXT} characters at most"
        raise InputError("text packet", "message", text, limits, "shorten it or replace characters")
    plain = text.encode("ascii") + b"\0"
    return plain + bytes(-(before + len(plain)) % 8)


def _check(packet: Packet) -> None:
    values: Mapping[str, Value] = packet.values
    for _, field in packet.kind.fields:
        value = values.get(field.name)
        if isinstance(value, str) or value is None or not isfinite(value):
            raise InputError(packet.name, field.name, value, "not a finite number", "give one")
        if not field.low <= value <= field.high:
            limits = f"outside {field.low:g} to {field.high:g}"
            raise InputError(packet.name, field.name, value, limits, "give a value inside")
        if (field.width or isinstance(field.low, int)) and value != int(value):
            raise InputError(packet.name, field.name, value, "not a whole number", "give one")
