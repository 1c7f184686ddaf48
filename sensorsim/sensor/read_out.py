"""What the detector reports of the light on its focal plane: noise in three dimensions, fixed pattern, counts.

U = S + sigma(S) (N_tvh + N_vh + N_v + N_h + N_t + N_tv + N_th) [DAgostino1991], rows and columns as read from the top
left; gains that differ show by what the light differs from that of the last correction. The NumPy twin of
shaders/sensor/detect.frag, which gets the same tables.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.radiometry import FloatArray, band_radiance
from sensorsim.sensor.dead_elements import seeing
from sensorsim.sensor.random_field import normal_deviate, place_rank
from sensorsim.sensor.sensitivity import Sensitivity
from sensorsim.sensor.sensor import Sensor

STREAMS = {"tvh": 0, "vh": 1, "v": 2, "h": 3, "t": 4, "tv": 5, "th": 6, "gain": 7, "dead": 8}
IntArray = NDArray[np.int64]
_FIRST = np.zeros(1, dtype=np.int64)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FrameNoise:
    """Deviates of one frame that are not random from element to element."""

    row: FloatArray  # (height,)
    line: FloatArray  # (width,)


def stream_seed(sensor: Sensor, name: str) -> int:
    """Seed of one of the STREAMS of a sensor."""
    return (sensor.noise.seed * len(STREAMS) + STREAMS[name]) % 2**32


def fixed_pattern(sensor: Sensor, size: tuple[int, int]) -> FloatArray:
    """Of each element (height, width, 4): deviate that stays, gain less one, 1 where it sees, 0."""
    column, row = np.arange(size[0])[None, :], np.arange(size[1])[:, None]
    noise = sensor.noise
    pattern = np.zeros((size[1], size[0], 4))
    pattern[..., 0] = noise.vh * normal_deviate(column, row, 0, stream_seed(sensor, "vh"))
    pattern[..., 1] = noise.gain * normal_deviate(column, row, 0, stream_seed(sensor, "gain"))
    pattern[..., 2] = seeing(place_rank(column, row, stream_seed(sensor, "dead")), noise.dead)
    return pattern


def frame_noise(sensor: Sensor, size: tuple[int, int], frame: int) -> FrameNoise:
    """Deviates of the rows and columns of a frame."""
    noise = sensor.noise
    column, row = np.arange(size[0], dtype=np.int64), np.arange(size[1], dtype=np.int64)
    shared = sensor.scan.pattern == "parallel" and sensor.scan.channels < size[1]
    channel: IntArray = row * sensor.scan.channels // size[1] if shared else row

    def part(name: str, place: IntArray, moment: int) -> FloatArray:
        return float(getattr(noise, name)) * normal_deviate(place, _FIRST, moment, stream_seed(sensor, name))

    return FrameNoise(
        row=part("v", channel, 0) + part("tv", row, frame) + part("t", _FIRST, frame),
        line=part("h", column, 0) + part("th", column, frame),
    )


def correction_radiance(sensor: Sensor) -> float:
    """Band radiance [W m-2 sr-1] where gains that differ do not show; none in reflective bands."""
    return float(band_radiance(sensor.band, sensor.noise.corrected_at)) if sensor.mode == "emissive" else 0.0


def read_out(sensor: Sensor, look: Sensitivity, light: FloatArray, frame: int) -> FloatArray:
    """Band radiance (height, width) [W m-2 sr-1] that is reported of `light` on the focal plane, in whole counts."""
    height, width = light.shape
    pattern, moment = fixed_pattern(sensor, (width, height)), frame_noise(sensor, (width, height), frame)
    column, row = np.arange(width)[None, :], np.arange(height)[:, None]
    deviate = normal_deviate(column, row, frame, stream_seed(sensor, "tvh")) + pattern[..., 0]
    deviate = deviate + moment.row[:, None] + moment.line[None, :]
    signal = light + pattern[..., 1] * (light - correction_radiance(sensor)) + look.deviation(light) * deviate
    count = np.clip(np.floor(signal * pattern[..., 2] / look.step + 0.5), 0.0, round(look.full / look.step))
    return np.asarray(count * look.step)
