"""Film conductances of air at a surface: forced by wind, free by its own temperature difference.

Section 3.1.1 of [Report1978] asks for both, by wind speed and direction, surface orientation and size. The march takes
the forced film as it stands and the free one as c |dT|^(1/3), the turbulent law, which has no length in it, and joins
them by their cubes [Churchill1977].

Forced films by name (`CORRELATIONS`), for wind as a weather station gives it, 10 m above open ground:

mowitt        a V^b at windows of low buildings, windward and leeward [Yazdanian1994], times the roughness factor.
mowitt_local  the same for wind at the surface's own height, coefficients of [Booten2012].
tarp          2.537 W (P V / A)^(1/2) at plates in a wind tunnel [Sparrow1979], W 1 windward and 0.5 leeward, with
              perimeter over area P / A of a square of the given length, times the roughness factor [Walton1983].
flat_plate    laminar or turbulent flow along a smooth plate by Reynolds and Prandtl number, times the roughness factor;
              whatever the wind's direction.
mcadams       5.6 + 3.9 V, beyond 4.9 m/s 7.2 V^0.78, at a plate of half a metre [McAdams1954]; still air is in it, so
              that free convection adds little. Neither direction nor roughness matter.

Where windward and leeward differ, the share of the windward film goes with the cosine of the angle to the wind, without
a jump, so that neighbouring orientations stay close; level surfaces count as windward, as roofs do in [Walton1983].
"""

import numpy as np

from sensorsim.errors import InputError
from sensorsim.thermal.air_properties import Air, air_at
from sensorsim.thermal.grid import FloatArray
from sensorsim.thermal.plate_convection import forced_nusselt

CORRELATIONS = ("mowitt", "mowitt_local", "tarp", "flat_plate", "mcadams")
# a [W m-2 K-1 (m/s)^-b] and b [-], windward and leeward.
MOWITT = {
    "mowitt": ((2.38, 0.89), (2.86, 0.617)),
    "mowitt_local": ((3.26, 0.89), (3.55, 0.617)),
}
ROUGHNESS_FACTOR = {
    "very_rough": 2.17,
    "rough": 1.67,
    "medium_rough": 1.52,
    "medium_smooth": 1.13,
    "smooth": 1.11,
    "very_smooth": 1.0,
}  # [Walton1983]
INTERIOR_FREE = 1.31  # c of a vertical surface [W m-2 K-4/3] at FREE_AIR_TEMPERATURE, sea level
FREE_AIR_TEMPERATURE = 294.26  # [K] 70 F, that the coefficients of [Walton1983] are for
_MCADAMS_TURN = 4.8768  # [m s-1] 16 feet a second
_WATTS = 5.678263  # [W m-2 K-1] of one Btu an hour, square foot and degree Fahrenheit
_FOOT = 0.3048  # [m]


def forced_film(
    normal: FloatArray,
    wind_speed: FloatArray,
    wind_direction: FloatArray,
    roughness: str,
    *,
    correlation: str = "mowitt",
    length: float | None = None,
    air: Air | None = None,
) -> FloatArray:
    """Forced film (t, o) [W m-2 K-1] of orientations (o, 3) in wind (t,) [m s-1] that blows from (t,) [deg].

    Parameters
    ----------
    roughness : class of ROUGHNESS_FACTOR
    correlation : one of CORRELATIONS
    length : [m] of the surface along the wind; 'tarp' and 'flat_plate' need it
    air : (t,) or one state, for 'flat_plate'; 20 C at sea level where not given. Free air will do, as the film of a
        surface 20 K warmer is only 2 to 5 % less

    Raises
    ------
    InputError : unknown correlation or roughness, no length where one is needed.
    """
    if roughness not in ROUGHNESS_FACTOR:
        raise InputError("convection", "roughness", roughness, "unknown", f"use one of {', '.join(ROUGHNESS_FACTOR)}")
    factor = ROUGHNESS_FACTOR[roughness]
    share = windward_share(normal, wind_direction)
    if correlation in MOWITT:
        windward, leeward = (a * wind_speed**b for a, b in MOWITT[correlation])
        return _blend(share, factor * windward, factor * leeward)
    if correlation == "mcadams":
        return _blend(share, _mcadams(wind_speed), _mcadams(wind_speed))
    if correlation not in CORRELATIONS:
        remedy = f"use one of {', '.join(CORRELATIONS)}"
        raise InputError("convection", "correlation", correlation, "unknown", remedy)
    if length is None or not length > 0.0:
        raise InputError("convection", "length", length, f"'{correlation}' needs one above 0", "give it in metres")
    if correlation == "tarp":
        film = factor * 2.537 * np.sqrt(4.0 / length * wind_speed)
        return _blend(share, film, 0.5 * film)
    state = air_at(293.15) if air is None else air
    nusselt = forced_nusselt(wind_speed * length / state.kinematic_viscosity, state.prandtl)
    film = factor * nusselt * state.conductivity / length
    return _blend(share, film, film)


