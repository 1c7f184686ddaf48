"""Motion imagery metadata as MISB ST 0601 has it: one local set for each picture.

Key, length and items of tag, length and value, big-endian, the checksum last [MISB0601]. Values are mapped to integers
linearly over each item's range; what lies outside of it is the item's `out of range` where it has one, else refused.
"""

import math
import struct
from collections.abc import Mapping
from dataclasses import dataclass

from sensorsim.errors import InputError

KEY = bytes.fromhex("060e2b34020b01010e01030101000000")
VERSION = 9  # of the standard whose items these are
CHECKSUM = 1


@dataclass(frozen=True, slots=True, kw_only=True)
class Item:
    """A number: its tag, bytes, and the range from low to high that they span; signed ranges are symmetric."""

    tag: int
    size: int
    low: float
    high: float

    def encode(self, name: str, value: float) -> bytes:
        """The value's bytes; InputError for one outside of the range."""
        if not (math.isfinite(value) and self.low <= value <= self.high):
            raise InputError("KLV", name, value, f"not {self.low:g} to {self.high:g}", "give it within its range")
        signed = self.low < 0.0 and self.low == -self.high
        steps = (1 << 8 * self.size) - (2 if signed else 1)
        share = value / (self.high - self.low) if signed else (value - self.low) / (self.high - self.low)
        return round(share * steps).to_bytes(self.size, "big", signed=signed)


ITEMS: Mapping[str, Item] = {
    "platform_heading": Item(tag=5, size=2, low=0.0, high=360.0),
    "platform_pitch": Item(tag=6, size=2, low=-20.0, high=20.0),
    "platform_roll": Item(tag=7, size=2, low=-50.0, high=50.0),
    "sensor_latitude": Item(tag=13, size=4, low=-90.0, high=90.0),
    "sensor_longitude": Item(tag=14, size=4, low=-180.0, high=180.0),
    "sensor_altitude": Item(tag=15, size=2, low=-900.0, high=19000.0),
    "horizontal_field": Item(tag=16, size=2, low=0.0, high=180.0),
    "vertical_field": Item(tag=17, size=2, low=0.0, high=180.0),
    "relative_azimuth": Item(tag=18, size=4, low=0.0, high=360.0),
    "relative_elevation": Item(tag=19, size=4, low=-180.0, high=180.0),
    "relative_roll": Item(tag=20, size=4, low=0.0, high=360.0),
    "slant_range": Item(tag=21, size=4, low=0.0, high=5e6),
}
TEXTS: Mapping[str, int] = {"mission": 3, "platform": 10, "image_source": 11, "coordinate_system": 12}
LONGEST_TEXT = 127


def local_set(microseconds: int, numbers: Mapping[str, float], texts: Mapping[str, str]) -> bytes:
    """One ST 0601 set of a UNIX time [us], numbers of ITEMS [deg, m] and texts of TEXTS; the checksum stands last."""
    unknown = (numbers.keys() - ITEMS.keys()) | (texts.keys() - TEXTS.keys())
    if unknown or not 0 <= microseconds < 2**64:
        raise InputError("KLV", "item", sorted(unknown) or microseconds, "unknown", f"use {', '.join(ITEMS)}")
    values = {ITEMS[name].tag: ITEMS[name].encode(name, value) for name, value in numbers.items()}
    values |= {TEXTS[name]: _text(name, text) for name, text in texts.items()} | {65: bytes([VERSION])}
    items = _item(2, struct.pack(">Q", microseconds))
    items += b"".join(_item(tag, value) for tag, value in sorted(values.items()))
    body = items + bytes([CHECKSUM, 2])
    head = KEY + length(len(body) + 2) + body
    return head + struct.pack(">H", checksum(head))


def checksum(data: bytes) -> int:
    """Sum of 16-bit words, the last one filled with zero."""
    return sum(byte << 8 if place % 2 == 0 else byte for place, byte in enumerate(data)) & 0xFFFF


def length(count: int) -> bytes:
    """A length as BER has it: one byte below 128, else a byte that counts those that follow."""
    if count < 128:
        return bytes([count])
    digits = count.to_bytes((count.bit_length() + 7) // 8, "big")
    return bytes([128 | len(digits)]) + digits


def _item(tag: int, value: bytes) -> bytes:
    return bytes([tag]) + length(len(value)) + value


def _text(name: str, text: str) -> bytes:
    if not (text.isascii() and text.isprintable() and 1 <= len(text) <= LONGEST_TEXT):
        raise InputError("KLV", name, text, f"not 1 to {LONGEST_TEXT} ASCII letters", "shorten it")
    return text.encode("ascii")
