"""The compiled loops of frames for display alone: air, runs, planes, and what stands among the surfaces."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from numba import njit
from small_world import town

from sensorsim.environment import AirPath, clear_path
from sensorsim.render import Renderer, look_at
from sensorsim.render.air_kernel import GENTLE, decay, through_air
from sensorsim.render.pixel_kernels import find_runs
from sensorsim.render.planes import surface_planes, triangle_planes
from sensorsim.render.solids import Solids
from sensorsim.scene import Mesh
from sensorsim.sensor import load_sensor
from sensorsim.sensor.line_noise import LineNoise
from sensorsim.sensor.random_field import deviate_table
from sensorsim.sensor.read_out import frame_noise
from sensorsim.sensor.words import folded, plus, times

SIZE = (100, 72)
VIEW = look_at([-150.0, -140.0, 60.0], [0.0, 0.0, 5.0], 50.0)
HAZE = AirPath(
    weight=np.array([0.5, 0.3, 0.2]), coefficient=np.array([5e-5, 4e-4, 6e-3]),
    inverse_scale_height=np.array([0.0, 1.0 / 8000.0, 1.0 / 1200.0]), source=np.array([30.0, 32.0, 33.0]),
    source_decay=1e-4, beam_source=np.array([0.0, 0.5, 0.0]), asymmetry=0.65,
)  # fmt: skip


@njit
def _decays(values, out):
    for place in range(values.size):
        out[place] = decay(values[place])


def test_exponential_is_true_to_single_precision():
    values = np.linspace(-80.0, 80.0, 20001).astype(np.float32)
    found = np.zeros_like(values)
    _decays(values, found)
    assert found == pytest.approx(np.exp(-values.astype(np.float64)), rel=4e-7)


@pytest.mark.parametrize("gentle", [False, True])
@pytest.mark.parametrize("height", [0.0, 40.0, 3000.0])
@pytest.mark.parametrize("air", [HAZE, clear_path()], ids=["haze", "clear"])
def test_row_of_air_is_its_twin(air, height, gentle):
    """Expected: the float64 equations, at ranges from none to where nothing of the light is left, up and down."""
    rng = np.random.default_rng(7)
    ray, along = np.array([0.9, 0.2, -0.5], np.float32), np.array([0.0, 0.0006, 0.001], np.float32)
    width = 1000
    direction = ray[None, :].astype(np.float64) + np.arange(width)[:, None] * along[None, :].astype(np.float64)
    most = 0.9 * GENTLE / air.inverse_scale_height.max(initial=1e-9) if gentle else 40000.0
    away = np.minimum(np.geomspace(1e-3, 3e4, width), most / np.maximum(np.abs(direction[:, 2]), 1e-6))
    away = np.where(rng.uniform(size=width) < 0.1, 0.0, away).astype(np.float32)
    source = rng.uniform(5.0, 60.0, width).astype(np.float32)
    sun = np.array([0.6, 0.0, 0.8])
    near, slope = air.source_at(height)
    extinction = air.coefficient * np.exp(-height * air.inverse_scale_height)
    flags = np.full(air.weight.size, float(gentle))
    terms = np.stack([extinction, air.weight, air.inverse_scale_height, near, slope, air.beam_source, flags], axis=1)
    seen = np.zeros(width, np.float32)
    through_air(ray, along, source, away, terms.astype(np.float32), np.append(sun, air.asymmetry),
                np.zeros((4, width), np.float32), seen)  # fmt: skip
    length = np.linalg.norm(direction, axis=1)
    expected = air.apparent_radiance(
        source, away * length, height, height + away * direction[:, 2].astype(np.float64), direction @ sun / length
    )
    assert seen == pytest.approx(expected, rel=2e-5)


def test_runs_end_where_numbers_change():
    rng = np.random.default_rng(3)
    numbers = np.repeat(rng.integers(0, 40, (30, 60)), 5, axis=1)[:, :299].astype(np.float32)
    numbers[3], numbers[4] = 7.0, np.arange(299)  # one run, and nothing but runs of one
    ends, seen = np.zeros(numbers.shape, np.int32), np.zeros(400, np.bool_)
    find_runs(numbers, 0, 17, ends, seen)
    find_runs(numbers, 17, 30, ends, seen)
    np.testing.assert_array_equal(np.flatnonzero(seen), np.unique(numbers))
    for row, found in zip(numbers, ends, strict=True):
        expected = [*(np.flatnonzero(np.diff(row)) + 1), row.size]
        np.testing.assert_array_equal(found[: len(expected)], expected)


def test_planes_hold_their_corners_and_spheres_too():
    world = town()
    planes = surface_planes(world.scene.mesh, world.scene.surfaces.normal)
    assert planes is not None
    mesh = world.scene.mesh
    corner, plane = mesh.position[mesh.triangle], planes[mesh.surface[mesh.triangle[:, 2]]]
    off = np.einsum("tck,tk->tc", corner, plane[:, :3]) - plane[:, 3:4]
    assert np.abs(off).max() < 1e-3
    assert np.all(np.linalg.norm(corner - plane[:, None, 4:7], axis=2) <= plane[:, 7:8] + 1e-9)


def test_triangles_are_planes_of_their_own():
    rng = np.random.default_rng(2)
    triangles = rng.uniform(-50.0, 50.0, (40, 3, 3))
    triangles[0] = 5.0  # a point
    planes = triangle_planes(triangles)
    off = np.einsum("tck,tk->tc", triangles, planes[:, :3]) - planes[:, 3:4]
    assert np.abs(off).max() < 1e-9
    assert np.linalg.norm(planes[1:, :3], axis=1) == pytest.approx(np.ones(39))
    assert np.isfinite(planes).all()


def _bent() -> tuple[Mesh, np.ndarray]:
    scene = town().scene
    position = scene.mesh.position.copy()
    wall = np.flatnonzero(np.abs(scene.surfaces.normal[scene.mesh.surface, 2]) < 0.5)[0]
    position[wall] += 2.0 * scene.surfaces.normal[scene.mesh.surface[wall]]
    return replace(scene.mesh, position=position), scene.surfaces.normal


def test_surface_that_is_not_flat_is_drawn_the_long_way():
    """Expected: the display of the whole frame, to the code, and no quick road."""
    mesh, normal = _bent()
    assert surface_planes(mesh, normal) is None
    bent = replace(town(), scene=replace(town().scene, mesh=mesh))
    with Renderer(bent, load_sensor("flir"), size=SIZE) as renderer:
        quick = renderer.render(VIEW, 43200.0, planes=("display",)).planes["display"]
        whole = renderer.render(VIEW, 43200.0).planes["display"]
        assert renderer._quick is None
    np.testing.assert_array_equal(quick, whole)


@pytest.mark.parametrize("name", ["flir", "lltv"])
def test_solids_stand_among_the_surfaces_as_in_whole_frames(name):
    """Expected: light within a code of the whole frame's, its box of bright triangles among it."""
    corners = np.array(list(itertools.product((0.0, 1.0), repeat=3))) * [30.0, 30.0, 25.0] + [-60.0, -90.0, 0.0]
    faces = np.array([[0, 1, 5], [0, 5, 4], [0, 4, 6], [0, 6, 2], [4, 5, 7], [4, 7, 6], [1, 3, 7], [1, 7, 5],
                      [0, 2, 3], [0, 3, 1], [2, 6, 7], [2, 7, 3]])  # fmt: skip
    triangles = corners[faces]
    outward = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    count = len(triangles)
    box = Solids(
        triangles=triangles, normal=outward, quarters=np.full((count, 4), 0.125),
        temperature=np.linspace(300.0, 330.0, count), emissivity=np.full(count, 0.9),
        reflectance=np.full(count, 0.6), number=np.zeros(count, np.int64),
    )  # fmt: skip
    with Renderer(town(), load_sensor(name), size=SIZE) as renderer:
        quick = renderer.render(VIEW, 43200.0, planes=("display",), solids=box).planes["display"]
        whole = renderer.render(VIEW, 43200.0, solids=box)
        bare = renderer.render(VIEW, 43200.0, planes=("display",)).planes["display"]
        assert renderer._quick is not None
    off = np.abs(quick.astype(int) - whole.planes["display"])
    assert np.sum(whole.planes["surface_id"] >= town().scene.surfaces.area.size) > 50
    assert off.max() <= 1
    assert np.mean(off > 0) < 0.01
    assert np.any(bare != quick)


