"""The image generator against the rules of CIGI: modes, handshake, frames, entities, views, sensors, clock and air."""

from datetime import UTC, date, datetime, timedelta

import numpy as np
import pytest
from trainer_world import ALTITUDE, AROUND, LATITUDE, LONGITUDE, NOON, PERIOD, Host, entity

from sensorsim.errors import InputError
from sensorsim.trainer.database import LoadState
from sensorsim.trainer.dialect import CIGI_33, CIGI_40, Dialect
from sensorsim.trainer.encode import encode_message, make_packet
from sensorsim.trainer.host_clock import HostClock, hear_timestamp
from sensorsim.trainer.image_generator import REFUSED, ImageGenerator
from sensorsim.trainer.settings import ImageSettings


@pytest.fixture
def host() -> Host:
    """In operate, its ownship 100 m above the origin heading north."""
    host = Host()
    host.frame(entity(0.0, 0.0, 100.0))
    assert host.said == ()
    return host


# --- modes, handshake, counters ----------------------------------------------------------------------------------


def test_standby_until_told_and_its_frames_are_empty() -> None:
    host = Host()
    (sof,) = host.frame(send=False)
    assert sof.values["ig_mode"] == 0
    assert host.ig.frame_request().views == ()


def test_start_of_frame_counts_and_echoes_the_host_frame(host: Host) -> None:
    for count in range(1, 5):
        sof = host.frame()[0].values
        assert sof["ig_frame_number"] == count
        assert sof["last_host_frame_number"] == 1000 + count - 1
        assert sof["ig_mode"] == 1
        assert sof["timestamp"] == round(count * PERIOD * 1e5)


def test_in_standby_every_packet_but_the_first_is_ignored() -> None:
    host = Host()
    host.frame(entity(0.0, 0.0, 100.0), ig_mode=0)
    assert host.ig.state.entities == {}


def test_entering_standby_forgets_all_that_the_host_said(host: Host) -> None:
    host.frame(
        host.packet("sensor_control", view_id=0, sensor_id=1, sensor_on_off=1, track_mode=2),
        host.packet("atmosphere_control", humidity=50, air_temp=10, visibility_range=5000),
        host.packet("hat_hot_request", hat_hot_id=5, update_period=1, lat_xoff=LATITUDE, lon_yoff=LONGITUDE),
    )
    state = host.ig.state
    assert (len(state.entities), len(state.sensors), len(state.queries)) == (1, 1, 1)
    host.frame(ig_mode=0)
    state = host.ig.state
    assert (state.entities, state.sensors, state.queries, state.air) == ({}, {}, {}, None)
    assert [packet.name for packet in host.frame(ig_mode=0)] == ["sof"]


@pytest.mark.parametrize("mode", [1, 2])
def test_operate_and_debug_are_reported_back(host: Host, mode: int) -> None:
    host.frame(ig_mode=mode)
    assert host.frame()[0].values["ig_mode"] == mode


def test_maintenance_is_not_for_a_host_to_ask(host: Host) -> None:
    before = host.ig.state
    data = bytearray(encode_message(CIGI_33, [make_packet(CIGI_33, "ig_control", ig_mode=1)]))
    data[4] |= 3
    assert host.ig.receive(bytes(data), host.time)
    assert host.ig.state is before


def test_database_number_turns_negative_while_loading_and_positive_when_both_are_done() -> None:
    loading: dict[str, LoadState] = {"state": "loading"}
    host = Host()
    host.ig = ImageGenerator(ImageSettings(start=NOON), AROUND, utc_offset=-5.0, load=lambda _: loading["state"])
    numbers = []
    for frame, asked in enumerate([0, 5, 5, 0, 0, 0, 5, 0, 7, 0, 0]):
        loading["state"] = "ready" if 5 <= frame < 9 else "missing" if frame == 10 else "loading"
        numbers.append(host.frame(db_number=asked)[0].values["db_number"])
    assert numbers == [0, 0, -5, -5, -5, 5, 5, 5, 5, -7, -128]


