"""What light does to a wall type from the moment that it falls on it: the march of the tables, linearised."""

import numpy as np

from sensorsim.tables.history import Ready
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.thermal.boundary import Outside
from sensorsim.thermal.linear_response import exterior_slope, interior_slope, linear_response
from sensorsim.thermal.natural import AERODYNAMIC


def sun_response(
    ready: Ready, outside: Outside, temperature: FloatArray, record: IntArray, *, light: FloatArray, first: int,
    step: float,
) -> FloatArray:  # fmt: skip
    """Rise (t, m) [K] of a plain wall type, black to the sun, by light (s, m) [W m-2] from sample `first` on.

    Linear about its course (t, o) [K] at the samples `record` (t,) under what acts `outside`, averaged over all
    orientations; before the first of them as at the same clock time later.
    """
    cover = ready.wall.cover
    at_record = outside._replace(
        film=outside.film[record], air=outside.air[record],
        latent=outside.latent[record] if outside.latent.shape[0] > 1 else outside.latent,
    )  # fmt: skip
    course = exterior_slope(at_record, temperature).mean(axis=1)
    clock = (np.arange(first, record[-1] + 1) - record[0]) % max(int(record[-1] - record[0]), 1)
    slope = np.interp(clock, record - record[0], course)
    share = cover.interception if cover is not None and cover.kind in AERODYNAMIC else 1.0
    rise = np.zeros((record.size, light.shape[1]))
    for path in ready.paths:
        inner = interior_slope(ready.inside, path.grid.interior_area)
        answer = linear_response(path.grid, light, slope, inner, step=step, record=record - first)
        rise += path.fraction * share * answer
    return rise
