"""The blur of a sensor as a kernel on the picture's own samples.

The transfer function of the whole system, optics, detector and scan, is turned into a point spread function on a grid
OVERSAMPLING times finer than the samples, by the inverse transform, and averaged over each sample, since the picture
is drawn in samples that stand for their whole area. The kernel is the sum of a few products of a column and a row, its
largest singular ones, so that two passes of one dimension apply it.
"""

import math
from dataclasses import dataclass

import numpy as np

from sensorsim.errors import InputError
from sensorsim.radiometry import FloatArray
from sensorsim.sensor import transfer
from sensorsim.sensor.sensor import Sensor

OVERSAMPLING = 4
PERIOD = 2  # extent of the transform over that of the kernel, against wrapping
RANKS = 4  # channels of a texel
TAIL = 2e-3  # of the kernel's sum that the products may miss
FIRST_REACH, REACH = 24, 192  # [samples] half of a kernel: tried first, widest
RADII = 4096  # of the pupil's function, straight in between: 1e-5 off
ENERGY = 0.987  # of the light of a point that a kernel holds, if not told otherwise


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Kernel:
    """Sum over r of column[r] x row[r]; its sum is one."""

    row: FloatArray  # (r, n) along the rows of the picture
    column: FloatArray  # (r, n)

    @property
    def weights(self) -> FloatArray:
        """The kernel itself (n, n), columns first."""
        return np.asarray(self.column.T @ self.row)


def system_transfer(sensor: Sensor, across: FloatArray, along: FloatArray, *, sweep_rate: float = 0.0) -> FloatArray:
    """Contrast left at frequencies `along` the rows and `across` them [cycles rad-1], broadcast against each other."""
    if sensor.optics is None or sensor.detector is None:
        return np.ones(np.broadcast_shapes(across.shape, along.shape))
    optics, detector = sensor.optics, sensor.detector
    radial = np.hypot(across, along)
    table = np.linspace(0.0, float(radial.max()), RADII)
    pupil = transfer.band_average(sensor.band, sensor.mode, table, optics.aperture, optics.obscuration, optics.defocus)
    total = np.interp(radial, table, pupil)
    total = total * transfer.gaussian_blur(radial, optics.blur) * transfer.random_motion(radial, optics.jitter)
    total = total * transfer.box(along, detector.width / optics.focal_length)
    total = total * transfer.box(across, detector.height / optics.focal_length)
    total = total * transfer.box(along, optics.drift)
    if sweep_rate > 0.0 and sensor.scan.electronics > 0.0:
        total = total * transfer.low_pass(along, sensor.scan.electronics / sweep_rate)
    return np.asarray(total)


def blur_kernel(
    sensor: Sensor, sample: float, *, rows: int | None = None, field: float | None = None, energy: float = ENERGY
) -> Kernel | None:
    """Kernel on samples of `sample` [rad], None for a sensor without optics.

    rows and field [rad] of the picture, for the sweep of a scanner; the sensor's own if left out. `energy` is the share
    of a point's light that reaches as far as it should; an edge is true to 0.36 of the rest, and 0 is no blur at all.
    Raises InputError for samples so fine that the blur would be wider than REACH of them.
    """
    if sensor.optics is None:
        return None
    if energy == 0.0:
        return Kernel(row=np.ones((1, 1)), column=np.ones((1, 1)))
    rows = sensor.size[1] if rows is None else rows
    field = math.radians(sensor.horizontal_field_of_view) if field is None else field
    sweep_rate, extent = sensor.scan.sweep_rate(field, rows), FIRST_REACH
    while extent <= REACH:
        spread = _point_spread(sensor, sample, sweep_rate, extent)
        for reach in range(1, extent + 1):
            kept = spread[extent - reach : extent + reach + 1, extent - reach : extent + reach + 1]
            if kept.sum() >= energy:
                return _products(_closed(kept))
        extent *= 2
    problem = f"the blur is wider than {REACH} samples of {sample:.3g} rad"
    raise InputError(
        f"sensor {sensor.name!r}", "optics", reach, problem, "widen the field of view or draw fewer pixels"
    )


def _point_spread(sensor: Sensor, sample: float, sweep_rate: float, extent: int) -> FloatArray:
    """Share of the light of a point (2 extent + 1, 2 extent + 1) that falls on each sample around it."""
    fine = sample / OVERSAMPLING
    count = 2 * extent * PERIOD * OVERSAMPLING
    frequency = np.fft.fftfreq(count, fine).astype(np.float64)
    half = np.fft.rfftfreq(count, fine).astype(np.float64)
    table = system_transfer(sensor, frequency[:, None], half[None, :], sweep_rate=sweep_rate)
    # A sample stands for its area: the box that averages over it is one more factor.
    table = table * transfer.box(frequency, sample)[:, None] * transfer.box(half, sample)[None, :]
    spread = np.fft.fftshift(np.fft.irfft2(table, s=(count, count)))
    places = count // 2 + OVERSAMPLING * np.arange(-extent, extent + 1)
    return np.asarray(spread[np.ix_(places, places)]) * OVERSAMPLING**2


def _closed(kept: FloatArray) -> FloatArray:
    """A kernel of sum one: the light that falls beyond is laid on its rim, where edges feel it least."""
    rim = np.ones(kept.shape)
    rim[1:-1, 1:-1] = 0.0
    return np.asarray(kept + rim * (1.0 - kept.sum()) / rim.sum())


def _products(kernel: FloatArray) -> Kernel:
    """The fewest products, up to RANKS, that miss no more than TAIL."""
    left, strength, right = np.linalg.svd(kernel)
    for rank in range(1, RANKS + 1):
        root = np.sqrt(strength[:rank])
        column, row = (left[:, :rank] * root).T, right[:rank] * root[:, None]
        if rank == RANKS or np.abs(kernel - column.T @ row).sum() <= TAIL:
            break
    return Kernel(row=np.asarray(row), column=np.asarray(column / (column.T @ row).sum()))
