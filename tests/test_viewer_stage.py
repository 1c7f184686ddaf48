"""Probe, off-screen pictures, sensors without noise or blur, and bakes in the background."""

import threading
from collections.abc import Iterator
from dataclasses import replace
from datetime import date

import numpy as np
import pytest
import small_world

from sensorsim.errors import InputError
from sensorsim.render import Renderer, World, station_camera
from sensorsim.sensor import DisplaySettings, load_sensor, sensitivity
from sensorsim.sensor.load import sensor_names
from sensorsim.tables.bake import Progress
from sensorsim.viewer import Place, Stage, ViewState, day_of_surface, probe_pixel
from sensorsim.viewer.baker import Baker
from sensorsim.viewer.choices import centre_range, seen, stations
from sensorsim.viewer.fit_errors import FitMeter
from sensorsim.viewer.probe import histogram
from sensorsim.viewer.stage import SCALES, drawn_size, next_scale, picture_tone
from sensorsim.viewer.variants import varied

SIZE = (160, 120)
NOON = 43200.0
PLACE = Place(level="IIIB", weather="winter", day=small_world.DAY)


def state(**changes: object) -> ViewState:
    camera = station_camera(small_world.town().scene, "overhead")
    base = ViewState(camera=camera, time_of_day=NOON, place=PLACE, sensors=("flir", "lltv"))
    return replace(base, **changes)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def stage() -> Iterator[Stage]:
    made = Stage(small_world.town(), {name: load_sensor(name) for name in ("flir", "lltv", "uncooled")})
    yield made
    made.release()


# --- probe -------------------------------------------------------------------------------------------------------


def test_the_probe_tells_the_surface_that_the_pixel_sees() -> None:
    world = small_world.town()
    with Renderer(world, load_sensor("flir"), size=SIZE) as renderer:
        picture = renderer.render(state().camera, NOON)
    ids = picture.planes["surface_id"]
    for surface in np.unique(ids[ids >= 0]):
        row, column = np.argwhere(ids == surface)[0]
        probe = probe_pixel(world, picture, int(column), int(row))
        assert probe is not None
        assert probe.surface == surface
        assert probe.role == world.scene.surfaces.role[surface]
        feature = world.scene.features[int(world.scene.surfaces.feature[surface])]
        assert probe.feature.startswith(feature.number)
        time, kelvin = day_of_surface(world, int(surface), 49)
        assert probe.temperature == pytest.approx(kelvin[time == NOON][0], abs=0.005)  # shader against its twin
        assert probe.range is not None
        assert probe.range > 100.0


def test_the_probe_knows_the_sky_and_the_edge() -> None:
    world = small_world.town()
    up = replace(state().camera, pitch=60.0)
    with Renderer(world, load_sensor("lltv"), size=SIZE) as renderer:
        picture = renderer.render(up, NOON)
    probe = probe_pixel(world, picture, 5, 5)
    assert probe is not None
    assert (probe.feature, probe.surface, probe.temperature, probe.range) == ("sky", None, None, None)
    assert probe.apparent_temperature is None
    assert probe.radiance > 0.0
    for column, row in ((-1, 0), (0, -1), (SIZE[0], 0), (0, SIZE[1])):
        assert probe_pixel(world, picture, column, row) is None


# --- stage -------------------------------------------------------------------------------------------------------


def test_two_sensors_see_the_same_surfaces_side_by_side(stage: Stage) -> None:
    shots = stage.draw(state(side_by_side=True), SIZE)
    assert [shot.sensor.name for shot in shots] == ["flir", "lltv"]
    assert np.array_equal(shots[0].picture.planes["surface_id"], shots[1].picture.planes["surface_id"])
    assert shots[0].colours.shape == (*SIZE[::-1], 3)
    assert stage.seconds > 0.0


def test_colours_are_the_display_through_the_palette_and_the_scale_is_its_window(stage: Stage) -> None:
    (grey,) = stage.draw(state(), SIZE)
    (iron,) = stage.draw(state(palette="iron"), SIZE)
    assert np.array_equal(grey.colours[:, :, 0], grey.picture.planes["display"])
    assert np.array_equal(iron.picture.planes["display"], grey.picture.planes["display"])
    assert not np.array_equal(iron.colours, grey.colours)
    assert picture_tone(grey) is None


