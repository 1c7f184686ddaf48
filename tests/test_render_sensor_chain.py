"""The passes of the sensor against their NumPy twins, on pictures made for the purpose."""

import dataclasses

import moderngl
import numpy as np
import pytest

from sensorsim.gpu import create_context
from sensorsim.render.sensor_chain import SensorChain
from sensorsim.sensor import (
    Noise,
    blur_kernel,
    column_places,
    focal_plane,
    load_sensor,
    read_out,
    sensitivity,
)

SIZE = (48, 36)
FIELD = 0.05


@pytest.fixture(scope="module")
def ctx():
    context = create_context()
    with context:
        yield context
    context.release()


def scene(samples, low, high):
    rng = np.random.default_rng(5)
    blocks = rng.uniform(low, high, (6, 8))
    return np.kron(blocks, np.ones((6 * samples, 6 * samples))).astype(np.float32)


def picture_texture(ctx, picture):
    data = np.zeros((*picture.shape, 4), dtype=np.float32)
    data[..., 0] = picture[::-1]
    texture = ctx.texture(picture.shape[::-1], 4, data, dtype="f4")
    texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
    return texture


def chain_report(ctx, sensor, picture, samples, frame=0, exposure=1.0):
    chain = SensorChain(ctx, sensor, SIZE, samples, 0.95)
    target = chain.run(picture_texture(ctx, picture), FIELD, frame, exposure)
    return chain.focus.read("focal_plane")[..., 0], target.read("reported")[..., 0]


@pytest.mark.parametrize("samples", [1, 3])
@pytest.mark.parametrize("name", ["flir1977", "uncooled", "cooled_mwir", "sit1977", "emccd"])
def test_chain_is_its_twin(ctx, name, samples):
    sensor = load_sensor(name)
    look = sensitivity(sensor)
    picture = scene(samples, 0.2 * look.full, 0.9 * look.full)
    focus, report = chain_report(ctx, sensor, picture, samples, frame=7)
    sample = 2.0 * np.tan(0.5 * FIELD) / (SIZE[0] * samples)
    kernel = blur_kernel(sensor, sample, rows=SIZE[1], field=FIELD, energy=0.95)
    places = column_places(SIZE[0], samples, FIELD, equal_angle=sensor.scan.equal_angle)
    light = focal_plane(picture.astype(np.float64), kernel, places, samples)
    assert focus == pytest.approx(light, rel=2e-6)
    twin = read_out(sensor, look, focus.astype(np.float64), 7)
    off = np.abs(report - twin) / look.step
    assert off.max() <= 1.001  # rounding to counts may fall to the other side
    assert np.mean(off > 0.5) < 0.01 + 2e-6 * look.full / look.step


def test_frames_of_one_number_are_the_same_and_of_two_are_not(ctx):
    sensor = load_sensor("uncooled")
    picture = scene(1, 30.0, 60.0)
    first, again, other = (chain_report(ctx, sensor, picture, 1, frame=frame)[1] for frame in (3, 3, 4))
    assert np.array_equal(first, again)
    assert np.mean(first == other) < 0.2


def test_iris_keeps_bright_scenes_below_full(ctx):
    sensor = load_sensor("emccd")
    look = sensitivity(sensor)
    picture = scene(1, 100.0 * look.full, 200.0 * look.full)
    full, stopped = (chain_report(ctx, sensor, picture, 1, exposure=share)[1] for share in (1.0, 1.0 / 250.0))
    assert full == pytest.approx(look.full, rel=1e-5)
    assert stopped.max() < 250.0 * look.full
    assert stopped.mean() == pytest.approx(picture.mean(), rel=0.01)


def test_uniform_scene_without_noise_is_reported_to_a_count(ctx):
    sensor = load_sensor("uncooled")
    detector = dataclasses.replace(sensor.detector, netd=1e-4)
    quiet = dataclasses.replace(sensor, noise=Noise(), detector=detector)
    picture = np.full((SIZE[1], SIZE[0]), 47.0, dtype=np.float32)
    _, report = chain_report(ctx, quiet, picture, 1)
    assert np.abs(report - 47.0).max() <= 0.51 * sensitivity(quiet).step + 5 * 1e-4
