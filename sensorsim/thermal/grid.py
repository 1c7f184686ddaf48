"""From layers to finite volumes: cells that hold heat, conductances between them, a face without capacity at each end.

Cells are laid out in the diffusive coordinate, thickness over the square root of diffusivity [s^0.5], in which the
penetration depth of a time scale is the same in every material: fine at the exterior at the scale of a step, growing
inward to the scale of a day. Layers without capacity become pure resistances between cells.
Source: finite volumes of eq. 2 of [Report1978], interface by resistances in series [Patankar1980 ch. 4].
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY

FloatArray = NDArray[np.float64]

STEP_FRACTION = 0.4  # first cell over the penetration depth of a step
DAY_FRACTION = 0.15  # thickest cell over the penetration depth of a day
GROWTH = 0.25  # growth of cell thickness per depth


class LayerLike(Protocol):
    """What a layer must tell; `resistance` is None for a layer that conducts by its own thickness."""

    @property
    def thickness(self) -> float: ...  # noqa: D102
    @property
    def conductivity(self) -> float: ...  # noqa: D102
    @property
    def density(self) -> float: ...  # noqa: D102
    @property
    def specific_heat(self) -> float: ...  # noqa: D102
    @property
    def resistance(self) -> float | None: ...  # noqa: D102


@dataclass(frozen=True, slots=True, kw_only=True)
class WallGrid:
    """Finite volumes of a wall, exterior to interior, per unit of its area."""

    capacity: FloatArray  # (n,) of each cell [J m-2 K-1]
    conductance: FloatArray  # (n + 1,) face to first cell, between cells, last cell to face [W m-2 K-1]
    depth: FloatArray  # (n,) of each cell's middle below the exterior face [m]


def build_grid(
    layers: Sequence[LayerLike],
    step: float,
    *,
    step_fraction: float = STEP_FRACTION,
    day_fraction: float = DAY_FRACTION,
    growth: float = GROWTH,
) -> WallGrid:
    """Finite volumes of `layers` for time steps of `step` [s]; layers of zero thickness are dropped."""
    capacity: list[float] = []
    conductance: list[float] = []
    depth: list[float] = []
    pending = 0.0  # resistance met since the last cell's middle [m2 K W-1]
    position = 0.0
    diffusive = 0.0
    for layer in layers:
        if layer.resistance is not None:
            pending += layer.resistance
            position += layer.thickness
            continue
        heat = layer.density * layer.specific_heat
        if heat <= 0.0 or layer.thickness <= 0.0:
            pending += layer.thickness / layer.conductivity if layer.thickness > 0.0 else 0.0
            position += layer.thickness
            continue
        root = np.sqrt(layer.conductivity / heat)
        span = layer.thickness / root
        edges = _cell_edges(diffusive, span, step_fraction * np.sqrt(step), growth, day_fraction * _day_root())
        for thickness in np.diff(edges) * root:
            half = 0.5 * thickness / layer.conductivity
            conductance.append(_inverse(pending + half))
            capacity.append(heat * thickness)
            depth.append(position + 0.5 * thickness)
            pending, position = half, position + thickness
        diffusive += span
    conductance.append(_inverse(pending))
    return WallGrid(capacity=np.array(capacity), conductance=np.array(conductance), depth=np.array(depth))


def _day_root() -> float:
    return float(np.sqrt(SECONDS_PER_DAY / np.pi))


def _cell_edges(start: float, span: float, finest: float, growth: float, coarsest: float) -> FloatArray:
    """Edges of a layer's cells [s^0.5]: cell size grows linearly with depth from `finest`, then stays at `coarsest`."""
    finest = min(finest, 0.99 * coarsest)
    turn = (coarsest - finest) / growth  # depth at which growth ends
    cells_to_turn = np.log(coarsest / finest) / growth

    def cells_above(depth: float) -> float:
        return float(np.log1p(growth * min(depth, turn) / finest) / growth + max(depth - turn, 0.0) / coarsest)

    first, last = cells_above(start), cells_above(start + span)
    wanted = np.linspace(first, last, max(1, int(np.ceil(last - first - 1e-9))) + 1)
    growing = finest / growth * np.expm1(growth * np.minimum(wanted, cells_to_turn))
    edges = growing + coarsest * np.maximum(wanted - cells_to_turn, 0.0) - start
    edges[0], edges[-1] = 0.0, span
    return np.asarray(edges)


def _inverse(resistance: float) -> float:
    """Conductance of a resistance; two faces in contact get a conductance that holds them within rounding."""
    return 1.0 / max(resistance, 1e-9)
