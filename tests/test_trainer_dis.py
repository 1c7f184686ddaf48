"""Entity states of DIS against an independent encoder and Wireshark; dead reckoning against motion known in full."""

import json
import struct
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from cigi_samples import run_tshark, write_pcap
from pyproj import Transformer
from trainer_world import PLACE

from sensorsim.errors import InputError
from sensorsim.trainer.appearance import thermal_state
from sensorsim.trainer.dead_reckoning import reckoned
from sensorsim.trainer.dis_listener import SILENCE, DisListener
from sensorsim.trainer.dis_pdu import EntityState, decode_dis, encode_dis
from sensorsim.trainer.rotations import FloatArray, attitude, travelled_faster, turned

VECTORS = json.loads((Path(__file__).parent / "data" / "dis_vectors.json").read_text("utf-8"))["packets"]
NAMES = ("exercise", "identity", "kind", "velocity", "location", "orientation", "appearance", "algorithm")
RUNNING = 1 << 22
CENTRED = Transformer.from_crs("EPSG:4979", "EPSG:4978", always_xy=True)


def located(east: float, north: float, up: float, **values: object) -> EntityState:
    """A tank at a local place, level and heading north there."""
    latitude, longitude, height = PLACE.geodetic(np.array([east, north, up]))
    phi, lam = np.radians([latitude, longitude])
    state = EntityState(
        exercise=1,
        identity=(1, 2, 3),
        force=1,
        kind=(1, 1, 225, 1, 1, 3, 0),
        velocity=(0.0, 0.0, 0.0),
        location=tuple(float(value) for value in CENTRED.transform(longitude, latitude, height)),  # type: ignore[arg-type]
        orientation=_heading_north(phi, lam),
        appearance=RUNNING,
        algorithm=2,
        acceleration=(0.0, 0.0, 0.0),
        angular_velocity=(0.0, 0.0, 0.0),
    )
    return replace(state, **values)  # type: ignore[arg-type]


def _heading_north(phi: float, lam: float) -> tuple[float, float, float]:
    """psi, theta, phi of a body whose axes are north, east, down at a place, by the angles of its own axes."""
    north = np.array([-np.sin(phi) * np.cos(lam), -np.sin(phi) * np.sin(lam), np.cos(phi)])
    east = np.array([-np.sin(lam), np.cos(lam), 0.0])
    down = np.cross(north, east)
    return float(np.arctan2(north[1], north[0])), float(-np.arcsin(north[2])), float(np.arctan2(east[2], down[2]))


# --- packets -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("vector", VECTORS, ids=[vector["marking"] for vector in VECTORS])
def test_an_independent_encoders_packet_is_read_and_written_the_same(vector: dict[str, object]) -> None:
    data = bytes.fromhex(str(vector["hex"]))
    (state,), faults = decode_dis(data)
    assert faults == ()
    for name in (*NAMES, "acceleration", "angular_velocity", "marking"):
        expected = vector[name]
        assert getattr(state, name) == (tuple(expected) if isinstance(expected, list) else expected), name
    assert encode_dis(state) == data


def test_wireshark_reads_the_packets_that_are_written(tmp_path: Path) -> None:
    turn = {"orientation": (0.5, -0.25, 1.125)}  # of six digits, as Wireshark prints them
    states = [located(10.0, 20.0, 30.0, **turn), located(-500.0, 800.0, 0.0, velocity=(1.5, -2.0, 0.25), **turn)]
    write_pcap(tmp_path / "dis.pcap", [(encode_dis(state), 3000) for state in states])
    fields = (
        "proto_ver",
        "pdu_type",
        "pdu_length",
        "entity_location.x",
        "entity_location.z",
        "entity_linear_velocity.y",
        "entity_orientation.psi",
    )
    wanted = [word for field in fields for word in ("-e", f"dis.{field}")]
    lines = run_tshark(
        "-r", str(tmp_path / "dis.pcap"), "-d", "udp.port==3000,dis", "-T", "fields", *wanted
    ).splitlines()
    assert len(lines) == len(states)
    for line, state in zip(lines, states, strict=True):
        values = [float(value) for value in line.split("\t")]
        assert values[:3] == [7.0, 1.0, 144.0]
        expected = [state.location[0], state.location[2], state.velocity[1], state.orientation[0]]
        assert values[3:] == pytest.approx(expected, rel=1e-14)


def test_packets_back_to_back_with_others_and_parts_between_are_all_found() -> None:
    state = located(0.0, 0.0, 0.0)
    plain = encode_dis(state)
    with_parts = bytearray(plain + bytes(32))
    with_parts[19] = 2
    struct.pack_into(">H", with_parts, 8, len(with_parts))
    other = struct.pack(">BBBBIHBB", 7, 1, 20, 5, 0, 40, 0, 0) + bytes(28)
    found, faults = decode_dis(plain + other + bytes(with_parts) + plain)
    assert (len(found), faults) == (3, ())
    assert len(set(found)) == 1