# --- frames ------------------------------------------------------------------------------------------------------


def test_a_frame_without_message_repeats_the_last_and_is_counted(host: Host) -> None:
    first = host.ig.frame_request()
    assert first.fresh
    host.frame(send=False)
    second = host.ig.frame_request()
    assert not second.fresh
    assert second.views[0].position == first.views[0].position
    host.frame(send=False)
    assert host.ig.late_frames == 1
    host.frame()
    assert host.ig.late_frames == 2


def test_a_message_for_an_earlier_frame_is_taken_but_is_not_fresh(host: Host) -> None:
    host.frame(last_ig_frame_number=host.ig.frame)
    assert not host.ig.frame_request().fresh


def test_time_that_goes_back_is_refused(host: Host) -> None:
    with pytest.raises(InputError, match="time"):
        host.ig.start_frame(-1.0)
    with pytest.raises(InputError, match="time"):
        host.ig.start_frame(float("nan"))


# --- entities ----------------------------------------------------------------------------------------------------


def position(host: Host, number: int = 0) -> tuple[float, float, float]:
    return {request.number: request.position for request in host.ig.frame_request().entities}[number]


def test_without_extrapolation_a_rate_moves_nothing(host: Host) -> None:
    host.frame(entity(0.0, 0.0, 100.0), host.packet("rate_control", entity_id=0, x_rate=60.0))
    before = position(host)
    host.frame(send=False)
    assert position(host) == before


def test_world_rates_carry_an_entity_north_east_and_down_between_messages(host: Host) -> None:
    host.frame(
        entity(0.0, 0.0, 100.0, extrapolation_enable=1),
        host.packet("rate_control", entity_id=0, x_rate=60.0, y_rate=30.0, z_rate=6.0, yaw_rate=90.0),
        extrapolation_enable=1,
    )
    for _ in range(30):
        host.frame(send=False)
    assert position(host) == pytest.approx((15.0, 30.0, 97.0), abs=1e-6)
    (own,) = host.ig.frame_request().entities
    assert own.angles == pytest.approx((45.0, 0.0, 0.0), abs=1e-9)


def test_body_rates_fly_a_circle(host: Host) -> None:
    """60 m/s ahead and 90 deg/s of yaw: after a second a quarter of a circle of radius 60 / (pi / 2)."""
    host.frame(
        entity(0.0, 0.0, 100.0, extrapolation_enable=1),
        host.packet("rate_control", entity_id=0, x_rate=60.0, yaw_rate=90.0, coordinate_system=1),
        extrapolation_enable=1,
    )
    for _ in range(60):
        host.frame(send=False)
    radius = 60.0 / (np.pi / 2.0)
    assert position(host) == pytest.approx((radius, radius, 100.0), abs=1e-6)


def test_a_new_rate_alone_does_not_make_an_entity_jump(host: Host) -> None:
    north = host.packet("rate_control", entity_id=0, x_rate=60.0)
    host.frame(entity(0.0, 0.0, 100.0, extrapolation_enable=1), north, extrapolation_enable=1)
    for _ in range(60):
        host.frame(send=False)
    host.send(host.packet("rate_control", entity_id=0, y_rate=60.0), extrapolation_enable=1)
    assert position(host) == pytest.approx((0.0, 60.0, 100.0), abs=1e-4)
    for _ in range(60):
        host.frame(send=False)
    assert position(host) == pytest.approx((60.0, 60.0, 100.0), abs=1e-4)


def test_attached_entities_and_views_follow_their_parent(host: Host) -> None:
    """Ownship heads east and banks 90 degrees right: its right is down, its down is north."""
    host.frame(
        entity(0.0, 0.0, 100.0, yaw=90.0, roll=90.0),
        host.packet(
            "entity_control",
            entity_id=3,
            entity_state=1,
            attach_state=1,
            parent_id=0,
            lat_xoff=10.0,
            lon_yoff=2.0,
            alt_zoff=1.0,
        ),
        host.packet("view_control", view_id=0, entity_id=3, xoff=1.0, xoff_enable=1),
    )
    assert host.said == ()
    assert position(host, 3) == pytest.approx((10.0, 1.0, 98.0), abs=1e-6)
    assert host.ig.frame_request().views[0].position == pytest.approx((11.0, 1.0, 98.0), abs=1e-6)


