"""The coefficient matrix: polynomials in solar reflectance, per time, wall type and standard orientation.

Section 3.6.1 of [Report1978] calls it four coefficients of a fourth-degree polynomial; a quartic has five, and five
reflectances determine it. The fit is least squares, so it may also have fewer powers than samples.
"""

from dataclasses import dataclass
from datetime import date

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.errors import InputError
from sensorsim.materials import WallType
from sensorsim.tables.orientations import FloatArray, OrientationSet
from sensorsim.tables.settings import BakeSettings
from sensorsim.thermal.lead_in import LeadIn


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ShadeTables:
    """All that the renderer needs to know of the thermal past."""

    day: date
    time_of_day: FloatArray  # (t,) of the slices, local standard time [s]
    wall_types: tuple[WallType, ...]
    orientations: OrientationSet
    coefficients: NDArray[np.float32]  # (t, w, o, p) of the powers of reflectance [K]
    ground_temperature: FloatArray  # (t,) of the ground plane [K]
    settings: BakeSettings
    lead_in: tuple[LeadIn, ...]  # of the wall types

    def at(self, time_of_day: float) -> FloatArray:
        """Coefficients (w, o, p) [K] at a time [s], linear between slices."""
        index, share = self.slice_of(time_of_day)
        first, second = self.coefficients[index].astype(np.float64), self.coefficients[index + 1].astype(np.float64)
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


def fit_polynomials(temperature: FloatArray, reflectances: FloatArray, degree: int) -> FloatArray:
    """Coefficients (..., degree + 1) [K] of temperatures (..., r) [K] at reflectances (r,), by least squares."""
    powers = np.vander(reflectances, degree + 1, increasing=True)
    return np.asarray(temperature @ np.linalg.pinv(powers).T)
