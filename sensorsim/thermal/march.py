"""Surface temperature histories of one wall for many orientations and absorptances at once."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.errors import NumericsError
from sensorsim.thermal.boundary import Cells, Columns, Inside, Outside, Trace, per_exterior_area
from sensorsim.thermal.conduction import factor
from sensorsim.thermal.damping import GAMMA
from sensorsim.thermal.grid import FloatArray, LayerLike, WallGrid, build_grid
from sensorsim.thermal.kernel import advance
from sensorsim.thermal.melting import advance_melting, latent_heat
from sensorsim.thermal.melting_cells import Thaw


@dataclass(frozen=True, slots=True, kw_only=True)
class History:
    """Temperatures of a wall at the recorded samples."""

    sample: np.ndarray  # (r,) indices of the recorded samples
    exterior: FloatArray  # (r, o, a) exterior surface temperature [K]
    interior: FloatArray  # (r, o, a) interior surface temperature [K]
    nodes: FloatArray | None  # (r, n, o, a) cell temperatures [K], where asked for
    heat: FloatArray  # (2, o, a) heat that entered through the exterior and the interior face, first to last [J m-2]
    stored: FloatArray  # (o, a) heat stored from the first sample to the last [J m-2]
    melted: FloatArray  # (o, a) heat that melting has taken up, less freezing; `heat` sums to `stored` and this [J m-2]
    drained: FloatArray  # (o, a) part of `melted` that came to snow which had all melted, and ran off [J m-2]
    grid: WallGrid


class _Run(NamedTuple):
    """All that one wall's march goes by."""

    columns: Columns
    taken: FloatArray
    walls: tuple[Cells, Cells]
    thaw: Thaw
    outside: Outside
    inside: Inside
    step: float


def march(
    layers: Sequence[LayerLike],
    outside: Outside,
    inside: Inside,
    absorptances: FloatArray,
    *,
    step: float,
    record: np.ndarray,
    keep_nodes: bool = False,
    grid: WallGrid | None = None,
    start: FloatArray | None = None,
    melting_depth: float = 0.0,
    drains: bool = True,
) -> History:
    """March a wall through all samples of its boundary conditions, `step` [s] apart, and record the samples asked for.

    The start is linear between interior and exterior air, as in section 3.6.1 of [Report1978], unless cell
    temperatures `start` (n,), or (n, o, a) of all surfaces, [K] are given; faces then begin as the cells next to them.
    The inside of a curved `grid` is given per its own area, as elsewhere; heats come per exterior area. A solid one has
    no inside: its innermost cell stands for the interior face.

    What lies down to `melting_depth` [m] is snow, or ice where its water does not drain (see `melting`): it melts and
    freezes at 0 C; ice that starts warmer is water. Steps of such a wall are of first order.
    """
    grid = build_grid(layers, step) if grid is None else grid
    latent = latent_heat(layers, grid, melting_depth)
    outside, inside = _plain_outside(outside), _plain_inside(inside, grid)
    columns = _start(grid, outside, inside, absorptances, start)
    walls = factor(grid, GAMMA * step, step), factor(grid, step, step)
    thaw = Thaw(grid.capacity, grid.conductance, latent, drains)
    before, taken = grid.capacity @ columns.cells, _taken(columns, thaw)
    held, run = _sum_of_cells(taken), _Run(columns, taken, walls, thaw, outside, inside, step)
    nodes = np.zeros((record.size, *columns.cells.shape)) if keep_nodes else None
    if nodes is None and grid.interior_area > 0.0 and not np.any(latent) and np.all(np.diff(record) > 0):
        faces = _march_through(run, record)
    else:
        faces = _march_by_samples(run, record, grid, nodes)
    exterior, interior = _by_surface(faces.swapaxes(0, 1), absorptances.size) + ZERO_CELSIUS
    return History(
        sample=record,
        exterior=exterior,
        interior=interior,
        nodes=None if nodes is None else _by_surface(nodes, absorptances.size) + ZERO_CELSIUS,
        heat=_by_surface(columns.heat, absorptances.size),
        stored=_by_surface(grid.capacity @ columns.cells - before, absorptances.size),
        melted=_by_surface(_sum_of_cells(taken) - held, absorptances.size),
        drained=_by_surface(taken[-1], absorptances.size),
        grid=grid,
    )


def _by_surface(values: FloatArray, absorptances: int) -> FloatArray:
    """Values (..., m) of columns as (..., o, a)."""
    return values.reshape(*values.shape[:-1], absorptances, -1).swapaxes(-1, -2)