@pytest.mark.parametrize(
    ("at", "code", "value", "word"),
    [
        (0, "B", 3, "version"),
        (8, "H", 10, "claims"),
        (8, "H", 143, "bytes"),
        (8, "H", 65535, "claims"),
        (19, "B", 1, "parts"),
        (36, "f", np.nan, "velocity"),
        (48, "d", np.inf, "location"),
        (48, "d", 1e300, "location"),
        (72, "f", -np.inf, "orientation"),
        (88, "B", 10, "algorithm"),
        (104, "f", 1e30, "acceleration"),
        (116, "f", np.nan, "angular"),
    ],
)
def test_what_no_entity_can_have_is_refused_in_words(at: int, code: str, value: float, word: str) -> None:
    data = bytearray(encode_dis(located(0.0, 0.0, 0.0)))
    struct.pack_into(">" + code, data, at, value)
    listener = DisListener(PLACE)
    faults = listener.receive(bytes(data), 0.0)
    assert word in faults[0]
    assert listener.entities(0.0) == ()


def test_noise_and_cut_packets_raise_nothing_and_add_nothing() -> None:
    listener = DisListener(PLACE)
    whole = encode_dis(located(0.0, 0.0, 0.0))
    rng = np.random.default_rng(2)
    for length in range(len(whole)):
        listener.receive(whole[:length], 0.0)
        listener.receive(rng.bytes(length), 0.0)
    assert listener.entities(0.0) == ()


@pytest.mark.parametrize(
    "values",
    [
        {"marking": "TWELVE CHARS"},
        {"location": (0.0, 0.0, 0.0)},
        {"velocity": (np.nan, 0.0, 0.0)},
        {"identity": (-1, 0, 0)},
    ],
)
def test_what_a_packet_cannot_hold_is_not_sent(values: dict[str, object]) -> None:
    with pytest.raises(InputError):
        encode_dis(located(0.0, 0.0, 0.0, **values))


# --- dead reckoning ----------------------------------------------------------------------------------------------

MOVING = located(
    0.0, 0.0, 100.0, velocity=(30.0, -20.0, 10.0), acceleration=(1.0, 2.0, -3.0), angular_velocity=(0.2, -0.3, 0.5)
)


def stepped(
    state: EntityState, elapsed: float, *, turning: bool, in_body: bool, faster: bool
) -> tuple[FloatArray, FloatArray]:
    """The motion in 20,000 small steps by the midpoint rule."""
    count = 20000
    step = elapsed / count
    psi, theta, phi = np.degrees(state.orientation).tolist()
    axes, position = attitude((psi, theta, phi)), np.array(state.location)
    spin = np.array(state.angular_velocity) if turning else np.zeros(3)
    half, whole = turned(spin, 0.5 * step), turned(spin, step)
    for number in range(count):
        gained = np.array(state.acceleration) * ((number + 0.5) * step) if faster else np.zeros(3)
        velocity = np.array(state.velocity) + gained
        position = position + step * (axes @ half @ velocity if in_body else velocity)
        axes = axes @ whole
    return position, axes


@pytest.mark.parametrize(
    ("algorithm", "turning", "in_body", "faster"),
    [
        (2, False, False, False),
        (3, True, False, False),
        (4, True, False, True),
        (5, False, False, True),
        (6, False, True, False),
        (7, True, True, False),
        (8, True, True, True),
        (9, False, True, True),
    ],
)
def test_each_algorithm_is_its_motion_integrated(algorithm: int, turning: bool, in_body: bool, faster: bool) -> None:
    position, axes = reckoned(replace(MOVING, algorithm=algorithm), 4.0)
    expected, turned_axes = stepped(MOVING, 4.0, turning=turning, in_body=in_body, faster=faster)
    assert position == pytest.approx(expected, abs=2e-5)
    assert axes == pytest.approx(turned_axes, abs=1e-9)


@pytest.mark.parametrize("algorithm", [0, 1])
def test_static_entities_stand_still(algorithm: int) -> None:
    position, axes = reckoned(replace(MOVING, algorithm=algorithm), 100.0)
    assert position.tolist() == list(MOVING.location)
    assert axes == pytest.approx(reckoned(MOVING, 0.0)[1])


@pytest.mark.parametrize("angle", [0.0, 5e-4, 9.99e-4, 1.001e-3, 0.5, 7.0])
def test_the_way_of_an_acceleration_is_continuous_where_its_series_ends(angle: float) -> None:
    """Against Gauss's quadrature of its definition."""
    rate: FloatArray = angle * np.array([2.0, -1.0, 2.0]) / 3.0
    nodes, weights = np.polynomial.legendre.leggauss(40)
    times = 0.5 * (nodes + 1.0)
    expected = sum(0.5 * weight * time * turned(rate, time) for weight, time in zip(weights, times, strict=True))
    assert travelled_faster(rate, 1.0) == pytest.approx(expected, abs=1e-10)


