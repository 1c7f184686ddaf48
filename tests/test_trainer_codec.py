"""CIGI packets against an independent encoder's bytes, against themselves in both byte orders, and against nonsense."""

import json
import struct
from pathlib import Path

import numpy as np
import pytest
from cigi_samples import first_packet, sample

from sensorsim.errors import InputError
from sensorsim.trainer.decode import Message, decode_message
from sensorsim.trainer.dialect import CIGI_33, CIGI_40, Dialect
from sensorsim.trainer.encode import encode_message, encode_packet, make_packet
from sensorsim.trainer.fields import ByteOrder, PacketKind

VECTORS = json.loads((Path(__file__).parent / "data" / "cigi_vectors.json").read_text("utf-8"))
FIRSTS = {CIGI_33: ("ig_control33", "sof33"), CIGI_40: ("ig_control40", "sof40")}
RENAMED = {"earth_model": "earth_ref_model_def", "view_definition": "view_def"}
BOTH = [(CIGI_33, "hex33"), (CIGI_40, "hex40")]
GOLDEN = [(dialect, name) for dialect, key in BOTH for name, entry in VECTORS["packets"].items() if key in entry]


def golden_bytes(dialect: Dialect, name: str) -> bytes:
    return bytes.fromhex(VECTORS["packets"][name]["hex33" if dialect is CIGI_33 else "hex40"])


def first_bytes(dialect: Dialect, which: int = 0) -> bytes:
    return bytes.fromhex(VECTORS[FIRSTS[dialect][which]])


def shown(text: str, name: str) -> float:
    """A number as Wireshark shows it; component data are shown as raw bytes."""
    return (
        float(struct.unpack("<I", bytes.fromhex(text.replace(":", "")))[0]) if name.startswith("data_") else float(text)
    )


# --- golden packets ----------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("dialect", "name"), GOLDEN, ids=[f"{d.major} {n}" for d, n in GOLDEN])
def test_golden_packet_comes_back_as_the_same_bytes(dialect: Dialect, name: str) -> None:
    packet_bytes = golden_bytes(dialect, name)
    message = decode_message(first_bytes(dialect) + packet_bytes)
    assert message.sound
    assert message.faults == message.unknown == ()
    assert message.packets[1].name == RENAMED.get(name, name)
    assert encode_packet(dialect, message.packets[1]) == packet_bytes


@pytest.mark.parametrize("dialect", [CIGI_33, CIGI_40], ids=["3.3", "4.0"])
@pytest.mark.parametrize("which", [0, 1], ids=["IG Control", "Start of Frame"])
def test_golden_first_packet_says_its_version_and_comes_back(dialect: Dialect, which: int) -> None:
    data = first_bytes(dialect, which)
    message = decode_message(data)
    assert (message.dialect, message.order, message.sound) == (dialect, "<", True)
    assert encode_message(dialect, message.packets) == data
    values = message.packets[0].values
    assert values["timestamp"] == 0x0A0B0C0D
    frames = [values[name] for name in values if "frame_number" in name]
    assert sorted(frames) == [0x01020304, 0x11223344]


@pytest.mark.parametrize("name", [name for name, entry in VECTORS["packets"].items() if "fields33" in entry])
def test_golden_fields_read_as_wireshark_reads_them(name: str) -> None:
    packet = decode_message(first_bytes(CIGI_33) + golden_bytes(CIGI_33, name)).packets[1]
    for path, text in VECTORS["packets"][name]["fields33"].items():
        if path in ("packet_id", "packet_size"):
            continue
        field = path.split(".")[1]
        assert packet.values[field] == pytest.approx(shown(text, field), rel=1e-14), path


@pytest.mark.parametrize(
    "name", [name for name, entry in VECTORS["packets"].items() if {"hex33", "hex40"} <= set(entry)]
)
def test_versions_say_the_same_by_the_same_names(name: str) -> None:
    """The encoder wrote one set of values in both versions; 4.0 keeps the entity's place elsewhere."""
    old = decode_message(first_bytes(CIGI_33) + golden_bytes(CIGI_33, name)).packets[1].values
    new = decode_message(first_bytes(CIGI_40) + golden_bytes(CIGI_40, name)).packets[1].values
    converted_otherwise = {"entity_type", "entity_id_valid"}  # by the encoder: another type, a bit dropped
    common = set(old) & set(new) - converted_otherwise
    assert len(common) >= 3
    assert {key: old[key] for key in common} == {key: new[key] for key in common}


# --- both orders, all packets ------------------------------------------------------------------------------------

KINDS = [(dialect, kind) for dialect in (CIGI_33, CIGI_40) for kind in dialect.packets]


