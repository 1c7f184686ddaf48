"""From the solved histories of a wall type to what its tables keep: lobes of the sun, and the smooth rest.

How much a wall warms in the sun depends on where it faces: its film does, by wind and by the air that rises along it,
and so does what it has lost by it in the last hours. So the lobes have a gain, linear in the normal and with an edge
along the horizon, where the free film turns over. Of all gains that one is taken by which the rest is smoothest: what
is left has the splines of least energy, as in generalised least squares, over all reflectances and the hours around,
through which the sun's edge has moved from orientation to orientation. Where the sun does not show, as on snow that
melts, there is next to no gain.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from sensorsim.constants import SECONDS_PER_HOUR
from sensorsim.environment import Environment
from sensorsim.tables.coefficients import fit_polynomials
from sensorsim.tables.lobes import gain_terms, lobe_gain
from sensorsim.tables.orientations import FloatArray, IntArray, orientation_set
from sensorsim.tables.spline import roughness
from sensorsim.tables.straighten import UNBENT, Films, Terms, fit_loss, straighten, tilt_terms
from sensorsim.thermal.convection import wind_share, wind_towards

UNSURE = 0.01  # of a gain's energy that stands for a gain of 1
DARKER = 1e-3  # least absorptance
FAINT = 0.01  # [K2] energy of lobes so weak that their gain cannot be told
AROUND = 1.0 * SECONDS_PER_HOUR  # standard deviation of the times by which a gain is told


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FittedWall:
    """One wall type's share of the tables."""

    coefficients: FloatArray  # (t, o, p) above `level` [K]
    level: FloatArray  # (t,) [K]
    loss: FloatArray  # (t, 5) by which values are bent back, see `straighten`
    weight: FloatArray | None  # (t, k + 1, 2) of the lobes [K]
    gain: FloatArray | None  # (t, 5) of the lobes, see `lobe_gain`


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FitFrame:
    """What the fits of all wall types share, beside lobes."""

    orientations: str  # layout that was solved
    facing: FloatArray  # (t, k + 1, o) cosine to the lobes, 0 behind them
    air: FloatArray  # (t,) [K]
    terms: Terms  # of the films, (t, o) and (o,)
    nearby: FloatArray  # (t, t) weights of the slices around, which sum to one


class Powers(NamedTuple):
    """What is fitted to the histories of a wall type at each orientation."""

    reflectances: FloatArray  # (r,) that were solved
    degree: int
    knot: float  # at which the last of four or more powers begins, else 0


def fit_frame(environment: Environment, record: IntArray, orientations: str, facing: FloatArray) -> FitFrame:
    """Frame of fits at the samples `record` (t,), with cosines (t, k + 1, o) of a layout's normals to the lobes."""
    normal, towards = orientation_set(orientations).normal, wind_towards(environment.wind_direction[record])
    return FitFrame(
        orientations=orientations, facing=facing, air=environment.air_temperature[record],
        terms=(wind_share(normal, towards), *tilt_terms(normal)), nearby=nearby_slices(environment.time[record]),
    )  # fmt: skip


def nearby_slices(clock: FloatArray) -> FloatArray:
    """Weights (t, t) of slices at times (t,) [s] around each, by a bell curve over time; each row sums to one."""
    edge = np.concatenate([clock[:1], 0.5 * (clock[1:] + clock[:-1]), clock[-1:]])
    span = np.diff(edge) if clock.size > 1 else np.ones(1)
    weight = np.exp(-0.5 * ((clock[:, None] - clock) / AROUND) ** 2) * span
    return np.asarray(weight / weight.sum(axis=1, keepdims=True))


def fit_plain(temperature: FloatArray, powers: Powers) -> FittedWall:
    """Temperatures (t, o, r) [K] as polynomials, above the coldest of each time."""
    level = temperature.min(axis=(1, 2))
    above = temperature - level[:, None, None]
    return FittedWall(
        coefficients=fit_polynomials(above, powers.reflectances, powers.degree, knot=powers.knot), level=level,
        loss=np.tile(UNBENT, (level.size, 1)), weight=None, gain=None,
    )  # fmt: skip


def fit_lobes(temperature: FloatArray, rise: FloatArray, films: Films, frame: FitFrame, powers: Powers) -> FittedWall:
    """Lobes whose rises are (t, k + 1, r) [K], and what is left of temperatures (t, o, r) [K] without them.

    Both straightened: rises are what they are at the mean temperature of all orientations and reflectances.
    """
    reflectances, alike = powers.reflectances, (*temperature.shape[:2], 1)
    mean = np.broadcast_to(temperature.mean(axis=(1, 2), keepdims=True), alike)
    straight, loss = fit_loss(temperature, frame.air, reflectances, films, frame.terms)
    stretch = straighten(mean, frame.air, loss, frame.terms)[1].mean(axis=1, keepdims=True)
    weight = np.zeros((*rise.shape[:2], 2))
    linear = min(2, reflectances.size)
    weight[..., :linear] = fit_polynomials(stretch * rise, reflectances, linear - 1)
    sun = frame.facing.swapaxes(1, 2) @ weight @ np.vander(reflectances, 2, increasing=True).T
    gain = fit_gain(straight, sun, frame.orientations, reflectances, frame.nearby)
    rest = straight - sun * lobe_gain(gain, orientation_set(frame.orientations).normal)[..., None]
    coefficients = fit_polynomials(rest, reflectances, powers.degree, knot=powers.knot)
    return FittedWall(coefficients=coefficients, level=frame.air, loss=loss, weight=weight, gain=gain)


def fit_gain(
    straight: FloatArray, sun: FloatArray, orientations: str, reflectances: FloatArray, nearby: FloatArray
) -> FloatArray:
    """Gain (t, 5) of lobes `sun` (t, o, r) [K] that leaves the least energy in straightened (t, o, r) [K] less them.

    Over all reflectances, as the lobes go with the absorptance, and the slices around each, by weights (t, t).
    """
    share = np.maximum(1.0 - reflectances, DARKER)
    whole, part = straight @ (share / np.linalg.norm(share)), sun @ (share / np.linalg.norm(share))
    terms = part[..., None] * gain_terms(orientation_set(orientations).normal)
    energy = roughness(orientations) @ terms
    square, held = terms.swapaxes(1, 2) @ energy, (whole[:, None, :] @ energy)[:, 0]
    square, held = np.tensordot(nearby, square, axes=1), nearby @ held
    doubt = UNSURE * np.trace(square, axis1=1, axis2=2) / square.shape[1] + FAINT
    held[:, 0] += doubt
    return np.asarray(np.linalg.solve(square + doubt[:, None, None] * np.eye(held.shape[1]), held[..., None])[..., 0])
