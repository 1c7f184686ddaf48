"""Which effects one frame calls for, once its camera, its moment and the world's tables are known."""

import numpy as np

from sensorsim.effects import (
    DEFAULT_NOISE,
    EFFECTS,
    FRAME,
    NOISE_SHARE,
    Ledger,
    Look,
    applicable,
    decide,
    emissive_bounds,
    reflective_bounds,
    reflective_tolerance,
)
from sensorsim.radiometry import BandTable
from sensorsim.render.camera import Camera
from sensorsim.render.illumination import Illumination
from sensorsim.render.ranges import ground_range, longest_range
from sensorsim.render.world import World


def frame_ledger(
    world: World, table: BandTable | None, camera: Camera, size: tuple[int, int], illumination: Illumination
) -> Ledger:
    """The world's ledger and the effects of one frame; `table` is that of the band of an emissive sensor."""
    effects = tuple(effect for effect in EFFECTS if effect.stage == FRAME)
    look = _look(world, camera, size, illumination)
    sky = world.tables.settings.sky
    if table is None:
        rows = decide(
            applicable(effects, sky=sky, mode="reflective"), reflective_bounds(look), world.choice,
            tolerance=reflective_tolerance(look), unit="W m-2 sr-1",
        )  # fmt: skip
    else:
        rows = decide(
            applicable(effects, sky=sky, mode="emissive"), emissive_bounds(look, table), world.choice,
            tolerance=DEFAULT_NOISE * NOISE_SHARE, unit="K", spent=world.ledger.spent,
        )  # fmt: skip
    return world.ledger.with_rows(rows)


def _look(world: World, camera: Camera, size: tuple[int, int], illumination: Illumination) -> Look:
    return Look(
        normal=world.scene.surfaces.normal,
        emissivity=world.assignment.emissivity,
        reflectance=world.assignment.nir_reflectance,
        coldest=world.limits.coldest,
        warmest=world.limits.greatest,
        longest_range=longest_range(camera, size, world.scene.mesh),
        ground_range=ground_range(camera, size),
        sun_direction=np.asarray(illumination.sun_direction),
        beam=illumination.beam,
        quadrant=np.asarray(illumination.quadrant),
        sky_radiance=illumination.sky_radiance,
        ground_radiance=illumination.ground_radiance,
        air_radiance=illumination.air_radiance,
        attenuation=illumination.attenuation,
    )
