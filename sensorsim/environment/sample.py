"""The environment at one moment, as plain numbers: what a frame is drawn with."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment.atmosphere import Transmittance, attenuation_coefficient, band_transmittance
from sensorsim.environment.band_sky import BandSky, band_sky
from sensorsim.environment.thermal_sky import CLOUD_TEMPERATURE_DEPRESSION

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EnvironmentSample:
    """Weather, sun and sky at one time of the image day."""

    time_of_day: float  # [s] since local midnight, standard time
    air_temperature: float  # [K]
    relative_humidity: float  # [-]
    vapour_pressure: float  # [Pa]
    wind_speed: float  # [m s-1]
    cloud_cover: float  # [-]
    precipitation: float  # [mm h-1]
    ground_state: str  # 'dry', 'wet' or 'snow'
    ground_albedo: float  # [-] solar
    visibility: float  # [m]
    aerosol: str  # kind of haze or fog
    sun_direction: FloatArray  # (3,) unit vector east, north, up
    sun_elevation: float  # [deg] apparent
    beam_irradiance: float  # [W m-2] normal to the sun
    quadrant_irradiance: FloatArray  # (4,) [W m-2] on the horizontal from N, E, S, W
    sky_temperature: float  # [K] black hemisphere, all long wavelengths
    nir_beam: float  # [W m-2] normal to the sun, 0.8-1.1 um
    nir_quadrant: FloatArray  # (4,) [W m-2] diffuse on the horizontal, 0.8-1.1 um
    moon_direction: FloatArray  # (3,) unit vector east, north, up
    moon_beam: float  # [W m-2] normal to the moon, 0.8-1.1 um

    @property
    def cloud_temperature(self) -> float:
        """Temperature of the cloud base [K]."""
        return self.air_temperature - CLOUD_TEMPERATURE_DEPRESSION

    def band_sky(self, elevation: FloatArray) -> BandSky:
        """Emissivities of air and cloud in 8-14 um at elevations [deg] above the horizon."""
        return band_sky(elevation, vapour_pressure=self.vapour_pressure, cloud_cover=self.cloud_cover)

    def transmittance(self, band: str) -> Transmittance:
        """Transmittance of 'FLIR', 'MWIR' or 'LLLTV' along a level path."""
        return band_transmittance(
            band,
            air_temperature=self.air_temperature,
            relative_humidity=self.relative_humidity,
            visibility=self.visibility,
            precipitation=self.precipitation,
            aerosol=self.aerosol,
        )

    def attenuation_coefficient(self, band: str) -> float:
        """Single coefficient [m-1] of [Report1978] eq. 15 for a band."""
        return attenuation_coefficient(
            band,
            air_temperature=self.air_temperature,
            relative_humidity=self.relative_humidity,
            visibility=self.visibility,
            precipitation=self.precipitation,
            aerosol=self.aerosol,
        )
