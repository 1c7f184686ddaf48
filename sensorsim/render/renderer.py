"""One frame as an ordered list of passes: surfaces, background, read-back, window, display."""

from collections.abc import Mapping
from dataclasses import dataclass
from types import TracebackType
from typing import Any, Self

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.environment import EnvironmentSample
from sensorsim.errors import InputError, NumericsError
from sensorsim.gpu import create_context, float_table, mesh_buffers, render_target, update_table
from sensorsim.radiometry import build_band_table
from sensorsim.render.air import DEFAULT_ATMOSPHERE, air_values, check_atmosphere
from sensorsim.render.blocks import AIR, DISPLAY, ILLUMINATION, VIEW_FRAME
from sensorsim.render.camera import Camera, clip_distances
from sensorsim.render.illumination import Illumination, dark, illuminate
from sensorsim.render.mirror import mirror_glsl, rise_table
from sensorsim.render.passes import TEXTURE_UNITS, background_pass, display_pass, surface_pass
from sensorsim.render.sensor_chain import SensorChain
from sensorsim.render.surface_table import surface_table
from sensorsim.render.world import World
from sensorsim.sensor import (
    TONE_ENTRIES,
    DisplaySettings,
    Sensitivity,
    Sensor,
    fix_window,
    tone_curve,
    window_limits,
)
from sensorsim.tables import LookupTable
from sensorsim.tables.coefficient_texture import coefficient_glsl, shade_texels

_BLOCKS = (VIEW_FRAME, ILLUMINATION, AIR, DISPLAY)
FILLED = 0.8  # of the detector's range, that an automatic iris aims at
QUANTITIES = ("radiance", "surface_temperature", "range")  # components of the float plane, in order


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Picture:
    """What one look yields: planes (height, width), row 0 at the top, and the display window they were shown with."""

    planes: Mapping[str, NDArray[Any]]
    display: DisplaySettings
    time_of_day: float  # [s]
    camera: Camera
    illumination: Illumination


