"""A variable in which a wall's temperature answers the sun in proportion.

What a face absorbs it loses by radiation, by the films of its air and into the wall. The wall is linear, the rest is
known: of a face y kelvin above the air, at A kelvin,

    v = y (a + r (4 A^3 + 6 A^2 y + 4 A y^2 + y^3) + ((l + d w)^3 + f c |y|)^(1/3))   [K]

is all but linear in what it absorbs: a mean of y, which a wall alone would answer with, and of what the face loses. r
is its radiation, l and d w its forced film, by the share w that it faces the wind, f c its free one, by the tilt and by
whether it is warmer or colder than the air. So the edges of the films along the horizon, where the free one turns over,
and at the temperature of the air are taken out before anything is interpolated, lobes add up, and fewer powers of the
reflectance do. How much of it is the loss, the share 1 - a, is what leaves the least curvature in the reflectance.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.materials import WallType
from sensorsim.tables.coefficients import least_squares
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.thermal.boundary import Outside
from sensorsim.thermal.convection import free_film_cubed, wind_share

WEAK = 0.3  # [K] curvature of the loss in reflectance below which too little sun tells how much of it there is
NEWTON_STEPS = 5  # from v, whose slope is about 1
LEAST = 1e-30  # [-] of the cube of a film, so that there is a slope where air stands still at its own temperature
COLUMNS = 5  # of a loss: a, r [K-3], l, d, f [K-1]
UNBENT = np.array([1.0, 0.0, 0.0, 0.0, 0.0])  # v = y
_VERTICAL = float(free_film_cubed(np.array([[1.0, 0.0, 0.0]]))[0])

Terms = tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]  # w, c of a warmer, of a colder face


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Films:
    """Films of a wall type's exterior face at the slices."""

    emissivity: float
    leeward: FloatArray  # (t,) forced [W m-2 K-1]
    windward: FloatArray  # (t,) what a face into the wind has more [W m-2 K-1]
    free: float  # film cubed per kelvin of a vertical face [W3 m-6 K-4]


def films_of(outside: Outside, record: IntArray, normal: FloatArray, towards: FloatArray) -> Films:
    """Films of orientations (o, 3) at the samples `record` (t,), wind from directions (t, 2).

    As two forced ones, by least squares where rain adds its own.
    """
    film, share = outside.film[record], wind_share(normal, towards)
    apart = share - share.mean(axis=1, keepdims=True)
    windward = np.sum(apart * film, axis=1) / np.maximum(np.sum(apart**2, axis=1), LEAST)
    return Films(
        emissivity=outside.emissivity,
        leeward=film.mean(axis=1) - windward * share.mean(axis=1),
        windward=windward,
        free=float(np.sum(outside.free) / np.sum(free_film_cubed(normal))) * _VERTICAL,
    )


def mix_films(wall: WallType, films: Sequence[Films]) -> Films:
    """Films of a mixed wall type from those of its components, by area."""
    share = [part.share for part in wall.parts]
    return Films(
        emissivity=float(np.average([film.emissivity for film in films], weights=share)),
        leeward=np.average([film.leeward for film in films], axis=0, weights=share),
        windward=np.average([film.windward for film in films], axis=0, weights=share),
        free=float(np.average([film.free for film in films], weights=share)),
    )


