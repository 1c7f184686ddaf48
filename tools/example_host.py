"""An example of a trainer's host: flies an approach to the hospital and prints how long pictures take.

    python tools/example_host.py --seconds 60                      # starts `sensorsim serve` itself, ends it again
    python tools/example_host.py --minutes 10 --hurry 2            # ten minutes of flight in five, if frames allow
    python tools/example_host.py --seconds 60 --ring FILE --port 8000 --listen 8001       # drives one that is running

It answers every Start of Frame with one message: IG Control, the ownship's Entity Control and, with the first, View
Definition and Sensor Control. The flight goes on by one frame's time with each of them, however long it took. Latency
is from the message sent to the picture of that frame found in the ring. Everything stays on 127.0.0.1.
"""

import argparse
import json
import math
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from sensorsim.scene import Scene, load_scene
from sensorsim.trainer import scene_place
from sensorsim.trainer.decode import decode_message
from sensorsim.trainer.dialect import CIGI_33
from sensorsim.trainer.encode import encode_message, make_packet
from sensorsim.trainer.fields import Packet
from sensorsim.trainer.local_place import LocalPlace
from sensorsim.trainer.ring import RingReader

LOOPBACK = "127.0.0.1"
FAR = 2000.0  # [m] from the hospital, where the approach begins
CLIMB = 300.0  # [m] above its end
LAP = 60.0  # [s] from the start of the approach to its end, and then again
WARM_UP = 30  # frames that are not counted: the first pictures compile shaders
SILENCE = 120.0  # [s] without a Start of Frame, or without a picture, after which the image generator is given up
PAGE = 4096


@dataclass(slots=True)
class Findings:
    """What the flight showed; times [s], memory [bytes]."""

    frames: list[int] = field(default_factory=list)
    begun: list[float] = field(default_factory=list)
    latency: list[float] = field(default_factory=list)
    missed: int = 0
    memory: list[tuple[float, int]] = field(default_factory=list)

    def summary(self, rate: float) -> dict[str, float | int | None]:
        """Figures in ms, frames and MiB, of a flight at so many frames per second of it [Hz].

        Late: a frame whose picture took longer than its time. Memory: grown from the second quarter to the last.
        """
        intervals = np.diff(self.begun)
        numbers = np.diff(self.frames)
        grown = None
        if len(self.memory) >= 8:
            quarter = len(self.memory) // 4
            first, last = self.memory[quarter : 2 * quarter], self.memory[-quarter:]
            grown = (np.mean([size for _, size in last]) - np.mean([size for _, size in first])) / 2**20
        return {
            "seconds": self.begun[-1] - self.begun[0],
            "seconds_of_flight": len(self.frames) / rate,
            "frames": len(self.frames),
            "frames_lost": int(np.sum(numbers - 1)),
            "pictures_not_seen": self.missed,
            "rate_Hz": float(len(intervals) / np.sum(intervals)),
            "interval_p99_ms": 1e3 * float(np.quantile(intervals, 0.99)),
            "frames_late": int(np.sum(np.array(self.latency) > 1.0 / rate)) + self.missed,
            "latency_p50_ms": 1e3 * float(np.quantile(self.latency, 0.5)) if self.latency else None,
            "latency_p99_ms": 1e3 * float(np.quantile(self.latency, 0.99)) if self.latency else None,
            "memory_growth_MiB": grown,
        }


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Approach:
    """Where it ends and what it is flown at (3,) [m]: the scene's camera of the hospital."""

    place: LocalPlace
    end: np.ndarray
    target: np.ndarray

    def position(self, seconds: float) -> np.ndarray:
        """Straight in from afar, again and again."""
        left = 1.0 - seconds % LAP / LAP
        out = (self.end - self.target) / np.linalg.norm(self.end - self.target)
        return self.end + left * (FAR * out + np.array([0.0, 0.0, CLIMB]))


def approach(scene: Scene) -> Approach:
    """The approach to the scene's camera of the hospital, else to its first."""
    names = [camera.name for camera in scene.cameras]
    station = scene.camera("hospital" if "hospital" in names else names[0])
    end, target = np.asarray(station.position(scene.frame)), np.asarray(station.target(scene.frame))
    return Approach(place=scene_place(scene), end=end, target=target)


def ownship(way: Approach, seconds: float) -> Packet:
    """Entity 0 on its approach, nose at the hospital."""
    position = way.position(seconds)
    ahead = way.target - position
    latitude, longitude, altitude = way.place.geodetic(position)
    return make_packet(
        CIGI_33, "entity_control", entity_id=0, entity_state=1, lat_xoff=latitude, lon_yoff=longitude,
        alt_zoff=altitude, yaw=math.degrees(math.atan2(ahead[0], ahead[1])) % 360.0,
        pitch=math.degrees(math.atan2(ahead[2], math.hypot(ahead[0], ahead[1]))),
        roll=3.0 * math.sin(0.7 * seconds),
    )  # fmt: skip


def first_words() -> list[Packet]:
    """The view's field, and a sensor in white-hot with automatic gain."""
    view = {"left": -15.0, "right": 15.0, "bottom": -11.25, "top": 11.25}
    enabled = {f"{side}_enable": 1 for side in view}
    return [
        make_packet(CIGI_33, "view_def", view_id=0, **view, **enabled),
        make_packet(CIGI_33, "sensor_control", view_id=0, sensor_id=0, sensor_on_off=1, auto_gain=1),
    ]


