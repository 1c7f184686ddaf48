"""A glossy surface as facets that mirror, with slopes of a Gaussian distribution: what it keeps of energy, tabulated.

Of light from i to o, a facet along h between both mirrors F(i.h), and the surface

    f(i, o) = F(i.h) D(h) g(i) g(o) / (4 cos i cos o),     D(h) = exp(-slope^2 / m) / (pi m cos^4 h)

[CookTorrance1982], m the variance of slopes [BeckmannSpizzichino1963]. g, the share of facets neither hidden nor in
shadow, is chosen so that facets that mirror everything send back all light: for each i the integral of f cos o over o
is 1 with F = 1. So nothing is lost between facets however rough the surface, and f(i, o) = f(o, i).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import NumericsError

FloatArray = NDArray[np.float64]

ANGLE_ENTRIES = 129  # equally spaced in the cosine of the angle from the normal, 0 to 1
_RINGS, _SECTORS = 96, 48  # of slopes
_ROUNDS, _CLOSED = 400, 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Facets:
    """Tables over cosines from 0 to 1."""

    seen: FloatArray  # (ANGLE_ENTRIES,) g [-]
    weight: FloatArray  # (ANGLE_ENTRIES, ANGLE_ENTRIES) share of facets at each angle of incidence; rows sum to 1

    def mean(self, rise: FloatArray) -> FloatArray:
        """Rise of the whole surface's reflectance (ANGLE_ENTRIES,) from that of its facets."""
        return np.asarray(self.weight @ rise)


def lobe_variance(spread: float) -> float:
    """Variance of slopes [-] whose lobe around the mirror direction has that half width at half its height [deg]."""
    return float(np.tan(np.radians(0.5 * spread)) ** 2 / np.log(2.0))


def lobe_spread(variance: float) -> float:
    """The half width [deg] of a variance of slopes [-]."""
    return float(np.degrees(2.0 * np.arctan(np.sqrt(variance * np.log(2.0)))))


@lru_cache(maxsize=64)
def facets(variance: float) -> Facets:
    """Facets of a variance of slopes [-]; a flat face for 0."""
    if variance == 0.0:
        return Facets(seen=np.ones(ANGLE_ENTRIES), weight=np.eye(ANGLE_ENTRIES))
    cosine = np.linspace(0.0, 1.0, ANGLE_ENTRIES)
    projected, incidence, leaving = _mirrored(cosine, variance)
    kernel = _spread_over(leaving, projected)
    per_cosine = np.ones(ANGLE_ENTRIES)  # g over the cosine
    for _ in range(_ROUNDS):
        excess = per_cosine * (kernel @ (per_cosine * cosine))
        if np.abs(excess - 1.0).max() < _CLOSED:
            break
        per_cosine = per_cosine / np.sqrt(excess)
    else:
        raise NumericsError(f"facets of slope variance {variance:g}: energy not closed")
    share = per_cosine[:, None, None] * projected * np.interp(leaving, cosine, per_cosine * cosine)
    return Facets(seen=per_cosine * cosine, weight=_spread_over(incidence, share))


def _mirrored(cosine: FloatArray, variance: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Of facets (entries, rings, sectors): share of the light, cosine of incidence, cosine of the light that leaves."""
    steepness = np.sqrt(-variance * np.log1p(-(np.arange(_RINGS) + 0.5) / _RINGS))[:, None]
    around = np.pi * (np.arange(_SECTORS) + 0.5) / _SECTORS
    upright = 1.0 / np.sqrt(1.0 + steepness**2)
    tilt = steepness * np.cos(around)
    projected = cosine[:, None, None] + np.sqrt(1.0 - cosine**2)[:, None, None] * tilt
    incidence = projected * upright
    leaving = 2.0 * incidence * upright - cosine[:, None, None]
    lit = (projected > 0.0) & (leaving > 0.0)
    return np.where(lit, projected, 0.0) / (_RINGS * _SECTORS), np.clip(incidence, 0.0, 1.0), np.clip(leaving, 0.0, 1.0)


def _spread_over(place: FloatArray, share: FloatArray) -> FloatArray:
    """Sums (entries, ANGLE_ENTRIES) of shares (entries, ...) at cosines, linearly between the entries."""
    position = place * (ANGLE_ENTRIES - 1)
    low = np.minimum(position.astype(np.int64), ANGLE_ENTRIES - 2)
    row = ANGLE_ENTRIES * np.arange(place.shape[0])[:, None, None] + low
    size = place.shape[0] * ANGLE_ENTRIES
    near = np.bincount(row.ravel(), (share * (1.0 - (position - low))).ravel(), minlength=size)
    far = np.bincount(row.ravel() + 1, (share * (position - low)).ravel(), minlength=size)
    return np.asarray((near + far).reshape(-1, ANGLE_ENTRIES))
