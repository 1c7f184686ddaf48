"""The processor's chain against the NumPy twins of each of its steps."""

import dataclasses
from collections.abc import Iterator

import numpy as np
import pytest

from sensorsim.errors import NumericsError
from sensorsim.sensor import (
    DisplaySettings,
    RowChain,
    blur_kernel,
    column_places,
    display_code,
    focal_plane,
    halo_radius,
    kept_per_block,
    load_sensor,
    read_out,
    remember,
    renewed_share,
    sampled_surfaces,
    sensitivity,
)
from sensorsim.sensor.exposure import ENOUGH, exposure_for
from sensorsim.sensor.raster import source_rows, weave
from sensorsim.sensor.spill import HALO_BLOCK, STREAK_BLOCK, baseline, block_mean, halo, spread_blocks

SIZE = (52, 36)
FIELD = 0.05


def scene(samples: int, low: float, high: float) -> np.ndarray:
    """Blocks of light, the first row at the top."""
    blocks = np.random.default_rng(5).uniform(low, high, (6, 13))
    return np.kron(blocks, np.ones((6 * samples, 4 * samples))).astype(np.float32)


@pytest.fixture
def chains() -> Iterator[list[RowChain]]:
    made: list[RowChain] = []
    yield made
    for chain in made:
        chain.release()


def chain_for(chains: list[RowChain], name: str, samples: int = 1, **changes: object) -> RowChain:
    sensor = dataclasses.replace(load_sensor(name), **changes)
    chains.append(RowChain(sensor, SIZE, samples=samples, energy=0.95, threads=3))
    return chains[-1]


def run(chain: RowChain, picture: np.ndarray, frame: int) -> np.ndarray:
    """What the chain reports of a picture, its first row at the top."""
    chain.light[:] = picture
    return chain.run(FIELD, frame)


