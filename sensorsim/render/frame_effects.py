"""Which effects one frame calls for, once its camera, its moment and the world's tables are known."""

from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import PI
from sensorsim.effects import (
    EFFECTS,
    FRAME,
    AirBefore,
    EffectChoice,
    Gleam,
    Ledger,
    LedgerRow,
    Limits,
    Look,
    Mirrors,
    applicable,
    decide,
    emissive_bounds,
    reflective_bounds,
    reflective_tolerance,
    sensor_bounds,
    signal_tolerance,
)
from sensorsim.radiometry import BandTable, build_band_table
from sensorsim.render.air import DEFAULT_ATMOSPHERE
from sensorsim.render.camera import Camera
from sensorsim.render.glossy_view import gleam_in_view
from sensorsim.render.illumination import Illumination, illuminate
from sensorsim.render.mirror import gloss_records, rise_table
from sensorsim.render.ranges import ground_range, half_field, in_view
from sensorsim.render.surface_table import surface_codes
from sensorsim.render.survey import Survey, tolerance_of
from sensorsim.render.world import World
from sensorsim.scene import Scene
from sensorsim.sensor import Sensitivity, Sensor, sensitivity, sensor_parts
from sensorsim.tables import surface_temperature
from sensorsim.tables.assign import Assignment
from sensorsim.thermal import ground_temperature

SHORT = 0.02  # [-] opacity of a path below which leaving it out is worth a closer look


class Decided(Protocol):
    """A scene whose effects of the surface are decided: a survey, or a world."""

    @property
    def scene(self) -> Scene: ...  # noqa: D102
    @property
    def assignment(self) -> Assignment: ...  # noqa: D102
    @property
    def choice(self) -> EffectChoice: ...  # noqa: D102
    @property
    def ledger(self) -> Ledger: ...  # noqa: D102
    @property
    def limits(self) -> Limits: ...  # noqa: D102


def frame_ledger(
    decided: Decided, sensor: Sensor, table: BandTable | None, camera: Camera, size: tuple[int, int],
    illumination: Illumination, *, extremes: Callable[[], tuple[float, float]] | None = None,
) -> Ledger:  # fmt: skip
    """The ledger with the effects of one frame; `table` is that of the band of an emissive sensor.

    `extremes` gives the coldest and the warmest surface of the moment [K], where they are known. It is called only
    where the path is so short that the limits of all times might be too wide for it.
    """
    look = _look(decided, camera, size, illumination, emissive=table is not None)
    mode = "reflective" if table is None else "emissive"
    effects = applicable((effect for effect in EFFECTS if effect.stage == FRAME), sky="", mode=mode)
    if table is None:
        rows = decide(
            effects, reflective_bounds(look), decided.choice, tolerance=reflective_tolerance(look), unit="W m-2 sr-1"
        )
    else:
        if extremes is not None and look.air.worst_opacity < SHORT:
            coldest, warmest = extremes()
            look = replace(look, coldest=coldest, warmest=warmest)
        mirrored = decided.choice.asked("reflected_sky") is not False
        rows = decide(
            effects, emissive_bounds(look, table, mirrored=mirrored), decided.choice,
            tolerance=_noise_of(sensor, decided.choice)[0], unit="K", spent=decided.ledger.spent,
        )  # fmt: skip
    return decided.ledger.with_rows((*rows, *_chain_rows(decided.choice, sensor, look, table)))


def _chain_rows(choice: EffectChoice, sensor: Sensor, look: Look, table: BandTable | None) -> tuple[LedgerRow, ...]:
    """Rows of the parts of a sensor's chain; none for an ideal sensor."""
    parts, state = sensor_parts(sensor), _noise_of(sensor, choice)[1]
    if state is None:
        return ()
    if table is None:
        lit = (look.beam + 4.0 * float(look.quadrant.sum())) / PI + look.ground_radiance
        brightest = lit + look.sky_range[1] + look.air.brightest + look.gleam.sent
    else:
        brightest = float(table.radiance[-1])  # a frame beyond is refused
    bounds = sensor_bounds(parts, state, brightest=brightest, pixels=look.pixels)
    effects = tuple(effect for effect in EFFECTS if effect.name in parts)
    return decide(effects, bounds, choice, tolerance=signal_tolerance(state), unit="W m-2 sr-1")


@lru_cache(maxsize=16)
def _noise_of(sensor: Sensor, choice: EffectChoice) -> tuple[float, Sensitivity | None]:
    """Tolerance [K] and sensitivity of a sensor, which ask for integrals over its band: None of an ideal one."""
    return tolerance_of(sensor, choice), None if sensor.detector is None else sensitivity(sensor)


