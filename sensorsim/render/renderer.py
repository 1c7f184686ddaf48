"""One frame as an ordered list of passes: surfaces, background, read-back, window, display."""

from collections.abc import Callable, Collection
from types import TracebackType
from typing import Any, Self

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.effects import EFFECTS, SURFACE, EffectPlan, Ledger
from sensorsim.environment import EnvironmentSample
from sensorsim.errors import InputError, NumericsError
from sensorsim.gpu import create_context, mesh_buffers, render_target
from sensorsim.radiometry import build_band_table
from sensorsim.render.air import DEFAULT_ATMOSPHERE, air_values, check_atmosphere
from sensorsim.render.blocks import AIR, VIEW_FRAME, view_frame
from sensorsim.render.camera import Camera
from sensorsim.render.detail import DetailRule
from sensorsim.render.display_stage import DisplayStage
from sensorsim.render.frame_effects import frame_ledger, world_extremes
from sensorsim.render.illumination import LIGHT, Illumination, illuminate, seen_with
from sensorsim.render.level_of_detail import LevelOfDetail
from sensorsim.render.moment import MomentTables
from sensorsim.render.nearest import Nearest
from sensorsim.render.passes import TEXTURE_UNITS
from sensorsim.render.picture import QUANTITIES, Picture, exposed, wanted_planes
from sensorsim.render.quick_road import QuickRoad, quick_planes
from sensorsim.render.sensor_chain import SensorChain
from sensorsim.render.solids import SolidPass, Solids
from sensorsim.render.surface_light import of_solids
from sensorsim.render.surface_table import surface_codes, surface_rows
from sensorsim.render.variants import Programs
from sensorsim.render.world import World, require_temperature
from sensorsim.sensor import (
    SHARP,
    AutoGain,
    DisplaySettings,
    Sensor,
    column_places,
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

        Planes: display, radiance [W m-2 sr-1], surface_temperature [K], range [m], surface_id, feature, material (its
        code), in emissive bands apparent_temperature [K], and of a sensor with a detector its signal [W m-2 sr-1] and
        raw counts, of the frame of that number; all that the effects leave, or those asked for. Display alone takes a
        quicker road where no effect is refused but air and direct light: see `quick_frame`; its codes may differ by
        one. `illumination` replaces that of the moment. `solids` stand among the surfaces; their ids follow on those of
        the scene.
        """
        wanted = wanted_planes(self.sensor, planes)
        if illumination is None:
            illumination = self._surroundings(time_of_day, float(camera.position[2]))
        chosen = self.sensor.display if display is None else display
        self.watch("moment")
        with self.ctx:  # another renderer's context may have become the current one
            self._begin(frame, time_of_day)
            road, ledger = self._quick_road() if wanted == {"display"} else None, None
            self._level.look(camera, None if self._quick is None else self._quick.frame)
            if road is not None:
                illumination = seen_with(illumination, self._unlit)
                codes, settings = road.show(camera, time_of_day, illumination, chosen, frame, solids, self.watch)
                found: dict[str, NDArray[Any]] = {"display": codes}
            else:
                ledger = self.ledger(camera, time_of_day, illumination)
                plan, illumination = ledger.plan, seen_with(illumination, ledger.plan)
                self._solids.solids = solids
                self._moment.set(time_of_day, illumination, plan)
                self._set_view(camera, illumination)
                found, settings = self._show_all(camera, chosen, frame, wanted, plan, illumination)
        return Picture(
            planes=found, display=settings, time_of_day=time_of_day, camera=camera, illumination=illumination,
            ledger=ledger, count_step=None if road or self._chain is None else self._chain.step,
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

    def _surroundings(self, time_of_day: float, height: float) -> Illumination:
        """As `illuminate`, or what was found last where only a camera moved that the air does not mind."""
        if self._own is None or self._own[0] != time_of_day or self.atmosphere == "modtran":
            self._own = time_of_day, self.illuminate(time_of_day, height)
        return self._own[1]

    def _build(self) -> None:
        ctx, mesh = self.ctx, self.world.scene.mesh
        self._box, self._near = (mesh.position.min(axis=0), mesh.position.max(axis=0)), Nearest(mesh)
        self._moment = MomentTables(ctx, self.world, self.band_table)
        vertices = {"position": mesh.position.astype(np.float32), "surface": mesh.surface}
        buffers, emissive = mesh_buffers(ctx, vertices, mesh.triangle), self.band_table is not None
        self._level = LevelOfDetail(self.world.scene, self.size, self.detail, buffers.index)
        self._programs = Programs(ctx, buffers, self._moment.generated, emissive=emissive)
        choice = self.world.choice
        self._off = {part for part in sensor_parts(self.sensor) if choice.asked(part) is False}
        left = {one.name for one in EFFECTS if one.stage != SURFACE and choice.asked(one.name) is False}
        self._may_be_quick, self._unlit = left <= set(LIGHT), EffectPlan(off=tuple(left.intersection(LIGHT)))
        self._solids = SolidPass(ctx, self.world.scene.surfaces.area.size)
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
        least = self._near.distance(camera.position) if self._solids.solids is None else 0.0
        self._blocks["ViewFrame"].write(view_frame(camera, self.size, *self._solids.box(*self._box), least))
        air = air_values(illumination.air, float(camera.position[2]), illumination.sun_direction)
        self._blocks["Air"].write(AIR.pack(**air))
        self._bind()

    def _quick_road(self) -> QuickRoad | None:
        """The road of frames for display alone; None where an effect is refused or a surface is not flat."""
        if self._quick is None and self._may_be_quick:
            planes = quick_planes(self.world)
            self._may_be_quick = planes is not None
            if planes is not None:
                count = self.world.scene.surfaces.area.size
                self._quick = QuickRoad(
                    self.ctx, self.world, self.sensor, self.size, surface_rows(self._moment.records, count), planes,
                    self.band_table, self._gain, self._near, samples=self.samples, energy=self.blur_energy,
                )  # fmt: skip
        return self._quick

    def _show_all(
        self,
        camera: Camera,
        display: DisplaySettings,
        frame: int,
        wanted: set[str],
        plan: EffectPlan,
        illumination: Illumination,
    ) -> tuple[dict[str, NDArray[Any]], DisplaySettings]:
        self._draw(plan, illumination)
        planes = self._read(camera, wanted, plan)
        self._detect(camera, planes, frame)
        seen = exposed(planes)
        settings = self._gain.window(display, seen)
        shown = self._target.texture("quantities") if self._chain is None else self._chain.texture
        planes["display"] = self._screen.show(shown, settings, self._gain.curve(settings, seen))
        return {name: plane for name, plane in planes.items() if name in wanted}, settings

    def _draw(self, plan: EffectPlan, illumination: Illumination) -> None:
        self._target.use()
        self._target.clear_depth()
        self.ctx.enable_only(moderngl.NOTHING)
        self._programs.background(plan).draw()
        self.ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        self._programs.surfaces(plan).draw()
        if self._solids.solids is not None:
            self._solids.draw(of_solids(self._solids.solids, illumination, self.band_table, plan))

    def _bind(self) -> None:
        for block in _BLOCKS:
            self._blocks[block.name].bind_to_uniform_block(block.binding)
        self._moment.bind()
        self._target.texture("quantities").use(TEXTURE_UNITS["radiance_picture"])

    def _read(self, camera: Camera, wanted: set[str], plan: EffectPlan) -> dict[str, NDArray[Any]]:
        quantities = self._target.read("quantities")
        if not np.all(np.isfinite(quantities)):
            raise NumericsError(f"frame of {self.sensor.name}: a pixel is not finite")
        places = self._places(camera)
        planes: dict[str, NDArray[Any]] = {
            name: np.ascontiguousarray(quantities[*places, component])
            for component, name in enumerate(QUANTITIES)
            if name != "surface_temperature" or plan.has("temperature")
        }
        surface = np.ascontiguousarray(self._target.read("id")[*places, 0])
        planes["surface_id"] = surface
        feature, material = self.world.scene.surfaces.feature, surface_codes(self.world.assignment)
        row = np.where(surface < 0, feature.size, np.minimum(surface, feature.size))
        for name, known in (("feature", feature), ("material", material)):
            planes[name] = np.append(known, -1)[row].astype(np.int32)  # -1 for what is no surface of the scene
        if self.band_table is not None and "apparent_temperature" in wanted:
            planes["apparent_temperature"] = self.band_table.apparent_temperature(planes["radiance"])
        return planes

    def _places(self, camera: Camera) -> tuple[slice, slice | NDArray[np.int64]]:
        """Rows and columns of the drawn picture that the pixels look at: each shows what its middle sees."""
        middle = slice(self.samples // 2, None, self.samples)
        if self._chain is None or not self.sensor.scan.equal_angle:
            return middle, middle
        field = float(np.radians(camera.horizontal_field_of_view))
        return middle, column_places(self.size[0], self.samples, field, equal_angle=True).astype(np.int64)

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
