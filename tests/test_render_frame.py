"""A whole frame against its twin in NumPy, and what every frame must keep."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from picture_twin import background, emitted, look, pixel_rays, reflected, temperatures, through_air
from small_world import town

from sensorsim.errors import GraphicsError
from sensorsim.render import Camera, Picture, Renderer, look_at
from sensorsim.sensor import DisplaySettings, auto_window, display_code, load_sensor

SIZE = (96, 72)
TIMES = (25200.0, 36000.0, 43999.0, 61200.0)  # [s]: 7 h, 10 h, between slices, 17 h
VIEWS = {
    "from the south-west": look_at([-150.0, -140.0, 60.0], [0.0, 0.0, 5.0], 50.0),
    "from the north-east": look_at([180.0, 160.0, 25.0], [0.0, 0.0, 10.0], 40.0),
    "from above, rolled": Camera(
        position=np.array([5.0, -3.0, 150.0]), yaw=30.0, pitch=-80.0, roll=25.0, horizontal_field_of_view=70.0
    ),
    "across the horizon": Camera(
        position=np.array([0.0, -260.0, 20.0]), yaw=2.0, pitch=3.0, horizontal_field_of_view=60.0
    ),
}


@pytest.fixture(scope="module")
def flir() -> Iterator[Renderer]:
    with Renderer(town(), load_sensor("flir"), size=SIZE) as renderer:
        yield renderer


@pytest.fixture(scope="module")
def lltv() -> Iterator[Renderer]:
    with Renderer(town(), load_sensor("lltv"), size=SIZE) as renderer:
        yield renderer


@pytest.mark.parametrize("name", VIEWS)
def test_every_pixel_shows_the_surface_that_its_ray_meets_first(flir: Renderer, name: str) -> None:
    """Expected: the same surface and range as ray casting, but where a ray passes within 1e-3 of an edge."""
    picture, sight = flir.render(VIEWS[name], 36000.0), look(town(), VIEWS[name], SIZE)
    clear = sight.margin > 1e-3
    assert clear.mean() > 0.9
    np.testing.assert_array_equal(picture.planes["surface_id"][clear], sight.surface[clear])
    np.testing.assert_allclose(picture.planes["range"][clear], sight.range[clear], rtol=2e-5)
    feature = np.where(sight.surface < 0, -1, town().scene.surfaces.feature[sight.surface])
    np.testing.assert_array_equal(picture.planes["feature"][clear], feature[clear])
    code = np.array([wall.code for wall in town().assignment.wall_types])[town().assignment.wall_type]
    material = np.where(sight.surface < 0, -1, code[sight.surface])
    np.testing.assert_array_equal(picture.planes["material"][clear], material[clear])


def _seen(picture: Picture) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pixels that see a surface, those surfaces' rows, and their ranges [m]."""
    seen = picture.planes["surface_id"] >= 0
    rows = picture.planes["surface_id"][seen].astype(np.int64)
    return seen, rows, picture.planes["range"][seen].astype(np.float64)


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("name", VIEWS)
def test_thermal_frame_is_its_twin_within_five_millikelvin(flir: Renderer, name: str, time: float) -> None:
    picture = flir.render(VIEWS[name], time)
    seen, rows, distance = _seen(picture)
    table = flir.band_table
    assert table is not None
    temperature = temperatures(town(), rows, time)
    assert np.abs(picture.planes["surface_temperature"][seen] - temperature).max() < 5e-3
    light = picture.illumination
    view = pixel_rays(VIEWS[name], SIZE)[seen]
    twin = through_air(emitted(town(), rows, time, light, table, view), distance, VIEWS[name], view, light)
    apparent = picture.planes["apparent_temperature"]
    assert np.abs(apparent[seen] - table.apparent_temperature(twin)).max() < 5e-3
    behind = background(VIEWS[name], pixel_rays(VIEWS[name], SIZE), light)[~seen]
    if behind.size:
        assert np.abs(apparent[~seen] - table.apparent_temperature(behind)).max() < 5e-3


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("name", VIEWS)
def test_low_light_frame_is_its_twin(lltv: Renderer, name: str, time: float) -> None:
    """Expected: 1e-5 of the radiance, single precision's share; the same geometry as the thermal frame."""
    picture = lltv.render(VIEWS[name], time)
    seen, rows, distance = _seen(picture)
    light = picture.illumination
    view = pixel_rays(VIEWS[name], SIZE)[seen]
    twin = through_air(reflected(town(), rows, light, view), distance, VIEWS[name], view, light)
    np.testing.assert_allclose(picture.planes["radiance"][seen], twin, rtol=2e-5)
    behind = background(VIEWS[name], pixel_rays(VIEWS[name], SIZE), light)[~seen]
    np.testing.assert_allclose(picture.planes["radiance"][~seen], behind, rtol=2e-5)
    assert "apparent_temperature" not in picture.planes


