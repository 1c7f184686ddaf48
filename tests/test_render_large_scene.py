"""Scenes with more surfaces than a row of the surface table holds, and with layers that lie close on each other."""

from dataclasses import replace

import numpy as np
import pytest
from picture_twin import look, temperatures
from small_world import DAY, SETTINGS, box, feature, write_town

from sensorsim.environment import read_weather
from sensorsim.render import Renderer, World, build_world, look_at, station_camera
from sensorsim.render.surface_table import SURFACE_TEXELS, SURFACES_PER_ROW, surface_table
from sensorsim.scene import load_scene
from sensorsim.sensor import load_sensor

COARSE = replace(SETTINGS, orientations="report10", step=600.0)
SIZE = (56, 42)


@pytest.fixture(scope="module")
def estate(tmp_path_factory: pytest.TempPathFactory) -> World:
    """Two hundred and fifty houses of six surfaces each, of many reflectances, on four layers of ground."""
    ground = [
        feature(box(0.0, 0.0, 900.0 - 50.0 * k, 900.0 - 50.0 * k), 0.0, base=0.15 * k, word=f"9{k}2{k}")
        for k in range(4)
    ]
    houses = [
        feature(
            box(40.0 * (n % 16) - 300.0, 40.0 * (n // 16) - 300.0, 20.0, 15.0),
            6.0 + n % 5,
            wall_word=f"20{10 + n % 80}",
            roof_word=f"67{10 + n % 60}",
        )
        for n in range(250)
    ]
    path = write_town(tmp_path_factory.mktemp("estate"), [*ground, *houses])
    return build_world(load_scene(path), read_weather("winter"), image_day=DAY, settings=COARSE)


def test_surfaces_beyond_the_first_row_of_the_table_keep_their_own_records(estate: World) -> None:
    """Expected: surface, range and temperature of every pixel as by ray casting, past surface 1023 too."""
    assert estate.scene.surfaces.word.size > SURFACES_PER_ROW + 200
    camera = look_at([-500.0, 700.0, 420.0], [0.0, 60.0, 0.0], 42.0)
    with Renderer(estate, load_sensor("flir"), size=SIZE) as renderer:
        picture = renderer.render(camera, 43200.0)
    sight = look(estate, camera, SIZE)
    clear = sight.margin > 3e-3
    assert clear.mean() > 0.9
    assert (picture.planes["surface_id"] >= SURFACES_PER_ROW).sum() > 50
    np.testing.assert_array_equal(picture.planes["surface_id"][clear], sight.surface[clear])
    seen = picture.planes["surface_id"] >= 0
    rows = picture.planes["surface_id"][seen].astype(np.int64)
    miss = picture.planes["surface_temperature"][seen] - temperatures(estate, rows, 43200.0)
    assert np.abs(miss).max() < 5e-3


@pytest.mark.parametrize("height", [3.0, 40.0, 400.0, 3000.0])
def test_layers_of_ground_fifteen_centimetres_apart_never_show_through(estate: World, height: float) -> None:
    camera = look_at([-460.0, -470.0, height], [0.0, 0.0, 0.0], 30.0)
    with Renderer(estate, load_sensor("flir"), size=SIZE) as renderer:
        shown = renderer.render(camera, 43200.0).planes["surface_id"]
    sight = look(estate, camera, SIZE)
    role = estate.scene.surfaces.role
    level = (sight.surface >= 0) & (role[sight.surface] == "plane") & (sight.margin > 3e-3)
    assert level.sum() > 100
    np.testing.assert_array_equal(shown[level], sight.surface[level])


def test_records_lie_in_rows_of_one_width(estate: World) -> None:
    surfaces = estate.scene.surfaces
    table = surface_table(surfaces.normal, surfaces.feature, estate.assignment, estate.tables.orientations)
    assert table.shape == (2, SURFACE_TEXELS * SURFACES_PER_ROW, 4)
    row = SURFACES_PER_ROW + 77
    record = table[1, SURFACE_TEXELS * 77 : SURFACE_TEXELS * 78]
    np.testing.assert_allclose(record[0, :3], surfaces.normal[row], rtol=0.0, atol=1e-7)
    assert record[0, 3] == estate.assignment.wall_type[row]
    assert record[2, 3] == np.float32(estate.assignment.reflectance[row])
    np.testing.assert_allclose(record[2, :3].sum(), 1.0, rtol=0.0, atol=1e-6)


@pytest.mark.parametrize("name", ["tower", "hospital", "cement_plant", "overhead"])
def test_hospital_shows_what_ray_casting_sees(name: str) -> None:
    """Expected: 99.5 % of all pixels, edges included; layers of ground, trees and houses at all ranges."""
    scene = load_scene("hospital", level="IIIB")
    world = build_world(scene, read_weather("winter"), image_day=DAY, settings=COARSE)
    camera = station_camera(scene, name)
    with Renderer(world, load_sensor("flir"), size=SIZE) as renderer:
        shown = renderer.render(camera, 36000.0).planes["surface_id"]
    assert np.mean(shown == look(world, camera, SIZE).surface) > 0.995
    assert np.unique(shown).size > 15
