"""Everything outdoors that drives a surface, on one uniform time grid."""

from dataclasses import dataclass
from datetime import datetime
from functools import partial

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.environment.perez_sky import SkyBrightness
from sensorsim.environment.sample import EnvironmentSample
from sensorsim.environment.site import Site
from sensorsim.errors import InputError

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Environment:
    """Weather, sun and sky from the start of the lead-in to the end of the image day; arrays over n times."""

    name: str
    site: Site
    start: datetime  # local standard time of the first sample
    image_start: datetime  # local midnight at which the image day begins
    step: float  # [s]
    time: FloatArray  # (n,) [s] since start
    air_temperature: FloatArray  # (n,) [K]
    relative_humidity: FloatArray  # (n,) [-]
    vapour_pressure: FloatArray  # (n,) [Pa]
    wind_speed: FloatArray  # (n,) [m s-1]
    wind_direction: FloatArray  # (n,) [deg] clockwise from north, where the wind blows from
    cloud_cover: FloatArray  # (n,) [-]
    precipitation: FloatArray  # (n,) [mm h-1]
    ground_state: NDArray[np.str_]  # (n,) 'dry', 'wet' or 'snow'
    ground_albedo: FloatArray  # (n,) [-] solar
    visibility: float  # [m] meteorological range, the same all the time
    aerosol: str  # kind of haze or fog
    sun_direction: FloatArray  # (n, 3) unit vector east, north, up towards the sun, also below the horizon
    sun_elevation: FloatArray  # (n,) [deg] apparent
    beam_irradiance: FloatArray  # (n,) [W m-2] normal to the sun
    diffuse_irradiance: (
        FloatArray  # (n,) [W m-2] on the horizontal, zero in twilight, which carries no heat to speak of
    )
    quadrant_irradiance: FloatArray  # (n, 4) [W m-2] its parts from the N, E, S and W quarters of the sky
    circumsolar_brightness: FloatArray  # (n,) [-] F1 of [Perez1990], share of the diffuse from around the sun
    horizon_brightness: FloatArray  # (n,) [-] F2 of [Perez1990], of the horizon against the dome
    sky_temperature: FloatArray  # (n,) [K] black hemisphere, all long wavelengths
    nir_beam: FloatArray  # (n,) [W m-2] normal to the sun, 0.8-1.1 um
    nir_quadrant: FloatArray  # (n, 4) [W m-2] diffuse on the horizontal, 0.8-1.1 um, with twilight, moon and night glow
    moon_direction: FloatArray  # (n, 3) unit vector east, north, up towards the moon, also below the horizon
    moon_beam: FloatArray  # (n,) [W m-2] normal to the moon, 0.8-1.1 um

    @property
    def sky_brightness(self) -> SkyBrightness:
        """How the diffuse light leans to the sun and to the horizon."""
        return SkyBrightness(circumsolar=self.circumsolar_brightness, horizon=self.horizon_brightness)

    @property
    def image_window(self) -> slice:
        """Samples of the image day, from midnight to midnight, both included."""
        first = round((self.image_start - self.start).total_seconds() / self.step)
        return slice(first, first + round(SECONDS_PER_DAY / self.step) + 1)

    def at(self, time_of_day: float) -> EnvironmentSample:
        """State at a time of the image day [s since local midnight], interpolated; what a frame is drawn with.

        Raises
        ------
        InputError : a time outside of 0 to 86400 s.
        """
        if not 0.0 <= time_of_day <= SECONDS_PER_DAY:
            raise InputError(self.name, "time of day", time_of_day, "not on the image day", "give 0 to 86400 s")
        position = self.image_window.start + time_of_day / self.step
        low = min(int(position), len(self.time) - 2)
        share = position - low
        held = low + int(share >= 1.0)
        mix = partial(_between, low=low, share=share)
        return EnvironmentSample(
            time_of_day=time_of_day,
            air_temperature=float(mix(self.air_temperature)),
            relative_humidity=float(mix(self.relative_humidity)),
            vapour_pressure=float(mix(self.vapour_pressure)),
            wind_speed=float(mix(self.wind_speed)),
            cloud_cover=float(mix(self.cloud_cover)),
            precipitation=float(self.precipitation[held]),
            ground_state=str(self.ground_state[held]),
            ground_albedo=float(self.ground_albedo[held]),
            visibility=self.visibility,
            aerosol=self.aerosol,
            sun_direction=_unit(mix(self.sun_direction)),
            sun_elevation=float(mix(self.sun_elevation)),
            beam_irradiance=float(mix(self.beam_irradiance)),
            quadrant_irradiance=mix(self.quadrant_irradiance),
            sky_temperature=float(mix(self.sky_temperature)),
            nir_beam=float(mix(self.nir_beam)),
            nir_quadrant=mix(self.nir_quadrant),
            moon_direction=_unit(mix(self.moon_direction)),
            moon_beam=float(mix(self.moon_beam)),
        )


def _unit(direction: FloatArray) -> FloatArray:
    return np.asarray(direction / np.linalg.norm(direction))


def _between(values: FloatArray, low: int, share: float) -> FloatArray:
    return np.asarray((1.0 - share) * values[low] + share * values[low + 1], dtype=np.float64)
