"""The passes of the sensor against their NumPy twins, on pictures made for the purpose."""

import dataclasses

import moderngl
import numpy as np
import pytest

from sensorsim.gpu import create_context
from sensorsim.render.sensor_chain import SensorChain
from sensorsim.sensor import (
    HALO_BLOCK,
    STREAK_BLOCK,
    Noise,
    blur_kernel,
    column_places,
    focal_plane,
    halo_radius,
    kept_per_block,
    load_sensor,
    read_out,
    remember,
    renewed_share,
    sensitivity,
)
from sensorsim.sensor.spill import baseline, halo, spread_blocks

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
    chain = SensorChain(ctx, sensor, SIZE, samples=samples, energy=0.95)
    chain.run(picture_texture(ctx, picture), FIELD, frame, exposure=exposure)
    return chain.read("focal_plane"), chain.read("reported")


def without_spill(sensor):
    return dataclasses.replace(sensor, intensifier=None, scan=dataclasses.replace(sensor.scan, ac_coupling=0.0))


def quiet(sensor):
    detector = sensor.detector
    if detector.kind == "photon":
        detector = dataclasses.replace(detector, read_noise=0.0, dark_current=0.0, excess_noise=1.0, bits=24)
    else:
        detector = dataclasses.replace(detector, bits=24)
    return dataclasses.replace(sensor, noise=Noise(), detector=detector)


@pytest.mark.parametrize("samples", [1, 3])
@pytest.mark.parametrize("name", ["flir1977", "uncooled", "cooled_mwir", "sit1977", "emccd"])
def test_blur_noise_and_counts_are_their_twins(ctx, name, samples):
    sensor = without_spill(load_sensor(name))
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
    calm = dataclasses.replace(sensor, noise=Noise(), detector=detector)
    picture = np.full((SIZE[1], SIZE[0]), 47.0, dtype=np.float32)
    _, report = chain_report(ctx, calm, picture, 1)
    assert np.abs(report - 47.0).max() <= 0.51 * sensitivity(calm).step + 5 * 1e-4


def test_capacitors_take_each_rows_own_level_and_leave_a_streak_behind_hot_objects(ctx):
    sensor = load_sensor("flir1977")
    look = sensitivity(sensor)
    picture = np.full((SIZE[1], SIZE[0]), 30.0, dtype=np.float32)
    picture[10:14, 4:16] = 60.0
    chain = SensorChain(ctx, sensor, SIZE, energy=0.95)
    chain.run(picture_texture(ctx, picture), FIELD, 3, level=30.0)
    light = chain.read("focal_plane").astype(np.float64)
    level = baseline(light, kept_per_block(sensor, FIELD, SIZE))
    assert chain.read("baseline") == pytest.approx(level, rel=1e-5)
    streaked = light + 30.0 - spread_blocks(level, SIZE, STREAK_BLOCK, 1)
    twin = read_out(sensor, look, streaked, 3)
    assert np.abs(chain.read("reported") - twin).max() <= 1.001 * look.step
    assert streaked[12, 30] < 27.0  # behind the hot object the row is dark
    assert streaked[25, 30] == pytest.approx(30.0, abs=1e-4)


def test_uniform_scene_keeps_its_level_through_capacitors(ctx):
    sensor = load_sensor("flir1977")
    picture = np.full((SIZE[1], SIZE[0]), 41.0, dtype=np.float32)
    chain = SensorChain(ctx, sensor, SIZE, energy=0.95)
    chain.run(picture_texture(ctx, picture), FIELD, 0, level=41.0)
    assert chain.read("baseline") == pytest.approx(np.full((SIZE[1], 3), 41.0), rel=1e-6)


def test_halo_of_a_light_is_a_disc_that_holds_its_share(ctx):
    sensor = load_sensor("sit1977")
    look = sensitivity(sensor)
    picture = np.full((SIZE[1], SIZE[0]), 0.1 * look.full, dtype=np.float32)
    picture[16:20, 24:28] = 50.0 * look.full
    chain = SensorChain(ctx, sensor, SIZE, energy=0.95)
    chain.run(picture_texture(ctx, picture), FIELD, 0)
    light = chain.read("focal_plane").astype(np.float64)
    radius = halo_radius(sensor, FIELD, SIZE[0])
    twin = halo(light, look.full, sensor.intensifier.halo_share, radius)
    assert chain.read("halo") == pytest.approx(twin, rel=1e-4, abs=1e-7)
    excess = np.maximum(light - look.full, 0.0).mean()
    assert twin.mean() == pytest.approx(sensor.intensifier.halo_share * excess, rel=1e-6)
    spread = spread_blocks(twin, SIZE, HALO_BLOCK, HALO_BLOCK)
    assert np.abs(chain.read("reported") - read_out(sensor, look, light + spread, 0)).max() <= 1.001 * look.step


def test_light_below_saturation_has_no_halo(ctx):
    sensor = load_sensor("sit1977")
    picture = np.full((SIZE[1], SIZE[0]), 0.9 * sensitivity(sensor).full, dtype=np.float32)
    chain = SensorChain(ctx, sensor, SIZE, energy=0.95)
    chain.run(picture_texture(ctx, picture), FIELD, 0)
    assert chain.read("halo").max() == 0.0


@pytest.mark.parametrize("name", ["uncooled", "sit1977"])
def test_memory_closes_in_on_a_new_picture_by_its_share(ctx, name):
    sensor = quiet(without_spill(load_sensor(name)))
    look, share = sensitivity(sensor), renewed_share(sensor)
    low, high = 0.2 * look.full, 0.6 * look.full
    pictures = [np.full((SIZE[1], SIZE[0]), light, dtype=np.float32) for light in (low, high)]
    chain = SensorChain(ctx, sensor, SIZE, energy=0.95)
    chain.run(picture_texture(ctx, pictures[0]), FIELD, 0)
    expected = low
    for frame in (1, 2, 3):
        chain.run(picture_texture(ctx, pictures[1]), FIELD, frame)
        expected = remember(expected, high, share)
        assert chain.read("remembered") == pytest.approx(np.full((SIZE[1], SIZE[0]), expected), rel=1e-5)
    chain.run(picture_texture(ctx, pictures[0]), FIELD, 9)  # a cut: nothing is left of what was before
    assert chain.read("remembered") == pytest.approx(pictures[0], rel=1e-6)


def test_bolometer_forgets_by_its_time_constant():
    sensor = load_sensor("uncooled")
    assert renewed_share(sensor) == pytest.approx(1.0 - np.exp(-1.0 / 30.0 / 0.010), rel=1e-12)
    assert renewed_share(load_sensor("flir")) == 1.0
