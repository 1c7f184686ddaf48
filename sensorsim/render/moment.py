"""What a moment of the day is to the shaders: tables of walls and sky as textures, light as a block."""

from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.effects import EffectPlan
from sensorsim.gpu import float_table, update_table
from sensorsim.radiometry import BandTable
from sensorsim.render.blocks import ILLUMINATION
from sensorsim.render.illumination import Illumination, dark
from sensorsim.render.mirror import mirror_glsl, rise_table
from sensorsim.render.passes import TEXTURE_UNITS
from sensorsim.render.surface_table import surface_table
from sensorsim.render.world import World
from sensorsim.tables import LookupTable
from sensorsim.tables.coefficient_texture import coefficient_glsl, shade_texels


class MomentTables:
    """Textures and light of one world in one band, and the GLSL that reads them."""

    def __init__(self, ctx: moderngl.Context, world: World, band_table: BandTable | None) -> None:
        self.world, self.time_of_day = world, 0.0
        band, skies = _band_lookup(band_table), (dark().sky_table(), *dark().glow_tables())
        texels: dict[str, NDArray[Any]] = {
            "surface_table": self._records(0.0),
            "band_radiance_table": band.texels,
            **{f"{table.name}_table": table.texels for table in skies},
            "rise_table": rise_table(),
            "mirror_table": dark().mirror_table(),
            **_known(shade_texels(world.tables, self.time_of_day)),
        }
        self.textures = {name: float_table(ctx, name, values) for name, values in texels.items()}
        self.block = ctx.buffer(reserve=ILLUMINATION.dtype.itemsize)
        self.generated = {
            "coefficients": coefficient_glsl(world.tables.coefficients.shape[-1]),
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
        """Upload a time of the image day [s] and its surroundings, as far as the plan calls for them."""
        if self.world.offsets is not None:
            update_table(self.textures["surface_table"], self._records(time_of_day))
        if plan.has("temperature") and time_of_day != self.time_of_day:
            for name, texels in _known(shade_texels(self.world.tables, time_of_day)).items():
                update_table(self.textures[name], texels)
            self.time_of_day = time_of_day
        for table in (illumination.sky_table(), *illumination.glow_tables()):
            update_table(self.textures[f"{table.name}_table"], table.texels)
        if plan.has("specular"):
            update_table(self.textures["mirror_table"], illumination.mirror_table())
        self.block.write(
            ILLUMINATION.pack(
                quadrant=illumination.quadrant,
                sun_direction=illumination.sun_direction,
                beam=illumination.beam,
                sky_radiance=illumination.sky_radiance,
                ground_radiance=illumination.ground_radiance,
            )
        )

    def _records(self, time_of_day: float) -> NDArray[np.float32]:
        """Surface table at a time of the image day [s]."""
        world, surfaces = self.world, self.world.scene.surfaces
        offset = None if world.offsets is None else world.offsets.at(time_of_day, surfaces.area.size)
        return surface_table(surfaces.normal, surfaces.feature, world.assignment, world.tables.orientations, offset)


def _known(texels: dict[str, NDArray[np.float32]]) -> dict[str, NDArray[np.float32]]:
    """Texels with zeros for what was not solved (NaN), which no surface reads."""
    return {name: np.nan_to_num(values) for name, values in texels.items()}


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