def _plain_outside(outside: Outside) -> Outside:
    vapour = outside.vapour if outside.vapour.size else np.zeros_like(outside.air)
    colder = outside.free_colder if outside.free_colder.size else outside.free
    return Outside(*(_plain(value) for value in outside._replace(vapour=vapour, free_colder=colder)))


def _plain_inside(inside: Inside, grid: WallGrid) -> Inside:
    return Inside(*(_plain(value) for value in per_exterior_area(inside, grid.interior_area)))


def _plain(value: Any) -> Any:
    """Contiguous and of double precision: other kinds of array would each be compiled for anew."""
    return np.require(value, np.float64, ["C", "W"]) if isinstance(value, np.ndarray) else float(value)


def _taken(columns: Columns, thaw: Thaw) -> FloatArray:
    """Latent heat (n + 1, m) [J m-2] that cells hold at the start: water of ice that is warmer than 0 C."""
    taken = np.zeros((thaw.latent.size + 1, columns.faces.shape[1]))
    if not thaw.drains:
        taken[:-1] = np.where(columns.cells > 0.0, thaw.latent[:, None], 0.0)
    return taken


def _sum_of_cells(taken: FloatArray) -> FloatArray:
    """Sum (m,) cell after cell: `sum` adds in another order where there is but one column."""
    return np.asarray(taken.cumsum(axis=0)[-1])


def _march_through(run: _Run, record: np.ndarray) -> FloatArray:
    """Faces (r, 2, m) [C] at samples that increase, in one go."""
    columns, last = run.columns, int(record[-1])
    row = np.full(run.outside.air.size, -1, dtype=np.int64)
    row[record] = np.arange(record.size)
    faces = np.zeros((record.size, 2, columns.faces.shape[1]))
    faces[0] = columns.faces  # stays where the start is asked for
    failures = advance(columns, *run.walls, run.outside, run.inside, 0, last, run.step, Trace(row, faces))
    _require_settled(failures, faces, 0, last)
    return faces


def _march_by_samples(run: _Run, record: np.ndarray, grid: WallGrid, nodes: FloatArray | None) -> FloatArray:
    """Faces (r, 2, m) [C], of a solid wall its innermost cell, and nodes (r, n, m) [C] where asked for."""
    columns, sample = run.columns, 0
    faces = np.zeros((record.size, 2, columns.faces.shape[1]))
    for row, wanted in enumerate(map(int, record)):
        if np.any(run.thaw.latent):
            failures = advance_melting(columns, run.taken, run.thaw, run.outside, run.inside, sample, wanted, run.step)
        else:
            failures = advance(columns, *run.walls, run.outside, run.inside, sample, wanted, run.step)
        _require_settled(failures, columns.faces, sample, wanted)
        sample = wanted
        faces[row] = columns.faces[0], columns.faces[1] if grid.interior_area > 0.0 else columns.cells[-1]
        if nodes is not None:
            nodes[row] = columns.cells
    return faces


def _require_settled(failures: int, faces: FloatArray, first: int, last: int) -> None:
    if failures or not np.all(np.isfinite(faces)):
        raise NumericsError(f"heat balance of a wall did not converge between samples {first} and {last}")


def _start(
    grid: WallGrid, outside: Outside, inside: Inside, absorptances: FloatArray, start: FloatArray | None
) -> Columns:
    """Columns at the first sample."""
    count = outside.irradiance.shape[1] * absorptances.size
    reach = np.concatenate([[0.0], np.cumsum(1.0 / np.maximum(grid.conductance, 1e-12))])
    share = reach / reach[-1]
    line = outside.air[0] + (inside.air[0] - outside.air[0]) * share
    profile = line[1:-1] if start is None else start
    surfaces = profile if profile.ndim == 3 else profile[:, None, None]
    shape = (profile.shape[0], outside.irradiance.shape[1], absorptances.size)
    cells = np.broadcast_to(surfaces, shape).swapaxes(1, 2).reshape(shape[0], count)
    ends = line[[0, -1], None] if start is None or start.size == 0 else cells[[0, -1]]
    faces = np.broadcast_to(ends, (2, count)) - ZERO_CELSIUS
    return Columns(
        cells=np.array(cells - ZERO_CELSIUS),
        carried=np.concatenate([faces, np.full((2, count), 0.2), np.zeros((6, count))]),
        absorptance=np.array(absorptances, dtype=np.float64),
    )
