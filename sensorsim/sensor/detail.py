"""Detail enhancement: what differs from a smooth base is shown with a gain of its own.

The base is the picture's own line fit around each element, a x + b with a = var / (var + EDGE^2), averaged over the
surroundings [He2010]: where the picture varies little it is their mean, at an edge it is the edge itself, so that what
is stretched is texture, and edges get no seam. All in shares x of the window. The NumPy twin of
shaders/sensor/detail_rows.frag and detail_columns.frag and of `detail_kernels`.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter

DETAIL_REACH = 4  # elements to either side that make a base
EDGE = 0.05  # of the window: steps well above it are edges, below it detail


def enhance_detail(signal: NDArray[Any], level: float, span: float, gain: float) -> NDArray[Any]:
    """Radiance (height, width) [W m-2 sr-1] with `gain` times its detail, for a window; its own type."""
    kind = signal.dtype.type
    share = (signal - kind(level)) / kind(span)
    mean = _mean(share)
    variance = np.maximum(_mean(share**2) - mean**2, kind(0.0))
    slope = variance / (variance + kind(EDGE**2))
    base = _mean(slope) * share + _mean(mean * (kind(1.0) - slope))
    return np.asarray(signal + kind(span * (gain - 1.0)) * (share - base))


def _mean(values: NDArray[Any]) -> NDArray[Any]:
    """Mean over the surroundings; the picture's edge goes on beyond it."""
    return np.asarray(uniform_filter(values, 2 * DETAIL_REACH + 1, mode="nearest"))
