"""What the viewer writes: pictures, planes, flights and its window, each under the next free number of a folder."""

import io
from pathlib import Path

import imageio.v3 as imageio

from sensorsim.errors import InputError
from sensorsim.frames import Frame, write_frame
from sensorsim.viewer.palettes import Colours

HIGHEST = 9999


def free_path(folder: Path, stem: str, suffix: str) -> Path:
    """The first of stem_001, stem_002, ... that no file of any suffix has; makes the folder."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        taken = {path.stem for path in folder.glob(f"{stem}_*")}
    except OSError as error:
        remedy = "name another folder with --out"
        raise InputError(folder, "folder", str(folder), f"cannot be used ({error.strerror})", remedy) from error
    for number in range(1, HIGHEST + 1):
        name = f"{stem}_{number:03d}"
        if name not in taken:
            return folder / f"{name}{suffix}"
    raise InputError(folder, "files", stem, f"{HIGHEST} of them are there", "name another folder with --out")


def save_picture(frame: Frame, folder: Path, stem: str) -> Path:
    """The display image as PNG, with its sidecar."""
    return write_frame(frame, free_path(folder, stem, ".png"))[0]


def save_planes(frame: Frame, folder: Path, stem: str) -> Path:
    """All planes but the display image as EXR, with their sidecar."""
    names = [name for name in frame.planes if name != "display"]
    return write_frame(frame, free_path(folder, stem, ".exr"), planes=names)[0]


def save_window(colours: Colours, folder: Path) -> Path:
    """The window as it is on the screen, as PNG."""
    path = free_path(folder, "window", ".png")
    buffer = io.BytesIO()
    imageio.imwrite(buffer, colours, extension=".png")
    try:
        path.write_bytes(buffer.getvalue())
    except OSError as error:
        path.unlink(missing_ok=True)
        raise InputError(path, "file", path.name, f"cannot be written ({error.strerror})", "free some space") from error
    return path