def test_a_choice_that_cannot_be_drawn_says_so_and_the_next_one_is_drawn(stage: Stage) -> None:
    lost = {"flir": DisplaySettings(level=40.0, span=1e-30)}
    with pytest.raises(InputError, match="span"):
        stage.draw(state(displays=lost), SIZE)
    with pytest.raises(InputError, match="atmosphere"):
        stage.draw(state(atmosphere="none at all"), SIZE)
    assert stage.draw(state(), SIZE)[0].picture.planes["range"].shape == SIZE[::-1]


def test_a_frame_that_is_saved_is_the_picture_on_show(stage: Stage) -> None:
    asked = state(sensors=("uncooled", "lltv"), frame=17)
    (shot,) = stage.draw(asked, SIZE)
    frame = stage.frame(asked, shot)
    assert np.array_equal(frame.plane("display").data, shot.picture.planes["display"])
    assert frame.settings["time_of_day_s"] == NOON


def test_renderers_are_kept_for_the_way_back_and_not_without_end(stage: Stage) -> None:
    first = stage.draw(state(), SIZE)[0].renderer
    for name in ("lltv", "uncooled", "flir"):
        stage.draw(state(sensors=(name, "lltv")), SIZE)
    assert stage.draw(state(), SIZE)[0].renderer is first
    for width in (40, 48, 56, 64):
        stage.draw(state(), (width, 40))
    assert stage.draw(state(), SIZE)[0].renderer is not first


def test_what_is_seen_lists_the_choices(stage: Stage) -> None:
    shots = stage.draw(state(), SIZE)
    facts = seen(stage.world, stage.sensors, shots, (), 320.0)
    assert facts.sensors == ("flir", "lltv", "uncooled")
    assert facts.shown["flir"] == shots[0].picture.display
    assert facts.distance == centre_range(shots[0])
    assert len(stations(stage.world)) == 1
    assert seen(stage.world, stage.sensors, (), (), 320.0).distance is None


def test_shares_of_the_histogram_sum_to_nearly_all_pixels(stage: Stage) -> None:
    for name, unit in (("flir", "K"), ("lltv", "W m-2 sr-1")):
        (shot,) = stage.draw(state(sensors=(name, "uncooled")), SIZE)
        shares, low, high, named = histogram(shot.picture)
        assert named == unit
        assert low < high
        assert 0.99 < shares.sum() <= 1.0


def test_slow_pictures_get_coarser_and_quick_ones_finer() -> None:
    assert next_scale(2.0, np.full(8, 0.2)) == 3.0
    assert next_scale(2.0, np.full(8, 0.001)) == 1.5
    assert next_scale(2.0, np.full(8, 0.03)) == 2.0
    assert next_scale(2.0, np.full(3, 0.2)) == 2.0
    assert next_scale(SCALES[-1], np.full(8, 9.0)) == SCALES[-1]
    assert next_scale(SCALES[0], np.full(8, 0.0)) == SCALES[0]
    assert drawn_size(980.0, 658.0, 2, 2.0) == (245, 329)
    assert drawn_size(1.0, 1.0, 2, 4.0) == (16, 16)


def test_without_air_the_far_ground_is_as_warm_as_it_is(stage: Stage) -> None:
    seen_through, bare = (stage.draw(state(atmosphere=air), SIZE)[0].picture.planes for air in ("standard", "none"))
    ground = bare["surface_id"] >= 0
    loss = seen_through["apparent_temperature"][ground] - bare["apparent_temperature"][ground]
    assert 0.05 < np.abs(loss).mean() < 5.0


def test_the_error_of_the_fit_is_that_of_the_world_it_was_measured_in() -> None:
    meter, world = FitMeter(), small_world.town()
    assert meter.found(world) is None
    meter.measure(world, NOON)
    meter.measure(world, 0.0)  # dropped: one at a time
    waiting = threading.Event()
    for _ in range(3000):
        if meter.found(world) is not None or "measuring" not in meter.note:
            break
        waiting.wait(0.01)
    found = meter.found(world)
    assert found is not None, meter.note
    assert found.time_of_day == NOON
    assert found.error.shape == (world.scene.surfaces.area.size,)
    assert np.all((found.error >= 0.0) & (found.error < 5.0))
    assert meter.found(replace(world, warnings=())) is None


# --- sensors without noise and blur ------------------------------------------------------------------------------


