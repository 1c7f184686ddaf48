"""Walls with studs, beams or panes beside panels: parallel one-dimensional paths, none of which feels the others.

Section 3.1.4 of [Report1978]. Every path has its share of the wall's area and is marched on its own; the wall's
surface temperature is the one whose fourth power is the area-weighted mean of the paths', so that it radiates what they
do together. In 8-14 um, where radiance goes with a power of 4.5 to 5 at outdoor temperatures, the two means differ by
less than 0.01 K for a quarter of studs 5 K from their wall. Heat flows add up by area, and so do transmittances.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from sensorsim.thermal.boundary import Inside, Outside, inside_from, outside_from
from sensorsim.thermal.grid import FloatArray, LayerLike, WallGrid, build_grid
from sensorsim.thermal.march import History, march
from sensorsim.thermal.periodic_start import settled_cells

SHORT_STEPS = 24  # before the first sample recorded, whatever the lead-in's


class PathLike(Protocol):
    """A share of a wall's area with its own layers."""

    @property
    def fraction(self) -> float: ...  # noqa: D102
    @property
    def layers(self) -> Sequence[LayerLike]: ...  # noqa: D102


class WallLike(Protocol):
    """What a construction or a wall type must tell; `paths` is empty for a wall that is the same all over."""

    @property
    def layers(self) -> Sequence[LayerLike]: ...  # noqa: D102
    @property
    def paths(self) -> Sequence[PathLike]: ...  # noqa: D102
    @property
    def shape(self) -> str: ...  # noqa: D102
    @property
    def radius(self) -> float | None: ...  # noqa: D102


@dataclass(frozen=True, slots=True, kw_only=True)
class GridPath:
    """One path of a wall as finite volumes."""

    fraction: float  # of the wall's area [-]
    layers: Sequence[LayerLike]
    grid: WallGrid


def wall_paths(wall: WallLike, step: float, *, cell_size: float = 1.0) -> tuple[GridPath, ...]:
    """Paths of a wall for steps of `step` [s], the widest first; one path where it is the same all over.

    `cell_size` is that of its cells over the usual [-].
    """
    shares = [(path.fraction, path.layers) for path in wall.paths] or [(1.0, wall.layers)]

    return tuple(
        GridPath(
            fraction=fraction,
            layers=layers,
            grid=build_grid(layers, step, shape=wall.shape, radius=wall.radius, cell_size=cell_size),
        )
        for fraction, layers in sorted(shares, key=lambda share: -share[0])
    )


def transmittance(wall: WallLike, exterior_resistance: float, interior_resistance: float) -> float:
    """Heat [W] per m2 of exterior area and kelvin from air to air, through films of these resistances [m2 K W-1]."""
    total = 0.0
    for path in wall_paths(wall, 3600.0):
        if path.grid.interior_area > 0.0:
            through = exterior_resistance + float(np.sum(1.0 / path.grid.conductance))
            total += path.fraction / (through + interior_resistance / path.grid.interior_area)
    return total


def march_paths(
    wall: WallLike,
    outside: Outside,
    inside: Inside,
    absorptances: FloatArray,
    *,
    step: float,
    record: np.ndarray,
    keep_nodes: bool = False,
    start: float | None = None,
    melting_depth: float = 0.0,
    cell_size: float = 1.0,
    repeated: bool = False,
    stride: int = 1,
) -> History:
    """March all paths of a construction or wall type, of any shape, as `march` does layers, and join them by area.

    With a temperature `start` [K] all cells of all paths begin there, `repeated` as the first day leaves them when it
    is repeated; `melting_depth` [m] is that of `march`. Before the first sample recorded, all but the last SHORT_STEPS
    are joined to steps `stride` times as long: heat that came hours ago has spread. Snow keeps its short steps.
    Grid and node temperatures are those of the widest path; heats begin where steps are short.
    """
    paths = wall_paths(wall, step, cell_size=cell_size)
    histories, long = [], 1 if melting_depth > 0.0 else stride
    skipped = max(int(record[0]) - SHORT_STEPS, 0) // long * long if long > 1 else 0
    far, near = (outside_from(outside, 0, long), inside_from(inside, 0, long)), inside_from(inside, skipped)
    for place, path in enumerate(paths):
        cells = None if start is None else np.full(path.grid.capacity.size, start)
        if repeated:
            cells = settled_cells(path.layers, path.grid, *far, absorptances, long * step)
        if skipped:
            cells = _cells_at(path, *far, absorptances, step=long * step, sample=skipped // long, start=cells)
        history = march(
            path.layers, outside_from(outside, skipped), near, absorptances, step=step, record=record - skipped,
            keep_nodes=keep_nodes and place == 0, grid=path.grid, start=cells, melting_depth=melting_depth,
        )  # fmt: skip
        histories.append(history)
    return histories[0] if len(histories) == 1 else _join([path.fraction for path in paths], histories)


def _cells_at(
    path: GridPath, outside: Outside, inside: Inside, absorptances: FloatArray, *, step: float, sample: int,
    start: FloatArray | None,
) -> FloatArray:  # fmt: skip
    """Cell temperatures (n, o, a) [K] of a path at a sample."""
    history = march(
        path.layers, outside, inside, absorptances, step=step, record=np.array([sample]), keep_nodes=True,
        grid=path.grid, start=start,
    )  # fmt: skip
    return np.array(np.asarray(history.nodes)[0])


def _join(fractions: Sequence[float], histories: Sequence[History]) -> History:
    """One history of several paths."""
    parts = list(zip(fractions, histories, strict=True))
    return History(
        sample=histories[0].sample,
        exterior=np.asarray(sum(share * history.exterior**4 for share, history in parts) ** 0.25),
        interior=np.asarray(sum(share * history.interior**4 for share, history in parts) ** 0.25),
        nodes=histories[0].nodes,
        heat=np.asarray(sum(share * history.heat for share, history in parts)),
        stored=np.asarray(sum(share * history.stored for share, history in parts)),
        melted=np.asarray(sum(share * history.melted for share, history in parts)),
        drained=np.asarray(sum(share * history.drained for share, history in parts)),
        grid=histories[0].grid,
    )
