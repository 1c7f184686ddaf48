"""Frames that a host asked for, drawn from a small town: views, sensors, knobs, clock, air and new worlds."""

from collections.abc import Iterator
from dataclasses import replace
from datetime import UTC, date, datetime, timedelta
from threading import Event

import numpy as np
import pytest
from numpy.typing import NDArray
from small_world import town
from trainer_world import Host

from sensorsim.environment import read_weather
from sensorsim.errors import InputError
from sensorsim.render import Camera, Renderer, World
from sensorsim.sensor import load_sensor
from sensorsim.trainer.background_bake import BackgroundBake, Baked
from sensorsim.trainer.bake_request import BakeRequest
from sensorsim.trainer.delivery import pixels_of
from sensorsim.trainer.frame_request import FrameRequest, ViewRequest
from sensorsim.trainer.host_state import Air, SensorState
from sensorsim.trainer.host_weather import host_weather
from sensorsim.trainer.scene_pictures import ScenePictures, time_of_day
from sensorsim.trainer.view_camera import mirrored, view_camera

SIZE = (64, 48)
SENSORS = (load_sensor("flir"), load_sensor("lltv"))
MORNING = town().environment.image_start + timedelta(hours=10)
VIEW = ViewRequest(
    number=0, view_type=0, position=(-150.0, -140.0, 60.0), angles=(46.0, -15.0, 0.0), left=-25.0, right=25.0,
    bottom=-19.0, top=19.0, near=1.0, far=1e4, mirror=0, visibility=None, sensors=(),
)  # fmt: skip
AIR = Air(
    path_model=True, relative_humidity=0.5, temperature=280.0, visibility=2e4, wind_speed=2.0, updraught=0.0,
    wind_from=0.0, pressure=1e5,
)  # fmt: skip


def frame(*views: ViewRequest, **values: object) -> FrameRequest:
    plain: dict[str, object] = {
        "frame": 7, "host_frame": 1, "time": 0.0, "fresh": True, "moment": MORNING, "sun": True, "entities": (),
        "air": None, "layers": (), "bake": None,
    }  # fmt: skip
    return FrameRequest(views=views or (VIEW,), **(plain | values))  # type: ignore[arg-type]


def knobs(**values: object) -> ViewRequest:
    return replace(VIEW, sensors=(SensorState(view=0, sensor=0, **values),))  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def pictures() -> Iterator[ScenePictures]:
    with ScenePictures(town(), SENSORS, SIZE, planes=None) as source:
        yield source


def plain(sensor: int, camera: Camera, seconds: float, **options: str) -> NDArray[np.float32]:
    with Renderer(town(), SENSORS[sensor], size=SIZE, **options) as renderer:  # type: ignore[arg-type]
        return np.asarray(renderer.render(camera, seconds).planes["radiance"])


def test_a_view_is_drawn_from_its_place_at_the_hosts_time(pictures: ScenePictures) -> None:
    camera = Camera(position=np.array(VIEW.position), yaw=46.0, pitch=-15.0, roll=0.0, horizontal_field_of_view=50.0)
    seen = pictures(frame())[0]["radiance"]
    np.testing.assert_array_equal(seen, plain(0, camera, 36000.0))
    later = pictures(frame(moment=MORNING + timedelta(hours=3)))[0]["radiance"]
    np.testing.assert_array_equal(later, plain(0, camera, 46800.0))
    assert np.abs(later - seen).max() > 0.01


@pytest.mark.parametrize(
    "words",
    [{}, {"auto_gain": False, "gain": 0.1, "level": 0.7}, {"auto_gain": False, "gain": 0.2, "level": 0.8},
     {"noise": 0.4}, {"ac_coupling": 20.0, "noise": 0.1, "line_dropout": True}],
)  # fmt: skip
def test_black_hot_is_the_exact_mirror_of_white_hot(pictures: ScenePictures, words: dict[str, object]) -> None:
    white = pictures(frame(knobs(**words)))[0]["display"]
    black = pictures(frame(knobs(black_hot=True, **words)))[0]["display"]
    np.testing.assert_array_equal(black, 255 - white)
    assert white.dtype == np.uint8
    assert np.unique(white).size > 10


def test_gain_widens_contrast_and_level_lightens(pictures: ScenePictures) -> None:
    def shown(**words: object) -> NDArray[np.float64]:
        return pictures(frame(knobs(auto_gain=False, **words)))[0]["display"].astype(np.float64)

    assert shown(gain=0.15, level=0.7).std() > 1.5 * shown(gain=0.0, level=0.7).std()
    assert shown(gain=0.1, level=0.7).mean() > shown(gain=0.1, level=0.6).mean() + 10.0


