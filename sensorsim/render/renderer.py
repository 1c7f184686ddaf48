"""One frame as an ordered list of passes: surfaces, background, read-back, window, display."""

from collections.abc import Callable, Collection
from types import TracebackType
from typing import Any, Self

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.effects import EFFECTS, EVERYTHING, SURFACE, EffectPlan, Ledger
from sensorsim.environment import EnvironmentSample
from sensorsim.errors import InputError, NumericsError
from sensorsim.gpu import create_context, mesh_buffers, render_target
from sensorsim.radiometry import build_band_table
from sensorsim.render.air import DEFAULT_ATMOSPHERE, air_values, check_atmosphere
from sensorsim.render.blocks import AIR, VIEW_FRAME
from sensorsim.render.camera import Camera, clip_distances
from sensorsim.render.detail import DetailRule
from sensorsim.render.display_stage import DisplayStage
from sensorsim.render.frame_effects import frame_ledger, world_extremes
from sensorsim.render.illumination import Illumination, illuminate, seen_with
from sensorsim.render.level_of_detail import LevelOfDetail
from sensorsim.render.moment import MomentTables
from sensorsim.render.passes import TEXTURE_UNITS
from sensorsim.render.picture import QUANTITIES, Picture, exposed
from sensorsim.render.quick_road import QuickRoad
from sensorsim.render.sensor_chain import SensorChain
from sensorsim.render.solids import SolidPass, Solids
from sensorsim.render.variants import Programs
from sensorsim.render.world import World, require_temperature
from sensorsim.sensor import (
    SHARP,
    AutoGain,
    DisplaySettings,
    Sensor,
    exposure_for,
    follows_in_time,
    sensor_parts,
    sensor_without,
)

_BLOCKS = (VIEW_FRAME, AIR)


