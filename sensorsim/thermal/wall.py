"""One wall under a boundary series of one's own: temperatures, heat and what loads the exterior face."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.errors import InputError, NumericsError
from sensorsim.thermal.grid import FloatArray, LayerLike, WallGrid
from sensorsim.thermal.wall_boundary import WallBoundary, WallSurface, require_valid
from sensorsim.thermal.wall_start import WallStart, make_start
from sensorsim.thermal.wall_steps import WallSteps, blocks, step_counts, wall_grid

LONGEST_STEP = 60.0  # [s] with which six walls come within 0.01 K of a fine solution
Progress = Callable[[int, int], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class WallHistory:
    """Temperatures of a wall at the samples of its boundary, and the heat of the whole march per area."""

    time: FloatArray  # (t,) [s]
    exterior: FloatArray  # (t,) exterior surface temperature [K]
    interior: FloatArray  # (t,) interior surface temperature [K]
    share: FloatArray  # (p,) of the area, of each of its parallel paths [-]
    faces: FloatArray  # (p, t) exterior surface temperature of each of them [K]
    nodes: FloatArray | None  # (t, n) cell temperatures [K], exterior first, where asked for
    grid: WallGrid
    surface: WallSurface
    start: WallStart
    heat: (
        FloatArray  # (t, 2) that has entered through the exterior and the interior face since the first sample [J m-2]
    )
    stored: float  # heat that the cells hold at the last sample beyond that at the first [J m-2]

    @property
    def energy_residual(self) -> float:
        """Heat entered less heat stored, over all that passed the faces either way, at least 1 K of the wall's [-]."""
        passed = float(np.sum(np.abs(np.diff(self.heat, axis=0))))
        scale = max(passed, float(self.grid.capacity.sum()))
        return (float(self.heat[-1].sum()) - self.stored) / scale if scale > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class WallLoads:
    """Heat that each path brings to the exterior face (t,) [W m-2]; their sum goes into the wall."""

    beam: FloatArray
    sky_diffuse: FloatArray
    ground_reflected: FloatArray
    sky_radiation: FloatArray  # received from the sky less given to it
    ground_radiation: FloatArray  # received from the ground less given to it
    convection: FloatArray

    @property
    def total(self) -> FloatArray:
        """Heat into the wall (t,) [W m-2]."""
        sun = self.beam + self.sky_diffuse + self.ground_reflected
        return sun + self.sky_radiation + self.ground_radiation + self.convection


def march_wall(
    layers: Sequence[LayerLike],
    boundary: WallBoundary,
    *,
    absorptance: float,
    emissivity: float,
    interior_emissivity: float,
    sky_view: float,
    shape: str = "slab",
    radius: float | None = None,
    step: float = LONGEST_STEP,
    start: str = "auto",
    lead_in: int | None = None,
    keep_nodes: bool = False,
    progress: Progress | None = None,
) -> WallHistory:
    """March a wall, layers exterior first, through its boundary series.

    absorptance (solar), emissivity, interior_emissivity and sky_view (share of sky before the exterior face) [0 to 1].
    shape: slab, cylinder or sphere, the curved ones with the radius [m] of the exterior face; heats come per exterior
    area, and of a solid one the innermost cell stands for the interior face. step: longest internal step [s]; each
    interval between samples has equal ones. start, lead_in [days]: as in `wall_start.make_start`. progress is called
    with samples done and samples in all.
    Raises InputError for what cannot be honoured, NumericsError where a heat balance does not converge.
    """
    surface = WallSurface(
        absorptance=float(absorptance),
        emissivity=float(emissivity),
        interior_emissivity=float(interior_emissivity),
        sky_view=float(sky_view),
    )
    _require_wall(layers, surface, step)
    require_valid(boundary)
    counts = step_counts(boundary.time, step)
    steps = WallSteps(wall_grid(layers, boundary.time, counts, shape=shape, radius=radius), surface)
    began = make_start(steps, boundary, kind=start, lead_in=lead_in, step=step)
    first = steps.columns.cells[:, 0].copy()
    states = _states(steps, boundary, counts, keep_nodes, progress)
    return WallHistory(
        time=boundary.time,
        exterior=states[2],
        interior=states[3],
        share=np.ones(1),
        faces=states[2:3],
        nodes=states[4:].T if keep_nodes else None,
        grid=steps.grid,
        surface=surface,
        start=began,
        heat=states[:2].T,
        stored=float(steps.grid.capacity @ (steps.columns.cells[:, 0] - first)),
    )


def exterior_loads(history: WallHistory, boundary: WallBoundary) -> WallLoads:
    """What loaded the exterior face of a wall at the samples of its boundary."""
    surface, face = history.surface, history.exterior
    grey = surface.emissivity * STEFAN_BOLTZMANN_CONSTANT
    return WallLoads(
        beam=surface.absorptance * boundary.beam,
        sky_diffuse=surface.absorptance * boundary.sky_diffuse,
        ground_reflected=surface.absorptance * boundary.ground_reflected,
        sky_radiation=grey * surface.sky_view * (boundary.sky_temperature**4 - face**4),
        ground_radiation=grey * (1.0 - surface.sky_view) * (boundary.ground_temperature**4 - face**4),
        convection=boundary.exterior_film * (boundary.air_temperature - history.share @ history.faces),
    )


def _states(
    steps: WallSteps, boundary: WallBoundary, counts: np.ndarray, keep_nodes: bool, progress: Progress | None
) -> FloatArray:
    """The `WallSteps.state` at all samples (n + 4, t), without cells where those are not kept (4, t)."""
    kept = 4 + (steps.grid.capacity.size if keep_nodes else 0)
    states = np.zeros((kept, boundary.time.size))
    states[:, 0] = steps.state[:kept]
    for first, last in blocks(counts):
        try:
            states[:, first + 1 : last + 1] = steps.cross(boundary, counts, first, last)[:kept]
        except NumericsError as error:
            raise NumericsError(f"{error} between {boundary.time[first]:g} s and {boundary.time[last]:g} s") from error
        if progress is not None:
            progress(last, counts.size)
    return states


def _require_wall(layers: Sequence[LayerLike], surface: WallSurface, step: float) -> None:
    for name in ("absorptance", "emissivity", "interior_emissivity", "sky_view"):
        value = getattr(surface, name)
        if not 0.0 <= value <= 1.0:
            raise InputError("wall", name, value, "not a number from 0 to 1", "correct it")
    if not (math.isfinite(step) and step > 0.0):
        raise InputError("wall", "step", step, "not a number above 0", "give seconds")
    if not layers:
        raise InputError("wall", "layers", 0, "no layers", "give one or more, exterior first")
    for number, layer in enumerate(layers, 1):
        values = (layer.thickness, layer.conductivity, layer.density, layer.specific_heat, layer.resistance or 0.0)
        conducts = layer.resistance is not None or layer.thickness == 0.0 or layer.conductivity > 0.0
        if not (conducts and all(math.isfinite(value) and value >= 0.0 for value in values)):
            remedy = "give finite numbers of 0 or more, and a conductivity above 0 or a resistance"
            raise InputError("wall", f"layer {number}", values, "cannot conduct", remedy)
