"""Odd layers: without capacity, without thickness, ten metres thick, or a billion times better than their neighbour."""

from collections.abc import Sequence
from functools import partial

import numpy as np

from sensorsim.materials import Layer
from sensorsim.study.stability_model import Case
from sensorsim.study.wall_setup import (
    BLOCK,
    DARK,
    STEEL,
    FloatArray,
    constant,
    gap,
    indoors,
    outdoors,
    slab,
    uniform_grid,
)
from sensorsim.thermal import march

PLACES = ("between", "outermost", "innermost", "doubled")


def _order(place: str, air: Layer) -> list[Layer]:
    board = slab(0.02, 0.16, 800.0, 1090.0)
    return {
        "between": [board, air, board],
        "outermost": [air, board],
        "innermost": [board, air],
        "doubled": [board, air, air, board],
    }[place]


def _gap_miss(place: str) -> float:
    """Difference of both faces between an air space of no capacity and one of 1e-9 J m-3 K-1."""
    count = 200
    morning = 0.5 + 0.5 * np.tanh((np.arange(count) - 120.0) / 30.0)
    outside = outdoors(280.0 + 10.0 * morning, 15.0, sun=400.0 * morning, sky=280.0, emissivity=0.9)
    faces = []
    for air in (gap(0.2), slab(0.01, 0.05, 1e-6, 1e-3)):
        layers = _order(place, air)
        cells = [4 if layer == air else 8 for layer in layers]
        history = march(
            layers, outside, indoors(constant(280.0, count), 5.0), np.array([0.7]), step=600.0,
            record=np.arange(60, count), grid=uniform_grid(layers, cells),
        )  # fmt: skip
        faces.append(np.stack([history.exterior, history.interior]))
    return float(np.abs(faces[0] - faces[1]).max())


def _resistances_alone() -> float:
    count = 50
    air = 280.0 + 10.0 * np.sin(np.arange(count))
    history = march(
        [gap(0.1), gap(0.3)], outdoors(air, 15.0, sun=200.0), indoors(constant(290.0, count), 5.0), np.ones(1),
        step=300.0, record=np.arange(1, count),
    )  # fmt: skip
    inward = 1.0 / (0.4 + 1.0 / 5.0)
    exact = (15.0 * air[1:] + 200.0 + inward * 290.0) / (15.0 + inward)
    return float(np.abs(history.exterior[:, 0, 0] - exact).max())


def _swing(layers: Sequence[Layer], cells: Sequence[int] | None = None, *, step: float, count: int) -> FloatArray:
    """Exterior face (t,) [K] under air that warms and swings."""
    air = 285.0 + 5.0 * np.tanh(np.arange(count) / 30.0) + 3.0 * np.sin(np.arange(count) / 10.0)
    history = march(
        layers, outdoors(air, 15.0, sky=280.0, emissivity=0.9), indoors(constant(280.0, count), 10.0), DARK,
        step=step, record=np.arange(1, count), grid=None if cells is None else uniform_grid(layers, cells),
    )  # fmt: skip
    return np.asarray(history.exterior[:, 0, 0])


def _thin_and_thick() -> float:
    """Difference that layers of 1e-9 m and of none make to ten metres of rock."""
    rock = slab(10.0, 1.5, 2000.0, 900.0)
    extremes = [slab(1e-9, 0.2, 1000.0, 1000.0), rock, slab(0.0, 1.0, 1.0, 1.0)]
    return float(np.abs(_swing(extremes, step=600.0, count=300) - _swing([rock], step=600.0, count=300)).max())


def _one_cell() -> float:
    """One cell of steel against twenty, at steps of 10 minutes."""
    one, twenty = (_swing([STEEL], [cells], step=600.0, count=300) for cells in (1, 20))
    return float(np.sqrt(np.mean((one - twenty) ** 2)))


def _many_cells() -> float:
    layer = [slab(1.0, 1.0, 1000.0, 1000.0)]
    fine, finest = (_swing(layer, [cells], step=3600.0, count=25) for cells in (1000, 10_000))
    return float(np.abs(fine - finest).max())


