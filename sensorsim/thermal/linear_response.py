"""What a little more heat on the exterior face of a wall does to that face's temperature, now and later.

The march is linearised about a course of the face's temperature: both films and the long-wave exchange become one
slope for each face, which changes with time at the exterior. Steps are those of `kernel`, two-stage SDIRK
[Alexander1977] with inputs linear between samples, so that the answer lags as the march's own does; so are the cells'
passes and the lanes, one for each source of heat (see `passes` and `lanes`), but the room is as it was: only one face
is left to be solved, and its balance is linear.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.environment import saturation_vapour_pressure
from sensorsim.thermal.boundary import Cells, Inside, Outside, per_exterior_area
from sensorsim.thermal.conduction import factor
from sensorsim.thermal.damping import CARRY, GAMMA
from sensorsim.thermal.grid import FloatArray, WallGrid
from sensorsim.thermal.lanes import LANES, ROW, Index, inner, outer, room_for, wide

INNER_DIFFERENCE = 3.0  # [K] between the interior face and its air, at which its free film is taken
LEAST_SLOPE = 1e-3  # [W m-2 K-1] in perfectly still air between black bodies of 0 K
# The face, what the cells send to it, the cell before; heat at the step's two samples.
FACE, LEFT, BEFORE, EARLY, LATE, ALL = ROW[0:6]
NOW, WORK, CELL = ROW[0:3]
FADED = 1e-30  # [K], [W m-2] as good as nothing, long before numbers get so small that processors are slow with them
FADING = 16  # steps after which what has faded is forgotten


def exterior_slope(outside: Outside, temperature: FloatArray) -> FloatArray:
    """Heat (t, o) that an exterior face loses per kelvin of its own [W m-2 K-1] about temperatures (t, o) [K]."""
    difference = np.abs(temperature - outside.air[:, None])
    colder = outside.free_colder if outside.free_colder.size else outside.free
    free = difference * np.where(temperature >= outside.air[:, None], outside.free, colder)
    film = np.maximum(np.cbrt(outside.film**3 + free), LEAST_SLOPE)
    slope = film + free / (3.0 * film**2)
    slope += 4.0 * outside.emissivity * STEFAN_BOLTZMANN_CONSTANT * temperature**3
    if outside.latent.shape[0] > 1:
        rise = saturation_vapour_pressure(temperature + 0.5) - saturation_vapour_pressure(temperature - 0.5)
        slope += outside.latent * rise
    return np.asarray(slope)


def interior_slope(inside: Inside, area: float) -> float:
    """Heat that the interior face loses per kelvin of its own, on average, per exterior area [W m-2 K-1]."""
    plain = per_exterior_area(inside, area)
    film = np.maximum(np.cbrt(plain.film**3 + plain.free * INNER_DIFFERENCE), LEAST_SLOPE)
    slope = film + plain.free * INNER_DIFFERENCE / (3.0 * film**2)
    return float(np.mean(slope + 4.0 * plain.emissivity * STEFAN_BOLTZMANN_CONSTANT * plain.radiant**3))


def linear_response(
    grid: WallGrid, source: FloatArray, slope: FloatArray, inner: float, *, step: float, record: NDArray[np.int64]
) -> FloatArray:
    """Rise (r, m) [K] of the exterior face at the samples `record` (r,) by heat (t, m) [W m-2] that it takes up.

    slope: of the exterior face (t,), inner: of the interior face [W m-2 K-1]; samples are `step` [s] apart.
    """
    conductance = grid.conductance.copy()
    conductance[-1] *= inner / max(conductance[-1] + inner, 1e-300)  # both are 0 at the centre of a solid
    if grid.capacity.size == 0:
        return np.asarray(source[record] / (slope[record, None] + conductance[0]))
    cells = factor(replace(grid, conductance=conductance), GAMMA * step, step)
    place = np.arange(1, grid.capacity.size + 2, dtype=Index) * CELL  # before and beyond them an idle cell
    w, c = room_for(int(ALL)), room_for((place.size + 1) * int(CELL))
    rise = np.zeros((record.size, source.shape[1]))
    plain, slopes = np.ascontiguousarray(source, dtype=np.float64), np.ascontiguousarray(slope)
    _march(Index(LANES), w, c, place, cells, plain, slopes, record, rise)
    return rise


@outer
def _march(
    lanes: Index, w: FloatArray, c: FloatArray, place: NDArray[Index], cells: Cells, source: FloatArray,
    slope: FloatArray, record: NDArray[np.int64], rise: FloatArray,
) -> None:  # fmt: skip
    """All steps to the last sample of `record`, which ascends, from no rise at all, block by block of sources.

    Blocks are passed over until the first of their sources begins.
    """
    outward, inward, through, late_through = cells.outward, cells.inward, cells.exchange[0], cells.exchange[1]
    for begin in range(0, source.shape[1], LANES):
        count, row = min(lanes, Index(source.shape[1] - begin)), 0
        first = _beginning(count, source, begin)
        w[:], c[:] = 0.0, 0.0
        while row < record.size and record[row] <= first:
            row += 1
        _take(count, w, source[first], begin)
        for k in range(first, record[-1]):
            _take(count, w, source[k + 1], begin)
            middle = (1.0 - GAMMA) * slope[k] + GAMMA * slope[k + 1]
            _face(lanes, w, 1.0 / (middle + through[0]), GAMMA)
            _turn(lanes, w, c, place, outward, inward)
            _face(lanes, w, 1.0 / (slope[k + 1] + late_through[0]), 1.0)
            _close(lanes, w, c, place, inward, outward, through[4])
            if k % FADING == 0:
                _fade(w)
                _fade(c)
            if record[row] == k + 1:
                for j in range(count):
                    rise[row, begin + j] = w[FACE + j]
                row += 1


@inner
def _beginning(count: Index, source: FloatArray, begin: int) -> int:
    """Sample before the one at which the first of a block's sources is felt."""
    for k in range(source.shape[0]):
        for j in range(count):
            if source[k, begin + j] != 0.0:
                return max(k - 1, 0)
    return int(source.shape[0])


