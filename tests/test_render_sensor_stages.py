"""Dead elements, fields, lines, detail and counts in whole frames: shaders and rows against their twins."""

from dataclasses import replace

import numpy as np
import pytest
from small_world import town
from test_render_sensor_chain import FIELD, SIZE, picture_texture, scene

from sensorsim.effects import read_choice
from sensorsim.errors import InputError
from sensorsim.gpu import create_context
from sensorsim.render import Camera, Renderer, look_at
from sensorsim.render.display_stage import DisplayStage
from sensorsim.render.sensor_chain import SensorChain
from sensorsim.sensor import (
    AutoGain,
    DisplaySettings,
    RowChain,
    Sensor,
    display_code,
    enhance_detail,
    load_sensor,
    source_rows,
)
from sensorsim.sensor.dead_elements import living_neighbours, replace_dead
from sensorsim.sensor.raster import weave
from sensorsim.sensor.read_out import fixed_pattern

NOON = 12.0 * 3600.0
VIEWS = [look_at([-60.0 + 4.0 * k, -80.0, 40.0], [20.0, 20.0, 5.0], 40.0) for k in range(4)]


@pytest.fixture(scope="module")
def ctx():
    context = create_context()
    with context:
        yield context
    context.release()


def run_rows(rows: RowChain, picture: np.ndarray, frame: int) -> np.ndarray:
    rows.light[:] = picture
    return rows.run(FIELD, frame)


def with_dead(name: str, share: float, *, replaced: bool) -> Sensor:
    sensor = load_sensor(name)
    return replace(sensor, noise=replace(sensor.noise, dead=share, replaced=replaced))


def lined(lines: int) -> Sensor:
    sensor = load_sensor("sit1977")
    return replace(sensor, scan=replace(sensor.scan, lines=lines))


@pytest.mark.parametrize("share", [0.01, 0.4])
def test_replaced_elements_are_their_twin(ctx, share: float) -> None:
    reports = []
    for replaced in (False, True):
        chain = SensorChain(ctx, with_dead("uncooled", share, replaced=replaced), SIZE, energy=0.95)
        chain.run(picture_texture(ctx, scene(1, 30.0, 60.0)), FIELD, 3)
        reports.append(chain.read(chain.output))
    sees = fixed_pattern(chain.sensor, SIZE)[..., 2]
    assert np.array_equal(reports[0] == 0.0, sees == 0.0)
    assert np.array_equal(reports[1], replace_dead(reports[0], living_neighbours(sees)))
    assert reports[1].min() > 0.0


@pytest.mark.parametrize("sensor", [lined(0), lined(12), replace(lined(7), scan=replace(lined(7).scan, interlace=3))])
def test_woven_pictures_are_their_twin_on_both_roads(ctx, sensor: Sensor) -> None:
    light = replace(sensor, detector=replace(sensor.detector, lag=0.0), intensifier=None)
    chain, plain = (SensorChain(ctx, one, SIZE, energy=0.95) for one in (light, progressive(light)))
    rows = RowChain(light, SIZE, energy=0.95, threads=2)
    plain_rows = RowChain(progressive(light), SIZE, energy=0.95, threads=2)
    full = chain.look.full
    shown, shown_rows = np.zeros(SIZE[::-1], np.float32), np.zeros(SIZE[::-1], np.float32)
    for frame in (4, 5, 6, 7, 9, 10):  # a cut before the ninth
        picture = np.roll(scene(1, 0.2 * full, 0.7 * full), 3 * frame, axis=1)
        source = source_rows(light.scan, SIZE[1], frame, follows=frame not in (4, 9))
        for one in (chain, plain):
            one.run(picture_texture(ctx, picture), FIELD, frame)
        weave(shown, plain.read(plain.output), source)
        assert np.array_equal(chain.read(chain.output), shown)
        weave(shown_rows, run_rows(plain_rows, picture, frame), source)
        assert np.array_equal(run_rows(rows, picture, frame), shown_rows)
    for one in (rows, plain_rows):
        one.release()


def progressive(sensor: Sensor) -> Sensor:
    return replace(sensor, scan=replace(sensor.scan, interlace=1, lines=0))


def test_rows_replace_the_dead_as_the_shader_does(ctx) -> None:
    sensor = with_dead("cooled_mwir", 0.02, replaced=True)
    picture = scene(1, 0.2, 0.8)
    rows = RowChain(sensor, SIZE, energy=0.95, threads=2)
    signal = run_rows(rows, picture, 3)
    assert np.array_equal(signal, replace_dead(rows.reported, living_neighbours(rows.pattern[2])))
    chain = SensorChain(ctx, sensor, SIZE, energy=0.95)
    chain.run(picture_texture(ctx, picture), FIELD, 3)
    assert np.abs(chain.read(chain.output) - signal).max() <= 1.001 * chain.step
    rows.release()


@pytest.mark.parametrize("settings", [
    DisplaySettings(level=45.0, span=20.0, detail=4.0),
    DisplaySettings(level=45.0, span=40.0, detail=0.0, polarity="black-hot"),
])  # fmt: skip
def test_detail_is_its_twin_on_both_roads(ctx, settings: DisplaySettings) -> None:
    """To a code: single precision's rounding decides at their borders."""
    picture = scene(1, 30.0, 60.0) + np.random.default_rng(2).normal(0.0, 0.3, SIZE[::-1]).astype(np.float32)
    enhanced = enhance_detail(picture.astype(np.float64), settings.level, settings.span, settings.detail)
    twin = display_code(enhanced, settings).astype(int)
    rows = RowChain(load_sensor("flir"), SIZE, threads=2)
    run_rows(rows, picture, 0)
    for codes in (DisplayStage(ctx, SIZE).show(picture_texture(ctx, picture), settings, None), rows.show(settings)):
        assert np.abs(codes - twin).max() <= 1
        assert np.mean(codes != twin) < 0.01
    assert np.mean(twin != display_code(picture, settings)) > 0.3
    rows.release()


