"""Depth at long range: what hides what goes by the nearest surface, not by the box around the whole scene."""

import numpy as np
import pytest
from small_world import DAY, SETTINGS, box, feature, write_town

from sensorsim.environment import read_weather
from sensorsim.render import Renderer, World, build_world, look_at
from sensorsim.render.camera import clip_distances
from sensorsim.render.nearest import IN_BLOCK, Nearest
from sensorsim.scene import Mesh, load_scene
from sensorsim.sensor import load_sensor

SIZE = (64, 48)


@pytest.fixture(scope="module")
def layers(tmp_path_factory: pytest.TempPathFactory) -> World:
    """Ground from the camera's feet on, and from 900 m to 3.3 km a second layer a tenth of a metre above it."""
    ground = feature(box(0.0, 0.0, 8000.0, 8000.0), 0.0, word="9420")
    above = feature(box(0.0, 2100.0, 8000.0, 2400.0), 0.0, base=0.1, word="8038")
    path = write_town(tmp_path_factory.mktemp("layers"), [ground, above])
    return build_world(load_scene(path), read_weather("winter"), image_day=DAY, settings=SETTINGS)


@pytest.mark.parametrize("height", [5.0, 30.0, 300.0])
def test_a_tenth_of_a_metre_is_told_apart_a_kilometre_away(layers: World, height: float) -> None:
    """From within the scene; expected: each pixel whose ray meets the upper layer shows it."""
    camera = look_at([0.0, 0.0, height], [0.0, 1000.0, 0.0], 2.0)
    corner, right, up = camera.view_rays(SIZE)
    rows = (np.arange(SIZE[1]) + 0.5)[::-1] / SIZE[1]
    rays = corner + 0.5 * right + rows[:, None] * up
    reach = np.where(rays[:, 2] < 0.0, (height - 0.1) * rays[:, 1] / -rays[:, 2], np.inf)
    with Renderer(layers, load_sensor("flir"), size=SIZE) as renderer:
        shown = renderer.render(camera, 43200.0).planes["surface_id"]
    upper = (reach > 950.0) & (reach < 1300.0)
    assert np.count_nonzero(upper) >= 2
    assert np.all(shown[upper] == 1)
    below = reach < 850.0
    assert np.all(shown[below] == 0)


def test_near_plane_lies_before_all_that_is_there_and_as_far_as_that_allows() -> None:
    """Squares in the air by chance, more than a block of them: never nearer than told, and told to a tenth."""
    rng = np.random.default_rng(5)
    count = 3 * IN_BLOCK + 7
    middle = rng.uniform(-300.0, 300.0, (count, 1, 3))
    corner = middle + np.array([[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]])
    mesh = Mesh(
        position=corner.reshape(-1, 3),
        surface=np.repeat(np.arange(count, dtype=np.int32), 3),
        triangle=np.arange(3 * count, dtype=np.int32).reshape(-1, 3),
    )
    near = Nearest(mesh)
    lowest, highest = mesh.position.min(axis=0), mesh.position.max(axis=0)
    for place in rng.uniform(-400.0, 400.0, (300, 3)):
        told = near.distance(place)
        flat = np.maximum(np.maximum(corner.min(axis=1) - place, place - corner.max(axis=1)), 0.0)
        assert told == pytest.approx(np.linalg.norm(flat, axis=1).min())
        assert told <= np.linalg.norm(corner - place, axis=2).min()
        camera = look_at(place, [0.0, 0.0, 0.0], 40.0)
        planes = clip_distances(camera, SIZE, lowest, highest, told)
        depth = (mesh.position - place) @ camera.axes()[0]
        across = np.abs((mesh.position - place) @ np.stack(camera.axes()[1:]).T)
        seen = np.all(across <= np.array(camera.half_extent(SIZE)) * depth[:, None], axis=1)
        assert np.all(depth[seen & (depth > 0.5)] >= planes[0])
        assert planes[0] >= clip_distances(camera, SIZE, lowest, highest)[0]