@inner
def _fade(values: FloatArray) -> None:
    """Nothing for what is as good as nothing."""
    for j in range(values.size):
        values[j] = values[j] if abs(values[j]) > FADED else 0.0


@inner
def _take(count: Index, w: FloatArray, source: FloatArray, begin: int) -> None:
    """The heat at a step's second sample is that at the next one's first."""
    for j in range(count):
        w[EARLY + j], w[LATE + j] = w[LATE + j], source[begin + j]


@inner
def _face(lanes: Index, w: FloatArray, per_loss: float, at: float) -> None:
    """Solve the face at a fraction `at` of the step."""
    wide()
    for j in range(lanes):
        w[FACE + j] = ((1.0 - at) * w[EARLY + j] + at * w[LATE + j] + w[LEFT + j]) * per_loss


@inner
def _turn(
    lanes: Index, w: FloatArray, c: FloatArray, place: NDArray[Index], ended: FloatArray, begun: FloatArray
) -> None:
    """Cells after the first stage, from the face inward, and the elimination of the second."""
    wide()
    for j in range(lanes):
        w[BEFORE + j], w[LEFT + j] = w[FACE + j], 0.0
    for i in range(ended.shape[0]):
        at, own, link, sent, before = place[i], begun[i, 0], begun[i, 1], begun[i, 2], ended[i, 3]
        for j in range(lanes):
            now, first = c[at + NOW + j], c[at + WORK + j] + before * w[BEFORE + j]
            star = now + CARRY * (first - now)
            w[BEFORE + j] = first
            w[LEFT + j] += sent * star
            c[at + WORK + j] = own * (star + link * c[at - CELL + WORK + j])


@inner
def _close(
    lanes: Index, w: FloatArray, c: FloatArray, place: NDArray[Index], ended: FloatArray, begun: FloatArray,
    outermost: float,
) -> None:  # fmt: skip
    """Cells after the second stage, from the inside outward, and the next step's elimination."""
    wide()
    for i in range(ended.shape[0] - 1, -1, -1):
        at, own, link, before, face = place[i], begun[i, 0], begun[i, 1], ended[i, 3], ended[i, 4]
        for j in range(lanes):
            now = c[at + WORK + j] + before * c[at + CELL + NOW + j] + face * w[FACE + j]
            c[at + NOW + j] = now
            c[at + WORK + j] = own * (now + link * c[at + CELL + WORK + j])
    for j in range(lanes):
        w[LEFT + j] = outermost * c[CELL + WORK + j]
