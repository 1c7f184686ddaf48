"""From the solved histories of a wall type to what its tables keep: lobes of the sun, and the smooth rest.

How much a wall warms in the sun depends on where it faces: its film does, by wind and by the air that rises along it.
So the lobes have a gain, linear in the normal and with an edge along the horizon, where the free film turns over. Of
all gains that one is taken by which the rest is smoothest: at the darkest reflectance what is left has the spline of
least energy, as in generalised least squares. Where the sun does not show, as on snow that melts, there is next to no
gain.
"""

from dataclasses import dataclass

import numpy as np

from sensorsim.tables.coefficients import fit_polynomials
from sensorsim.tables.lobes import gain_terms, lobe_gain
from sensorsim.tables.orientations import FloatArray, orientation_set
from sensorsim.tables.spline import roughness
from sensorsim.tables.straighten import fit_bend, straighten

UNSURE = 0.01  # of a gain's energy that stands for a gain of 1
FAINT = 0.01  # [K2] energy of lobes so weak that their gain cannot be told


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FittedWall:
    """One wall type's share of the tables."""

    coefficients: FloatArray  # (t, o, p) above `level` [K]
    level: FloatArray  # (t,) [K]
    bend: FloatArray  # (t,) [K-1]
    weight: FloatArray | None  # (t, k + 1, 2) of the lobes [K]
    gain: FloatArray | None  # (t, 5) of the lobes, see `lobe_gain`


def fit_plain(temperature: FloatArray, reflectances: FloatArray, degree: int) -> FittedWall:
    """Temperatures (t, o, r) [K] at reflectances (r,) as polynomials, above the coldest of each time."""
    level = temperature.min(axis=(1, 2))
    above = temperature - level[:, None, None]
    return FittedWall(
        coefficients=fit_polynomials(above, reflectances, degree), level=level, bend=np.zeros_like(level), weight=None,
        gain=None,
    )  # fmt: skip


def fit_lobes(
    temperature: FloatArray, rise: FloatArray, facing: FloatArray, orientations: str, reflectances: FloatArray,
    degree: int,
) -> FittedWall:  # fmt: skip
    """Lobes whose rises are (t, k + 1, r) [K], and what is left of temperatures (t, o, r) [K] without them.

    Both straightened: rises are what they are at the mean temperature of all orientations and reflectances. `facing`
    (t, k + 1, o) is the cosine to the lobes, or 0 behind them, at the layout named `orientations`.
    """
    level, bend = fit_bend(temperature, reflectances)
    stretch = 1.0 + 2.0 * bend * (temperature.mean(axis=(1, 2)) - level)
    weight = np.zeros((*rise.shape[:2], 2))
    powers = min(2, reflectances.size)
    weight[..., :powers] = fit_polynomials(stretch[:, None, None] * rise, reflectances, powers - 1)
    sun = facing.swapaxes(1, 2) @ weight @ np.vander(reflectances, 2, increasing=True).T
    straight = straighten(temperature, level[:, None, None], bend[:, None, None])
    gain = fit_gain(straight, sun, orientations, reflectances)
    rest = straight - sun * lobe_gain(gain, orientation_set(orientations).normal)[..., None]
    return FittedWall(
        coefficients=fit_polynomials(rest, reflectances, degree), level=level, bend=bend, weight=weight, gain=gain
    )


def fit_gain(straight: FloatArray, sun: FloatArray, orientations: str, reflectances: FloatArray) -> FloatArray:
    """Gain (t, 5) of lobes `sun` (t, o, r) [K] that leaves the least energy in straightened (t, o, r) [K] less them."""
    darkest = int(np.argmin(reflectances))
    whole, part = straight[..., darkest], sun[..., darkest]
    terms = part[..., None] * gain_terms(orientation_set(orientations).normal)
    energy = roughness(orientations) @ terms
    square = terms.swapaxes(1, 2) @ energy
    doubt = UNSURE * np.trace(square, axis1=1, axis2=2) / square.shape[1] + FAINT
    held = (whole[:, None, :] @ energy)[:, 0]
    held[:, 0] += doubt
    return np.asarray(np.linalg.solve(square + doubt[:, None, None] * np.eye(held.shape[1]), held[..., None])[..., 0])
