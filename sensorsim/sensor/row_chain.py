"""From the drawn picture to display codes on the processor, in single precision: for frames that are shown, not kept.

A software rasteriser pays dearly for every texel that a screen pass looks up; compiled loops over rows do the same
blur, memory, streaks, halo, noise, counts and grey in a tenth of the time. On a graphics card they save reading back
wide pictures. Results differ from the shaders' by single precision's rounding: by a count or a display code, rarely.
"""

import math
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import NumericsError
from sensorsim.sensor import row_kernels
from sensorsim.sensor.dead_elements import living_neighbours, replace_dead
from sensorsim.sensor.detail import enhance_detail
from sensorsim.sensor.display import DisplaySettings, window_limits
from sensorsim.sensor.exposure import exposure_for, sampled_surfaces
from sensorsim.sensor.focal_plane import column_places
from sensorsim.sensor.memory import renewed_share
from sensorsim.sensor.point_spread import blur_kernel
from sensorsim.sensor.random_field import deviate_table
from sensorsim.sensor.raster import is_plain, source_rows, weave
from sensorsim.sensor.read_out import correction_radiance, fixed_pattern, frame_noise, stream_seed
from sensorsim.sensor.sensitivity import Sensitivity, sensitivity
from sensorsim.sensor.sensor import Sensor
from sensorsim.sensor.spill import (
    HALO_BLOCK,
    STREAK_BLOCK,
    baseline,
    block_places,
    blocks_by_row,
    halo,
    halo_radius,
    kept_per_block,
)

Single = NDArray[np.float32]
MOST_THREADS = 8


