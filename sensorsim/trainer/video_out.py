"""Video of a view: H.264 in an MPEG transport stream with ST 0601 metadata, over UDP, RTP or to a file (extra `video`).

Each packet of metadata stands in the stream asynchronously, with the private stream id that strict decoders ask for;
its time is in the metadata itself.
"""

import math
from fractions import Fraction
from pathlib import Path
from types import TracebackType
from typing import Any, Self
from urllib.parse import urlsplit

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.trainer.frame_request import FrameRequest, ViewRequest
from sensorsim.trainer.h264_time import with_time
from sensorsim.trainer.klv import local_set
from sensorsim.trainer.local_place import LocalPlace

PRIVATE_STREAM = b"\xbd"
TICKS = 90_000  # of a transport stream's clock [s-1]
DATAGRAM = 1316  # [bytes]: seven packets of a transport stream


class VideoOut:
    """Takes pictures of one size at a steady rate. Use it in a `with`: the stream is closed at its end."""

    def __init__(self, target: str, size: tuple[int, int], rate: float, place: LocalPlace, *, source: str) -> None:
        """target: udp://host:port, rtp://host:port or the path of a .ts file; source: what the pictures are of.

        InputError for a size that the codec cannot halve, another kind of target, or where PyAV is not installed.
        """
        if size[0] % 2 or size[1] % 2:
            raise InputError("video", "size", size, "odd", "give even numbers of pixels")
        try:
            import av
        except ImportError as error:
            raise InputError("video", "target", target, "PyAV is missing", "pip install 'sensorsim[video]'") from error
        self._av, self._place, self._source, self._size = av, place, source, size
        name, form, options = _muxer(target)
        try:
            self._file: Any = av.open(name, "w", format=form, options=options)
        except (OSError, ValueError) as error:
            raise InputError("video", "target", target, str(error), "give a place that can be written to") from error
        self._rate = Fraction(rate).limit_denominator(1001)
        self._video = self._file.add_stream("libx264", rate=self._rate)
        self._video.width, self._video.height, self._video.pix_fmt = *size, "yuv420p"
        self._video.options = {"preset": "ultrafast", "tune": "zerolatency", "g": str(max(1, round(rate / 2)))}
        self._data = self._file.add_data_stream("klv")
        self._count = 0

    def write(self, picture: NDArray[np.uint8], request: FrameRequest, view: ViewRequest) -> None:
        """Puts a picture (h, w) and its metadata into the stream."""
        if picture.shape != (self._size[1], self._size[0]) or picture.dtype != np.uint8:
            raise InputError("video", "picture", picture.shape, f"not {self._size}", "give display codes of that size")
        frame = self._av.VideoFrame.from_ndarray(picture, format="gray").reformat(format="yuv420p")
        frame.pts, frame.time_base = self._count, 1 / self._rate
        metadata = view_metadata(request, view, self._place, self._size, self._source)
        self._file.mux(self._metadata_packet(metadata))
        for packet in self._video.encode(frame):  # one a picture: nothing is held back
            self._file.mux(self._timed(packet, scene_time(request)))
        self._count += 1

    def close(self) -> None:
        """Ends the stream; a second call does nothing."""
        if self._file is not None:
            self._file.mux(self._video.encode(None))
            self._file.close()
            self._file = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _timed(self, packet: Any, microseconds: int) -> Any:
        timed = self._av.Packet(with_time(bytes(packet), microseconds))
        timed.stream, timed.time_base, timed.is_keyframe = self._video, packet.time_base, packet.is_keyframe
        timed.pts, timed.dts = packet.pts, packet.dts
        return timed

    def _metadata_packet(self, data: bytes) -> Any:
        from av.packet import PacketSideData, packet_sidedata_type_from_literal

        packet = self._av.Packet(data)
        packet.stream, packet.time_base = self._data, Fraction(1, TICKS)
        packet.pts = packet.dts = round(self._count / self._rate * TICKS)
        mark = PacketSideData(packet_sidedata_type_from_literal("mpegts_stream_id"), 1)  # type: ignore[call-arg]  # the stubs lack it
        mark.update(PRIVATE_STREAM)
        packet.set_sidedata(mark)
        return packet


def scene_time(request: FrameRequest) -> int:
    """UNIX time of the scene's clock [us], 0 before 1970."""
    return max(0, round(request.moment.timestamp() * 1e6))


def view_metadata(
    request: FrameRequest, view: ViewRequest, place: LocalPlace, size: tuple[int, int], source: str
) -> bytes:
    """ST 0601 of a view: a platform that is level and heads north, and the sensor's angles against it."""
    latitude, longitude, altitude = place.geodetic(np.array(view.position))
    yaw, pitch, roll = view.angles
    wide = view.right - view.left
    high = 2.0 * math.degrees(math.atan(math.tan(math.radians(0.5 * wide)) * size[1] / size[0]))
    numbers = {
        "platform_heading": 0.0,
        "platform_pitch": 0.0,
        "platform_roll": 0.0,
        "sensor_latitude": latitude,
        "sensor_longitude": (longitude + 180.0) % 360.0 - 180.0,
        "sensor_altitude": min(max(altitude, -900.0), 19000.0),
        "horizontal_field": wide,
        "vertical_field": high,
        "relative_azimuth": (yaw + place.convergence(latitude, longitude)) % 360.0,
        "relative_elevation": pitch,
        "relative_roll": roll % 360.0,
    }
    texts = {"image_source": source, "coordinate_system": "Geodetic WGS84"}
    return local_set(scene_time(request), numbers, texts)


def _muxer(target: str) -> tuple[str, str, dict[str, str]]:
    """What PyAV opens: name, format and options of a target."""
    kind = urlsplit(target).scheme
    if kind == "udp":
        return f"{target}?pkt_size={DATAGRAM}", "mpegts", {}
    if kind == "rtp":
        return target, "rtp_mpegts", {}
    if kind == "" and target.endswith(".ts") and Path(target).parent.is_dir():
        return target, "mpegts", {}
    raise InputError(
        "video",
        "target",
        target,
        "no stream",
        "use udp://host:port, rtp://host:port or a .ts file in a folder that is there",
    )
