"""Frames for display alone against the whole ones, which are the reference; what a moving clock costs; repetition."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from small_world import town

from sensorsim.errors import InputError
from sensorsim.frames import take_frame
from sensorsim.render import Camera, Renderer, look_at
from sensorsim.sensor import DisplaySettings, load_sensor
from sensorsim.tables.coefficient_texture import shade_texels

SIZE = (100, 72)
NOON = 43200.0
VIEWS = {
    "down": look_at([-150.0, -140.0, 60.0], [0.0, 0.0, 5.0], 50.0),
    "across the horizon, rolled": Camera(
        position=np.array([0.0, -260.0, 20.0]), yaw=2.0, pitch=3.0, roll=17.0, horizontal_field_of_view=60.0
    ),
    "upside down": Camera(
        position=np.array([0.0, -260.0, 20.0]), yaw=2.0, pitch=3.0, roll=170.0, horizontal_field_of_view=60.0
    ),
    "nothing but sky": Camera(
        position=np.array([0.0, 0.0, 100.0]), yaw=0.0, pitch=90.0, horizontal_field_of_view=40.0
    ),
    "from under the ground": Camera(
        position=np.array([0.0, -260.0, -5.0]), yaw=2.0, pitch=3.0, horizontal_field_of_view=60.0
    ),
}  # fmt: skip


@pytest.fixture(scope="module")
def renderers() -> Iterator[dict[str, Renderer]]:
    made = {name: Renderer(town(), load_sensor(name), size=SIZE) for name in ("flir", "lltv", "flir1977", "uncooled")}
    yield made
    for renderer in made.values():
        renderer.release()


@pytest.mark.parametrize("time", [0.0, 25200.0, 43999.0, 86400.0])
@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("name", ["flir", "lltv"])
def test_shading_once_a_surface_is_shading_every_pixel(
    renderers: dict[str, Renderer], name: str, view: str, time: float
) -> None:
    """Expected: radiance within 0.5 mK of the whole frame's shaders, the same sky, the same window and codes."""
    renderer = renderers[name]
    quick = renderer.render(VIEWS[view], time, planes=("display",))
    whole = renderer.render(VIEWS[view], time)
    drawn = renderer.render(VIEWS[view], time, planes=("display",))
    assert renderer._quick is not None
    rows = renderer._quick.rows
    np.testing.assert_array_equal(rows.surface, whole.planes["surface_id"] >= 0)
    if renderer.band_table is None:
        assert rows.light == pytest.approx(
            whole.planes["radiance"], rel=2e-5
        )  # near the horizon the shader's rays are off
    else:
        apparent = renderer.band_table.apparent_temperature(rows.light)
        assert np.abs(apparent - whole.planes["apparent_temperature"]).max() < 5e-4
    assert set(quick.planes) == {"display"}
    assert quick.display.level == pytest.approx(whole.display.level, rel=1e-6)
    off = np.abs(quick.planes["display"].astype(int) - whole.planes["display"])
    assert off.max() <= 1
    assert np.mean(off > 0) < 0.01
    np.testing.assert_array_equal(quick.planes["display"], drawn.planes["display"])


@pytest.mark.parametrize("view", ["down", "across the horizon, rolled"])
@pytest.mark.parametrize("name", ["flir1977", "uncooled"])
def test_detector_on_the_processor_shows_what_the_shaders_show(
    renderers: dict[str, Renderer], name: str, view: str
) -> None:
    """Expected: codes that differ by as much as a count or two makes, in one of a hundred pixels at most."""
    renderer = renderers[name]
    quick = renderer.render(VIEWS[view], NOON, frame=3, planes=("display",)).planes["display"]
    whole = renderer.render(VIEWS[view], NOON, frame=3).planes["display"]
    off = np.abs(quick.astype(int) - whole)
    assert off.max() <= 2
    assert np.mean(off > 0) < 0.01
    assert quick.std() > 1.0


def test_frames_are_the_same_bit_for_bit_whatever_was_drawn_before(renderers: dict[str, Renderer]) -> None:
    for name, renderer in renderers.items():
        first = renderer.render(VIEWS["down"], NOON, frame=5, planes=("display",)).planes["display"]
        renderer.render(VIEWS["upside down"], 3600.0, frame=90, planes=("display",))
        renderer.render(VIEWS["down"], 3600.0)
        second = renderer.render(VIEWS["down"], NOON, frame=5, planes=("display",)).planes["display"]
        with Renderer(town(), load_sensor(name), size=SIZE) as fresh:
            third = fresh.render(VIEWS["down"], NOON, frame=5, planes=("display",)).planes["display"]
        np.testing.assert_array_equal(first, second)
        np.testing.assert_array_equal(first, third)


