"""What instruments would measure of pictures of a black body: NETD, noise in three dimensions, half floats."""

import dataclasses
from collections.abc import Iterator

import moderngl
import noise3d
import numpy as np
import pytest

from sensorsim.gpu import create_context
from sensorsim.radiometry import band_radiance, build_band_table
from sensorsim.render.sensor_chain import SensorChain
from sensorsim.sensor import Noise, RowChain, Sensor, load_sensor, netd, sensitivity
from sensorsim.sensor.read_out import fixed_pattern, frame_noise

FIELD = 0.05
SIZE = (320, 240)
NAMES = ("t", "v", "h", "tv", "th", "vh", "tvh")  # in the order of the package


@pytest.fixture(scope="module")
def ctx() -> Iterator[moderngl.Context]:
    context = create_context()
    with context:
        yield context
    context.release()


def uniform(ctx: moderngl.Context, sensor: Sensor, kelvin: float, frame: int) -> np.ndarray:
    """A black body's picture as the sensor reports it."""
    light = np.zeros((SIZE[1], SIZE[0], 4), np.float32)
    light[..., 0] = band_radiance(sensor.band, kelvin)
    texture = ctx.texture(SIZE, 4, light, dtype="f4")
    texture.filter = (moderngl.NEAREST, moderngl.NEAREST)
    chain = SensorChain(ctx, sensor, SIZE, energy=0.95)
    chain.run(texture, FIELD, frame, level=float(light[0, 0, 0]))
    return chain.read(chain.output).astype(np.float64)


@pytest.mark.parametrize("name", ["cooled_mwir", "uncooled", "flir1977"])
@pytest.mark.parametrize("kelvin", [280.0, 300.0, 320.0])
def test_netd_of_rendered_uniform_frames_is_that_of_the_model(ctx: moderngl.Context, name: str, kelvin: float) -> None:
    """To a hundredth: the deviation of 76,800 pixels is true to 0.26 %, well below that hundredth."""
    sensor = dataclasses.replace(load_sensor(name), noise=Noise(seed=3))
    colder, warmer = (uniform(ctx, sensor, kelvin + shift, 1) for shift in (0.0, 0.5))
    measured = colder.std() * 0.5 / (warmer.mean() - colder.mean())
    assert measured == pytest.approx(netd(sensor, kelvin), rel=0.01)


def injected(sensor: Sensor, frames: int) -> dict[str, float]:
    """Standard deviations of the deviates that the frames had: so few of them have not that of the distribution."""
    found = {"tvh": 1.0}
    for name in NAMES[:-1]:
        alone = Noise(seed=sensor.noise.seed, **{name: getattr(sensor.noise, name)})
        only = dataclasses.replace(sensor, noise=alone)
        if name == "vh":
            found[name] = float(fixed_pattern(only, SIZE)[..., 0].std())
            continue
        moments = [frame_noise(only, SIZE, frame) for frame in range(frames)]
        found[name] = float(np.std([(one.line if "h" in name else one.row) for one in moments]))
    return found


def test_independent_package_recovers_the_noise_of_a_sequence() -> None:
    """noise3d 0.0.2, corrected for the leaking of means into components of fewer directions, to two hundredths."""
    frames = 96
    noise = Noise(t=0.8, v=0.9, h=1.1, tv=0.7, th=0.6, vh=1.2, seed=2)
    plain = load_sensor("uncooled")
    detector = dataclasses.replace(plain.detector, bits=16, response_time=0.0)
    sensor = dataclasses.replace(plain, noise=noise, detector=detector)
    light = float(band_radiance(sensor.band, 300.0))
    chain = RowChain(sensor, SIZE, energy=0.95)
    chain.light[:] = light
    cube = np.stack([chain.run(FIELD, frame).astype(np.float64) for frame in range(frames)])
    chain.release()
    variance = noise3d.get_all_3d_corrected_var_matrix(cube / float(sensitivity(sensor).deviation(light)))
    recovered = dict(zip(NAMES, np.sqrt(variance[:7]).tolist(), strict=True))
    assert recovered == pytest.approx(injected(sensor, frames), rel=0.02)


def test_half_floats_would_cost_more_than_five_millikelvin_and_single_ones_do_not(ctx: moderngl.Context) -> None:
    """So pictures are held in single precision: radiance by half costs tens of millikelvin, temperature a tenth."""
    table = build_band_table(load_sensor("flir").band)
    kelvin = np.linspace(240.0, 320.0, 4001)
    radiance = table.radiance_at(kelvin)
    cost = {
        kind: np.abs(table.apparent_temperature(radiance.astype(kind).astype(np.float64)) - kelvin).max()
        for kind in (np.float16, np.float32)
    }
    assert cost[np.float16] > 0.02
    assert cost[np.float32] < 1e-4
    assert np.abs(kelvin.astype(np.float16).astype(np.float64) - kelvin).max() > 0.1
    chain = SensorChain(ctx, load_sensor("sit1977"), SIZE, energy=0.95)
    assert {target.texture("picture").dtype for target in chain.targets.values()} == {"f4"}
