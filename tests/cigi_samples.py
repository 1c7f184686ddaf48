"""Packets with every field set at random, pcap files, and the independent decoder that reads them."""

import shutil
import struct
import subprocess
from pathlib import Path

import numpy as np

from sensorsim.trainer.dialect import CIGI_33, Dialect
from sensorsim.trainer.encode import make_packet
from sensorsim.trainer.fields import Packet, PacketKind

OWN = {"version", "minor_version", "byte_swap"}
MODEST = 999.0  # greatest real drawn; in eighths, so that single precision and six printed digits hold it exactly


def sample(dialect: Dialect, kind: PacketKind, rng: np.random.Generator) -> Packet:
    """A packet whose fields are drawn from all that they may be, reals in eighths."""
    values: dict[str, int | float | str] = {}
    codes = {id(field): slot.code for slot in kind.slots for field in slot.fields}
    for _, field in kind.fields:
        if field.name in OWN:
            continue
        if codes[id(field)] in "fd":
            low, high = max(field.low, -MODEST), min(field.high, MODEST)
            values[field.name] = float(np.trunc(8.0 * rng.uniform(low, high)) / 8.0)
        else:
            values[field.name] = int(rng.integers(int(field.low), int(field.high), endpoint=True))
    if kind.text:
        values[kind.text] = "path of 9000 m asked for"
    return make_packet(dialect, kind.name, **values)


def first_packet(dialect: Dialect = CIGI_33, name: str = "ig_control", **values: int) -> Packet:
    """The packet that begins a message; a host's says operate with timestamp unless told otherwise."""
    return make_packet(dialect, name, **({"ig_mode": 1, "timestamp_valid": 1} | values))


def write_pcap(path: Path, datagrams: list[tuple[bytes, int]], linktype: int = 228) -> None:
    """Datagrams, each with its UDP destination port, as a pcap of IPv4 packets between 127.0.0.1 and itself."""
    data = struct.pack("<IHHiIII", 0xA1B2C3D4, 2, 4, 0, 0, 262144, linktype)
    for number, (payload, port) in enumerate(datagrams):
        udp = struct.pack(">HHHH", 40000, port, 8 + len(payload), 0) + payload
        address = bytes([127, 0, 0, 1])
        ip = struct.pack(">BBHHHBBH", 0x45, 0, 20 + len(udp), number, 0, 64, 17, 0) + address + address + udp
        data += struct.pack("<IIII", number, 0, len(ip), len(ip)) + ip
    path.write_bytes(data)


def run_tshark(*arguments: str) -> str:
    """Its standard output; an assertion that says what to do where it is missing."""
    tool = shutil.which("tshark")
    assert tool, "tshark is not installed: run tools/bootstrap dev, or apt-get install tshark"
    done = subprocess.run([tool, *arguments], capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout
