"""One construction under a boundary series of one's own: its parallel paths marched one by one and joined by area.

As in `paths`: faces radiate together, so that the surface temperature is the one whose fourth power is the paths' mean
by area; heat flows add up by area. Cells, nodes and their depths are those of the widest path.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from sensorsim.thermal.paths import WallLike
from sensorsim.thermal.wall import Progress, WallHistory, march_wall
from sensorsim.thermal.wall_boundary import WallBoundary


def march_construction(
    wall: WallLike,
    boundary: WallBoundary,
    *,
    keep_nodes: bool = False,
    progress: Progress | None = None,
    **options: Any,
) -> WallHistory:
    """March a construction, flat or around a centre, with studs or without; options and errors as of `march_wall`."""
    paths = sorted(wall.paths, key=lambda path: -path.fraction)
    shares = [path.fraction for path in paths] or [1.0]
    stacks = [path.layers for path in paths] or [wall.layers]
    histories = []
    for place, layers in enumerate(stacks):
        history = march_wall(
            layers, boundary, shape=wall.shape, radius=wall.radius, keep_nodes=keep_nodes and place == 0,
            progress=None if progress is None else _later(progress, place, len(stacks)), **options,
        )  # fmt: skip
        histories.append(history)
    return histories[0] if len(histories) == 1 else _join(shares, histories)


def _later(progress: Progress, place: int, count: int) -> Progress:
    """Progress of one path as that of all."""
    return lambda done, total: progress(place * total + done, count * total)


def _join(shares: Sequence[float], histories: Sequence[WallHistory]) -> WallHistory:
    share = np.array(shares)

    def radiant(faces: list[np.ndarray]) -> np.ndarray:
        return np.asarray((share @ np.stack(faces) ** 4) ** 0.25)

    starts = [history.start for history in histories]
    changes = [start.change for start in starts if start.change is not None]
    lefts = [start.left for start in starts if start.left is not None]
    return replace(
        histories[0],
        exterior=radiant([history.exterior for history in histories]),
        interior=radiant([history.interior for history in histories]),
        share=share,
        faces=np.concatenate([history.faces for history in histories]),
        start=replace(
            starts[0],
            days=max(start.days for start in starts),
            change=max(changes, default=None),
            left=max(lefts, default=None),
            settled=all(start.settled for start in starts),
            time_constant=max(start.time_constant for start in starts),
        ),
        heat=np.einsum("p,pth->th", share, np.stack([history.heat for history in histories])),
        stored=float(share @ [history.stored for history in histories]),
    )
