"""Vehicles in lines of sight: ranges against analytic geometry, who is looked past, and what a gate loses."""

from dataclasses import replace

import numpy as np
import pytest
from trainer_world import ALTITUDE, AROUND, LATITUDE, LONGITUDE, PLACE, Host
from trainer_world import entity as placed

from sensorsim.trainer.dialect import CIGI_33, CIGI_40
from sensorsim.trainer.fields import Packet
from sensorsim.trainer.vehicle_shape import METAL, box, shape
from sensorsim.trainer.vehicles import built_in_vehicles

MILLIMETRE = 1e-3
TANK, CAR = 2, 3
LENGTH, WIDTH, HEIGHT = 4.0, 2.0, 2.0  # of the car here: a box on the ground [m]
SHAPES = {**built_in_vehicles(), "car": shape("car", [("skin", box((0.0, 0.0, 1.0), (LENGTH, WIDTH, HEIGHT)))])}
NORTH = PLACE.convergence(LATITUDE, LONGITUDE)  # heading of the map's north [deg]


def vehicle(east: float, north: float, heading: float = 0.0, **values: float) -> Packet:
    """Entity Control of car 7 on the ground, by its heading from the map's north."""
    plain = {"entity_id": 7, "entity_type": CAR, "yaw": (heading + NORTH) % 360.0}
    return placed(east, north, 0.0, **(plain | values))


@pytest.fixture
def host() -> Host:
    host = Host(around=replace(AROUND, shapes=SHAPES))
    host.frame(placed(0.0, 0.0, 1.0))
    return host


def geodetic(east: float, north: float, up: float, prefix: str) -> dict[str, float]:
    latitude, longitude, altitude = PLACE.geodetic(np.array([east, north, up]))
    return {f"{prefix}lat_xoff": latitude, f"{prefix}lon_yoff": longitude, f"{prefix}alt_zoff": altitude}


def ask(host: Host, name: str, **values: float) -> list[Packet]:
    host.frame(host.packet(name, **values))
    assert host.said == ()
    return host.frame()[1:]


def look_north(host: Host, **values: float) -> list[Packet]:
    """Meetings of a level ray to the map's north from 1 m above the origin."""
    start = geodetic(0.0, 0.0, 1.0, "source_")
    return ask(host, "los_vector_request", los_id=3, azimuth=NORTH, max_range=1000.0, **(start | values))


def sees(host: Host, end: tuple[float, float, float], **values: float) -> bool:
    places = {**geodetic(0.0, 0.0, 1.0, "source_"), **geodetic(*end, "destination_")}
    answers = ask(host, "los_segment_request", **(places | values))
    return bool(answers[0].values["visible"])


@pytest.mark.parametrize("heading", [0.0, 30.0, 90.0, 200.0])
def test_ranges_to_a_vehicle_are_those_of_its_faces(host: Host, heading: float) -> None:
    """Of a box, by the slabs between its faces."""
    host.frame(vehicle(0.3, 200.0, heading))
    turn = np.radians(heading)
    enter, leave = 0.0, 1000.0
    for axis, half in ((np.array([np.sin(turn), np.cos(turn)]), 0.5 * LENGTH),
                       (np.array([np.cos(turn), -np.sin(turn)]), 0.5 * WIDTH)):  # fmt: skip
        middle, speed = axis @ np.array([-0.3, -200.0]), float(axis[1])
        if abs(speed) > 1e-9:
            ends = sorted(((-half - middle) / speed, (half - middle) / speed))
            enter, leave = max(enter, ends[0]), min(leave, ends[1])
    near, far = look_north(host, type=1)
    assert [packet.values["range"] for packet in (near, far)] == pytest.approx([enter, leave], abs=MILLIMETRE)
    for packet, length in ((near, enter), (far, leave)):
        assert (packet.values["entity_id_valid"], packet.values["entity_id"]) == (1, 7)
        assert packet.values["material_code"] == METAL
        place = PLACE.local(*(float(packet.values[name]) for name in ("lat_xoff", "lon_yoff", "alt_zoff")))
        assert place == pytest.approx([0.0, length, 1.0], abs=MILLIMETRE)


def test_the_normal_of_a_vehicles_face_turns_with_it(host: Host) -> None:
    host.frame(vehicle(0.0, 200.0, 30.0))
    near, _ = look_north(host, type=1)
    side = (30.0 + 90.0 + NORTH + 180.0) % 360.0 - 180.0  # its right side looks south-east
    assert near.values["normal_vector_azimuth"] == pytest.approx(side, abs=2e-3)
    assert near.values["normal_vector_elevation"] == pytest.approx(0.0, abs=1e-5)


def test_short_answers_name_the_entity_and_count_terrain_and_vehicle_by_range(host: Host) -> None:
    """To the east: a car, then the box of the scene."""
    host.frame(vehicle(50.0, 0.0))
    answers = ask(host, "los_vector_request", azimuth=90.0 + NORTH, max_range=200.0, **geodetic(0, 0, 1.0, "source_"))
    assert [packet.values["range"] for packet in answers] == pytest.approx([49.0, 51.0, 100.0, 140.0], abs=MILLIMETRE)
    assert [packet.values["entity_id_valid"] for packet in answers] == [1, 1, 0, 0]
    assert [packet.values["entity_id"] for packet in answers] == [7, 7, 0, 0]
    assert {packet.values["count"] for packet in answers} == {4}