def test_destroying_a_parent_takes_its_children_and_their_questions(host: Host) -> None:
    child = host.packet("entity_control", entity_id=3, entity_state=1, attach_state=1, parent_id=0, lat_xoff=10.0)
    of_child = host.packet("hat_hot_request", hat_hot_id=1, coordinate_system=1, entity_id=3, update_period=1)
    elsewhere = host.packet("hat_hot_request", hat_hot_id=2, lat_xoff=LATITUDE, lon_yoff=LONGITUDE, update_period=1)
    host.frame(child, of_child, elsewhere)
    host.frame(host.packet("entity_control", entity_id=0, entity_state=2))
    assert host.ig.state.entities == {}
    assert [key[1] for key in host.ig.state.queries] == [2]


@pytest.mark.parametrize(
    "values",
    [
        {"lat_xoff": 95.0, "lon_yoff": 0.0, "entity_state": 1},
        {"lat_xoff": 0.0, "lon_yoff": 400.0, "entity_state": 1},
        {"attach_state": 1, "parent_id": 0, "entity_state": 1},
    ],
    ids=["latitude", "longitude", "its own parent"],
)
def test_a_place_that_is_none_is_refused_and_the_rest_goes_on(host: Host, values: dict[str, float]) -> None:
    before = host.ig.state.entities
    host.frame(host.packet("entity_control", **values), host.packet("view_def", view_id=0, near=5.0, near_enable=1))
    assert len(host.said) == 1
    assert host.ig.state.entities == before
    assert host.ig.state.views[0].near == 5.0
    message = host.frame()[-1]
    assert message.name == "image_generator_message"
    assert "refused" in str(message.values["message"])


def test_more_entities_than_the_limit_are_refused() -> None:
    host = Host(most_entities=2)
    host.frame(*[entity(0.0, 0.0, 10.0, entity_id=number) for number in range(4)])
    assert sorted(host.ig.state.entities) == [0, 1]
    assert len(host.said) == 2


def test_clamped_entities_stand_on_the_highest_surface_and_conformal_ones_lean_with_it(host: Host) -> None:
    latitude, longitude, _ = AROUND.place.geodetic(np.array([325.0, 0.0, 0.0]))
    north = AROUND.place.convergence(latitude, longitude)
    on_box = entity(120.0, 0.0, -ALTITUDE + 1.5, entity_id=1, ground_ocean_clamp=1)
    on_slope = entity(325.0, 0.0, -ALTITUDE, entity_id=2, ground_ocean_clamp=2, yaw=90.0 + north)
    host.frame(on_box, on_slope)
    assert position(host, 1) == pytest.approx((120.0, 0.0, 21.5), abs=1e-6)
    assert position(host, 2) == pytest.approx((325.0, 0.0, 25.0), abs=1e-6)
    leaning = host.ig.frame_request().entities[2]
    assert leaning.angles == pytest.approx((90.0, 45.0, 0.0), abs=1e-5)  # yaw is single


def test_components_and_parts_reach_the_entity(host: Host) -> None:
    host.frame(
        host.packet("component_control", component_id=4, instance_id=0, component_class=0, component_state=2, data_1=7),
        host.packet("art_part_control", entity_id=0, part_id=1, part_enable=1, yaw_enable=1, yaw=30.0, pitch=5.0),
        host.packet("short_art_part_control", entity_id=0, part_id_1=1, dof_select_1=5, dof_1=12.0, part_enable_1=1),
    )
    (own,) = host.ig.frame_request().entities
    assert (own.components[4].state, own.components[4].words[0]) == (2, 7)
    assert own.parts[1].values == {"yaw": 30.0, "pitch": 12.0}