def test_two_renders_are_the_same_bit_for_bit(flir: Renderer) -> None:
    view = VIEWS["from the south-west"]
    first = flir.render(view, 36000.0)
    flir.render(VIEWS["across the horizon"], 61200.0)
    second = flir.render(view, 36000.0)
    with Renderer(town(), load_sensor("flir"), size=SIZE) as fresh:
        third = fresh.render(view, 36000.0)
    for name, plane in first.planes.items():
        np.testing.assert_array_equal(plane, second.planes[name])
        np.testing.assert_array_equal(plane, third.planes[name])


def test_renderers_that_are_open_together_do_not_disturb_each_other(flir: Renderer, lltv: Renderer) -> None:
    view = VIEWS["from the south-west"]
    thermal, light = flir.render(view, 36000.0), lltv.render(view, 36000.0)
    with Renderer(town(), load_sensor("flir"), size=(20, 10)) as small:
        small.render(view, 36000.0)
        for name, plane in flir.render(view, 36000.0).planes.items():
            np.testing.assert_array_equal(plane, thermal.planes[name])
        small.render(view, 36000.0)
    for name, plane in lltv.render(view, 36000.0).planes.items():
        np.testing.assert_array_equal(plane, light.planes[name])


@pytest.mark.parametrize(
    "settings",
    [
        DisplaySettings(),
        DisplaySettings(polarity="black-hot"),
        DisplaySettings(level=40.0, span=6.0),
        DisplaySettings(level=42.0, span=0.5, polarity="black-hot"),
    ],
)
def test_display_is_the_twin_of_the_sensors_mapping(flir: Renderer, settings: DisplaySettings) -> None:
    """Expected: the same code everywhere, but within 1e-3 of a code's border, where single precision decides."""
    picture = flir.render(VIEWS["across the horizon"], 36000.0, display=settings)
    radiance = picture.planes["radiance"].astype(np.float64)
    twin, shown = display_code(radiance, picture.display), picture.planes["display"]
    level, span = picture.display.level, picture.display.span
    assert level is not None
    assert span is not None
    code = 255.0 * np.clip((radiance - level) / span + 0.5, 0.0, 1.0)
    if picture.display.polarity == "black-hot":
        code = 255.0 - code
    border = np.abs(code + 0.5 - np.round(code + 0.5)) < 1e-3
    np.testing.assert_array_equal(shown[~border], twin[~border])
    assert np.abs(shown.astype(int) - twin).max() <= 1
    assert shown.dtype == np.uint8


def test_automatic_window_goes_by_the_surfaces_and_not_by_the_sky(flir: Renderer) -> None:
    picture = flir.render(VIEWS["across the horizon"], 36000.0)
    seen = picture.planes["surface_id"] >= 0
    assert 0.1 < seen.mean() < 0.9
    level, span = auto_window(picture.planes["radiance"][seen])
    assert (picture.display.level, picture.display.span) == (level, span)
    assert picture.planes["display"][~seen][picture.planes["radiance"][~seen] < level - span / 2.0].max() == 0


