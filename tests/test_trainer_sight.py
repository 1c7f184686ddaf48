"""Ranges, heights, normals and the tracking gate against analytic geometry."""

import numpy as np
import pytest
from numpy.typing import NDArray
from pyproj import Geod, Proj
from trainer_world import ALTITUDE, AROUND, BRICK, GRASS, LATITUDE, LONGITUDE, PLACE, SLATE, Host, entity

from sensorsim.scene import load_scene
from sensorsim.trainer.fields import Packet
from sensorsim.trainer.local_place import LocalPlace, geodetic_from_geocentric, scene_place
from sensorsim.trainer.rotations import angles_of, attitude, travelled, turned
from sensorsim.trainer.terrain import build_terrain, height_of_terrain, ray_hits, terrain_from_triangles

MILLIMETRE = 1e-3


@pytest.fixture
def host() -> Host:
    host = Host()
    host.frame(entity(0.0, 0.0, 10.0))
    return host


def geodetic(east: float, north: float, up: float, prefix: str = "") -> dict[str, float]:
    latitude, longitude, altitude = PLACE.geodetic(np.array([east, north, up]))
    return {f"{prefix}lat_xoff": latitude, f"{prefix}lon_yoff": longitude, f"{prefix}alt_zoff": altitude}


def ask(host: Host, name: str, **values: float) -> list[Packet]:
    """Answers in the frame after the one that the question came with."""
    host.frame(host.packet(name, **values))
    assert host.said == ()
    return host.frame()[1:]


# --- rotations and places ----------------------------------------------------------------------------------------


def test_angles_come_back_from_their_attitude() -> None:
    rng = np.random.default_rng(5)
    for yaw, pitch, roll in zip(
        rng.uniform(0, 360, 200), rng.uniform(-89, 89, 200), rng.uniform(-179, 179, 200), strict=True
    ):
        assert angles_of(attitude((yaw, pitch, roll))) == pytest.approx((yaw, pitch, roll), abs=1e-9)


@pytest.mark.parametrize("pitch", [-90.0, 90.0])
def test_straight_up_and_down_keep_the_attitude(pitch: float) -> None:
    matrix = attitude((40.0, pitch, 25.0))
    assert attitude(angles_of(matrix)) == pytest.approx(matrix, abs=1e-9)


@pytest.mark.parametrize("speed", [0.0, 1e-9, 1e-4, 9e-4, 1.1e-3, 0.3, 4.0])
def test_a_steady_turn_is_the_exponential_and_its_integral(speed: float) -> None:
    """Against many small steps of the midpoint rule."""
    rate: NDArray[np.float64] = speed * np.array([0.48, -0.6, 0.64])
    steps = 4000
    rotation, way = np.eye(3), np.zeros((3, 3))
    half, whole = turned(rate, 0.5 / steps), turned(rate, 1.0 / steps)
    for _ in range(steps):
        way += rotation @ half / steps
        rotation = rotation @ whole
    assert turned(rate, 1.0) == pytest.approx(rotation, abs=1e-11)
    assert travelled(rate, 1.0) == pytest.approx(way, abs=3e-7)
    assert rotation @ rotation.T == pytest.approx(np.eye(3), abs=1e-11)


def test_convergence_is_the_projections_own() -> None:
    projection = Proj(proj="tmerc", lon_0=LONGITUDE, lat_0=LATITUDE, k=1.0, ellps="WGS84")
    for latitude, longitude in ((LATITUDE, LONGITUDE + 0.2), (LATITUDE + 0.2, LONGITUDE - 0.3)):
        factors = projection.get_factors(longitude, latitude)
        assert PLACE.convergence(latitude, longitude) == pytest.approx(factors.meridian_convergence, abs=1e-6)


def test_a_true_heading_leads_along_the_meridian(host: Host) -> None:
    """20 km east of the origin north of the map is 0.15 degrees from true north; the pose is turned by as much."""
    longitude = LONGITUDE + 0.2335
    host.frame(
        host.packet(
            "entity_control", entity_id=0, entity_state=1, lat_xoff=LATITUDE, lon_yoff=longitude, alt_zoff=300.0
        )
    )
    (own,) = host.ig.frame_request().entities
    ahead, _, _ = Geod(ellps="WGS84").fwd(longitude, LATITUDE, 0.0, 100.0)
    there = PLACE.local(LATITUDE + 100.0 / 111035.0, ahead, 300.0)
    bearing = np.degrees(np.arctan2(there[0] - own.position[0], there[1] - own.position[1]))
    assert abs(bearing) > 0.1
    assert (own.angles[0] - bearing + 180.0) % 360.0 - 180.0 == pytest.approx(0.0, abs=1e-4)