def test_a_turret_turns_on_while_its_tank_is_sent_again_and_again() -> None:
    """60 deg/s for a second, with an Entity Control in every frame; then a new rate takes it from there."""
    host = Host()
    tank = entity(0.0, 0.0, 2.0, extrapolation_enable=1)
    turret = {"entity_id": 0, "part_id": 1, "apply_to_part": 1}
    aim = host.packet("art_part_control", entity_id=0, part_id=1, part_enable=1, yaw_enable=1, yaw=10.0)
    host.frame(tank, aim, host.packet("rate_control", yaw_rate=60.0, **turret), extrapolation_enable=1)
    for _ in range(60):
        host.frame(tank, extrapolation_enable=1)
    (own,) = host.ig.frame_request().entities
    assert own.parts[1].values["yaw"] == pytest.approx(70.0, abs=1e-9)
    host.frame(tank, host.packet("rate_control", yaw_rate=-60.0, **turret), extrapolation_enable=1)
    for _ in range(30):
        host.frame(tank, extrapolation_enable=1)
    (own,) = host.ig.frame_request().entities
    assert own.parts[1].values["yaw"] == pytest.approx(71.0 - 30.0, abs=1e-9)


# --- views and sensors -------------------------------------------------------------------------------------------


def test_view_control_moves_only_what_it_enables(host: Host) -> None:
    host.frame(host.packet("view_control", view_id=0, xoff=2.0, xoff_enable=1, yaw=30.0, yaw_enable=1, pitch=-40.0))
    (view,) = host.ig.frame_request().views
    assert view.position == pytest.approx((0.0, 2.0, 100.0), abs=1e-6)
    assert view.angles == pytest.approx((30.0, 0.0, 0.0), abs=1e-9)


def test_group_control_moves_every_view_of_the_group_and_no_other(host: Host) -> None:
    for number, group in ((1, 4), (2, 4), (3, 5)):
        host.frame(host.packet("view_def", view_id=number, group_id=group))
    host.frame(host.packet("view_control", view_id=3, group_id=4, pitch=-10.0, pitch_enable=1))
    pitches = {view.number: view.angles[1] for view in host.ig.frame_request().views}
    assert pitches == pytest.approx({0: 0.0, 1: -10.0, 2: -10.0, 3: 0.0}, abs=1e-9)


def test_two_views_of_one_sensor_head_look_the_same_way(host: Host) -> None:
    aim = {"yaw": 10.0, "yaw_enable": 1, "pitch": -5.0, "pitch_enable": 1}
    host.frame(host.packet("view_control", view_id=0, **aim), host.packet("view_control", view_id=1, **aim))
    flir, lltv = host.ig.frame_request().views
    assert (flir.position, flir.angles) == (lltv.position, lltv.angles)


@pytest.mark.parametrize(
    ("half_angles", "sides", "left"),
    [
        ("signed", {"left": -10.0, "right": 12.0}, -10.0),
        ("signed", {"left": 10.0, "right": 10.0}, -10.0),
        ("signed", {"left": 2.0, "right": 12.0}, 2.0),
        ("magnitude", {"left": 2.0, "right": 12.0}, -2.0),
    ],
)
def test_half_angles_are_signed_unless_told_or_senseless(
    half_angles: str, sides: dict[str, float], left: float
) -> None:
    host = Host(half_angles=half_angles)
    host.frame(entity(0.0, 0.0, 10.0), host.packet("view_def", view_id=0, left_enable=1, right_enable=1, **sides))
    assert host.ig.state.views[0].left == left
    assert host.ig.state.views[0].right == sides["right"]


@pytest.mark.parametrize(
    "values",
    [
        {"near": 0.0, "near_enable": 1},
        {"near": 10.0, "far": 5.0, "near_enable": 1, "far_enable": 1},
        {"left": -89.0, "left_enable": 1},
        {"projection_type": 1},
    ],
)
def test_views_that_no_sensor_has_are_refused(host: Host, values: dict[str, float]) -> None:
    before = host.ig.state.views
    host.frame(host.packet("view_def", view_id=0, **values))
    assert len(host.said) == 1
    assert host.ig.state.views == before


