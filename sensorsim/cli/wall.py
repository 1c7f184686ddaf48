"""`sensorsim wall`: one wall under a boundary series of one's own."""

import json
import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import typer
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import BarColumn, Progress, TaskProgressColumn, TextColumn, TimeRemainingColumn

from sensorsim.cli.options import AsJson
from sensorsim.constants import SECONDS_PER_DAY, SECONDS_PER_HOUR, ZERO_CELSIUS
from sensorsim.errors import InputError
from sensorsim.materials import Construction, load_construction
from sensorsim.study import plot_wall, require_plot
from sensorsim.thermal import LONGEST_STEP, WallHistory, history_csv, march_construction, read_boundary, write_whole
from sensorsim.thermal.boundary_file import LONGEST_GAP, UNITS, option
from sensorsim.thermal.wall import Progress as MarchProgress
from sensorsim.thermal.wall_start import SETTLED

FloatArray = NDArray[np.float64]

FORGOTTEN = math.log(400.0)  # time constants in which 20 K fall to 0.05 K
PANEL = "Constants in place of columns"
Celsius = Annotated[float | None, typer.Option(help="In C.", rich_help_panel=PANEL)]
Irradiance = Annotated[float | None, typer.Option(help="On the face, in W m-2.", rich_help_panel=PANEL)]
Film = Annotated[float | None, typer.Option(help="Of convection, in W m-2 K-1.", rich_help_panel=PANEL)]


def wall(
    construction: Annotated[str, typer.Option(help="Construction of the package, or a TOML file of layers.")],
    boundary: Annotated[Path, typer.Option(help="CSV file of what acts on both faces.")],
    out: Annotated[Path, typer.Option(help="CSV file of the surface temperatures at the boundary's times.")],
    absorptance: Annotated[float, typer.Option(help="Solar absorptance of the exterior face.")] = 0.7,
    emissivity: Annotated[float, typer.Option(help="Emissivity of the exterior face.")] = 0.9,
    interior_emissivity: Annotated[float, typer.Option(help="Emissivity of the interior face.")] = 0.9,
    sky_view: Annotated[float, typer.Option(help="Share that sees the sky; the rest sees the ground.")] = 0.5,
    air_temperature: Celsius = None,
    sky_temperature: Celsius = None,
    ground_temperature: Celsius = None,
    beam: Irradiance = None,
    sky_diffuse: Irradiance = None,
    ground_reflected: Irradiance = None,
    exterior_film: Film = None,
    interior_air_temperature: Celsius = None,
    interior_radiant_temperature: Celsius = None,
    interior_film: Film = None,
    step: Annotated[float, typer.Option(help="Longest internal step, in s.")] = LONGEST_STEP,
    start: Annotated[
        str, typer.Option(help="periodic, steady, linear, or auto: periodic where a day is told.")
    ] = "auto",
    lead_in: Annotated[
        int | None, typer.Option(help="Days of the first day repeated before it; of a periodic start the most.")
    ] = None,
    longest_gap: Annotated[float, typer.Option(help="Longest time between rows that is bridged, in h.")] = LONGEST_GAP
    / SECONDS_PER_HOUR,
    nodes: Annotated[bool, typer.Option("--nodes", help="Write the temperatures of the nodes too.")] = False,
    plot: Annotated[Path | None, typer.Option(help="Figure of nodes and loads: .png, .svg or .pdf.")] = None,
    as_json: AsJson = False,
) -> None:
    """March one wall through a boundary series and write its surface temperatures.

    The file begins with a row of column names: time, ISO 8601 with offset or seconds, and those listed at the end of
    this page, with _ for -. Inputs are linear between rows. Sun that is not given is 0, the room's surfaces are at its
    air temperature unless told; all else is needed, sky and ground where the exterior face sees them.
    """
    given = locals()
    constants = {name: given[name] for name in UNITS if given[name] is not None}
    surface = {name: given[name] for name in ("absorptance", "emissivity", "interior_emissivity", "sky_view")}
    _require_options(surface, step, longest_gap, {"--out": out, "--plot": plot, "--boundary": boundary})
    stack = load_construction(construction)
    gap = longest_gap * SECONDS_PER_HOUR
    series = read_boundary(boundary, constants=constants, emissivity=emissivity, sky_view=sky_view, longest_gap=gap)
    keep = nodes or plot is not None
    with _march_progress(stack.name) as progress:
        history = march_construction(
            stack, series.boundary, **surface, step=step, start=start, lead_in=lead_in, keep_nodes=keep,
            progress=progress,
        )  # fmt: skip
    contents = {out: history_csv(history, series.time_text, nodes=nodes).encode()}
    if plot is not None:
        kind = plot.suffix.lower()
        contents[plot] = plot_wall(history, series.boundary, title=stack.name, start=series.start, kind=kind)
    write_whole(contents)
    notes = [*series.notes, *stack_notes(stack, history), *start_notes(history)]
    _report(history, stack, notes, [str(path) for path in contents], as_json)


def stack_notes(stack: Construction, history: WallHistory) -> list[str]:
    """What a construction is beside layers one behind the other."""
    notes = []
    if stack.paths:
        shares = ", ".join(f"{path.name} {path.fraction:.3g}" for path in stack.paths)
        notes.append(f"parallel paths by share of the area: {shares}; nodes are those of the widest")
    if stack.shape != "slab":
        notes.append(f"{stack.shape} of radius {stack.radius:g} m; heats are per exterior area")
    if history.grid.interior_area == 0.0:
        notes.append("it is solid: the innermost node stands for the interior face")
    return notes


