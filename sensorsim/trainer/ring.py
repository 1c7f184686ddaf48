"""Pictures for other programs of this machine: a ring of frames in a file that both map into memory.

Little-endian, in a file of /dev/shm or anywhere else. Header, 64 bytes:

    0  8 bytes  magic "SSRING01"          24  u32  height [pixels]
    8  u32      length of the header, 64  28  u32  kind: 1 display code u8, 2 apparent temperature u16 in 0.01 K,
    12 u32      number of slots                    3 band radiance f32 in W m-2 sr-1
    16 u32      length of a slot          32  u64  frames written so far; the last is in slot (frames - 1) % slots
    20 u32      width [pixels]            40  24 bytes of zero

A slot: u64 stamp, u64 frame number, f64 time [s], u32 view, u32 sensor, then the pixels, row 0 at the top. The stamp
is 2 n - 1 while the n-th frame is being written and 2 n when it is whole: a reader copies the slot and believes it
where the stamp was 2 n before and after. A writer never waits. The order of stores is relied on, which x86-64 keeps.
"""

import mmap
import os
import struct
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Literal

import numpy as np
import numpy.typing as npt

from sensorsim.errors import InputError

PixelKind = Literal["display", "centikelvin", "radiance"]

MAGIC = b"SSRING01"
HEADER = struct.Struct("<8sIIIIIIQ24x")
SLOT = struct.Struct("<QQdII")
COUNT_AT = 32
KINDS: tuple[tuple[PixelKind, str], ...] = (("display", "<u1"), ("centikelvin", "<u2"), ("radiance", "<f4"))
MOST_SLOTS, MOST_PIXELS = 64, 16384  # pixels on a side


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RingFrame:
    """One picture (h, w) of its ring's type, the count of frames when it was written, and what it is of."""

    count: int
    frame: int
    time: float
    view: int
    sensor: int
    pixels: npt.NDArray[np.generic]


