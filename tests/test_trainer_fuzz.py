"""A hundred thousand datagrams of nonsense: nothing raised, nothing changed."""

import gc
import struct
from collections.abc import Iterator

import numpy as np
from cigi_samples import first_packet, sample
from trainer_world import Host, entity

from sensorsim.trainer.dialect import CIGI_33, CIGI_40, Dialect
from sensorsim.trainer.encode import encode_packet
from sensorsim.trainer.fields import ByteOrder

EACH = 20_000  # datagrams of each of five sorts
LONGEST = 65536


def messages(rng: np.random.Generator) -> list[tuple[Dialect, ByteOrder, list[bytes]]]:
    """Sound messages of both versions and orders, packet by packet: what is spoiled below."""
    made: list[tuple[Dialect, ByteOrder, list[bytes]]] = []
    for dialect in (CIGI_33, CIGI_40):
        kinds = [kind for kind in dialect.packets if kind.name not in ("ig_control", "sof")]
        orders: tuple[ByteOrder, ByteOrder] = ("<", ">")
        for order in orders:
            for kind in kinds:
                packets = [first_packet(dialect), sample(dialect, kind, rng)]
                made.append((dialect, order, [encode_packet(dialect, packet, order) for packet in packets]))
    return made


def spoiled(sort: int, dialect: Dialect, order: ByteOrder, packets: list[bytes], rng: np.random.Generator) -> bytes:
    """One datagram: truncated, of size zero or huge, of another version, or with a real that is not finite."""
    first, last = packets
    if sort == 0:
        length = int(rng.integers(0, len(first + last)))
        return (first + last)[: length if length != len(first) else length - 1]  # the first alone is a message
    if sort in (1, 2):
        size = 0 if sort == 1 else int(rng.integers(len(last) + 1, 256 if dialect is CIGI_33 else 65536))
        place, code = (1, "B") if dialect is CIGI_33 else (0, order + "H")
        changed = bytearray(last)
        struct.pack_into(code, changed, place, size)
        return first + bytes(changed)
    if sort == 3:
        changed = bytearray(first)
        changed[2 if dialect is CIGI_33 else 4] = int(rng.choice([0, 1, 2, 5, 200, 255]))
        return bytes(changed) + last
    return first + _not_finite(dialect, order, last, rng)


def _not_finite(dialect: Dialect, order: ByteOrder, packet: bytes, rng: np.random.Generator) -> bytes:
    """The packet with one of its reals made NaN or infinite; cut short where it has none."""
    first, second = struct.unpack_from(order + 2 * dialect.header, packet)
    kind = dialect.by_number[second if dialect.size_first else first]
    places, at = [], dialect.header_size
    for slot in kind.slots:
        if slot.code in "fd" and slot.fields:
            places.append((at, slot.code))
        at += struct.calcsize("=" + slot.code)
    if not places:
        return packet[:-1]
    place, code = places[int(rng.integers(len(places)))]
    changed = bytearray(packet)
    struct.pack_into(order + code, changed, place, float(rng.choice([np.nan, np.inf, -np.inf])))
    return bytes(changed)


def datagrams() -> Iterator[bytes]:
    rng = np.random.default_rng(99)
    sound = messages(rng)
    for sort in range(5):
        for number in range(EACH):
            dialect, order, packets = sound[number % len(sound)]
            yield spoiled(sort, dialect, order, packets, rng)


def test_a_hundred_thousand_spoiled_datagrams_raise_nothing_and_change_nothing() -> None:
    host = Host()
    sensor = host.packet("sensor_control", view_id=0, sensor_id=1, sensor_on_off=1, gain=0.5)
    host.frame(entity(0.0, 0.0, 100.0), sensor)
    state, request = host.ig.state, host.ig.frame_request()
    count = 0
    for data in datagrams():
        assert host.ig.receive(data, host.time), data.hex()
        count += 1
        assert host.ig.state is state, data.hex()
    assert count == 100_000
    assert host.ig.refused >= 100_000
    assert host.ig.frame_request() == request
    assert [packet.name for packet in host.frame()] == ["sof"]
    assert host.said == ()


