"""One block of columns as the compiled march holds it: two arrays of rows, one number a lane.

w is for the faces, c for the cells, and a row is named by its offset. All loops over lanes are vectorised, which takes
unsigned offsets, as signed ones might count from the end; rows of one array at constant distances, so that none can
overlap; and a number of lanes that the compiler does not know, or it would unroll the loops instead.
"""

from collections.abc import Callable
from typing import Any, TypeVar, cast

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.thermal.boundary import Columns, FloatArray

F = TypeVar("F", bound=Callable[..., object])
Index = np.uint64
LANES = 32
UNBOUNDED = 1e9  # [K], [W m-2]
ROW = [Index(LANES * row) for row in range(38)]
# What a column carries from step to step, in the order of `Columns.carried`, and what it never changes.
EXTERIOR, INTERIOR, EXTERIOR_FILM, INTERIOR_FILM, HEAT, INTERIOR_HEAT, RISE, INTERIOR_RISE = ROW[0:8]
ABSORPTANCE, FREE, FREE_COLDER = ROW[8:11]
# Its load at a step's first sample, and LATER at its second.
ABSORBED, FORCED, EXCHANGE, SUN, LONGWAVE, LATER = *ROW[11:16], ROW[5]
# The stage that is being solved; the start of the step; the range that its cells may have and the one they have.
LOAD, FILM_CUBED, LATENT, LATENT_SLOPE, LEFT, RIGHT, MOVED, FLUX, INTERIOR_FLUX = ROW[21:30]
START, INTERIOR_START, LEAST, MOST, LOWEST, HIGHEST, MARK, ALL = ROW[30:38]
# Rows of each cell: in the stage, before the step, after its first stage, what all from here inward send to the room.
STAGE, NOW, FIRST, SENT, CELL = ROW[0:5]


def inner(function: F) -> F:
    """Compile what only compiled code calls, without the wrappers for others, which take longer than the function."""
    compiler = cast("Any", njit)(
        nogil=True, error_model="numpy", fastmath={"contract"}, no_cpython_wrapper=True, no_cfunc_wrapper=True
    )
    return cast("F", compiler(function))


@inner
def take(
    lanes: Index, w: FloatArray, c: FloatArray, lane: NDArray[Index], columns: Columns, free: FloatArray,
    free_colder: FloatArray, begin: int,
) -> None:  # fmt: skip
    """Columns from `begin` on into lanes; lanes beyond the last column repeat it."""
    last = Index(columns.orientation.size - 1)
    for j in range(lanes):
        k = min(Index(begin) + j, last)
        lane[j] = columns.orientation[k]
        w[FREE + j], w[FREE_COLDER + j] = free[lane[j]], free_colder[lane[j]]
        w[ABSORPTANCE + j], w[LOWEST + j], w[HIGHEST + j] = columns.absorptance[k], UNBOUNDED, -UNBOUNDED
    for row in range(columns.carried.shape[0]):
        to, carried = Index(row) * Index(LANES), columns.carried[row]
        for j in range(lanes):
            w[to + j] = carried[min(Index(begin) + j, last)]
    for i in range(columns.cells.shape[0]):
        at, cells = Index(i + 1) * CELL + STAGE, columns.cells[i]
        for j in range(lanes):
            c[at + j] = cells[min(Index(begin) + j, last)]
        for j in range(lanes):
            w[LOWEST + j], w[HIGHEST + j] = min(w[LOWEST + j], c[at + j]), max(w[HIGHEST + j], c[at + j])


@inner
def give(lanes: Index, w: FloatArray, c: FloatArray, columns: Columns, begin: int) -> None:
    """Lanes back into columns."""
    count, start = min(lanes, Index(columns.orientation.size - begin)), Index(begin)
    for row in range(columns.carried.shape[0]):
        at, carried = Index(row) * Index(LANES), columns.carried[row]
        for j in range(count):
            carried[start + j] = w[at + j]
    for i in range(columns.cells.shape[0]):
        at, cells = Index(i + 1) * CELL + STAGE, columns.cells[i]
        for j in range(count):
            cells[start + j] = c[at + j]


@inner
def note(lanes: Index, w: FloatArray, faces: FloatArray, begin: int) -> None:
    """Temperatures of both faces (2, m) [C] of one sample, as they are now."""
    count, start = min(lanes, Index(faces.shape[1] - begin)), Index(begin)
    exterior, interior = faces[0], faces[1]
    for j in range(count):
        exterior[start + j], interior[start + j] = w[EXTERIOR + j], w[INTERIOR + j]
