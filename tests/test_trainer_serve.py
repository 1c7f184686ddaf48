"""`sensorsim serve` on loopback: frames for a host, pictures in a ring, an end when told; and the example host."""

import os
import runpy
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from cigi_samples import first_packet
from mcap.reader import make_reader
from small_world import LATITUDE, LONGITUDE, town_features, write_town

from sensorsim.cli import main
from sensorsim.trainer.decode import decode_message
from sensorsim.trainer.dialect import CIGI_33
from sensorsim.trainer.encode import encode_message, make_packet
from sensorsim.trainer.ring import RingReader

ROOT = Path(__file__).resolve().parents[1]
FRAMES = 30
PATIENCE = 60.0  # [s]


class RingHost(threading.Thread):
    """Answers Starts of Frame until none comes, and keeps what the ring showed."""

    def __init__(self, ring: Path) -> None:
        super().__init__()
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.bind(("127.0.0.1", 0))
        self.ring, self.frames = ring, list[int]()
        self.pictures: dict[tuple[int, int], np.ndarray] = {}

    def run(self) -> None:
        self.socket.settimeout(PATIENCE)
        seen, reader = 0, None
        while True:
            try:
                data, sender = self.socket.recvfrom(65535)
            except TimeoutError:
                break
            self.socket.settimeout(2.0)
            reader = reader or RingReader(self.ring)
            number = int(decode_message(data).packets[0].values["ig_frame_number"])
            self.frames.append(number)
            first = first_packet(host_frame_number=number, last_ig_frame_number=number)
            self.socket.sendto(encode_message(CIGI_33, [first, *self.words(number)]), sender)
            picture = reader.latest(after=seen)
            if picture is not None:
                seen = picture.count
                self.pictures[picture.frame, picture.view] = picture.pixels
        self.socket.close()

    def words(self, number: int) -> list:
        place = {"lat_xoff": LATITUDE - 0.002, "lon_yoff": LONGITUDE, "alt_zoff": 330.0, "pitch": -15.0}
        ship = make_packet(CIGI_33, "entity_control", entity_id=0, entity_state=1, **place)
        sensor = {"view_id": 0, "sensor_id": 0, "sensor_on_off": 1, "auto_gain": 1, "polarity": int(number >= 15)}
        return [ship, make_packet(CIGI_33, "sensor_control", **sensor)]


def test_a_served_host_gets_a_frame_for_each_message_and_pictures_in_the_ring(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    scene, ring = write_town(tmp_path, town_features()), tmp_path / "ring"
    host = RingHost(ring)
    host.start()
    words = ["serve", scene, "--at", "1976-02-07T10:00", "--size", "64x48", "--rate", "10", "--port", "0"]
    words += ["--host-port", host.socket.getsockname()[1], "--ring", ring, "--frames", FRAMES, "--preset", "report"]
    words += ["--video", tmp_path / "a.ts", "--bag", tmp_path / "a.mcap", "--dis", "0"]
    monkeypatch.setattr(sys, "argv", ["sensorsim", *map(str, words)])
    with pytest.raises(SystemExit) as left:
        main()
    host.join()
    told = capsys.readouterr().err
    assert not left.value.code
    assert host.frames == list(range(FRAMES))
    assert f"{FRAMES} frames" in told
    assert "127.0.0.1" in told
    assert not ring.exists()
    assert (tmp_path / "a.ts").stat().st_size > 10_000
    with (tmp_path / "a.mcap").open("rb") as bag:
        assert sum(1 for _ in make_reader(bag).iter_messages()) == 2 * FRAMES
    assert len(host.pictures) > FRAMES // 2
    white, black = (host.pictures[max(k for k in host.pictures if k[0] < last)] for last in (15, FRAMES))
    assert white.std() > 5.0
    assert np.abs(white.astype(int) + black.astype(int) - 255).max() <= 3  # the clock went on between the two


def bound_addresses(process: int) -> set[str]:
    """Addresses, as the kernel writes them, that a process's UDP sockets are bound to."""
    links = [str(entry.readlink()) for entry in Path(f"/proc/{process}/fd").iterdir() if entry.is_symlink()]
    own = {link.partition("[")[2].rstrip("]") for link in links if link.startswith("socket:")}
    rows = [line.split() for line in Path("/proc/net/udp").read_text().splitlines()[1:]]
    return {row[1].partition(":")[0] for row in rows if row[9] in own}


def test_a_server_ends_cleanly_on_sigterm_and_listens_on_this_machine_alone(tmp_path: Path) -> None:
    scene, ring = write_town(tmp_path, town_features()), tmp_path / "ring"
    words = ["serve", scene, "--at", "1976-02-07T10:00", "--size", "32x24", "--rate", "20", "--port", "0"]
    words += ["--host-port", "9", "--ring", ring, "--preset", "report"]
    command = [sys.executable, "-m", "sensorsim", *map(str, words)]
    with subprocess.Popen(command, cwd=ROOT, stderr=subprocess.PIPE, text=True, env=dict(os.environ)) as child:
        end = time.monotonic() + PATIENCE
        while not ring.exists() and time.monotonic() < end:
            time.sleep(0.05)
        assert ring.exists()
        assert bound_addresses(child.pid) == {"0100007F"}
        time.sleep(0.5)
        child.send_signal(signal.SIGTERM)
        _, told = child.communicate(timeout=30)
    assert child.returncode == 0
    assert "frames" in told
    assert not ring.exists()


def test_the_example_host_flies_and_reports(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    fly = runpy.run_path(str(ROOT / "tools" / "example_host.py"))["main"]
    scene, options = write_town(tmp_path, town_features()), ["--size", "64x48", "--preset", "report"]
    figures = fly(["--minutes", "0.05", "--hurry", "4", "--rate", "10", "--scene", str(scene), "--", *options])
    assert figures["frames"] == 30
    assert figures["seconds_of_flight"] == pytest.approx(3.0)
    assert 0.7 < figures["seconds"] < 2.8  # 29 intervals at four times real time
    assert figures["frames_lost"] == figures["pictures_not_seen"] == 0
    assert 0.0 < figures["latency_p50_ms"] < 1e3
    assert "latency_p99_ms" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "said"),
    [(["--cigi", "2"], "--cigi"), (["--model", "plane=x.glb"], "--model"), (["--model", "tank=none.obj"], "none.obj"),
     (["--host", "somewhere"], "host"), (["--ring", "x", "--ring-kind", "jpeg"], "kind"), (["--rate", "0"], "rate"),
     (["--video", "x.avi"], "video")],
)  # fmt: skip
def test_servers_that_cannot_be_are_refused_in_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], words: list[str], said: str
) -> None:
    scene = write_town(tmp_path, town_features())
    monkeypatch.chdir(tmp_path)
    fixed = ["serve", scene, "--at", "1976-02-07T10:00", "--size", "32x24", "--port", "0", "--preset", "report"]
    monkeypatch.setattr(sys, "argv", ["sensorsim", *map(str, fixed), *words])
    with pytest.raises(SystemExit) as left:
        main()
    assert left.value.code == 2
    told = [line for line in capsys.readouterr().err.splitlines() if line.startswith("sensorsim:")]
    assert len(told) == 1
    assert said in told[0]
