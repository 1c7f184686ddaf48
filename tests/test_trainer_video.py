"""Video, its metadata and bags: read back by what did not write them, value by value."""

import socket
import struct
from datetime import UTC, datetime, timedelta
from pathlib import Path

import av
import numpy as np
import pytest
from mcap.reader import make_reader
from test_trainer_pictures import MORNING, VIEW, frame
from trainer_world import PLACE

from sensorsim.errors import InputError
from sensorsim.trainer.bag import BagWriter
from sensorsim.trainer.h264_time import IDENTIFIER, time_message, with_time
from sensorsim.trainer.klv import ITEMS, KEY, checksum, length, local_set
from sensorsim.trainer.video_out import VideoOut, view_metadata

SIZE, RATE = (64, 48), 30.0
NUMBERS = {"sensor_latitude": 39.8, "sensor_longitude": -84.02, "platform_pitch": -3.5, "horizontal_field": 50.0}


def items_of(data: bytes) -> dict[int, bytes]:
    """Tags and values of a local set, read by its rules alone."""
    assert data[:16] == KEY
    count, place = data[16], 17
    if count >= 128:
        place += count - 128
        count = int.from_bytes(data[17:place], "big")
    assert place + count == len(data)
    items = {}
    while place < len(data):
        tag, size = data[place], data[place + 1]
        items[tag] = data[place + 2 : place + 2 + size]
        place += 2 + size
    return items


def ramp(number: int) -> np.ndarray:
    y, x = np.mgrid[: SIZE[1], : SIZE[0]]
    return ((2 * x + y + 3 * number) % 200 + 20).astype(np.uint8)


def write(target: str, count: int) -> None:
    with VideoOut(target, SIZE, RATE, PLACE, source="flir") as video:
        for number in range(count):
            video.write(ramp(number), frame(VIEW, moment=MORNING + timedelta(seconds=number / RATE)), VIEW)


def test_a_set_holds_its_items_and_a_sum_that_is_right() -> None:
    data = local_set(1_700_000_000_123_456, NUMBERS, {"image_source": "flir"})
    items = items_of(data)
    assert list(items) == [2, 6, 11, 13, 14, 16, 65, 1]
    assert struct.unpack(">Q", items[2])[0] == 1_700_000_000_123_456
    assert items[11] == b"flir"
    assert struct.unpack(">i", items[13])[0] * 180.0 / (2**32 - 2) == pytest.approx(39.8, abs=1e-7)
    assert struct.unpack(">h", items[6])[0] * 40.0 / (2**16 - 2) == pytest.approx(-3.5, abs=1e-3)
    assert struct.unpack(">H", items[16])[0] * 180.0 / (2**16 - 1) == pytest.approx(50.0, abs=2e-3)
    words = data[:-2] + bytes(len(data[:-2]) % 2)
    assert sum(struct.unpack(f">{len(words) // 2}H", words)) % 65536 == struct.unpack(">H", items[1])[0]
    assert checksum(b"") == 0
    assert checksum(b"\x01") == 256
    assert checksum(bytes.fromhex("060e2b34020081bb")) == 0xB4FD  # the standard's own example


