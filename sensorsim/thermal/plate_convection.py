"""Convection at plates from first principles of similarity: Nusselt numbers by Reynolds, Rayleigh and Prandtl.

[Report1978] section 3.1.1 asks for laminar and turbulent flow under ideal conditions. These are the textbook forms, for
study and for checking the shorter ones that the march uses. Nusselt numbers are means over the plate.
"""

import numpy as np

from sensorsim.thermal.air_properties import Air
from sensorsim.thermal.grid import FloatArray

TRANSITION_REYNOLDS = 5e5  # of the boundary layer of a smooth plate [Incropera2007 ch. 7]


def forced_nusselt(reynolds: FloatArray, prandtl: FloatArray) -> FloatArray:
    """Mean Nusselt number of flow along a flat plate [Incropera2007 eq. 7.30, 7.38].

    Laminar, 0.664 Re^1/2 Pr^1/3, up to the transition; beyond it laminar ahead and turbulent behind,
    (0.037 Re^4/5 - 871) Pr^1/3. Both meet at the transition, where the greater one changes over.
    """
    laminar = 0.664 * np.sqrt(reynolds)
    mixed = 0.037 * reynolds**0.8 - 871.0
    return np.asarray(np.where(reynolds > TRANSITION_REYNOLDS, np.maximum(laminar, mixed), laminar) * np.cbrt(prandtl))


def vertical_nusselt(rayleigh: FloatArray, prandtl: FloatArray) -> FloatArray:
    """Mean Nusselt number of free convection at a vertical plate, any flow [ChurchillChu1975 eq. 9]."""
    spread = (1.0 + (0.492 / prandtl) ** (9.0 / 16.0)) ** (8.0 / 27.0)
    return np.asarray((0.825 + 0.387 * rayleigh ** (1.0 / 6.0) / spread) ** 2)


def laminar_vertical_nusselt(rayleigh: FloatArray, prandtl: FloatArray) -> FloatArray:
    """The same for laminar flow only, Rayleigh number up to 1e9 [ChurchillChu1975 eq. 10]; closer there."""
    spread = (1.0 + (0.492 / prandtl) ** (9.0 / 16.0)) ** (4.0 / 9.0)
    return np.asarray(0.68 + 0.670 * rayleigh**0.25 / spread)


def horizontal_nusselt(rayleigh: FloatArray, *, rising: bool) -> FloatArray:
    """Mean Nusselt number of free convection at a horizontal plate [McAdams1954 ch. 7].

    Rising: warm and facing up, or cold and facing down; 0.54 Ra^1/4 laminar, 0.15 Ra^1/3 turbulent, whichever is
    greater. Else the heat stays under the plate (or the cold on it): 0.27 Ra^1/4.
    """
    if rising:
        return np.asarray(np.maximum(0.54 * rayleigh**0.25, 0.15 * np.cbrt(rayleigh)))
    return np.asarray(0.27 * rayleigh**0.25)


def free_plate_film(
    up: FloatArray | float, difference: FloatArray | float, length: FloatArray | float, air: Air
) -> FloatArray:
    """Free film [W m-2 K-1] of a plate of any tilt; arguments broadcast.

    The part of gravity along the plate drives it as if it were vertical, the part across it as if it were horizontal,
    and the stronger flow prevails [Raithby1998].

    Parameters
    ----------
    up : upward component of the unit normal [-]
    difference : surface minus air temperature [K]
    length : [m] of the plate along the flow
    air : at the film temperature
    """
    rayleigh = air.buoyancy * np.abs(difference) * np.asarray(length) ** 3
    across = np.asarray(up) * np.sign(difference)
    along = np.sqrt(np.maximum(1.0 - np.asarray(up) ** 2, 0.0))
    slanted = vertical_nusselt(rayleigh * along, air.prandtl)
    rising = horizontal_nusselt(rayleigh * np.maximum(across, 0.0), rising=True)
    staying = horizontal_nusselt(rayleigh * np.maximum(-across, 0.0), rising=False)
    return np.asarray(np.maximum(slanted, np.maximum(rising, staying)) * air.conductivity / length)
