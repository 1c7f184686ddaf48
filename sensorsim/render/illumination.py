"""What surrounds the surfaces at one moment, in the sensor's band: the few numbers a frame is drawn with.

Emissive bands: sky and ground glow by their own temperatures. Reflective bands: sun, sky and sunlit ground.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import PI
from sensorsim.environment import (
    CLOUD_TEMPERATURE_DEPRESSION,
    EnvironmentSample,
    attenuation_coefficient,
    band_sky,
)
from sensorsim.radiometry import BandTable
from sensorsim.sensor import Sensor
from sensorsim.tables import LookupTable

FloatArray = NDArray[np.float64]

SKY_ENTRIES = 1024  # from the horizon to the zenith, equally spaced in the sine of the elevation


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Illumination:
    """Surroundings in band: irradiance [W m-2], radiance [W m-2 sr-1]."""

    sun_direction: FloatArray  # (3,) unit
    beam: float  # irradiance normal to the sun
    quadrant: FloatArray  # (4,) irradiance of the horizontal from the N, E, S and W quarter of the sky
    sky: FloatArray  # (SKY_ENTRIES,) radiance at elevations whose sine goes from 0 to 1
    ground_radiance: float
    air_radiance: float  # of an infinite path through the air
    attenuation: float  # [m-1]

    @property
    def sky_radiance(self) -> float:
        """Radiance of the uniform sky that gives a horizontal surface the same irradiance."""
        sine = _sines()
        return float(np.trapezoid(self.sky * sine, sine) / np.trapezoid(sine, sine))

    def sky_table(self) -> LookupTable:
        """Sky radiance against the sine of the elevation, for the background.

        The sine is a view's upward component. An arc sine in the shader would cost 7 mK: drivers approximate it.
        """
        return LookupTable(
            name="sky_radiance", quantity="Radiance", argument="Ratio", minimum=0.0, maximum=1.0, values=self.sky
        )


def illuminate(
    sensor: Sensor, sample: EnvironmentSample, ground_temperature: float, table: BandTable | None
) -> Illumination:
    """Surroundings of a moment as `sensor` sees them; `table` is its band's, for emissive sensors."""
    attenuation = attenuation_coefficient(
        sensor.band.name,
        air_temperature=sample.air_temperature,
        relative_humidity=sample.relative_humidity,
        visibility=sample.visibility,
        precipitation=sample.precipitation,
    )
    if table is None:
        return _reflective(sample, attenuation)
    return _emissive(sample, ground_temperature, table, attenuation)


def _emissive(
    sample: EnvironmentSample, ground_temperature: float, table: BandTable, attenuation: float
) -> Illumination:
    parts = band_sky(
        np.degrees(np.arcsin(_sines())), vapour_pressure=sample.vapour_pressure, cloud_cover=sample.cloud_cover
    )
    air = float(table.radiance_at(sample.air_temperature))
    cloud = float(table.radiance_at(sample.air_temperature - CLOUD_TEMPERATURE_DEPRESSION))
    return Illumination(
        sun_direction=sample.sun_direction,
        beam=0.0,
        quadrant=np.zeros(4),
        sky=parts.air * air + parts.cloud * cloud,
        ground_radiance=float(table.radiance_at(ground_temperature)),  # a near black body, section 3.1.3
        air_radiance=air,
        attenuation=attenuation,
    )


def _reflective(sample: EnvironmentSample, attenuation: float) -> Illumination:
    diffuse = float(np.sum(sample.nir_quadrant))
    received = sample.nir_beam * max(float(sample.sun_direction[2]), 0.0) + diffuse
    sky = diffuse / PI
    return Illumination(
        sun_direction=sample.sun_direction,
        beam=sample.nir_beam,
        quadrant=sample.nir_quadrant,
        sky=np.full(SKY_ENTRIES, sky),
        ground_radiance=sample.ground_albedo * received / PI,
        air_radiance=sky,  # the air lights up to the brightness of the horizon
        attenuation=attenuation,
    )


def _sines() -> FloatArray:
    return np.linspace(0.0, 1.0, SKY_ENTRIES)
