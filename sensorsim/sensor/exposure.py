"""What automatic gains and irises go by: the surfaces of a picture, thinned out where it has many pixels."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.sensor.sensitivity import Sensitivity

FILLED = 0.8  # of the detector's range, that an automatic iris aims at
ENOUGH = 20000  # pixels: the share below a quantile at 1% is then true to 0.07%


def sampled_surfaces(picture: NDArray[Any], surface: NDArray[np.bool_]) -> NDArray[Any]:
    """Values of every n-th row and column of a picture (height, width), of surfaces where any is seen."""
    line = sampled_lines(picture.shape)
    return of_surfaces(picture[line, line], surface[line, line])


def sampled_lines(shape: tuple[int, ...]) -> slice:
    """Every n-th row or column; n is the largest that leaves ENOUGH pixels of a picture of that shape."""
    stride = max(1, math.isqrt(math.prod(shape) // ENOUGH))
    return slice(stride // 2 if min(shape) > stride // 2 else 0, None, stride)


def of_surfaces(values: NDArray[Any], seen: NDArray[np.bool_]) -> NDArray[Any]:
    """Values of surfaces where any is seen, else all: the sky may be cold or bright."""
    return values[seen] if np.any(seen) else values.ravel()


def exposure_for(look: Sensitivity, radiance: NDArray[Any]) -> float:
    """Share of the light that keeps all but a hundredth of the pixels below FILLED of what the detector holds."""
    if float(np.max(radiance)) <= FILLED * look.full:
        return 1.0  # of all the pixels: no need to sort them
    bright = float(np.quantile(radiance, 0.99))
    return min(1.0, FILLED * look.full / bright) if bright > 0.0 else 1.0