def test_a_view_of_an_entity_that_is_not_there_is_left_out(host: Host) -> None:
    host.frame(host.packet("view_control", view_id=1, entity_id=77))
    assert [view.number for view in host.ig.frame_request().views] == [0]


def test_sensor_control_reaches_its_view(host: Host) -> None:
    knobs = {"gain": 0.25, "level": 0.75, "ac_coupling": 3.0, "noise": 0.5}
    flags = {"sensor_on_off": 1, "polarity": 1, "line_dropout_enable": 1, "auto_gain": 0, "track_mode": 3}
    host.frame(host.packet("sensor_control", view_id=0, sensor_id=7, **knobs, **flags))
    (sensor,) = host.ig.frame_request().views[0].sensors
    assert (sensor.sensor, sensor.on, sensor.black_hot, sensor.line_dropout, sensor.auto_gain) == (
        7,
        True,
        True,
        True,
        False,
    )
    assert (sensor.gain, sensor.level, sensor.ac_coupling, sensor.noise) == tuple(knobs.values())
    assert sensor.track_mode == "target"


# --- clock and air -----------------------------------------------------------------------------------------------


def test_the_clock_runs_from_its_start_and_from_what_the_host_sets(host: Host) -> None:
    assert host.ig.frame_request().moment == NOON
    for _ in range(60):
        host.frame()
    assert host.ig.frame_request().moment == NOON + timedelta(seconds=1)
    host.frame(
        host.packet("celestial_sphere_control", hour=6, minute=30, date=9031976, date_time_valid=1, ephemeris_enable=1)
    )
    assert host.ig.frame_request().moment == datetime(1976, 9, 3, 6, 30, tzinfo=UTC)


def test_a_held_clock_stands_and_runs_on_from_there(host: Host) -> None:
    host.frame(host.packet("celestial_sphere_control", ephemeris_enable=0))
    held = host.ig.frame_request().moment
    for _ in range(30):
        host.frame()
    assert host.ig.frame_request().moment == held
    host.frame(host.packet("celestial_sphere_control", ephemeris_enable=1))
    host.frame()
    assert abs((host.ig.frame_request().moment - held).total_seconds() - PERIOD) < 2e-6  # a clock of microseconds


def test_host_time_is_of_the_zone_that_it_is_configured_for() -> None:
    host = Host(celestial_utc_offset=-5.0)
    host.frame(host.packet("celestial_sphere_control", hour=6, minute=30, date=2071976, date_time_valid=1))
    assert host.ig.frame_request().moment == datetime(1976, 2, 7, 11, 30, tzinfo=UTC)


@pytest.mark.parametrize("number", [0, 13011976, 2301976, 99999999, 4294967295])
def test_a_date_that_is_none_is_refused(host: Host, number: int) -> None:
    host.frame(host.packet("celestial_sphere_control", date=number, date_time_valid=1))
    assert len(host.said) == 1
    assert host.ig.state.clock.moment == NOON


def test_atmosphere_is_live_in_si_and_asks_once_for_a_bake_until_it_is_done(host: Host) -> None:
    atmosphere = host.packet(
        "atmosphere_control",
        atmospheric_model_enable=1,
        humidity=65,
        air_temp=25.0,
        visibility_range=9000.0,
        horiz_wind=5.0,
        wind_direction=270.0,
        barometric_pressure=1013.25,
    )
    host.frame(atmosphere)
    request = host.ig.frame_request()
    assert request.air is not None
    assert (request.air.path_model, request.air.visibility, request.views[0].visibility) == (True, 9000.0, 9000.0)
    assert (request.air.temperature, request.air.pressure) == pytest.approx((298.15, 101325.0))
    assert request.bake is not None
    assert (request.bake.day, request.bake.air_temperature, request.bake.wind_speed) == (date(1976, 2, 7), 298.15, 5.0)
    frames = [host.frame(atmosphere) for _ in range(5) if host.ig.frame_request()]
    assert [packet.name for frame in frames for packet in frame].count("image_generator_message") == 1
    assert {frame[0].values["ig_status"] for frame in frames} == {1}
    host.ig.bake_done(request.bake)
    assert host.ig.frame_request().bake is None
    assert host.frame()[0].values["ig_status"] == 0


