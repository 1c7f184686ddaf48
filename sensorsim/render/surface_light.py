"""What whole surfaces send at a moment, on the processor: temperature and radiance of those that a frame sees.

What does not vary within a surface is computed once for each moment, and only for surfaces that are in a picture: the
cost follows what is visible. The equations are those of shaders/radiance/emitted.glsl, reflected.glsl and
glossy.glsl.
"""

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import PI
from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.materials.facets import ANGLE_ENTRIES
from sensorsim.radiometry import BandTable
from sensorsim.render.illumination import Illumination
from sensorsim.render.mirror import facet_table
from sensorsim.render.solids import Solids
from sensorsim.render.surface_table import SurfaceRows
from sensorsim.render.world import World
from sensorsim.tables.shade import shade

FloatArray = NDArray[np.float64]
Single = NDArray[np.float32]


class SurfaceLight:
    """Radiances of a world's surfaces in one band, of the moment that was asked for last."""

    def __init__(self, world: World, rows: SurfaceRows, band_table: BandTable | None) -> None:
        self.world, self.rows, self.band_table = world, rows, band_table
        count = rows.wall_type.size
        # Matt: radiance. Glossy: black body's and emissivity; in reflective bands what scatters, a facet's reflectance.
        self.sent = np.zeros((count, 2), np.float32)
        self.known = np.zeros(count, np.bool_)
        self.moment: tuple[float, Illumination] | None = None

    def settle(self, time_of_day: float, illumination: Illumination, seen: NDArray[np.bool_]) -> Single:
        """What surfaces send (s, 2) at a time of the image day [s], true for those `seen` (s,)."""
        if self.moment is None or self.moment[0] != time_of_day or self.moment[1] is not illumination:
            self.moment = time_of_day, illumination
            self.known[:] = False
        new = np.flatnonzero(seen & ~self.known)
        if new.size:
            self.sent[new] = self._sent(new, time_of_day, illumination)
            self.known[new] = True
        return self.sent

    def _sent(self, row: NDArray[np.int64], time_of_day: float, illumination: Illumination) -> FloatArray:
        rows = self.rows
        normal, sent = rows.normal[row], np.zeros((row.size, 2))
        if self.band_table is None:
            sent[:, 0] = reflected(illumination, rows.nir_reflectance[row], normal, rows.quarters[row])
            held = row[rows.gloss[row] >= 0]
            if held.size:
                sent[rows.gloss[row] >= 0] = np.stack([scattered(illumination, rows, held), rows.facet[held]], axis=1)
            return sent
        black = self.band_table.radiance_at(self._temperature(row, time_of_day))
        glossy = rows.gloss[row] >= 0
        sent[:, 0] = np.where(glossy, black, matt(illumination, black, rows.emissivity[row], normal))
        sent[:, 1] = rows.normal_emissivity[row]
        return sent

    def _temperature(self, row: NDArray[np.int64], time_of_day: float) -> FloatArray:
        """Of surfaces (r,) [K]."""
        rows = self.rows
        place = rows.corner[row], rows.weight[row]
        found = shade(
            self.world.tables.at(time_of_day), place, rows.normal[row], rows.wall_type[row], rows.reflectance[row]
        )
        if self.world.offsets is not None:
            found = found + self.world.offsets.at(time_of_day, self.known.size)[row]
        return found


def of_solids(
    solids: Solids, around: Illumination, band_table: BandTable | None, plan: EffectPlan = EVERYTHING
) -> FloatArray:
    """Radiance (t,) [W m-2 sr-1] that the triangles of solids send, all of them matt."""
    if band_table is None:
        return reflected(around, solids.reflectance, solids.normal, solids.quarters)
    black = band_table.radiance_at(solids.temperature)
    if not plan.has("reflected_sky"):
        return np.asarray(solids.emissivity * black)
    return matt(around, black, solids.emissivity, solids.normal)


def matt(around: Illumination, black: FloatArray, emissivity: FloatArray, normal: FloatArray) -> FloatArray:
    """Radiance of surfaces that emit and reflect sky and ground by their view factors, `black` a black body's."""
    share = 0.5 * (1.0 + normal[:, 2])
    mirrored = around.ground_radiance + share * (around.sky_radiance - around.ground_radiance)
    return np.asarray(mirrored + emissivity * (black - mirrored))


def reflected(around: Illumination, reflectance: FloatArray, normal: FloatArray, quarters: FloatArray) -> FloatArray:
    """Radiance of Lambertian surfaces in a reflective band: direct sun, four quarters of the sky, sunlit ground."""
    direct = around.beam * np.maximum(normal @ around.sun_direction, 0.0)
    return np.asarray(reflectance * (direct + diffuse(around, normal, quarters)) / PI)


def diffuse(around: Illumination, normal: FloatArray, quarters: FloatArray) -> FloatArray:
    """Irradiance of surfaces by four quarters of the sky and the sunlit ground [W m-2]."""
    from_ground = PI * around.ground_radiance * 0.5 * (1.0 - normal[:, 2])
    return np.asarray(4.0 * (quarters @ around.quadrant) + from_ground)


def scattered(around: Illumination, rows: SurfaceRows, held: NDArray[np.int64]) -> FloatArray:
    """Radiance that glossy surfaces scatter from below their facets, seen along the normal."""
    table, kinds, cosine = facet_table(around.wind_speed), rows.gloss[held], np.linspace(0.0, 1.0, ANGLE_ENTRIES)
    normal = rows.normal[held]
    sun = np.maximum(normal @ around.sun_direction, 0.0)
    rise = np.array([np.interp(angle, cosine, table[kind, :-1]) for angle, kind in zip(sun, kinds, strict=True)])
    direct = around.beam * sun * (1.0 - rise) / table[kinds, -1]
    share = rows.nir_reflectance[held] - rows.facet[held]
    return np.asarray(share * (direct + diffuse(around, normal, rows.quarters[held])) / PI)
