"""The two versions of CIGI: their packets by name and number, and how a packet begins."""

import struct
from dataclasses import dataclass
from functools import cached_property

from sensorsim.errors import InputError
from sensorsim.trainer.cigi3_host import HOST_PACKETS
from sensorsim.trainer.cigi3_image import IMAGE_PACKETS
from sensorsim.trainer.cigi4_host import HOST_PACKETS_4
from sensorsim.trainer.cigi4_image import IMAGE_PACKETS_4
from sensorsim.trainer.fields import ByteOrder, PacketKind

BYTE_SWAP = 0x8000  # written in the sender's own order at a fixed place of a 3.3 message's first packet
BYTE_SWAP_AT = 6
FIRST_PACKETS = ("ig_control", "sof")  # one of them begins every message


@dataclass(frozen=True, kw_only=True)
class Dialect:
    """One version: `header` gives the `struct` letters of a packet's first two numbers."""

    major: int
    minor: int
    header: str
    size_first: bool
    packets: tuple[PacketKind, ...]

    @cached_property
    def by_number(self) -> dict[int, PacketKind]:
        """Packets by number."""
        return {kind.number: kind for kind in self.packets}

    @cached_property
    def by_name(self) -> dict[str, PacketKind]:
        """Packets by name."""
        return {kind.name: kind for kind in self.packets}

    @property
    def header_size(self) -> int:
        """Length of a packet's header [bytes]."""
        return struct.calcsize("=" + 2 * self.header)

    def kind(self, name: str) -> PacketKind:
        """The packet of that name; InputError where this version has none."""
        if name not in self.by_name:
            known = ", ".join(self.by_name)
            raise InputError(f"CIGI {self.major}.{self.minor}", "packet", name, "unknown", f"use one of {known}")
        return self.by_name[name]


CIGI_33 = Dialect(major=3, minor=3, header="B", size_first=False, packets=HOST_PACKETS + IMAGE_PACKETS)
CIGI_40 = Dialect(major=4, minor=0, header="H", size_first=True, packets=HOST_PACKETS_4 + IMAGE_PACKETS_4)


def detect(data: bytes) -> tuple[Dialect, ByteOrder] | str:
    """Version and byte order of a message by its first eight bytes, or why it is none.

    3.3 says its order by a word at byte 6; 4.0 by its first packet's size, 24, which has one byte of zero.
    """
    if len(data) < 24:
        return f"{len(data)} bytes: shorter than the packet that begins a message"
    if data[1] == 24 and data[0] in (1, 101):
        return _detect_3(data)
    sizes: dict[bytes, ByteOrder] = {b"\x18\x00": "<", b"\x00\x18": ">"}
    if data[:2] in sizes and data[2:4] in (b"\x00\x00", b"\xff\xff"):
        major, minor = data[4], data[7] >> 4
        return (CIGI_40, sizes[data[:2]]) if major == 4 else f"version {major}.{minor} in a message laid out as 4.0"
    return "does not begin with IG Control or Start of Frame"


def _detect_3(data: bytes) -> tuple[Dialect, ByteOrder] | str:
    minor = data[4 if data[0] == 1 else 5] >> 4
    if data[2] != 3 or minor > 3:
        return f"version {data[2]}.{minor} in a message laid out as 3.3"
    word = data[BYTE_SWAP_AT : BYTE_SWAP_AT + 2]
    if word == b"\x80\x00":
        return CIGI_33, ">"
    if word == b"\x00\x80":
        return CIGI_33, "<"
    return f"byte-swap word {word.hex()}"
