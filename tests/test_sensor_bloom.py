"""Charge above a full well in the others of its column."""

from collections.abc import Iterator
from dataclasses import replace

import moderngl
import numpy as np
import pytest
from test_render_sensor_chain import FIELD, SIZE, picture_texture

from sensorsim.errors import InputError
from sensorsim.gpu import create_context
from sensorsim.render.sensor_chain import SensorChain
from sensorsim.sensor import Noise, RowChain, Sensor, load_sensor, sensitivity, sensor_parts, sensor_without
from sensorsim.sensor.bloom import bloomed

FULL = 10.0


@pytest.fixture(scope="module")
def ctx() -> Iterator[moderngl.Context]:
    context = create_context()
    with context:
        yield context
    context.release()


def blooming(share: float = 1.0) -> Sensor:
    sensor = load_sensor("emccd")
    return replace(sensor, noise=Noise(random=0.0), detector=replace(sensor.detector, blooming=share))


def lit(dark: float, bright: float) -> np.ndarray:
    light = np.full((61, 5), dark)
    light[30, 2] = bright
    return light


def test_charge_is_kept_and_fills_one_well_after_the_other() -> None:
    light = lit(4.0, 100.0)
    after = bloomed(light, FULL, 1.0)
    assert after.sum() == pytest.approx(light.sum(), rel=1e-12)
    assert after.max() == FULL
    assert np.flatnonzero(after[:, 2] == FULL).tolist() == list(range(23, 38))  # 45 on each side: seven wells of 6
    assert after[22, 2] == after[38, 2] == pytest.approx(4.0 + 45.0 - 42.0)
    assert np.array_equal(np.delete(after, 2, axis=1), np.delete(light, 2, axis=1))


@pytest.mark.parametrize("share", [0.0, 0.25])
def test_drain_takes_the_rest(share: float) -> None:
    light = lit(4.0, 100.0)
    assert bloomed(light, FULL, share).sum() == pytest.approx(light.sum() - (1.0 - share) * 90.0, rel=1e-12)


def test_picture_without_a_full_well_stays() -> None:
    light = np.random.default_rng(1).uniform(0.0, FULL, (20, 7))
    assert bloomed(light, FULL, 1.0) == pytest.approx(light, rel=1e-15)


def test_charge_at_the_edge_is_gone() -> None:
    light = lit(4.0, 4.0)
    light[0, 2] = 30.0
    after = bloomed(light, FULL, 1.0)
    assert after.sum() == pytest.approx(light.sum() - 10.0, rel=1e-12)
    assert np.all(bloomed(lit(4.0, 1e9), FULL, 1.0)[:, 2] == FULL)


def test_blooming_is_its_twin_on_both_roads(ctx: moderngl.Context) -> None:
    """To a count, where single precision rounds to another."""
    sensor = blooming()
    full = sensitivity(sensor).full
    picture = np.random.default_rng(3).uniform(0.1 * full, 0.3 * full, SIZE[::-1]).astype(np.float32)
    picture[17, 20], picture[5, 31] = 60.0 * full, 20.0 * full
    chain = SensorChain(ctx, sensor, SIZE, energy=0.95)
    chain.run(picture_texture(ctx, picture), FIELD, 0)
    focus = chain.read("focal_plane").astype(np.float64)
    twin = bloomed(focus, full, 1.0)
    assert np.sum(twin >= full) > np.sum(focus >= full) + 5
    assert chain.read("bloomed") == pytest.approx(twin, abs=1e-5 * full)
    rows = RowChain(sensor, SIZE, energy=0.95, threads=2)
    rows.light[:] = picture
    assert np.abs(rows.run(FIELD, 0) - chain.read(chain.output)).max() <= 1.001 * chain.step
    rows.release()


def test_blooming_is_a_part_of_its_own() -> None:
    assert "blooming" in sensor_parts(blooming())
    assert sensor_without(blooming(), {"blooming"}).detector == blooming(0.0).detector
    assert "blooming" not in sensor_parts(blooming(0.0))


def test_tube_with_wells_that_spill_is_refused() -> None:
    sensor = load_sensor("sit1977")
    with pytest.raises(InputError, match=r"detector\.blooming = 0\.5"):
        replace(sensor, detector=replace(sensor.detector, blooming=0.5))
