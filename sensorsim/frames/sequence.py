"""Sequences of frames on disk that survive being cut off, and are the same whatever draws them side by side.

A sequence is a list of frames, each a sensor at a moment behind a camera. It is drawn in blocks of consecutive
frames of one sensor; a block begins with the frames before it that still show in it, drawn and not written, so that
no frame depends on where the work was cut. A frame that lies complete in the folder, with the same inputs, is
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
from sensorsim.sensor import MEMORY, DisplaySettings, Sensor, follows_in_time, renewed_share

BLOCK = 32  # frames, at least
PER_LEAD = 4  # times as many frames in a block as are drawn ahead of it
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


def sequence_blocks(sensor: Sensor, shots: Sequence[Shot]) -> list[range]:
    """Numbers of frames that are drawn together, so many that what is drawn ahead of them is a small part."""
    ahead = max((warm_up(sensor, shots, number) for number in range(0, len(shots), BLOCK)), default=0)
    size = max(BLOCK, PER_LEAD * ahead)
    return [range(begin, min(begin + size, len(shots))) for begin in range(0, len(shots), size)]


def frame_path(options: SequenceOptions, sensor: Sensor, number: int) -> Path:
    """File of a frame: sensor, number in six digits."""
    return options.folder / f"{sensor.name}_{number:06d}{options.suffix}"


def warm_up(sensor: Sensor, shots: Sequence[Shot], number: int, display: DisplaySettings | None = None) -> int:
    """Frames before one of that number that show in it: by what the detector remembers, by fields, by a slow gain."""
    share, settle = renewed_share(sensor), (sensor.display if display is None else display).settle
    memory = 0 if share >= 1.0 else math.ceil(math.log(FORGOTTEN) / math.log(1.0 - share))
    memory += sensor.scan.interlace - 1 if sensor.detector is not None else 0
    first = number
    if settle > 0.0:
        while first > 0 and _age(sensor, shots[first - 1], shots[number]) <= MEMORY * settle:
            first -= 1
    for earlier in range(first - 1, max(first - memory, 0) - 1, -1):
        if not follows_in_time(sensor, shots[earlier].time_of_day, shots[earlier + 1].time_of_day):
            break
        first = earlier
    return number - first


def _age(sensor: Sensor, shot: Shot, later: Shot) -> float:
    """Time [s] between two shots, of which each takes a frame's at least."""
    periods = (later.number - shot.number) / sensor.scan.frame_rate
    return max(abs(later.time_of_day - shot.time_of_day), periods)


def draw_block(renderer: Renderer, shots: Sequence[Shot], numbers: range, options: SequenceOptions) -> int:
    """Draw the frames of a block and write those that are missing; returns how many these were."""
    missing = [number for number in numbers if not _is_complete(renderer, shots[number], options)]
    for shot in _needed(renderer.sensor, shots, missing, numbers, options.display):
        frame = take_frame(
            renderer, shot.camera, shot.time_of_day, display=options.display, frame=shot.number,
            fit_error="fit_error" in options.planes,
            planes={"display", *options.planes} if options.suffix == ".png" else None,
        )  # fmt: skip
        if shot.number in missing:
            path = frame_path(options, renderer.sensor, shot.number)
            write_frame(frame, path, planes=options.planes, plane_format=options.plane_format)
    return len(missing)


def _needed(
    sensor: Sensor, shots: Sequence[Shot], missing: Sequence[int], numbers: range, display: DisplaySettings | None
) -> Iterator[Shot]:
    """Missing frames; where frames show in later ones, all of the block up to the last and those before it."""
    if not missing:
        return
    alone = not any(warm_up(sensor, shots, number, display) for number in numbers)
    first = numbers.start - warm_up(sensor, shots, numbers.start, display)
    for number in missing if alone else range(first, missing[-1] + 1):
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
