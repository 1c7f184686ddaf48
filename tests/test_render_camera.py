import numpy as np
import pytest
from picture_twin import pixel_rays
from small_world import town

from sensorsim.errors import InputError
from sensorsim.render import Camera, look_at, station_camera
from sensorsim.render.camera import clip_distances
from sensorsim.scene import load_scene

SIZE = (640, 480)


def _camera(yaw: float = 0.0, pitch: float = 0.0, roll: float = 0.0, field: float = 40.0) -> Camera:
    return Camera(
        position=np.array([10.0, -20.0, 30.0]), yaw=yaw, pitch=pitch, roll=roll, horizontal_field_of_view=field
    )


def _pixel(camera: Camera, point: np.ndarray, size: tuple[int, int] = SIZE) -> tuple[float, float, float]:
    """Column, row (from the top) and depth over w of a point [m], by the camera's own matrix."""
    clip = camera.clip_from_camera(size, 1.0, 1000.0) @ np.append(point - camera.position, 1.0)
    x, y, z = clip[:3] / clip[3]
    return (x + 1.0) / 2.0 * size[0], (1.0 - y) / 2.0 * size[1], z


ATTITUDES = [(0.0, 0.0, 0.0), (90.0, 20.0, 0.0), (213.0, -35.0, 17.0), (359.9, 90.0, 5.0), (45.0, -90.0, -60.0)]


@pytest.mark.parametrize(("yaw", "pitch", "roll"), ATTITUDES)
def test_axes_are_orthonormal_and_right_handed(yaw: float, pitch: float, roll: float) -> None:
    axes = np.stack(_camera(yaw, pitch, roll).axes())
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), rtol=0.0, atol=1e-14)
    forward, right, up = axes
    np.testing.assert_allclose(np.cross(right, forward), up, rtol=0.0, atol=1e-14)


def test_angles_mean_what_they_say() -> None:
    """Yaw clockwise from north, pitch up, roll clockwise: the right wing goes down."""
    cases = {
        (0.0, 0.0, 0.0): ([0, 1, 0], [1, 0, 0], [0, 0, 1]),
        (90.0, 0.0, 0.0): ([1, 0, 0], [0, -1, 0], [0, 0, 1]),
        (0.0, 90.0, 0.0): ([0, 0, 1], [1, 0, 0], [0, -1, 0]),
        (0.0, -90.0, 0.0): ([0, 0, -1], [1, 0, 0], [0, 1, 0]),
        (0.0, 0.0, 90.0): ([0, 1, 0], [0, 0, -1], [1, 0, 0]),
    }
    for attitude, axes in cases.items():
        np.testing.assert_allclose(_camera(*attitude).axes(), axes, rtol=0.0, atol=1e-14)


@pytest.mark.parametrize(("yaw", "pitch", "roll"), ATTITUDES)
def test_points_fall_where_their_angles_put_them(yaw: float, pitch: float, roll: float) -> None:
    camera = _camera(yaw, pitch, roll)
    forward, right, up = camera.axes()
    half = np.tan(np.radians(20.0))
    for across, high in ((0.0, 0.0), (half, 0.0), (-half, 0.75 * half), (0.3 * half, -0.2 * half)):
        for distance in (1.0, 50.0, 900.0):
            column, row, _ = _pixel(camera, camera.position + distance * (forward + across * right + high * up))
            assert column == pytest.approx(320.0 * (1.0 + across / half), abs=1e-6)
            assert row == pytest.approx(240.0 * (1.0 - high / (0.75 * half)), abs=1e-6)


def test_near_and_far_plane_are_the_ends_of_the_depth() -> None:
    camera = _camera(30.0, 10.0)
    forward, right, _ = camera.axes()
    for distance, depth in ((1.0, -1.0), (1000.0, 1.0)):
        assert _pixel(camera, camera.position + distance * (forward + 0.1 * right))[2] == pytest.approx(depth, abs=1e-9)


