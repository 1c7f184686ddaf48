"""A UDP endpoint for one host: bound to this machine unless told otherwise, deaf to others, and limited in rate."""

import socket
from dataclasses import dataclass
from ipaddress import ip_address
from time import monotonic
from types import TracebackType

from sensorsim.errors import InputError

LARGEST_DATAGRAM = 65535  # [bytes]
HOST_TO_IMAGE_PORT, IMAGE_TO_HOST_PORT = 8000, 8001  # as the examples of the CIGI Class Library have them [CIGICCL402]


@dataclass(frozen=True, slots=True, kw_only=True)
class Endpoint:
    """Where to listen and whom to serve.

    host: the only address that is heard, and where answers go (host_port); reply_to_sender: to the port that the last
    datagram came from instead, since some hosts listen where they send. rate: datagrams served per second, with as many
    at once as come in a tenth of a second.
    """

    address: str = "127.0.0.1"
    port: int = HOST_TO_IMAGE_PORT
    host: str = "127.0.0.1"
    host_port: int = IMAGE_TO_HOST_PORT
    reply_to_sender: bool = False
    rate: float = 1000.0

    def __post_init__(self) -> None:
        """Refuse what is no address, port or rate; port 0 lets the system choose."""
        for name in ("address", "host"):
            try:
                ip_address(getattr(self, name))
            except ValueError as error:
                raise InputError("endpoint", name, getattr(self, name), "no IP address", "write numbers") from error
        for name, least in (("port", 0), ("host_port", 1)):
            if not least <= getattr(self, name) <= 65535:
                raise InputError("endpoint", name, getattr(self, name), f"not {least} to 65535", "give a free port")
        if not 1.0 <= self.rate <= 1e6:
            raise InputError("endpoint", "rate", self.rate, "not 1 to 1e6 per second", "give datagrams per second")


class UdpEndpoint:
    """An open socket. Counts: served, and dropped because they came from others or too fast. Use it in a `with`."""

    def __init__(self, endpoint: Endpoint) -> None:
        """Binds; InputError where the address or port cannot be had."""
        self.endpoint = endpoint
        self.served = self.from_others = self.too_fast = 0
        self._reply_port = endpoint.host_port
        self._burst = max(1.0, 0.1 * endpoint.rate)
        self._tokens, self._filled = self._burst, monotonic()
        family = socket.AF_INET6 if ip_address(endpoint.address).version == 6 else socket.AF_INET
        self._socket = socket.socket(family, socket.SOCK_DGRAM)
        try:
            self._socket.bind((endpoint.address, endpoint.port))
        except OSError as error:
            self._socket.close()
            where = f"{endpoint.address}:{endpoint.port}"
            raise InputError("endpoint", "port", where, str(error), "use a free port of this machine") from error

    @property
    def port(self) -> int:
        """The port that is listened on."""
        return int(self._socket.getsockname()[1])

    def receive(self, timeout: float) -> bytes | None:
        """The host's next datagram; None when none came in `timeout` seconds, however many others sent."""
        end = monotonic() + timeout
        while True:
            left = end - monotonic()
            self._socket.settimeout(max(left, 1e-6))
            try:
                data, sender = self._socket.recvfrom(LARGEST_DATAGRAM)
            except (TimeoutError, BlockingIOError):
                return None
            except ConnectionError:  # the host's port was closed when we last sent: it may open again
                data, sender = b"", ("", 0)
            if data and self._is_served(sender[0]):
                self._reply_port = sender[1] if self.endpoint.reply_to_sender else self._reply_port
                return data
            if left <= 0.0:
                return None

    def send(self, data: bytes) -> bool:
        """Sends to the host; False where the system would not take it, which is as good as lost on the way."""
        try:
            return self._socket.sendto(data, (self.endpoint.host, self._reply_port)) == len(data)
        except OSError:
            return False

    def close(self) -> None:
        """Gives the port back; a second call does nothing."""
        self._socket.close()

    def __enter__(self) -> "UdpEndpoint":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _is_served(self, sender: str) -> bool:
        """Whether a datagram is the host's and within the rate."""
        if ip_address(sender) != ip_address(self.endpoint.host):
            self.from_others += 1
            return False
        now = monotonic()
        self._tokens = min(self._burst, self._tokens + (now - self._filled) * self.endpoint.rate)
        self._filled = now
        if self._tokens < 1.0:
            self.too_fast += 1
            return False
        self._tokens -= 1.0
        self.served += 1
        return True