def _series_miss(better: float, worse: float) -> float:
    """Steady flux through two layers less that of their resistances in series."""
    layers, count = [slab(0.01, better, 1000.0, 1000.0), slab(0.01, worse, 1000.0, 1000.0)], 4000
    history = march(
        layers, outdoors(constant(300.0, count), 20.0), indoors(constant(280.0, count), 8.0), DARK,
        step=3600.0, record=np.array([count - 1]), grid=uniform_grid(layers, [5, 5]),
    )  # fmt: skip
    resistance = 1.0 / 20.0 + 0.01 / better + 0.01 / worse + 1.0 / 8.0
    return abs(8.0 * (float(history.interior[0, 0, 0]) - 280.0) - 20.0 / resistance)


def _insulated() -> float:
    """What a room that warms by 30 K does to a face behind a resistance of 1e12."""
    count, faces = 200, []
    for room in (280.0, 310.0):
        history = march(
            [BLOCK, gap(1e12), BLOCK], outdoors(constant(280.0, count), 10.0), indoors(constant(room, count), 8.0),
            DARK, step=600.0, record=np.arange(count),
            start=constant(280.0, 2 * 4), grid=uniform_grid([BLOCK, gap(1e12), BLOCK], [4, 0, 4]),
        )  # fmt: skip
        faces.append(history.exterior)
    return float(np.abs(faces[0] - faces[1]).max())


CASES = (
    *(
        Case(
            name=f"air space {place}",
            group="odd layers",
            stresses="a row without heat capacity; eq. 9 of the report divides by it",
            measured="difference from the same wall with 1e-9 J m-3 K-1 in the space, both faces",
            unit="K",
            bound=1e-6,
            reason="a capacity that small holds no heat that could be seen",
            measure=partial(_gap_miss, place),
        )
        for place in PLACES
    ),
    Case(
        name="wall of resistances alone",
        group="odd layers",
        stresses="no cell at all",
        measured="distance from the balance of each moment",
        unit="K",
        bound=1e-9,
        reason="without capacity the balance is algebraic",
        measure=_resistances_alone,
    ),
    Case(
        name="layers of 0 m, 1e-9 m and 10 m",
        group="odd layers",
        stresses="0/0 in a conductance, cells that differ by 1e8",
        measured="difference that the two thin layers make",
        unit="K",
        bound=0.01,
        reason="the accuracy that is asked of the default wall",
        measure=_thin_and_thick,
    ),
    Case(
        name="one layer of one cell",
        group="odd layers",
        stresses="first and last cell are the same",
        measured="rms difference from twenty cells",
        unit="K",
        bound=0.03,
        reason="what is asked of steel against EnergyPlus; 1.5 mm of it have one temperature",
        measure=_one_cell,
    ),
    Case(
        name="ten thousand cells",
        group="odd layers",
        stresses="an elimination of 10,000 rows",
        measured="difference from a thousand cells",
        unit="K",
        bound=1e-3,
        reason="both are far finer than a wave of the air",
        measure=_many_cells,
    ),
    *(
        Case(
            name=f"conductivities {better:g} and {worse:g} W m-1 K-1",
            group="odd layers",
            stresses="neighbours whose ratio is 1e4 to 1e9",
            measured="steady flux less that of the resistances in series",
            unit="W m-2",
            bound=1e-7,
            reason="1e-8 K at an interior film of 8 W m-2 K-1",
            measure=partial(_series_miss, better, worse),
        )
        for better, worse in ((386.0, 0.0386), (1e3, 1e-6), (1e-3, 1e3))
    ),
    Case(
        name="perfectly insulating layer",
        group="odd layers",
        stresses="a link of 1e-12 W m-2 K-1 in the elimination",
        measured="what a room 30 K warmer does to the outer face",
        unit="K",
        bound=1e-8,
        reason="30 K over 1e12 m2 K W-1 carry nothing",
        measure=_insulated,
    ),
)
