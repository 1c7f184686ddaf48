"""Where pictures go: a ring for other programs, a video, a bag; and a word on how it is going every so often."""

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from time import monotonic
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.trainer.bag import BagWriter
from sensorsim.trainer.frame_request import FrameRequest
from sensorsim.trainer.local_place import LocalPlace
from sensorsim.trainer.ring import PixelKind, RingWriter
from sensorsim.trainer.video_out import VideoOut

STATUS_EVERY = 10.0  # [s]
CENTIKELVIN = 100.0  # counts per kelvin
HIGHEST_COUNT = 65535
PLANE_OF = {"display": "display", "radiance": "radiance", "centikelvin": "apparent_temperature"}  # by kind of ring


@dataclass(frozen=True, slots=True, kw_only=True)
class Outlets:
    """Where pictures are to go, None where they are not. The ring takes all views, video and bag the first one."""

    ring: Path | None = None
    ring_kind: str = "display"
    video: str | None = None
    bag: Path | None = None

    @property
    def planes(self) -> tuple[str, ...]:
        """Planes that have to be drawn; InputError for an unknown kind of ring."""
        if self.ring_kind not in PLANE_OF:
            raise InputError("ring", "kind", self.ring_kind, "unknown", f"use {', '.join(PLANE_OF)}")
        wanted = {"display"} | ({PLANE_OF[self.ring_kind]} if self.ring is not None else set())
        return tuple(sorted(wanted | ({PLANE_OF["centikelvin"]} if self.bag is not None else set())))

    def open(
        self, stack: ExitStack, size: tuple[int, int], rate: float, place: LocalPlace, source: str,
        say: Callable[[str], None],
    ) -> "Delivery":  # fmt: skip
        """All of them open, until the stack is left."""
        ring = video = bag = None
        if self.bag is not None:
            bag = stack.enter_context(BagWriter(self.bag, name=source))
        if self.video is not None:
            video = stack.enter_context(VideoOut(self.video, size, rate, place, source=source))
        if self.ring is not None:
            ring = stack.enter_context(RingWriter(self.ring, cast(PixelKind, self.ring_kind), size))
        return Delivery(ring=ring, video=video, bag=bag, say=say)


class Delivery:
    """Takes the pictures of each frame."""

    def __init__(
        self, *, ring: RingWriter | None, video: VideoOut | None, bag: BagWriter | None, say: Callable[[str], None]
    ) -> None:
        self._ring, self._video, self._bag, self._say = ring, video, bag, say
        self._since, self._frames, self._late = monotonic(), 0, 0

    def __call__(self, request: FrameRequest, pictures: Mapping[int, Mapping[str, NDArray[Any]]]) -> None:
        """Hands every picture on; InputError where a sensor has none of the kind wanted."""
        seconds = request.moment.timestamp()
        for view in request.views if self._ring is not None else ():
            assert self._ring is not None
            pixels = pixels_of(pictures[view.number], self._ring.layout.kind)
            self._ring.write(pixels, frame=request.frame, time=seconds, view=view.number)
        for view in request.views[:1]:
            if self._video is not None:
                self._video.write(pictures[view.number]["display"], request, view)
            if self._bag is not None:
                counts = pixels_of(pictures[view.number], "centikelvin")
                self._bag.write(counts, max(seconds, 0.0), view.right - view.left)
        self._report(request)

    def _report(self, request: FrameRequest) -> None:
        self._frames, self._late = self._frames + 1, self._late + (not request.fresh)
        passed = monotonic() - self._since
        if passed < STATUS_EVERY:
            return
        views = ", ".join(str(view.number) for view in request.views) or "none"
        self._say(
            f"frame {request.frame}: {self._frames / passed:.1f} per second, {self._late} without their message, "
            f"clock {request.moment:%Y-%m-%d %H:%M:%S}, views {views}, {len(request.entities)} entities"
        )
        self._since, self._frames, self._late = monotonic(), 0, 0


def pixels_of(planes: Mapping[str, NDArray[Any]], kind: str) -> NDArray[Any]:
    """A view's picture as a ring of that kind holds it; temperatures beyond 655.35 K are its highest count."""
    name = PLANE_OF[kind]
    if name not in planes:
        if set(planes) == {"display"}:  # a view that is black
            shape = planes["display"].shape
            return np.zeros(shape, dtype={"radiance": np.float32, "centikelvin": np.uint16}[kind])
        raise InputError("ring", "kind", kind, f"the sensor gives {', '.join(planes)}", "choose another kind")
    data = planes[name]
    if kind == "centikelvin":
        return np.clip(np.rint(data * CENTIKELVIN), 0, HIGHEST_COUNT).astype(np.uint16)
    return np.asarray(data.astype(np.float32) if kind == "radiance" else data)
