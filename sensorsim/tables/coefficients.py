"""The coefficient matrix: polynomials in solar reflectance, per time, wall type and standard orientation.

Section 3.6.1 of [Report1978] calls it four coefficients of a fourth-degree polynomial; a quartic has five, and five
reflectances determine it. The fit is least squares, so it may also have fewer powers than samples.
"""

from dataclasses import dataclass, replace
from datetime import date
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.errors import InputError
from sensorsim.materials import WallType
from sensorsim.tables.lobes import Lobes
from sensorsim.tables.orientations import FloatArray, OrientationSet, orientation_set
from sensorsim.tables.settings import BakeSettings
from sensorsim.tables.spline import dense_layout, spline_matrix
from sensorsim.thermal.lead_in import LeadIn

# Products of a matrix product that OpenBLAS leaves to the thread that asks. From twice as many on it shares the work
# with threads that then wait for more for many milliseconds, at full load, on processors that a frame needs.
ALONE = 2**17
UNKNOTTED = 3  # powers that are those of the reflectance itself


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Moment:
    """The tables of one moment, at the orientations that are looked up."""

    coefficients: FloatArray  # (w, o, p) of the powers of reflectance [K] above `level`
    level: FloatArray  # (w,) that they are above [K]; 0 without lobes
    loss: FloatArray  # (w, 5) by which values are bent back, see `straighten`
    towards: FloatArray  # (2,) where the wind comes from, east and north
    knot: float  # reflectance at which the last of four or more powers begins
    direction: FloatArray  # (l, 3) of the lobes
    weight: FloatArray  # (w, l, 2) of the lobes, powers 0 and 1 of the reflectance [K]
    gain: FloatArray  # (w, 5) of the lobes by where a surface faces, see `lobe_gain`


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ShadeTables:
    """All that the renderer needs to know of the thermal past."""

    day: date
    time_of_day: FloatArray  # (t,) of the slices, local standard time [s]
    wall_types: tuple[WallType, ...]
    orientations: OrientationSet  # that are looked up: the solved ones, or the dense ones that a spline leads to
    coefficients: NDArray[np.floating[Any]]  # (t, w, o, p) of the powers of reflectance, solved, above `level` [K]
    level: FloatArray  # (t, w) [K]: of the air, without lobes of the coldest
    loss: FloatArray  # (t, w, 5) by which values are bent back, see `straighten`
    towards: FloatArray  # (t, 2) where the wind comes from, east and north
    lobes: Lobes | None  # of the sun; None: the coefficients hold it too
    ground_temperature: FloatArray  # (t,) of the ground plane [K]
    settings: BakeSettings
    lead_in: tuple[LeadIn, ...]  # of the wall types

    def at(self, time_of_day: float) -> Moment:
        """The tables at a time [s]: straight between slices, the sun of the moment where it stands."""
        index, share = self.slice_of(time_of_day)
        coefficients = self._between(self.coefficients, index, share)
        level, loss = self._between(self.level, index, share), self._between(self.loss, index, share)
        if self.lobes is None:
            coefficients[..., 0] += level[:, None]
            level, loss = np.zeros_like(level), np.zeros_like(loss)
            loss[:, 0] = 1.0
        direction, weight, gain = np.zeros((0, 3)), np.zeros((level.size, 0, 2)), np.zeros((level.size, 5))
        if self.lobes is not None:
            direction, weight = self.lobes.at(index, share)
            gain = self.lobes.gain_at(index, share)
        return Moment(
            coefficients=self._spread(coefficients), level=level, loss=loss, direction=direction, weight=weight,
            gain=gain, towards=self._between(self.towards, index, share), knot=self.settings.knot,
        )  # fmt: skip

    def _spread(self, coefficients: FloatArray) -> FloatArray:
        """From the solved orientations to those that are looked up."""
        if self.settings.interpolation != "spline" or coefficients.shape[1] == self.orientations.normal.shape[0]:
            return coefficients  # tables that were not baked have no more orientations than are looked up
        walls, count, powers = coefficients.shape
        flat = coefficients.transpose(1, 0, 2).reshape(count, walls * powers)  # one product instead of one a wall
        matrix = spline_matrix(self.settings.orientations, self.orientations.name)
        rows = max(1, ALONE // flat.size)
        dense = np.concatenate([matrix[first : first + rows] @ flat for first in range(0, len(matrix), rows)])
        return np.asarray(dense.reshape(-1, walls, powers).transpose(1, 0, 2))

    @staticmethod
    def _between(values: NDArray[np.floating[Any]], index: int, share: float) -> FloatArray:
        first, second = values[index].astype(np.float64), values[index + 1].astype(np.float64)
        return np.asarray(first + share * (second - first))

    def slice_of(self, time_of_day: float) -> tuple[int, float]:
        """Index of the slice before a time [s] and the share of the next one [-]."""
        if not 0.0 <= time_of_day <= SECONDS_PER_DAY:
            raise InputError(
                f"tables of {self.day}", "time", time_of_day, "outside of the day", "use 0 to 86400 s after midnight"
            )
        index = int(
            np.clip(np.searchsorted(self.time_of_day, time_of_day, side="right") - 1, 0, self.time_of_day.size - 2)
        )
        span = self.time_of_day[index + 1] - self.time_of_day[index]
        return index, float((time_of_day - self.time_of_day[index]) / span)


def lookup_orientations(settings: BakeSettings) -> OrientationSet:
    """The orientations that coefficients are looked up at, by the settings' interpolation."""
    if settings.interpolation == "spline":
        return orientation_set(dense_layout(settings.orientations))
    return replace(orientation_set(settings.orientations), scheme=settings.interpolation)


def reflectance_powers(reflectance: FloatArray, count: int, knot: float) -> FloatArray:
    """Powers (m, count) of reflectances (m,), lowest first; of four or more the last one begins at the knot.

    A light face may pass the temperature of its air, and then its free film turns over: what a cubic misses lies there.
    """
    powers = np.asarray(np.vander(reflectance, count, increasing=True), dtype=np.float64)
    if count > UNKNOTTED:
        powers[:, -1] = np.maximum(reflectance - knot, 0.0) ** (count - 1)
    return powers


def fit_polynomials(temperature: FloatArray, reflectances: FloatArray, degree: int, *, knot: float = 0.0) -> FloatArray:
    """Coefficients (..., degree + 1) [K] of temperatures (..., r) [K] at reflectances (r,), by least squares."""
    return np.asarray(temperature @ least_squares(tuple(reflectances.tolist()), degree, knot).T)


@lru_cache(maxsize=64)
def least_squares(reflectances: tuple[float, ...], degree: int, knot: float = 0.0) -> FloatArray:
    """From values at reflectances (r,) to the coefficients of the closest polynomial (degree + 1, r)."""
    return np.asarray(np.linalg.pinv(reflectance_powers(np.asarray(reflectances), degree + 1, knot)))