@pytest.mark.parametrize(("dialect", "kind"), KINDS, ids=[f"{d.major} {k.name}" for d, k in KINDS])
@pytest.mark.parametrize("order", ["<", ">"])
def test_every_packet_comes_back_with_its_values(dialect: Dialect, kind: PacketKind, order: ByteOrder) -> None:
    rng = np.random.default_rng(7)
    for _ in range(20):
        packet = sample(dialect, kind, rng)
        alone = kind.name in ("ig_control", "sof")
        data = encode_message(dialect, [packet] if alone else [first_packet(dialect), packet], order)
        message = decode_message(data)
        assert (message.dialect, message.order, message.faults, message.sound) == (dialect, order, (), True)
        assert message.packets[-1] == packet
        text = len(str(packet.values.get("message", ""))) + 1
        whole = 8 * -(-(dialect.header_size + kind.layouts[order].size + text) // 8)
        assert len(encode_packet(dialect, packet, order)) == (kind.size or whole)


@pytest.mark.parametrize("order", ["<", ">"])
@pytest.mark.parametrize(
    ("name", "values", "letters", "numbers"),
    [
        ("component_control", {"component_id": 0x102, "component_class": 13, "component_state": 7, "instance_id": 0x304,
         "data_1": 1, "data_6": 0xAABBCCDD}, "HHHBBHHI6I",
         (40, 3, 0x102, 13, 7, 0x304, 0, 0, 1, 0, 0, 0, 0, 0xAABBCCDD)),
        ("short_component_control", {"component_id": 9, "component_state": 255, "instance_id": 5, "data_2": 6},
         "HHHBBHHI2I", (24, 4, 9, 0, 255, 5, 0, 0, 0, 6)),
        ("art_part_control", {"entity_id": 0x203, "part_id": 4, "part_enable": 1, "xoff_enable": 1, "yaw_enable": 1,
         "xoff": 0.5, "roll": -1.5, "pitch": 2.5, "yaw": 90.25}, "HHHBB6f",
         (32, 5, 0x203, 4, 0x43, .5, 0, 0, -1.5, 2.5, 90.25)),
        ("short_art_part_control", {"entity_id": 0x203, "part_id_1": 1, "part_id_2": 2, "dof_select_1": 4,
         "dof_select_2": 5, "part_enable_1": 1, "dof_1": 45.5, "dof_2": -3.5},
         "HHHBBBBHffI", (24, 6, 0x203, 1, 2, 4 | 5 << 3 | 1 << 6, 0, 0, 45.5, -3.5, 0)),
        ("rate_control", {"entity_id": 8, "part_id": 1, "apply_to_part": 1, "coordinate_system": 1, "y_rate": 2.5,
         "yaw_rate": -6.0}, "HHHBB6f", (32, 7, 8, 1, 3, 0, 2.5, 0, 0, 0, -6.0)),
    ],
)  # fmt: skip
def test_packets_of_entities_in_4_0_lie_as_the_class_library_writes_them(
    name: str, values: dict[str, float], letters: str, numbers: tuple[float, ...], order: ByteOrder
) -> None:
    """Written here number by number, in the order of the library's own writing."""
    packet = make_packet(CIGI_40, name, **values)
    assert encode_packet(CIGI_40, packet, order) == struct.pack(order + letters, *numbers)


@pytest.mark.parametrize("dialect", [CIGI_33, CIGI_40], ids=["3.3", "4.0"])
def test_layouts_fill_the_declared_sizes_with_every_number_on_its_own_alignment(dialect: Dialect) -> None:
    for kind in dialect.packets:
        at = dialect.header_size
        for slot in kind.slots:
            width = struct.calcsize("=" + slot.code)
            assert at % width == 0, (kind.name, slot)
            at += width
        assert at == kind.size or (kind.text and kind.size == 0), kind.name
        assert kind.size % 8 == 0
        bits = [(slot, field) for slot in kind.slots for field in slot.fields if field.width]
        assert all(field.shift + field.width <= 8 * struct.calcsize("=" + slot.code) for slot, field in bits)


# --- liberal on receipt ------------------------------------------------------------------------------------------


def host_message(*packets: bytes, dialect: Dialect = CIGI_33) -> Message:
    return decode_message(encode_message(dialect, [first_packet(dialect)]) + b"".join(packets))


def test_unknown_packets_are_skipped_by_their_size() -> None:
    sensor = golden_bytes(CIGI_33, "sensor_control")
    message = host_message(b"\xd3\x10" + bytes(14), sensor, b"\xfe\x02")
    assert message.sound
    assert [packet.name for packet in message.packets] == ["ig_control", "sensor_control"]
    assert message.unknown == (0xD3, 0xFE)


@pytest.mark.parametrize("minor", [0, 1, 2, 3])
def test_any_minor_version_of_3_in_24_bytes_is_read_as_3_3(minor: int) -> None:
    data = bytearray(first_bytes(CIGI_33))
    data[4] = minor << 4 | data[4] & 15
    assert decode_message(bytes(data)).packets[0].values["minor_version"] == minor


@pytest.mark.parametrize(
    ("tail", "word"),
    [
        (b"\x11", "left over"),
        (b"\x11\x00" + bytes(22), "claims 0"),
        (b"\x11\x01" + bytes(22), "claims 1"),
        (b"\x11\x18" + bytes(21), "claims 24 of 23"),
        (b"\x11\xff" + bytes(100), "claims 255"),
        (b"\x11\x14" + bytes(18), "not 24"),
        (bytes.fromhex(VECTORS["ig_control33"]), "a second ig_control"),
        (bytes.fromhex(VECTORS["sof33"]), "a second sof"),
        (b"\x75\x02", "too few"),
    ],
)
def test_a_broken_message_gives_what_was_good_and_says_what_was_not(tail: bytes, word: str) -> None:
    message = host_message(golden_bytes(CIGI_33, "sensor_control"), tail)
    assert not message.sound
    assert [packet.name for packet in message.packets] == ["ig_control", "sensor_control"]
    assert word in message.faults[-1]


@pytest.mark.parametrize(
    "data",
    [b"", b"\x01", bytes(24), golden_bytes(CIGI_33, "sensor_control"), bytes(65536), b"\x01\x10" + bytes(14)],
    ids=["empty", "one byte", "zeros", "another packet first", "too long", "3.1 header"],
)
def test_what_is_no_message_gives_nothing_and_a_reason(data: bytes) -> None:
    message = decode_message(data)
    assert (message.dialect, message.packets, message.sound, len(message.faults)) == (None, (), False, 1)


@pytest.mark.parametrize(("at", "value"), [(2, 2), (2, 4), (2, 255), (4, 0x40), (6, 1), (7, 0), (0, 3)])
def test_another_version_or_byte_swap_word_is_refused(at: int, value: int) -> None:
    data = bytearray(first_bytes(CIGI_33))
    data[at] = value
    assert decode_message(bytes(data)).dialect is None


@pytest.mark.parametrize("number", [np.nan, np.inf, -np.inf])
def test_a_number_that_is_not_finite_makes_the_whole_message_unsound(number: float) -> None:
    sensor = golden_bytes(CIGI_33, "sensor_control")
    message = host_message(sensor[:8] + struct.pack("<f", number) + sensor[12:])
    assert not message.sound
    assert "gain" in message.faults[0]


def test_a_value_out_of_its_limits_costs_its_packet_and_no_other() -> None:
    sensor = golden_bytes(CIGI_33, "sensor_control")
    message = host_message(sensor[:8] + struct.pack("<f", 1.5) + sensor[12:], golden_bytes(CIGI_33, "view_definition"))
    assert message.sound
    assert [packet.name for packet in message.packets] == ["ig_control", "view_def"]
    assert message.faults == ("sensor_control: gain of 1.5 is outside 0 to 1",)


# --- strict on sending -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("sensor_control", {"gain": 1.5}),
        ("sensor_control", {"gain": float("nan")}),
        ("sensor_control", {"track_mode": 5}),
        ("sensor_control", {"sensor_id": 256}),
        ("sensor_control", {"sensor_id": 1.5}),
        ("sensor_control", {"gian": 0.5}),
        ("sensor_control", {"gain": "0.5"}),
        ("celestial_sphere_control", {"hour": 24}),
        ("atmosphere_control", {"humidity": 101}),
        ("sof", {"db_number": -129}),
        ("los_response", {"range": float("inf")}),
        ("no_such_packet", {}),
    ],
)
def test_what_a_field_cannot_hold_is_refused_by_name(name: str, values: dict[str, float]) -> None:
    with pytest.raises(InputError, match=next(iter(values), "no_such_packet")):
        make_packet(CIGI_33, name, **values)