def test_earth_centred_coordinates_become_geodetic() -> None:
    """A point on the equator, one on the axis, and the ellipsoid's own formula between."""
    a, e2 = 6378137.0, 6.69437999014e-3
    assert geodetic_from_geocentric(a + 100.0, 0.0, 0.0) == pytest.approx((0.0, 0.0, 100.0), abs=1e-6)
    phi, lam, h = np.radians(LATITUDE), np.radians(LONGITUDE), 300.0
    n = a / np.sqrt(1.0 - e2 * np.sin(phi) ** 2)
    xyz = (n + h) * np.cos(phi) * np.cos(lam), (n + h) * np.cos(phi) * np.sin(lam), (n * (1.0 - e2) + h) * np.sin(phi)
    assert geodetic_from_geocentric(*xyz) == pytest.approx((LATITUDE, LONGITUDE, h), abs=1e-6)


# --- rays --------------------------------------------------------------------------------------------------------


def test_ranges_to_a_tilted_plane_are_those_of_its_equation() -> None:
    rng = np.random.default_rng(11)
    normal = np.array([0.6, 0.0, 0.8])
    along, across = np.array([0.8, 0.0, -0.6]), np.array([0.0, 1.0, 0.0])
    sheet = 20000.0 * np.array([-along - across, along - across, along + across, -along + across]) + 50.0 * normal
    terrain = terrain_from_triangles(sheet[[[0, 1, 2], [0, 2, 3]]], np.array([1, 1]))
    for _ in range(300):
        origin = rng.uniform(-500.0, 500.0, 3) + 900.0 * normal
        direction = rng.normal(size=3)
        direction /= np.linalg.norm(direction)
        if direction @ normal > -0.3:
            continue
        expected = (50.0 - origin @ normal) / (direction @ normal)
        (hit,) = ray_hits(terrain, origin, direction, 0.0, 1e6)
        assert hit.range == pytest.approx(expected, abs=1e-7)
        assert hit.normal == pytest.approx(normal, abs=1e-12)


def test_a_ray_through_shared_edges_and_corners_is_met_once() -> None:
    """Both the diagonal of the ground and the middle where four triangles meet."""
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 0]], dtype=np.float64)
    terrain = terrain_from_triangles(corners[[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]], np.zeros(4, dtype=np.int64))
    for east, north in ((0.0, 0.0), (0.5, 0.5), (-0.25, 0.25), (1.0, 0.0), (-1.0, -1.0)):
        hits = ray_hits(terrain, np.array([east, north, 5.0]), np.array([0.0, 0.0, -1.0]), 0.0, 10.0)
        assert [hit.range for hit in hits] == [5.0]


@pytest.mark.parametrize(
    ("up", "direction"), [(30.0, [0.0, 0.0, 1.0]), (0.0, [0.0, 1.0, 0.0]), (60.0, [1.0, 0.0, 0.0])]
)
def test_a_ray_that_meets_nothing_gives_nothing(up: float, direction: list[float]) -> None:
    """Away from the ground, along it, and above all of it."""
    assert ray_hits(AROUND.terrain, np.array([0.0, 0.0, up]), np.array(direction), 0.0, np.inf) == []


def test_an_empty_scene_has_no_height() -> None:
    empty = terrain_from_triangles(np.zeros((0, 3, 3)), np.zeros(0, dtype=np.int64))
    assert height_of_terrain(empty, 0.0, 0.0) is None
    assert ray_hits(empty, np.zeros(3), np.array([0.0, 0.0, -1.0]), 0.0, 1.0) == []


def test_roofs_of_the_hospital_are_as_high_as_its_features_say() -> None:
    """From above, the middle of every convex roof that nothing covers is met at the feature's top."""
    scene = load_scene("hospital", level="IIIB")
    terrain = build_terrain(scene)
    seen = 0
    for feature in scene.features:
        for part in feature.parts:
            corners = scene.frame.metres_from_degrees(part.footprint)
            if part.is_plane or part.holes or len(corners) != 4:
                continue
            hit = height_of_terrain(terrain, *corners.mean(axis=0))
            assert hit is not None
            assert hit.height >= part.top - MILLIMETRE
            seen += abs(hit.height - part.top) < MILLIMETRE
    assert seen > 20
    assert scene_place(scene) == LocalPlace(frame=scene.frame, altitude=255.0)


