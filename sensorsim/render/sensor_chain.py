"""From the drawn picture to what the detector reports: blur along rows and columns, memory, noise and counts.

Each step is a pass of its own and is left out where the sensor does not have it.
"""

from typing import Any

import moderngl
import numpy as np

from sensorsim.gpu import RenderTarget, float_table, render_target, update_table
from sensorsim.render.blocks import DETECTION
from sensorsim.render.passes import TEXTURE_UNITS, screen_pass
from sensorsim.sensor import (
    Sensor,
    blur_kernel,
    column_places,
    correction_radiance,
    deviate_table,
    fixed_pattern,
    frame_noise,
    sensitivity,
    stream_seed,
)


class SensorChain:
    """The passes of one sensor at one size; holds what the detector remembers from picture to picture."""

    def __init__(
        self, ctx: moderngl.Context, sensor: Sensor, size: tuple[int, int], samples: int, energy: float
    ) -> None:
        self.ctx, self.sensor, self.size, self.samples, self.energy = ctx, sensor, size, samples, energy
        self.look = sensitivity(sensor)
        width, height = size
        self.products = render_target(ctx, (width, height * samples), {"products": "RGBA32F"})
        self.focus = render_target(ctx, size, {"focal_plane": "R32F"})
        self.report = render_target(ctx, size, {"reported": "R32F"})
        self.blur_rows = screen_pass(ctx, "sensor/blur_rows.frag", ("radiance_picture", "kernel_table", "column_table"))
        self.blur_columns = screen_pass(
            ctx, "sensor/blur_columns.frag", ("product_picture", "kernel_table"), {"ROWS_PER_ELEMENT": samples}
        )
        self.detect = screen_pass(
            ctx,
            "sensor/detect.frag",
            ("focal_plane", "pattern_table", "row_table", "line_table", "deviate_table"),
            blocks=(DETECTION,),
        )
        self.block = ctx.buffer(reserve=DETECTION.dtype.itemsize)
        self.tables = {
            "column_table": float_table(ctx, "column_table", np.zeros((1, width))),
            "pattern_table": float_table(ctx, "pattern_table", fixed_pattern(sensor, size)),
            "row_table": float_table(ctx, "row_table", np.zeros((1, height))),
            "line_table": float_table(ctx, "line_table", np.zeros((1, width))),
            "deviate_table": float_table(ctx, "deviate_table", deviate_table()[None, :]),
        }
        self.field = 0.0

    def run(self, picture: moderngl.Texture, field: float, frame: int, exposure: float) -> RenderTarget:
        """What the detector reports of a picture over a horizontal field [rad], in the plane `reported`."""
        self._look_through(field)
        self._set_frame(frame, exposure)
        self._draw(self.products, self.blur_rows, {"radiance_picture": picture})
        self._draw(self.focus, self.blur_columns, {"product_picture": self.products.texture("products")})
        self._draw(self.report, self.detect, {"focal_plane": self.focus.texture("focal_plane")})
        return self.report

    def _draw(self, target: RenderTarget, screen: Any, pictures: dict[str, moderngl.Texture]) -> None:
        for name, texture in {**self.tables, **pictures}.items():
            texture.use(TEXTURE_UNITS[name])
        self.block.bind_to_uniform_block(DETECTION.binding)
        target.use()
        screen.draw()

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

    def _set_frame(self, frame: int, exposure: float) -> None:
        look, noise = self.look.stopped(exposure), frame_noise(self.sensor, self.size, frame)
        update_table(self.tables["row_table"], noise.row[None, :])
        update_table(self.tables["line_table"], noise.line[None, :])
        self.block.write(
            DETECTION.pack(
                constant=look.constant,
                shot=look.shot,
                count_step=look.step,
                highest=float(round(look.full / look.step)),
                corrected_at=correction_radiance(self.sensor),
                frame=frame,
                seed=stream_seed(self.sensor, "tvh"),
            )
        )