class Renderer:
    """Draws a world as one sensor sees it. Use as a context manager: it holds an OpenGL context."""

    def __init__(
        self, world: World, sensor: Sensor, *, size: tuple[int, int] | None = None, backend: str = "auto",
        samples: int = 1, blur_energy: float = 0.99, atmosphere: str = DEFAULT_ATMOSPHERE,
        detail: DetailRule | None = None,
    ) -> None:  # fmt: skip
        """`atmosphere`: 'standard', 'report', 'modtran', or 'none' for the radiance that leaves the surfaces.

        `detail` chooses among the levels of a scene that holds several.
        """
        self.atmosphere = check_atmosphere(atmosphere)
        if samples not in (1, 3, 5, 7):
            raise InputError("renderer", "samples", samples, "not 1, 3, 5 or 7", "give an odd number per pixel's side")
        if samples > 1 and sensor.detector is None:
            raise InputError("renderer", "samples", samples, f"{sensor.name} has no detector to join them", "use 1")
        self.world = world
        self.sensor = sensor
        self.size = sensor.size if size is None else size
        self.samples, self.blur_energy = samples, blur_energy
        self.detail = DetailRule() if detail is None else detail
        self.band_table = build_band_table(sensor.band) if sensor.mode == "emissive" else None
        # Told of each stage of a frame for display alone, once it is over:
        self.watch: Callable[[str], None] = lambda _stage: None
        self._quick: QuickRoad | None = None
        self._gain, self._last_time = AutoGain(1.0 / sensor.scan.frame_rate), 0.0
        self._own: tuple[float, Illumination] | None = None  # surroundings that were found last
        require_temperature(world, sensor)
        self.ctx = create_context(backend)
        try:
            self._build()
        except BaseException:
            self.release()
            raise

    def __enter__(self) -> Self:
        """The renderer itself."""
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Give back the context."""
        self.release()

    def release(self) -> None:
        """Give back the OpenGL context with everything in it."""
        if self._quick is not None:
            self._quick.release()
        self.ctx.release()

    def render(
        self, camera: Camera, time_of_day: float, *, display: DisplaySettings | None = None,
        illumination: Illumination | None = None, frame: int = 0, planes: Collection[str] | None = None,
        solids: Solids | None = None,
    ) -> Picture:  # fmt: skip
        """The picture from `camera` at a time of the image day [s].

        Planes: display, radiance [W m-2 sr-1], surface_temperature [K], range [m], surface_id, feature, in emissive
        bands apparent_temperature [K], and of a sensor with a detector its signal [W m-2 sr-1] and raw counts, of the
        frame of that number; all that the effects leave, or those asked for. Display alone takes a quicker road where
        no effect is refused: see `quick_frame`; its codes may differ by one. `illumination` replaces that of the
        moment. `solids` stand among the surfaces; their ids follow on those of the scene.
        """
        wanted = self._wanted(planes)
        if illumination is None:
            illumination = self._surroundings(time_of_day, float(camera.position[2]))
        quick = wanted == {"display"} and self._may_be_quick
        ledger = None if quick else self.ledger(camera, time_of_day, illumination)
        plan = EVERYTHING if ledger is None else ledger.plan
        illumination = seen_with(illumination, plan)
        with self.ctx:  # another renderer's context may have become the current one
            self._begin(frame, time_of_day)
            self._solids.solids = solids
            road = self._quick_road() if quick else None
            self._level.look(camera, None if self._quick is None else self._quick.frame)
            self._moment.set(time_of_day, illumination, plan)
            self._set_view(camera, illumination)
            self.watch("moment")
            chosen = self.sensor.display if display is None else display
            if road is not None:
                codes, settings = road.show(camera, chosen, frame, self._moment.number, self.watch, self._solids.draw)
                found: dict[str, NDArray[Any]] = {"display": codes}
            else:
                found, settings = self._show_all(camera, chosen, frame, wanted, plan)
        return Picture(
            planes=found, display=settings, time_of_day=time_of_day, camera=camera, illumination=illumination,
            ledger=ledger, count_step=None if quick or self._chain is None else self._chain.step,
        )  # fmt: skip

    def ledger(self, camera: Camera, time_of_day: float, illumination: Illumination) -> Ledger:
        """Which effects the picture from `camera` calls for, in these surroundings."""
        return frame_ledger(
            self.world, self.sensor, self.band_table, camera, self.size, illumination,
            extremes=lambda: world_extremes(self.world, time_of_day),
        )  # fmt: skip

    def illuminate(
        self, time_of_day: float, camera_height: float = 0.0, *, sample: EnvironmentSample | None = None
    ) -> Illumination:
        """Surroundings at a time of the image day [s] or in a `sample`, in the sensor's band, from a height [m]."""
        tables = self.world.tables
        index, share = tables.slice_of(time_of_day)
        ground = tables.ground_temperature[index : index + 2]
        temperature = float(ground[0] + share * (ground[1] - ground[0]))
        return illuminate(
            self.sensor, sample or self.world.environment.at(time_of_day), temperature, self.band_table,
            atmosphere=self.atmosphere, camera_height=camera_height,
        )  # fmt: skip

    def _wanted(self, planes: Collection[str] | None) -> set[str]:
        there = {*QUANTITIES, "surface_id", "feature", "display"}
        there |= {"signal"} if self.sensor.detector is not None else set()
        there |= {"counts"} if self.sensor.has_counts else set()
        there |= {"apparent_temperature"} if self.band_table is not None else set()
        unknown = set() if planes is None else set(planes) - there
        if unknown or (planes is not None and not planes):
            where, problem = f"sensor {self.sensor.name!r}", "not what its frames have"
            raise InputError(where, "planes", sorted(unknown), problem, f"use {', '.join(sorted(there))}")
        return there if planes is None else set(planes)

    def _surroundings(self, time_of_day: float, height: float) -> Illumination:
        """As `illuminate`, or what was found last where only a camera moved that the air does not mind."""
        if self._own is None or self._own[0] != time_of_day or self.atmosphere == "modtran":
            self._own = time_of_day, self.illuminate(time_of_day, height)
        return self._own[1]

    def _build(self) -> None:
        ctx, mesh = self.ctx, self.world.scene.mesh
        self._box = mesh.position.min(axis=0), mesh.position.max(axis=0)
        self._moment = MomentTables(ctx, self.world, self.band_table)
        vertices = {"position": mesh.position.astype(np.float32), "surface": mesh.surface}
        buffers, emissive = mesh_buffers(ctx, vertices, mesh.triangle), self.band_table is not None
        self._level = LevelOfDetail(self.world.scene, self.size, self.detail, buffers.index)
        self._programs = Programs(ctx, buffers, self._moment.generated, emissive=emissive)
        choice = self.world.choice
        self._off = {part for part in sensor_parts(self.sensor) if choice.asked(part) is False}
        self._may_be_quick = all(choice.asked(one.name) is not False for one in EFFECTS if one.stage != SURFACE)
        self._solids = SolidPass(
            ctx, self._moment.generated, emissive=emissive, first=self.world.scene.surfaces.area.size
        )
        self._build_targets()

    def _build_targets(self) -> None:
        ctx = self.ctx
        self._screen = DisplayStage(ctx, self.size)
        drawn = (self.samples * self.size[0], self.samples * self.size[1])
        self._chain = None
        if self.sensor.detector is not None:
            energy = SHARP if "blur" in self._off else self.blur_energy
            chosen = sensor_without(self.sensor, self._off)
            self._chain = SensorChain(ctx, chosen, self.size, samples=self.samples, energy=energy)
        self._target = render_target(ctx, drawn, {"quantities": "RGBA32F", "id": "R32I"}, depth=True)
        self._blocks = {block.name: ctx.buffer(reserve=block.dtype.itemsize) for block in _BLOCKS}

    def _begin(self, frame: int, time_of_day: float) -> None:
        """A frame of that number and time [s]; of one too far from that of the last nothing is remembered."""
        self._gain.begin(frame, time_of_day)
        if not follows_in_time(self.sensor, self._last_time, time_of_day):
            for chain in (self._chain, None if self._quick is None else self._quick.rows):
                if chain is not None:
                    chain.cut()
        self._last_time = time_of_day

    def _set_view(self, camera: Camera, illumination: Illumination) -> None:
        near, far = clip_distances(camera, self.size, *self._solids.box(*self._box))
        corner, right, up = camera.view_rays(self.size)
        self._blocks["ViewFrame"].write(
            VIEW_FRAME.pack(
                clip_from_camera=camera.clip_from_camera(self.size, near, far),
                camera_position=camera.position,
                view_corner=corner,
                view_right=right,
                view_up=up,
            )
        )
        air = air_values(illumination.air, float(camera.position[2]), illumination.sun_direction)
        self._blocks["Air"].write(AIR.pack(**air))
        self._bind()

    def _quick_road(self) -> QuickRoad:
        """The road of frames for display alone, made for the first of them."""
        if self._quick is None:
            self._quick = QuickRoad(
                self.ctx, self.world, self.sensor, self.size, self._moment.generated, samples=self.samples,
                energy=self.blur_energy, gain=self._gain,
            )  # fmt: skip
        return self._quick

    def _show_all(
        self, camera: Camera, display: DisplaySettings, frame: int, wanted: set[str], plan: EffectPlan
    ) -> tuple[dict[str, NDArray[Any]], DisplaySettings]:
        self._draw(plan)
        planes = self._read(wanted, plan)
        self._detect(camera, planes, frame)
        seen = exposed(planes)
        settings = self._gain.window(display, seen)
        shown = self._target.texture("quantities") if self._chain is None else self._chain.texture
        planes["display"] = self._screen.show(shown, settings, self._gain.curve(settings, seen))
        return {name: plane for name, plane in planes.items() if name in wanted}, settings

    def _draw(self, plan: EffectPlan) -> None:
        self._target.use()
        self._target.clear_depth()
        self.ctx.enable_only(moderngl.NOTHING)
        self._programs.background(plan).draw()
        self.ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        self._programs.surfaces(plan).draw()
        self._solids.draw()

    def _bind(self) -> None:
        for block in _BLOCKS:
            self._blocks[block.name].bind_to_uniform_block(block.binding)
        self._moment.bind()
        self._target.texture("quantities").use(TEXTURE_UNITS["radiance_picture"])

    def _read(self, wanted: set[str], plan: EffectPlan) -> dict[str, NDArray[Any]]:
        quantities = self._target.read("quantities")
        if not np.all(np.isfinite(quantities)):
            raise NumericsError(f"frame of {self.sensor.name}: a pixel is not finite")
        middle = slice(self.samples // 2, None, self.samples)  # each pixel shows what its middle sees
        planes: dict[str, NDArray[Any]] = {
            name: np.ascontiguousarray(quantities[middle, middle, component])
            for component, name in enumerate(QUANTITIES)
            if name != "surface_temperature" or plan.has("temperature")
        }
        surface = np.ascontiguousarray(self._target.read("id")[middle, middle, 0])
        planes["surface_id"] = surface
        feature = np.append(self.world.scene.surfaces.feature, -1)  # of what is no surface of the scene: none
        planes["feature"] = feature[np.where(surface < 0, feature.size - 1, np.minimum(surface, feature.size - 1))]
        if self.band_table is not None and "apparent_temperature" in wanted:
            planes["apparent_temperature"] = self.band_table.apparent_temperature(planes["radiance"])
        return planes

    def _detect(self, camera: Camera, planes: dict[str, NDArray[Any]], frame: int) -> None:
        """What the detector reports of the frame of that number, as plane `signal` and as the picture on display."""
        if self._chain is None:
            return
        seen = exposed(planes)
        exposure, level = exposure_for(self._chain.look, seen), float(np.mean(seen, dtype=np.float64))
        field = float(np.radians(camera.horizontal_field_of_view))
        self._chain.run(self._target.texture("quantities"), field, frame, exposure=exposure, level=level)
        planes["signal"] = self._chain.read(self._chain.output)
        if self.sensor.has_counts:
            planes["counts"] = np.rint(planes["signal"] / self._chain.step).astype(np.uint16)
