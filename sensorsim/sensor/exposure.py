"""What an automatic iris goes by."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.sensor.sensitivity import Sensitivity

FILLED = 0.8  # of the detector's range, that an automatic iris aims at


def exposure_for(look: Sensitivity, radiance: NDArray[Any]) -> float:
    """Share of the light that keeps all but a hundredth of the pixels below FILLED of what the detector holds."""
    bright = float(np.quantile(radiance, 0.99))
    return min(1.0, FILLED * look.full / bright) if bright > 0.0 else 1.0