def world_extremes(world: World, time_of_day: float) -> tuple[float, float]:
    """Coldest and warmest surface of a baked scene [K] at a time of the image day [s]."""
    surfaces, assignment = world.scene.surfaces, world.assignment
    found = surface_temperature(
        world.tables, surfaces.normal, assignment.wall_type, assignment.reflectance, time_of_day
    )
    if world.offsets is not None:
        found = found + world.offsets.at(time_of_day, found.size)
    return float(found.min()), float(found.max())


def survey_ledger(
    survey: Survey, sensor: Sensor, camera: Camera, size: tuple[int, int], time_of_day: float, *,
    atmosphere: str = DEFAULT_ATMOSPHERE,
) -> Ledger:  # fmt: skip
    """The same before anything is baked, at a time of the image day [s]; of the scene only the ground is solved."""
    table, ground = None, float("nan")
    if sensor.mode == "emissive":
        table = build_band_table(sensor.band)
        history = ground_temperature(
            survey.environment, survey.ground, sky=survey.settings.sky, plan=survey.ledger.plan
        )
        day = history[survey.environment.image_window]
        ground = float(np.interp(time_of_day / survey.environment.step, np.arange(day.size), day))
    illumination = illuminate(
        sensor, survey.environment.at(time_of_day), ground, table, atmosphere=atmosphere,
        camera_height=float(camera.position[2]),
    )  # fmt: skip
    return frame_ledger(survey, sensor, table, camera, size, illumination)


def _look(
    decided: Decided, camera: Camera, size: tuple[int, int], illumination: Illumination, *, emissive: bool
) -> Look:  # fmt: skip
    seen, assignment, sky = in_view(camera, size, decided.scene.mesh), decided.assignment, illumination.sky
    gleam = Gleam()
    if not emissive:
        gleam = gleam_in_view(decided.scene, assignment, camera, size, seen.surface, illumination)
    return Look(
        normal=decided.scene.surfaces.normal[seen.surface],
        emissivity=assignment.emissivity[seen.surface],
        reflectance=assignment.nir_reflectance[seen.surface],
        mirrors=_mirrors(assignment, seen.surface),
        gleam=gleam,
        coldest=decided.limits.coldest,
        warmest=decided.limits.greatest,
        sun_direction=np.asarray(illumination.sun_direction),
        beam=illumination.beam,
        quadrant=np.asarray(illumination.quadrant),
        sky_radiance=illumination.sky_radiance,
        sky_range=(float(sky.min()), float(sky.max()) + illumination.brightest_glow),
        ground_radiance=illumination.ground_radiance,
        air=AirBefore(
            path=illumination.air,
            camera_height=float(camera.position[2]),
            surface_heights=seen.heights,
            longest_range=seen.longest_range,
            ground_range=ground_range(camera, size),
            facing_light=_facing_light(camera, size, illumination),
        ),
        pixels=size[0] * size[1],
    )


def _facing_light(camera: Camera, size: tuple[int, int], illumination: Illumination) -> float:
    """Greatest cosine of the angle between a ray of the picture and the sun or moon [-]."""
    off = np.arccos(np.clip(float(camera.axes()[0] @ illumination.sun_direction), -1.0, 1.0))
    return float(np.cos(max(off - half_field(camera, size), 0.0)))


def _mirrors(assignment: Assignment, surface: NDArray[np.int64]) -> Mirrors:
    """Those of the surfaces that mirror."""
    glossy, whole = _all_mirrors(assignment)
    kept = np.zeros(glossy.size, dtype=np.bool_)
    kept[surface] = True
    kept = kept[glossy]
    return Mirrors(matt=whole.matt[kept], least=whole.least[kept], greatest=whole.greatest[kept])


@lru_cache(maxsize=8)
def _all_mirrors(assignment: Assignment) -> tuple[NDArray[np.bool_], Mirrors]:
    """Which surfaces (s,) of a scene mirror, and those; the same in each of its frames."""
    matt = assignment.emissivity
    record, rise = gloss_records(surface_codes(assignment), matt, assignment.nir_reflectance), rise_table()
    glossy = record[:, 0] >= 0.0
    kind, along_normal = record[glossy, 0].astype(np.int64), record[glossy, 1]
    return glossy, Mirrors(
        matt=matt[glossy],
        least=along_normal * (1.0 - rise.max(axis=1)[kind]),
        greatest=along_normal * (1.0 - rise.min(axis=1)[kind]),
    )
