"""The gymnasium environment: what gymnasium itself checks, and motion, time and pictures that are right."""

from collections.abc import Iterator

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from small_world import town

from sensorsim.render import Renderer, look_at
from sensorsim.sensor import load_sensor
from sensorsim.trainer.gym import ENVIRONMENT, FASTEST, SceneEnvironment

START = look_at([-150.0, -140.0, 60.0], [0.0, 0.0, 5.0], 50.0)
WORDS = {"at": "1976-02-07T10:00", "size": (32, 24), "start": START, "target": (0.0, 0.0, 5.0)}
STILL = np.zeros(6, dtype=np.float32)


@pytest.fixture(scope="module")
def env() -> Iterator[SceneEnvironment]:
    made = SceneEnvironment(world=town(), **WORDS)
    yield made
    made.close()


@pytest.mark.parametrize("sensor", ["flir", "lltv"])
def test_it_passes_the_checks_of_gymnasium(sensor: str) -> None:
    made = gymnasium.make(ENVIRONMENT, world=town(), sensor=sensor, render_mode="rgb_array", **WORDS)
    check_env(made.unwrapped, skip_render_check=False)
    made.reset(seed=1)
    picture = made.render()
    assert picture.shape == (24, 32, 3)
    assert picture.dtype == np.uint8
    assert picture.std() > 5.0
    made.close()


def test_the_image_is_apparent_temperature_from_the_pose(env: SceneEnvironment) -> None:
    pose = np.array([*START.position, START.yaw, START.pitch, 0.0])
    seen, _ = env.reset(options={"pose": pose})
    with Renderer(town(), load_sensor("flir"), size=(32, 24)) as renderer:
        planes = renderer.render(START, 36000.0).planes
    np.testing.assert_allclose(seen["image"][:, :, 0] / 100.0, planes["apparent_temperature"], atol=0.0051)
    np.testing.assert_array_equal(seen["pose"], pose)


def test_an_action_moves_along_the_cameras_axes_and_turns_it(env: SceneEnvironment) -> None:
    before, _ = env.reset(options={"pose": np.array([0.0, -200.0, 50.0, 0.0, 0.0, 0.0])})
    after, _, ended, cut, info = env.step(np.array([1.0, 0.5, -0.5, 1.0, -1.0, 0.0], dtype=np.float32))
    moved = after["pose"] - before["pose"]
    np.testing.assert_allclose(moved, FASTEST * 0.1 * [0.5, 1.0, -0.5, 1.0, -1.0, 0.0], atol=1e-9)
    assert (ended, cut, info["time_of_day"]) == (False, False, 36000.1)


def test_looking_at_the_target_is_worth_most_and_away_from_it_least(env: SceneEnvironment) -> None:
    def worth(yaw: float) -> float:
        env.reset(options={"pose": np.array([0.0, -200.0, 5.0, yaw, 0.0, 0.0])})
        return env.step(STILL)[1]

    assert worth(0.0) == pytest.approx(1.0)
    assert worth(90.0) == pytest.approx(0.0, abs=1e-9)
    assert worth(180.0) == pytest.approx(-1.0)


def test_an_episode_ends_at_the_ground_and_starts_differ_by_seed_alone(env: SceneEnvironment) -> None:
    env.reset(options={"pose": np.array([0.0, -200.0, 4.0, 0.0, -90.0, 0.0])})
    assert env.step(np.array([1.0, 0, 0, 0, 0, 0], dtype=np.float32))[2]
    one, other, third = (env.reset(seed=seed)[0] for seed in (5, 5, 6))
    np.testing.assert_array_equal(one["image"], other["image"])
    assert np.abs(one["pose"] - third["pose"]).max() > 0.1
