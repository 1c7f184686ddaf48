"""Quadrilaterals are cut without a search; the cut is the one that a search would be held to."""

import numpy as np
import pytest

from sensorsim.scene import triangulate
from sensorsim.scene.extrude import ring_area

QUADS = {
    "rectangle": [[0.0, 0.0], [8.0, 0.0], [8.0, 5.0], [0.0, 5.0]],
    "kite far away": [[1e6, 1e6], [1e6 + 9.0, 1e6 - 1.0], [1e6 + 10.0, 1e6 + 8.0], [1e6 - 2.0, 1e6 + 3.0]],
    "dart": [[0.0, 0.0], [4.0, 1.0], [0.0, 8.0], [1.0, 1.5]],
    "dart from another corner": [[1.0, 1.5], [0.0, 0.0], [4.0, 1.0], [0.0, 8.0]],
}


@pytest.mark.parametrize("backwards", [False, True])
@pytest.mark.parametrize("name", QUADS)
def test_triangles_fill_the_quadrilateral_and_turn_left(name: str, backwards: bool) -> None:
    ring = np.array(QUADS[name])[:: -1 if backwards else 1]
    areas = [ring_area(ring[row]) for row in triangulate((ring,))]
    assert len(areas) == 2
    assert min(areas) > 0.0
    assert sum(areas) == pytest.approx(abs(ring_area(ring)), rel=1e-9)


def test_area_of_a_ring_does_not_lose_digits_far_away_nor_depend_on_its_first_corner() -> None:
    ring = np.array(QUADS["kite far away"])
    expected = ring_area(ring - ring[2])
    for first in range(4):
        assert ring_area(np.roll(ring, first, axis=0)) == pytest.approx(expected, rel=1e-9)
