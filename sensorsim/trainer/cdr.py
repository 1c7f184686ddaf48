"""Messages of ROS 2 as bytes: CDR, little-endian, each value at a multiple of its own size [OMGCDR2021]."""

import struct

import numpy as np
from numpy.typing import NDArray

ENCAPSULATION = b"\x00\x01\x00\x00"
STAMP = "builtin_interfaces/Time stamp\nstring frame_id\n"
RULE = "=" * 80 + "\n"
TIME = f"{RULE}MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n"
HEADER = f"{RULE}MSG: std_msgs/Header\n{STAMP}{TIME}"
ROI = (
    f"{RULE}MSG: sensor_msgs/RegionOfInterest\nuint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\n"
    "bool do_rectify\n"
)
IMAGE_TYPE, CAMERA_TYPE = "sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo"
IMAGE = (
    "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\n"
    f"uint8[] data\n{HEADER}"
)
CAMERA = (
    "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\nfloat64[] d\nfloat64[9] k\n"
    "float64[9] r\nfloat64[12] p\nuint32 binning_x\nuint32 binning_y\nsensor_msgs/RegionOfInterest roi\n"
    f"{HEADER}{ROI}"
)


class _Bytes:
    """Values one after the other."""

    def __init__(self) -> None:
        self._data = bytearray()

    def put(self, code: str, *values: float) -> None:
        """Numbers of one struct code."""
        size = struct.calcsize(code)
        for value in values:
            self._data += bytes(-len(self._data) % size)
            self._data += struct.pack(f"<{code}", value)

    def text(self, text: str) -> None:
        """A string with its length and a zero at its end."""
        encoded = text.encode("ascii") + b"\x00"
        self.put("I", len(encoded))
        self._data += encoded

    def block(self, data: bytes) -> None:
        """Bytes with their length."""
        self.put("I", len(data))
        self._data += data

    def message(self) -> bytes:
        """All of it."""
        return ENCAPSULATION + bytes(self._data)


def image_message(pixels: NDArray[np.uint16], nanoseconds: int, frame: str) -> bytes:
    """An Image 16UC1 of counts (h, w)."""
    out = _Bytes()
    _header(out, nanoseconds, frame)
    out.put("I", *pixels.shape)
    out.text("16UC1")
    out.put("B", 0)
    out.put("I", 2 * pixels.shape[1])
    out.block(np.ascontiguousarray(pixels, dtype="<u2").tobytes())
    return out.message()


def camera_message(size: tuple[int, int], focal: float, nanoseconds: int, frame: str) -> bytes:
    """A CameraInfo without distortion; focal length [pixels]; the axis goes through the middle of the picture."""
    (width, height), out = size, _Bytes()
    across, down = 0.5 * (width - 1), 0.5 * (height - 1)
    _header(out, nanoseconds, frame)
    out.put("I", height, width)
    out.text("plumb_bob")
    out.put("I", 5)
    out.put("d", *[0.0] * 5)
    out.put("d", focal, 0.0, across, 0.0, focal, down, 0.0, 0.0, 1.0)
    out.put("d", *np.eye(3).ravel().tolist())
    out.put("d", focal, 0.0, across, 0.0, 0.0, focal, down, 0.0, 0.0, 0.0, 1.0, 0.0)
    out.put("I", *[0] * 6)
    out.put("B", 0)
    return out.message()


def _header(out: _Bytes, nanoseconds: int, frame: str) -> None:
    out.put("i", nanoseconds // 10**9)
    out.put("I", nanoseconds % 10**9)
    out.text(frame)
