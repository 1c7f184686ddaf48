"""Flights: recorded as a camera path, written as the CSV that `sensorsim capture` reads, and flown again."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from sensorsim.errors import InputError
from sensorsim.files import placed_whole
from sensorsim.frames.camera_path import PATH_COLUMNS, CameraPath
from sensorsim.render import Camera
from sensorsim.scene import LocalFrame


@dataclass(frozen=True, slots=True, kw_only=True)
class Recording:
    """Cameras so far, each with its time [s] since the start."""

    time: tuple[float, ...] = ()
    camera: tuple[Camera, ...] = ()

    def add(self, time: float, camera: Camera) -> "Recording":
        """With one camera more; one that is not later than the last is left out."""
        if self.time and time <= self.time[-1]:
            return self
        return Recording(time=(*self.time, time), camera=(*self.camera, camera))

    def path(self) -> CameraPath:
        """The flight, its times from 0."""
        if not self.time:
            raise InputError("recording", "cameras", 0, "nothing was recorded", "press R, fly, press R again")
        return CameraPath(time=tuple(time - self.time[0] for time in self.time), camera=self.camera)


def write_camera_path(path: Path, flight: CameraPath, frame: LocalFrame) -> None:
    """Write a flight as CSV, whole or not at all; 1e-9 deg and 1 mm are kept. InputError where the disk refuses."""
    rows = [",".join(PATH_COLUMNS)]
    for time, camera in zip(flight.time, flight.camera, strict=True):
        longitude, latitude = frame.degrees_from_metres(np.atleast_2d(camera.position[:2]))[0]
        angles = (camera.yaw, camera.pitch, camera.roll, camera.horizontal_field_of_view)
        place = f"{time:.4f},{latitude:.9f},{longitude:.9f},{float(camera.position[2]):.3f}"
        rows.append(",".join([place, *(f"{angle:.5f}" for angle in angles)]))
    try:
        with placed_whole(path) as (partial,):
            partial.write_text("\n".join(rows) + "\n", encoding="utf-8")
    except OSError as error:
        remedy = "check the folder's permissions and free space"
        raise InputError(path, "file", path.name, f"cannot be written ({error.strerror})", remedy) from error


def camera_at(flight: CameraPath, seconds: float) -> Camera:
    """The camera of a flight at a time [s] from its start: straight in between, angles the shorter way.

    Before the start and after the end it is the first and the last one.
    """
    time = np.asarray(flight.time) - flight.time[0]
    if len(time) < 2 or seconds <= 0.0:
        return flight.camera[0]
    if seconds >= time[-1]:
        return flight.camera[-1]
    index = int(np.searchsorted(time, seconds, side="right")) - 1
    share = float((seconds - time[index]) / (time[index + 1] - time[index]))
    return _between(flight.camera[index : index + 2], share)


def _between(pair: Sequence[Camera], share: float) -> Camera:
    first, second = pair

    def mix(a: float, b: float, circle: float | None = None) -> float:
        step = b - a if circle is None else (b - a + 0.5 * circle) % circle - 0.5 * circle
        return a + share * step

    field = mix(first.horizontal_field_of_view, second.horizontal_field_of_view)
    return replace(
        first,
        position=first.position + share * (second.position - first.position),
        yaw=mix(first.yaw, second.yaw, 360.0) % 360.0,
        pitch=mix(first.pitch, second.pitch),
        roll=mix(first.roll, second.roll, 360.0),
        horizontal_field_of_view=field,
    )
