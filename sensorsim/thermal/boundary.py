"""What the march takes in: a wall's factored linear part, its boundary conditions on both faces, its state.

Named tuples, because compiled code takes them as they are. Films join forced and free convection by their cubes,
h = (forced^3 + free |dT|)^(1/3) [Churchill1977]; the march takes one step of its inverse along with each Newton step
of the face temperatures. Its state is in degrees Celsius, so that a metal skin's conductance of 1e6 W m-2 K-1
multiplies the rounding errors of 20 and not of 300.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


class Cells(NamedTuple):
    """A wall's linear part, factored for one step length, to be eliminated from either face."""

    # (2, 5) flux into the exterior face per kelvin of itself and, away, of the interior one; into the interior face per
    # kelvin of the exterior one, away, and of itself; conductance from the face to the cell next to it [W m-2 K-1];
    # as found by an elimination that ends at the exterior and at the interior face
    exchange: FloatArray
    # (n, 5) of an elimination outward: a cell's own part, the share of the cell before in it, its flux into the face
    # where the elimination began [W m-2 K-1]; then its temperature by that of the cell after it and by that face
    outward: FloatArray
    inward: FloatArray  # (n, 5) likewise of an elimination inward
    # (2,) reach of the outermost and innermost cells' change in a step by that in the first stage, 0 for those that
    # take longer than a step
    reach: FloatArray


class Outside(NamedTuple):
    """What acts on the exterior face, at samples (t) and orientations (o)."""

    irradiance: FloatArray  # (t, o) solar [W m-2]
    longwave: FloatArray  # (t, o) irradiance from sky and ground [W m-2]
    film: FloatArray  # (t, o) forced [W m-2 K-1]
    free: FloatArray  # (o,) free film cubed per kelvin, of a face warmer than the air [W3 m-6 K-4]
    air: FloatArray  # (t,) [K]
    emissivity: float
    latent: FloatArray = np.zeros((1, 1))  # (t, o) vapour exchange [W m-2 Pa-1]; one row: a dry surface
    vapour: FloatArray = np.zeros(0)  # (t,) pressure in the air [Pa]
    free_colder: FloatArray = np.zeros(0)  # (o,) of a face colder than the air; none: as of a warmer one


class Inside(NamedTuple):
    """What acts on the interior face."""

    air: FloatArray  # (t,) [K]
    radiant: FloatArray  # (t,) [K]
    film: FloatArray  # (t,) forced [W m-2 K-1]
    free: float  # free film cubed per kelvin [W3 m-6 K-4]
    emissivity: float


def per_exterior_area(inside: Inside, area: float) -> Inside:
    """What acts on an interior face of `area` times the exterior one [-], per unit of exterior area."""
    if area == 1.0:
        return inside
    if area == 0.0:  # a solid: no heat passes, and a film of any size lets the idle face find its balance
        return inside._replace(film=np.ones_like(inside.film), free=0.0, emissivity=0.0)
    return inside._replace(film=area * inside.film, free=area**3 * inside.free, emissivity=area * inside.emissivity)


def outside_from(outside: Outside, first: int, stride: int = 1) -> Outside:
    """What acts on the exterior face from a sample on, of every `stride`-th one."""
    names = ["irradiance", "longwave", "film", "air"]
    names += ["vapour"] if outside.vapour.size else []
    names += ["latent"] if len(outside.latent) == len(outside.air) else []
    chosen = slice(first, None, stride)
    series: dict[str, Any] = {name: np.ascontiguousarray(getattr(outside, name)[chosen]) for name in names}
    return outside._replace(**series)


def outside_at(outside: Outside, chosen: NDArray[np.bool_]) -> Outside:
    """What acts on the exterior faces of some of the orientations (o,)."""
    names = ["irradiance", "longwave", "film"]
    names += ["latent"] if outside.latent.shape[1] == chosen.size else []
    series = {name: getattr(outside, name)[:, chosen] for name in names}
    colder = outside.free_colder[chosen] if outside.free_colder.size else outside.free_colder
    return outside._replace(free=outside.free[chosen], free_colder=colder, **series)


def inside_from(inside: Inside, first: int, stride: int = 1) -> Inside:
    """What acts on the interior face from a sample on, of every `stride`-th one."""
    chosen = slice(first, None, stride)
    return inside._replace(air=inside.air[chosen], radiant=inside.radiant[chosen], film=inside.film[chosen])


class Columns(NamedTuple):
    """State of all columns, updated in place."""

    cells: FloatArray  # (n, m) [C]
    # (10, m) by pairs of the exterior and the interior face: temperatures [C], inverse total films [W-1 m2 K], heat
    # entered [J m-2], what temperatures rose in the last step and in the one before [K], by which the next is guessed
    carried: FloatArray
    absorptance: FloatArray  # (a,) [-]; the columns of each stand together, orientation by orientation

    @property
    def faces(self) -> FloatArray:
        """Temperatures (2, m) [C]."""
        return self.carried[0:2]

    @property
    def heat(self) -> FloatArray:
        """Heat (2, m) that has entered through each face [J m-2]."""
        return self.carried[4:6]


class Trace(NamedTuple):
    """Samples of which the march keeps both faces' temperatures as it passes them."""

    row: NDArray[np.int64]  # (t,) of each sample in `faces`, -1 for those that are not kept
    faces: FloatArray  # (r, 2, m) exterior, interior [C]
