"""One wall on its way through a boundary series: equal steps within each interval, so that none crosses a sample.

The linear part is factored once for each length of step that occurs.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.errors import InputError, NumericsError
from sensorsim.thermal.boundary import Cells, Columns, FloatArray, Inside, Outside, per_exterior_area
from sensorsim.thermal.conduction import factor
from sensorsim.thermal.damping import GAMMA
from sensorsim.thermal.grid import LayerLike, WallGrid, build_grid
from sensorsim.thermal.kernel import advance
from sensorsim.thermal.wall_boundary import WallBoundary, WallSurface, conditions

FACTORS_KEPT = 512
BLOCK = 8192  # steps whose conditions are laid out at once
FINER = 0.5  # cell sizes over those of a bake: one wall can afford a quarter of the error in space
FINEST = 1.0  # [s] a shorter step asks for no finer cells
FOREVER = 1e15  # [s] after which a wall under constant conditions is steady
MOST_STEPS = 1_000_000  # of an interval between samples, which is laid out at once
AT_ONCE = 1e-6  # [s] in which faces, which hold no heat, come to their balance and cells stay as they are


class WallSteps:
    """Temperatures of a wall's cells and faces, and the heat that has entered; one caller at a time."""

    def __init__(self, grid: WallGrid, surface: WallSurface) -> None:
        self.grid, self.surface = grid, surface
        self.columns = Columns(
            cells=np.zeros((grid.capacity.size, 1)),
            carried=np.array([[0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]]).T.copy(),
            absorptance=np.array([surface.absorptance]),
        )
        self._factors: dict[float, tuple[Cells, Cells]] = {}

    @property
    def state(self) -> FloatArray:
        """Heat entered through both faces [J m-2], temperatures of both faces and the cells [K]: (n + 4,)."""
        columns = self.columns
        solid = self.grid.interior_area == 0.0  # nothing passes its middle: the innermost cell stands for that face
        inner = columns.cells[-1] if solid else columns.faces[1]
        temperatures = np.concatenate([columns.faces[0], inner, columns.cells[:, 0]]) + ZERO_CELSIUS
        return np.concatenate([columns.heat[:, 0], temperatures])

    def put_line(self, exterior: float, interior: float) -> None:
        """Steady conduction between face temperatures [K]."""
        reach = np.concatenate([[0.0], np.cumsum(1.0 / np.maximum(self.grid.conductance, 1e-12))])
        line = exterior + (interior - exterior) * reach / reach[-1] - ZERO_CELSIUS
        self.columns.cells[:, 0], self.columns.faces[:, 0] = line[1:-1], line[[0, -1]]

    def hold(self, boundary: WallBoundary, row: int, span: float) -> None:
        """One step of `span` [s] under the conditions of a sample; the heat of it does not count."""
        outside, inside = conditions(boundary, self.surface, np.array([row, row]), np.zeros(2))
        before = self.columns.heat.copy()
        self._advance(outside, inside, 0, 1, span)
        self.columns.heat[:] = before

    def cross(self, boundary: WallBoundary, counts: NDArray[np.int64], first: int, last: int) -> FloatArray:
        """March from sample `first` to `last` in `counts` steps an interval.

        Returns the `state` (n + 4, last - first) at the samples after the first.
        """
        outside, inside = lay_out(boundary, self.surface, counts, first, last)
        passed = np.zeros((self.grid.capacity.size + 4, last - first))
        begin = 0
        for i in range(first, last):
            end = begin + int(counts[i])
            self._advance(outside, inside, begin, end, float(boundary.time[i + 1] - boundary.time[i]) / (end - begin))
            passed[:, i - first] = self.state
            begin = end
        return passed

    def _advance(self, outside: Outside, inside: Inside, begin: int, end: int, step: float) -> None:
        inside = per_exterior_area(inside, self.grid.interior_area)
        step = float(f"{step:.8e}")  # so that steps alike to nine digits, as times with fractions have, share factors
        cells, damped = self._factored(step)
        failures = advance(self.columns, cells, damped, outside, inside, begin, end, step)
        if failures or not np.all(np.isfinite(self.columns.faces)):
            raise NumericsError("heat balance of a wall did not converge")

    def _factored(self, step: float) -> tuple[Cells, Cells]:
        """Linear part for a step [s] of two stages and of one."""
        if step not in self._factors:
            if len(self._factors) >= FACTORS_KEPT:
                self._factors.clear()
            self._factors[step] = factor(self.grid, GAMMA * step, step), factor(self.grid, step, step)
        return self._factors[step]


def step_counts(time: FloatArray, step: float) -> NDArray[np.int64]:
    """Equal steps of at most `step` [s] in each interval between times (t,) [s]: (t - 1,).

    Raises InputError for a step far too short for an interval.
    """
    counts = np.maximum(1.0, np.ceil(np.diff(time) / step - 1e-9))
    if np.any(counts > MOST_STEPS):
        problem = f"{counts.max():.3g} of them between two samples, more than {MOST_STEPS:,}"
        raise InputError("wall", "step", step, problem, "give a longer step, or samples closer to each other")
    return np.asarray(counts, dtype=np.int64)


def wall_grid(
    layers: Sequence[LayerLike],
    time: FloatArray,
    counts: NDArray[np.int64],
    *,
    shape: str = "slab",
    radius: float | None = None,
) -> WallGrid:
    """Cells fine enough for the shortest step of a series."""
    shortest = max(float(np.min(np.diff(time) / counts)), FINEST)
    return build_grid(layers, shortest, shape=shape, radius=radius, cell_size=FINER)


def lay_out(
    boundary: WallBoundary, surface: WallSurface, counts: NDArray[np.int64], first: int, last: int
) -> tuple[Outside, Inside]:
    """Conditions at the ends of all steps from sample `first` to `last`."""
    steps = counts[first:last]
    row = np.append(np.repeat(np.arange(first, last), steps), last)
    begins = np.repeat(np.cumsum(steps) - steps, steps)
    share = np.append((np.arange(begins.size) - begins) / np.repeat(steps, steps), 0.0)
    return conditions(boundary, surface, row, share)


def blocks(counts: NDArray[np.int64]) -> list[tuple[int, int]]:
    """First and last sample of stretches of about BLOCK steps."""
    ends = np.cumsum(counts)
    marks = [0]
    while marks[-1] < counts.size:
        done = ends[marks[-1] - 1] if marks[-1] else 0
        marks.append(max(int(np.searchsorted(ends, done + BLOCK, side="right")), marks[-1] + 1))
    return list(pairwise(marks))
