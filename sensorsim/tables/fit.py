"""From the solved histories of a wall type to what its tables keep: lobes of the sun, and the smooth rest."""

from dataclasses import dataclass

import numpy as np

from sensorsim.tables.coefficients import fit_polynomials
from sensorsim.tables.lobes import LobeSources
from sensorsim.tables.orientations import FloatArray
from sensorsim.tables.straighten import fit_bend, straighten


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FittedWall:
    """One wall type's share of the tables."""

    coefficients: FloatArray  # (t, o, p) above `level` [K]
    level: FloatArray  # (t,) [K]
    bend: FloatArray  # (t,) [K-1]
    weight: FloatArray | None  # (t, k + 1, 2) of the lobes [K]


def fit_plain(temperature: FloatArray, reflectances: FloatArray, degree: int) -> FittedWall:
    """Temperatures (t, o, r) [K] at reflectances (r,) as polynomials, above the coldest of each time."""
    level = temperature.min(axis=(1, 2))
    above = temperature - level[:, None, None]
    return FittedWall(
        coefficients=fit_polynomials(above, reflectances, degree), level=level, bend=np.zeros_like(level), weight=None
    )


def fit_lobes(
    temperature: FloatArray, rise: FloatArray, sources: LobeSources, normal: FloatArray, reflectances: FloatArray,
    degree: int,
) -> FittedWall:  # fmt: skip
    """Lobes whose rises are (t, k + 1, r) [K], and what is left of temperatures (t, o, r) [K] without them.

    Both straightened: rises are what they are at the mean temperature of all orientations and reflectances.
    """
    level, bend = fit_bend(temperature, reflectances)
    stretch = 1.0 + 2.0 * bend * (temperature.mean(axis=(1, 2)) - level)
    weight = np.zeros((*rise.shape[:2], 2))
    powers = min(2, reflectances.size)
    weight[..., :powers] = fit_polynomials(stretch[:, None, None] * rise, reflectances, powers - 1)
    facing = np.maximum(np.concatenate([sources.sun[:, None], _repeat(sources)], axis=1) @ normal.T, 0.0)
    lobes = facing.swapaxes(1, 2) @ weight
    straight = straighten(temperature, level[:, None, None], bend[:, None, None])
    rest = straight - lobes @ np.vander(reflectances, 2, increasing=True).T
    return FittedWall(coefficients=fit_polynomials(rest, reflectances, degree), level=level, bend=bend, weight=weight)


def _repeat(sources: LobeSources) -> FloatArray:
    """Directions (t, k, 3) of the lobes that stand still."""
    return np.broadcast_to(sources.direction, (sources.clock.size, *sources.direction.shape))
