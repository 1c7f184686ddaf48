"""Pictures joined to a video: GIF with what the core has, MP4 through PyAV (extra `video`)."""

import math
from collections.abc import Sequence
from pathlib import Path

import imageio.v3 as imageio
import numpy as np

from sensorsim.errors import InputError
from sensorsim.files import placed_whole

VIDEO_SUFFIXES = ("gif", "mp4")


def write_video(pictures: Sequence[Path], target: Path, rate: float) -> None:
    """Write pictures of one size as a video of `rate` [1/s]; the file appears whole or not at all.

    Raises InputError for an unknown kind of file, a rate that is no rate, and MP4 where PyAV is not installed.
    """
    kind = target.suffix.lower().lstrip(".")
    if kind not in VIDEO_SUFFIXES:
        raise InputError(target, "video", kind, "unknown", f"use {' or '.join(VIDEO_SUFFIXES)}")
    if not (math.isfinite(rate) and 0.0 < rate <= 1000.0):
        raise InputError(target, "rate", rate, "not above 0 and up to 1000 per second", "give pictures per second")
    try:
        with placed_whole(target) as (partial,):
            if kind == "gif":
                imageio.imwrite(partial, [imageio.imread(path) for path in pictures], duration=1000.0 / rate, loop=0)
            else:
                _write_mp4(pictures, partial, rate)
    except ImportError as error:
        raise InputError(
            target, "video", "mp4", "PyAV is missing", "pip install 'sensorsim[video]', or use gif"
        ) from error


def _write_mp4(pictures: Sequence[Path], target: Path, rate: float) -> None:
    with imageio.imopen(target, "w", plugin="pyav") as file:
        file.init_video_stream("libx264", fps=round(rate))
        for path in pictures:
            grey = imageio.imread(path)
            even = grey[: grey.shape[0] // 2 * 2, : grey.shape[1] // 2 * 2]  # the format halves its colour planes
            file.write_frame(np.repeat(even[:, :, None], 3, axis=2))