def test_views_of_one_head_show_each_its_sensor(pictures: ScenePictures) -> None:
    both = pictures(frame(VIEW, replace(VIEW, number=1, view_type=1)))
    assert "apparent_temperature" in both[0]
    assert "apparent_temperature" not in both[1]
    chosen = pictures(frame(replace(VIEW, sensors=(SensorState(view=0, sensor=1),))))
    np.testing.assert_array_equal(chosen[0]["radiance"], both[1]["radiance"])


def test_a_plane_that_only_one_sensor_of_a_head_has_keeps_the_other_from_nothing() -> None:
    with ScenePictures(town(), SENSORS, SIZE, planes=("display", "apparent_temperature")) as source:
        source.prepare(range(2))
        both = source(frame(VIEW, replace(VIEW, number=1, view_type=1)))
    assert [set(both[view]) for view in (0, 1)] == [{"display", "apparent_temperature"}, {"display"}]
    assert both[1]["display"].max() > 0


def test_the_first_sensor_that_is_on_is_shown_and_without_one_the_view_is_black(pictures: ScenePictures) -> None:
    off, on = SensorState(view=0, sensor=0, on=False), SensorState(view=0, sensor=1)
    shown = pictures(frame(replace(VIEW, sensors=(off, on))))[0]
    assert "apparent_temperature" not in shown
    assert pictures(frame(replace(VIEW, sensors=(off,))))[0]["display"].max() == 0


def test_what_cannot_be_shown_is_black_or_the_first_sensor_and_said_once() -> None:
    said: list[str] = []
    with ScenePictures(town(), SENSORS[:1], SIZE, planes=None, say=said.append) as source:
        wide = replace(VIEW, left=-85.0, right=85.0)
        for _ in range(3):
            assert source(frame(wide))[0]["display"].max() == 0
            assert source(frame(replace(VIEW, view_type=5)))[0]["display"].max() > 0
    assert len(said) == 2
    assert "horizontal_field_of_view" in said[0]
    assert "no sensor 5" in said[1]


def test_a_view_from_the_edge_of_the_map_does_not_end_the_session() -> None:
    said: list[str] = []
    with ScenePictures(town(), SENSORS[:1], SIZE, planes=None, say=said.append) as source:
        for place in ((5e5, -5e5, 4e5), (0.0, 0.0, -500.0), (0.0, 0.0, -5e5), (5e5, 5e5, 2.0)):
            planes = source(frame(replace(VIEW, position=place)))[0]
            assert planes["display"].shape == (48, 64)
            assert "radiance" not in planes or np.isfinite(planes["radiance"]).all()
        assert all("view 0 is black" in text for text in said)


def test_a_view_beside_its_axis_looks_at_the_middle_of_its_field() -> None:
    middle = view_camera(replace(VIEW, left=-10.0, right=30.0, bottom=5.0, top=15.0, angles=(90.0, 0.0, 0.0)))
    assert (middle.yaw, middle.pitch, middle.roll) == pytest.approx((100.0, 10.0, 0.0))
    assert middle.horizontal_field_of_view == 40.0


def test_a_mirror_turns_the_picture_round() -> None:
    picture = np.arange(6, dtype=np.uint8).reshape(2, 3)
    assert [mirrored(picture, mode).ravel().tolist() for mode in range(4)] == [
        [0, 1, 2, 3, 4, 5], [2, 1, 0, 5, 4, 3], [3, 4, 5, 0, 1, 2], [5, 4, 3, 2, 1, 0]
    ]  # fmt: skip


def test_source_radiance_is_seen_through_no_air(pictures: ScenePictures) -> None:
    camera = view_camera(VIEW)
    source = pictures(
        frame(air=replace(AIR, path_model=False, temperature=town().environment.at(36000.0).air_temperature))
    )
    through = pictures(frame(air=AIR))[0]["radiance"]
    seen = source[0]["surface_id"] >= 0
    np.testing.assert_allclose(
        source[0]["surface_temperature"][seen], pictures(frame())[0]["surface_temperature"][seen], atol=1e-3
    )
    assert np.abs(through - source[0]["radiance"])[seen].max() > 1e-3
    bare = plain(0, camera, 36000.0, atmosphere="none")
    assert np.abs(bare - source[0]["radiance"])[seen].max() < 0.05 * np.ptp(bare[seen])


