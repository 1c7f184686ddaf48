"""The sun: where it stands and what reaches the ground through a cloudless and a cloudy sky.

Position and clear sky come from pvlib: the SPA of [Reda2004], good to a thousandth of a degree in any year, and the
model of [Ineichen2002] with the monthly Linke turbidity that pvlib stores for every place.
"""

from dataclasses import dataclass

import numpy as np
import pandas as pd
import pvlib
from numpy.typing import NDArray

from sensorsim.environment.air_mass import relative_air_mass
from sensorsim.environment.site import Site

FloatArray = NDArray[np.float64]
SEA_LEVEL_PRESSURE = 101325.0  # [Pa]
SUN_RADIUS = 4.65e-3  # [rad] 695,700 km at 149.6 million km [Prsa2016]; the moon's is within 4 %


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SunPosition:
    """Where the sun stands; arrays over n times."""

    direction: FloatArray  # (n, 3) unit vector east, north, up towards the apparent sun, also below the horizon
    elevation: FloatArray  # (n,) [deg] apparent, raised by refraction near and above the horizon
    true_elevation: FloatArray  # (n,) [deg] without refraction, smooth across the horizon
    azimuth: FloatArray  # (n,) [deg] clockwise from north


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sunlight:
    """Broadband solar irradiance [W m-2]; arrays over n times, zero while the sun is down."""

    beam: FloatArray  # on a plane normal to the sun
    diffuse: FloatArray  # from the sky on the horizontal
    extraterrestrial: FloatArray  # normal to the sun, above the atmosphere


def sun_position(site: Site, time: NDArray[np.datetime64]) -> SunPosition:
    """Position of the sun at a site for times in UTC, shape (n,)."""
    stamps = pd.DatetimeIndex(time.astype("datetime64[ns]"), tz="UTC")
    pressure = pvlib.atmosphere.alt2pres(site.altitude)
    table = pvlib.solarposition.spa_python(
        stamps, site.latitude, site.longitude, altitude=site.altitude, pressure=pressure
    )
    column = {name: table[name].to_numpy(dtype=np.float64) for name in table}
    elevation, azimuth = column["apparent_elevation"], column["azimuth"]
    up, around = np.deg2rad(elevation), np.deg2rad(azimuth)
    direction = np.stack([np.cos(up) * np.sin(around), np.cos(up) * np.cos(around), np.sin(up)], axis=-1)
    return SunPosition(direction=direction, elevation=elevation, true_elevation=column["elevation"], azimuth=azimuth)


def linke_turbidity(site: Site, date: NDArray[np.datetime64]) -> FloatArray:
    """Linke turbidity [-] on local dates, linear between the middles of the months; shape as given."""
    year = date.astype("datetime64[Y]")
    starts = year[..., None].astype("datetime64[M]") + np.arange(13)
    day_of_start = (starts.astype("datetime64[D]") - year[..., None].astype("datetime64[D]")).astype(np.float64)
    # Asked at mid-month without interpolation, pvlib returns its twelve stored values.
    months = pd.DatetimeIndex([f"2001-{month:02d}-15" for month in range(1, 13)], tz="UTC")
    monthly = pvlib.clearsky.lookup_linke_turbidity(
        months, site.latitude, site.longitude, interp_turbidity=False
    ).to_numpy(dtype=np.float64)
    day = _day_of_year(date)
    found = [
        np.interp(now, (begin[:-1] + begin[1:]) / 2.0, monthly, period=begin[-1])
        for now, begin in zip(day.ravel(), day_of_start.reshape(-1, 13), strict=True)
    ]
    return np.array(found, dtype=np.float64).reshape(date.shape)


def clear_sunlight(site: Site, position: SunPosition, date: NDArray[np.datetime64]) -> Sunlight:
    """Sunlight under a cloudless sky [Ineichen2002]; `date` is the local date of each sample."""
    days, which = np.unique(date.astype("datetime64[D]"), return_inverse=True)
    turbidity = linke_turbidity(site, days)[which]
    daily = pvlib.irradiance.get_extra_radiation(_day_of_year(days), method="spencer")
    extraterrestrial = np.asarray(daily, dtype=np.float64)[which]
    # The model divides by the cosine from the zenith: ask it only where the sun is up.
    up = position.elevation > 0.0
    zenith = 90.0 - position.elevation[up]
    air_mass = relative_air_mass(position.elevation[up]) * pvlib.atmosphere.alt2pres(site.altitude) / SEA_LEVEL_PRESSURE
    clear = pvlib.clearsky.ineichen(
        zenith, air_mass, turbidity[up], altitude=site.altitude, dni_extra=extraterrestrial[up]
    )
    beam, diffuse = np.zeros(up.shape), np.zeros(up.shape)
    beam[up], diffuse[up] = clear["dni"], clear["dhi"]
    return Sunlight(beam=beam, diffuse=diffuse, extraterrestrial=extraterrestrial)


def sunlight_under_cloud(clear: Sunlight, elevation: FloatArray, cloud_cover: FloatArray) -> Sunlight:
    """Sunlight under a sky that clouds cover to the share n [-].

    The global irradiance falls to 1 - 0.75 n^3.4 of the clear one [KastenCzeplak1980]; the sun is seen through the
    gaps, so the beam to 1 - n (estimate). The diffuse is what remains, which is never negative as 0.75 n^3.4 <= n.
    """
    height = np.sin(np.deg2rad(np.maximum(elevation, 0.0)))
    total = (clear.beam * height + clear.diffuse) * (1.0 - 0.75 * cloud_cover**3.4)
    beam = clear.beam * (1.0 - cloud_cover)
    return Sunlight(beam=beam, diffuse=total - beam * height, extraterrestrial=clear.extraterrestrial)


def _day_of_year(date: NDArray[np.datetime64]) -> FloatArray:
    days = date.astype("datetime64[D]") - date.astype("datetime64[Y]").astype("datetime64[D]")
    return np.asarray(days.astype(np.float64) + 1.0, dtype=np.float64)
