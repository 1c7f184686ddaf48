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

from sensorsim.thermal.boundary import Columns, FloatArray, Outside

F = TypeVar("F", bound=Callable[..., object])
Index = np.uint64
LANES = 32  # at most
VECTOR = 8
UNBOUNDED = 1e9  # [K], [W m-2]
ROW = [Index(LANES * row) for row in range(53)]
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
KEPT, VAPOUR_EXCHANGE, ALL = ROW[43], ROW[51], ROW[52]
# Rows of each cell: now, as eliminated so far, before the step.
NOW, WORK, OLD, CELL = ROW[0:4]


class Group(NamedTuple):
    """Orientations at one absorptance, which have a lane each: what acts on them lies side by side in memory."""

    begin: Index  # first orientation
    width: Index  # how many
    column: Index  # of the first
    absorptance: Index


def outer(function: F) -> F:
    """Compile what Python calls, and keep it on disk. It counts no references to arrays, which its caller holds."""
    compiler = cast("Any", njit)(
        cache=True, nogil=True, error_model="numpy", fastmath={"contract"}, _nrt=False
    )  # fmt: skip
    return cast("F", compiler(function))


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
    blocks = max(-(-orientations // LANES), 1)
    return Index(VECTOR * max(-(-orientations // (VECTOR * blocks)), 1))


@scalar
def groups(columns: Columns, lanes: Index) -> int:
    """How many groups there are of all columns."""
    absorptances = columns.absorptance.size
    return int(-(-(columns.carried.shape[1] // absorptances) // int(lanes)) * absorptances)


@scalar
def group_at(columns: Columns, lanes: Index, number: int) -> Group:
    """The group of a number; those of the same orientations, which the same acts on, follow one another."""
    absorptances, begin = columns.absorptance.size, Index(number // columns.absorptance.size) * lanes
    orientations, absorptance = Index(columns.carried.shape[1] // absorptances), Index(number % absorptances)
    return Group(begin, min(lanes, orientations - begin), absorptance * orientations + begin, absorptance)


@scalar
def spread(lanes: Index, w: FloatArray, at: Index, values: FloatArray, begin: Index, width: Index) -> None:
    """Values of a group from `begin` on into lanes; those beyond its width repeat the last one."""
    for j in range(width):
        w[at + j] = values[begin + j]
    last = w[at + width - Index(1)]
    for j in range(width, lanes):
        w[at + j] = last


@scalar
def collect(w: FloatArray, at: Index, values: FloatArray, group: Group) -> None:
    """Lanes back into the values of a group's columns."""
    for j in range(group.width):
        values[group.column + j] = w[at + j]


@inner
def take(
    lanes: Index, w: FloatArray, c: FloatArray, group: Group, columns: Columns, outside: Outside
) -> None:  # fmt: skip
    """Columns of a group into lanes."""
    spread(lanes, w, FREE, outside.free, group.begin, group.width)
    spread(lanes, w, FREE_COLDER, outside.free_colder, group.begin, group.width)
    for j in range(lanes):
        w[ABSORPTANCE + j], w[LEAST + j], w[MOST + j] = columns.absorptance[group.absorptance], UNBOUNDED, -UNBOUNDED
    for row in range(columns.carried.shape[0]):
        spread(lanes, w, Index(row) * Index(LANES), columns.carried[row], group.column, group.width)
    for i in range(columns.cells.shape[0]):
        at = Index(i + 1) * CELL + NOW
        spread(lanes, c, at, columns.cells[i], group.column, group.width)
        for j in range(lanes):
            w[LEAST + j], w[MOST + j] = min(w[LEAST + j], c[at + j]), max(w[MOST + j], c[at + j])


@inner
def give(w: FloatArray, c: FloatArray, group: Group, columns: Columns) -> None:
    """Lanes back into columns."""
    for row in range(columns.carried.shape[0]):
        collect(w, Index(row) * Index(LANES), columns.carried[row], group)
    for i in range(columns.cells.shape[0]):
        collect(c, Index(i + 1) * CELL + NOW, columns.cells[i], group)


@inner
def note(w: FloatArray, faces: FloatArray, group: Group) -> None:
    """Temperatures of both faces (2, m) [C] of one sample, as they are now."""
    collect(w, EXTERIOR, faces[0], group)
    collect(w, INTERIOR, faces[1], group)
