"""The ground plane: how much sunlight it returns. Its temperature follows from the heat balance, not from here."""

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import ZERO_CELSIUS

# Solar reflectance of open ground. Dry: grass, soil and pavement together, 0.16 to 0.26 for grass and 0.05 to 0.40
# for soils [Oke1987]. Wet: estimate, two thirds of the dry value as wetting darkens it. Snow: between old and fresh,
# 0.40 to 0.95 [Oke1987].
GROUND_ALBEDO = {"dry": 0.20, "wet": 0.14, "snow": 0.70}

# Snow melts rather than warm: no ground under snow gets above this temperature [K] [Report1978] section 3.1.3. What it
# takes to melt it is in the march of ground made of snow (thermal.melting).
SNOW_MAXIMUM_TEMPERATURE = ZERO_CELSIUS


def ground_albedo(ground_state: NDArray[np.str_]) -> NDArray[np.float64]:
    """Solar reflectance [-] of the ground plane for each ground state, shape as given."""
    return np.array([GROUND_ALBEDO[state] for state in ground_state.ravel()]).reshape(ground_state.shape)