def test_messages_begin_with_their_frame_packet_and_fit_one_frame_of_the_network() -> None:
    entity = make_packet(CIGI_33, "entity_control")
    for wrong in ([], [entity], [entity, first_packet()], [first_packet(), first_packet()]):
        with pytest.raises(InputError, match="Start of Frame"):
            encode_message(CIGI_33, wrong)
    with pytest.raises(InputError, match="1472"):
        encode_message(CIGI_33, [first_packet(), *[entity] * 31])
    assert len(encode_message(CIGI_33, [first_packet(), *[entity] * 30])) == 24 + 30 * 48


@pytest.mark.parametrize("text", ["", "a", "abc", "bake: 25 C", "x" * 100])
def test_text_packets_are_padded_to_eight_bytes_and_closed_with_zero(text: str) -> None:
    data = encode_packet(CIGI_33, make_packet(CIGI_33, "image_generator_message", message_id=7, message=text))
    assert len(data) == data[1]
    assert len(data) % 8 == 0
    assert data[4:].rstrip(b"\0") == text.encode()
    assert data.endswith(b"\0")


@pytest.mark.parametrize("text", ["x" * 101, "25 \N{DEGREE SIGN}C", "two\nlines", "zero\0inside"])
def test_text_that_is_not_plain_is_refused(text: str) -> None:
    with pytest.raises(InputError, match="message"):
        encode_packet(CIGI_33, make_packet(CIGI_33, "image_generator_message", message=text))