def windward_share(normal: FloatArray, wind_direction: FloatArray) -> FloatArray:
    """How far (t, o) surfaces (o, 3) face the wind that blows from (t,) [deg]: 1 into it or level, 0 a lee wall."""
    return wind_share(normal, wind_towards(wind_direction))


def wind_towards(wind_direction: FloatArray) -> FloatArray:
    """Unit vectors (t, 2) east and north to where the wind comes from, at directions (t,) [deg]."""
    angle = np.radians(wind_direction)
    return np.stack([np.sin(angle), np.cos(angle)], axis=-1)


def wind_share(normal: FloatArray, towards: FloatArray) -> FloatArray:
    """As `windward_share`, of unit vectors (t, 2) to where the wind comes from, or means of such."""
    return np.asarray(np.clip(0.5 * (1.0 + towards @ normal[:, :2].T + np.abs(normal[:, 2])), 0.0, 1.0))


def free_film_cubed(normal: FloatArray, *, air: Air | None = None, warmer: bool = True) -> FloatArray:
    """Cube of the free film per kelvin (o,) [W3 m-6 K-4] of surfaces (o, 3) warmer or colder than the air.

    A surface that faces up sheds its warm air more easily than a vertical one, one that faces down holds it, and the
    other way round with cold air [Walton1983 eq. 89 and 90]: c = 9.482 / (7.238 - |cos tilt|) where
    the air comes away, 1.810 / (1.382 + |cos tilt|) where it stays. In `air` of another temperature or pressure than
    70 F at sea level c goes with k (g beta / (nu alpha))^(1/3), as every turbulent law does.

    Beside the full correlation of [ChurchillChu1975] a vertical surface of 3 to 10 m gets 2 % more to 10 % less, one
    of 0.5 m 12 to 24 % less, between 1 and 30 K; a level one that sheds gets 16 % less than by [McAdams1954].
    """
    rising = normal[:, 2] if warmer else -normal[:, 2]
    tilt = np.abs(rising)
    coefficient = np.where(rising >= 0.0, 9.482 / (7.238 - tilt), 1.810 / (1.382 + tilt))
    return np.asarray(coefficient**3 * (1.0 if air is None else _free_strength(air)))


def _free_strength(air: Air) -> float:
    """Cube of the turbulent film in one state of air over that in the air that the coefficients are for [-]."""
    reference = air_at(FREE_AIR_TEMPERATURE)
    ratio = (air.conductivity / reference.conductivity) ** 3 * air.buoyancy / reference.buoyancy
    return float(ratio)


def _blend(share: FloatArray, windward: FloatArray, leeward: FloatArray) -> FloatArray:
    """Film (t, o) from shares (t, o) and the two extremes (t,)."""
    return np.asarray(leeward[:, None] + share * (windward - leeward)[:, None])


def _mcadams(speed: FloatArray) -> FloatArray:
    """Film at a smooth plate in parallel flow; its two branches are made to meet, which they do within 0.1 %."""
    slow = _WATTS * (0.99 + 0.21 * np.minimum(speed, _MCADAMS_TURN) / _FOOT)
    return np.asarray(slow * np.maximum(speed / _MCADAMS_TURN, 1.0) ** 0.78)