def test_ends_of_ranges_are_the_ends_of_the_integers() -> None:
    for name, item in ITEMS.items():
        ends = [int.from_bytes(item.encode(name, value), "big", signed=item.low < 0) for value in (item.low, item.high)]
        whole = 256**item.size
        signed = item.low == -item.high
        assert ends == ([-(whole // 2 - 1), whole // 2 - 1] if signed else [0, whole - 1]) or item.tag == 15
    altitude = ITEMS["sensor_altitude"]
    assert [int.from_bytes(altitude.encode("", value), "big") for value in (-900.0, 19000.0)] == [0, 65535]


@pytest.mark.parametrize("value", [90.1, float("nan"), float("inf"), -1e9])
def test_values_outside_of_their_range_are_refused(value: float) -> None:
    with pytest.raises(InputError, match="sensor_latitude"):
        local_set(0, {"sensor_latitude": value}, {})


def test_unknown_items_and_odd_texts_are_refused() -> None:
    for numbers, texts in (
        ({"height": 1.0}, {}),
        ({}, {"mission": ""}),
        ({}, {"mission": "x" * 200}),
        ({}, {"a": "b"}),
    ):
        with pytest.raises(InputError):
            local_set(0, numbers, texts)


@pytest.mark.parametrize(
    ("count", "bytes_of"), [(0, b"\0"), (127, b"\x7f"), (128, b"\x81\x80"), (300, b"\x82\x01\x2c")]
)
def test_lengths_are_those_of_ber(count: int, bytes_of: bytes) -> None:
    assert length(count) == bytes_of


def test_metadata_of_a_view_say_where_it_is_and_looks() -> None:
    items = items_of(view_metadata(frame(), VIEW, PLACE, SIZE, "flir"))
    latitude = struct.unpack(">i", items[13])[0] * 180.0 / (2**32 - 2)
    longitude = struct.unpack(">i", items[14])[0] * 360.0 / (2**32 - 2)
    east, north, _ = PLACE.local(latitude, longitude, 0.0)
    assert (east, north) == pytest.approx(VIEW.position[:2], abs=0.02)
    assert struct.unpack(">I", items[18])[0] * 360.0 / (2**32 - 1) == pytest.approx(46.0, abs=0.01)
    assert struct.unpack(">i", items[19])[0] * 360.0 / (2**32 - 2) == pytest.approx(-15.0, abs=1e-6)
    past = frame(moment=datetime(1950, 1, 1, tzinfo=UTC))
    assert struct.unpack(">Q", items_of(view_metadata(past, VIEW, PLACE, SIZE, "x"))[2])[0] == 0


def test_a_stream_gives_back_pictures_and_metadata(tmp_path: Path) -> None:
    write(str(tmp_path / "a.ts"), 20)
    with av.open(tmp_path / "a.ts") as file:
        assert [stream.codec_context.name if stream.type == "video" else "klv" for stream in file.streams] == [
            "h264",
            "klv",
        ]
        packets = [(packet.stream.type, bytes(packet)) for packet in file.demux() if packet.size]
    sets = [data for kind, data in packets if kind == "data"]
    times = [struct.unpack(">Q", items_of(data)[2])[0] for data in sets]
    assert times == [round((MORNING + timedelta(seconds=n / RATE)).timestamp() * 1e6) for n in range(20)]
    units = [data for kind, data in packets if kind == "video"]
    assert [unit.count(IDENTIFIER) for unit in units] == [1] * 20
    with av.open(tmp_path / "a.ts") as file:
        shown = [picture.to_ndarray(format="gray") for picture in file.decode(video=0)]
    assert len(shown) == 20
    for number, picture in enumerate(shown):
        assert np.abs(picture.astype(int) - ramp(number)).mean() < 8.0


@pytest.mark.parametrize("scheme", ["udp", "rtp"])
def test_a_stream_over_the_network_is_whole_packets(scheme: str) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as heard:
        heard.bind(("127.0.0.1", 0))
        heard.settimeout(5.0)
        heard.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
        write(f"{scheme}://127.0.0.1:{heard.getsockname()[1]}", 10)
        data = [heard.recv(2000) for _ in range(3)]
    for datagram in data:
        payload = datagram[12:] if scheme == "rtp" else datagram
        assert scheme == "udp" or (datagram[0] >> 6, datagram[1] & 127) == (2, 33)
        assert len(payload) % 188 == 0
        assert set(payload[::188]) == {0x47}


@pytest.mark.parametrize(
    ("target", "size"),
    [("http://127.0.0.1/x", SIZE), ("x.avi", SIZE), ("x.ts", (63, 48)), ("/nowhere/at/all/x.ts", SIZE)],
)
def test_videos_that_cannot_be_are_refused(target: str, size: tuple[int, int]) -> None:
    with pytest.raises(InputError, match="video"):
        VideoOut(target, size, RATE, PLACE, source="flir")


def test_the_time_stands_before_the_first_slice_and_has_no_start_code_in_it() -> None:
    unit = b"\0\0\0\1\x67abc\0\0\0\1\x68d\0\0\1\x65slice\0\0\1\x65more"
    timed = with_time(unit, 0)
    assert timed == b"\0\0\0\1\x67abc\0\0\0\1\x68d" + time_message(0) + b"\0\0\1\x65slice\0\0\1\x65more"
    assert b"\0\0\1" not in time_message(0)[4:]
    assert b"\0\0\0" not in time_message(2**40)[4:]
    assert with_time(b"no start", 5) == b"no start"
    assert with_time(b"", 5) == b""
    assert len(time_message(0)) == 4 + 3 + 28 + 1


def cdr_header(data: bytes) -> tuple[int, int, str, int]:
    """Seconds, nanoseconds, frame, and where the message goes on."""
    assert data[:4] == b"\0\1\0\0"
    seconds, nano, count = struct.unpack_from("<iII", data, 4)
    return seconds, nano, data[16 : 16 + count - 1].decode(), 16 + count


def test_a_bag_gives_back_kelvin_and_the_camera(tmp_path: Path) -> None:
    counts = np.array([[29315, 31315, 65535], [0, 1, 2]], dtype=np.uint16)
    with BagWriter(tmp_path / "a.mcap") as bag:
        assert not (tmp_path / "a.mcap").exists()
        bag.write(counts, 192553200.25, 90.0)
        bag.write(counts + np.uint16(0), 192553201.0, 90.0)
    with (tmp_path / "a.mcap").open("rb") as file:
        found = [
            (schema.name, channel.topic, message.data) for schema, channel, message in make_reader(file).iter_messages()
        ]
    assert [(name, topic) for name, topic, _ in found][:2] == [
        ("sensor_msgs/msg/Image", "/flir/image_raw"), ("sensor_msgs/msg/CameraInfo", "/flir/camera_info")
    ]  # fmt: skip
    assert len(found) == 4
    data = found[0][2]
    seconds, nano, name, place = cdr_header(data)
    assert (seconds, nano, name) == (192553200, 250_000_000, "flir_optical_frame")
    place += (4 - place) % 4
    height, width, text = struct.unpack_from("<III", data, place)
    assert (height, width, text, data[place + 12 : place + 17]) == (2, 3, 6, b"16UC1")
    np.testing.assert_array_equal(np.frombuffer(data[-12:], "<u2").reshape(2, 3), counts)
    numbers = np.frombuffer(found[1][2], "<f8", 14, offset=4 + 64)  # five of distortion, then the matrix
    np.testing.assert_allclose(numbers, [0, 0, 0, 0, 0, 1.5, 0, 1.0, 0, 1.5, 0.5, 0, 0, 1], atol=1e-12)
    with pytest.raises(ValueError, match="stop"), BagWriter(tmp_path / "b.mcap"):
        raise ValueError("stop")
    assert [path.name for path in tmp_path.iterdir()] == ["a.mcap"]


@pytest.mark.parametrize(
    ("pixels", "seconds", "field"),
    [(np.zeros((2, 2), np.uint8), 0.0, 40.0), (np.zeros(4, np.uint16), 0.0, 40.0),
     (np.zeros((2, 2), np.uint16), -1.0, 40.0), (np.zeros((2, 2), np.uint16), 0.0, 180.0)],
)  # fmt: skip
def test_pictures_that_are_none_do_not_go_into_a_bag(
    tmp_path: Path, pixels: np.ndarray, seconds: float, field: float
) -> None:
    with BagWriter(tmp_path / "a.mcap") as bag, pytest.raises(InputError):
        bag.write(pixels, seconds, field)
