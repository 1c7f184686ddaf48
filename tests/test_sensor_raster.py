"""Fields that come in turn and lines wider than a row."""

import dataclasses

import numpy as np
import pytest

from sensorsim.errors import InputError
from sensorsim.sensor import Scan, load_sensor, sensor_parts, sensor_without
from sensorsim.sensor.raster import HELD, is_plain, source_rows, weave


def scan(interlace: int = 1, lines: int = 0) -> Scan:
    return Scan(pattern="raster", interlace=interlace, lines=lines)


@pytest.mark.parametrize("fields", [1, 2, 3, 8])
@pytest.mark.parametrize("rows", [1, 7, 48])
def test_as_many_frames_as_fields_bring_every_row_once(fields: int, rows: int) -> None:
    brought = np.stack([source_rows(scan(fields), rows, frame, follows=True) for frame in range(5, 5 + fields)])
    assert np.all((brought != HELD).sum(axis=0) == 1)
    assert np.array_equal(brought.max(axis=0), np.arange(rows))


def test_odd_frames_bring_odd_lines() -> None:
    for frame in range(4):
        rows = source_rows(scan(2), 9, frame, follows=True)
        assert np.flatnonzero(rows != HELD).tolist() == list(range(frame % 2, 9, 2))


def test_picture_that_follows_no_other_is_whole() -> None:
    assert np.array_equal(source_rows(scan(2), 9, 3, follows=False), np.arange(9))


@pytest.mark.parametrize(("lines", "rows"), [(3, 9), (180, 360), (7, 48), (48, 48), (100, 48)])
def test_line_is_what_its_middle_row_sees(lines: int, rows: int) -> None:
    source = source_rows(scan(lines=lines), rows, 0, follows=False)
    count = min(lines, rows)
    assert np.unique(source).size == count
    assert np.all(np.diff(source) >= 0)
    assert np.abs(source - np.arange(rows)).max() <= 0.5 * rows / count + 0.5
    assert np.array_equal(source[np.unique(source)], np.unique(source))  # lines show themselves


def test_moving_edge_has_a_comb_and_a_still_one_has_none() -> None:
    rows, columns = 12, 30
    shown = np.zeros((rows, columns))
    for frame in range(6):
        edge = 5 * min(frame, 3)  # it moves for three frames and stands for two
        report = np.broadcast_to(np.arange(columns) < edge, (rows, columns)).astype(float)
        weave(shown, report, source_rows(scan(2), rows, frame, follows=frame > 0))
        lit = shown.sum(axis=1)
        if frame in (1, 2, 3):
            assert np.all(lit[frame % 2 :: 2] == edge)
            assert np.all(lit[(frame + 1) % 2 :: 2] == edge - 5)
        if frame == 5:
            assert np.all(lit == 15)


def test_scan_says_which_of_it_there_is() -> None:
    assert is_plain(scan())
    assert not is_plain(scan(2))
    assert not is_plain(scan(lines=100))
    sensor = dataclasses.replace(load_sensor("sit1977"), scan=scan(2, 240))
    assert {"interlace", "raster_lines"} <= sensor_parts(sensor)
    assert is_plain(sensor_without(sensor, {"interlace", "raster_lines"}).scan)
    assert sensor_without(sensor, {"interlace"}).scan.lines == 240


@pytest.mark.parametrize("entry", ["interlace", "lines"])
@pytest.mark.parametrize("value", [-1, 1.5, float("nan"), 10001, True])
def test_impossible_rasters_are_refused(entry: str, value: object) -> None:
    with pytest.raises(InputError, match=entry):
        Scan(pattern="raster", **{entry: value})  # type: ignore[arg-type]


def test_staring_array_has_no_lines() -> None:
    with pytest.raises(InputError, match="lines"):
        Scan(lines=100)
