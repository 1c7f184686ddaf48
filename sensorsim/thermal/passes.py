"""The cells of a block of columns on their way through a step: passes, each of which ends a stage and begins the next.

A stage eliminates the cells from one face to the other, which leaves two balances in the temperatures of the faces;
with those known the cells follow on the way back. The first stage of a step eliminates outward and the second one
inward, so that the way back of either is the way of the next one's elimination.
"""

from numpy.typing import NDArray

from sensorsim.thermal.boundary import FloatArray
from sensorsim.thermal.lanes import (
    CELL,
    EXTERIOR,
    FIRST,
    HIGHEST,
    INTERIOR,
    LEFT,
    LOWEST,
    MARK,
    NOW,
    OLD,
    RIGHT,
    UNBOUNDED,
    WORK,
    Index,
    inner,
    wide,
)


@inner
def eliminate(
    lanes: Index, w: FloatArray, c: FloatArray, place: NDArray[Index], begun: FloatArray, outermost: float
) -> None:
    """Elimination outward of the cells as they are now, for faces at 0 C, and what they then send to the faces."""
    wide()
    for j in range(lanes):
        w[RIGHT + j] = 0.0
    for i in range(begun.shape[0] - 1, -1, -1):
        at, own, link, sent = place[i], begun[i, 0], begun[i, 1], begun[i, 2]
        for j in range(lanes):
            now = c[at + NOW + j]
            w[RIGHT + j] += sent * now
            c[at + WORK + j] = own * (now + link * c[at + CELL + WORK + j])
    for j in range(lanes):
        w[LEFT + j] = outermost * c[CELL + WORK + j]


@inner
def turn(
    lanes: Index, w: FloatArray, c: FloatArray, place: NDArray[Index], ended: FloatArray, begun: FloatArray,
    innermost: float, carry: float,
) -> None:  # fmt: skip
    """Cells after the first stage, from the exterior face inward, and the elimination of the second.

    The second stage goes on from what the first one changed, times `carry`.
    """
    wide()
    at = Index(0)
    for j in range(lanes):
        w[FIRST + j], w[LEFT + j] = w[EXTERIOR + j], 0.0
    for i in range(ended.shape[0]):
        at, own, link, sent, before, face = place[i], begun[i, 0], begun[i, 1], begun[i, 2], ended[i, 3], ended[i, 4]
        for j in range(lanes):
            now = c[at + NOW + j]
            first = c[at + WORK + j] + before * w[FIRST + j] + face * w[INTERIOR + j]
            star = now + carry * (first - now)
            w[FIRST + j], c[at + OLD + j] = first, now
            w[LEFT + j] += sent * star
            c[at + WORK + j] = own * (star + link * c[at - CELL + WORK + j])
    for j in range(lanes):
        w[RIGHT + j] = innermost * c[at + WORK + j]


@inner
def close(
    lanes: Index, w: FloatArray, c: FloatArray, place: NDArray[Index], ended: FloatArray, begun: FloatArray,
    outermost: float,
) -> None:  # fmt: skip
    """Cells after the second stage, from the interior face outward, their range, and the next step's elimination."""
    wide()
    inside = place[ended.shape[0]]
    for j in range(lanes):
        c[inside + NOW + j], w[RIGHT + j], w[LOWEST + j], w[HIGHEST + j] = w[INTERIOR + j], 0.0, UNBOUNDED, -UNBOUNDED
    for i in range(ended.shape[0] - 1, -1, -1):
        at, own, link, sent, before, face = place[i], begun[i, 0], begun[i, 1], begun[i, 2], ended[i, 3], ended[i, 4]
        for j in range(lanes):
            now = c[at + WORK + j] + before * c[at + CELL + NOW + j] + face * w[EXTERIOR + j]
            c[at + NOW + j] = now
            # Adding nothing keeps the compiler from masked stores, for which the next cell would have to wait.
            w[LOWEST + j], w[HIGHEST + j] = min(w[LOWEST + j], now) + 0.0, max(w[HIGHEST + j], now) + 0.0
            w[RIGHT + j] += sent * now
            c[at + WORK + j] = own * (now + link * c[at + CELL + WORK + j])
    for j in range(lanes):
        w[LEFT + j] = outermost * c[CELL + WORK + j]


@inner
def substitute(lanes: Index, w: FloatArray, c: FloatArray, place: NDArray[Index], ended: FloatArray) -> None:
    """Cells of marked lanes after an elimination outward, of others what was put away as old, and their range."""
    wide()
    for j in range(lanes):
        w[FIRST + j], w[LOWEST + j], w[HIGHEST + j] = w[EXTERIOR + j], UNBOUNDED, -UNBOUNDED
    for i in range(ended.shape[0]):
        at, before, face = place[i], ended[i, 3], ended[i, 4]
        for j in range(lanes):
            first = c[at + WORK + j] + before * w[FIRST + j] + face * w[INTERIOR + j]
            now = first if w[MARK + j] > 0.0 else c[at + OLD + j]
            w[FIRST + j], c[at + NOW + j] = first, now
            w[LOWEST + j], w[HIGHEST + j] = min(w[LOWEST + j], now) + 0.0, max(w[HIGHEST + j], now) + 0.0
