"""Elements that do not see: which ones, and what a camera shows in their place.

A share of the elements, chosen by a seed, reports nothing. A camera that knows its dead elements shows the median of
the living ones around each, the lower of two middle ones, so that what is shown is a whole count; where none around
lives it looks farther. The NumPy twin of shaders/sensor/replace.frag.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

REACH = 4  # elements to either side, beyond which a dead element stays dark: of half of them dead 2^-80 are so alone


def seeing(rank: NDArray[np.uint32], dead: float) -> NDArray[np.float64]:
    """1 where an element sees, 0 for the share `dead` of them [-] of the lowest rank; shape of `rank`."""
    count = round(dead * rank.size)
    if count == 0:
        return np.ones(rank.shape)
    return np.where(rank <= np.partition(rank, count - 1, axis=None)[count - 1], 0.0, 1.0)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Neighbours:
    """Dead elements that have living ones around them, and these; elements are counted row by row."""

    place: NDArray[np.int64]  # (n,)
    source: NDArray[np.int64]  # (n, k)
    lives: NDArray[np.bool_]  # (n, k)


def living_neighbours(sees: NDArray[Any]) -> tuple[Neighbours, ...]:
    """What stands for the dead elements of (height, width), which is 0 where one does not see; one for each reach."""
    lonely, found = np.argwhere(sees == 0.0), []
    for reach in range(1, REACH + 1):
        around = np.mgrid[-reach : reach + 1, -reach : reach + 1].reshape(2, -1).T
        there = lonely[:, None, :] + around
        inside = np.all((there >= 0) & (there < sees.shape), axis=2)
        row, column = np.where(inside[..., None], there, 0).transpose(2, 0, 1)
        lives = inside & (sees[row, column] != 0.0)
        some, width = lives.any(axis=1), sees.shape[1]
        place, source = lonely[:, 0] * width + lonely[:, 1], row * width + column
        found.append(Neighbours(place=place[some], source=source[some], lives=lives[some]))
        lonely = lonely[~some]
    return tuple(one for one in found if one.place.size)


def replace_dead(reported: NDArray[Any], neighbours: Sequence[Neighbours]) -> NDArray[Any]:
    """The picture (height, width) with the medians of the living in place of the dead; its own type."""
    shown = reported.ravel().copy()
    for one in neighbours:
        values = np.where(one.lives, reported.ravel()[one.source], reported.dtype.type(np.inf))
        middle = (one.lives.sum(axis=1) - 1) // 2
        shown[one.place] = np.take_along_axis(np.sort(values, axis=1), middle[:, None], axis=1)[:, 0]
    return shown.reshape(reported.shape)
