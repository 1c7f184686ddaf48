"""From layers to finite volumes: cells that hold heat, conductances between them, a face without capacity at each end.

Cells are laid out in the diffusive coordinate, thickness over the square root of diffusivity [s^0.5], in which the
penetration depth of a time scale is the same in every material: fine at the exterior at the scale of a step, growing
inward to the scale of a day. Layers without capacity become pure resistances between cells. Cylinders and spheres are
solved per unit of exterior area (see `shells`), so that steady radial conduction is exact with any number of cells.
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
    step_fraction: float = STEP_FRACTION,
    day_fraction: float = DAY_FRACTION,
    growth: float = GROWTH,
) -> WallGrid:
    """Finite volumes of `layers` for time steps of `step` [s]; layers of zero thickness are dropped.

    `shape` is 'slab', 'cylinder' or 'sphere', the curved ones with the `radius` [m] of the exterior face. Layers that
    reach the centre make it solid: no heat crosses its middle. A pure resistance is per unit of area where it stands.
    Raises InputError for an unknown shape, a missing radius, and layers thicker than the radius.
    """
    shells = Shells(shape=shape, radius=radius)
    pile = _Pile(shells)
    diffusive = 0.0
    for layer in layers:
        if layer.resistance is not None:
            pile.resist(layer.thickness, layer.resistance / max(shells.area(pile.position), 1e-12))
            continue
        heat = layer.density * layer.specific_heat
        if layer.thickness <= 0.0:
            continue
        if heat <= 0.0:
            pile.resist(layer.thickness, shells.resistance(pile.position, layer.thickness) / layer.conductivity)
            continue
        root = np.sqrt(layer.conductivity / heat)
        span = layer.thickness / root
        edges = _cell_edges(diffusive, span, step_fraction * np.sqrt(step), growth, day_fraction * _day_root())
        for thickness in np.diff(edges) * root:
            pile.add_cell(float(thickness), layer.conductivity, heat)
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
