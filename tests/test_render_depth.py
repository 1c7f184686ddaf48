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
def walls(tmp_path_factory: pytest.TempPathFactory) -> World:
    """A house around the one that stands in it, their southern walls a kilometre away and a tenth of a metre apart."""
    inner = feature(box(0.0, 1010.0, 380.0, 19.8), 90.0, wall_word="2040")
    outer = feature(box(0.0, 1010.0, 400.0, 20.0), 100.0, wall_word="1260")
    ground = feature(box(0.0, 0.0, 8000.0, 8000.0), 0.0, word="9420")
    path = write_town(tmp_path_factory.mktemp("walls"), [inner, outer, ground])
    return build_world(load_scene(path), read_weather("winter"), image_day=DAY, settings=SETTINGS)


@pytest.mark.parametrize("height", [5.0, 30.0, 60.0])
def test_a_tenth_of_a_metre_is_told_apart_a_kilometre_away(walls: World, height: float) -> None:
    """From within the scene, in whole frames and, where the walls' greys differ, in those for display alone."""
    camera = look_at([0.0, 0.0, height], [0.0, 1000.0, 50.0], 15.0)
    with Renderer(walls, load_sensor("flir"), size=SIZE) as renderer:
        planes = renderer.render(camera, 43200.0).planes
        quick = renderer.render(camera, 43200.0, planes=("display",)).planes["display"]
    shown = walls.scene.surfaces.feature[planes["surface_id"]]
    assert np.count_nonzero(shown == 1) > 500
    assert not np.any(shown == 0)
    assert np.abs(quick.astype(int) - planes["display"]).max() <= 1


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
