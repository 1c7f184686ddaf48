"""What neighbours change in the radiation that falls on near surfaces, in long waves and in diffuse sunlight.

Every surface sends what it emits, or reflects of the beam, and what it reflects of its sky, its ground and its
neighbours, back and forth as often as it takes. Sent by Lambert's law, J = own + reflectance (sky + ground + F J).
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.errors import InputError, NumericsError
from sensorsim.thermal.exchange import Exchange

FloatArray = NDArray[np.float64]

BOUNCED = 1e-13  # of the largest radiosity, that a further bounce may add
MOST_BOUNCES = 2000


def radiosity(
    exchange: Exchange, own: FloatArray, reflectance: FloatArray, *, sky: ArrayLike, ground: ArrayLike
) -> FloatArray:
    """What n surfaces send out [W m-2], shape (n,) or (t, n), of which `own` is not reflected of diffuse radiation.

    reflectance (n,) [-]; sky and ground, scalar, (t,) or (t, n), are the radiosities [W m-2] of what is left of them.
    Raises NumericsError where surfaces that reflect everything enclose each other.
    """
    received = _column(sky) * exchange.sky_share + _column(ground) * exchange.ground_share
    source = np.asarray(own + reflectance * received)
    back = (reflectance[:, None] * exchange.matrix()).T
    sent = source
    for _ in range(MOST_BOUNCES):
        further = np.asarray(source + sent @ back)
        if np.max(np.abs(further - sent), initial=0.0) <= BOUNCED * np.max(np.abs(further), initial=0.0):
            return further
        sent = further
    raise NumericsError(f"exchange between surfaces that absorb next to nothing: no end after {MOST_BOUNCES} bounces")


def change_by_neighbours(
    exchange: Exchange, own: FloatArray, reflectance: FloatArray, *, sky: ArrayLike, ground: ArrayLike
) -> FloatArray:
    """Change of the irradiance [W m-2] of n surfaces, shape (n,) or (t, n), by the neighbours that they see.

    Arguments and errors as of `radiosity`. What neighbours send replaces the sky and the ground that they hide.
    """
    sent = radiosity(exchange, own, reflectance, sky=sky, ground=ground)
    hidden = _column(sky) * exchange.sky_taken + _column(ground) * exchange.ground_taken
    return np.asarray(sent @ exchange.matrix().T - hidden)


def longwave_from_neighbours(
    exchange: Exchange, temperature: FloatArray, emissivity: FloatArray, *, sky: ArrayLike, ground: ArrayLike
) -> FloatArray:
    """Change of the long-wave irradiance [W m-2] of n surfaces by their neighbours, shape (n,) or (t, n).

    temperature (n,) or (t, n) [K], emissivity (n,) [-]; sky and ground, scalar, (t,) or (t, n), are radiosities
    [W m-2]. An isothermal scene is left as it is. A surface absorbs the change by its own emissivity.
    """
    temperature, emissivity = np.asarray(temperature, dtype=np.float64), np.asarray(emissivity, dtype=np.float64)
    if not (np.all(temperature > 0.0) and np.all(np.isfinite(temperature))):
        worst = float(np.min(temperature))
        raise InputError("exchange", "temperature", worst, "not all positive and finite [K]", "give kelvin")
    if not np.all((emissivity >= 0.0) & (emissivity <= 1.0)):
        raise InputError("exchange", "emissivity", float(np.max(emissivity)), "not within 0 to 1", "give a fraction")
    emitted = emissivity * STEFAN_BOLTZMANN_CONSTANT * temperature**4
    return change_by_neighbours(exchange, emitted, 1.0 - emissivity, sky=sky, ground=ground)


def _column(values: ArrayLike) -> FloatArray:
    """Values of all surfaces, (t,) as (t, 1)."""
    array = np.asarray(values, dtype=np.float64)
    return array if array.ndim == 2 else array[..., None]


def largest_possible_change(
    exchange: Exchange,
    *,
    sky_difference: ArrayLike,
    ground_difference: ArrayLike,
    greatest_temperature: float,
    emissivity: ArrayLike = 1.0,
) -> FloatArray:
    """Bound [W m-2] of what neighbours can change in the long-wave load that n surfaces absorb, shape (n,).

    Differences [K] bound how far the radiant temperatures of neighbours, ground and sky lie from that of the sky, and
    from that of the ground.
    By the mean value theorem |s T1^4 - s T2^4| <= 4 s T^3 |T1 - T2|, with s the Stefan-Boltzmann constant and T the
    greatest radiant temperature. A neighbour that hides a share of the sky changes the irradiance by at most that
    share times the bound for the sky's difference, and so for the ground; the sum is absorbed by the surface's
    emissivity. A grey neighbour's radiosity is a mean, with weights that add up to one, of black neighbours, sky and
    ground: its radiant temperature is no farther from either than the farthest of those.
    """
    slope = 4.0 * STEFAN_BOLTZMANN_CONSTANT * greatest_temperature**3
    sky, ground = np.abs(np.asarray(sky_difference)), np.abs(np.asarray(ground_difference))
    change = slope * (sky * exchange.sky_taken + ground * exchange.ground_taken)
    if not (np.all(np.isfinite(change)) and greatest_temperature > 0.0):
        raise InputError("exchange", "differences", float(np.max(change)), "not a finite bound [W m-2]", "give kelvin")
    return np.asarray(np.asarray(emissivity) * change)
