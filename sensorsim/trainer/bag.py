"""Thermal pictures as an MCAP bag of ROS 2 messages: Image 16UC1 in hundredths of a kelvin, and CameraInfo (extra
`mcap`)."""

import math
import secrets
from pathlib import Path
from types import TracebackType
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.trainer.cdr import CAMERA, CAMERA_TYPE, IMAGE, IMAGE_TYPE, camera_message, image_message


class BagWriter:
    """A bag that appears whole when it is closed. Use it in a `with`: an error in it leaves no file behind."""

    def __init__(self, path: Path, *, name: str = "flir") -> None:
        """name: of the sensor, in topics and frames; InputError where mcap is missing or the file cannot be made."""
        try:
            from mcap.writer import Writer
        except ImportError as error:
            raise InputError(path, "bag", path.name, "mcap is missing", "pip install 'sensorsim[mcap]'") from error
        self._path, self._name = path, name
        self._partial = path.with_name(f".{path.name}.{secrets.token_hex(4)}.partial")
        try:
            self._file = self._partial.open("wb")
        except OSError as error:
            raise InputError(path, "bag", path.name, str(error), "choose a folder that can be written to") from error
        self._writer: Any = Writer(self._file)
        self._writer.start(profile="ros2", library="sensorsim")
        self._image = self._channel("image_raw", IMAGE_TYPE, IMAGE)
        self._camera = self._channel("camera_info", CAMERA_TYPE, CAMERA)
        self._count = 0

    def write(self, pixels: NDArray[np.uint16], seconds: float, horizontal_field: float) -> None:
        """A picture (h, w) in 0.01 K at a UNIX time [s], of a horizontal field [deg]."""
        if pixels.ndim != 2 or pixels.dtype != np.uint16:
            raise InputError(
                self._path, "picture", (pixels.shape, str(pixels.dtype)), "no uint16 picture", "convert it"
            )
        if not 0.0 < horizontal_field < 180.0 or not 0.0 <= seconds < 2**31:
            raise InputError(self._path, "field or time", (horizontal_field, seconds), "out of range", "give deg and s")
        height, width = pixels.shape
        stamp, frame = round(seconds * 1e9), f"{self._name}_optical_frame"
        focal = 0.5 * width / math.tan(math.radians(0.5 * horizontal_field))
        for channel, data in (
            (self._image, image_message(pixels, stamp, frame)),
            (self._camera, camera_message((width, height), focal, stamp, frame)),
        ):
            self._writer.add_message(channel, stamp, data, stamp, self._count)
        self._count += 1

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._writer.finish()
        self._file.close()
        if error is None:
            self._partial.replace(self._path)
        else:
            self._partial.unlink(missing_ok=True)

    def _channel(self, topic: str, kind: str, text: str) -> int:
        schema = self._writer.register_schema(kind, "ros2msg", text.encode("ascii"))
        return int(self._writer.register_channel(f"/{self._name}/{topic}", "cdr", schema))
