"""From the drawn picture to display codes on the processor, in single precision: for frames that are shown, not kept.

A software rasteriser pays dearly for every texel that a screen pass looks up; compiled loops over rows do the same
blur, memory, streaks, halo, noise, counts and grey in a tenth of the time. On a graphics card they save reading back
wide pictures. Results differ from the shaders' by single precision's rounding: by a count or a display code, rarely.
"""

import math
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import NumericsError
from sensorsim.sensor import detail_kernels, row_kernels
from sensorsim.sensor.bloom import bloomed
from sensorsim.sensor.dead_elements import living_neighbours, replace_dead
from sensorsim.sensor.detail import DETAIL_REACH, EDGE
from sensorsim.sensor.display import DisplaySettings, window_limits
from sensorsim.sensor.exposure import exposure_for, of_surfaces, sampled_lines
from sensorsim.sensor.focal_plane import column_places
from sensorsim.sensor.line_noise import LineNoise
from sensorsim.sensor.memory import renewed_share
from sensorsim.sensor.point_spread import blur_kernel
from sensorsim.sensor.random_field import deviate_table
from sensorsim.sensor.raster import is_plain, source_rows, weave
from sensorsim.sensor.read_out import correction_radiance, fixed_pattern, stream_seed
from sensorsim.sensor.sensitivity import Sensitivity, sensitivity
from sensorsim.sensor.sensor import Sensor
from sensorsim.sensor.spill import (
    HALO_BLOCK,
    STREAK_BLOCK,
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
        self.light = np.zeros((height * samples, width * samples), np.float32)  # to be filled before a run
        self.surface = np.ones(self.light.shape, np.bool_)  # where one is seen, for the gain
        self.focus, self.reported = np.zeros((height, width), np.float32), np.zeros((height, width), np.float32)
        self.signal = self.reported  # with what stands for dead elements, line by line
        self.held, self.last_frame = self.focus, -1
        self.field = 0.0  # [rad] that kernel and columns are for
        self.places = np.arange(width) * samples + samples // 2  # sample that each column looks at
        if sensor.detector is not None:
            self._set_up(sensor)

    def _set_up(self, sensor: Sensor) -> None:
        """What does not change from frame to frame."""
        width, height = self.size
        self.look, self.corrected_at = sensitivity(sensor), correction_radiance(sensor)
        self.pattern = np.ascontiguousarray(np.moveaxis(fixed_pattern(sensor, self.size)[..., :3], 2, 0), np.float32)
        self.deviates = deviate_table().astype(np.float32)
        self.noise = LineNoise(sensor, self.size, self.deviates)
        self.streaks = np.zeros((height, -(-width // STREAK_BLOCK)), np.float32)
        self.halos = np.zeros((height, -(-width // HALO_BLOCK)), np.float32)
        self.spilled = np.zeros((height, width), np.float32)
        self.woven = np.zeros((height, width), np.float32)
        self.streak_places = _between(width, self.streaks.shape[1], STREAK_BLOCK)
        self.halo_places = _between(width, self.halos.shape[1], HALO_BLOCK)
        self.neighbours = living_neighbours(self.pattern[2]) if sensor.noise.replaced else ()
        assert sensor.detector is not None
        kept = renewed_share(sensor) < 1.0 or sensor.detector.blooming > 0.0
        self.rows_alone = not kept and sensor.intensifier is None  # each goes on to its report without the others
        self.rows_stay = self.rows_alone and sensor.scan.lines == 0 and not self.neighbours  # of lines not brought

    def release(self) -> None:
        """End the threads."""
        self.pool.shutdown()

    def run(self, field: float, frame: int) -> Single:
        """What the sensor reports [W m-2 sr-1] of its `light`, over a horizontal field [rad], as frame of that number.

        Raises NumericsError for light that is not finite.
        """
        if not math.isfinite(float(self.light.sum())):
            raise NumericsError(f"frame of {self.sensor.name}: a pixel is not finite")
        if self.sensor.detector is None:
            self.signal[:] = self.light
            return self.signal
        self._look_through(field)
        seen = self.seen(self.light)
        look = self.look.stopped(exposure_for(self.look, seen))  # an iris
        level = float(np.mean(seen, dtype=np.float64))
        report = self._report(look, level, frame)
        if self.rows_alone:
            self._brought(frame, lambda *rows: report(self._focused(*rows), *rows))
        else:
            self._brought(frame, self._focused)
            light = self._remembered(frame)
            if self.sensor.detector.blooming > 0.0 and float(light.max()) > look.full:
                light = bloomed(light, look.full, self.sensor.detector.blooming)
            light = self._spilled(light, look, level)
            self._brought(frame, lambda *rows: report(light, *rows))
        self._put_out(frame)
        return self.signal

    def cut(self) -> None:
        """Forget the frame before: the next one begins anew."""
        self.last_frame = -1

    def seen(self, picture: Single) -> Single:
        """Radiances of a picture that an automatic gain goes by."""
        middle, every = slice(self.samples // 2, None, self.samples), sampled_lines(self.size[::-1])
        columns = self.places[every]
        here = picture[middle][every][:, columns] if picture is self.light else picture[every, every]
        return of_surfaces(here, self.surface[middle][every][:, columns])

    def show(self, settings: DisplaySettings, curve: NDArray[np.float64] | None = None) -> NDArray[np.uint8]:
        """Display codes (height, width) of the last report through a fixed window, by a curve if there is one."""
        low, high = window_limits(settings)
        bent = np.zeros(0, np.float32) if curve is None else curve.astype(np.float32)
        signal = self.signal if settings.detail == 1.0 else self._enhanced(low, high, settings.detail)
        window = np.array([0.5 * (low + high), high - low, 0.5, 1.0, 255.0], np.float32)
        black_hot, codes = settings.polarity == "black-hot", np.zeros(self.signal.shape, np.uint8)
        self.each(
            self.size[1],
            lambda first, last: row_kernels.show(signal, bent, window, black_hot, first, last, codes),
        )
        return codes

    def _enhanced(self, low: float, high: float, gain: float) -> Single:
        """The last report with that gain of its detail, for a window from `low` to `high` [W m-2 sr-1]."""
        share = (self.signal - np.float32(0.5 * (low + high))) / np.float32(high - low)
        square, edge, more = share * share, np.array([EDGE], np.float32), np.array([(gain - 1.0) * (high - low)], "f4")
        slope, offset, out = np.zeros_like(share), np.zeros_like(share), np.zeros_like(share)
        self.each(
            self.size[1],
            lambda first, last: detail_kernels.fit_base(share, square, DETAIL_REACH, edge, first, last, slope, offset),
        )
        self.each(
            self.size[1],
            lambda first, last: detail_kernels.stretch_detail(
                self.signal, share, slope, offset, DETAIL_REACH, more, first, last, out
            ),
        )
        return out

    def each(self, rows: int, work: Callable[[int, int], Any]) -> None:
        """Do the work on all rows, shared by the threads; the caller's own takes the last part."""
        edges = [rows * part // self.threads for part in range(self.threads + 1)]
        others = [self.pool.submit(work, *pair) for pair in pairwise(edges[:-1])]
        work(*edges[-2:])
        for other in others:
            other.result()

    def _look_through(self, field: float) -> None:
        """Kernel and columns for a horizontal field [rad]."""
        if field == self.field:
            return
        width, height = self.size
        sample = 2.0 * math.tan(0.5 * field) / (width * self.samples)
        kernel = blur_kernel(self.sensor, sample, rows=height, field=field, energy=self.energy)
        assert kernel is not None
        places = column_places(width, self.samples, field, equal_angle=self.sensor.scan.equal_angle)
        self.places = places.astype(np.int64)  # as a turning mirror places them
        self.kernel = row_kernels.padded(kernel.row), row_kernels.padded(kernel.column), kernel.row.shape[1] // 2
        self.field = field

    def _remembered(self, frame: int) -> Single:
        """The light that the detector holds, with what is left of the frame before."""
        share = renewed_share(self.sensor)
        if share < 1.0:
            follows = self._follows(frame)
            self.held = self.held + np.float32(share) * (self.focus - self.held) if follows else self.focus.copy()
            return self.held
        return self.focus

    def _brought(self, frame: int, work: Callable[[int, int, int], Any]) -> None:
        """Do the work on the rows that are needed: on every so manieth where the others stay as they are reported."""
        every = self.sensor.scan.interlace if self.rows_stay and self._follows(frame) else 1
        self.each(self.size[1], lambda first, last: work(first + (frame - first) % every, last, every))

    def _focused(self, first: int, last: int, every: int) -> Single:
        """The light, its rows from first to last blurred."""
        (row, column, reach), places = self.kernel, self.places
        row_kernels.blur(
            self.light, row, column, reach, places, self.samples, first, last, every, self.focus
        )  # fmt: skip
        return self.focus

    def _spilled(self, light: Single, look: Sensitivity, level: float) -> Single:
        """Light on an intensifier, with streaks and what its halo needs; `level` is that of the whole picture."""
        sensor, (width, height) = self.sensor, self.size
        if sensor.intensifier is None:
            return light
        if sensor.scan.ac_coupling > 0.0:
            whole = light
            self.each(height, lambda first, last: self._with_streaks(whole, level, first, last, 1))
            light = self.spilled
        radius = halo_radius(sensor, self.field, width)
        around = halo(light, look.full, sensor.intensifier.halo_share, radius)
        self.halos[:] = blocks_by_row(around, height, HALO_BLOCK)
        return light

    def _report(self, look: Sensitivity, level: float, frame: int) -> Callable[[Single, int, int, int], None]:
        """What makes noise and counts of rows of light, with streaks and halo."""
        sensor = self.sensor
        numbers = [look.constant, look.shot, look.step, round(look.full / look.step), self.corrected_at]
        packed, seed = np.array(numbers, np.float32), stream_seed(sensor, "tvh")
        row, line = self.noise.at(frame)

        def work(seen: Single, first: int, last: int, every: int) -> None:
            if sensor.intensifier is not None:
                seen = self._with_halo(seen, first, last, every)
            elif sensor.scan.ac_coupling > 0.0:
                seen = self._with_streaks(seen, level, first, last, every)
            row_kernels.report(
                seen, self.pattern, row, line, self.deviates, packed, frame, seed, first, last, every, self.reported
            )

        return work

    def _with_streaks(self, light: Single, level: float, first: int, last: int, every: int) -> Single:
        """Rows of the light less what each channel has settled to, but for a level."""
        kept = kept_per_block(self.sensor, self.field, self.size)
        row_kernels.settled_blocks(light, STREAK_BLOCK, kept, first, last, every, self.streaks)
        numbers = np.array([level, -1.0], np.float32)
        row_kernels.add_blocks(
            light, self.streaks, *self.streak_places, numbers, first, last, every, self.spilled
        )  # fmt: skip
        return self.spilled

    def _with_halo(self, light: Single, first: int, last: int, every: int) -> Single:
        numbers = np.array([0.0, 1.0], np.float32)
        row_kernels.add_blocks(light, self.halos, *self.halo_places, numbers, first, last, every, self.spilled)
        return self.spilled

    def _put_out(self, frame: int) -> None:
        """What stands for dead elements, and the lines that the frame brings."""
        shown, scan = self.reported, self.sensor.scan
        if self.neighbours:
            shown = replace_dead(shown, self.neighbours)
        if not (is_plain(scan) or self.rows_stay):
            weave(self.woven, shown, source_rows(scan, self.size[1], frame, follows=self._follows(frame)))
            shown = self.woven
        self.signal, self.last_frame = shown, frame

    def _follows(self, frame: int) -> bool:
        """Whether what the last frame has left is that of the one before."""
        return frame == self.last_frame + 1 and self.last_frame >= 0


def _between(count: int, blocks: int, extent: int) -> tuple[NDArray[np.uint32], NDArray[np.uint32], Single]:
    """For each of `count` elements the blocks on its left and right, and how far it is to the right one."""
    left, share = block_places(count, blocks, extent)
    right = np.minimum(left + 1, blocks - 1)
    return left.astype(np.uint32), right.astype(np.uint32), share.astype(np.float32)
