"""Blur, noise, memory, streaks and halo as effects: left out on request, on where a sensor has them, and only there."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from effect_cases import DAYS
from small_world import town_features, write_town
from test_effects_images import ACROSS, COARSE, SIZE

from sensorsim.effects import read_choice
from sensorsim.environment import read_weather
from sensorsim.errors import InputError
from sensorsim.render import Picture, Renderer, World, build_world
from sensorsim.scene import load_scene
from sensorsim.sensor import exposure_for, load_sensor, sensitivity, sensor_parts, sensor_without

PARTS: dict[str, set[str]] = {
    "flir": set(), "lltv": set(), "uncooled": {"blur", "noise", "memory"}, "emccd": {"blur", "noise"},
    "cooled_mwir": {"blur", "noise"}, "flir1977": {"blur", "noise", "streaks", "interlace"},
    "sit1977": {"blur", "noise", "memory", "halo", "interlace"},
}  # fmt: skip
LEFT_OUT = [("uncooled", "blur"), ("uncooled", "noise"), ("uncooled", "memory"), ("flir1977", "streaks"),
            ("flir1977", "interlace"),
            ("emccd", "blur"), ("emccd", "noise"), ("sit1977", "memory")]  # fmt: skip


def built(folder: Path, choice: str, sensor: str) -> World:
    scene = load_scene(write_town(folder, town_features()))
    return build_world(
        scene, read_weather("winter"), image_day=DAYS["winter"], settings=COARSE, effects=read_choice(choice),
        sensor=load_sensor(sensor),
    )  # fmt: skip


def looks(folder: Path, choice: str, sensor: str) -> list[Picture]:
    """Two frames of a camera that turns, as a sequence has them."""
    views = [replace(ACROSS, yaw=ACROSS.yaw + turn) for turn in (0.0, 2.0)]
    with Renderer(built(folder, choice, sensor), load_sensor(sensor), size=SIZE) as renderer:
        return [renderer.render(view, 36000.0, frame=frame) for frame, view in enumerate(views)]


@pytest.mark.parametrize("sensor", PARTS)
def test_sensor_has_the_parts_that_its_file_tells_of(sensor: str) -> None:
    assert sensor_parts(load_sensor(sensor)) == PARTS[sensor]


@pytest.mark.parametrize("sensor", [sensor for sensor, parts in PARTS.items() if parts])
def test_sensor_without_its_parts_has_none_but_those_of_any_detector(sensor: str) -> None:
    left = sensor_without(load_sensor(sensor), PARTS[sensor])
    assert sensor_parts(left) == {"blur", "noise"}
    assert sensitivity(left).constant == sensitivity(left).shot == 0.0


@pytest.mark.parametrize(("sensor", "part"), LEFT_OUT)
def test_part_that_is_left_out_changes_the_signal_by_less_than_its_bound(
    sensor: str, part: str, tmp_path: Path
) -> None:
    whole, lean = looks(tmp_path, "auto", sensor), looks(tmp_path, f"-{part}", sensor)
    assert whole[1].ledger.row(part).on
    assert not lean[1].ledger.row(part).on
    change = [np.abs(one.planes["signal"] - two.planes["signal"]).max() for one, two in zip(whole, lean, strict=True)]
    assert 0.0 < max(change) <= lean[1].ledger.row(part).bound
    assert np.array_equal(whole[1].planes["radiance"], lean[1].planes["radiance"])


@pytest.mark.parametrize("sensor", ["uncooled", "emccd", "cooled_mwir", "flir1977"])
def test_chain_without_its_parts_is_the_picture_in_counts(sensor: str, tmp_path: Path) -> None:
    """To half a count, and a hundredth for single precision."""
    look = sensitivity(load_sensor(sensor))
    for picture in looks(tmp_path, ",".join(f"-{part}" for part in sorted(PARTS[sensor])), sensor):
        radiance = picture.planes["radiance"].astype(np.float64)
        stopped = look.stopped(exposure_for(look, radiance[picture.planes["surface_id"] >= 0]))
        apart = picture.planes["signal"] - np.minimum(radiance, stopped.full)
        assert np.abs(apart).max() <= 0.51 * stopped.step


def test_frames_without_noise_and_memory_are_all_alike(tmp_path: Path) -> None:
    with Renderer(built(tmp_path, "-noise,-memory", "uncooled"), load_sensor("uncooled"), size=SIZE) as renderer:
        first, second = (renderer.render(ACROSS, 36000.0, frame=frame).planes["signal"] for frame in (0, 7))
    assert np.array_equal(first, second)


@pytest.mark.parametrize(("sensor", "part"), [("flir", "noise"), ("uncooled", "halo"), ("emccd", "streaks")])
def test_part_that_a_sensor_does_not_have_cannot_be_asked_for(sensor: str, part: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match=f"whose chain has {part}"):
        built(tmp_path, f"+{part}", sensor)


def test_ideal_sensors_have_no_rows_of_a_chain(tmp_path: Path) -> None:
    rows = {row.effect for row in looks(tmp_path, "all", "flir")[0].ledger.rows}
    assert not rows & {"blur", "noise", "memory", "streaks", "halo"}
