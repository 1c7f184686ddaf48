"""The viewer from end to end: a window on a screen that is only memory (Xvfb), keys and mouse from xdotool.

Both programs come with `tools/bootstrap dev`.
"""

import json
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import imageio.v3 as imageio
import numpy as np
import pytest
import small_world

from sensorsim.cli.app import app
from sensorsim.errors import SensorsimError

ROOT = Path(__file__).resolve().parents[1]
TIMEOUT = 120.0  # [s] of anything, on a busy machine
OPTIONS = ("--preset", "report", "--at", "1976-02-07T15:00Z", "--size", "960x540", "--scale", "3")


@pytest.fixture(scope="module")
def screen() -> Iterator[dict[str, str]]:
    """The environment of programs that are to open their windows on an Xvfb of this module's own."""
    read, write = os.pipe()
    command = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1024x600x24", "-nolisten", "tcp"]
    server = subprocess.Popen(command, pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as pipe:
        number = pipe.readline().strip()
    assert number, "Xvfb did not start"
    kept = {name: value for name, value in os.environ.items() if name != "WAYLAND_DISPLAY"}
    yield {**kept, "DISPLAY": f":{number}", "PYTHONPATH": str(ROOT)}
    server.terminate()
    server.wait(TIMEOUT)


@pytest.fixture(scope="module")
def town(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_world.write_town(tmp_path_factory.mktemp("scene"), small_world.town_features())


def view(town: Path, *options: str) -> list[str]:
    return [sys.executable, "-m", "sensorsim", "view", str(town), *options]


def run(command: list[str], environment: Mapping[str, str], folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        command, env=environment, cwd=folder, capture_output=True, text=True, timeout=TIMEOUT, check=False
    )


@dataclass
class Hand:
    """A person at the window, and the folder that the window saves to."""

    environment: Mapping[str, str]
    folder: Path
    seen: set[Path] = field(default_factory=set)

    def do(self, *arguments: str) -> str:
        done = run(["xdotool", *arguments], self.environment, self.folder)
        assert done.returncode == 0, f"xdotool {arguments}: {done.stderr}"
        return done.stdout

    def save(self, key: str, suffix: str) -> Path:
        """The file that a key has made the viewer write."""
        self.do("key", key)
        end = time.monotonic() + TIMEOUT
        while time.monotonic() < end:
            new = {path for path in self.folder.glob(f"*{suffix}") if not path.name.startswith(".")} - self.seen
            if new:
                self.seen |= new
                return new.pop()
            time.sleep(0.05)
        raise AssertionError(f"{key} wrote no {suffix}; there is {sorted(self.folder.iterdir())}")

    def picture(self) -> tuple[np.ndarray, dict[str, Any]]:
        """The picture that F12 saves, with its settings."""
        sidecar = self.save("F12", ".json")
        image = imageio.imread(sidecar.with_suffix(".png"))
        return image, json.loads(sidecar.read_text())["settings"]


def test_start_fly_scrub_switch_sensor_save_and_quit(screen: dict[str, str], town: Path, tmp_path: Path) -> None:
    command = view(town, *OPTIONS, "--out", str(tmp_path))
    log = (tmp_path / "log.txt").open("w+")
    viewer = subprocess.Popen(command, env=screen, cwd=tmp_path, stdout=log, stderr=log)
    hand = Hand(environment=screen, folder=tmp_path)
    try:
        window = hand.do("search", "--sync", "--onlyvisible", "--name", "sensorsim: town").split()[0]
        hand.do("windowfocus", window)
        hand.do("mousemove", "--window", window, "600", "300")
        first, start = hand.picture()
        assert start["sensor"]["name"] == "flir"
        assert start["time_of_day_s"] == 36000.0

        hand.do("keydown", "w", "sleep", "0.5", "keyup", "w")
        _, flown = hand.picture()
        assert flown["camera"]["latitude"] > start["camera"]["latitude"]  # the camera looks north, from the south
        assert flown["camera"]["height_m"] < start["camera"]["height_m"]  # and down

        hand.do("mousedown", "1", "sleep", "0.3", "mousemove_relative", "--sync", "--", "-60", "0", "sleep", "0.3")
        hand.do("mouseup", "1")
        _, turned = hand.picture()
        assert 1.0 < turned["camera"]["yaw_deg"] < 20.0

        hand.do("keydown", "period", "sleep", "0.5", "keyup", "period")
        _, later = hand.picture()
        assert later["time_of_day_s"] > start["time_of_day_s"] + 60.0

        strip = 308 + (960 - 308 - 8) * 3 // 4  # of day and night, right of the panel: 18 h
        hand.do("mousemove", "--window", window, str(strip), "525", "sleep", "0.3", "mousedown", "1", "sleep", "0.3")
        hand.do("mouseup", "1")
        _, evening = hand.picture()
        assert evening["time_of_day_s"] == pytest.approx(18.0 * 3600.0, abs=300.0)
        assert evening["camera"] == later["camera"]  # a panel takes the mouse

        hand.do("key", "2")
        second, switched = hand.picture()
        assert switched["sensor"]["name"] == "lltv"
        assert second.shape == first.shape
        assert np.ptp(second) > 50

        planes = hand.save("F11", ".exr")
        assert planes.name.startswith("town_lltv_")
        shown = imageio.imread(hand.save("F10", "window_001.png"))
        assert shown.shape == (540, 960, 3)
        hand.do("key", "u")
        listed = imageio.imread(hand.save("F10", "window_002.png"))
        changed = np.any(listed != shown, axis=2)[70:500, 320:800]
        assert changed.mean() > 0.5  # the list of effects lies over the picture
        hand.do("key", "Escape")
        assert viewer.wait(TIMEOUT) == 0, (tmp_path / "log.txt").read_text()
    finally:
        viewer.kill()
        viewer.wait(TIMEOUT)
        log.close()
    assert (tmp_path / "log.txt").read_text() == ""


def test_a_script_flies_records_bakes_and_replays_the_same_twice(
    screen: dict[str, str], town: Path, tmp_path: Path
) -> None:
    script = tmp_path / "script.txt"
    script.write_text(
        "0.1 press R\n0.1 hold W\n0.5 release W\n0.5 press R\n0.6 press V\n0.6 mouse 500 250\n0.7 press F12\n"
        "0.8 press J\n0.9 wait bake\n1.0 press V\n1.0 press H\n1.1 press F10\n1.2 press H\n1.2 press BACKSPACE\n"
        "1.4 press F12\n1.5 time 13:30\n1.5 sensor uncooled\n1.6 press F11\n"
    )
    shared = (*OPTIONS, "--at", "1976-10-07T10:00", "--script", str(script))
    flights = [
        subprocess.Popen(
            view(town, *shared, "--frames", frames, "--out", name), env=screen, cwd=tmp_path, stderr=subprocess.PIPE
        )
        for name, frames in (("one", "55"), ("two", "23"))
    ]
    for flight in flights:
        _, errors = flight.communicate(timeout=TIMEOUT)
        assert (flight.returncode, errors) == (0, b"")
    one, two = ({path.name: path for path in (tmp_path / name).iterdir()} for name in ("one", "two"))
    assert set(two) == {f"town_{name}_001.{kind}" for name in ("flir", "lltv") for kind in ("png", "json")} | {
        "flight_001.csv"
    }
    for name, path in two.items():
        assert one[name].read_bytes() == path.read_bytes(), name
    days = [json.loads(one[f"town_flir_00{number}.json"].read_text())["settings"]["day"] for number in (1, 2)]
    assert days == ["1976-10-07", "1976-02-07"]  # after fall comes winter, baked while it flew
    places = [json.loads(one[f"town_flir_00{n}.json"].read_text())["settings"]["camera"]["latitude"] for n in (1, 2)]
    assert places[1] < places[0]  # half way through the flight again
    planes = json.loads(one["town_uncooled_001.json"].read_text())
    assert planes["settings"]["time_of_day_s"] == 13.5 * 3600.0
    assert {plane["name"] for plane in planes["planes"]} >= {"radiance", "signal", "apparent_temperature", "range"}
    help_page = imageio.imread(one["window_001.png"])
    assert help_page.shape == (540, 960, 3)
    assert len(np.unique(help_page.reshape(-1, 3), axis=0)) > 200


def refused(town: Path, *options: str) -> str:
    """The message of the error that the command ends with."""
    with pytest.raises(SensorsimError) as caught:
        app(["view", str(town), "--preset", "report", *options], standalone_mode=False)
    return str(caught.value)


def test_without_a_display_the_error_names_the_remedy_before_anything_is_baked(
    town: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    message = refused(town, "--weather", "nothing")
    assert "no window" in message
    assert "xvfb-run" in message


@pytest.mark.parametrize("missing", ["glfw", "imgui_bundle"])
def test_without_the_extra_the_error_names_the_line_that_installs_it(
    town: Path, missing: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in [name for name in sys.modules if name.startswith("sensorsim.viewer.")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, missing, None)
    message = refused(town)
    assert missing in message
    assert "pip install 'sensorsim[viewer]'" in message


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (("--scale", "2.5"), "--scale"), (("--frames", "0"), "--frames"), (("--size", "wide"), "--size"),
        (("--sensor", "nothing"), "sensor"), (("--weather", "nothing"), "weather"), (("--script", "no.txt"), "no.txt"),
        (("--at", "noon"), "--at"), (("--level", "IVC"), "level"), (("--camera", "nowhere"), "camera"),
    ],
)  # fmt: skip
def test_what_cannot_be_honoured_is_refused_before_any_window(
    town: Path, tmp_path: Path, options: tuple[str, ...], text: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sensorsim.viewer.window.check_display", lambda: None)
    assert text in refused(town, *options)
