"""From the drawn picture to what the sensor puts out: blur, memory, blooming, streaks, halo, noise and counts, what
stands for dead elements, and the lines of its raster.

Each step is a pass of its own and is left out where the sensor does not have it.
"""

from collections.abc import Mapping

import moderngl
import numpy as np

from sensorsim.gpu import RenderTarget, float_table, render_target, update_table
from sensorsim.render.blocks import DETECTION
from sensorsim.render.passes import TEXTURE_UNITS, Pass, screen_pass
from sensorsim.sensor import (
    HALO_BLOCK,
    REACH,
    STREAK_BLOCK,
    Sensitivity,
    Sensor,
    blur_kernel,
    column_places,
    correction_radiance,
    deviate_table,
    fixed_pattern,
    frame_noise,
    halo_radius,
    is_plain,
    kept_per_block,
    renewed_share,
    sensitivity,
    source_rows,
    stream_seed,
)

Pictures = Mapping[str, moderngl.Texture]


class SensorChain:
    """The passes of one sensor at one size; holds what the detector remembers from picture to picture."""

    def __init__(
        self, ctx: moderngl.Context, sensor: Sensor, size: tuple[int, int], *, samples: int = 1, energy: float = 0.98
    ) -> None:
        self.ctx, self.sensor, self.size, self.samples, self.energy = ctx, sensor, size, samples, energy
        self.look = sensitivity(sensor)
        self.field = 0.0  # [rad] that kernel and columns are for
        self.last_frame: int | None = None
        self.step = self.look.step  # band radiance of a count of the last run [W m-2 sr-1]
        self.blooms = sensor.detector is not None and sensor.detector.blooming > 0.0
        self.streaks = sensor.scan.ac_coupling > 0.0
        self.halo = sensor.intensifier is not None
        self.remembers = renewed_share(sensor) < 1.0
        self.after = ("replaced",) * (sensor.noise.replaced and sensor.noise.dead > 0.0)
        self.after += ("woven",) * (not is_plain(sensor.scan))
        self.block = ctx.buffer(reserve=DETECTION.dtype.itemsize)
        self.targets = self._targets()
        self.passes = self._passes()
        width, height = size
        self.tables = {
            "column_table": float_table(ctx, "column_table", np.zeros((1, width))),
            "pattern_table": float_table(ctx, "pattern_table", fixed_pattern(sensor, size)),
            "row_table": float_table(ctx, "row_table", np.zeros((1, height))),
            "line_table": float_table(ctx, "line_table", np.zeros((1, width))),
            "deviate_table": float_table(ctx, "deviate_table", deviate_table()[None, :]),
            "raster_table": float_table(ctx, "raster_table", np.zeros((1, height))),
        }

    def run(
        self, picture: moderngl.Texture, field: float, frame: int, *, exposure: float = 1.0, level: float = 0.0
    ) -> moderngl.Texture:
        """What the detector reports [W m-2 sr-1] of a picture over a horizontal field [rad], as frame of that number.

        exposure: share of the light; level: radiance that stands for the level of a channel coupled by a capacitor.
        A frame that follows the one before remembers it; any other starts anew.
        """
        self._look_through(field)
        look = self.look.stopped(exposure)
        self.step = look.step
        self._set_frame(look, frame, level)
        self._draw("products", {"radiance_picture": picture})
        self._draw("focal_plane", {"product_picture": self._texture("products")})
        light = self._held(frame)
        if self.blooms:
            self._draw("columns", {"focal_plane": light})
            self._draw("bloomed", {"focal_plane": light, "block_picture": self._texture("columns")})
            light = self._texture("bloomed")
        more: dict[str, moderngl.Texture] = {}
        if self.streaks:
            self._draw("row_blocks", {"focal_plane": light})
            self._draw("baseline", {"block_picture": self._texture("row_blocks")})
            more["baseline_picture"] = self._texture("baseline")
        if self.halo:
            self._draw("square_blocks", {"focal_plane": light})
            self._draw("halo", {"block_picture": self._texture("square_blocks")})
            more["halo_picture"] = self._texture("halo")
        self._draw("reported", {"focal_plane": light, **more})
        for name, before in zip(self.after, ("reported", *self.after), strict=False):
            self._draw(name, {"reported_picture": self._texture(before)})
        self.last_frame = frame
        return self.texture

    def cut(self) -> None:
        """Forget the frame before: the next one begins anew."""
        self.last_frame = None

    @property
    def texture(self) -> moderngl.Texture:
        """What the sensor put out last [W m-2 sr-1]."""
        return self._texture(self.output)

    @property
    def output(self) -> str:
        """Name of the picture that the sensor puts out."""
        return self.after[-1] if self.after else "reported"

    def read(self, name: str) -> np.ndarray:
        """A picture of the last run (height, width): products, focal_plane, reported and so on."""
        return np.asarray(self.targets[name].read("picture")[:, :, 0])

    def _targets(self) -> dict[str, RenderTarget]:
        (width, height), ctx = self.size, self.ctx
        columns, squares = -(-width // STREAK_BLOCK), (-(-width // HALO_BLOCK), -(-height // HALO_BLOCK))
        kinds = {"products": ((width, height * self.samples), "RGBA32F"), "focal_plane": (self.size, "R32F")}
        kinds |= dict.fromkeys(("reported", *self.after), (self.size, "R32F"))
        if self.remembers:
            kinds |= {"remembered": (self.size, "R32F"), "remembered_last": (self.size, "R32F")}
        if self.blooms:
            kinds |= {"columns": ((width, 1), "RG32F"), "bloomed": (self.size, "R32F")}
        if self.streaks:
            kinds |= {"row_blocks": ((columns, height), "RG32F"), "baseline": ((columns, height), "R32F")}
        if self.halo:
            kinds |= {"square_blocks": (squares, "RG32F"), "halo": (squares, "R32F")}
        return {name: render_target(ctx, size, {"picture": kind}) for name, (size, kind) in kinds.items()}

    def _passes(self) -> dict[str, Pass]:
        ctx = self.ctx
        blur = ("kernel_table", "column_table")
        per_element = {"ROWS_PER_ELEMENT": self.samples}
        rows = {"BLOCK_WIDTH": STREAK_BLOCK, "BLOCK_HEIGHT": 1}
        squares = {"BLOCK_WIDTH": HALO_BLOCK, "BLOCK_HEIGHT": HALO_BLOCK}
        passes = {
            "products": screen_pass(ctx, "sensor/blur_rows.frag", ("radiance_picture", *blur)),
            "focal_plane": screen_pass(ctx, "sensor/blur_columns.frag", ("product_picture", blur[0]), per_element),
        }
        if self.remembers:
            passes["remembered"] = _with_block(ctx, "remember", ("focal_plane", "last_picture"))
        if self.blooms:
            whole = {"BLOCK_WIDTH": 1, "BLOCK_HEIGHT": self.size[1]}
            passes["columns"] = _with_block(ctx, "block_mean", ("focal_plane",), whole)
            passes["bloomed"] = _with_block(ctx, "bloom", ("focal_plane", "block_picture"))
        if self.streaks:
            passes["row_blocks"] = _with_block(ctx, "block_mean", ("focal_plane",), rows)
            passes["baseline"] = _with_block(ctx, "baseline", ("block_picture",))
        if self.halo:
            passes["square_blocks"] = _with_block(ctx, "block_mean", ("focal_plane",), squares)
            passes["halo"] = _with_block(ctx, "halo", ("block_picture",))
        samplers = ["focal_plane", "pattern_table", "row_table", "line_table", "deviate_table"]
        samplers += ["baseline_picture"] * self.streaks + ["halo_picture"] * self.halo
        defines = {"STREAKS": int(self.streaks), "HALO": int(self.halo)}
        defines |= {"STREAK_BLOCK": STREAK_BLOCK, "HALO_BLOCK": HALO_BLOCK}
        passes["reported"] = _with_block(ctx, "detect", tuple(samplers), defines)
        return passes | self._last_passes()

    def _last_passes(self) -> dict[str, Pass]:
        """What comes after the detector's report."""
        passes = {}
        if "replaced" in self.after:
            tables = ("reported_picture", "pattern_table")
            passes["replaced"] = screen_pass(self.ctx, "sensor/replace.frag", tables, {"REACH": REACH})
        if "woven" in self.after:
            passes["woven"] = screen_pass(self.ctx, "sensor/raster.frag", ("reported_picture", "raster_table"))
        return passes

    def _texture(self, name: str) -> moderngl.Texture:
        return self.targets[name].texture("picture")

    def _draw(self, name: str, pictures: Pictures) -> None:
        for sampler, texture in {**self.tables, **pictures}.items():
            texture.use(TEXTURE_UNITS[sampler])
        self.block.bind_to_uniform_block(DETECTION.binding)
        self.targets[name].use()
        self.passes[name].draw()

    def _held(self, frame: int) -> moderngl.Texture:
        """The light that the detector holds, with what is left of the frame before."""
        if not self.remembers:
            return self._texture("focal_plane")
        before = self._texture("remembered" if self._follows(frame) else "focal_plane")
        targets = self.targets
        targets["remembered"], targets["remembered_last"] = targets["remembered_last"], targets["remembered"]
        self._draw("remembered", {"focal_plane": self._texture("focal_plane"), "last_picture": before})
        return self._texture("remembered")

    def _follows(self, frame: int) -> bool:
        """Whether what the last frame has left is that of the one before."""
        return self.last_frame is not None and frame == self.last_frame + 1

    def _look_through(self, field: float) -> None:
        """Kernel and columns for a horizontal field [rad]."""
        if field == self.field:
            return
        width, height = self.size
        sample = 2.0 * np.tan(0.5 * field) / (width * self.samples)
        kernel = blur_kernel(self.sensor, sample, rows=height, field=field, energy=self.energy)
        assert kernel is not None
        weights = np.zeros((2, kernel.row.shape[1], 4))
        weights[0, :, : kernel.row.shape[0]], weights[1, :, : kernel.row.shape[0]] = kernel.row.T, kernel.column.T
        if "kernel_table" in self.tables:
            self.tables["kernel_table"].release()
        self.tables["kernel_table"] = float_table(self.ctx, "kernel_table", weights)
        places = column_places(width, self.samples, field, equal_angle=self.sensor.scan.equal_angle)
        update_table(self.tables["column_table"], places[None, :])
        self.field = field

    def _set_frame(self, look: Sensitivity, frame: int, level: float) -> None:
        noise, sensor = frame_noise(self.sensor, self.size, frame), self.sensor
        update_table(self.tables["row_table"], noise.row[None, :])
        update_table(self.tables["line_table"], noise.line[None, :])
        if "woven" in self.after:
            rows = source_rows(sensor.scan, self.size[1], frame, follows=self._follows(frame))
            update_table(self.tables["raster_table"], rows[None, :].astype(np.float64))
        self.block.write(
            DETECTION.pack(
                constant=look.constant,
                shot=look.shot,
                count_step=look.step,
                highest=float(round(look.full / look.step)),
                corrected_at=correction_radiance(sensor),
                full=look.full,
                renewed=renewed_share(sensor),
                kept=kept_per_block(sensor, self.field, self.size),
                level=level,
                blooming=0.0 if sensor.detector is None else sensor.detector.blooming,
                halo_share=0.0 if sensor.intensifier is None else sensor.intensifier.halo_share,
                halo_radius=halo_radius(sensor, self.field, self.size[0]),
                frame=frame,
                seed=stream_seed(sensor, "tvh"),
            )
        )


def _with_block(
    ctx: moderngl.Context, name: str, samplers: tuple[str, ...], defines: Mapping[str, int] | None = None
) -> Pass:
    return screen_pass(ctx, f"sensor/{name}.frag", samplers, defines, blocks=(DETECTION,))
