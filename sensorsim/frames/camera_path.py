"""Camera paths from files: a table of places and angles over time, or poses as tracking programs write them.

CSV: a first row of column names in any order, PATH_COLUMNS; lines that begin with # are notes. `t` is in seconds from
the start of the sequence, `lat`, `lon` in degrees, `alt` in metres above the scene's ground, `yaw` (clockwise from
north), `pitch` (up), `roll` (clockwise) and `hfov` in degrees.

TUM: lines of `t x y z qx qy qz qw` with blanks between, metres east, north and up of the scene's origin, and the
quaternion that turns the camera's axes (right, down, forward) into east, north and up.
"""

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.interpolate import interp1d
from scipy.spatial.transform import Rotation

from sensorsim.errors import InputError
from sensorsim.render import Camera
from sensorsim.scene import LocalFrame

PATH_COLUMNS = ("t", "lat", "lon", "alt", "yaw", "pitch", "roll", "hfov")


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraPath:
    """Cameras at increasing times [s] from the start of a sequence."""

    time: tuple[float, ...]
    camera: tuple[Camera, ...]

    def resample(self, rate: float) -> "CameraPath":
        """Cameras `rate` times a second from first to last, straight between those given, angles the shorter way."""
        if not (math.isfinite(rate) and 0.0 < rate <= 1e4):
            raise InputError(
                "camera path", "rate", rate, "not above 0 and up to 10000 per second", "give frames per second"
            )
        if len(self.time) < 2:
            return self
        count = math.floor((self.time[-1] - self.time[0]) * rate + 1e-9) + 1
        time = self.time[0] + np.arange(count) / rate
        turning = np.unwrap(np.radians([[c.yaw, c.pitch, c.roll] for c in self.camera]), axis=0)
        rows = np.column_stack(
            [
                np.array([c.position for c in self.camera]),
                np.degrees(turning),
                [c.horizontal_field_of_view for c in self.camera],
            ]
        )
        between = interp1d(self.time, rows, axis=0)(np.minimum(time, self.time[-1]))
        return CameraPath(time=tuple(map(float, time)), camera=tuple(_camera(row) for row in between))


def read_camera_path(path: Path | str, frame: LocalFrame, *, horizontal_field_of_view: float = 40.0) -> CameraPath:
    """Path of a .csv file, or of a .txt or .tum file of poses, which get the field of view given [deg].

    Raises InputError that names file, line, value and remedy for whatever is no path.
    """
    source = Path(path)
    try:
        lines = source.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(source, "file", source.name, f"cannot be read ({error})", "name a text file") from error
    numbered = [
        (n, line) for n, line in enumerate(lines, start=1) if line.strip() and not line.lstrip().startswith("#")
    ]
    if source.suffix.lower() == ".csv":
        times, cameras = _from_csv(source, numbered, frame)
    elif source.suffix.lower() in (".txt", ".tum"):
        times, cameras = _from_tum(source, numbered, horizontal_field_of_view)
    else:
        raise InputError(source, "file", source.name, "no camera path by its name", "use .csv, or .tum for poses")
    if not times:
        raise InputError(source, "file", source.name, "holds no camera", "give one line at least")
    for index in range(1, len(times)):
        if times[index] <= times[index - 1]:
            place = f"{source} line {numbered[-len(times) :][index][0]}"
            raise InputError(place, "t", times[index], "not after the line before", "sort the lines by time")
    return CameraPath(time=tuple(times), camera=tuple(cameras))


def _from_csv(source: Path, lines: Sequence[tuple[int, str]], frame: LocalFrame) -> tuple[list[float], list[Camera]]:
    rows = list(csv.reader(line for _, line in lines))
    names = [name.strip() for name in rows[0]] if rows else []
    if sorted(names) != sorted(PATH_COLUMNS):
        remedy = f"give each of {', '.join(PATH_COLUMNS)} once"
        raise InputError(source, "columns", names, "not those of a camera path", remedy)
    times, cameras = [], []
    for (number, _), cells in zip(lines[1:], rows[1:], strict=True):
        place = f"{source} line {number}"
        values = dict(zip(names, _numbers(place, cells, names), strict=True))
        east, north = frame.metres_from_degrees(np.array([[values["lon"], values["lat"]]]))[0]
        pose = (east, north, values["alt"], values["yaw"], values["pitch"], values["roll"], values["hfov"])
        times.append(values["t"])
        cameras.append(_placed(place, pose))
    return times, cameras


def _from_tum(source: Path, lines: Sequence[tuple[int, str]], field: float) -> tuple[list[float], list[Camera]]:
    times, cameras = [], []
    names = ("t", "x", "y", "z", "qx", "qy", "qz", "qw")
    for number, line in lines:
        place = f"{source} line {number}"
        values = _numbers(place, line.split(), names)
        quaternion = np.array(values[4:])
        if not 0.99 < float(np.linalg.norm(quaternion)) < 1.01:
            raise InputError(place, "quaternion", values[4:], "not of length 1", "write qx qy qz qw in this order")
        times.append(values[0])
        cameras.append(_placed(place, (*values[1:4], *_angles(quaternion), field)))
    return times, cameras


def _angles(quaternion: np.ndarray) -> tuple[float, float, float]:
    """Yaw, pitch and roll [deg] of a camera whose axes are right, down and forward."""
    right, _, forward = Rotation.from_quat(quaternion).as_matrix().T
    yaw, pitch = math.atan2(forward[0], forward[1]), math.asin(max(-1.0, min(1.0, forward[2])))
    level = np.array([math.cos(yaw), -math.sin(yaw), 0.0])
    upright = np.cross(level, forward)
    roll = math.atan2(-float(right @ upright), float(right @ level))
    return math.degrees(yaw) % 360.0, math.degrees(pitch), math.degrees(roll)


def _numbers(place: str, cells: Sequence[str], names: Sequence[str]) -> list[float]:
    if len(cells) != len(names):
        raise InputError(place, "line", " ".join(cells), f"not {len(names)} numbers", f"give {' '.join(names)}")
    values = []
    for name, cell in zip(names, cells, strict=True):
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise InputError(place, name, cell, "no finite number", "write for example 12.5")
        values.append(value)
    return values


def _placed(place: str, pose: Sequence[float]) -> Camera:
    try:
        return _camera(pose)
    except InputError as error:
        raise InputError(place, error.entry, error.value, error.problem, error.remedy) from error


def _camera(row: Sequence[float]) -> Camera:
    east, north, up, yaw, pitch, roll, field = (float(value) for value in row)
    return Camera(
        position=np.array([east, north, up]), yaw=yaw % 360.0, pitch=pitch, roll=roll, horizontal_field_of_view=field
    )
