"""The endpoint on loopback: who is heard, how fast, and how it closes. Every loop has a fixed count."""

import socket
import threading
import time
from collections.abc import Iterator

import pytest
from cigi_samples import first_packet
from trainer_world import Host, entity

from sensorsim.errors import InputError
from sensorsim.trainer.decode import decode_message
from sensorsim.trainer.dialect import CIGI_33
from sensorsim.trainer.encode import encode_message
from sensorsim.trainer.udp import Endpoint, UdpEndpoint

PATIENCE = 5.0  # [s] for what must come


@pytest.fixture
def listener() -> Iterator[socket.socket]:
    """Where the host listens."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        opened.bind(("127.0.0.1", 0))
        opened.settimeout(PATIENCE)
        yield opened


@pytest.fixture
def sender() -> Iterator[socket.socket]:
    """Where the host sends from: another port than it listens on, as real hosts do."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        opened.bind(("127.0.0.1", 0))
        opened.settimeout(PATIENCE)
        yield opened


def opened(listener: socket.socket, **values: object) -> UdpEndpoint:
    return UdpEndpoint(Endpoint(port=0, host_port=listener.getsockname()[1], **values))  # type: ignore[arg-type]


def test_it_is_bound_to_this_machine_unless_told_otherwise() -> None:
    assert Endpoint().address == Endpoint().host == "127.0.0.1"


def test_datagrams_of_the_host_come_through_and_answers_go_to_its_port(
    listener: socket.socket, sender: socket.socket
) -> None:
    with opened(listener) as endpoint:
        sender.sendto(b"hello", ("127.0.0.1", endpoint.port))
        assert endpoint.receive(PATIENCE) == b"hello"
        assert endpoint.send(b"frame")
        assert listener.recv(100) == b"frame"
        assert endpoint.served == 1


def test_answers_go_to_where_the_host_sends_from_when_asked(listener: socket.socket, sender: socket.socket) -> None:
    with opened(listener, reply_to_sender=True) as endpoint:
        sender.sendto(b"hello", ("127.0.0.1", endpoint.port))
        assert endpoint.receive(PATIENCE) == b"hello"
        assert endpoint.send(b"frame")
        assert sender.recv(100) == b"frame"


def test_datagrams_of_others_are_dropped_and_counted(listener: socket.socket, sender: socket.socket) -> None:
    with opened(listener, host="127.0.0.2") as endpoint:
        for _ in range(5):
            sender.sendto(b"hello", ("127.0.0.1", endpoint.port))
        assert endpoint.receive(0.2) is None
        assert (endpoint.from_others, endpoint.served) == (5, 0)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as host:
            host.bind(("127.0.0.2", 0))
            host.sendto(b"it is me", ("127.0.0.1", endpoint.port))
        assert endpoint.receive(PATIENCE) == b"it is me"


def test_no_more_than_the_rate_is_served(listener: socket.socket, sender: socket.socket) -> None:
    """A burst of 100 at 50 per second: five at once, and what trickles in while they are read."""
    with opened(listener, rate=50.0) as endpoint:
        for _ in range(100):
            sender.sendto(b"x", ("127.0.0.1", endpoint.port))
        start = time.monotonic()
        for _ in range(100):
            endpoint.receive(0.01)
        allowed = 5 + 50.0 * (time.monotonic() - start) + 1
        assert 5 <= endpoint.served <= allowed
        assert endpoint.served + endpoint.too_fast == 100


def test_waiting_ends_in_time_whatever_others_send(listener: socket.socket, sender: socket.socket) -> None:
    with opened(listener, host="127.0.0.2") as endpoint:
        stop = threading.Event()

        def chatter() -> None:
            for _ in range(2000):
                if stop.is_set():
                    return
                sender.sendto(b"x", ("127.0.0.1", endpoint.port))
                time.sleep(0.0005)

        thread = threading.Thread(target=chatter)
        thread.start()
        start = time.monotonic()
        assert endpoint.receive(0.1) is None
        waited = time.monotonic() - start
        stop.set()
        thread.join()
        assert 0.09 < waited < 1.0


def test_a_closed_host_does_no_harm(sender: socket.socket) -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as gone:
        gone.bind(("127.0.0.1", 0))
        port = gone.getsockname()[1]
    with UdpEndpoint(Endpoint(port=0, host_port=port)) as endpoint:
        for _ in range(3):
            endpoint.send(b"into the void")
        sender.sendto(b"hello", ("127.0.0.1", endpoint.port))
        assert endpoint.receive(PATIENCE) == b"hello"
        assert not endpoint.send(bytes(70000))


def test_closing_twice_and_opening_again_on_the_same_port() -> None:
    endpoint = UdpEndpoint(Endpoint(port=0))
    port = endpoint.port
    with pytest.raises(InputError, match="port"):
        UdpEndpoint(Endpoint(port=port))
    endpoint.close()
    endpoint.close()
    UdpEndpoint(Endpoint(port=port)).close()


@pytest.mark.parametrize(
    "values",
    [
        {"address": "localhost"},
        {"host": ""},
        {"port": -1},
        {"port": 65536},
        {"host_port": 0},
        {"rate": 0.0},
        {"rate": float("nan")},
    ],
)
def test_what_is_no_endpoint_is_refused(values: dict[str, object]) -> None:
    with pytest.raises(InputError, match=next(iter(values))):
        Endpoint(**values)  # type: ignore[arg-type]


def test_a_synchronous_session_over_loopback_echoes_every_frame(listener: socket.socket, sender: socket.socket) -> None:
    """Sixty frames: the host answers each Start of Frame, and sees its own last frame number in the next."""
    ig = Host().ig
    echoed = []
    with opened(listener) as endpoint:
        for number in range(60):
            assert endpoint.send(ig.start_frame(number / 60.0))
            sof = decode_message(listener.recv(2000)).packets[0].values
            echoed.append(sof["last_host_frame_number"])
            first = first_packet(host_frame_number=500 + number, last_ig_frame_number=int(sof["ig_frame_number"]))
            message = encode_message(CIGI_33, [first, entity(0.0, float(number), 50.0)])
            sender.sendto(message, ("127.0.0.1", endpoint.port))
            data = endpoint.receive(PATIENCE)
            assert data is not None
            assert ig.receive(data, number / 60.0) == ()
            request = ig.frame_request()
            assert request.fresh
            assert request.views[0].position == pytest.approx((0.0, float(number), 50.0), abs=1e-6)
    assert echoed == [0, *range(500, 559)]
    assert ig.late_frames == 0