# --- listener ----------------------------------------------------------------------------------------------------


def test_a_tank_stands_where_it_says_and_heads_true_north() -> None:
    listener = DisListener(PLACE, exercise=1)
    assert listener.receive(encode_dis(located(300.0, -400.0, 2.0)), 0.0) == ()
    (tank,) = listener.entities(0.0)
    assert tank.position == pytest.approx((300.0, -400.0, 2.0), abs=1e-3)
    latitude, longitude, _ = PLACE.geodetic(np.array(tank.position))
    heading = -PLACE.convergence(latitude, longitude) % 360.0
    assert tank.angles[0] == pytest.approx(heading, abs=1e-4)
    assert tank.angles[1:] == pytest.approx((0.0, 0.0), abs=1e-4)


def test_it_drives_on_between_packets_and_stops_when_frozen() -> None:
    """15 m/s to the north: Earth-centred velocity along the meridian."""
    start = located(0.0, 0.0, 2.0)
    psi, theta, phi = np.degrees(start.orientation).tolist()
    north = attitude((psi, theta, phi))[:, 0]
    driving = replace(start, velocity=tuple((15.0 * north).tolist()))
    listener = DisListener(PLACE)
    listener.receive(encode_dis(driving), 10.0)
    (tank,) = listener.entities(14.0)
    assert tank.position == pytest.approx((0.0, 60.0, 2.0), abs=0.01)  # 255 m up, the Earth is 4e-5 wider
    assert tank.speed == pytest.approx(15.0, abs=1e-5)
    listener.receive(encode_dis(replace(driving, appearance=RUNNING | 1 << 21)), 10.0)
    assert listener.entities(14.0)[0].position == pytest.approx((0.0, 0.0, 2.0), abs=1e-3)


def test_silent_and_deactivated_entities_are_gone() -> None:
    listener = DisListener(PLACE)
    listener.receive(encode_dis(located(0.0, 0.0, 0.0)), 0.0)
    listener.receive(encode_dis(located(0.0, 0.0, 0.0, identity=(1, 2, 4))), 5.0)
    assert [tank.identity for tank in listener.entities(SILENCE)] == [(1, 2, 3), (1, 2, 4)]
    assert [tank.identity for tank in listener.entities(SILENCE + 1.0)] == [(1, 2, 4)]
    listener.receive(encode_dis(located(0.0, 0.0, 0.0, identity=(1, 2, 4), appearance=1 << 23)), 6.0)
    assert listener.entities(6.0) == ()


def test_other_exercises_other_places_and_too_many_entities_are_left_out() -> None:
    listener = DisListener(PLACE, exercise=1, most_entities=2)
    assert listener.receive(encode_dis(located(0.0, 0.0, 0.0, exercise=2)), 0.0) == ("exercise 2",)
    far = located(0.0, 0.0, 0.0, identity=(9, 9, 9), location=(6378137.0, 0.0, 0.0))
    assert listener.receive(encode_dis(far), 0.0) == ()
    assert listener.entities(0.0) == ()
    for number in range(3):
        listener.receive(encode_dis(located(0.0, 0.0, 0.0, identity=(1, 1, number))), 0.0)
    assert len(listener.entities(0.0)) == 1
    assert listener.refused == 3


# --- appearance --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("bits", "expected"),
    [
        (0, (False, False, False, False, "none", False, True)),
        (1 << 22, (True, False, False, False, "none", False, True)),
        (1 << 22 | 2 << 5, (True, True, False, False, "none", False, True)),
        (1 << 22 | 3 << 5 | 1 << 15, (True, True, True, True, "none", False, True)),
        (1 << 22 | 3 << 3, (False, False, False, False, "destroyed", False, True)),
        (1 << 22 | 1 << 3 | 1 << 21, (True, False, False, False, "slight", True, True)),
        (1 << 22 | 1 << 23, (False, False, False, False, "none", False, False)),
    ],
)
def test_appearance_bits_say_what_is_hot(bits: int, expected: tuple[object, ...]) -> None:
    state = thermal_state(bits, 1)
    found = (state.engine_on, state.engine_smoke, state.plume, state.burning, state.damage, state.frozen, state.active)
    assert found == expected


def test_what_is_no_platform_has_no_engine() -> None:
    person = thermal_state(0xFFFFFFFF & ~(1 << 23), 3)
    assert (person.engine_on, person.burning, person.frozen, person.active) == (False, False, True, True)