def test_noise_of_any_length_is_no_message() -> None:
    host = Host()
    host.frame(entity(0.0, 0.0, 100.0))
    state = host.ig.state
    rng = np.random.default_rng(1)
    for length in [*range(200), 1472, 4096, 65507, 65508, LONGEST]:
        for data in (rng.bytes(length), bytes(length), b"\xff" * length):
            assert host.ig.receive(data, host.time)
    assert host.ig.state is state


def test_random_values_in_sound_packets_raise_nothing_and_leave_frames_finite() -> None:
    """Every host packet with values drawn from all that the codec lets through, entities and queries among them."""
    host = Host()
    host.frame(entity(0.0, 0.0, 100.0))
    rng = np.random.default_rng(4)
    kinds = [kind for kind in CIGI_33.packets if 1 < kind.number < 101]
    for _ in range(120):
        packets = [sample(CIGI_33, kinds[int(rng.integers(len(kinds)))], rng) for _ in range(6)]
        host.frame(*packets, extrapolation_enable=1)
        request = host.ig.frame_request()
        numbers = [number for view in request.views for number in (*view.position, *view.angles)]
        numbers += [number for each in request.entities for number in (*each.position, *each.angles)]
        assert np.all(np.isfinite(numbers))


def test_extreme_but_allowed_motion_leaves_frames_finite() -> None:
    host = Host()
    host.frame(
        entity(0.0, 0.0, 1e7, extrapolation_enable=1, yaw=1e6, pitch=-1e6, roll=1e6),
        host.packet(
            "rate_control", entity_id=0, x_rate=1e5, z_rate=-1e5, yaw_rate=1e5, roll_rate=-1e5, coordinate_system=1
        ),
        host.packet("view_control", view_id=0, xoff=1e8, xoff_enable=1),
        extrapolation_enable=1,
    )
    assert host.said == ()
    for hours in (0.001, 1.0, 1000.0):
        host.time += 3600.0 * hours
        host.frame(send=False)
        request = host.ig.frame_request()
        for drawn in (*request.views, *request.entities):
            assert np.all(np.isfinite([*drawn.position, *drawn.angles]))


def test_memory_does_not_grow_with_the_frames() -> None:
    """Frames with a standing question, a tracking sensor and a refusal in each leave no more objects behind."""
    host = Host()
    host.frame(entity(0.0, 0.0, 10.0), host.packet("sensor_control", view_id=0, sensor_on_off=1, track_mode=2))
    question = host.packet("hat_hot_request", hat_hot_id=1, update_period=1, lat_xoff=39.82, lon_yoff=-84.02)
    refused = host.packet("rate_control", entity_id=99)
    sizes = []
    for _ in range(3):
        for _ in range(150):
            host.frame(entity(0.0, 0.0, 10.0), question, refused)
            host.ig.frame_request()
        gc.collect()
        sizes.append(len(gc.get_objects()))
    assert abs(sizes[2] - sizes[1]) < 50  # one packet kept from each frame would be 150


def test_a_host_that_uses_every_number_stays_within_the_limits() -> None:
    host = Host(most_entities=50, most_views=8, most_components=50, most_queries=20)
    host.frame(entity(0.0, 0.0, 10.0))
    for start in range(0, 600, 20):
        numbers = range(start, start + 20)
        host.frame(*[entity(0.0, 0.0, 10.0, entity_id=number) for number in numbers])
        host.frame(*[host.packet("view_control", view_id=number) for number in numbers])
        host.frame(*[host.packet("sensor_control", view_id=0, sensor_id=number % 256) for number in numbers])
        host.frame(*[host.packet("short_component_control", component_id=number) for number in numbers])
        host.frame(*[host.packet("los_vector_request", los_id=number, update_period=255) for number in numbers])
    state = host.ig.state
    assert (len(state.entities), len(state.views), len(state.components), len(state.queries)) == (50, 8, 50, 20)
    assert len(state.sensors) == 8
