"""How a packet is declared: once, as data, from which reading and writing both follow.

A packet is a row of slots, each one number of the wire; a slot carries one field, several fields of bits, or nothing.
"""

import struct
from dataclasses import dataclass
from functools import cached_property
from typing import Literal, TypeAlias

Value: TypeAlias = int | float | str
ByteOrder: TypeAlias = Literal["<", ">"]

WHOLE_LIMITS = {"b": (-128, 127), "B": (0, 255), "H": (0, 65535), "I": (0, 2**32 - 1)}


@dataclass(frozen=True, slots=True, kw_only=True)
class Field:
    """One value of a packet: the bits of its slot that it takes (width 0: all of it) and the numbers it may be."""

    name: str
    low: float
    high: float
    shift: int = 0
    width: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Slot:
    """One number of the wire, by its `struct` letter; without fields it is reserved: written 0, read and ignored."""

    code: str
    fields: tuple[Field, ...] = ()


@dataclass(frozen=True, kw_only=True)
class PacketKind:
    """A packet's name, number, size [bytes] with its header, and slots; `text` names a text that fills the rest."""

    name: str
    number: int
    size: int
    slots: tuple[Slot, ...]
    text: str = ""

    @cached_property
    def layouts(self) -> dict[str, struct.Struct]:
        """Layout of all that follows the header, by byte order."""
        codes = "".join(slot.code for slot in self.slots)
        return {order: struct.Struct(order + codes) for order in "<>"}

    @cached_property
    def fields(self) -> tuple[tuple[int, Field], ...]:
        """All fields with the position of their slot."""
        return tuple((at, field) for at, slot in enumerate(self.slots) for field in slot.fields)


@dataclass(frozen=True, slots=True, kw_only=True)
class Packet:
    """A packet read or to be written: values by field name."""

    kind: PacketKind
    values: dict[str, Value]

    @property
    def name(self) -> str:
        """Name of its kind."""
        return self.kind.name


def whole(code: str, name: str, low: int | None = None, high: int | None = None) -> Slot:
    """A whole number (`struct` letter b, B, H or I), all that fit unless limits are given."""
    least, most = WHOLE_LIMITS[code]
    field = Field(name=name, low=least if low is None else low, high=most if high is None else high)
    return Slot(code=code, fields=(field,))


def real(code: str, name: str, low: float = -1e30, high: float = 1e30) -> Slot:
    """A real number (`struct` letter f or d); limits keep out what no host can mean."""
    return Slot(code=code, fields=(Field(name=name, low=low, high=high),))


def reals(code: str, *names: str, low: float = -1e30, high: float = 1e30) -> tuple[Slot, ...]:
    """Several real numbers of the same limits."""
    return tuple(real(code, name, low, high) for name in names)


def bits(*names_and_widths: tuple[str, int] | tuple[str, int, int], code: str = "B") -> Slot:
    """Fields packed in one number from the least bit up: (name, width) or (name, width, greatest); '' is reserved."""
    fields: list[Field] = []
    shift = 0
    for name, width, *most in names_and_widths:
        high = most[0] if most else 2**width - 1
        if name:
            fields.append(Field(name=name, low=0, high=high, shift=shift, width=width))
        shift += width
    return Slot(code=code, fields=tuple(fields))


def spare(codes: str) -> tuple[Slot, ...]:
    """Reserved numbers."""
    return tuple(Slot(code=code) for code in codes)


def kind(name: str, number: int, size: int, *slots: Slot | tuple[Slot, ...], text: str = "") -> PacketKind:
    """A packet of these slots, loose or in groups."""
    flat = [piece for slot in slots for piece in (slot if isinstance(slot, tuple) else (slot,))]
    return PacketKind(name=name, number=number, size=size, slots=tuple(flat), text=text)
