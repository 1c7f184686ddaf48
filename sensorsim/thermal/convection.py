"""Film conductances of air at a surface: forced by wind, free by its own temperature difference.

Forced: h = a V^b at glass-smooth buildings, windward and leeward [Yazdanian1994], times the surface's roughness
factor [Walton1983]. Between the two the share of the windward film follows the angle to the wind, without a jump, so
that neighbouring orientations stay close. Free: turbulent, h = c |dT|^(1/3), which has no length in it
[Walton1983], for heat that rises from a surface; section 3.1.1 of [Report1978] asks for both kinds.
"""

import numpy as np

from sensorsim.thermal.grid import FloatArray

WINDWARD = (3.26, 0.89)  # a [W m-2 K-1 (m/s)^-b], b [-]
LEEWARD = (3.55, 0.617)
ROUGHNESS_FACTOR = {
    "very_rough": 2.17,
    "rough": 1.67,
    "medium_rough": 1.52,
    "medium_smooth": 1.13,
    "smooth": 1.11,
    "very_smooth": 1.0,
}
VERTICAL_FREE = 1.31  # c of a vertical surface [W m-2 K-4/3]
INTERIOR_FREE = 1.31


def forced_film(normal: FloatArray, wind_speed: FloatArray, wind_direction: FloatArray, roughness: str) -> FloatArray:
    """Forced film (t, o) [W m-2 K-1] of orientations (o, 3) in wind (t,) [m s-1] that blows from (t,) [deg]."""
    angle = np.radians(wind_direction)
    towards = np.stack([np.sin(angle), np.cos(angle)], axis=-1)
    windward_share = 0.5 * (1.0 + towards @ normal[:, :2].T + np.abs(normal[:, 2]))
    windward_share = np.clip(windward_share, 0.0, 1.0)
    speed = wind_speed[:, None]
    smooth = windward_share * WINDWARD[0] * speed ** WINDWARD[1]
    smooth = smooth + (1.0 - windward_share) * LEEWARD[0] * speed ** LEEWARD[1]
    return np.asarray(ROUGHNESS_FACTOR[roughness] * smooth)


def free_film_cubed(normal: FloatArray) -> FloatArray:
    """Cube of the free film per kelvin (o,) [W3 m-6 K-4], of surfaces warmer than the air.

    A surface that faces up sheds its warm air more easily than a vertical one, one that faces down holds it
    [Walton1983 eq. 89 and 90], joined smoothly: c = 9.482 / (7.238 - |cos tilt|) upward, 1.810 / (1.382 + |cos tilt|)
    downward.
    """
    up = normal[:, 2]
    coefficient = np.where(up >= 0.0, 9.482 / (7.238 - np.abs(up)), 1.810 / (1.382 + np.abs(up)))
    return np.asarray(coefficient**3)
