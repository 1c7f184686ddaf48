"""From the numbers of the surfaces that pixels show to light: what whole surfaces send, then row by row the rest."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment import clear_path
from sensorsim.radiometry import BandTable
from sensorsim.render.air_kernel import GENTLE
from sensorsim.render.camera import Camera
from sensorsim.render.illumination import Illumination
from sensorsim.render.pixel_kernels import find_runs, light_rows
from sensorsim.render.planes import Planes, triangle_planes
from sensorsim.render.solids import Solids
from sensorsim.render.surface_light import SurfaceLight, of_solids
from sensorsim.render.surface_table import SurfaceRows
from sensorsim.render.world import World

Single = NDArray[np.float32]
Work = Callable[[int, int], None]  # on rows from the first to before the last
_NO_PLANES, _NONE_SENT = np.zeros((0, 8)), np.zeros((0, 2), np.float32)


class QuickLight:
    """Light of a world's pictures of one size in one band; `each` shares rows among threads."""

    def __init__(
        self, world: World, size: tuple[int, int], rows: SurfaceRows, planes: Planes, band_table: BandTable | None,
        each: Callable[[int, Work], None],
    ) -> None:  # fmt: skip
        self.planes, self.each = planes, each
        self.surfaces = SurfaceLight(world, rows, band_table)
        self.gloss, self.emissive = rows.gloss, band_table is not None
        up = world.scene.mesh.position[:, 2]
        self.heights = np.array([up.min(), up.max(), 0.0])  # [m] between which all lies, the endless ground too
        self.ends = np.zeros((size[1], size[0]), np.int32)
        self.around: tuple[NDArray[np.float32], ...] = ()
        self.lit: Illumination | None = None

    def fill(
        self, numbers: Single, camera: Camera, time_of_day: float, illumination: Illumination, solids: Solids | None,
        light: Single, surface: NDArray[np.bool_],
    ) -> None:  # fmt: skip
        """Band radiance (height, width) and where a surface is seen, from the top, of numbers from the lowest row."""
        self._look_around(illumination)
        planes, sent = _NO_PLANES, _NONE_SENT
        if solids is not None:
            planes = triangle_planes(solids.triangles)
            sent = np.zeros((len(planes), 2), np.float32)
            sent[:, 0] = of_solids(solids, illumination, self.surfaces.band_table)
        seen, ends = np.zeros(self.gloss.size + len(planes) + 1, np.bool_), self.ends
        self.each(len(numbers), lambda first, last: find_runs(numbers, first, last, ends, seen))
        settled = self.surfaces.settle(time_of_day, illumination, seen[1 : self.gloss.size + 1])
        eye = np.asarray(camera.position, np.float64)
        heights = self.heights if solids is None else np.append(self.heights, solids.triangles[:, :, 2])
        most = float(np.max(np.abs(heights - eye[2])))  # [m] of any rise
        rays = np.stack(camera.view_rays((numbers.shape[1], numbers.shape[0])))
        both, all_sent, air = (self.planes, planes), (settled, sent), _air_terms(illumination, camera, most)
        self.each(
            len(numbers),
            lambda first, last: light_rows(
                numbers, ends, rays, eye, both, all_sent, self.gloss, self.around, air, first, last, light, surface
            ),
        )

    def _look_around(self, illumination: Illumination) -> None:
        """Sky, its glow and what glossy surfaces mirror, of new surroundings."""
        if illumination is self.lit:
            return
        self.lit, glow = illumination, illumination.glow
        none, lone = np.zeros(0), np.zeros((1, 2))
        tables = {"rise_table": lone, "mirror_table": lone}
        if np.any(self.gloss >= 0):
            tables = illumination.mirror_tables(emissive=self.emissive)
        light = [illumination.ground_radiance] + ([] if self.emissive else [illumination.beam])
        around = (
            illumination.sky,
            none if glow is None else glow.gradation,
            none if glow is None else glow.indicatrix,
            tables["rise_table"],
            tables["mirror_table"],
            np.array(light),
        )
        self.around = tuple(np.ascontiguousarray(table, np.float32) for table in around)


def _air_terms(illumination: Illumination, camera: Camera, most: float) -> tuple[Single, NDArray[np.float64]]:
    """Terms (k, 7) of air for rises of `most` [m], none without air; the sun's direction and the asymmetry (4,)."""
    if illumination.air is clear_path():
        return np.zeros((0, 7), np.float32), np.append(illumination.sun_direction, 0.0)
    height = float(camera.position[2])
    air = illumination.air.seen_from(height)
    source, slope = air.source_at(height)
    extinction = air.coefficient * np.exp(-height * air.inverse_scale_height)
    gentle = np.abs(air.inverse_scale_height) * most < GENTLE
    terms = np.stack([extinction, air.weight, air.inverse_scale_height, source, slope, air.beam_source, gentle], axis=1)
    used = terms[air.weight > 0.0]
    return np.ascontiguousarray(used, np.float32), np.append(illumination.sun_direction, air.asymmetry)
