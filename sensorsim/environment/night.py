"""Light after sunset: twilight and the glow of the moonless night sky in 0.8-1.1 um. No heat worth counting."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

# log10 of the illuminance [lx] of a horizontal plane by the sun: a cubic in x = true elevation / 90 deg on each range
# of elevation [deg], sun below the horizon only. [Seidelmann1992], from [Janiczek1987].
_TWILIGHT = (
    (-0.8, (2.88, 22.26, -207.64, 1034.30)),
    (-5.0, (2.88, 21.81, -258.11, -858.36)),
    (-12.0, (2.70, 12.17, -431.69, -1899.83)),
    (-18.0, (13.84, 262.72, 1447.42, 2797.93)),
)
# The cubics do not quite meet: taken every quarter of a degree and joined by straight lines they fall without a step.
_ELEVATION = np.linspace(-18.0, 0.0, 73)

# In-band irradiance per illuminance [W m-2 lx-1]. Estimate: a fifth of a low sun's global irradiance lies in the band
# [Bird1986], and daylight has 110 lm W-1.
_BAND_PER_LUX = 0.2 / 110.0

# Moonless clear night, hemispheric, airglow more than stars [W m-2]; estimate from sky brightness in I, z and Y.
NIGHT_GLOW = 13e-6


def _log_illuminance(elevation: float) -> float:
    cubic = next(cubic for lowest, cubic in _TWILIGHT if elevation >= lowest)
    x = elevation / 90.0
    return cubic[0] + x * (cubic[1] + x * (cubic[2] + x * cubic[3]))


_LOG_ILLUMINANCE = np.array([_log_illuminance(elevation) for elevation in _ELEVATION])


def twilight_irradiance(true_elevation: FloatArray) -> FloatArray:
    """Clear-sky diffuse irradiance [W m-2] on the horizontal in 0.8-1.1 um with the sun at an elevation [deg].

    For the sun below the horizon; above it the value of the horizon is held, for the caller to exceed by daylight.
    Falls with the sun to NIGHT_GLOW at 18 degrees below, and stays there.
    """
    dusk = 10.0 ** np.interp(true_elevation, _ELEVATION, _LOG_ILLUMINANCE) - 10.0 ** _LOG_ILLUMINANCE[0]
    return np.asarray(_BAND_PER_LUX * dusk + NIGHT_GLOW, dtype=np.float64)
