"""What the march takes in: a wall's factored linear part, its boundary conditions on both faces, its state.

Named tuples, because compiled code takes them as they are. Films join forced and free convection by their cubes,
h = (forced^3 + free |dT|)^(1/3) [Churchill1977]; the march takes one Newton step of the cube root along with each step
of the face temperatures. Its state is in degrees Celsius, so that a metal skin's conductance of 1e6 W m-2 K-1
multiplies the rounding errors of 20 and not of 300.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


class Cells(NamedTuple):
    """A wall's linear part, factored for one step length."""

    rate: FloatArray  # (n,) capacity / (gamma step) [W m-2 K-1]
    conductance: FloatArray  # (n + 1,) [W m-2 K-1]
    pivot: FloatArray  # (n,) reciprocal pivots of the elimination [m2 K W-1]
    influence: FloatArray  # (2, n) cell temperatures per kelvin of the exterior and of the interior face [-]
    exchange: FloatArray  # (2, 2) flux into the wall per kelvin of either face [W m-2 K-1]
    stiff: NDArray[np.bool_]  # (n,) cells that relax within a step
    lag: FloatArray  # (n,) a cell's own relaxation over the stage's span [-]


class Outside(NamedTuple):
    """What acts on the exterior face, at samples (t) and orientations (o)."""

    irradiance: FloatArray  # (t, o) solar [W m-2]
    longwave: FloatArray  # (t, o) irradiance from sky and ground [W m-2]
    film: FloatArray  # (t, o) forced [W m-2 K-1]
    free: FloatArray  # (o,) free film cubed per kelvin [W3 m-6 K-4]
    air: FloatArray  # (t,) [K]
    emissivity: float
    latent: FloatArray = np.zeros((1, 1))  # (t, o) vapour exchange [W m-2 Pa-1]; one row: a dry surface
    vapour: FloatArray = np.zeros(0)  # (t,) pressure in the air [Pa]


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


def outside_from(outside: Outside, first: int) -> Outside:
    """What acts on the exterior face from a sample on."""
    series = {name: getattr(outside, name)[first:] for name in ("irradiance", "longwave", "film", "air")}
    if outside.vapour.size:
        series["vapour"] = outside.vapour[first:]
    if len(outside.latent) == len(outside.air):
        series["latent"] = outside.latent[first:]
    return outside._replace(**series)


def inside_from(inside: Inside, first: int) -> Inside:
    """What acts on the interior face from a sample on."""
    return inside._replace(air=inside.air[first:], radiant=inside.radiant[first:], film=inside.film[first:])


class Columns(NamedTuple):
    """State of all columns, updated in place."""

    cells: FloatArray  # (n, m) [C]
    faces: FloatArray  # (2, m) exterior, interior [C]
    films: FloatArray  # (2, m) total films [W m-2 K-1]
    heat: FloatArray  # (2, m) heat that has entered through each face [J m-2]
    orientation: NDArray[np.int64]  # (m,)
    absorptance: FloatArray  # (m,)


class Work(NamedTuple):
    """One block of l lanes, each a column, on its way through a step."""

    now: FloatArray  # (n, l) cells at the start of the step [C]
    first: FloatArray  # (n, l) their change in the first stage [K]
    star: FloatArray  # (n, l) right side of the second stage [C]
    cells: FloatArray  # (n, l) cells of the stage that is being solved [C]
    kept: FloatArray  # (n, l) cells of the second stage, while the step is damped for some lanes [C]
    load: FloatArray  # (12, l) what acts on the exterior face, and scratch
    faces: FloatArray  # (2, l) at the start of the step [C]
    ends: FloatArray  # (2, l) of the stage that is being solved [C]
    trial: FloatArray  # (2, l) of the second stage, while the step is damped for some lanes [C]
    films: FloatArray  # (2, l) [W m-2 K-1]
    held: FloatArray  # (2, l) of the second stage, while the step is damped for some lanes [W m-2 K-1]
    flux: FloatArray  # (6, l) into the wall through both faces, of stages one, two and damped [W m-2]
