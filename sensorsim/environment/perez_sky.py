"""Diffuse sunlight on tilted surfaces by the sky of [Perez1990]: uniform dome, glow around the sun, bright horizon.

Two numbers describe the sky at a moment, F1 for the glow and F2 for the horizon, and the irradiance of any surface
follows from them in closed form. pvlib holds the table that gives them from clearness, brightness and the sun's height;
clearness falls into eight classes, so F1 and F2 step a little (a wall's irradiance by up to 10 W m-2) as it goes from
one to the next.
"""

from dataclasses import dataclass

import numpy as np
import pvlib
from numpy.typing import NDArray

from sensorsim.environment.air_mass import relative_air_mass
from sensorsim.environment.sun import Sunlight, SunPosition

FloatArray = NDArray[np.float64]

# The glow of a sun lower than this is spread over the horizontal as if it stood here [Perez1990].
LOWEST_GLOW = float(np.sin(np.deg2rad(5.0)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SkyBrightness:
    """How far the sky is from uniform; arrays over n times, zero while the sun is down."""

    circumsolar: FloatArray  # (n,) F1 [-], share of the diffuse light that comes from around the sun, 0 to 1
    horizon: FloatArray  # (n,) F2 [-], brightness of the horizon; negative where it is darker than the dome


def sky_brightness(light: Sunlight, position: SunPosition) -> SkyBrightness:
    """Brightness of glow and horizon for the sunlight and the sun's position at n times [Perez1990]."""
    lit = (light.diffuse > 0.0) & (position.elevation > 0.0)
    circumsolar, horizon = np.zeros(lit.shape), np.zeros(lit.shape)
    diffuse, elevation = light.diffuse[lit], position.elevation[lit]
    # On a wall that faces the sun none of the parts is cut off, so F1 and F2 can be read back from them.
    parts = pvlib.irradiance.perez(
        90.0,
        position.azimuth[lit],
        diffuse,
        light.beam[lit],
        light.extraterrestrial[lit],
        90.0 - elevation,
        position.azimuth[lit],
        relative_air_mass(elevation),
        return_components=True,
    )
    circumsolar[lit] = 1.0 - 2.0 * parts["poa_isotropic"] / diffuse
    horizon[lit] = parts["poa_horizon"] / diffuse
    return SkyBrightness(circumsolar=np.clip(circumsolar, 0.0, 1.0), horizon=horizon)


def circumsolar_irradiance(diffuse: FloatArray, brightness: SkyBrightness, sun_direction: FloatArray) -> FloatArray:
    """Irradiance (n,) [W m-2] of the glow normal to the sun; with the beam it is all that comes from there."""
    return np.asarray(diffuse * brightness.circumsolar / np.maximum(sun_direction[:, 2], LOWEST_GLOW))


def perez_irradiance(
    diffuse: FloatArray, brightness: SkyBrightness, sun_direction: FloatArray, normal: FloatArray, *,
    dome: bool = True, glow: bool = True, horizon: bool = True,
) -> FloatArray:  # fmt: skip
    """Diffuse irradiance (n, m) [W m-2] from the sky on surfaces of unit normals (m, 3) east, north, up.

    Parameters
    ----------
    diffuse : (n,) on the horizontal
    brightness : of the sky at the n times
    sun_direction : (n, 3) unit vector towards the sun
    dome, glow, horizon : the parts of the sky that count
    """
    total = np.zeros((diffuse.size, normal.shape[0]))
    if glow:
        total = np.maximum(sun_direction @ normal.T, 0.0)
        total *= circumsolar_irradiance(diffuse, brightness, sun_direction)[:, None]
    uniform = diffuse * (1.0 - brightness.circumsolar) * float(dome)
    rim = diffuse * brightness.horizon * float(horizon)
    if dome or horizon:
        sine = np.hypot(normal[:, 0], normal[:, 1])
        total += np.stack([uniform, rim], axis=-1) @ np.stack([0.5 * (1.0 + normal[:, 2]), sine])
    # A dark horizon may take more from a surface that leans forward than its bit of dome gives.
    return np.asarray(np.maximum(total, 0.0, out=total), dtype=np.float64)
