"""Tiles: each triangle in one of them, and none left out that a camera sees."""

from dataclasses import replace
from datetime import date
from pathlib import Path

import numpy as np
import pytest
from small_world import SETTINGS, town

from sensorsim.environment import read_weather
from sensorsim.errors import InputError
from sensorsim.render import Camera, Renderer, World, build_world, look_at, tiles
from sensorsim.scene import load_scene
from sensorsim.sensor import load_sensor
from sensorsim.study.city import PITCH, write_city


@pytest.fixture(scope="module")
def city(tmp_path_factory: pytest.TempPathFactory) -> World:
    path = tmp_path_factory.mktemp("city") / "city.geojson"
    write_city(path, 900)
    return build_world(load_scene(path), read_weather("winter"), image_day=date(1976, 2, 7), settings=SETTINGS)


def test_city_is_the_same_for_its_seed_and_goes_through_the_pipeline(tmp_path: Path, city: World) -> None:
    texts = []
    for name, seed in (("a", 1), ("b", 1), ("c", 2)):
        assert write_city(tmp_path / name, 10, seed=seed) == 4 * PITCH
        texts.append((tmp_path / name).read_text())
    assert texts[0] == texts[1] != texts[2]
    assert len(city.scene.features) == 901
    assert city.scene.surfaces.area.size == 900 * 6 + 1
    with pytest.raises(InputError, match="building"):
        write_city(tmp_path / "d", 0)


VIEWS = {
    "over the roofs": look_at([-600.0, -600.0, 120.0], [0.0, 0.0, 0.0], 40.0),
    "in a street, rolled": Camera(
        position=np.array([0.0, 0.0, 2.0]), yaw=37.0, pitch=4.0, roll=50.0, horizontal_field_of_view=60.0
    ),
    "straight down": Camera(
        position=np.array([100.0, 50.0, 300.0]), yaw=10.0, pitch=-90.0, horizontal_field_of_view=20.0
    ),
    "away": Camera(position=np.array([0.0, -900.0, 50.0]), yaw=180.0, pitch=5.0, horizontal_field_of_view=40.0),
}


def _frame(world: World, view: Camera, monkeypatch: pytest.MonkeyPatch, per_tile: int) -> tuple[np.ndarray, int, int]:
    monkeypatch.setattr(tiles, "PER_TILE", per_tile)
    with Renderer(world, load_sensor("flir"), size=(120, 90)) as renderer:
        codes = renderer.render(view, 36000.0, planes=("display",)).planes["display"]
        quick = None if renderer._quick is None else renderer._quick.frame
        assert quick is not None
        drawn = tiles.visible_tiles(quick.tiles, view, (120, 90))
        edge = quick.tiles.edge
        return codes, int(np.sum(edge[drawn + 1] - edge[drawn])), int(edge[-1])


@pytest.mark.parametrize("name", VIEWS)
def test_tiles_change_what_is_drawn_and_not_what_is_seen(
    city: World, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    whole, every, total = _frame(city, VIEWS[name], monkeypatch, 10**9)
    tiled, drawn, _ = _frame(city, VIEWS[name], monkeypatch, 100)
    np.testing.assert_array_equal(tiled, whole)
    assert drawn <= every
    if name == "straight down":
        assert drawn < 0.15 * total
    if name == "away":
        assert drawn == 0


def test_every_triangle_is_in_one_run_and_its_box(city: World) -> None:
    mesh = city.scene.mesh
    made = tiles.build_tiles(mesh, mesh.position[mesh.triangle[:, 0], 2])
    assert sorted(map(tuple, made.triangle.tolist())) == sorted(map(tuple, mesh.triangle.tolist()))
    assert made.edge[0] == 0
    assert made.edge[-1] == len(mesh.triangle)
    assert np.all(np.diff(made.edge) > 0)
    for run in range(len(made.lowest)):
        corner = mesh.position[made.triangle[made.edge[run] : made.edge[run + 1]]].reshape(-1, 3)
        np.testing.assert_array_equal(corner.min(axis=0), made.lowest[run])
        np.testing.assert_array_equal(corner.max(axis=0), made.highest[run])


def test_scene_of_one_triangle_and_one_without_width_have_a_tile() -> None:
    mesh = town().scene.mesh
    for part in (mesh.triangle[:1], mesh.triangle[:1].repeat(3, axis=0)):
        made = tiles.build_tiles(replace(mesh, triangle=part), np.zeros(len(part)))
        assert made.edge.tolist() == [0, len(part)]
    point = replace(mesh, position=np.zeros((3, 3)), triangle=np.array([[0, 1, 2]], dtype=np.int32))
    assert tiles.build_tiles(point, np.zeros(1)).edge.tolist() == [0, 1]
