"""One wall against time, in the manner of figures 13 and 14 of [Report1978]: its nodes above, what loads it below.

Needs matplotlib, which comes with the extra `study`.
"""

import importlib
import importlib.util
import io
from datetime import datetime, timedelta
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from sensorsim.constants import SECONDS_PER_HOUR, ZERO_CELSIUS
from sensorsim.errors import InputError
from sensorsim.thermal import WallBoundary, WallHistory, exterior_loads

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FORMATS = (".png", ".svg", ".pdf")
LOADS = {  # label and colour by field of WallLoads, that all colour vision tells apart
    "beam": ("beam, absorbed", "#E69F00"),
    "sky_diffuse": ("sky diffuse, absorbed", "#56B4E9"),
    "ground_reflected": ("ground-reflected, absorbed", "#009E73"),
    "sky_radiation": ("thermal sky, net", "#0072B2"),
    "ground_radiation": ("thermal ground, net", "#CC79A7"),
    "convection": ("convection", "#D55E00"),
}

_ABOVE: dict[str, Any] = {
    "loc": "lower left", "bbox_to_anchor": (0.0, 1.0), "ncols": 4, "fontsize": "small",
    "frameon": False, "handlelength": 1.2, "columnspacing": 1.2,
}  # fmt: skip


def require_plot(path: Path) -> None:
    """Raise InputError unless a figure can be drawn and written under this name."""
    if path.suffix.lower() not in FORMATS:
        raise InputError("command line", "--plot", str(path), "unknown kind of file", f"use {', '.join(FORMATS)}")
    if importlib.util.find_spec("matplotlib") is None:
        raise InputError("command line", "--plot", str(path), "needs matplotlib", "pip install 'sensorsim[study]'")


def plot_wall(history: WallHistory, boundary: WallBoundary, *, title: str, start: datetime | None, kind: str) -> bytes:
    """Figure of a wall's history as the bytes of a file of `kind`, one of FORMATS.

    `history` with nodes; `start` of the first sample, with offset, or None for an axis in hours. Raises InputError
    where matplotlib is missing.
    """
    require_plot(Path(f"figure{kind}"))
    from matplotlib.figure import Figure

    figure = Figure(figsize=(10.0, 8.0), layout="constrained")
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3, 2))
    time = _axis_time(history, start)
    _draw_nodes(figure, upper, time, history, boundary)
    _draw_loads(lower, time, history, boundary)
    figure.suptitle(title)
    _label_time(lower, start)
    file = io.BytesIO()
    figure.savefig(file, format=kind[1:], dpi=130, metadata={"Date": None} if kind == ".svg" else None)
    return file.getvalue()


def _axis_time(history: WallHistory, start: datetime | None) -> Any:
    passed = history.time - history.time[0]
    if start is None:
        return passed / SECONDS_PER_HOUR
    return [start + timedelta(seconds=float(seconds)) for seconds in passed]


def _draw_nodes(figure: "Figure", axes: "Axes", time: Any, history: WallHistory, boundary: WallBoundary) -> None:
    """Every node as a thin line coloured by its depth, both faces and both airs on top."""
    from matplotlib import colormaps
    from matplotlib.cm import ScalarMappable
    from matplotlib.colors import Normalize

    nodes = np.zeros((history.time.size, 0)) if history.nodes is None else history.nodes
    depth = 1e3 * history.grid.depth
    colours = ScalarMappable(Normalize(0.0, float(depth.max(initial=1e-3))), colormaps["viridis"])
    for i in range(nodes.shape[1]):
        axes.plot(time, nodes[:, i] - ZERO_CELSIUS, color=colours.to_rgba(depth[i]), linewidth=0.8)
    axes.plot(time, boundary.air_temperature - ZERO_CELSIUS, "k:", linewidth=1.0, label="exterior air")
    axes.plot(time, boundary.interior_air_temperature - ZERO_CELSIUS, "k--", linewidth=1.0, label="interior air")
    axes.plot(time, history.exterior - ZERO_CELSIUS, color="#D55E00", linewidth=2.8, label="exterior face")
    axes.plot(time, history.interior - ZERO_CELSIUS, color="#0072B2", linewidth=1.4, label="interior face")
    if nodes.shape[1] > 1:
        figure.colorbar(colours, ax=axes, label="depth of node [mm]", pad=0.01)
    axes.set_ylabel("temperature [°C]")
    axes.grid(alpha=0.3)
    axes.legend(**_ABOVE)


def _draw_loads(axes: "Axes", time: Any, history: WallHistory, boundary: WallBoundary) -> None:
    """Each path's heat into the exterior face, those that bring none left out, and their sum."""
    loads = exterior_loads(history, boundary)
    for name, (label, colour) in LOADS.items():
        values = getattr(loads, name)
        if np.any(values != 0.0):
            axes.plot(time, values, color=colour, linewidth=1.2, label=label)
    axes.plot(time, loads.total, "k", linewidth=1.6, label="sum, into the wall")
    axes.axhline(0.0, color="grey", linewidth=0.6)
    axes.set_ylabel("load on the exterior face [W m$^{-2}$]")
    axes.grid(alpha=0.3)
    axes.legend(**_ABOVE)


def _label_time(axes: "Axes", start: datetime | None) -> None:
    if start is None:
        axes.set_xlabel("time since the first sample [h]")
        return
    dates: Any = importlib.import_module("matplotlib.dates")
    locator = dates.AutoDateLocator(tz=start.tzinfo)
    axes.xaxis.set_major_locator(locator)
    axes.xaxis.set_major_formatter(dates.ConciseDateFormatter(locator, tz=start.tzinfo))
    axes.set_xlabel(f"time, {start.tzname()}")
