"""The ring of pictures: what is written is read, by Python and by C, and never half of it.

`tools/bootstrap dev` sees to a C compiler; where none is there the C reader's test fails and says so.
"""

import shutil
import struct
import subprocess
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.trainer.ring import HEADER, KINDS, PixelKind, RingReader, RingWriter

SOURCE = Path(__file__).resolve().parents[1] / "tools" / "ring_reader.c"
SIZE = (32, 20)


def picture(number: int, dtype: str, size: tuple[int, int] = SIZE) -> NDArray[np.generic]:
    values = (np.arange(size[0] * size[1]) + number) % 250
    return values.reshape(size[1], size[0]).astype(dtype)


@pytest.mark.parametrize(("kind", "dtype"), KINDS)
def test_each_kind_of_pixel_comes_back_with_its_frame(kind: PixelKind, dtype: str, tmp_path: Path) -> None:
    with RingWriter(tmp_path / "ring", kind, SIZE, slots=3) as writer, RingReader(tmp_path / "ring") as reader:
        assert reader.latest() is None
        for number in range(8):
            writer.write(picture(number, dtype), frame=100 + number, time=0.5 * number, view=2, sensor=7)
            found = reader.latest()
            assert found is not None
            assert (found.count, found.frame, found.time, found.view, found.sensor) == (
                number + 1,
                100 + number,
                0.5 * number,
                2,
                7,
            )
            assert found.pixels.dtype == np.dtype(dtype)
            assert np.array_equal(found.pixels, picture(number, dtype))
        assert reader.latest(after=8) is None


def test_a_picture_that_is_being_written_is_not_taken(tmp_path: Path) -> None:
    with RingWriter(tmp_path / "ring", "display", SIZE, slots=2) as writer, RingReader(tmp_path / "ring") as reader:
        writer.write(picture(0, "u1"), frame=1, time=0.0)
        with (tmp_path / "ring").open("r+b") as file:
            file.seek(HEADER.size)
            file.write(struct.pack("<Q", 3))
        assert reader.latest() is None


FRAMES = 2000


def test_a_reader_beside_a_fast_writer_sees_whole_pictures_in_order(tmp_path: Path) -> None:
    """Every frame is one grey; a torn copy would hold two. The C reader below is another process."""
    seen: list[int] = []
    with RingWriter(tmp_path / "ring", "centikelvin", (160, 120), slots=2) as writer:

        def write() -> None:
            for number in range(FRAMES):
                writer.write(np.full((120, 160), number, dtype=np.uint16), frame=number, time=0.0)

        thread = threading.Thread(target=write)
        with RingReader(tmp_path / "ring") as reader:
            thread.start()
            end = time.monotonic() + 60.0
            while (not seen or seen[-1] < FRAMES - 1) and time.monotonic() < end:
                found = reader.latest(after=seen[-1] + 1 if seen else 0)
                if found is not None:
                    seen.append(found.frame)
                    assert (found.pixels == found.frame).all()
            thread.join()
    assert seen[-1] == FRAMES - 1
    assert seen == sorted(set(seen))


def test_the_file_goes_with_its_writer_and_readers_keep_what_was_there(tmp_path: Path) -> None:
    writer = RingWriter(tmp_path / "ring", "display", SIZE)
    writer.write(picture(5, "u1"), frame=5, time=1.0)
    reader = RingReader(tmp_path / "ring")
    writer.close()
    writer.close()
    assert list(tmp_path.iterdir()) == []
    found = reader.latest()
    assert found is not None
    assert found.frame == 5
    reader.close()


@pytest.mark.parametrize(
    "wrong", [np.zeros((20, 31), np.uint8), np.zeros((20, 32), np.float32), np.zeros(640, np.uint8)]
)
def test_a_picture_of_another_shape_or_type_is_refused(wrong: NDArray[np.generic], tmp_path: Path) -> None:
    with RingWriter(tmp_path / "ring", "display", SIZE) as writer, pytest.raises(InputError, match="picture"):
        writer.write(wrong, frame=0, time=0.0)


@pytest.mark.parametrize(("size", "slots"), [((0, 5), 4), ((5, 0), 4), ((99999, 5), 4), ((5, 5), 1), ((5, 5), 65)])
def test_a_ring_that_holds_nothing_or_too_much_is_refused(size: tuple[int, int], slots: int, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="ring"):
        RingWriter(tmp_path / "ring", "display", size, slots=slots)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "data", [b"", b"short", bytes(64), b"SSRING01" + bytes(100)], ids=["empty", "short", "zeros", "header of zeros"]
)
def test_what_is_no_ring_is_refused(data: bytes, tmp_path: Path) -> None:
    (tmp_path / "ring").write_bytes(data)
    with pytest.raises(InputError):
        RingReader(tmp_path / "ring")
    with pytest.raises(InputError, match="start the writer"):
        RingReader(tmp_path / "missing")


def test_a_ring_cut_short_is_refused(tmp_path: Path) -> None:
    with RingWriter(tmp_path / "ring", "display", SIZE):
        (tmp_path / "cut").write_bytes((tmp_path / "ring").read_bytes()[:-1])
    with pytest.raises(InputError, match="size"):
        RingReader(tmp_path / "cut")


# --- the C reader ------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def c_reader(tmp_path_factory: pytest.TempPathFactory) -> Path:
    compiler = next((found for name in ("cc", "gcc", "clang", "tcc") if (found := shutil.which(name))), None)
    assert compiler, "no C compiler: run tools/bootstrap dev, or apt-get install tcc libc6-dev"
    program = tmp_path_factory.mktemp("reader") / "ring_reader"
    done = subprocess.run(
        [compiler, "-o", str(program), str(SOURCE)], capture_output=True, text=True, timeout=60, check=False
    )
    assert done.returncode == 0, done.stderr
    return program


@pytest.mark.parametrize(("kind", "dtype"), KINDS)
def test_the_c_reader_sees_the_same_pixels(kind: PixelKind, dtype: str, c_reader: Path, tmp_path: Path) -> None:
    with RingWriter(tmp_path / "ring", kind, SIZE) as writer:
        for number in range(6):
            writer.write(picture(number, dtype), frame=40 + number, time=1.25)
        done = subprocess.run([c_reader, tmp_path / "ring"], capture_output=True, text=True, timeout=20, check=True)
    frame, time, _, size, least, greatest, mean = done.stdout.split()
    scale = 0.01 if kind == "centikelvin" else 1.0
    pixels = scale * picture(5, dtype).astype(np.float64)
    assert (frame, time, size) == ("45", "1.250000", "32x20")
    assert [float(least), float(greatest), float(mean)] == pytest.approx(
        [pixels.min(), pixels.max(), pixels.mean()], rel=1e-5
    )


def test_the_c_reader_refuses_what_is_no_ring(c_reader: Path, tmp_path: Path) -> None:
    (tmp_path / "noise").write_bytes(bytes(200))
    (tmp_path / "short").write_bytes(b"SSRING01" + struct.pack("<IIIIII", 64, 4, 640, 32, 20, 1) + bytes(200))
    for name in ("noise", "short", "missing"):
        assert subprocess.run([c_reader, tmp_path / name], capture_output=True, timeout=20, check=False).returncode == 2
    with RingWriter(tmp_path / "ring", "display", SIZE):
        done = subprocess.run([c_reader, tmp_path / "ring"], capture_output=True, timeout=20, check=False)
        assert done.returncode == 1
