"""What a frame of a city submits goes with what it sees, and the study that measures it."""

import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from small_world import SETTINGS

from sensorsim.cli import main
from sensorsim.cli.app import app
from sensorsim.errors import InputError
from sensorsim.render import Camera, look_at, tiles
from sensorsim.scene import Mesh, load_scene
from sensorsim.sensor import load_sensor
from sensorsim.study.city import PITCH, write_city
from sensorsim.study.city_bench import city_views, run_city

SIZE = (160, 120)
COARSE = replace(SETTINGS, orientations="report10", step=600.0)


def city_mesh(folder: Path, buildings: int) -> Mesh:
    write_city(folder / f"{buildings}.geojson", buildings)
    return load_scene(folder / f"{buildings}.geojson").mesh


def submitted(mesh: Mesh, camera: Camera) -> int:
    count = len(mesh.triangle)
    made = tiles.build_tiles(mesh, np.zeros(count, np.int64), np.zeros(count))
    seen = tiles.visible_tiles(made, camera, SIZE)
    return int(np.sum(made.edge[seen + 1] - made.edge[seen]))


def test_what_is_drawn_does_not_grow_with_what_is_not_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A view of some blocks in the middle of cities of 144, 576 and 1296 buildings; one of all of it grows with it.

    The squares of the tiles lie elsewhere in each city, so a border of tiles more or less is in the view.
    """
    monkeypatch.setattr(tiles, "PER_TILE", 30)
    sizes = (144, 576, 1296)
    meshes = [city_mesh(tmp_path, buildings) for buildings in sizes]
    down = look_at([1.0, -1.0, 100.0], [0.0, 0.0, 0.0], 40.0)
    few = [submitted(mesh, down) for mesh in meshes]
    assert min(few) > 50
    assert max(few) < 2.0 * min(few)
    every = [submitted(mesh, city_views(count)["far"]) for mesh, count in zip(meshes, sizes, strict=True)]
    assert every == [len(mesh.triangle) for mesh in meshes]
    assert few[2] < 0.05 * every[2]


def test_study_tells_steps_memory_and_views(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(tiles, "PER_TILE", 100)
    found = run_city(200, load_sensor("flir"), tmp_path, size=SIZE, frames=2, settings=COARSE)
    assert json.loads(json.dumps(found.to_dict()))["views"].keys() == city_views(200).keys()
    assert found.surfaces == 1201
    assert found.triangles == 200 * 12 + 2
    assert set(found.build) == {"write", "load", "bake", "renderer", "first frame"}
    assert all(span.wall > 0.0 for span in found.build.values())
    assert found.peak_mib > 50.0
    views = found.views
    assert views["outward"].triangles == 0
    assert 0 < views["street"].triangles < views["far"].triangles == found.triangles
    assert all(view.frame_ms > 0.0 for view in views.values())


def test_the_street_is_a_street() -> None:
    """The eye stands between two rows of buildings, whether their number across is odd or even."""
    for buildings in (100, 121):
        across = 10 if buildings == 100 else 11
        middles = (np.arange(across) + 0.5) * PITCH - 0.5 * across * PITCH
        east = city_views(buildings)["street"].position[0]
        assert np.abs(middles - east).min() == pytest.approx(0.5 * PITCH)


def test_command_prints_the_figures_and_refuses_nonsense(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(
        sys, "argv",
        ["sensorsim", "study", "city", "--buildings", "9", "--size", "32x24", "--frames", "1", "--preset", "report",
         "--sensor", "flir"],
    )  # fmt: skip
    with pytest.raises(SystemExit) as left:
        main()
    assert left.value.code in (0, None)
    assert "9 buildings, 110 triangles" in capsys.readouterr().out
    for words in (("--frames", "0"), ("--buildings", "0"), ("--size", "0x5")):
        with pytest.raises(InputError):
            app(["study", "city", *words], standalone_mode=False)