class RowChain:
    """What one sensor makes of drawn pictures, at one size; holds its buffers and what its detector remembers."""

    def __init__(
        self,
        sensor: Sensor,
        size: tuple[int, int],
        *,
        samples: int = 1,
        energy: float = 0.98,
        threads: int | None = None,
    ) -> None:
        self.sensor, self.size, self.samples, self.energy = sensor, size, samples, energy
        width, height = size
        self.threads = min(threads or os.cpu_count() or 1, MOST_THREADS, height)
        self.pool = ThreadPoolExecutor(max_workers=self.threads)
        self.light = np.zeros((height * samples, width * samples), np.float32)
        self.marked = np.zeros(self.light.shape, np.bool_)
        self.focus, self.reported = np.zeros((height, width), np.float32), np.zeros((height, width), np.float32)
        self.signal = self.reported  # with what stands for dead elements, line by line
        self.held, self.last_frame = self.focus, -1
        self.field = 0.0  # [rad] that kernel and columns are for
        if sensor.detector is not None:
            self.look, self.corrected_at = sensitivity(sensor), correction_radiance(sensor)
            self.pattern = np.ascontiguousarray(np.moveaxis(fixed_pattern(sensor, size)[..., :3], 2, 0), np.float32)
            self.deviates = deviate_table().astype(np.float32)
            self.neighbours = living_neighbours(self.pattern[2]) if sensor.noise.replaced else ()

    def release(self) -> None:
        """End the threads."""
        self.pool.shutdown()

    def run(self, stored: Single, field: float, frame: int) -> Single:
        """What the sensor reports [W m-2 sr-1] of a picture over a horizontal field [rad], as frame of that number.

        stored (height samples, width samples): radiance from the lowest row up, its sign set where no surface is seen.
        Raises NumericsError for a picture that is not finite.
        """
        self._each(
            len(stored), lambda first, last: row_kernels.split_marks(stored, first, last, self.light, self.marked)
        )
        if not math.isfinite(float(self.light.sum())):
            raise NumericsError(f"frame of {self.sensor.name}: a pixel is not finite")
        if self.sensor.detector is None:
            self.signal[:] = self.light
            return self.signal
        self._look_through(field)
        row, column, places = self.kernel
        self._each(
            self.size[1],
            lambda first, last: row_kernels.blur(
                self.light, row, column, places, self.samples, first, last, self.focus
            ),
        )
        seen = self.seen(self.light)
        look = self.look.stopped(exposure_for(self.look, seen))  # an iris
        light = self._spilled(self._remembered(frame), look, float(np.mean(seen, dtype=np.float64)))
        self._report(light, look, frame)
        self._put_out(frame)
        return self.signal

    def cut(self) -> None:
        """Forget the frame before: the next one begins anew."""
        self.last_frame = -1

    def seen(self, picture: Single) -> Single:
        """Radiances of a picture that an automatic gain goes by."""
        middle = slice(self.samples // 2, None, self.samples)
        step = self.samples if picture.shape != self.size[::-1] else 1
        here = picture[step // 2 :: step, step // 2 :: step]
        return sampled_surfaces(here, ~self.marked[middle, middle])

    def show(self, settings: DisplaySettings, curve: NDArray[np.float64] | None = None) -> NDArray[np.uint8]:
        """Display codes (height, width) of the last report through a fixed window, by a curve if there is one."""
        low, high = window_limits(settings)
        bent = np.zeros(0, np.float32) if curve is None else curve.astype(np.float32)
        signal = self.signal
        if settings.detail != 1.0:
            signal = enhance_detail(signal, 0.5 * (low + high), high - low, settings.detail)
        window = np.array([0.5 * (low + high), high - low, 0.5, 1.0, 255.0], np.float32)
        black_hot, codes = settings.polarity == "black-hot", np.zeros(self.signal.shape, np.uint8)
        self._each(
            self.size[1],
            lambda first, last: row_kernels.show(signal, bent, window, black_hot, first, last, codes),
        )
        return codes

    def _each(self, rows: int, work: Callable[[int, int], Any]) -> None:
        """Do the work on all rows, shared by the threads."""
        edges = [rows * part // self.threads for part in range(self.threads + 1)]
        list(self.pool.map(work, edges[:-1], edges[1:]))

    def _look_through(self, field: float) -> None:
        """Kernel and columns for a horizontal field [rad]."""
        if field == self.field:
            return
        width, height = self.size
        sample = 2.0 * math.tan(0.5 * field) / (width * self.samples)
        kernel = blur_kernel(self.sensor, sample, rows=height, field=field, energy=self.energy)
        assert kernel is not None
        places = column_places(width, self.samples, field, equal_angle=self.sensor.scan.equal_angle)
        self.kernel = kernel.row.astype(np.float32), kernel.column.astype(np.float32), places.astype(np.int32)
        self.field = field

    def _remembered(self, frame: int) -> Single:
        """The light that the detector holds, with what is left of the frame before."""
        share = renewed_share(self.sensor)
        if share < 1.0:
            follows = self._follows(frame)
            self.held = self.held + np.float32(share) * (self.focus - self.held) if follows else self.focus.copy()
            return self.held
        return self.focus

    def _spilled(self, light: Single, look: Sensitivity, level: float) -> Single:
        """The light less what each channel has settled to but for a level, with the halo of bright lights."""
        sensor, (width, height) = self.sensor, self.size
        if sensor.scan.ac_coupling > 0.0:
            settled = baseline(light, kept_per_block(sensor, self.field, self.size))
            light = self._with_blocks(light, settled, STREAK_BLOCK, level, -1.0)
        if sensor.intensifier is not None:
            radius = halo_radius(sensor, self.field, width)
            around = halo(light, look.full, sensor.intensifier.halo_share, radius)
            light = self._with_blocks(light, blocks_by_row(around, height, HALO_BLOCK), HALO_BLOCK, 0.0, 1.0)
        return light

    def _with_blocks(self, light: Single, rows: Any, width: int, constant: float, factor: float) -> Single:
        """Light with a constant, and a multiple of blocks (height, blocks), spread along the rows."""
        left, share = block_places(self.size[0], rows.shape[1], width)
        values, part = rows.astype(np.float32), share.astype(np.float32)
        added = np.zeros(light.shape, np.float32)
        numbers = np.array([constant, factor], np.float32)
        self._each(
            self.size[1],
            lambda first, last: row_kernels.add_blocks(light, values, left, part, numbers, first, last, added),
        )
        return added

    def _report(self, light: Single, look: Sensitivity, frame: int) -> None:
        """Noise and counts."""
        sensor = self.sensor
        numbers = [look.constant, look.shot, look.step, round(look.full / look.step), self.corrected_at]
        packed, noise = np.array(numbers, np.float32), frame_noise(sensor, self.size, frame)
        row, line, seed = noise.row.astype(np.float32), noise.line.astype(np.float32), stream_seed(sensor, "tvh")
        self._each(
            self.size[1],
            lambda first, last: row_kernels.report(
                light, self.pattern, row, line, self.deviates, packed, frame, seed, first, last, self.reported
            ),
        )

    def _put_out(self, frame: int) -> None:
        """What stands for dead elements, and the lines that the frame brings."""
        shown, scan = self.reported, self.sensor.scan
        if self.neighbours:
            shown = replace_dead(shown, self.neighbours)
        if not is_plain(scan):
            shown = weave(self.signal, shown, source_rows(scan, self.size[1], frame, follows=self._follows(frame)))
        self.signal, self.last_frame = shown, frame

    def _follows(self, frame: int) -> bool:
        """Whether what the last frame has left is that of the one before."""
        return frame == self.last_frame + 1 and self.last_frame >= 0