# --- HAT and HOT -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("east", "north", "up", "height", "material"),
    [
        (0.0, 0.0, 50.0, 0.0, GRASS),
        (120.0, 10.0, 50.0, 20.0, SLATE),
        (330.0, 5.0, 80.0, 30.0, SLATE),
        (5.0, 5.0, -3.0, 0.0, GRASS),
    ],
    ids=["ground", "roof", "slope", "below ground"],
)
def test_heights_and_material_are_those_of_the_terrain(
    host: Host, east: float, north: float, up: float, height: float, material: int
) -> None:
    place = geodetic(east, north, up)
    (hat,) = ask(host, "hat_hot_request", hat_hot_id=1, type=0, **place)
    (hot,) = ask(host, "hat_hot_request", hat_hot_id=2, type=1, **place)
    (both,) = ask(host, "hat_hot_request", hat_hot_id=3, type=2, **place)
    assert (hat.values["type"], hot.values["type"]) == (0, 1)
    assert all(packet.values["valid"] == 1 for packet in (hat, hot, both))
    assert hat.values["height"] == pytest.approx(up - height, abs=MILLIMETRE)
    assert hot.values["height"] == pytest.approx(ALTITUDE + height, abs=MILLIMETRE)
    assert (both.values["hat"], both.values["hot"]) == (hat.values["height"], hot.values["height"])
    assert both.values["material_code"] == material


def test_the_slopes_normal_leans_west_by_45_degrees(host: Host) -> None:
    (answer,) = ask(host, "hat_hot_request", type=2, **geodetic(325.0, 0.0, 90.0))
    azimuth = -90.0 + PLACE.convergence(LATITUDE, LONGITUDE + 325.0 / 85600.0)
    assert answer.values["normal_vector_azimuth"] == pytest.approx(azimuth, abs=1e-4)
    assert answer.values["normal_vector_elevation"] == pytest.approx(45.0, abs=1e-5)


def test_beside_the_scene_there_is_no_height(host: Host) -> None:
    (answer,) = ask(host, "hat_hot_request", type=1, **geodetic(5000.0, 0.0, 90.0))
    assert answer.values["valid"] == 0


def test_heights_below_an_entitys_own_point(host: Host) -> None:
    (answer,) = ask(host, "hat_hot_request", coordinate_system=1, entity_id=0, lon_yoff=120.0, alt_zoff=-40.0)
    assert answer.values["height"] == pytest.approx(50.0 - 20.0, abs=MILLIMETRE)
    (nobody,) = ask(host, "hat_hot_request", coordinate_system=1, entity_id=9)
    assert nobody.values["valid"] == 0


def test_a_question_with_a_period_is_answered_every_so_many_frames_until_taken_back(host: Host) -> None:
    place = geodetic(0.0, 0.0, 10.0)
    host.frame(host.packet("hat_hot_request", hat_hot_id=4, update_period=3, **place))
    answered = [len(host.frame()) - 1 for _ in range(9)]
    assert answered == [1, 0, 0, 1, 0, 0, 1, 0, 0]
    host.frame(host.packet("hat_hot_request", hat_hot_id=4, update_period=0, **place))
    assert [len(host.frame()) - 1 for _ in range(6)] == [1, 0, 0, 0, 0, 0]


def test_answers_carry_the_low_bits_of_the_host_frame(host: Host) -> None:
    host.frame(host.packet("hat_hot_request", **geodetic(0.0, 0.0, 10.0)), host_frame_number=0x12345)
    assert host.frame()[1].values["host_frame_number_lsn"] == 5


def test_many_questions_are_answered_over_several_frames_and_none_is_lost() -> None:
    host = Host(queries_per_frame=16)
    host.frame(entity(0.0, 0.0, 10.0))
    questions = [
        host.packet("hat_hot_request", hat_hot_id=number, type=2, **geodetic(0.0, 0.0, 9.0)) for number in range(40)
    ]
    host.frame(*questions)
    frames = [[packet.values["hat_hot_id"] for packet in host.frame()[1:]] for _ in range(6)]
    assert [len(frame) for frame in frames] == [16, 16, 8, 0, 0, 0]
    assert [number for frame in frames for number in frame] == list(range(40))