@pytest.mark.parametrize("name", sensor_names())
def test_without_noise_the_full_signal_stays_and_the_deviation_falls(name: str) -> None:
    sensor = load_sensor(name)
    quiet = varied(sensor, noise=False, blur=True)
    assert varied(sensor, noise=True, blur=True) is sensor
    if sensor.detector is None:
        assert varied(sensor, noise=False, blur=False) is sensor
        return
    loud, silent = sensitivity(sensor), sensitivity(quiet)
    assert silent.full == pytest.approx(loud.full, rel=1e-9)
    assert silent.step == pytest.approx(loud.step, rel=1e-9)
    half = 0.5 * loud.full
    assert silent.deviation(half) < 0.05 * loud.deviation(half)
    assert (quiet.noise.vh, quiet.noise.gain, quiet.noise.dead) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("name", [name for name in sensor_names() if load_sensor(name).optics is not None])
def test_without_blur_only_diffraction_and_the_elements_are_left(name: str) -> None:
    sharp = varied(load_sensor(name), noise=True, blur=False)
    assert sharp.optics is not None
    assert (sharp.optics.blur, sharp.optics.jitter, sharp.optics.drift, sharp.optics.defocus) == (0.0, 0.0, 0.0, 0.0)
    assert sharp.noise == load_sensor(name).noise


def test_edges_are_steeper_without_blur(stage: Stage) -> None:
    near = replace(state().camera, horizontal_field_of_view=2.0)  # pixels finer than the blur

    def steepest(*, blur: bool) -> float:
        asked = state(sensors=("uncooled", "lltv"), camera=near, noise=False, blur=blur)
        return float(np.abs(np.diff(stage.draw(asked, SIZE)[0].picture.planes["signal"], axis=1)).max())

    assert steepest(blur=False) > 1.03 * steepest(blur=True)  # the elements' size blurs most


def test_noise_switched_off_is_gone_from_the_picture(stage: Stage) -> None:
    def spread(**changes: object) -> float:
        first, second = (
            stage.draw(state(sensors=("uncooled", "lltv"), frame=frame, **changes), SIZE)[0] for frame in (0, 50)
        )
        difference = first.picture.planes["signal"] - second.picture.planes["signal"]
        return float(np.std(difference[first.picture.planes["surface_id"] >= 0]))

    assert spread(noise=False) < 0.05 * spread(noise=True)


# --- bakes -------------------------------------------------------------------------------------------------------


def collected(baker: Baker) -> object:
    """The job that ends within ten seconds."""
    waiting = threading.Event()
    for _ in range(1000):
        done = baker.collect()
        if done is not None:
            return done
        waiting.wait(0.01)
    raise AssertionError("no job ended")


def test_a_bake_reports_and_hands_over_whole() -> None:
    go = threading.Event()

    def build(place: Place, progress: Progress) -> World:  # noqa: ARG001
        progress("brick", 1, 4)
        go.wait(10.0)
        return small_world.town()

    baker = Baker(build)
    assert not baker.busy
    baker.ask(PLACE)
    assert baker.busy
    assert baker.collect() is None
    waiting = threading.Event()
    for _ in range(500):
        if "1 of 4" in baker.note:
            break
        waiting.wait(0.01)
    assert "winter" in baker.note
    assert "1 of 4 (brick)" in baker.note
    go.set()
    done = collected(baker)
    assert done.world is small_world.town()  # type: ignore[attr-defined]
    assert not baker.busy
    assert baker.note == ""


def test_of_several_that_wait_only_the_last_is_baked() -> None:
    go, built = threading.Event(), []

    def build(place: Place, progress: Progress) -> World:  # noqa: ARG001
        built.append(place.level)
        go.wait(10.0)
        return small_world.town()

    baker = Baker(build)
    for level in ("IA", "IIA", "IIIB"):
        baker.ask(replace(PLACE, level=level))
    go.set()
    done = collected(baker)
    assert done.place.level == "IIIB"  # type: ignore[attr-defined]
    assert built == ["IA", "IIIB"]


@pytest.mark.parametrize(
    ("error", "text"),
    [(InputError("w.csv", "day", date(1, 1, 1), "not covered", "another"), "not covered"), (KeyError("x"), "KeyError")],
)
def test_a_bake_that_fails_says_why_and_gives_no_world(error: Exception, text: str) -> None:
    def build(place: Place, progress: Progress) -> World:  # noqa: ARG001
        raise error

    baker = Baker(build)
    baker.ask(PLACE)
    done = collected(baker)
    assert done.world is None  # type: ignore[attr-defined]
    assert text in done.problem  # type: ignore[attr-defined]
