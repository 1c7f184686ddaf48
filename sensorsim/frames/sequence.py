"""Sequences of frames on disk that survive being cut off, and are the same whatever draws them side by side.

A sequence is a list of frames, each a sensor at a moment behind a camera. It is drawn in blocks of BLOCK consecutive
frames of one sensor; a block begins with the frames before it that its detector still remembers, drawn and not written,
so that no frame depends on where the work was cut. A frame that lies complete in the folder, with the same inputs, is
not written again.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from sensorsim.errors import InputError
from sensorsim.frames.capture import request_settings, take_frame
from sensorsim.frames.reader import read_sidecar
from sensorsim.frames.writer import inputs_sha256, write_frame
from sensorsim.render import Camera, Renderer
from sensorsim.sensor import DisplaySettings, Sensor, renewed_share

BLOCK = 32  # frames
FORGOTTEN = 1e-4  # share of a picture that no longer matters


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Shot:
    """One frame of a sequence."""

    number: int
    time_of_day: float  # [s] of the image day
    camera: Camera


@dataclass(frozen=True, slots=True, kw_only=True)
class SequenceOptions:
    """What is written of each frame."""

    folder: Path
    planes: tuple[str, ...] = ()
    plane_format: str = "exr"
    suffix: str = ".png"
    display: DisplaySettings | None = None


def blocks(count: int) -> list[range]:
    """Numbers of frames that are drawn together."""
    return [range(begin, min(begin + BLOCK, count)) for begin in range(0, count, BLOCK)]


def frame_path(options: SequenceOptions, sensor: Sensor, number: int) -> Path:
    """File of a frame: sensor, number in six digits."""
    return options.folder / f"{sensor.name}_{number:06d}{options.suffix}"


def warm_up(sensor: Sensor) -> int:
    """Frames that a detector remembers."""
    share = renewed_share(sensor)
    return 0 if share >= 1.0 else math.ceil(math.log(FORGOTTEN) / math.log(1.0 - share))


def draw_block(renderer: Renderer, shots: Sequence[Shot], numbers: range, options: SequenceOptions) -> int:
    """Draw the frames of a block and write those that are missing; returns how many these were."""
    missing = [number for number in numbers if not _is_complete(renderer, shots[number], options)]
    for shot in _needed(renderer.sensor, shots, missing, numbers):
        frame = take_frame(
            renderer, shot.camera, shot.time_of_day, display=options.display, frame=shot.number,
            fit_error="fit_error" in options.planes,
            planes={"display", *options.planes} if options.suffix == ".png" else None,
        )  # fmt: skip
        if shot.number in missing:
            path = frame_path(options, renderer.sensor, shot.number)
            write_frame(frame, path, planes=options.planes, plane_format=options.plane_format)
    return len(missing)


def _needed(sensor: Sensor, shots: Sequence[Shot], missing: Sequence[int], numbers: range) -> Iterator[Shot]:
    """Missing frames, and of a detector that remembers all of the block up to the last and those before it."""
    if not missing:
        return
    memory = warm_up(sensor)
    first = max(0, numbers.start - memory) if memory else missing[0]
    for number in range(first, missing[-1] + 1) if memory else missing:
        yield shots[number]


def _is_complete(renderer: Renderer, shot: Shot, options: SequenceOptions) -> bool:
    """Whether a frame lies in the folder whole, made of the same scene, weather, sensor, camera and settings."""
    path = frame_path(options, renderer.sensor, shot.number)
    try:
        sidecar = read_sidecar(path)
    except InputError:
        return False
    names = {entry["name"] for entry in sidecar["planes"]}
    files = {path.with_name(entry["file"]) for entry in sidecar["planes"]}
    wanted = {*options.planes, "display"} if options.suffix == ".png" else set(options.planes)
    asked = request_settings(renderer, shot.camera, shot.time_of_day, display=options.display, frame=shot.number)
    same = sidecar["settings"].get("request_sha256") == inputs_sha256(asked)
    return same and wanted <= names and all(f.is_file() for f in files)