def test_answers_that_do_not_fit_one_message_go_with_the_next() -> None:
    """Sixty questions for one frame: 36 answers of 40 bytes fit beside a Start of Frame in 1472."""
    host = Host()
    place = geodetic(0.0, 0.0, 9.0)
    host.frame(*[host.packet("hat_hot_request", hat_hot_id=number, type=2, **place) for number in range(40)])
    host.send(*[host.packet("hat_hot_request", hat_hot_id=number, type=2, **place) for number in range(40, 60)])
    frames = [[packet.values["hat_hot_id"] for packet in host.frame()[1:]] for _ in range(3)]
    assert [len(frame) for frame in frames] == [36, 24, 0]
    assert frames[0] + frames[1] == list(range(60))


# --- line of sight -----------------------------------------------------------------------------------------------


def segment(start: tuple[float, float, float], end: tuple[float, float, float], **values: float) -> dict[str, float]:
    return {**geodetic(*start, prefix="source_"), **geodetic(*end, prefix="destination_"), **values}


@pytest.mark.parametrize("height", [1.0, 10.0, 19.9])
def test_the_box_stands_between(host: Host, height: float) -> None:
    near, far = ask(host, "los_segment_request", los_id=3, **segment((0.0, 0.0, height), (200.0, 0.0, height)))
    assert [packet.values["range"] for packet in (near, far)] == pytest.approx([100.0, 140.0], abs=MILLIMETRE)
    assert {packet.values["count"] for packet in (near, far)} == {2}
    assert {(packet.values["valid"], packet.values["visible"]) for packet in (near, far)} == {(1, 0)}


def test_above_the_box_the_end_is_seen(host: Host) -> None:
    (answer,) = ask(host, "los_segment_request", **segment((0.0, 0.0, 20.1), (200.0, 0.0, 20.1)))
    assert (answer.values["valid"], answer.values["visible"]) == (1, 1)


def test_a_segment_to_a_surface_sees_the_surface(host: Host) -> None:
    (answer,) = ask(host, "los_segment_request", **segment((0.0, 0.0, 10.0), (100.0, 3.0, 10.0)))
    assert answer.values["visible"] == 1


def test_extended_answers_say_where_and_on_what(host: Host) -> None:
    near, far = ask(host, "los_segment_request", type=1, **segment((0.0, 0.0, 10.0), (200.0, 30.0, 10.0)))
    for packet, expected in ((near, [100.0, 15.0, 10.0]), (far, [400.0 / 3.0, 20.0, 10.0])):
        place = PLACE.local(*(float(packet.values[name]) for name in ("lat_xoff", "lon_yoff", "alt_zoff")))
        assert place == pytest.approx(expected, abs=MILLIMETRE)
        assert packet.values["range"] == pytest.approx(np.hypot(*expected[:2]), abs=MILLIMETRE)
    assert near.values["material_code"] == far.values["material_code"] == BRICK
    assert near.values["range_valid"] == 1


@pytest.mark.parametrize(
    ("azimuth", "elevation"), [(90.0, 0.0), (85.0, 3.0), (95.0, -2.0), (180.0, -45.0), (0.0, -90.0), (271.0, -0.5)]
)
def test_vector_ranges_are_analytic_to_a_millimetre(host: Host, azimuth: float, elevation: float) -> None:
    eye = np.array([2.0, -1.0, 12.0])
    answers = ask(
        host,
        "los_vector_request",
        azimuth=azimuth,
        elevation=elevation,
        max_range=4000.0,
        **geodetic(*eye, prefix="source_"),
    )
    yaw, rise = np.radians([azimuth - PLACE.convergence(LATITUDE, LONGITUDE + 2.0 / 85600.0), elevation])
    direction = np.array([np.sin(yaw) * np.cos(rise), np.cos(yaw) * np.cos(rise), np.sin(rise)])
    candidates = [(100.0 - eye[0]) / direction[0]] if 80.0 < azimuth < 100.0 else []
    candidates += [-eye[2] / direction[2]] if direction[2] < 0.0 else []
    assert answers[0].values["range"] == pytest.approx(min(candidates), abs=MILLIMETRE)


def test_a_ray_in_an_entitys_axes_starts_and_points_with_it(host: Host) -> None:
    """Heading east, 10 m up, 20 m of offset ahead: the box's wall is 80 m away."""
    north = PLACE.convergence(LATITUDE, LONGITUDE)
    host.frame(entity(0.0, 0.0, 10.0, yaw=90.0 + north))
    answers = ask(
        host, "los_vector_request", type=1, source_coord=1, response_coord=1, source_lat_xoff=20.0, max_range=100.0
    )
    assert answers[0].values["range"] == pytest.approx(80.0, abs=MILLIMETRE)
    assert [answers[0].values[name] for name in ("lat_xoff", "lon_yoff", "alt_zoff")] == pytest.approx(
        [100.0, 0.0, 0.0], abs=MILLIMETRE
    )
    assert (answers[0].values["normal_vector_azimuth"], answers[0].values["normal_vector_elevation"]) == pytest.approx(
        (-90.0, 0.0), abs=2e-3
    )