class Renderer:
    """Draws a world as one sensor sees it. Use as a context manager: it holds an OpenGL context."""

    def __init__(
        self, world: World, sensor: Sensor, *, size: tuple[int, int] | None = None, backend: str = "auto",
        samples: int = 1, blur_energy: float = 0.99, atmosphere: str = DEFAULT_ATMOSPHERE,
    ) -> None:  # fmt: skip
        """`atmosphere`: 'standard', 'report', 'modtran', or 'none' for the radiance that leaves the surfaces."""
        self.atmosphere = check_atmosphere(atmosphere)
        if samples not in (1, 3, 5, 7):
            raise InputError("renderer", "samples", samples, "not 1, 3, 5 or 7", "give an odd number per pixel's side")
        if samples > 1 and sensor.detector is None:
            raise InputError("renderer", "samples", samples, f"{sensor.name} has no detector to join them", "use 1")
        self.world = world
        self.sensor = sensor
        self.size = sensor.size if size is None else size
        self.samples, self.blur_energy = samples, blur_energy
        self.band_table = build_band_table(sensor.band) if sensor.mode == "emissive" else None
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
        self.ctx.release()

    def render(
        self, camera: Camera, time_of_day: float, *, display: DisplaySettings | None = None,
        illumination: Illumination | None = None, frame: int = 0,
    ) -> Picture:  # fmt: skip
        """The picture from `camera` at a time of the image day [s].

        Planes: display, radiance [W m-2 sr-1], surface_temperature [K], range [m], surface_id, feature, in emissive
        bands apparent_temperature [K], and of a sensor with a detector its signal [W m-2 sr-1], of the frame of that
        number. `illumination` replaces the surroundings of the moment.
        """
        if illumination is None:
            illumination = self.illuminate(time_of_day, float(camera.position[2]))
        with self.ctx:  # another renderer's context may have become the current one
            self._set_moment(time_of_day, illumination)
            self._draw(camera, illumination)
            planes = self._read()
            self._detect(camera, planes, frame)
            settings = fix_window(self.sensor.display if display is None else display, exposed(planes))
            planes["display"] = self._display(settings, exposed(planes))
        return Picture(
            planes=planes, display=settings, time_of_day=time_of_day, camera=camera, illumination=illumination
        )

    def illuminate(
        self, time_of_day: float, camera_height: float = 0.0, *, sample: EnvironmentSample | None = None
    ) -> Illumination:
        """Surroundings at a time of the image day [s], in the sensor's band, from a camera's height [m].

        `sample` replaces the weather, sun and sky of the moment.
        """
        tables = self.world.tables
        index, share = tables.slice_of(time_of_day)
        ground = tables.ground_temperature[index : index + 2]
        temperature = float(ground[0] + share * (ground[1] - ground[0]))
        return illuminate(
            self.sensor, sample or self.world.environment.at(time_of_day), temperature, self.band_table,
            atmosphere=self.atmosphere, camera_height=camera_height,
        )  # fmt: skip

    def _build(self) -> None:
        ctx, world = self.ctx, self.world
        mesh, records = world.scene.mesh, self._records(0.0)
        band = self._band_lookup()
        skies = (dark().sky_table(), *dark().glow_tables())
        self._tables = {
            "surface_table": float_table(ctx, "surface_table", records),
            "band_radiance_table": float_table(ctx, "band_radiance_table", band.texels),
            **{f"{table.name}_table": float_table(ctx, table.name, table.texels) for table in skies},
            "rise_table": float_table(ctx, "rise_table", rise_table()),
            "mirror_table": float_table(ctx, "mirror_table", dark().mirror_table()),
        }
        self._tables_at = 0.0
        for name, texels in shade_texels(world.tables, self._tables_at).items():
            self._tables[name] = float_table(ctx, name, texels)
        generated = {
            "coefficients": coefficient_glsl(world.tables.coefficients.shape[-1]),
            "band_radiance": band.glsl(),
            **{table.name: table.glsl() for table in skies},
            "mirror_size": mirror_glsl(),
        }
        vertices = {"position": mesh.position.astype(np.float32), "surface": mesh.surface}
        emissive, lobes = self.sensor.mode == "emissive", world.tables.lobes is not None
        buffers = mesh_buffers(ctx, vertices, mesh.triangle)
        self._surfaces = surface_pass(ctx, buffers, generated, emissive=emissive, lobes=lobes)
        self._background = background_pass(ctx, generated, emissive=emissive)
        self._build_targets()

    def _build_targets(self) -> None:
        ctx = self.ctx
        curve = LookupTable(
            name="tone", quantity="Ratio", argument="Ratio", minimum=0.0, maximum=1.0, values=np.zeros(TONE_ENTRIES)
        )
        self._tables["tone_table"] = float_table(ctx, "tone_table", curve.texels)
        self._show, self._show_curve = display_pass(ctx), display_pass(ctx, curve)
        drawn = (self.samples * self.size[0], self.samples * self.size[1])
        self._chain = None
        if self.sensor.detector is not None:
            energy = self.blur_energy
            self._chain = SensorChain(ctx, self.sensor, self.size, samples=self.samples, energy=energy)
        self._target = render_target(ctx, drawn, {"quantities": "RGBA32F", "id": "R32I"}, depth=True)
        self._screen = render_target(ctx, self.size, {"grey": "R8"})
        self._blocks = {block.name: ctx.buffer(reserve=block.dtype.itemsize) for block in _BLOCKS}

    def _band_lookup(self) -> LookupTable:
        """Band radiance against temperature; reflective bands compile it but never read it."""
        table = self.band_table
        return LookupTable(
            name="band_radiance",
            quantity="Radiance",
            argument="Kelvin",
            minimum=150.0 if table is None else float(table.temperature[0]),
            maximum=700.0 if table is None else float(table.temperature[-1]),
            values=np.zeros(2) if table is None else table.radiance,
        )

    def _records(self, time_of_day: float) -> NDArray[np.float32]:
        """Surface table at a time of the image day [s]."""
        world, surfaces = self.world, self.world.scene.surfaces
        offset = None if world.offsets is None else world.offsets.at(time_of_day, surfaces.area.size)
        return surface_table(surfaces.normal, surfaces.feature, world.assignment, world.tables.orientations, offset)

    def _set_moment(self, time_of_day: float, illumination: Illumination) -> None:
        if self.world.offsets is not None:
            update_table(self._tables["surface_table"], self._records(time_of_day))
        self._set_tables(time_of_day)
        for table in (illumination.sky_table(), *illumination.glow_tables()):
            update_table(self._tables[f"{table.name}_table"], table.texels)
        update_table(self._tables["mirror_table"], illumination.mirror_table())
        self._blocks["Illumination"].write(
            ILLUMINATION.pack(
                quadrant=illumination.quadrant,
                sun_direction=illumination.sun_direction,
                beam=illumination.beam,
                sky_radiance=illumination.sky_radiance,
                ground_radiance=illumination.ground_radiance,
            )
        )

    def _set_tables(self, time_of_day: float) -> None:
        """Upload the tables of a moment, where the clock has moved."""
        if time_of_day == self._tables_at:
            return
        for name, texels in shade_texels(self.world.tables, time_of_day).items():
            update_table(self._tables[name], texels)
        self._tables_at = time_of_day

    def _draw(self, camera: Camera, illumination: Illumination) -> None:
        position = self.world.scene.mesh.position
        near, far = clip_distances(camera, self.size, position.min(axis=0), position.max(axis=0))
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
        self._target.use()
        self._target.clear_depth()
        self.ctx.enable_only(moderngl.NOTHING)
        self._background.draw()
        self.ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        self._surfaces.draw()

    def _bind(self) -> None:
        for block in _BLOCKS:
            self._blocks[block.name].bind_to_uniform_block(block.binding)
        for name, texture in self._tables.items():
            texture.use(TEXTURE_UNITS[name])
        self._target.texture("quantities").use(TEXTURE_UNITS["radiance_picture"])

    def _read(self) -> dict[str, NDArray[Any]]:
        quantities = self._target.read("quantities")
        if not np.all(np.isfinite(quantities)):
            raise NumericsError(f"frame of {self.sensor.name}: a pixel is not finite")
        middle = slice(self.samples // 2, None, self.samples)  # each pixel shows what its middle sees
        planes: dict[str, NDArray[Any]] = {
            name: np.ascontiguousarray(quantities[middle, middle, component])
            for component, name in enumerate(QUANTITIES)
        }
        surface = np.ascontiguousarray(self._target.read("id")[middle, middle, 0])
        planes["surface_id"] = surface
        planes["feature"] = np.where(surface < 0, -1, self.world.scene.surfaces.feature[np.maximum(surface, 0)])
        if self.band_table is not None:
            planes["apparent_temperature"] = self.band_table.apparent_temperature(planes["radiance"])
        return planes

    def _detect(self, camera: Camera, planes: dict[str, NDArray[Any]], frame: int) -> None:
        """What the detector reports of the frame of that number, as plane `signal` and as the picture on display."""
        if self._chain is None:
            return
        seen = exposed(planes)
        exposure, level = exposure_for(self._chain.look, seen), float(np.mean(seen, dtype=np.float64))
        field = float(np.radians(camera.horizontal_field_of_view))
        picture = self._target.texture("quantities")
        reported = self._chain.run(picture, field, frame, exposure=exposure, level=level)
        planes["signal"] = self._chain.read("reported")
        reported.use(TEXTURE_UNITS["radiance_picture"])

    def _display(self, settings: DisplaySettings, seen: NDArray[np.float32]) -> NDArray[np.uint8]:
        low, high = window_limits(settings)
        black_hot = float(settings.polarity == "black-hot")
        self._blocks["Display"].write(DISPLAY.pack(level=0.5 * (low + high), span=high - low, black_hot=black_hot))
        show = self._show
        if not settings.is_straight:
            show = self._show_curve
            curve = tone_curve(settings.tone, settings.gamma, seen, low, high)
            update_table(self._tables["tone_table"], curve[None, :])
            self._tables["tone_table"].use(TEXTURE_UNITS["tone_table"])
        self._screen.use()
        self.ctx.enable_only(moderngl.NOTHING)
        show.draw()
        return np.asarray(self._screen.read("grey")[:, :, 0])


def exposure_for(look: Sensitivity, radiance: NDArray[np.float32]) -> float:
    """Share of the light that keeps all but a hundredth of the pixels below FILLED of what the detector holds."""
    bright = float(np.quantile(radiance, 0.99))
    return min(1.0, FILLED * look.full / bright) if bright > 0.0 else 1.0


def exposed(planes: Mapping[str, NDArray[Any]]) -> NDArray[np.float32]:
    """Radiances that an automatic gain goes by: of surfaces, so that a cold or bright sky does not take the window."""
    seen = planes["surface_id"] >= 0
    radiance: NDArray[np.float32] = planes.get("signal", planes["radiance"])
    return radiance[seen] if np.any(seen) else radiance.ravel()