@pytest.mark.parametrize("size", [(640, 480), (1, 1), (31, 200), (200, 7)])
@pytest.mark.parametrize(("yaw", "pitch", "roll"), ATTITUDES)
def test_rays_go_through_the_pixels_that_the_matrix_projects_to(
    yaw: float, pitch: float, roll: float, size: tuple[int, int]
) -> None:
    camera = _camera(yaw, pitch, roll)
    corner, across, high = camera.view_rays(size)
    rays = pixel_rays(camera, size)
    for row, column in ((0, 0), (size[1] - 1, size[0] - 1), (size[1] // 2, size[0] // 3)):
        ray = corner + (column + 0.5) / size[0] * across + (1.0 - (row + 0.5) / size[1]) * high
        np.testing.assert_allclose(ray / np.linalg.norm(ray), rays[row, column], rtol=0.0, atol=1e-12)
        x, y, _ = _pixel(camera, camera.position + 20.0 * ray, size)
        assert (x, y) == pytest.approx((column + 0.5, row + 0.5), abs=1e-6)


@pytest.mark.parametrize("field", [0.5, 20.0, 90.0, 169.0])
def test_field_of_view_is_the_full_angle_across_the_picture(field: float) -> None:
    corner, across, high = _camera(field=field).view_rays(SIZE)
    left, right = corner + 0.5 * high, corner + across + 0.5 * high
    cosine = left @ right / np.linalg.norm(left) / np.linalg.norm(right)
    assert np.degrees(np.arccos(cosine)) == pytest.approx(field, abs=1e-5)
    assert np.linalg.norm(high) / np.linalg.norm(across) == pytest.approx(0.75)


@pytest.mark.parametrize(
    "target", [[0.0, 0.0, 0.0], [10.0, 500.0, 30.0], [-300.0, -20.0, 90.0], [10.0, -20.0, 0.0], [10.0, -20.0, 99.0]]
)
def test_camera_that_looks_at_a_point_has_it_in_the_middle(target: list[float]) -> None:
    """Also straight down and straight up."""
    camera = look_at([10.0, -20.0, 30.0], target, 30.0)
    column, row, _ = _pixel(camera, np.array(target))
    assert (column, row) == pytest.approx((320.0, 240.0), abs=1e-6)
    assert camera.axes()[1][2] == pytest.approx(0.0, abs=1e-14)  # its horizon is level


def test_named_cameras_of_the_hospital_see_their_targets() -> None:
    scene = load_scene("hospital", level="IA")
    for station in scene.cameras:
        camera = station_camera(scene, station.name)
        assert camera.horizontal_field_of_view == station.horizontal_field_of_view
        np.testing.assert_allclose(camera.position, station.position(scene.frame), rtol=0.0, atol=1e-9)
        column, row, _ = _pixel(camera, station.target(scene.frame))
        assert (column, row) == pytest.approx((320.0, 240.0), abs=1e-6)
    assert station_camera(scene, "tower", horizontal_field_of_view=3.0).horizontal_field_of_view == 3.0


def test_unknown_camera_is_refused_with_those_that_are_known() -> None:
    with pytest.raises(InputError, match=r"camera = 'steeple': no such camera; use one of overhead"):
        station_camera(town().scene, "steeple")


@pytest.mark.parametrize(
    ("entry", "value"),
    [
        ("position", np.array([0.0, np.nan, 0.0])),
        ("position", np.array([0.0, 1.0])),
        ("yaw", np.inf),
        ("pitch", 90.5),
        ("pitch", np.nan),
        ("roll", np.nan),
        ("horizontal_field_of_view", 0.0),
        ("horizontal_field_of_view", 170.0),
        ("horizontal_field_of_view", np.nan),
    ],
)
def test_numbers_that_no_camera_can_have_are_refused(entry: str, value: object) -> None:
    numbers = {"position": np.zeros(3), "yaw": 0.0, "pitch": 0.0, "roll": 0.0, "horizontal_field_of_view": 40.0}
    with pytest.raises(InputError, match=r"camera: .*; (give|use)"):
        Camera(**{**numbers, entry: value})


def test_looking_at_where_one_stands_is_refused() -> None:
    with pytest.raises(InputError, match=r"camera: target = .*no direction"):
        look_at([1.0, 2.0, 3.0], [1.0, 2.0, 3.0], 40.0)


def test_clip_planes_hold_all_of_the_scene_that_the_picture_can_show() -> None:
    """Rationale: random cameras in and around a box, random fields; every box point in view lies between the planes."""
    rng = np.random.default_rng(3)
    lowest, highest = np.array([-50.0, -80.0, 0.0]), np.array([60.0, 40.0, 30.0])
    corners = np.stack(np.meshgrid(*zip(lowest, highest, strict=True)), axis=-1).reshape(-1, 3)
    points = np.vstack([corners, rng.uniform(lowest, highest, (4000, 3))])
    for _ in range(200):
        camera = Camera(
            position=rng.uniform(-150.0, 150.0, 3), yaw=rng.uniform(0.0, 360.0), pitch=rng.uniform(-90.0, 90.0),
            roll=rng.uniform(0.0, 360.0), horizontal_field_of_view=rng.uniform(1.0, 169.0),
        )  # fmt: skip
        near, far = clip_distances(camera, SIZE, lowest, highest)
        depth, across, high = np.stack(camera.axes()) @ (points - camera.position).T
        half_width, half_height = camera.half_extent(SIZE)
        away = np.linalg.norm(points - camera.position, axis=1)
        in_view = (np.abs(across) <= half_width * depth) & (np.abs(high) <= half_height * depth) & (away > 0.5)
        assert np.all(depth[in_view] >= near * (1.0 - 1e-12))
        assert np.all(depth[in_view] <= far)
