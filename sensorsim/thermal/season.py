"""What time of the year a day is for its plants and its ground: whether deciduous trees are bare, whether snow lies."""

from dataclasses import dataclass

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY, ZERO_CELSIUS
from sensorsim.environment import Environment, saturation_vapour_pressure
from sensorsim.thermal.grid import FloatArray

HORIZON = -0.833  # [deg] elevation of the sun at sunrise: 34' of refraction, 16' of its radius [Seidelmann1992]
GREEN_INDEX = 0.5  # growing season index at and above which there are leaves [Jolly2005]
# Where growth stops and where nothing hinders it [Jolly2005 table 1].
COLDEST_NIGHT = (ZERO_CELSIUS - 2.0, ZERO_CELSIUS + 5.0)  # [K]
DAY_LENGTH = (10.0, 11.0)  # [h]
DEFICIT = (4100.0, 900.0)  # [Pa]


@dataclass(frozen=True, slots=True, kw_only=True)
class Season:
    """The state of a scene's nature, one for the whole image day."""

    leafless: bool
    snow: bool


def season_of(environment: Environment) -> Season:
    """Season by the weather of the lead-in and the image day; snow lies if it does for most of the image day."""
    state = environment.ground_state[environment.image_window]
    return Season(leafless=growing_season_index(environment) < GREEN_INDEX, snow=bool(np.mean(state == "snow") > 0.5))


def growing_season_index(environment: Environment) -> float:
    """Growing season index [-] of [Jolly2005]: 0 dormant, 1 in growth; the mean over the whole days at hand.

    Each day has the product of three indices, linear between two limits: of its coldest air, its length, and its mean
    vapour pressure deficit. [Jolly2005] takes three weeks; the days of the environment stand for them.
    """
    count = round(SECONDS_PER_DAY / environment.step)
    days = (environment.time.size - 1) // count

    def by_day(values: FloatArray) -> FloatArray:
        return np.asarray(values[-days * count :], dtype=np.float64).reshape(days, count)

    coldest = by_day(environment.air_temperature).min(axis=1)
    length = by_day(np.where(environment.sun_elevation > HORIZON, 1.0, 0.0)).mean(axis=1) * 24.0
    deficit = by_day(saturation_vapour_pressure(environment.air_temperature) - environment.vapour_pressure).mean(axis=1)
    daily = _share(coldest, COLDEST_NIGHT) * _share(length, DAY_LENGTH) * _share(deficit, DEFICIT)
    return float(daily.mean())


def _share(values: FloatArray, limits: tuple[float, float]) -> FloatArray:
    """0 at and beyond the first limit, 1 at and beyond the second."""
    none, full = limits
    return np.asarray(np.clip((values - none) / (full - none), 0.0, 1.0))
