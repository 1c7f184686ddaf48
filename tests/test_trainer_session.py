"""The loop on loopback: a host in a thread that answers each Start of Frame, for a fixed number of frames."""

import socket
import threading
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager

import numpy as np
import pytest
from cigi_samples import first_packet
from numpy.typing import NDArray
from trainer_world import Host, entity

from sensorsim.errors import InputError
from sensorsim.trainer.decode import decode_message
from sensorsim.trainer.dialect import CIGI_33
from sensorsim.trainer.encode import encode_message
from sensorsim.trainer.frame_request import FrameRequest
from sensorsim.trainer.session import run_session
from sensorsim.trainer.udp import Endpoint, UdpEndpoint

FRAMES = 25
PATIENT = {"rate": 10.0, "wait_share": 0.9}  # 90 ms for an answer: a busy machine grants them too
Pictures = Mapping[int, Mapping[str, NDArray[np.generic]]]


def draw(request: FrameRequest) -> Pictures:
    """Each view's display shows the frame's number."""
    return {view.number: {"display": np.full((4, 6), request.frame % 256, np.uint8)} for view in request.views}


class AnsweringHost:
    """Answers every Start of Frame but those it is told to leave out; keeps what it was told."""

    def __init__(self, silent: frozenset[int] = frozenset()) -> None:
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.socket.settimeout(2.0)
        self.silent, self.frames, self.echoes = silent, list[int](), list[int]()
        self.target = 0

    def run(self) -> None:
        for _ in range(FRAMES):
            try:
                values = decode_message(self.socket.recv(2000)).packets[0].values
            except TimeoutError:
                return
            frame = int(values["ig_frame_number"])
            self.frames.append(frame)
            self.echoes.append(int(values["last_host_frame_number"]))
            if frame not in self.silent:
                first = first_packet(host_frame_number=700 + frame, last_ig_frame_number=frame)
                data = encode_message(CIGI_33, [first, entity(0.0, float(frame), 50.0)])
                self.socket.sendto(data, ("127.0.0.1", self.target))


@contextmanager
def host_and_link(silent: frozenset[int] = frozenset()) -> Iterator[tuple[AnsweringHost, UdpEndpoint]]:
    host = AnsweringHost(silent)
    with UdpEndpoint(Endpoint(port=0, host_port=host.socket.getsockname()[1])) as link:
        host.target = link.port
        thread = threading.Thread(target=host.run)
        thread.start()
        yield host, link
        thread.join()
        host.socket.close()


def test_every_frame_has_its_start_its_answer_and_its_picture() -> None:
    delivered: list[tuple[int, bool, int]] = []

    def deliver(request: FrameRequest, pictures: Pictures) -> None:
        delivered.append((request.frame, request.fresh, int(pictures[0]["display"][0, 0]) if pictures else -1))

    ig = Host().ig
    with host_and_link() as (host, link):
        report = run_session(ig, link, draw, deliver, frames=FRAMES, **PATIENT)
    assert host.frames == list(range(FRAMES))
    assert [frame for frame, _, _ in delivered] == list(range(FRAMES))
    assert report.frames == FRAMES
    assert report.late == sum(not fresh for _, fresh, _ in delivered) <= 2
    assert all(shown == frame for frame, fresh, shown in delivered if fresh)
    assert host.echoes[0] == 0
    assert host.echoes == sorted(host.echoes)
    assert report.interval[0] == pytest.approx(0.1, abs=0.01)
    assert 0.0 < report.latency[0] < 0.09


def test_frames_that_the_host_leaves_out_are_drawn_all_the_same() -> None:
    seen: dict[int, bool] = {}
    ig = Host().ig
    with host_and_link(silent=frozenset({7, 8, 20})) as (_, link):
        report = run_session(
            ig, link, draw, lambda request, _: seen.update({request.frame: request.fresh}), frames=FRAMES, **PATIENT
        )
    assert len(seen) == FRAMES
    assert not seen[7]
    assert not seen[8]
    assert not seen[20]
    assert 3 <= report.late <= 5


class Silence:
    """A host that is not there."""

    def receive(self, timeout: float) -> bytes | None:
        time.sleep(timeout)
        return None

    def send(self, data: bytes) -> bool:
        return bool(data)


def test_a_picture_that_takes_too_long_costs_whole_periods_and_no_more() -> None:
    def slow(request: FrameRequest) -> Pictures:
        time.sleep(0.05 if request.frame == 2 else 0.0)
        return {}

    report = run_session(Host().ig, Silence(), slow, lambda *_: None, rate=100.0, frames=6, wait_share=0.1)
    assert report.frames == report.late == 6
    assert report.overrun >= 4
    assert np.isnan(report.latency[0])


def test_a_session_stops_when_told() -> None:
    drawn: list[int] = []
    report = run_session(
        Host().ig,
        Silence(),
        draw,
        lambda request, _: drawn.append(request.frame),
        rate=200.0,
        frames=1000,
        stop=lambda: len(drawn) >= 5,
    )
    assert report.frames == 5


def test_an_asynchronous_session_takes_what_has_come_and_does_not_wait() -> None:
    host = Host(synchronous=False)
    start = time.monotonic()
    report = run_session(host.ig, Silence(), draw, lambda *_: None, rate=100.0, frames=10)
    assert report.frames == 10
    assert time.monotonic() - start > 0.09


@pytest.mark.parametrize("values", [{"rate": 0.0}, {"rate": float("nan")}, {"frames": 0}, {"wait_share": 1.5}])
def test_a_session_that_cannot_be_is_refused(values: dict[str, float]) -> None:
    with pytest.raises(InputError, match=next(iter(values))):
        run_session(Host().ig, Silence(), draw, lambda *_: None, **({"frames": 1} | values))  # type: ignore[arg-type]
