"""Sunlight in 0.8-1.1 um, the band of low-light television, from broadband sunlight.

In-band shares of the clear beam and of the clear diffuse light grow with air mass, as the blue is lost first. The
power of air mass and its end are read off [Bird1986] (SPCTRAL2; precipitable water 9 to 29 mm, aerosol optical depth
0.1 to 0.25). The factors put 151.5 W m-2 of beam and 15.7 W m-2 of diffuse light into the band at 60 degrees from the
zenith, mid-latitude summer, 23 km visibility (6S 155 and [LOWTRAN7] 148 for the beam), out of 657 and 129 W m-2 in
all (SPCTRAL2).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment.air_mass import relative_air_mass
from sensorsim.environment.night import twilight_irradiance
from sensorsim.environment.quadrants import quadrant_irradiance
from sensorsim.environment.sun import Sunlight, SunPosition

FloatArray = NDArray[np.float64]

_BEAM_SHARE = 0.207  # [-] at air mass 1
_DIFFUSE_SHARE = 0.109  # [-] at air mass 1
_AIR_MASS_EXPONENT = 0.16
_GREATEST_AIR_MASS = (
    8.0  # beyond it the shares stay: water vapour then takes as much from the band as is lost in the blue
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NearInfrared:
    """Irradiance [W m-2] in 0.8-1.1 um; arrays over n times."""

    beam: FloatArray  # (n,) normal to the sun
    quadrant: FloatArray  # (n, 4) on the horizontal from the N, E, S and W quarters of the sky


def near_infrared(
    clear: Sunlight, cloudy: Sunlight, position: SunPosition, cloud_cover: FloatArray, circumsolar: FloatArray
) -> NearInfrared:
    """Beam and quadrants in 0.8-1.1 um by day, in twilight and at night.

    Under cloud the diffuse light takes on the spectrum of the clear global one, in proportion to the cover, and
    twilight is dimmed like the day's global light. The sky is uniform while the sun is down.

    Parameters
    ----------
    clear, cloudy : broadband sunlight, without and with the clouds
    position : of the sun
    cloud_cover : (n,) [-]
    circumsolar : (n,) [-] share of the diffuse light that leans towards the sun
    """
    growth = np.minimum(relative_air_mass(position.elevation), _GREATEST_AIR_MASS) ** _AIR_MASS_EXPONENT
    beam_share, diffuse_share = _BEAM_SHARE * growth, _DIFFUSE_SHARE * growth
    height = np.sin(np.deg2rad(np.maximum(position.elevation, 0.0)))
    direct = clear.beam * height
    total = direct + clear.diffuse
    lit = total > 0.0
    global_share = (direct * beam_share + clear.diffuse * diffuse_share) / np.where(lit, total, 1.0)
    share = (1.0 - cloud_cover) * diffuse_share + cloud_cover * global_share
    dusk = twilight_irradiance(position.true_elevation) * (1.0 - 0.75 * cloud_cover**3.4)
    diffuse = np.maximum(cloudy.diffuse * share, dusk)
    quadrant = quadrant_irradiance(diffuse, position.azimuth, circumsolar)
    return NearInfrared(beam=cloudy.beam * beam_share, quadrant=quadrant)
