"""Frames of several sensors in one picture, where they show the same moment from the same place."""

from collections.abc import Sequence
from pathlib import Path

import imageio.v3 as imageio
import numpy as np
import numpy.typing as npt

from sensorsim.errors import InputError
from sensorsim.files import placed_whole
from sensorsim.frames.reader import read_sidecar

LOCKED = ("time_of_day_s", "frame", "camera")  # settings in which the frames must agree


def join_frames(pictures: Sequence[Path], target: Path) -> None:
    """Write display pictures of one instant, camera and frame number as one, from left to right.

    The lower ones stand in the middle between black. InputError, naming the setting, for frames that are not locked.
    """
    settings = [read_sidecar(picture)["settings"] for picture in pictures]
    for name in LOCKED:
        for picture, other in zip(pictures, settings, strict=True):
            if other.get(name) != settings[0].get(name):
                problem = f"differs from that of {pictures[0].name}"
                raise InputError(picture, name, other.get(name), problem, "draw both with the same settings")
    joined = beside([imageio.imread(picture) for picture in pictures])
    with placed_whole(target) as (partial,):
        imageio.imwrite(partial, joined)


def beside(pictures: Sequence[npt.NDArray[np.uint8]]) -> npt.NDArray[np.uint8]:
    """Pictures (height, width) from left to right, the lower ones in the middle between black."""
    height = max(picture.shape[0] for picture in pictures)
    over = [(height - picture.shape[0]) // 2 for picture in pictures]
    padded = [
        np.pad(picture, ((above, height - picture.shape[0] - above), (0, 0)))
        for picture, above in zip(pictures, over, strict=True)
    ]
    return np.concatenate(padded, axis=1)
