"""Dead elements by seed and share, and the neighbours that stand for them."""

import dataclasses

import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.sensor import Noise, load_sensor, sensor_parts, sensor_without
from sensorsim.sensor.dead_elements import REACH, living_neighbours, replace_dead
from sensorsim.sensor.read_out import fixed_pattern

SIZE = (160, 120)


def dead_map(share: float, seed: int = 3) -> np.ndarray:
    sensor = dataclasses.replace(load_sensor("uncooled"), noise=Noise(dead=share, seed=seed))
    return np.asarray(fixed_pattern(sensor, SIZE)[..., 2] == 0.0)


@pytest.mark.parametrize("share", [0.0, 1.0 / 19200.0, 1e-4, 0.003, 0.02, 0.5])
def test_as_many_elements_are_dead_as_the_share_says(share: float) -> None:
    """To one: two elements may have the same rank."""
    assert abs(int(dead_map(share).sum()) - round(share * 19200)) <= (share > 0.0)


def test_dead_elements_lie_anywhere_and_elsewhere_for_another_seed() -> None:
    dead = dead_map(0.02)
    quarters = [int(dead[row::2, column::2].sum()) for row in (0, 1) for column in (0, 1)]
    assert min(quarters) > 60  # of 96, three standard deviations and a half
    assert int((dead & dead_map(0.02, seed=4)).sum()) < 30  # of 384, 8 by chance
    assert not np.any(dead_map(0.01) & ~dead)  # more dead are the same and others


def test_plane_picture_shows_nothing_of_its_dead_elements() -> None:
    """A median of neighbours all around lies on a plane where its neighbours are alive; here each is within a step."""
    sees = ~dead_map(0.02)
    row, column = np.mgrid[0 : SIZE[1], 0 : SIZE[0]]
    scene = 100.0 + 2.0 * row + 1.0 * column
    shown = replace_dead(np.where(sees, scene, 0.0), living_neighbours(sees))
    assert np.array_equal(shown[sees], scene[sees])
    assert np.abs(shown - scene).max() <= 2.0 * REACH
    flat = replace_dead(np.where(sees, 7.0, 0.0), living_neighbours(sees))
    assert np.array_equal(flat, np.full(flat.shape, 7.0))


def test_replacement_is_the_lower_median_of_the_living() -> None:
    sees = np.ones((3, 4))
    sees[1, 1] = sees[0, 0] = 0.0
    report = np.array([[9.0, 2.0, 3.0, 0.0], [4.0, 9.0, 5.0, 0.0], [6.0, 7.0, 8.0, 0.0]])
    shown = replace_dead(report, living_neighbours(sees))
    assert shown[1, 1] == 5.0  # of 2 3 4 5 6 7 8
    assert shown[0, 0] == 2.0  # of 2 4


def test_lonely_elements_look_farther_and_give_up_beyond_their_reach() -> None:
    sees = np.zeros((4, 12))
    sees[:, 0] = 1.0
    shown = replace_dead(np.where(sees == 1.0, 5.0, 0.0), living_neighbours(sees))
    assert np.array_equal(shown[0], [5.0] * (1 + REACH) + [0.0] * (11 - REACH))
    assert living_neighbours(np.zeros((3, 3))) == ()
    assert living_neighbours(np.ones((3, 3))) == ()


def test_dead_elements_and_their_replacement_are_parts_of_their_own() -> None:
    sensor = dataclasses.replace(load_sensor("uncooled"), noise=Noise(dead=0.01, replaced=True))
    assert {"dead_elements", "replacement"} <= sensor_parts(sensor)
    assert sensor_without(sensor, {"replacement"}).noise == dataclasses.replace(sensor.noise, replaced=False)
    assert sensor_parts(sensor_without(sensor, {"dead_elements"})) == {"blur", "noise", "memory"}
    assert sensor_without(sensor, {"noise"}).noise.dead == 0.01
    assert "replacement" not in sensor_parts(dataclasses.replace(sensor, noise=Noise(replaced=True)))


@pytest.mark.parametrize("value", [1, "yes", None])
def test_replaced_is_true_or_false(value: object) -> None:
    with pytest.raises(InputError, match="replaced"):
        Noise(replaced=value)  # type: ignore[arg-type]
