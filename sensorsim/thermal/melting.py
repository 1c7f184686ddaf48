"""Walls that begin with snow or ice, compiled: backward Euler in enthalpy, in blocks of columns.

A cell of capacity C that has taken up latent heat M of its L holds C T + M. While 0 < M < L it stays at 0 C, whether
it melts or freezes, and what reaches it goes into M. A step guesses which cells do so, solves the others, linear then,
with both faces, and corrects the guess until it holds, cells that begin to melt within those that end it: the nested
iteration of [Brugnano2008], finite and free of chatter as the matrix is an M-matrix.

Snow drains: it stays at 0 C when it has melted, its water carries off what heat comes then, and where its face would
get warmer than 0 C the face holds that, and all heat that it takes in goes to the first cell, and on inward where that
has melted. Ice keeps its water, which warms. Melted snow keeps its place, density and conductivity, and as much water
as it held stays to freeze again.
"""

from collections.abc import Sequence

import numpy as np

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.thermal.balance import load
from sensorsim.thermal.boundary import Columns, FloatArray, Inside, Outside
from sensorsim.thermal.grid import LayerLike, WallGrid
from sensorsim.thermal.kernel import DAMPED_GUESS, Shared, room_at, sample, settle, share
from sensorsim.thermal.lanes import (
    Group,
    Index,
    collect,
    give,
    group_at,
    groups,
    inner,
    lanes_for,
    outer,
    room_for,
    spread,
    take,
)
from sensorsim.thermal.melting_cells import (
    MELTING_ROWS,
    TAKEN,
    Block,
    Thaw,
    begin,
    block_of,
    eliminate_melting,
    exchange_inside,
    factor_linear,
    guess,
    judge,
    store,
    substitute_linear,
    substitute_melting,
)
from sensorsim.thermal.melting_faces import balance_melting, enter, gain_at_zero

HEAT_OF_FUSION = 3.34e5  # [J kg-1] of ice [Incropera2007]
GUESSES = 200


def latent_heat(layers: Sequence[LayerLike], grid: WallGrid, depth: float) -> FloatArray:
    """Heat (n,) [J m-2] that it takes to melt each cell of a wall that is snow or ice down to `depth` [m]."""
    melts = grid.depth < depth
    bottom = np.cumsum([layer.thickness for layer in layers])
    specific = np.array([layer.specific_heat for layer in layers])[np.searchsorted(bottom, grid.depth[melts])]
    latent = np.zeros(grid.capacity.size)
    latent[melts] = grid.capacity[melts] / specific * HEAT_OF_FUSION
    return latent


def advance_melting(
    columns: Columns,
    taken: FloatArray,
    wall: Thaw,
    outside: Outside,
    inside: Inside,
    first: int,
    last: int,
    step: float,
) -> int:
    """Make steps `first` to `last` - 1 [of `step` s]; returns how many balances or states did not settle.

    `taken` (n + 1, m) [J m-2] is the latent heat that cells have taken up and, last, what has drained.
    """
    lanes, w = lanes_for(outside.irradiance.shape[1]), room_for(int(MELTING_ROWS))
    return int(_advance(lanes, w, block_of(wall), columns, taken, wall, outside, inside, first, last, step))


@outer
def _advance(
    lanes: Index, w: FloatArray, block: Block, columns: Columns, taken: FloatArray, wall: Thaw,
    outside: Outside, inside: Inside, first: int, last: int, step: float,
) -> int:  # fmt: skip
    """Steps of all blocks in turn."""
    failures = 0
    factor_linear(wall, block, step)
    for number in range(groups(columns, lanes)):
        group = group_at(columns, lanes, number)
        take(lanes, w, block.c, group, columns, outside)
        _take(lanes, block, taken, group)
        sample(lanes, w, group, outside, first)
        for k in range(first, last):
            sample(lanes, w, group, outside, k + 1)
            failures += _step(lanes, w, block, share(outside, inside, k + 1), wall, outside, inside, step)
            settle(lanes, w, step)
        give(w, block.c, group, columns)
        _give(block, taken, group)
    return failures


@inner
def _take(lanes: Index, block: Block, taken: FloatArray, group: Group) -> None:
    """Latent heat of columns into lanes."""
    p = block.spot.size - 1
    for i in range(p + 1):
        at, held = block.spot[i] + TAKEN, taken[i if i < p else taken.shape[0] - 1]
        spread(lanes, block.v, at, held, group.column, group.width)


@inner
def _give(block: Block, taken: FloatArray, group: Group) -> None:
    """Latent heat of lanes back into columns."""
    p = block.spot.size - 1
    for i in range(p + 1):
        at, held = block.spot[i] + TAKEN, taken[i if i < p else taken.shape[0] - 1]
        collect(block.v, at, held, group)


@inner
def _step(
    lanes: Index, w: FloatArray, block: Block, shared: Shared, wall: Thaw, outside: Outside, inside: Inside, step: float
) -> int:
    """One step of one block; returns failures."""
    wet, grey, failures, turning = outside.latent.shape[0] > 1, outside.emissivity * SIGMA, 0, 1
    room = room_at(shared, shared, 1.0, inside.free, inside.emissivity * SIGMA)
    air, vapour = shared[0], shared[1]
    begin(lanes, w, wall, block, step)
    load(lanes, w, 1.0, DAMPED_GUESS)
    gain_at_zero(lanes, w, grey, air, vapour, wet)
    guesses = 0
    while turning > 0 and guesses < GUESSES:
        eliminate_melting(lanes, w, wall, block, step)
        exchange_inside(lanes, w, wall, block)
        failures = balance_melting(lanes, w, grey, air, vapour, room, wet)
        substitute_melting(lanes, w, block)
        judge(lanes, w, wall, block, step)
        turning = guess(lanes, w, wall, block)
        guesses += 1
    substitute_linear(lanes, w, block, block.spot.size - 1, wall.capacity.size + 1)
    enter(lanes, w, wall, block)
    store(lanes, w, wall, block, step)
    return failures + turning