def test_fog_takes_the_contrast_of_the_low_light_picture(pictures: ScenePictures) -> None:
    def contrast(visibility: float | None) -> float:
        planes = pictures(frame(replace(VIEW, view_type=1, visibility=visibility)))[0]
        seen = planes["radiance"][planes["surface_id"] >= 0]
        return float(seen.std() / seen.mean())

    assert contrast(200.0) < 0.6 * contrast(None)


def test_without_its_sun_the_low_light_picture_is_darker(pictures: ScenePictures) -> None:
    lit, unlit = (pictures(frame(replace(VIEW, view_type=1), sun=sun))[0]["radiance"] for sun in (True, False))
    assert unlit.mean() < 0.8 * lit.mean()


def test_a_moment_of_another_day_is_its_time_of_the_baked_day() -> None:
    midnight = town().environment.image_start
    assert time_of_day(midnight + timedelta(days=3, hours=5), midnight) == 18000.0
    assert time_of_day(midnight - timedelta(hours=1), midnight) == 82800.0
    assert time_of_day((midnight + timedelta(hours=2)).astimezone(UTC), midnight) == 7200.0


def test_a_new_world_is_baked_beside_the_frames_and_taken_in_whole() -> None:
    may_end, told = Event(), list[Baked]()
    other = replace(town(), warnings=("another",))

    def bake(wanted: BakeRequest, moment: datetime) -> World:
        assert (wanted.day, moment) == (date(1976, 2, 8), MORNING)
        assert may_end.wait(10.0)
        return other

    wanted = BakeRequest(day=date(1976, 2, 8))
    with ScenePictures(town(), SENSORS[:1], SIZE, bake=BackgroundBake(bake), on_bake=told.append) as source:
        before = source(frame(bake=wanted))[0]["display"]
        assert source.world is town()
        assert told == []
        may_end.set()
        for _ in range(500):
            after = source(frame(bake=wanted))[0]["display"]
            if told:
                break
        assert source.world is other
        assert [done.request for done in told] == [wanted]
        np.testing.assert_array_equal(after, before)


def test_a_bake_that_fails_is_told_and_not_tried_again() -> None:
    tried, told = list[BakeRequest](), list[Baked]()

    def bake(wanted: BakeRequest, _: datetime) -> World:
        tried.append(wanted)
        raise InputError("winter", "day", wanted.day, "not covered", "give a weather file of it")

    with ScenePictures(town(), SENSORS[:1], SIZE, bake=BackgroundBake(bake), on_bake=told.append) as source:
        for _ in range(50):
            source(frame(bake=BakeRequest(day=date(2026, 7, 1))))
        assert source.world is town()
    assert len(tried) == len(told) == 1
    assert "not covered" in told[0].reason
    host = Host()
    host.frame()
    host.ig.bake_refused(told[0].reason)
    said = [packet.values["message"] for packet in host.frame() if packet.name == "image_generator_message"]
    assert len(said) == 1
    assert "not covered" in str(said[0])


def test_the_weather_of_a_bake_has_the_hosts_values_at_its_moment() -> None:
    winter = read_weather("winter")
    wanted = BakeRequest(
        day=date(1976, 2, 7), air_temperature=300.0, relative_humidity=0.4, wind_speed=7.0, wind_from=90.0,
        cloud_cover=1.0, precipitation="snow",
    )  # fmt: skip
    made = host_weather(winter, wanted, MORNING)
    now = np.interp((MORNING - made.start).total_seconds(), made.time, made.air_temperature)
    assert now == pytest.approx(300.0)
    np.testing.assert_allclose(np.diff(made.air_temperature), np.diff(winter.air_temperature), atol=1e-9)
    for name, value in (
        ("relative_humidity", 0.4),
        ("wind_speed", 7.0),
        ("wind_direction", 90.0),
        ("cloud_cover", 1.0),
    ):
        assert np.all(getattr(made, name) == value)
    assert set(made.ground_state) == {"snow"}
    assert np.all(made.precipitation > 0.0)
    assert host_weather(winter, BakeRequest(day=date(1976, 2, 7)), MORNING) is winter


def test_pixels_for_a_ring_are_counts_of_a_hundredth_kelvin() -> None:
    planes = {"display": np.zeros((1, 3), np.uint8), "apparent_temperature": np.array([[0.0, 293.154, 9999.0]])}
    assert pixels_of(planes, "centikelvin").tolist() == [[0, 29315, 65535]]
    with pytest.raises(InputError, match="kind = 'radiance'"):
        pixels_of(planes, "radiance")
    black = {"display": np.zeros((2, 3), np.uint8)}
    assert pixels_of(black, "centikelvin").dtype == np.uint16