def test_counts_are_the_signal_over_its_step() -> None:
    for name in ("uncooled", "emccd"):
        with Renderer(town(), load_sensor(name), size=SIZE) as renderer:
            picture = renderer.render(VIEWS[0], NOON)
        counts = picture.planes["counts"]
        assert counts.dtype == np.uint16
        assert counts.max() < 2 ** load_sensor(name).detector.bits
        assert counts * picture.count_step == pytest.approx(picture.planes["signal"], rel=1e-6)


@pytest.mark.parametrize("bits", [17, None])
def test_counts_are_refused_where_no_detector_has_them(bits: int | None) -> None:
    sensor = load_sensor("flir" if bits is None else "uncooled")
    if bits is not None:
        sensor = replace(sensor, detector=replace(sensor.detector, bits=bits))
    with Renderer(town(), sensor, size=SIZE) as renderer, pytest.raises(InputError, match=rf"{sensor.name}.*counts"):
        renderer.render(VIEWS[0], NOON, planes={"counts"})


def frames(world, sensor: Sensor, views: list[Camera], display: DisplaySettings, planes: set[str]) -> list[np.ndarray]:
    """Display codes of a flight at the sensor's own rate."""
    with Renderer(world, sensor, size=SIZE) as renderer:
        return [
            renderer.render(view, NOON + k / 30.0, frame=k, planes=planes, display=display).planes["display"]
            for k, view in enumerate(views)
        ]


def test_flight_of_an_interlaced_sensor_has_a_comb_that_the_switch_takes_away() -> None:
    """Rows of the other field are those of the frame before, on either road."""
    sensor = load_sensor("flir1977")
    settings = DisplaySettings(level=20.0, span=15.0)
    for planes in ({"display"}, {"display", "signal"}):
        shown = frames(town(), sensor, VIEWS, settings, planes)
        whole = frames(town(), progressive(sensor), VIEWS, settings, planes)
        assert np.array_equal(shown[0], whole[0])
        for k in (1, 2, 3):
            assert np.array_equal(shown[k][k % 2 :: 2], whole[k][k % 2 :: 2])
            assert np.array_equal(shown[k][1 - k % 2 :: 2], whole[k - 1][1 - k % 2 :: 2])
            assert not np.array_equal(shown[k], whole[k])


def test_picture_of_another_hour_remembers_nothing() -> None:
    """Bolometers and fields: frames of successive numbers, but a quarter of an hour apart."""
    for name in ("uncooled", "flir1977"):
        with Renderer(town(), load_sensor(name), size=SIZE) as renderer:
            pictures = [renderer.render(VIEWS[0], NOON + 900.0 * k, frame=k).planes["signal"] for k in range(2)]
        with Renderer(town(), load_sensor(name), size=SIZE) as renderer:
            assert np.array_equal(renderer.render(VIEWS[0], NOON + 900.0, frame=1).planes["signal"], pictures[1])


@pytest.mark.parametrize("planes", [{"display"}, {"display", "radiance"}])
def test_settling_gain_goes_by_the_frames_before_on_both_roads(planes: set[str]) -> None:
    settings, gain = DisplaySettings(settle=0.2), AutoGain(1.0 / 30.0)
    with (
        Renderer(town(), load_sensor("flir"), size=SIZE) as renderer,
        Renderer(town(), load_sensor("flir"), size=SIZE) as other,
    ):
        for k, view in enumerate(VIEWS):
            time = NOON + k / 30.0
            alone = other.render(view, time).planes
            gain.begin(k, time)
            expected = gain.window(settings, alone["radiance"][alone["surface_id"] >= 0])
            found = renderer.render(view, time, frame=k, planes=planes, display=settings).display
            assert (found.level, found.span) == pytest.approx((expected.level, expected.span), rel=1e-5)


def test_switches_of_the_effects_take_the_stages_away() -> None:
    sensor = with_dead("sit1977", 0.05, replaced=False)
    sensor = replace(sensor, scan=replace(sensor.scan, lines=12))
    world = town()
    lean = replace(world, choice=read_choice("-dead_elements,-raster_lines,-interlace"))
    with Renderer(lean, sensor, size=SIZE) as renderer:
        bare = renderer.render(VIEWS[0], NOON)
    assert {row.effect for row in bare.ledger.rows if not row.on} >= {"dead_elements", "raster_lines", "interlace"}
    with Renderer(world, progressive(with_dead("sit1977", 0.0, replaced=False)), size=SIZE) as renderer:
        plain = renderer.render(VIEWS[0], NOON)
    assert np.array_equal(bare.planes["signal"], plain.planes["signal"])
    with Renderer(world, sensor, size=SIZE) as renderer:
        whole = renderer.render(VIEWS[0], NOON)
    assert np.mean(whole.planes["counts"] == 0) > 0.02
    assert whole.ledger.row("dead_elements").on