def tilt_terms(normal: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Cube of the free film (m,) of warmer and of colder faces (m, 3) over that of a vertical one [-]."""
    warmer, colder = (free_film_cubed(normal, warmer=warm) / _VERTICAL for warm in (True, False))
    return warmer, colder


def fit_loss(
    temperature: FloatArray, level: FloatArray, reflectances: FloatArray, films: Films, terms: Terms
) -> tuple[FloatArray, FloatArray]:
    """Straightened (t, o, r) [K] of temperatures (t, o, r) [K] at reflectances (r,), and the loss (t, COLUMNS) of that.

    Above the air's temperature `level` (t,) [K]. Least squares of the second-order term in reflectance; without three
    reflectances nothing is bent.
    """
    above, loss = temperature - level[:, None, None], np.tile(UNBENT, (level.size, 1))
    if reflectances.size < 3:
        return above, loss
    loss[:, 0], loss[:, 4] = 0.0, films.free
    loss[:, 1] = films.emissivity * STEFAN_BOLTZMANN_CONSTANT
    loss[:, 2], loss[:, 3] = films.leeward, films.windward
    lost, slope = straighten(temperature, level, loss, terms)
    scale = slope.mean(axis=(1, 2))
    lost /= scale[:, None, None]
    lost -= above
    second = least_squares(tuple(reflectances.tolist()), 2)[2]
    own, more = above @ second, lost @ second
    share = -np.sum(own * more, axis=1) / (np.sum(more**2, axis=1) + WEAK**2 * own.shape[1])
    share = np.clip(share, 0.0, 1.0)
    loss[:, :4] *= (share / scale)[:, None]
    loss[:, 4] *= (share / scale) ** 3
    loss[:, 0] = 1.0 - share
    return above + share[:, None, None] * lost, loss


def straighten(
    temperature: FloatArray, level: FloatArray, loss: FloatArray, terms: Terms
) -> tuple[FloatArray, FloatArray]:
    """Straightened values (t, o, r) [K] of temperatures (t, o, r) [K] and their slopes (t, o, r) [-]."""
    own, radiation, leeward, windward, free = loss.T
    share, warmer, colder = terms
    forced = (leeward[:, None] + share * windward[:, None]) ** 3 + LEAST
    above = temperature - level[:, None, None]
    value, slope = np.zeros(above.shape), np.zeros(above.shape)
    _straighten(above, _powers(own, radiation, level), forced, free, warmer, colder, value, slope)
    return value, slope


def bend_back(value: FloatArray, level: FloatArray, loss: FloatArray, terms: Terms) -> FloatArray:
    """Temperatures (m,) [K] of straightened values (m,) [K] of faces above levels (m,), with losses (m, COLUMNS)."""
    own, radiation, leeward, windward, free = loss.T
    share, warmer, colder = terms
    forced, above = (leeward + share * windward) ** 3 + LEAST, np.zeros(value.shape)
    _bend_back(value, _powers(own, radiation, level), forced, free * warmer, free * colder, above)
    return np.asarray(level + above)


def _powers(own: FloatArray, radiation: FloatArray, level: FloatArray) -> FloatArray:
    """What a face loses per kelvin without its films, by powers (m, 4) of its temperature above the air's."""
    return np.stack(
        [own + 4.0 * radiation * level**3, 6.0 * radiation * level**2, 4.0 * radiation * level, radiation], 1
    )


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _lost(above: float, powers: FloatArray, forced: float, free: float) -> tuple[float, float]:
    """Value and slope of one face, its forced film cubed, its free one per kelvin."""
    rising = free * abs(above)
    film = np.cbrt(forced + rising)
    per_kelvin = powers[0] + above * (powers[1] + above * (powers[2] + above * powers[3])) + film
    steeper = above * (powers[1] + above * (2.0 * powers[2] + 3.0 * above * powers[3]))
    return above * per_kelvin, per_kelvin + steeper + rising / (3.0 * film * film)


@njit(cache=True, nogil=True, error_model="numpy")
def _straighten(
    above: FloatArray, powers: FloatArray, forced: FloatArray, free: FloatArray, warmer: FloatArray,
    colder: FloatArray, value: FloatArray, slope: FloatArray,
) -> None:  # fmt: skip
    """Faces (t, o, r), of powers (t, 4), forced films (t, o) and free ones by time (t,) and tilt (o,)."""
    for t in range(above.shape[0]):
        for o in range(above.shape[1]):
            rising, falling = free[t] * warmer[o], free[t] * colder[o]
            for r in range(above.shape[2]):
                y = above[t, o, r]
                value[t, o, r], slope[t, o, r] = _lost(y, powers[t], forced[t, o], rising if y >= 0.0 else falling)


@njit(cache=True, nogil=True, error_model="numpy")
def _bend_back(
    value: FloatArray, powers: FloatArray, forced: FloatArray, warmer: FloatArray, colder: FloatArray, above: FloatArray
) -> None:
    """Newton's steps of faces (m,)."""
    for m in range(value.size):
        y = value[m]
        for _ in range(NEWTON_STEPS):
            straight, slope = _lost(y, powers[m], forced[m], warmer[m] if y >= 0.0 else colder[m])
            y -= (straight - value[m]) / slope
        above[m] = y
