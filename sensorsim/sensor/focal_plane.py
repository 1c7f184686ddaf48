"""Light on the focal plane from the drawn picture: blur, the sensor's own spacing of columns, samples to elements.

The NumPy twin of shaders/sensor/blur_rows.frag and blur_columns.frag.
"""

import math

import numpy as np
from scipy.ndimage import convolve1d

from sensorsim.radiometry import FloatArray
from sensorsim.sensor.point_spread import Kernel


def column_places(width: int, samples: int, field: float, *, equal_angle: bool) -> FloatArray:
    """Sample of the drawn picture's row (width,) that each column looks at.

    The picture is a plane projection of a horizontal field [rad]; a turning mirror spaces columns equally in angle.
    `samples` is odd: a column's middle is a sample.
    """
    place = (np.arange(width) + 0.5) / width * 2.0 - 1.0
    if equal_angle:
        place = np.tan(0.5 * field * place) / math.tan(0.5 * field)
    return np.asarray(np.floor(0.5 * (place + 1.0) * width * samples))


def focal_plane(picture: FloatArray, kernel: Kernel, places: FloatArray, samples: int) -> FloatArray:
    """Radiance (height, width) [W m-2 sr-1] on the elements, of a picture (height samples, width samples)."""
    total = np.zeros((picture.shape[0] // samples, places.size))
    for row, column in zip(kernel.row, kernel.column, strict=True):
        along = convolve1d(picture, row[::-1], axis=1, mode="nearest")[:, places.astype(np.int64)]
        total += convolve1d(along, column[::-1], axis=0, mode="nearest")[samples // 2 :: samples]
    return total
