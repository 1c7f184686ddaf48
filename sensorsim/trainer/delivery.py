"""Where pictures go: a ring for other programs, and a word on how it is going every so often."""

from collections.abc import Callable, Mapping
from time import monotonic
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.trainer.frame_request import FrameRequest
from sensorsim.trainer.ring import RingWriter

STATUS_EVERY = 10.0  # [s]
CENTIKELVIN = 100.0  # counts per kelvin
HIGHEST_COUNT = 65535


class Delivery:
    """Takes the pictures of each frame."""

    def __init__(self, *, ring: RingWriter | None, say: Callable[[str], None]) -> None:
        self._ring, self._say = ring, say
        self._since, self._frames, self._late = monotonic(), 0, 0

    def __call__(self, request: FrameRequest, pictures: Mapping[int, Mapping[str, NDArray[Any]]]) -> None:
        """Writes every view's picture to the ring; InputError where a sensor has none of the ring's kind."""
        if self._ring is not None:
            seconds = request.moment.timestamp()
            for view, planes in pictures.items():
                pixels = pixels_of(planes, self._ring.layout.kind)
                self._ring.write(pixels, frame=request.frame, time=seconds, view=view)
        self._frames, self._late = self._frames + 1, self._late + (not request.fresh)
        passed = monotonic() - self._since
        if passed >= STATUS_EVERY:
            views = ", ".join(str(view) for view in pictures) or "none"
            self._say(
                f"frame {request.frame}: {self._frames / passed:.1f} per second, {self._late} without their message, "
                f"clock {request.moment:%Y-%m-%d %H:%M:%S}, views {views}, {len(request.entities)} entities"
            )
            self._since, self._frames, self._late = monotonic(), 0, 0


def pixels_of(planes: Mapping[str, NDArray[Any]], kind: str) -> NDArray[Any]:
    """A view's picture as a ring of that kind holds it; temperatures beyond 655.35 K are its highest count."""
    name = {"display": "display", "radiance": "radiance", "centikelvin": "apparent_temperature"}[kind]
    if name not in planes:
        if set(planes) == {"display"}:  # a view that is black
            shape = planes["display"].shape
            return np.zeros(shape, dtype={"radiance": np.float32, "centikelvin": np.uint16}[kind])
        raise InputError("ring", "kind", kind, f"the sensor gives {', '.join(planes)}", "choose another kind")
    data = planes[name]
    if kind == "centikelvin":
        return np.clip(np.rint(data * CENTIKELVIN), 0, HIGHEST_COUNT).astype(np.uint16)
    return np.asarray(data.astype(np.float32) if kind == "radiance" else data)