def test_view_of_nothing_but_sky_is_a_frame_too(flir: Renderer) -> None:
    up = Camera(position=np.array([0.0, 0.0, 100.0]), yaw=0.0, pitch=90.0, horizontal_field_of_view=40.0)
    picture = flir.render(up, 36000.0)
    assert np.all(picture.planes["surface_id"] == -1)
    assert np.all(picture.planes["feature"] == -1)
    assert np.all(picture.planes["range"] == 0.0)
    assert np.all(picture.planes["surface_temperature"] == 0.0)
    assert picture.planes["display"].min() < picture.planes["display"].max()
    twin = background(up, pixel_rays(up, SIZE), picture.illumination)
    np.testing.assert_allclose(picture.planes["radiance"], twin, rtol=2e-5)


@pytest.mark.parametrize("pitch", [-12.0, 0.0, 9.0])
def test_horizon_lies_where_level_rays_go(flir: Renderer, pitch: float) -> None:
    """With nothing in sight: sky above that row, warmer downwards, and below it the ground plane through the air."""
    away = Camera(position=np.array([0.0, -300.0, 30.0]), yaw=180.0, pitch=pitch, horizontal_field_of_view=50.0)
    picture = flir.render(away, 36000.0)
    assert np.all(picture.planes["surface_id"] == -1)
    half_height = np.tan(np.radians(25.0)) * SIZE[1] / SIZE[0]
    horizon = SIZE[1] / 2.0 * (1.0 + np.tan(np.radians(pitch)) / half_height)
    middle = picture.planes["radiance"][:, SIZE[0] // 2].astype(np.float64)
    above, below = middle[: int(np.floor(horizon))], middle[int(np.ceil(horizon)) :]
    assert np.all(np.diff(above) > 0.0)  # the sky warms towards the horizon
    air = town().environment.at(36000.0).air_temperature
    assert flir.band_table is not None
    assert above[-1] < flir.band_table.radiance_at(air)
    assert np.all(np.diff(np.abs(below - picture.illumination.ground_radiance)) < 0.0)  # ever less air before it
    assert above.size + below.size >= SIZE[1] - 1


def test_camera_inside_a_building_looks_out_through_its_walls(flir: Renderer) -> None:
    """Faces are seen from outside only, so that a camera in a room shows what stands beyond the walls."""
    inside = Camera(position=np.array([-40.0, 0.0, 4.0]), yaw=90.0, pitch=-5.0, horizontal_field_of_view=60.0)
    picture, sight = flir.render(inside, 36000.0), look(town(), inside, SIZE)
    own = town().scene.surfaces.feature == 1
    assert not np.any(own[picture.planes["surface_id"][picture.planes["surface_id"] >= 0]])
    clear = sight.margin > 1e-3
    np.testing.assert_array_equal(picture.planes["surface_id"][clear], sight.surface[clear])


@pytest.mark.parametrize("size", [(1, 1), (1, 37), (41, 1), (7, 5), (33, 95), (200, 3)])
def test_any_size_works_and_shows_what_its_rays_meet(size: tuple[int, int]) -> None:
    view = VIEWS["from the south-west"]
    with Renderer(town(), load_sensor("flir"), size=size) as renderer:
        picture = renderer.render(view, 36000.0)
    sight = look(town(), view, size)
    assert all(plane.shape == (size[1], size[0]) for plane in picture.planes.values())
    clear = sight.margin > 1e-3
    np.testing.assert_array_equal(picture.planes["surface_id"][clear], sight.surface[clear])


@pytest.mark.parametrize("field", [1.0, 100.0, 150.0, 169.0])
def test_nothing_is_cut_off_in_narrow_and_very_wide_fields(field: float) -> None:
    """Rationale: the near plane stands square to the view, so at a picture's corner it is nearer than it says."""
    view = replace(VIEWS["from the south-west"], horizontal_field_of_view=field)
    with Renderer(town(), load_sensor("flir"), size=SIZE) as renderer:
        picture = renderer.render(view, 36000.0)
    sight = look(town(), view, SIZE)
    clear = sight.margin > 1e-3
    np.testing.assert_array_equal(picture.planes["surface_id"][clear], sight.surface[clear])


def test_size_of_nothing_is_refused() -> None:
    with pytest.raises(GraphicsError, match="picture of 0 x 4 pixels"):
        Renderer(town(), load_sensor("flir"), size=(0, 4))
