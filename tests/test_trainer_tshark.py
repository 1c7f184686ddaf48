"""Every packet, read by Wireshark's dissector: an implementation that shares nothing with this one.

`tools/bootstrap dev` installs tshark; where it is missing these tests fail and say so.
"""

import struct
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from cigi_samples import OWN, first_packet, run_tshark, sample, write_pcap

from sensorsim.trainer.dialect import CIGI_33
from sensorsim.trainer.encode import encode_message
from sensorsim.trainer.fields import ByteOrder, Packet
from sensorsim.trainer.handle_entities import SHORT_AXES

HOST_PORT, IMAGE_PORT = 8000, 8001
IMAGE_NUMBERS = 101  # packets from here on are the image generator's
ROUNDS = 4
WIRESHARK_NAMES = {"los_ext_response": "3_2_los_ext_response"}  # of 3.2 and later


def messages(order: ByteOrder) -> list[tuple[list[Packet], bytes, int]]:
    """Packets, datagram and port: each kind several times behind the packet that begins a message."""
    rng = np.random.default_rng(33)
    made = []
    for kind in CIGI_33.packets * ROUNDS:
        of_image = kind.number >= IMAGE_NUMBERS
        packet = sample(CIGI_33, kind, rng)
        packets = (
            [packet]
            if kind.name in ("ig_control", "sof")
            else [first_packet(name="sof" if of_image else "ig_control"), packet]
        )
        made.append((packets, encode_message(CIGI_33, packets, order), IMAGE_PORT if of_image else HOST_PORT))
    return made


def decoded(path: Path) -> list[ET.Element]:
    """Wireshark's reading of each datagram."""
    ports = [word for port in (HOST_PORT, IMAGE_PORT) for word in ("-d", f"udp.port=={port},cigi")]
    text = run_tshark("-r", str(path), *ports, "-T", "pdml")
    assert "malformed" not in text.lower()
    found = [packet.find("proto[@name='cigi']") for packet in ET.fromstring(text).iter("packet")]
    assert None not in found, "a datagram is not read as CIGI"
    return [element for element in found if element is not None]


def number(element: ET.Element, order: ByteOrder) -> float:
    text = element.get("show", "")
    if ":" in text:  # bytes as they lie on the wire
        return float(struct.unpack(order + "I", bytes.fromhex(text.replace(":", "")))[0])
    return float(int(text, 16)) if text.startswith("0x") else float(text)


@pytest.mark.parametrize("order", ["<", ">"], ids=["little-endian", "big-endian"])
def test_wireshark_reads_every_packet_with_equal_fields_and_size(order: ByteOrder, tmp_path: Path) -> None:
    sent = messages(order)
    write_pcap(tmp_path / "sent.pcap", [(data, port) for _, data, port in sent])
    seen = decoded(tmp_path / "sent.pcap")
    assert len(seen) == len(sent)
    for (packets, data, _), element in zip(sent, seen, strict=True):
        trees = [tree for tree in element.iter("field") if tree.find("field[@name='cigi.packet_size']") is not None]
        assert len(trees) == len(packets)
        start = 28  # [bytes] of the headers of IP and UDP
        for packet, tree in zip(packets, trees, strict=True):
            fields = {field.get("name", ""): field for field in tree.iter("field")}
            size = int(fields["cigi.packet_size"].get("show", ""))
            assert (int(tree.get("pos", "")), int(tree.get("size", ""))) == (start, size), packet.name
            assert int(fields["cigi.packet_id"].get("show", "")) == packet.kind.number
            _compare(packet, fields, order)
            start += size
        assert start == 28 + len(data)


def _compare(packet: Packet, fields: dict[str, ET.Element], order: ByteOrder) -> None:
    prefix = f"cigi.{WIRESHARK_NAMES.get(packet.name, packet.name)}."
    for name, value in packet.values.items():
        if name in OWN - {"minor_version"}:
            continue
        shown = fields[prefix + name]
        if isinstance(value, str):
            assert shown.get("show") == value
        else:
            assert number(shown, order) == value, (packet.name, name)


def test_the_reading_tells_a_wrong_field_from_a_right_one(tmp_path: Path) -> None:
    """The comparison above can fail: one bit of a gain changed on the wire is seen."""
    packet = sample(CIGI_33, CIGI_33.kind("sensor_control"), np.random.default_rng(1))
    data = bytearray(encode_message(CIGI_33, [first_packet(), packet]))
    data[24 + 10] ^= 0x40
    write_pcap(tmp_path / "changed.pcap", [(bytes(data), HOST_PORT)])
    (element,) = decoded(tmp_path / "changed.pcap")
    fields = {field.get("name", ""): field for field in element.iter("field")}
    with pytest.raises(AssertionError, match="gain"):
        _compare(packet, fields, "<")


def test_choices_of_the_short_part_packet_are_wiresharks() -> None:
    """What 1 to 6 stand for is no order of the long packet: yaw is 4, roll 6."""
    rows = [line.split("\t") for line in run_tshark("-G", "values").splitlines()]
    labels = {int(row[2], 0): row[3] for row in rows if row[:2] == ["V", "cigi.short_art_part_control.dof_select_1"]}
    shown = {number: label.lower().replace(" offset", "off") for number, label in labels.items() if number}
    assert shown == dict(enumerate(SHORT_AXES, start=1))
