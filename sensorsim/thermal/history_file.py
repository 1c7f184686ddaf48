"""Writes the history of a wall as CSV text, and several files together or none."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.errors import InputError
from sensorsim.files import placed_whole
from sensorsim.thermal.boundary import FloatArray
from sensorsim.thermal.wall import WallHistory


def history_csv(history: WallHistory, time_text: Sequence[str], *, nodes: bool = False) -> str:
    """Columns time, exterior_surface_temperature, interior_surface_temperature [C], then the nodes that were kept.

    Temperatures have 7 decimals; a node's column is named by its depth below the exterior face.
    """
    header = ["time", "exterior_surface_temperature", "interior_surface_temperature"]
    columns = [history.exterior, history.interior]
    if nodes and history.nodes is not None:
        header += node_names(history.grid.depth)
        columns += list(history.nodes.T)
    values = np.stack(columns, axis=1) - ZERO_CELSIUS
    form = ",".join(["%.7f"] * len(columns))
    rows = (f"{_quoted(text)},{form % tuple(row)}" for text, row in zip(time_text, values.tolist(), strict=True))
    return "\n".join([",".join(header), *rows, ""])


def node_names(depth: FloatArray) -> list[str]:
    """Column names of nodes by depth [m], in millimetres with as many digits as keep them apart: `node_12.7_mm`."""
    for digits in range(4, 18):
        names = [f"node_{1e3 * value:.{digits}g}_mm" for value in depth]
        if len(set(names)) == len(names):
            break
    return names


def write_whole(contents: Mapping[Path, bytes]) -> None:
    """Write all files or none; files of the same names are replaced."""
    path = next(iter(contents))
    try:
        for path in contents:
            path.parent.mkdir(parents=True, exist_ok=True)
        with placed_whole(*contents) as temporary:
            for path, written in zip(contents, temporary, strict=True):
                written.write_bytes(contents[path])
    except OSError as error:
        remedy = "check the folder, its permissions and free space"
        raise InputError(path, "file", path.name, error.strerror or "not written", remedy) from error


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"' if any(mark in text for mark in ',"\n') else text
