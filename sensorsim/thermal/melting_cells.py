"""The cells of a block of columns that melt, on their way through a step: passes over lanes, cell by cell.

Rows of the cells: their temperature NOW, WORK, what of it is their own, and OLD, their heat content by the step. Snow
and ice lie outermost and have rows of their own besides. What lies under them stays linear, so it is eliminated before
a step's guesses, and follows the last of them.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sensorsim.thermal.boundary import FloatArray
from sensorsim.thermal.lanes import (
    ALL,
    CELL,
    EXTERIOR,
    INTERIOR,
    LANES,
    LEFT,
    NOW,
    OLD,
    RIGHT,
    START,
    UNBOUNDED,
    WORK,
    Index,
    inner,
    room_for,
    wide,
)

FROZEN, MELTING, MELTED = 0.0, 1.0, 2.0
NEGLIGIBLE = 1e-10  # [W m-2] that a cell may lack of being frozen, so that rounding does not turn its state for ever
# Of a cell that melts: what it is guessed to be and, next, would have to be; what it has of the cell outward of it and
# of the interior face [-]; latent heat taken up [J m-2].
STATE, NEXT, OUTWARD, ROOM, TAKEN, MELTING_CELL = [Index(LANES * row) for row in range(6)]
# Of a column: whether its face is held at 0 C and what it then takes in [W m-2], whether it has settled; flux into the
# exterior face per kelvin of itself and, away, of the interior one, into that by the exterior one, away, and by itself.
_ROW = [ALL + Index(LANES * row) for row in range(16)]
HELD, GAIN, SETTLED, BY_FACE, FROM_ROOM, TO_ROOM, BY_ROOM = _ROW[0:7]
# What a cell does not lose to the one outward of it; own part of the innermost linear cell; heat from the cell before;
# whether cells freeze or begin to melt, any change, the face turns; film at 0 C, cubed, and its inverse.
KEPT_BACK, INNERMOST, BEFORE, COLDER, WARMER, TURNED, CUBED, ROOT, MELTING_ROWS = _ROW[7:16]


class Thaw(NamedTuple):
    """A wall that melts."""

    capacity: FloatArray  # (n,) [J m-2 K-1]
    conductance: FloatArray  # (n + 1,) [W m-2 K-1]
    latent: FloatArray  # (n,) heat that it takes to melt each cell, 0 for what does not, which lies inmost [J m-2]
    drains: bool  # whether its water runs off rather than get warmer


class Block(NamedTuple):
    """What the passes work in, for one wall and step."""

    c: FloatArray  # rows of all cells
    v: FloatArray  # rows of those that melt, and one beyond
    linear: FloatArray  # (n + 1, 4) of cells that do not: by content, conductance inward [W m-2 K-1], by outward, room
    whole: FloatArray  # (4,) kept and room of the outermost of them; the innermost one by what melts and by the room
    place: NDArray[Index]  # (n + 2,) of all cells in `c`, faces included
    spot: NDArray[Index]  # (p + 1,) of those that melt in `v`


def block_of(wall: Thaw) -> Block:
    """Room for a block of columns."""
    n, melting = wall.capacity.size, int(np.count_nonzero(wall.latent))
    place, spot = np.arange(n + 2, dtype=Index) * CELL, np.arange(melting + 1, dtype=Index) * MELTING_CELL
    c, v = room_for((n + 2) * int(CELL)), room_for((melting + 1) * int(MELTING_CELL))
    return Block(c, v, np.zeros((n + 1, 4)), np.zeros(4), place, spot)


@inner
def factor_linear(wall: Thaw, block: Block, step: float) -> None:
    """Elimination of the cells that do not melt, as far as it is alike for all columns."""
    n, p = wall.capacity.size, block.spot.size - 1
    kept, room, linear, whole = 1.0, 1.0, block.linear, block.whole
    linear[n, 3] = 1.0  # beyond the last cell is the interior face
    for i in range(n - 1, p - 1, -1):
        outward, inward = wall.conductance[i], wall.conductance[i + 1]
        inside = wall.capacity[i] / step + inward * kept
        own = 1.0 / (outward + inside)
        room, kept = inward * room * own, inside * own
        linear[i, 0], linear[i, 1], linear[i, 2], linear[i, 3] = own, inward, outward * own, room
    whole[0], whole[1], whole[2], whole[3] = kept, room, 1.0, 0.0
    for i in range(p, n):
        whole[2], whole[3] = whole[2] * linear[i, 2], linear[i, 3] + linear[i, 2] * whole[3]


@inner
def begin(lanes: Index, w: FloatArray, wall: Thaw, block: Block, step: float) -> None:
    """Contents before the step, the first guess of what melts, and elimination of what does not."""
    wide()
    c, v, p = block.c, block.v, block.spot.size - 1
    for i in range(p):
        at, spot, heat, most = block.place[i + 1], block.spot[i], wall.capacity[i] / step, wall.latent[i]
        most = np.inf if wall.drains else most
        for j in range(lanes):
            taken = v[spot + TAKEN + j]
            c[at + OLD + j] = heat * c[at + NOW + j] + taken / step
            v[spot + STATE + j] = FROZEN if taken <= 0.0 else (MELTING if taken < most else MELTED)
    for i in range(wall.capacity.size - 1, p - 1, -1):
        at, heat, own, inward = block.place[i + 1], wall.capacity[i] / step, block.linear[i, 0], block.linear[i, 1]
        for j in range(lanes):
            c[at + WORK + j] = own * (heat * c[at + NOW + j] + inward * c[at + CELL + WORK + j])
    for j in range(lanes):
        w[INNERMOST + j], w[SETTLED + j] = 0.0, 0.0
        w[HELD + j] = 1.0 if wall.drains and w[START + j] == 0.0 else 0.0
    for i in range(p, wall.capacity.size):
        at, outward = block.place[i + 1], block.linear[i, 2]
        for j in range(lanes):
            w[INNERMOST + j] = c[at + WORK + j] + outward * w[INNERMOST + j]


@inner
def eliminate_melting(lanes: Index, w: FloatArray, wall: Thaw, block: Block, step: float) -> None:
    """Elimination of the cells that are not at 0 C, innermost first, and what the exterior face then exchanges.

    Sums of positive terms alone, as in `conduction`. A face that is held at 0 C gives the first cell its gain.
    """
    wide()
    c, v, p = block.c, block.v, block.spot.size - 1
    for j in range(lanes):
        w[KEPT_BACK + j], v[block.spot[p] + ROOM + j] = block.whole[0], block.whole[1]
    for i in range(p - 1, -1, -1):
        at, spot, first = block.place[i + 1], block.spot[i], 1.0 if i == 0 else 0.0
        heat, melt = wall.capacity[i] / step, wall.latent[i] / step
        link, inward = wall.conductance[i], wall.conductance[i + 1]
        for j in range(lanes):
            state, held = v[spot + STATE + j], first * w[HELD + j]
            outward, inside = link * (1.0 - held), heat + inward * w[KEPT_BACK + j]
            source = c[at + OLD + j] - (melt if state == MELTED else 0.0) + held * w[GAIN + j]
            own = 0.0 if state == MELTING else 1.0 / (outward + inside)
            c[at + WORK + j] = (source + inward * c[at + CELL + WORK + j]) * own
            w[KEPT_BACK + j] = 1.0 if state == MELTING else inside * own
            v[spot + OUTWARD + j] = outward * own
            v[spot + ROOM + j] = inward * v[spot + MELTING_CELL + ROOM + j] * own
    for j in range(lanes):
        outermost = wall.conductance[0] * (1.0 - w[HELD + j])
        w[BY_FACE + j] = UNBOUNDED if w[HELD + j] > 0.0 else outermost * w[KEPT_BACK + j]
        w[FROM_ROOM + j], w[LEFT + j] = outermost * v[ROOM + j], outermost * c[CELL + WORK + j]


@inner
def exchange_inside(lanes: Index, w: FloatArray, wall: Thaw, block: Block) -> None:
    """What the interior face exchanges, likewise."""
    wide()
    c, v, whole, innermost = block.c, block.v, block.whole, wall.conductance[wall.capacity.size]
    for j in range(lanes):
        w[TO_ROOM + j], w[RIGHT + j], w[BY_ROOM + j] = 1.0, 0.0, 0.0
    for i in range(block.spot.size - 1):
        at, spot = block.place[i + 1], block.spot[i]
        for j in range(lanes):
            outward = v[spot + OUTWARD + j]
            w[RIGHT + j] = c[at + WORK + j] + outward * w[RIGHT + j]
            w[BY_ROOM + j] = v[spot + ROOM + j] + outward * w[BY_ROOM + j]
            w[TO_ROOM + j] *= outward
    for j in range(lanes):
        w[TO_ROOM + j] = innermost * (whole[2] * w[TO_ROOM + j])
        w[BY_ROOM + j] = innermost * (1.0 - (whole[3] + whole[2] * w[BY_ROOM + j]))
        w[RIGHT + j] = innermost * (w[INNERMOST + j] + whole[2] * w[RIGHT + j])


@inner
def substitute_melting(lanes: Index, w: FloatArray, block: Block) -> None:
    """Temperatures of the cells that melt, and of the one next to them, from those of the faces."""
    wide()
    c, v, p = block.c, block.v, block.spot.size - 1
    for j in range(lanes):
        w[EXTERIOR + j] = 0.0 if w[HELD + j] > 0.0 else w[EXTERIOR + j]
        c[NOW + j] = w[EXTERIOR + j]
    for i in range(p):
        at, spot = block.place[i + 1], block.spot[i]
        for j in range(lanes):
            before, room = v[spot + OUTWARD + j] * c[at - CELL + NOW + j], v[spot + ROOM + j] * w[INTERIOR + j]
            c[at + NOW + j] = c[at + WORK + j] + before + room
    substitute_linear(lanes, w, block, p, p + 1)


@inner
def substitute_linear(lanes: Index, w: FloatArray, block: Block, first: int, last: int) -> None:
    """Temperatures of cells that do not melt, and beyond them the interior face."""
    wide()
    c = block.c
    for i in range(first, last):
        at, outward, room = block.place[i + 1], block.linear[i, 2], block.linear[i, 3]
        for j in range(lanes):
            c[at + NOW + j] = c[at + WORK + j] + outward * c[at - CELL + NOW + j] + room * w[INTERIOR + j]


@inner
def judge(lanes: Index, w: FloatArray, wall: Thaw, block: Block, step: float) -> None:
    """What each cell at its temperature, or at 0 C by its content, would have to be; which columns have such cells."""
    wide()
    c, v = block.c, block.v
    for j in range(lanes):
        w[COLDER + j], w[WARMER + j] = 0.0, 0.0
    for i in range(block.spot.size - 1):
        at, spot, first = block.place[i + 1], block.spot[i], 1.0 if i == 0 else 0.0
        most = UNBOUNDED if wall.drains else wall.latent[i] / step + NEGLIGIBLE
        link, inward = wall.conductance[i], wall.conductance[i + 1]
        for j in range(lanes):
            state, now, held = v[spot + STATE + j], c[at + NOW + j], first * w[HELD + j]
            outer = link * (c[at - CELL + NOW + j] - now)
            outer = w[GAIN + j] if held > 0.0 else outer
            content = c[at + OLD + j] + outer + inward * (c[at + CELL + NOW + j] - now)
            frozen = MELTING if now > 0.0 else FROZEN
            melted = MELTING if now < 0.0 else MELTED
            melting = FROZEN if content < -NEGLIGIBLE else (MELTED if content > most else MELTING)
            after = frozen if state == FROZEN else (melted if state == MELTED else melting)
            v[spot + NEXT + j] = after
            apart = 1.0 if after != state else 0.0
            w[COLDER + j] = max(w[COLDER + j], apart if min(state, after) == FROZEN else 0.0)
            w[WARMER + j] = max(w[WARMER + j], apart)


@inner
def guess(lanes: Index, w: FloatArray, wall: Thaw, block: Block) -> int:
    """Guess anew in columns that are not what they would have to be; returns how many.

    Faces come first, then cells that begin to melt or freeze to the end, last those that melt to the end or begin to
    freeze.
    """
    wide()
    c, v, count, outermost = block.c, block.v, 0, wall.conductance[0]
    for j in range(lanes):
        held = w[HELD + j]
        release = 1.0 if w[GAIN + j] + outermost * c[CELL + NOW + j] < 0.0 else 0.0
        turned = release if held > 0.0 else (1.0 if w[EXTERIOR + j] > 0.0 else 0.0)
        turned = turned if wall.drains else 0.0
        w[TURNED + j], w[HELD + j] = turned, abs(held - turned)
        w[SETTLED + j] = 1.0 if turned + w[WARMER + j] == 0.0 else 0.0
        count += 0 if turned + w[WARMER + j] == 0.0 else 1
    for i in range(block.spot.size - 1 if count > 0 else 0):
        spot = block.spot[i]
        for j in range(lanes):
            state, after = v[spot + STATE + j], v[spot + NEXT + j]
            begins = 1.0 if min(state, after) == FROZEN else 0.0
            first = w[TURNED + j] == 0.0 and begins == w[COLDER + j]
            v[spot + STATE + j] = after if first else state
    return count


@inner
def store(lanes: Index, w: FloatArray, wall: Thaw, block: Block, step: float) -> None:
    """Latent heat at the end of the step; what is more than melts snow goes on inward, and at last drains."""
    wide()
    c, v, p = block.c, block.v, block.spot.size - 1
    for j in range(lanes):
        w[BEFORE + j] = 0.0
    for i in range(p):
        at, spot, latent, first = block.place[i + 1], block.spot[i], wall.latent[i], 1.0 if i == 0 else 0.0
        link, inward, most = wall.conductance[i], wall.conductance[i + 1], latent if wall.drains else np.inf
        for j in range(lanes):
            state, now, held = v[spot + STATE + j], c[at + NOW + j], first * w[HELD + j]
            outer = link * (c[at - CELL + NOW + j] - now)
            outer = w[GAIN + j] if held > 0.0 else outer
            content = step * (c[at + OLD + j] + outer + inward * (c[at + CELL + NOW + j] - now))
            content = content if state == MELTING else (latent if state == MELTED else 0.0)
            content += w[BEFORE + j]
            v[spot + TAKEN + j] = min(content, most)
            w[BEFORE + j] = content - min(content, most)
    for j in range(lanes):
        v[block.spot[p] + TAKEN + j] += w[BEFORE + j]
