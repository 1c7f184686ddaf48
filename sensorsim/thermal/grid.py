"""From layers to finite volumes: cells that hold heat, conductances between them, a face without capacity at each end.

Cells are laid out in the diffusive coordinate, thickness over the square root of diffusivity [s^0.5], in which the
penetration depth of a time scale is the same in every material: fine at the scale of a step at the exterior face, of a
day at the interior one, and growing linearly with the distance from either, as only slower changes get there. Layers
without capacity become pure resistances between cells. Cylinders and spheres are solved per unit of exterior area (see
`shells`), so that steady radial conduction is exact with any number of cells.
Source: finite volumes of eq. 2 of [Report1978], interface by resistances in series [Patankar1980 ch. 4].
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.thermal.shells import Shells

FloatArray = NDArray[np.float64]

STEP_FRACTION = 0.4  # outermost cell over the penetration depth of a step
DAY_FRACTION = 0.12  # innermost cell over the penetration depth of a day
GROWTH = 0.18  # growth of cell thickness per distance from a face


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
    """Finite volumes of a wall, exterior to interior, per unit of its exterior area."""

    capacity: FloatArray  # (n,) of each cell [J m-2 K-1]
    conductance: FloatArray  # (n + 1,) face to first cell, between cells, last cell to face [W m-2 K-1]
    depth: FloatArray  # (n,) of each cell's middle below the exterior face [m]
    interior_area: float = 1.0  # of the interior face over the exterior one [-]; 0 for a solid cylinder or sphere


def build_grid(
    layers: Sequence[LayerLike],
    step: float,
    *,
    shape: str = "slab",
    radius: float | None = None,
    cell_size: float = 1.0,
) -> WallGrid:
    """Finite volumes of `layers` for time steps of `step` [s]; layers of zero thickness are dropped.

    `shape` is 'slab', 'cylinder' or 'sphere', the curved ones with the `radius` [m] of the exterior face. Layers that
    reach the centre make it solid: no heat crosses its middle. A pure resistance is per unit of area where it stands.
    `cell_size` is that of the cells, and of how they grow, over the usual [-].
    Raises InputError for an unknown shape, a missing radius, and layers thicker than the radius.
    """
    shells = Shells(shape=shape, radius=radius)
    pile = _Pile(shells)
    sizes = _Sizes(step, cell_size, sum(_diffusive_span(layer) for layer in layers))
    diffusive = 0.0
    for layer in layers:
        if layer.resistance is not None:
            pile.resist(layer.thickness, layer.resistance / max(shells.area(pile.position), 1e-12))
            continue
        heat = layer.density * layer.specific_heat
        if layer.thickness <= 0.0:
            continue
        span = _diffusive_span(layer)
        if span <= 0.0:
            pile.resist(layer.thickness, shells.resistance(pile.position, layer.thickness) / layer.conductivity)
            continue
        for share in np.diff(sizes.edges(diffusive, diffusive + span)) / span:
            pile.add_cell(float(share) * layer.thickness, layer.conductivity, heat)
        diffusive += span
    return pile.grid()


class _Pile:
    """A wall under construction, exterior first: cells so far, and the resistance met since the last one's middle."""

    def __init__(self, shells: Shells) -> None:
        self.shells = shells
        self.capacity: list[float] = []
        self.conductance: list[float] = []
        self.depth: list[float] = []
        self.position = 0.0  # reached so far [m]
        self.pending = 0.0  # [m2 K W-1]

    def resist(self, thickness: float, resistance: float) -> None:
        """Go `thickness` deeper through a resistance without capacity."""
        self.pending += resistance
        self.position += thickness

    def add_cell(self, thickness: float, conductivity: float, heat: float) -> None:
        """Go `thickness` deeper through a cell of a heat capacity [J m-3 K-1]."""
        middle = self.shells.middle(self.position, thickness)
        outer_half = self.shells.resistance(self.position, middle) / conductivity
        self.conductance.append(_inverse(self.pending + outer_half))
        self.capacity.append(heat * self.shells.volume(self.position, thickness))
        self.depth.append(self.position + middle)
        self.pending = self.shells.resistance(self.position + middle, thickness - middle) / conductivity
        self.position += thickness

    def grid(self) -> WallGrid:
        """The finished wall; nothing passes the middle of a solid one."""
        area = self.shells.area(self.position)
        return WallGrid(
            capacity=np.array(self.capacity),
            conductance=np.array([*self.conductance, _inverse(self.pending) if area > 0.0 else 0.0]),
            depth=np.array(self.depth),
            interior_area=area,
        )


def _diffusive_span(layer: LayerLike) -> float:
    """Thickness of a layer [s^0.5]; zero for one that holds no heat."""
    if layer.resistance is not None or layer.thickness <= 0.0:
        return 0.0
    return float(layer.thickness * np.sqrt(layer.density * layer.specific_heat / layer.conductivity))


class _Sizes:
    """How large cells are to be [s^0.5] at a depth [s^0.5]: the lesser of what either face allows."""

    def __init__(self, step: float, cell_size: float, span: float) -> None:
        innermost = cell_size * DAY_FRACTION * np.sqrt(SECONDS_PER_DAY / np.pi)
        self.growth = cell_size * GROWTH
        self.finest = min(cell_size * STEP_FRACTION * np.sqrt(step), innermost)
        self.turn = min(0.5 * (span + (innermost - self.finest) / self.growth), span)  # where both rules say the same
        self.largest = self.finest + self.growth * self.turn
        self.cells_to_turn = np.log(self.largest / self.finest) / self.growth

    def edges(self, first: float, last: float) -> FloatArray:
        """Edges [s^0.5] of whole cells from one depth to another."""
        above, through = self._cells_above(first), self._cells_above(last)
        edges = self._depth(np.linspace(above, through, max(1, int(np.ceil(through - above - 1e-9))) + 1))
        edges[0], edges[-1] = first, last
        return edges

    def _cells_above(self, depth: float) -> float:
        if depth <= self.turn:
            return float(np.log1p(self.growth * depth / self.finest) / self.growth)
        return float(self.cells_to_turn - np.log1p(-self.growth * (depth - self.turn) / self.largest) / self.growth)

    def _depth(self, cells: FloatArray) -> FloatArray:
        """Inverse of `_cells_above`."""
        outer = self.finest / self.growth * np.expm1(self.growth * np.minimum(cells, self.cells_to_turn))
        beyond = np.maximum(cells - self.cells_to_turn, 0.0)
        return np.asarray(outer - self.largest / self.growth * np.expm1(-self.growth * beyond))


def _inverse(resistance: float) -> float:
    """Conductance of a resistance; two faces in contact get a conductance that holds them within rounding."""
    return 1.0 / max(resistance, 1e-9)
