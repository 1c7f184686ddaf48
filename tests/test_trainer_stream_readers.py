"""The transport stream read by three programs that share nothing with its writer: ffprobe, klvdata, stanag4609.

`tools/bootstrap dev` installs them; where one is missing these tests fail and say so.
"""

import json
import shutil
import subprocess
import sys
from datetime import UTC
from pathlib import Path

import av
import pytest
from test_trainer_pictures import MORNING, VIEW
from test_trainer_video import write
from trainer_world import PLACE

COUNT = 40
READ_WITH_KLVDATA = """
import json, sys, klvdata
sets = list(klvdata.StreamParser(open(sys.argv[1], "rb").read()))
print(json.dumps([{key[0]: str(item.value) for key, item in one.items.items()} for one in sets]))
"""


@pytest.fixture(scope="module")
def stream(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("stream") / "a.ts"
    write(str(path), COUNT)
    return path


def run(*words: str) -> str:
    done = subprocess.run(words, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_ffprobe_finds_a_video_and_metadata_beside_every_picture(stream: Path) -> None:
    tool = shutil.which("ffprobe")
    assert tool, "ffprobe is not installed: run tools/bootstrap dev, or apt-get install ffmpeg"
    entries = "stream=codec_name,codec_tag_string,nb_read_packets,width,height,r_frame_rate"
    words = [tool, "-v", "error", "-count_packets", "-show_entries", entries, "-of", "json", str(stream)]
    video, data = json.loads(run(*words))["streams"]
    assert (video["codec_name"], video["width"], video["height"]) == ("h264", 64, 48)
    assert (video["r_frame_rate"], video["nb_read_packets"]) == ("30/1", str(COUNT))
    assert (data["codec_name"], data["codec_tag_string"], data["nb_read_packets"]) == ("klv", "KLVA", str(COUNT))


def test_klvdata_reads_where_the_sensor_is_and_looks(stream: Path, tmp_path: Path) -> None:
    with av.open(stream) as file:
        sets = [bytes(packet) for packet in file.demux() if packet.size and packet.stream.type == "data"]
    (tmp_path / "a.klv").write_bytes(b"".join(sets))
    read = json.loads(run(sys.executable, "-c", READ_WITH_KLVDATA, str(tmp_path / "a.klv")))
    assert len(read) == COUNT
    first = read[0]
    east, north, up = PLACE.local(float(first["13"]), float(first["14"]), float(first["15"]))
    assert (east, north) == pytest.approx(VIEW.position[:2], abs=0.02)
    assert up == pytest.approx(VIEW.position[2], abs=0.16)  # half a step of 16 bits
    assert float(first["16"]) == pytest.approx(VIEW.right - VIEW.left, abs=2e-3)
    convergence = PLACE.convergence(float(first["13"]), float(first["14"]))
    assert float(first["5"]) + float(first["18"]) == pytest.approx(VIEW.angles[0] + convergence, abs=1e-5)
    assert float(first["19"]) == pytest.approx(VIEW.angles[1], abs=1e-6)
    assert float(first["20"]) == pytest.approx(0.0, abs=1e-6)
    assert (first["11"], first["12"], first["65"]) == ("flir", "Geodetic WGS84", "9.0")
    assert first["2"] == str(MORNING.astimezone(UTC))


def test_stanag4609_verifies_the_stream_without_an_error(stream: Path) -> None:
    tool = Path(sys.executable).with_name("stanag4609-verify")
    assert tool.exists(), "stanag4609 is not installed: run tools/bootstrap dev"
    report = json.loads(run(str(tool), "--profile", "structural", "--format", "json", str(stream)))
    status = {finding["code"]: finding["status"] for finding in report["findings"]}
    assert "error" not in status.values()
    assert sum(one == "pass" for one in status.values()) >= 18
    for code in ("metadata.decode", "st0604.timestamp.syntax", "st1402.metadata", "transport.continuity"):
        assert status[code] == "pass", code


def test_stanag4609_tells_a_spoilt_stream(stream: Path, tmp_path: Path) -> None:
    """The verification can fail: a packet of the stream taken out is seen."""
    data = stream.read_bytes()
    (tmp_path / "gap.ts").write_bytes(data[: 188 * 30] + data[188 * 31 :])
    tool = Path(sys.executable).with_name("stanag4609-verify")
    words = [str(tool), "--profile", "structural", "--format", "json", str(tmp_path / "gap.ts")]
    done = subprocess.run(words, capture_output=True, text=True, timeout=120, check=False)
    assert any(finding["status"] == "error" for finding in json.loads(done.stdout)["findings"])