@pytest.mark.parametrize("name", ["flir1977", "uncooled", "sit1977"])
def test_noise_of_lines_is_that_of_the_read_out(name):
    sensor = load_sensor(name)
    lines = LineNoise(sensor, (37, 23), deviate_table().astype(np.float32))
    for frame in (0, 1, 77):
        expected = frame_noise(sensor, (37, 23), frame)
        row, line = lines.at(frame)
        assert row == pytest.approx(expected.row, abs=1e-6)
        assert line == pytest.approx(expected.line, abs=1e-6)


@njit
def _words(first, second, out):
    for place in range(first.size):
        out[0, place] = plus(first[place], second[place])
        out[1, place] = times(first[place], second[place])
        out[2, place] = folded(first[place])


def test_words_of_32_bits_wrap():
    first, second = np.random.default_rng(1).integers(0, 2**32, (2, 500), dtype=np.uint32)
    first[:2], second[:2] = (0, 2**32 - 1), 2**32 - 1
    found = np.zeros((3, 500), np.uint32)
    _words(first, second, found)
    wide = first.astype(np.uint64), second.astype(np.uint64)
    np.testing.assert_array_equal(found[0], (wide[0] + wide[1]) % 2**32)
    np.testing.assert_array_equal(found[1], (wide[0] * wide[1]) % 2**32)
    np.testing.assert_array_equal(found[2], first ^ (first >> 16))