def test_planes_asked_for_are_there_and_no_others(renderers: dict[str, Renderer]) -> None:
    whole = renderers["flir"].render(VIEWS["down"], NOON).planes
    for wanted in (["radiance"], ["display", "range"], ["apparent_temperature"], list(whole)):
        planes = renderers["flir"].render(VIEWS["down"], NOON, planes=wanted).planes
        assert set(planes) == set(wanted)
        for name, plane in planes.items():
            np.testing.assert_array_equal(plane, whole[name])


@pytest.mark.parametrize("planes", [(), ("signal",), ("display", "colour")])
def test_planes_that_a_sensor_has_not_are_refused(renderers: dict[str, Renderer], planes: tuple[str, ...]) -> None:
    with pytest.raises(InputError, match="planes"):
        renderers["flir"].render(VIEWS["down"], NOON, planes=planes)


def test_clock_that_moves_uploads_one_slice_and_frames_for_display_alone_nothing(
    renderers: dict[str, Renderer],
) -> None:
    renderer = renderers["flir"]
    for time in (NOON, 0.0):  # by day the mirrors are called for, and from then on written
        renderer.render(VIEWS["down"], time)
    slice_size = sum(4 * texels.size for texels in shade_texels(town().tables, 0.0).values())
    moment = renderer._moment
    light = sum(4 * moment.textures[name].width * moment.textures[name].height for name in moment.textures
                if name.startswith("sky_") or name in ("mirror_table", "rise_table"))  # fmt: skip
    before = moment.uploaded
    for second in range(1, 20):
        renderer.render(VIEWS["down"], 864.0 * second - 100.0, planes=("display",))
        renderer.render(VIEWS["down"], 864.0 * second)
    assert moment.uploaded - before == 19 * (slice_size + light)
    before = moment.uploaded
    for step in range(10):
        flown = replace(VIEWS["down"], position=VIEWS["down"].position + step)
        renderer.render(flown, 864.0 * 19)
    assert moment.uploaded == before


def test_clock_is_continuous(renderers: dict[str, Renderer]) -> None:
    """Expected: a second changes a pixel by what a slice's change comes to in a second, also across a slice's edge."""
    renderer, table = renderers["flir"], renderers["flir"].band_table
    assert table is not None
    interval = town().tables.time_of_day[1]
    kept = {}
    for time in (0.0, interval - 1.0, interval, interval + 1.0, 2.0 * interval):
        planes = renderer.render(VIEWS["down"], NOON + time, planes=("surface_temperature",)).planes
        kept[time] = planes["surface_temperature"]
    per_second = np.maximum(
        np.abs(kept[interval] - kept[0.0]), np.abs(kept[2.0 * interval] - kept[interval])
    ) / interval  # fmt: skip
    for early, late in ((interval - 1.0, interval), (interval, interval + 1.0)):
        assert np.all(np.abs(kept[late] - kept[early]) <= 1.5 * per_second + 1e-3)
    assert 0.0 < per_second.max() < 0.01


def test_window_that_is_given_is_kept(renderers: dict[str, Renderer]) -> None:
    window = DisplaySettings(level=40.0, span=6.0, polarity="black-hot")
    for name in ("flir", "uncooled"):
        picture = renderers[name].render(VIEWS["down"], NOON, display=window, planes=("display",))
        assert picture.display == window


def test_frame_of_chosen_planes_has_them_and_its_settings(renderers: dict[str, Renderer]) -> None:
    whole = take_frame(renderers["flir"], VIEWS["down"], NOON)
    for wanted in (["display"], ["display", "range"]):
        frame = take_frame(renderers["flir"], VIEWS["down"], NOON, planes=wanted)
        assert set(frame.planes) == set(wanted)
        assert frame.settings["request_sha256"] == whole.settings["request_sha256"]
        off = np.abs(frame.plane("display").data.astype(int) - whole.plane("display").data)
        assert off.max() <= (1 if wanted == ["display"] else 0)
        assert np.mean(off > 0) < 0.01