def fly(
    link: socket.socket,
    target: int,
    ring: RingReader,
    way: Approach,
    *,
    frames: int,
    rate: float,
    process: int | None,
) -> Findings:
    """Answers so many Starts of Frame, `rate` of them to a second of flight, and looks for each picture."""
    findings, begun, seen = Findings(), 0.0, 0
    for count in range(frames + WARM_UP):
        number = _start_of_frame(link)
        now = time.monotonic()
        begun = begun or now
        packets = [ownship(way, count / rate), *(first_words() if count == 0 else [])]
        control = make_packet(
            CIGI_33, "ig_control", ig_mode=1, timestamp_valid=1, host_frame_number=count, last_ig_frame_number=number,
            timestamp=round(now * 1e5) % 2**32, extrapolation_enable=1,
        )  # fmt: skip
        sent = time.monotonic()
        link.sendto(encode_message(CIGI_33, [control, *packets]), (LOOPBACK, target))
        seen, ready = _picture(ring, seen, number)
        if count < WARM_UP:
            continue
        findings.frames.append(number)
        findings.begun.append(now)
        if ready is None:
            findings.missed += 1
        else:
            findings.latency.append(ready - sent)
        if process is not None and count % 30 == 0:
            findings.memory.append((now - begun, resident(process)))
    return findings


def resident(process: int) -> int:
    """Memory of a process that is in use [bytes]."""
    return int(Path(f"/proc/{process}/statm").read_text().split()[1]) * PAGE


def _start_of_frame(link: socket.socket) -> int:
    """The newest Start of Frame; those that came meanwhile are lost frames."""
    data = link.recv(65535)
    link.setblocking(False)
    try:
        while True:
            data = link.recv(65535)
    except BlockingIOError:
        link.settimeout(SILENCE)
    return int(decode_message(data).packets[0].values["ig_frame_number"])


def _picture(ring: RingReader, seen: int, number: int, patience: float = 2.0) -> tuple[int, float | None]:
    """Count of the ring and time when the picture of a frame, or a later one, was there; None where it never came."""
    end = time.monotonic() + patience
    while time.monotonic() < end:
        frame = ring.latest(after=seen)
        if frame is not None:
            seen = frame.count
            if frame.frame >= number:
                return seen, time.monotonic()
        time.sleep(2e-4)
    return seen, None


@contextmanager
def server(
    scene: str, arguments: Sequence[str], link: socket.socket, ring: Path, rate: float
) -> Iterator[tuple[int, int]]:
    """A `sensorsim serve` of our own: its port and process."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        probe.bind((LOOPBACK, 0))
        port = probe.getsockname()[1]
    own = ["--port", str(port), "--host-port", str(link.getsockname()[1]), "--ring", str(ring), "--rate", str(rate)]
    child = subprocess.Popen([sys.executable, "-m", "sensorsim", "serve", scene, *own, *arguments])
    try:
        yield port, child.pid
    finally:
        child.terminate()
        child.wait(timeout=30)


def wait_for_ring(path: Path, patience: float) -> RingReader:
    """The ring, once the image generator has made it."""
    end = time.monotonic() + patience
    while not path.exists():
        if time.monotonic() > end:
            raise SystemExit(f"no ring at {path} after {patience:g} s")
        time.sleep(0.05)
    return RingReader(path)


def main(words: Sequence[str] | None = None) -> dict[str, float | int | None]:
    """Flies and prints; gives the figures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=60.0, help="of flight")
    parser.add_argument("--minutes", type=float, help="of flight, in place of seconds")
    parser.add_argument("--rate", type=float, default=60.0, help="frames to a second of flight [Hz]")
    parser.add_argument("--hurry", type=float, default=1.0, help="times real time that our own server is asked for")
    parser.add_argument("--scene", default="hospital")
    parser.add_argument("--port", type=int, default=0, help="of a running image generator; 0 starts one")
    parser.add_argument("--listen", type=int, default=0, help="port to hear a running image generator on")
    parser.add_argument("--ring", type=Path, help="ring of a running image generator")
    parser.add_argument("serve", nargs="*", help="options of `sensorsim serve`, after --")
    asked = parser.parse_args(words)
    seconds = asked.seconds if asked.minutes is None else 60.0 * asked.minutes
    frames, way = round(seconds * asked.rate), approach(load_scene(asked.scene, level="IIIB"))
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as link, tempfile.TemporaryDirectory() as folder:
        link.bind((LOOPBACK, asked.listen))
        link.settimeout(SILENCE)
        if asked.port:
            with wait_for_ring(asked.ring, SILENCE) as ring:
                found = fly(link, asked.port, ring, way, frames=frames, rate=asked.rate, process=None)
        else:
            path = Path(folder) / "pictures"
            with (
                server(asked.scene, asked.serve, link, path, asked.hurry * asked.rate) as (port, process),
                wait_for_ring(path, SILENCE) as ring,
            ):
                found = fly(link, port, ring, way, frames=frames, rate=asked.rate, process=process)
    figures = found.summary(asked.rate)
    print(json.dumps(figures, indent=1))
    return figures


if __name__ == "__main__":
    main()