def twin(chain: RowChain, picture: np.ndarray, frame: int) -> tuple[np.ndarray, np.ndarray]:
    """Light on the focal plane, and what is reported of the chain's own light with streaks and halo."""
    sensor, samples = chain.sensor, chain.samples
    sample = 2.0 * np.tan(0.5 * FIELD) / (SIZE[0] * samples)
    kernel = blur_kernel(sensor, sample, rows=SIZE[1], field=FIELD, energy=0.95)
    assert kernel is not None
    places = column_places(SIZE[0], samples, FIELD, equal_angle=sensor.scan.equal_angle)
    light = focal_plane(picture.astype(np.float64), kernel, places, samples)
    seen = picture[samples // 2 :: samples, samples // 2 :: samples]
    look = sensitivity(sensor)
    look = look.stopped(exposure_for(look, seen))
    shown = chain.focus.astype(np.float64)
    if sensor.scan.ac_coupling > 0.0:
        level = baseline(shown, kept_per_block(sensor, FIELD, SIZE))
        shown = shown + float(np.mean(seen, dtype=np.float64)) - spread_blocks(level, SIZE, STREAK_BLOCK, 1)
    if sensor.intensifier is not None:
        around = halo(shown, look.full, sensor.intensifier.halo_share, halo_radius(sensor, FIELD, SIZE[0]))
        shown = shown + spread_blocks(around, SIZE, HALO_BLOCK, HALO_BLOCK)
    return light, read_out(sensor, look, shown, frame)


@pytest.mark.parametrize("samples", [1, 3])
@pytest.mark.parametrize("name", ["flir1977", "uncooled", "cooled_mwir", "sit1977", "emccd"])
def test_report_is_its_twin_to_a_count(chains: list[RowChain], name: str, samples: int) -> None:
    """Expected: light to 2e-6, counts that differ by one in one of a hundred elements at most."""
    chain = chain_for(chains, name, samples)
    full = sensitivity(chain.sensor).full
    picture = scene(samples, 0.2 * full, 0.9 * full)
    signal = run(chain, picture, 7)
    light, reported = twin(chain, picture, 7)
    assert chain.focus == pytest.approx(light, rel=2e-6)
    look = sensitivity(chain.sensor)
    step = look.step / exposure_for(look, chain.seen(chain.light))
    off = np.abs(signal - reported) / step
    assert off.max() <= 1.001 + 1e-6 * full / step
    assert np.mean(off > 0.5) < 0.01 + 2e-6 * full / step


def test_lights_beyond_saturation_have_their_halo(chains: list[RowChain]) -> None:
    chain = chain_for(chains, "sit1977")
    full = sensitivity(chain.sensor).full
    picture = np.full((SIZE[1], SIZE[0]), 0.1 * full, dtype=np.float32)
    picture[4, 24] = 5000.0 * full  # too small for the iris to mind
    run(chain, picture, 0)
    assert exposure_for(sensitivity(chain.sensor), chain.seen(chain.light)) == 1.0
    assert chain.signal[4, 24] == pytest.approx(full, rel=1e-6)
    _, reported = twin(chain, picture, 0)
    assert np.abs(chain.signal - reported).max() <= 1.001 * sensitivity(chain.sensor).step


@pytest.mark.parametrize("name", ["uncooled", "sit1977"])
def test_memory_follows_its_share_and_ends_at_a_cut(chains: list[RowChain], name: str) -> None:
    chain = chain_for(chains, name)
    full, share = sensitivity(chain.sensor).full, renewed_share(chain.sensor)
    dim, bright = (np.full((SIZE[1], SIZE[0]), part * full, dtype=np.float32) for part in (0.2, 0.6))
    run(chain, dim, 0)
    expected = 0.2 * full
    for frame in (1, 2, 3):
        run(chain, bright, frame)
        expected = remember(expected, 0.6 * full, share)
        assert chain.held == pytest.approx(np.full(chain.held.shape, expected), rel=1e-5)
    run(chain, dim, 9)
    assert chain.held == pytest.approx(dim, rel=1e-6)


@pytest.mark.parametrize("samples", [1, 3])
@pytest.mark.parametrize("fields", [2, 3])
def test_fields_in_turn_are_woven_of_reports_of_all_rows(chains: list[RowChain], fields: int, samples: int) -> None:
    """Expected: to the bit, though a chain makes only the rows that a frame brings; frame 7 follows on none."""
    scan = dataclasses.replace(load_sensor("flir1977").scan, interlace=fields)
    chain, anew = (chain_for(chains, "flir1977", samples, scan=scan) for _ in range(2))
    full, shown = sensitivity(chain.sensor).full, np.zeros((SIZE[1], SIZE[0]), np.float32)
    for frame in (3, 4, 5, 7, 8):
        picture = np.roll(scene(samples, 0.2 * full, 0.9 * full), 5 * frame, axis=1)
        anew.cut()
        weave(shown, run(anew, picture, frame), source_rows(scan, SIZE[1], frame, follows=frame not in (3, 7)))
        assert np.array_equal(run(chain, picture, frame), shown)


@pytest.mark.parametrize("threads", [1, 2, 5, 64])
def test_threads_do_not_show(threads: int) -> None:
    picture = scene(1, 30.0, 60.0)
    results = []
    for number in (1, threads):
        chain = RowChain(load_sensor("flir1977"), SIZE, energy=0.95, threads=number)
        results.append(run(chain, picture, 3).copy())
        chain.release()
    assert np.array_equal(*results)


@pytest.mark.parametrize(
    "settings",
    [
        DisplaySettings(level=45.0, span=20.0),
        DisplaySettings(level=45.0, span=20.0, polarity="black-hot"),
        DisplaySettings(level=40.0, span=1.0, gamma=2.2),
    ],
)
def test_codes_are_those_of_the_display(chains: list[RowChain], settings: DisplaySettings) -> None:
    """Expected: the same but within 1e-3 of a code's border, where single precision decides."""
    chain = chain_for(chains, "flir")
    rng = np.random.default_rng(3)
    picture = rng.uniform(30.0, 60.0, (SIZE[1], SIZE[0])).astype(np.float32)
    run(chain, picture, 0)
    assert np.array_equal(chain.signal, picture)  # an ideal sensor
    curve = None if settings.is_straight else np.linspace(0.0, 1.0, 512) ** (1.0 / settings.gamma)
    codes = chain.show(settings, curve)
    expected = display_code(picture, settings, curve)
    assert np.mean(codes != expected) < 2e-3
    assert np.abs(codes.astype(int) - expected).max() <= 1


def test_sky_is_marked_and_left_out_of_the_gain(chains: list[RowChain]) -> None:
    chain = chain_for(chains, "flir")
    picture = np.full((SIZE[1], SIZE[0]), 40.0, dtype=np.float32)
    picture[:10] = 7.0
    chain.surface[:10] = False
    run(chain, picture, 0)
    assert np.array_equal(chain.signal, picture)
    assert np.unique(chain.seen(chain.signal)).tolist() == [40.0]


def test_picture_that_is_not_finite_is_refused(chains: list[RowChain]) -> None:
    chain = chain_for(chains, "flir")
    for bad in (np.nan, np.inf, -np.inf):
        picture = np.full((SIZE[1], SIZE[0]), 40.0, dtype=np.float32)
        picture[3, 4] = bad
        with pytest.raises(NumericsError, match="not finite"):
            run(chain, picture, 0)


@pytest.mark.parametrize("shape", [(1, 1), (7, 5), (96, 72), (480, 640), (2000, 3000), (3, 100000)])
def test_gain_goes_by_enough_pixels_and_not_by_many_more(shape: tuple[int, int]) -> None:
    picture = np.arange(shape[0] * shape[1], dtype=np.float64).reshape(shape)
    for surface in (np.ones(shape, bool), np.zeros(shape, bool)):
        chosen = sampled_surfaces(picture, surface)
        assert min(picture.size, ENOUGH) * 0.5 <= chosen.size <= 4.1 * ENOUGH
        assert np.isin(chosen, picture).all()


def test_means_of_blocks_are_their_means() -> None:
    """Expected: each block's own mean, blocks counted from the lower left, those at the far edges smaller."""
    light = np.random.default_rng(1).uniform(0.0, 1.0, (7, 10))
    means = block_mean(light, 4, 3)
    assert means.shape == (3, 3)
    flipped = light[::-1]
    for row in range(3):
        for column in range(3):
            part = flipped[3 * row : 3 * row + 3, 4 * column : 4 * column + 4]
            assert means[2 - row, column] == pytest.approx(part.mean(), rel=1e-12)
