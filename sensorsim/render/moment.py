"""What a moment of the day is to the shaders: tables of walls and sky as textures, light as a block.

They are written again only where the clock or the surroundings have changed: a camera that flies costs nothing here,
and a clock that moves one slice of the tables, interpolated, with nothing solved.
"""

from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.effects import EffectPlan
from sensorsim.gpu import float_table, update_table
from sensorsim.radiometry import BandTable
from sensorsim.render.blocks import ILLUMINATION
from sensorsim.render.illumination import Illumination, dark
from sensorsim.render.mirror import mirror_glsl
from sensorsim.render.passes import TEXTURE_UNITS
from sensorsim.render.surface_table import set_offsets, surface_table
from sensorsim.render.world import World
from sensorsim.tables import LookupTable
from sensorsim.tables.coefficient_texture import HEAD, coefficient_glsl, shade_texels


class MomentTables:
    """Textures and light of one world in one band; `number` counts the moments that they have held."""

    def __init__(self, ctx: moderngl.Context, world: World, band_table: BandTable | None) -> None:
        self.world, self.number, self.emissive = world, 0, band_table is not None
        self.time_of_day = -1.0  # [s] that the tables of walls are of
        self.illumination: Illumination | None = None
        self.uploaded = 0  # [byte] since the beginning
        self.mirrors = False  # whether the last frame has called for what surfaces mirror
        surfaces = world.scene.surfaces
        self.records = surface_table(surfaces.normal, surfaces.feature, world.assignment, world.tables.orientations)
        band, skies = _band_lookup(band_table), (dark().sky_table(), *dark().glow_tables())
        texels: dict[str, NDArray[Any]] = {
            "surface_table": self.records,
            "band_radiance_table": band.texels,
            **{f"{table.name}_table": table.texels for table in skies},
            **dark().mirror_tables(emissive=self.emissive),
            **_known(shade_texels(world.tables, 0.0)),
        }
        self.textures = {name: float_table(ctx, name, values) for name, values in texels.items()}
        lobes = world.tables.lobes
        self.most = 0 if lobes is None else self.textures["lobe_table"].width - HEAD  # of them at any time
        self.block = ctx.buffer(reserve=ILLUMINATION.dtype.itemsize)
        self.generated = {
            "coefficients": coefficient_glsl(world.tables.coefficients.shape[-1], world.tables.settings.knot),
            "band_radiance": band.glsl(),
            **{table.name: table.glsl() for table in skies},
            "mirror_size": mirror_glsl(),
        }

    def bind(self) -> None:
        """Make the shaders see all of it."""
        self.block.bind_to_uniform_block(ILLUMINATION.binding)
        for name, texture in self.textures.items():
            texture.use(TEXTURE_UNITS[name])

    def set(self, time_of_day: float, illumination: Illumination, plan: EffectPlan) -> None:
        """Upload what a time of the image day [s] and its surroundings have changed, if the plan calls for it."""
        if plan.has("specular") != self.mirrors:
            self.mirrors, self.illumination = not self.mirrors, None
        if time_of_day == self.time_of_day and illumination is self.illumination:
            return
        if time_of_day != self.time_of_day and plan.has("temperature"):
            self._set_walls(time_of_day)
        if illumination is not self.illumination:
            self._set_light(illumination)
        self.time_of_day, self.illumination = time_of_day, illumination
        self.number += 1

    def _set_walls(self, time_of_day: float) -> None:
        offsets = self.world.offsets
        if offsets is not None:
            set_offsets(self.records, offsets.at(time_of_day, self.world.scene.surfaces.area.size))
            self._update("surface_table", self.records)
        for name, texels in _known(shade_texels(self.world.tables, time_of_day, most=self.most)).items():
            self._update(name, texels)

    def _set_light(self, illumination: Illumination) -> None:
        for table in (illumination.sky_table(), *illumination.glow_tables()):
            self._update(f"{table.name}_table", table.texels)
        if self.mirrors:
            for name, texels in illumination.mirror_tables(emissive=self.emissive).items():
                self._update(name, texels)
        self.block.write(
            ILLUMINATION.pack(
                quadrant=illumination.quadrant,
                sun_direction=illumination.sun_direction,
                beam=illumination.beam,
                sky_radiance=illumination.sky_radiance,
                ground_radiance=illumination.ground_radiance,
                mirrors=float(self.mirrors),
            )
        )

    def _update(self, name: str, texels: NDArray[Any]) -> None:
        update_table(self.textures[name], texels)
        self.uploaded += 4 * texels.size


def _band_lookup(table: BandTable | None) -> LookupTable:
    """Band radiance against temperature; reflective bands compile it but never read it."""
    return LookupTable(
        name="band_radiance",
        quantity="Radiance",
        argument="Kelvin",
        minimum=150.0 if table is None else float(table.temperature[0]),
        maximum=700.0 if table is None else float(table.temperature[-1]),
        values=np.zeros(2) if table is None else table.radiance,
    )


def _known(texels: dict[str, NDArray[np.float32]]) -> dict[str, NDArray[np.float32]]:
    """Texels with zeros for what was not solved, NaN from the first component on, which no surface reads."""
    return {name: np.where(np.isnan(values[..., :1]), np.float32(0.0), values) for name, values in texels.items()}