@dataclass(frozen=True, slots=True, kw_only=True)
class RingLayout:
    """What a ring's header says."""

    kind: PixelKind
    width: int
    height: int
    slots: int

    def __post_init__(self) -> None:
        """Refuse rings that hold nothing or far too much."""
        if self.kind not in {name for name, _ in KINDS}:
            raise InputError("ring", "kind", self.kind, "unknown", f"use {', '.join(name for name, _ in KINDS)}")
        for name, least, most in (("width", 1, MOST_PIXELS), ("height", 1, MOST_PIXELS), ("slots", 2, MOST_SLOTS)):
            if not least <= getattr(self, name) <= most:
                raise InputError("ring", name, getattr(self, name), f"not {least} to {most}", "give another")

    @property
    def dtype(self) -> np.dtype[np.generic]:
        """Type of a pixel."""
        return np.dtype(dict(KINDS)[self.kind])

    @property
    def stride(self) -> int:
        """Length of a slot [bytes], a multiple of 64."""
        return -(-(SLOT.size + self.width * self.height * self.dtype.itemsize) // 64) * 64

    @property
    def size(self) -> int:
        """Length of the file [bytes]."""
        return HEADER.size + self.slots * self.stride


class RingWriter:
    """Makes the file, which appears whole, and takes it away when closed; who has it mapped keeps what was there."""

    def __init__(self, path: Path, kind: PixelKind, size: tuple[int, int], *, slots: int = 4) -> None:
        """size: width and height; InputError for a layout that is none or a folder that cannot be written to."""
        self.layout = RingLayout(kind=kind, width=size[0], height=size[1], slots=slots)
        self.path, self._count = path, 0
        number = 1 + [name for name, _ in KINDS].index(kind)
        head = HEADER.pack(MAGIC, HEADER.size, slots, self.layout.stride, size[0], size[1], number, 0)
        part = path.with_name(f".{path.name}.{os.getpid()}")
        try:
            part.write_bytes(head + bytes(self.layout.size - len(head)))
            with part.open("r+b") as file:
                self._map = mmap.mmap(file.fileno(), self.layout.size)
            part.replace(path)
        except OSError as error:
            part.unlink(missing_ok=True)
            raise InputError(path, "ring", path.name, str(error), "choose a folder that can be written to") from error

    def write(
        self, pixels: npt.NDArray[np.generic], *, frame: int, time: float, view: int = 0, sensor: int = 0
    ) -> None:
        """Puts a picture in the next slot; InputError for another shape or type than the ring's."""
        if pixels.shape != (self.layout.height, self.layout.width) or pixels.dtype != self.layout.dtype:
            wanted = f"not {self.layout.dtype} of {(self.layout.height, self.layout.width)}"
            raise InputError(self.path, "picture", (pixels.shape, str(pixels.dtype)), wanted, "convert it first")
        count = self._count + 1
        at = HEADER.size + (self._count % self.layout.slots) * self.layout.stride
        struct.pack_into("<Q", self._map, at, 2 * count - 1)
        SLOT.pack_into(self._map, at, 2 * count - 1, frame, time, view, sensor)
        data = np.ascontiguousarray(pixels).tobytes()
        self._map[at + SLOT.size : at + SLOT.size + len(data)] = data
        struct.pack_into("<Q", self._map, at, 2 * count)
        struct.pack_into("<Q", self._map, COUNT_AT, count)
        self._count = count

    def close(self) -> None:
        """Unmaps and removes the file; a second call does nothing."""
        if not self._map.closed:
            self._map.close()
            self.path.unlink(missing_ok=True)

    def __enter__(self) -> "RingWriter":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


class RingReader:
    """Maps a ring that is there, for reading only."""

    def __init__(self, path: Path) -> None:
        """InputError for a file that is not there, is no ring, or is shorter than its header says."""
        try:
            with path.open("rb") as file:
                self._map = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        except (OSError, ValueError) as error:
            raise InputError(path, "ring", path.name, str(error), "start the writer first") from error
        self.layout = self._layout(path)

    def latest(self, after: int = 0) -> RingFrame | None:
        """The newest whole picture if more than `after` frames have been written, else None; its pixels are a copy."""
        for _ in range(3):  # a writer that laps us during the copy leaves a newer frame behind
            (count,) = struct.unpack_from("<Q", self._map, COUNT_AT)
            if count <= after:
                return None
            at = HEADER.size + ((count - 1) % self.layout.slots) * self.layout.stride
            stamp, frame, time, view, sensor = SLOT.unpack_from(self._map, at)
            shape = (self.layout.height, self.layout.width)
            flat = np.frombuffer(self._map, self.layout.dtype, shape[0] * shape[1], at + SLOT.size)
            pixels = flat.reshape(shape).copy()
            del flat
            if stamp == 2 * count == struct.unpack_from("<Q", self._map, at)[0]:
                return RingFrame(count=count, frame=frame, time=time, view=view, sensor=sensor, pixels=pixels)
        return None

    def close(self) -> None:
        """Unmaps; a second call does nothing."""
        self._map.close()

    def __enter__(self) -> "RingReader":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _layout(self, path: Path) -> RingLayout:
        remedy = "give the file of a RingWriter"
        if len(self._map) < HEADER.size:
            raise InputError(path, "ring", len(self._map), "shorter than a header", remedy)
        magic, head, slots, stride, width, height, number, _ = HEADER.unpack_from(self._map)
        if magic != MAGIC or head != HEADER.size or not 1 <= number <= len(KINDS):
            raise InputError(path, "header", magic, "no ring of this version", remedy)
        layout = RingLayout(kind=KINDS[number - 1][0], width=width, height=height, slots=slots)
        if stride != layout.stride or len(self._map) < layout.size:
            raise InputError(path, "size", len(self._map), f"not the {layout.size} bytes of its header", remedy)
        return layout