def test_source_radiance_is_asked_for_by_bit_0(host: Host) -> None:
    host.frame(host.packet("atmosphere_control", atmospheric_model_enable=0, visibility_range=5000.0))
    air = host.ig.frame_request().air
    assert air is not None
    assert not air.path_model


def test_a_small_change_of_the_air_asks_for_no_new_bake(host: Host) -> None:
    host.frame(host.packet("atmosphere_control", air_temp=20.0, humidity=50))
    bake = host.ig.frame_request().bake
    assert bake is not None
    host.ig.bake_done(bake)
    host.frame(host.packet("atmosphere_control", air_temp=20.1, humidity=51))
    assert host.ig.frame_request().bake is None
    host.frame(host.packet("atmosphere_control", air_temp=22.0, humidity=51))
    assert host.ig.frame_request().bake is not None


def test_the_next_day_at_the_site_asks_for_its_bake(host: Host) -> None:
    """20 h UTC - 5 h is the same day at the site; 6 h UTC of the next date is the next day there."""
    for hour, day, wanted in ((4, 2081976, None), (6, 2081976, date(1976, 2, 8))):
        host.frame(host.packet("celestial_sphere_control", hour=hour, date=day, date_time_valid=1))
        bake = host.ig.frame_request().bake
        assert (bake.day if bake else None) == wanted


def test_fog_hides_only_those_inside_it(host: Host) -> None:
    fog = {"layer_id": 0, "weather_enable": 1, "visibility_range": 300.0, "base_elevation": ALTITUDE, "thickness": 50.0}
    clear = host.packet("atmosphere_control", visibility_range=20000.0)
    host.frame(clear, host.packet("weather_control", **fog))
    assert host.ig.frame_request().views[0].visibility == 20000.0
    host.frame(entity(0.0, 0.0, 20.0))
    assert host.ig.frame_request().views[0].visibility == 300.0
    host.frame(host.packet("weather_control", **(fog | {"weather_enable": 0})))
    assert host.ig.frame_request().views[0].visibility == 20000.0


def test_rain_and_cloud_are_reported_as_layers_and_asked_for_as_a_bake(host: Host) -> None:
    rain = host.packet("weather_control", layer_id=4, weather_enable=1, severity=3)
    cloud = host.packet("weather_control", layer_id=1, weather_enable=1, coverage=80.0)
    host.frame(rain, cloud)
    request = host.ig.frame_request()
    assert [layer.kind for layer in request.layers] == ["cloud 1", "rain"]
    assert request.bake is not None
    assert (request.bake.cloud_cover, request.bake.precipitation) == (0.8, "rain")


@pytest.mark.parametrize("values", [{"scope": 1}, {"scope": 2}, {"layer_id": 12}])
def test_weather_that_cannot_be_honoured_is_refused(host: Host, values: dict[str, float]) -> None:
    host.frame(host.packet("weather_control", weather_enable=1, **values))
    assert len(host.said) == 1
    assert host.ig.state.layers == {}


# --- asynchronous ------------------------------------------------------------------------------------------------


def test_an_asynchronous_host_is_carried_on_from_its_timestamp() -> None:
    """Messages of 50 m/s that arrive 0 to 8 ms late: the entity moves evenly all the same."""
    host = Host(synchronous=False)
    late = np.random.default_rng(3).uniform(0.0, 0.008, 120)
    late[0] = 0.0
    seen = []
    for number in range(120):
        truth = number * PERIOD
        host.ig.start_frame(truth + 0.010)
        rate = host.packet("rate_control", entity_id=0, x_rate=50.0)
        packets = (entity(0.0, 50.0 * truth, 100.0, extrapolation_enable=1), rate)
        host.time = truth
        ticks = round(truth * 1e5)
        first = make_packet(
            CIGI_33, "ig_control", ig_mode=1, timestamp_valid=1, timestamp=ticks, extrapolation_enable=1
        )
        host.ig.receive(encode_message(CIGI_33, [first, *packets]), truth + late[number])
        seen.append(position(host)[1])
    expected = 50.0 * (np.arange(120) * PERIOD + 0.010)
    assert np.abs(np.array(seen) - expected).max() < 50.0 * 2e-4  # the clock's drift allowance and its ticks


