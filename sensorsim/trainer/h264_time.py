"""The time of a picture inside its H.264 access unit, as MISB ST 0604 has it: an unregistered SEI message before the
first slice [MISB0604]."""

IDENTIFIER = b"MISPmicrosectime"
LOCKED = 0x1F  # status: to no discontinuity, reserved bits set
SLICES = (1, 5)
SEI, UNREGISTERED, END = 6, 5, 0x80
START = b"\x00\x00\x01"


def time_message(microseconds: int) -> bytes:
    """The SEI unit of a UNIX time [us], with its start code; 0xFF keeps zeros apart, so nothing has to be escaped."""
    digits = microseconds.to_bytes(8, "big")
    spaced = b"\xff".join(digits[place : place + 2] for place in range(0, 8, 2))
    body = IDENTIFIER + bytes([LOCKED]) + spaced
    return b"\x00" + START + bytes([SEI, UNREGISTERED, len(body)]) + body + bytes([END])


def with_time(unit: bytes, microseconds: int) -> bytes:
    """An access unit in Annex B's byte stream with the time before its first slice; as it is where it has none."""
    place = unit.find(START)
    while place >= 0:
        if unit[place + 3] & 31 in SLICES:
            first = place - 1 if place > 0 and unit[place - 1] == 0 else place
            return unit[:first] + time_message(microseconds) + unit[first:]
        place = unit.find(START, place + 3)
    return unit
