"""The benchmark: its keys and what must hold of its numbers on any machine."""

import dataclasses
import json

import numpy as np
import pytest
from small_world import town
from typer.testing import CliRunner

from sensorsim.cli.app import app
from sensorsim.render import ConstantColour, Renderer, World, look_at
from sensorsim.sensor import load_sensor
from sensorsim.study.bench import STAGES, Bench, run_bench
from sensorsim.study.bench_timing import measure
from sensorsim.study.bench_worlds import with_surfaces, with_triangles, with_wall_types

SIZE = (320, 240)
VIEW = look_at([-150.0, -140.0, 60.0], [0.0, 0.0, 5.0], 50.0)
KEYS = {"frame_ms", "constant_colour_ms", "ratio_constant_colour", "stages_ms", "peers", "growth"}


@pytest.fixture(scope="module")
def found() -> Bench:
    return run_bench(town(), load_sensor("flir1977"), VIEW, size=SIZE, frames=15, peers=False, growth=True)


def test_keys_are_there_and_json_holds_them(found: Bench) -> None:
    plain = json.loads(json.dumps(found.to_dict()))
    assert plain.keys() >= KEYS
    assert set(plain["stages_ms"]) == set(STAGES)
    assert set(plain["growth"]) == {"pixels", "triangles", "surfaces", "wall_types"}
    assert plain["peers"] == {}


def test_times_are_positive_and_ratios_are_ratios(found: Bench) -> None:
    times = [found.frame_ms, found.processor_ms, found.constant_colour_ms, found.constant_colour_processor_ms]
    times += [*found.stages_ms.values(), *(row["frame_ms"] for rows in found.growth.values() for row in rows)]
    assert all(np.isfinite(time) and time > 0.0 for time in times)
    assert found.ratio_constant_colour == pytest.approx(found.frame_ms / found.constant_colour_ms)
    assert found.frames_per_second == pytest.approx(1000.0 / found.frame_ms)


def test_stages_make_up_the_frame(found: Bench) -> None:
    """Expected: medians of parts, so only about the median of the whole."""
    assert 0.6 * found.frame_ms < sum(found.stages_ms.values()) < 1.4 * found.frame_ms


def test_growth_counts_what_it_says(found: Bench) -> None:
    scene = town().scene
    bases = {"triangles": len(scene.mesh.triangle), "surfaces": scene.surfaces.area.size,
             "wall_types": len(town().tables.wall_types)}  # fmt: skip
    for name, base in bases.items():
        assert [row["count"] for row in found.growth[name]] == [base, 2 * base, 4 * base]
    assert [row["count"] for row in found.growth["pixels"]] == [160 * 120, 320 * 240, 640 * 480]


@pytest.mark.parametrize("more", [with_triangles, with_surfaces, with_wall_types])
def test_more_of_one_thing_is_the_same_picture(more: object) -> None:
    assert callable(more)
    pictures = []
    for world in (town(), more(town(), 3)):
        assert isinstance(world, World)
        with Renderer(world, load_sensor("flir"), size=(80, 60)) as renderer:
            pictures.append(renderer.render(VIEW, 36000.0, planes=("display",)).planes["display"])
    assert pictures[0].std() > 5.0
    np.testing.assert_array_equal(*pictures)


def test_one_colour_covers_what_surfaces_cover() -> None:
    plain = ConstantColour(town().scene.mesh, (80, 60))
    colour = plain.render(VIEW)[::-1].copy()
    plain.release()
    with Renderer(town(), load_sensor("flir"), size=(80, 60)) as renderer:
        seen = renderer.render(VIEW, 36000.0).planes["surface_id"] >= 0
    np.testing.assert_array_equal(colour[..., 3] > 0, seen)
    assert set(map(tuple, colour[seen])) == {(64, 128, 191, 255)}


def test_pieces_take_turns() -> None:
    order: list[str] = []
    measure({"a": lambda: order.append("a"), "b": lambda: order.append("b")}, 4)
    assert "".join(order) == "ab" * 7


def test_command_prints_the_keys() -> None:
    options = ["bench", "hospital", "--level", "IA", "--size", "64x48", "--frames", "2", "--no-growth", "--json",
               "--preset", "report", "--sensor", "flir"]  # fmt: skip
    result = CliRunner().invoke(app, options)
    assert result.exit_code == 0, result.output
    plain = json.loads(result.stdout)
    assert plain.keys() >= KEYS
    assert (plain["scene"], plain["size"]) == ("hospital IA", [64, 48])


def test_results_are_plain_values(found: Bench) -> None:
    assert {field.name for field in dataclasses.fields(found)} == set(found.to_dict())
