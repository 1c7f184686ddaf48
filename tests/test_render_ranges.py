"""What may be in view, found with nothing drawn, holds all that is drawn."""

import numpy as np
import pytest
from small_world import town

from sensorsim.render import Camera, Renderer, look_at
from sensorsim.render.ranges import ground_range, in_view
from sensorsim.sensor import load_sensor

SIZE = (96, 72)


def cameras() -> list[Camera]:
    rng = np.random.default_rng(8)
    around = [
        look_at([*rng.uniform(-250.0, 250.0, 2), rng.uniform(2.0, 120.0)], [*rng.uniform(-80.0, 80.0, 2), 3.0], field)
        for field in (3.0, 20.0, 60.0, 120.0)
    ]
    away = look_at([0.0, -300.0, 30.0], [0.0, -600.0, 90.0], 20.0)
    return [*around, look_at([0.0, 0.0, 200.0], [1.0, 0.0, 0.0], 50.0), away]


def test_what_is_drawn_is_among_what_may_be_in_view_and_no_farther() -> None:
    mesh = town().scene.mesh
    with Renderer(town(), load_sensor("flir"), size=SIZE) as renderer:
        for camera in cameras():
            planes, found = renderer.render(camera, 36000.0).planes, in_view(camera, SIZE, mesh)
            drawn = planes["surface_id"] >= 0
            assert set(planes["surface_id"][drawn]) <= set(found.surface.tolist())
            assert planes["range"].max(initial=0.0) <= found.longest_range * (1.0 + 1e-5)
            assert found.heights[0] >= mesh.position[:, 2].min()
            assert found.heights[1] <= mesh.position[:, 2].max()


def test_nothing_is_in_view_of_a_camera_that_looks_away() -> None:
    found = in_view(cameras()[-1], SIZE, town().scene.mesh)
    assert found.surface.size == 0
    assert found.longest_range == 0.0


@pytest.mark.parametrize(("pitch", "low"), [(-89.0, 100.0), (-30.0, 100.0), (60.0, 0.0)])
def test_ground_is_as_far_as_the_flattest_ray_goes(pitch: float, low: float) -> None:
    camera = Camera(position=np.array([0.0, 0.0, 100.0]), yaw=10.0, pitch=pitch, horizontal_field_of_view=20.0)
    assert low <= ground_range(camera, SIZE) < 400.0
    level = Camera(position=np.array([0.0, 0.0, 100.0]), yaw=10.0, pitch=0.0, horizontal_field_of_view=20.0)
    assert ground_range(level, SIZE) == np.inf