def test_least_and_greatest_range_leave_surfaces_out(host: Host) -> None:
    eye = geodetic(0.0, 0.0, 10.0, prefix="source_")
    behind = ask(host, "los_vector_request", azimuth=90.0, min_range=110.0, max_range=200.0, **eye)
    assert [packet.values["range"] for packet in behind] == pytest.approx([140.0], abs=MILLIMETRE)
    (nothing,) = ask(host, "los_vector_request", azimuth=90.0, max_range=90.0, **eye)
    assert nothing.values["valid"] == 0


def test_no_direction_and_no_entity_are_answered_as_invalid(host: Host) -> None:
    (same,) = ask(host, "los_segment_request", **segment((0.0, 0.0, 5.0), (0.0, 0.0, 5.0)))
    (nobody,) = ask(host, "los_vector_request", source_coord=1, entity_id=55)
    assert (same.values["valid"], nobody.values["valid"]) == (0, 0)


# --- tracking ----------------------------------------------------------------------------------------------------

TARGET = {"view_id": 0, "sensor_id": 2, "sensor_on_off": 1, "track_mode": 3, "response_type": 1}


def test_the_gate_stands_on_the_entity_and_is_sent_every_frame(host: Host) -> None:
    host.frame(entity(50.0, 500.0, 40.0, entity_id=8), host.packet("sensor_control", **TARGET))
    for _ in range(3):
        (response,) = host.frame()[1:]
        assert response.name == "sensor_ext_response"
        assert response.values["sensor_status"] == 1
        assert (response.values["entity_id_valid"], response.values["entity_id"]) == (1, 8)
        assert response.values["gate_x_pos"] == pytest.approx(np.degrees(np.arctan2(50.0, 500.0)), abs=1e-5)
        assert response.values["gate_y_pos"] == pytest.approx(np.degrees(np.arctan2(30.0, 500.0)), abs=1e-5)
        place = PLACE.local(*(float(response.values[f"track_{name}"]) for name in ("lat", "lon", "alt")))
        assert place == pytest.approx([50.0, 500.0, 40.0], abs=MILLIMETRE)
    host.frame(host.packet("sensor_control", **(TARGET | {"track_mode": 0})))
    assert host.frame()[1:] == []


def test_an_entity_that_leaves_the_field_breaks_the_lock_until_tracking_starts_again(host: Host) -> None:
    status = []
    host.frame(host.packet("sensor_control", **TARGET), entity(0.0, 500.0, 10.0, entity_id=8))
    for east in (0.0, 170.0, 200.0, 0.0):
        host.frame(entity(east, 500.0, 10.0, entity_id=8))
        status.append(host.frame()[1].values["sensor_status"])
    assert status == [1, 2, 3, 3]
    host.frame(host.packet("sensor_control", **(TARGET | {"track_mode": 0})))
    host.frame(host.packet("sensor_control", **TARGET))
    assert host.frame()[1].values["sensor_status"] == 1


def test_what_stands_behind_the_box_is_searched_for_in_vain(host: Host) -> None:
    aim = host.packet("view_control", view_id=0, yaw=90.0, yaw_enable=1)
    host.frame(aim, host.packet("sensor_control", **TARGET), entity(200.0, 0.0, 5.0, entity_id=8))
    assert host.frame()[1].values["sensor_status"] == 0
    host.frame(entity(60.0, 0.0, 5.0, entity_id=8))
    assert host.frame()[1].values["sensor_status"] == 1


def test_scene_tracking_holds_the_point_while_the_eye_moves(host: Host) -> None:
    aim = host.packet("view_control", view_id=0, pitch=-10.0, pitch_enable=1)
    host.frame(aim, host.packet("sensor_control", **(TARGET | {"track_mode": 2})))
    away = 10.0 / np.tan(np.radians(10.0))
    first = host.frame(entity(5.0, 0.0, 10.0))[1].values
    second = host.frame()[1].values
    assert (first["gate_x_pos"], first["gate_y_pos"]) == pytest.approx((0.0, 0.0), abs=1e-4)
    assert second["gate_x_pos"] == pytest.approx(-np.degrees(np.arctan2(5.0, np.hypot(away, 10.0))), abs=1e-4)
    assert (first["track_lat"], first["track_lon"]) == (second["track_lat"], second["track_lon"])