def test_a_vehicle_hides_what_is_behind_it_and_no_more(host: Host) -> None:
    assert sees(host, (0.0, 200.0, 1.0))
    host.frame(vehicle(0.0, 100.0))
    assert not sees(host, (0.0, 200.0, 1.0))
    assert sees(host, (0.0, 200.0, 3.1))  # 2.05 m above the car's middle
    assert sees(host, (3.0, 200.0, 1.0))  # half a metre beside it
    assert sees(host, (0.0, 97.9, 1.0))
    assert not sees(host, (0.0, 98.1, 1.0))


@pytest.mark.parametrize(("state", "kind"), [(0, CAR), (2, CAR), (1, 0), (1, 99)])
def test_what_is_not_drawn_hides_nothing(host: Host, state: int, kind: int) -> None:
    host.frame(vehicle(0.0, 100.0))
    assert not sees(host, (0.0, 200.0, 1.0))
    host.frame(vehicle(0.0, 100.0, entity_state=state, entity_type=kind))
    assert sees(host, (0.0, 200.0, 1.0))


def test_the_vehicle_asked_for_and_the_one_that_looks_are_looked_past(host: Host) -> None:
    to_car = {"destination_entity_id_valid": 1, "destination_entity_id": 7, "destination_coord": 1}
    middle = {"destination_lat_xoff": 0.0, "destination_lon_yoff": 0.0, "destination_alt_zoff": -1.0}
    host.frame(vehicle(0.0, 200.0), vehicle(0.0, 0.0, 0.0, entity_id=0))
    assert sees(host, (0.0, 0.0, 0.0), source_coord=1, entity_id=0, source_lat_xoff=0.0, source_lon_yoff=0.0,
                source_alt_zoff=-1.0, **to_car, **middle)  # fmt: skip
    host.frame(vehicle(0.0, 100.0, entity_id=9))
    (near, *_) = ask(
        host, "los_segment_request", type=1, source_coord=1, entity_id=0, source_alt_zoff=-1.0, **to_car, **middle
    )
    assert (near.values["visible"], near.values["entity_id"]) == (0, 9)
    own = ask(host, "los_vector_request", source_coord=1, entity_id=0, source_alt_zoff=-1.0, max_range=150.0)
    assert [packet.values["entity_id"] for packet in own] == [9, 9]


def test_a_vehicle_that_drives_hides_where_it_is_at_the_frames_time(host: Host) -> None:
    drive = host.packet("rate_control", entity_id=7, x_rate=60.0)  # [m s-1] north: 1 m a frame
    host.frame(vehicle(0.0, 100.0, extrapolation_enable=1), drive, extrapolation_enable=1)
    for _ in range(10):
        host.frame(extrapolation_enable=1)
    places = {**geodetic(0.0, 0.0, 1.0, "source_")}
    host.frame(host.packet("los_vector_request", azimuth=NORTH, max_range=500.0, **places), extrapolation_enable=1)
    answers = host.frame(extrapolation_enable=1)[1:]
    assert answers[0].values["range"] == pytest.approx(98.0 + 12.0, abs=MILLIMETRE)  # twelve frames on


def test_a_gun_hides_only_where_the_turret_points_it(host: Host) -> None:
    """A tank to the east of the ray, heading north; its gun crosses the ray when the turret has turned to the west."""
    host.frame(vehicle(4.0, 100.0, entity_type=TANK))
    eye = geodetic(0.0, 0.0, 2.0, "source_")
    (nothing,) = look_north(host, **eye)
    assert nothing.values["valid"] == 0
    host.frame(host.packet("art_part_control", entity_id=7, part_id=1, part_enable=1, yaw_enable=1, yaw=-90.0))
    answers = look_north(host, **eye)
    assert {packet.values["entity_id"] for packet in answers} == {7}
    assert answers[0].values["range"] == pytest.approx(100.2 - 0.09, abs=0.01)  # a drum of twelve sides


def test_heights_of_terrain_do_not_count_vehicles(host: Host) -> None:
    host.frame(vehicle(0.0, 100.0))
    (hot,) = ask(host, "hat_hot_request", type=1, **geodetic(0.0, 100.0, 10.0, ""))
    assert hot.values["height"] == pytest.approx(ALTITUDE, abs=MILLIMETRE)


@pytest.mark.parametrize("track_mode", [2, 3], ids=["scene", "target"])
def test_a_vehicle_that_passes_before_it_breaks_a_lock(host: Host, track_mode: int) -> None:
    sensor = {"view_id": 0, "sensor_id": 2, "sensor_on_off": 1, "track_mode": track_mode, "response_type": 1}
    down = host.packet("view_control", view_id=0, pitch=-0.5, pitch_enable=1, yaw=-NORTH % 360.0, yaw_enable=1)
    host.frame(down, host.packet("sensor_control", **sensor), placed(0.0, 300.0, 1.0, entity_id=8))
    status = []
    for east in (30.0, 10.0, 0.0, 30.0):
        host.frame(vehicle(east, 60.0))
        status.append(host.frame()[1].values["sensor_status"])
    assert status == [1, 1, 3, 3]


def test_both_versions_of_the_protocol_name_the_vehicle() -> None:
    for dialect in (CIGI_33, CIGI_40):
        host = Host(dialect, around=replace(AROUND, shapes=SHAPES))
        if dialect is CIGI_33:
            host.frame(vehicle(0.0, 100.0))
        else:
            place = geodetic(0.0, 100.0, 0.0, "")
            host.frame(host.packet("entity_control", entity_id=7, entity_state=1, entity_type=CAR),
                       host.packet("entity_position", entity_id=7, **place))  # fmt: skip
        near, _ = look_north(host, type=1)
        assert (near.values["entity_id_valid"], near.values["entity_id"]) == (1, 7)
