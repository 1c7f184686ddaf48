"""What surrounds the surfaces at one moment, in the sensor's band: the few numbers a frame is drawn with.

Emissive bands: sky and ground glow by their own temperatures. Reflective bands: sun, sky and sunlit ground.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import PI
from sensorsim.effects import EffectPlan
from sensorsim.environment import (
    CLOUD_TEMPERATURE_DEPRESSION,
    AirPath,
    EnvironmentSample,
    SkyGlow,
    band_sky,
    clear_glow,
    clear_path,
    overcast_radiance,
)
from sensorsim.environment.sky_glow import INDICATRIX_ENTRIES
from sensorsim.radiometry import BandTable
from sensorsim.render.air import DEFAULT_ATMOSPHERE, air_path
from sensorsim.render.mirror import facet_table, glow_mirror_table, mirror_table, rise_table
from sensorsim.sensor import Sensor
from sensorsim.tables import LookupTable

FloatArray = NDArray[np.float64]

SKY_ENTRIES = 1024  # from the horizon to the zenith, equally spaced in the sine of the elevation


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Illumination:
    """Surroundings in band: irradiance [W m-2], radiance [W m-2 sr-1]."""

    sun_direction: FloatArray  # (3,) unit, towards the moon where it is the brighter light
    beam: float  # irradiance normal to the sun
    quadrant: FloatArray  # (4,) irradiance of the horizontal from the N, E, S and W quarter of the sky
    sky: FloatArray  # (SKY_ENTRIES,) radiance at elevations whose sine goes from 0 to 1
    ground_radiance: float
    air: AirPath
    glow: SkyGlow | None = None  # what the sky sends besides `sky`, leaning to the sun
    wind_speed: float = 0.0  # [m s-1] that raises waves

    @property
    def sky_radiance(self) -> float:
        """Radiance of the uniform sky that gives a horizontal surface the same irradiance."""
        sine = _sines()
        even = float(np.trapezoid(self.sky * sine, sine) / np.trapezoid(sine, sine))
        return even if self.glow is None else even + self.glow.irradiance / PI

    @property
    def brightest_glow(self) -> float:
        """Most that the sky sends besides `sky`."""
        return 0.0 if self.glow is None else float(self.glow.gradation.max() * self.glow.indicatrix.max())

    def sky_table(self) -> LookupTable:
        """Sky radiance against the sine of the elevation, for the background.

        The sine is a view's upward component. An arc sine in the shader would cost 7 mK: drivers approximate it.
        """
        return _table("sky_radiance", "Radiance", 0.0, self.sky)

    def mirror_tables(self, *, emissive: bool) -> dict[str, FloatArray]:
        """How the reflectance of each kind of gloss rises with the angle, and what it shows: tables of `mirror`."""
        if emissive:
            return {"rise_table": rise_table(), "mirror_table": mirror_table(self.sky, self.ground_radiance)}
        shown = glow_mirror_table(self.sky, self.ground_radiance, self.glow, self.wind_speed)
        return {"rise_table": facet_table(self.wind_speed), "mirror_table": shown}

    def glow_tables(self) -> tuple[LookupTable, LookupTable]:
        """Gradation of the sky's glow by the sine of the elevation, its indicatrix by the cosine from the sun."""
        none = SkyGlow(gradation=np.zeros(SKY_ENTRIES), indicatrix=np.zeros(INDICATRIX_ENTRIES), irradiance=0.0)
        glow = none if self.glow is None else self.glow
        return (
            _table("sky_gradation", "Radiance", 0.0, glow.gradation),
            _table("sky_indicatrix", "Ratio", -1.0, glow.indicatrix),
        )


def dark() -> Illumination:
    """No light at all: what tables are laid out with before the first moment."""
    return Illumination(
        sun_direction=np.array([0.0, 0.0, 1.0]), beam=0.0, quadrant=np.zeros(4), sky=np.zeros(SKY_ENTRIES),
        ground_radiance=0.0, air=clear_path(),
    )  # fmt: skip


def _table(name: str, quantity: str, lowest: float, values: FloatArray) -> LookupTable:
    return LookupTable(name=name, quantity=quantity, argument="Ratio", minimum=lowest, maximum=1.0, values=values)


def illuminate(
    sensor: Sensor,
    sample: EnvironmentSample,
    ground_temperature: float,
    table: BandTable | None,
    *,
    atmosphere: str = DEFAULT_ATMOSPHERE,
    camera_height: float = 0.0,
) -> Illumination:
    """Surroundings of a moment as `sensor` sees them from a height [m]; `table` is its band's, if it is emissive.

    InputError for an atmosphere that is unknown or that this moment is not covered by.
    """
    around = _reflective(sample) if table is None else _emissive(sample, ground_temperature, table)
    air = air_path(
        atmosphere, sensor, sample, table, beam=around.beam, sky_radiance=around.sky_radiance,
        ground_radiance=around.ground_radiance, camera_height=camera_height,
    )  # fmt: skip
    return replace(around, air=air)


def _emissive(sample: EnvironmentSample, ground_temperature: float, table: BandTable) -> Illumination:
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
        air=clear_path(),
    )


def _reflective(sample: EnvironmentSample) -> Illumination:
    diffuse = float(np.sum(sample.nir_quadrant))
    by_moon = sample.moon_beam > sample.nir_beam
    light, beam = (sample.moon_direction, sample.moon_beam) if by_moon else (sample.sun_direction, sample.nir_beam)
    lit = light[2] > 0.0 and (beam > 0.0 or sample.sun_elevation > 0.0)  # else no one knows where the light comes from
    clear = diffuse * (1.0 - sample.cloud_cover) if lit else 0.0
    received = beam * max(float(light[2]), 0.0) + diffuse
    return Illumination(
        sun_direction=light,
        beam=beam,
        quadrant=sample.nir_quadrant,
        sky=overcast_radiance(diffuse - clear, SKY_ENTRIES) if lit else np.full(SKY_ENTRIES, diffuse / PI),
        ground_radiance=sample.ground_albedo * received / PI,
        air=clear_path(),
        glow=clear_glow(clear, light, SKY_ENTRIES) if lit else None,
        wind_speed=sample.wind_speed,
    )


def _sines() -> FloatArray:
    return np.linspace(0.0, 1.0, SKY_ENTRIES)


LIGHT = ("atmosphere", "reflected_sun")  # effects of a frame that are left out of its surroundings themselves


@lru_cache(maxsize=16)
def seen_with(illumination: Illumination, plan: EffectPlan) -> Illumination:
    """The surroundings by a plan, without its air or the sun's light on surfaces; the same ones for the same."""
    if not plan.has("atmosphere"):
        illumination = replace(illumination, air=clear_path())
    return illumination if plan.has("reflected_sun") else replace(illumination, beam=0.0)