def test_timestamps_wrap_without_a_jump() -> None:
    clock, first = hear_timestamp(HostClock(), 2**32 - 100, 10.0)
    clock, second = hear_timestamp(clock, 900, 10.012)
    assert first == 10.0
    assert second == pytest.approx(10.010, abs=1e-5)


def test_a_host_that_starts_again_is_followed_at_once() -> None:
    clock, _ = hear_timestamp(HostClock(), 5_000_000, 10.0)
    clock, true_at = hear_timestamp(clock, 0, 11.0)
    assert true_at == 11.0


# --- 4.0 ---------------------------------------------------------------------------------------------------------


def test_the_same_flight_in_4_0_gives_the_same_frame(host: Host) -> None:
    new = Host(CIGI_40)
    latitude, longitude, altitude = AROUND.place.geodetic(np.array([0.0, 0.0, 100.0]))
    place = {"lat_xoff": latitude, "lon_yoff": longitude, "alt_zoff": altitude}
    new.frame(new.packet("entity_control", entity_state=1), new.packet("entity_position", **place))
    view = {"view_id": 0, "yaw": 20.0, "yaw_enable": 1}
    sensor = {"view_id": 0, "sensor_id": 1, "sensor_on_off": 1, "gain": 0.5}
    for each in (host, new):
        each.frame(each.packet("view_control", **view), each.packet("sensor_control", **sensor))
        assert each.said == ()
    old_frame, new_frame = host.ig.frame_request(), new.ig.frame_request()
    assert old_frame.views == new_frame.views
    assert old_frame.moment == new_frame.moment
    assert new.frame()[0].values["ig_mode"] == 1


def test_switches_and_parts_of_4_0_reach_the_entity_as_those_of_3_3_do(host: Host) -> None:
    new = Host(CIGI_40)
    new.frame(
        new.packet("entity_control", entity_state=1), new.packet("entity_position", lat_xoff=39.82, lon_yoff=-84.02)
    )
    switch = {"component_id": 1, "instance_id": 0, "component_class": 0, "component_state": 1, "data_2": 9}
    part = {"entity_id": 0, "part_id": 1, "part_enable": 1, "pitch_enable": 1, "pitch": 7.5, "yaw": 5.0}
    rate = {"entity_id": 0, "part_id": 1, "apply_to_part": 1, "yaw_rate": 4.0}
    for each in (host, new):
        each.frame(each.packet("short_component_control", **switch), each.packet("art_part_control", **part))
        each.frame(
            each.packet("component_control", **(switch | {"component_id": 2})), each.packet("rate_control", **rate)
        )
        assert each.said == ()
    (old_entity,), (new_entity,) = host.ig.frame_request().entities, new.ig.frame_request().entities
    assert new_entity.components == old_entity.components
    assert new_entity.components[1].words == (0, 9)
    assert {1: new_entity.parts[1].values, 2: new_entity.parts[1].rates} == {
        1: old_entity.parts[1].values, 2: old_entity.parts[1].rates
    }  # fmt: skip
    assert new_entity.parts[1].values == {"pitch": 7.5}


@pytest.mark.parametrize("dialect", [CIGI_33, CIGI_40], ids=["3.3", "4.0"])
def test_what_is_refused_is_told_in_words(dialect: Dialect) -> None:
    host = Host(dialect)
    host.frame()
    host.frame(host.packet("rate_control", entity_id=77))
    (answer,) = host.frame()[1:]
    assert (answer.name, answer.values["message_id"]) == ("image_generator_message", REFUSED)
    assert "77" in str(answer.values["message"])
    assert "no such entity" in str(answer.values["message"])