def start_notes(history: WallHistory) -> list[str]:
    """What was done before the first row, and how long it is felt."""
    start, span = history.start, history.time[-1] - history.time[0]
    constant = start.time_constant
    notes = [f"slowest mode of the wall: {_span(constant)}"]
    days = _count(start.days, "day")
    if start.kind == "periodic":
        notes.append(
            f"start: periodic, the first day repeated over {days}; the last changed the wall by {start.change:.1e} K, "
            f"further ones would by {start.left:.1e} K"
        )
        if not start.settled:
            notes.append(f"the start is not settled to {SETTLED:g} K: raise --lead-in above {days}")
        return notes
    after = f", then the first day repeated over {days}" if start.days else ""
    notes.append(f"start: {_KINDS[start.kind]}{after}")
    felt = FORGOTTEN * constant - start.days * SECONDS_PER_DAY
    if felt > 0.0:
        share = "longer than the series" if felt > span else f"the first {_span(felt)} of the series"
        notes.append(f"a start 20 K off would be felt by more than 0.05 K for {share}")
    return notes


_KINDS = {"steady": "steady under the first row", "linear": "linear between exterior and interior air"}


def _span(seconds: float) -> str:
    """A time in the unit that suits it."""
    if math.isinf(seconds):
        return "never forgets (no exchange of heat)"
    for unit, length in (("d", SECONDS_PER_DAY), ("h", SECONDS_PER_HOUR), ("min", 60.0)):
        if seconds >= 2.0 * length:
            return f"{seconds / length:.3g} {unit}"
    return f"{seconds:.3g} s"


def _count(number: int, thing: str) -> str:
    return f"{number} {thing}{'' if number == 1 else 's'}"


def _require_options(surface: dict[str, float], step: float, longest_gap: float, files: dict[str, Path | None]) -> None:
    """Refuse numbers that cannot be, before anything is read."""
    for name, value in surface.items():
        if not 0.0 <= value <= 1.0:
            raise InputError("command line", option(name), value, "not from 0 to 1", "correct it")
    for name, value in (("--step", step), ("--longest-gap", longest_gap)):
        if not (math.isfinite(value) and value > 0.0):
            raise InputError("command line", name, value, "not a number above 0", "correct it")
    named = {name: path.resolve() for name, path in files.items() if path is not None}
    for name in ("--out", "--plot"):
        if name in named and list(named.values()).count(named[name]) > 1:
            remedy = "give each file a name of its own"
            raise InputError("command line", name, str(files[name]), "named twice", remedy)
    if (plot := files["--plot"]) is not None:
        require_plot(plot)


@contextmanager
def _march_progress(title: str) -> Iterator[MarchProgress]:
    """A progress bar on the error stream while a wall is marched, where that is a terminal."""
    columns = (TextColumn("{task.description}"), BarColumn(), TaskProgressColumn(), TimeRemainingColumn())
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task(title, total=None)

        def report(done: int, total: int) -> None:
            bar.update(task, completed=done, total=total)

        yield report


def _report(history: WallHistory, stack: Construction, notes: list[str], files: list[str], as_json: bool) -> None:
    """Notes to the error stream; files, or figures as JSON, to the output."""
    errors = Console(stderr=True, soft_wrap=True)
    errors.print(
        f"{stack.name}: {_count(len(stack.layers), 'layer')}, {_count(history.grid.capacity.size, 'node')}",
        highlight=False,
    )
    for note in notes:
        errors.print(f"- {note}", markup=False, highlight=False)
    if as_json:
        print(json.dumps({"files": files, "notes": notes, **figures(history, stack)}, indent=2))  # noqa: T201
        return
    console = Console(soft_wrap=True)
    for file in files:
        console.print(f"wrote {file}", markup=False, highlight=False)


def figures(history: WallHistory, stack: Construction) -> dict[str, Any]:
    """What a history comes to, in the units of the files."""
    start, constant = history.start, history.start.time_constant
    return {
        "construction": stack.name,
        "thermal_resistance_m2_K_W": stack.thermal_resistance,
        "paths": {path.name: path.fraction for path in stack.paths},
        "shape": stack.shape,
        "radius_m": stack.radius,
        "nodes": history.grid.capacity.size,
        "samples": history.time.size,
        "span_h": float(history.time[-1] - history.time[0]) / SECONDS_PER_HOUR,
        "surface": asdict(history.surface),
        "exterior_surface_temperature_C": _extremes(history.exterior),
        "interior_surface_temperature_C": _extremes(history.interior),
        "time_constant_h": constant / SECONDS_PER_HOUR if math.isfinite(constant) else None,
        "start": {
            "kind": start.kind, "days": start.days, "last_change_K": start.change, "left_K": start.left,
            "settled": start.settled,
        },
        "heat_J_m2": {
            "through_exterior": float(history.heat[-1, 0]), "through_interior": float(history.heat[-1, 1]),
            "stored": history.stored, "relative_residual": history.energy_residual,
        },
    }  # fmt: skip


def _extremes(temperature: FloatArray) -> dict[str, float]:
    celsius = temperature - ZERO_CELSIUS
    return {"min": float(celsius.min()), "max": float(celsius.max())}
