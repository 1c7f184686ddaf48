"""What a little more heat on the exterior face of a wall does to that face's temperature, now and later.

The march is linearised about a course of the face's temperature: both films and the long-wave exchange become one
slope for each face, which changes with time at the exterior. Steps are those of `kernel`, two-stage SDIRK
[Alexander1977] with inputs linear between samples, so that the answer lags as the march's own does.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.environment import saturation_vapour_pressure
from sensorsim.thermal.boundary import Inside, Outside, per_exterior_area
from sensorsim.thermal.grid import FloatArray, WallGrid

GAMMA = 1.0 - np.sqrt(0.5)
CARRY = (1.0 - GAMMA) / GAMMA  # weight of the first stage's change in the second stage's right side
INNER_DIFFERENCE = 3.0  # [K] between the interior face and its air, at which its free film is taken
LEAST_SLOPE = 1e-3  # [W m-2 K-1] in perfectly still air between black bodies of 0 K


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
    n = grid.capacity.size
    conductance = grid.conductance
    if n == 0:
        through = conductance[0] * inner / (conductance[0] + inner)
        return np.asarray(source[record] / (slope[record, None] + through))
    rate = grid.capacity / (GAMMA * step)
    pivot = np.zeros(n)
    drain = conductance[n] * inner / (conductance[n] + inner)
    for i in range(n - 1, 0, -1):  # from the inside out: only the outermost cell's own pivot changes with time
        pivot[i] = 1.0 / (rate[i] + conductance[i] + drain)
        drain = conductance[i] * (1.0 - conductance[i] * pivot[i])
    first = np.where(np.any(source != 0.0, axis=0), np.argmax(source != 0.0, axis=0), source.shape[0])
    order = np.argsort(first, kind="stable")
    plain = np.ascontiguousarray(source[:, order], dtype=np.float64)
    rise = np.zeros((record.size, source.shape[1]))
    slopes = np.ascontiguousarray(slope)
    rise[:, order] = _march(rate, conductance, pivot, drain, plain, first[order], slopes, record)
    return rise


@njit(cache=True, nogil=True, error_model="numpy")
def _march(
    rate: FloatArray, conductance: FloatArray, pivot: FloatArray, drain: float, source: FloatArray,
    first: NDArray[np.int64], slope: FloatArray, record: NDArray[np.int64],
) -> FloatArray:  # fmt: skip
    """All steps to the last sample of `record`, which ascends; starts without any rise.

    Sources ascend by the sample that each is first felt at: before that they are passed over.
    """
    n, shape = rate.size, (rate.size, source.shape[1])
    now, star, cells, face = np.zeros(shape), np.zeros(shape), np.zeros(shape), np.zeros(shape[1])
    rise, row = np.zeros((record.size, shape[1])), int(record[0] == 0)
    for k in range(record[-1]):
        m = np.searchsorted(first, k + 1, side="right")  # of the sources that have begun
        for stage in range(2):
            at = GAMMA if stage == 0 else 1.0
            loss = (1.0 - at) * slope[k] + at * slope[k + 1]
            for i in range(n):
                for j in range(m):
                    star[i, j] = now[i, j] if stage == 0 else now[i, j] + CARRY * (cells[i, j] - now[i, j])
                    star[i, j] *= rate[i]
            for i in range(n - 1, 0, -1):
                carried = conductance[i] * pivot[i]
                for j in range(m):
                    star[i - 1, j] += carried * star[i, j]
            share = conductance[0] / (conductance[0] + loss)  # of what the face takes up that goes into the wall
            outer = 1.0 / (rate[0] + drain + share * loss)
            for j in range(m):
                heat = (1.0 - at) * source[k, j] + at * source[k + 1, j]
                cells[0, j] = (star[0, j] + share * heat) * outer
                face[j] = (heat + conductance[0] * cells[0, j]) / (conductance[0] + loss)
            for i in range(1, n):
                for j in range(m):
                    cells[i, j] = (star[i, j] + conductance[i] * cells[i - 1, j]) * pivot[i]
        now[:, :m] = cells[:, :m]
        if record[row] == k + 1:
            rise[row] = face
            row += 1
    return rise
