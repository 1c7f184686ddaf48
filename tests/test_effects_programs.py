"""The programs of frames: every one that is built is counted, over all plans, bands, sensors and roads of a frame."""

from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import Any

import moderngl
import numpy as np
import pytest
from effect_cases import DAYS
from small_world import town_features, write_town
from test_effects_images import ACROSS, COARSE, SIZE

from sensorsim.effects import EFFECTS, FRAME, read_choice
from sensorsim.environment import read_weather
from sensorsim.gpu import build_program
from sensorsim.render import Renderer, World, build_world, passes, solids
from sensorsim.render.solids import Solids
from sensorsim.render.variants import all_plans
from sensorsim.scene import load_scene
from sensorsim.sensor import DisplaySettings, Sensor, load_sensor, sensor_parts
from sensorsim.study.effects_sensors import study_sensor
from sensorsim.tables import BakeSettings

LOBED = BakeSettings(orientations="icosphere42", step=1200.0, slice_interval=3600.0, lead_in_days=1.0)
MOST, DETECTORS = 16, 18
SENSORS = ("flir", "lltv", "uncooled", "cooled_mwir", "emccd", "flir1977", "sit1977", "emccd, blooming",
           "uncooled, repaired", "sit1977, coarse")  # fmt: skip
Key = tuple[str, str, tuple[tuple[str, int], ...]]


@pytest.fixture
def built(monkeypatch: pytest.MonkeyPatch) -> Counter[Key]:
    """Files and defines of every program that frames have built."""
    found: Counter[Key] = Counter()

    def counted(ctx: moderngl.Context, **kinds: Any) -> moderngl.Program:
        found[kinds["vertex"], kinds["fragment"], tuple(sorted((kinds.get("defines") or {}).items()))] += 1
        return build_program(ctx, **kinds)

    for module in (passes, solids):
        monkeypatch.setattr(module, "build_program", counted)
    return found


def town(folder: Path, sensor: Sensor, settings: BakeSettings = COARSE, choice: str = "all") -> World:
    return build_world(
        load_scene(write_town(folder, town_features())), read_weather("winter"), image_day=DAYS["winter"],
        settings=settings, effects=read_choice(choice), sensor=sensor,
    )  # fmt: skip


def cart() -> Solids:
    """One triangle that stands in the way."""
    one, south = np.ones(1), np.array([[0.0, -1.0, 0.0]])
    return Solids(
        triangles=np.array([[[60.0, -20.0, 0.0], [64.0, -20.0, 0.0], [62.0, -20.0, 5.0]]]), normal=south,
        quarters=np.full((1, 4), 0.125), temperature=300.0 * one, emissivity=0.9 * one, reflectance=0.3 * one,
        number=np.zeros(1, dtype=np.int64),
    )  # fmt: skip


def is_of_the_scene(key: Key) -> bool:
    """Whether a program draws what there is, or shows it: all but the stages of a detector and of fine detail."""
    return key[1].startswith("scene/") or key[1] == "sensor/display.frag"


def test_programs_of_all_plans_both_bands_both_roads_things_and_display_are_sixteen_at_most(
    built: Counter[Key], tmp_path: Path
) -> None:
    """Ten for surfaces, two for the background and for the display, one for things and for numbers of surfaces."""
    for name in ("flir", "lltv"):
        for settings in (COARSE, LOBED):
            with Renderer(town(tmp_path, load_sensor(name), settings), load_sensor(name), size=SIZE) as renderer:
                with renderer.ctx:
                    for plan in all_plans():
                        renderer._programs.surfaces(plan)
                        renderer._programs.background(plan)
                for planes in (None, ("display",)):
                    renderer.render(ACROSS, 36000.0, solids=cart(), planes=planes)
    scene = Counter(key[1] for key in built if is_of_the_scene(key))
    assert scene == {
        "scene/surface.frag": 10, "scene/background.frag": 2, "scene/solid.frag": 1, "scene/number.frag": 1,
        "sensor/display.frag": 1,
    }  # fmt: skip
    curve = 1  # the display's other program has the same files, and a curve in place of a line
    assert sum(scene.values()) + curve <= MOST


@pytest.mark.parametrize("name", ["flir", "lltv"])
def test_choices_of_effects_build_no_program_that_plans_do_not_know(
    name: str, built: Counter[Key], tmp_path: Path
) -> None:
    """With each effect of a frame left out, and all of them."""
    sensor = load_sensor(name)
    world = town(tmp_path, sensor)
    left = [effect.name for effect in EFFECTS if effect.stage == FRAME and effect.mode in (None, sensor.mode)]
    for text in ("none", *(f"all,-{one}" for one in left if not is_of_a_detector(one))):
        choice = read_choice(f"{text},+temperature" if name == "flir" else text)
        with Renderer(replace(world, choice=choice), sensor, size=SIZE) as renderer:
            renderer.render(ACROSS, 36000.0, solids=cart())
    known = {("surface", 6 if name == "flir" else 4), ("background", 2), ("solid", 1)}
    for stage, most in known:
        assert sum(key[1] == f"scene/{stage}.frag" for key in built) <= most


def is_of_a_detector(effect: str) -> bool:
    """Whether an effect is one of a detector's chain, which these sensors do not have."""
    return {one.name: one.part for one in EFFECTS}[effect]


def test_stages_of_all_detectors_go_by_the_sensor_and_not_by_the_plan(built: Counter[Key], tmp_path: Path) -> None:
    """A plan drops passes of a detector and makes none of its own; detail takes two sums twice."""
    detail = DisplaySettings(detail=3.0)
    for name in SENSORS:
        sensor = study_sensor(name)
        world = town(tmp_path, sensor)
        for text in ("all", ",".join(["all", *(f"-{part}" for part in sorted(sensor_parts(sensor)))])):
            with Renderer(replace(world, choice=read_choice(text)), sensor, size=SIZE) as renderer:
                renderer.render(ACROSS, 36000.0, display=detail)
    stages = Counter(key[1].removeprefix("sensor/") for key in built if not is_of_the_scene(key))
    several = {"detect.frag": 4, "block_mean.frag": 3, "detail_rows.frag": 2, "detail_columns.frag": 2}
    assert all(count <= several.get(stage, 1) for stage, count in stages.items())
    assert set(several) < set(stages)
    assert sum(stages.values()) <= DETECTORS
