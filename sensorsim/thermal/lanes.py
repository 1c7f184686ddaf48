"""One block of columns as the compiled march holds it: two arrays of rows, one number a lane.

w is for the faces, c for the cells, and a row is named by its offset. All loops over lanes are vectorised, which takes
unsigned offsets, as signed ones might count from the end; rows of one array at constant distances, so that none can
overlap; and a number of lanes that the compiler does not know, or it would unroll the loops instead.
"""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar, cast

import numpy as np
from numba import njit, types
from numba.extending import intrinsic

from sensorsim.thermal.boundary import Columns, FloatArray

F = TypeVar("F", bound=Callable[..., object])
Index = np.uint64
LANES = 32  # at most
VECTOR = 8
UNBOUNDED = 1e9  # [K], [W m-2]
ROW = [Index(LANES * row) for row in range(52)]
# What a column carries from step to step, in the order of `Columns.carried`, and what it never changes.
EXTERIOR, INTERIOR, PER_FILM, INTERIOR_PER_FILM, HEAT, INTERIOR_HEAT = ROW[0:6]
RISE, INTERIOR_RISE, RISE_BEFORE, INTERIOR_RISE_BEFORE = ROW[6:10]
ABSORPTANCE, FREE, FREE_COLDER = ROW[10:13]
# Its load at a step's first sample, and LATER at its second.
ABSORBED, FORCED, EXCHANGE, SUN, LONGWAVE, LATER = *ROW[13:18], ROW[5]
# The stage that is being solved; fluxes of the first and of the second; the range of the cells before and after.
LOAD, FILM_CUBED, LATENT, LATENT_SLOPE, LEFT, RIGHT, MOVED, FIRST, OUTERMOST = ROW[23:32]
FLUX, INTERIOR_FLUX, LATER_FLUX, LATER_INTERIOR_FLUX = ROW[32:36]
START, INTERIOR_START, LEAST, MOST, LOWEST, HIGHEST, MARK = ROW[36:43]
KEPT, ALL = ROW[43], ROW[51]
# Rows of each cell: now, as eliminated so far, before the step.
NOW, WORK, OLD, CELL = ROW[0:4]


class Group(NamedTuple):
    """Orientations at one absorptance, which have a lane each: what acts on them lies side by side in memory."""

    begin: Index  # first orientation
    width: Index  # orientations
    absorptances: Index  # that all orientations have
    absorptance: Index  # which of them


def inner(function: F) -> F:
    """Compile what only compiled code calls: no wrappers for others, and no counting of references to what it is lent.

    Either would take longer than the function.
    """
    compiler = cast("Any", njit)(
        nogil=True,
        error_model="numpy",
        fastmath={"contract"},
        no_cpython_wrapper=True,
        no_cfunc_wrapper=True,
        _nrt=False,
    )
    return cast("F", compiler(function))


def scalar(function: F) -> F:
    """Compile a part of a loop's body, so that the loop is compiled as one."""
    compiler = cast("Any", njit)(
        nogil=True, error_model="numpy", fastmath={"contract"}, no_cpython_wrapper=True, no_cfunc_wrapper=True,
        forceinline=True,
    )  # fmt: skip
    return cast("F", compiler(function))


def _widest(_context: object) -> tuple[Any, Any]:
    """Let the function that this stands in use the widest vectors there are; the compiler prefers narrower ones."""

    def generate(context: Any, builder: Any, _signature: Any, _arguments: Any) -> Any:
        set.add(builder.function.attributes, '"prefer-vector-width"="512"')  # llvmlite knows no attribute with a value
        return context.get_dummy_value()

    return types.void(), generate


wide = cast("Callable[[], None]", intrinsic(_widest))


def room_for(count: int) -> FloatArray:
    """Zeros that begin where a vector does in memory: one that lies across two lines of it takes twice as long."""
    line = 64  # bytes
    room = np.zeros(count + line // 8)
    first = -room.ctypes.data % line // 8
    return room[first : first + count]


def lanes_for(orientations: int) -> Index:
    """Lanes of a block: whole vectors, and about as many in each of the blocks that it takes."""
    blocks = -(-orientations // LANES)
    return Index(VECTOR * -(-orientations // (VECTOR * blocks)))


@scalar
def column(group: Group, j: int) -> Index:
    """Column of a lane; lanes beyond the last orientation repeat it."""
    return (group.begin + min(Index(j), group.width - Index(1))) * group.absorptances + group.absorptance


@scalar
def groups(columns: Columns, lanes: Index) -> int:
    """How many groups there are of all columns."""
    absorptances = columns.absorptance.size
    return int(-(-(columns.carried.shape[1] // absorptances) // int(lanes)) * absorptances)


@scalar
def group_at(columns: Columns, lanes: Index, number: int) -> Group:
    """The group of a number; those of the same orientations, which the same acts on, follow one another."""
    absorptances, begin = Index(columns.absorptance.size), Index(number // columns.absorptance.size) * lanes
    width = min(lanes, Index(columns.carried.shape[1]) // absorptances - begin)
    return Group(begin, width, absorptances, Index(number % columns.absorptance.size))


@scalar
def spread(lanes: Index, w: FloatArray, at: Index, values: FloatArray, group: Group) -> None:
    """Values (o,) of a group's orientations into lanes."""
    for j in range(group.width):
        w[at + j] = values[group.begin + j]
    last = w[at + group.width - Index(1)]
    for j in range(group.width, lanes):
        w[at + j] = last


@inner
def take(
    lanes: Index,
    w: FloatArray,
    c: FloatArray,
    group: Group,
    columns: Columns,
    free: FloatArray,
    free_colder: FloatArray,
) -> None:
    """Columns of a group into lanes."""
    spread(lanes, w, FREE, free, group)
    spread(lanes, w, FREE_COLDER, free_colder, group)
    for j in range(lanes):
        w[ABSORPTANCE + j], w[LEAST + j], w[MOST + j] = columns.absorptance[group.absorptance], UNBOUNDED, -UNBOUNDED
    for row in range(columns.carried.shape[0]):
        to, carried = Index(row) * Index(LANES), columns.carried[row]
        for j in range(lanes):
            w[to + j] = carried[column(group, j)]
    for i in range(columns.cells.shape[0]):
        at, cells = Index(i + 1) * CELL + NOW, columns.cells[i]
        for j in range(lanes):
            c[at + j] = cells[column(group, j)]
        for j in range(lanes):
            w[LEAST + j], w[MOST + j] = min(w[LEAST + j], c[at + j]), max(w[MOST + j], c[at + j])


@inner
def give(w: FloatArray, c: FloatArray, group: Group, columns: Columns) -> None:
    """Lanes back into columns."""
    for row in range(columns.carried.shape[0]):
        at, carried = Index(row) * Index(LANES), columns.carried[row]
        for j in range(group.width):
            carried[column(group, j)] = w[at + j]
    for i in range(columns.cells.shape[0]):
        at, cells = Index(i + 1) * CELL + NOW, columns.cells[i]
        for j in range(group.width):
            cells[column(group, j)] = c[at + j]


@inner
def note(w: FloatArray, faces: FloatArray, group: Group) -> None:
    """Temperatures of both faces (2, m) [C] of one sample, as they are now."""
    exterior, interior = faces[0], faces[1]
    for j in range(group.width):
        k = column(group, j)
        exterior[k], interior[k] = w[EXTERIOR + j], w[INTERIOR + j]
