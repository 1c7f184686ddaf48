"""How a wall begins, since no series tells what went before it.

linear    steady conduction between exterior and interior air, as in section 3.6.1 of [Report1978].
steady    steady under the first sample.
periodic  as the first day leaves it, when that is repeated until the wall is the same after it as before. What one
          repetition changes is carried to its limit mode by mode, so that thick walls too need only a few.
"""

from dataclasses import dataclass, fields

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY, SECONDS_PER_HOUR
from sensorsim.errors import InputError, NumericsError
from sensorsim.thermal.grid import FloatArray
from sensorsim.thermal.wall_boundary import WallBoundary, WallSurface
from sensorsim.thermal.wall_modes import WallModes, wall_modes
from sensorsim.thermal.wall_steps import AT_ONCE, FOREVER, WallSteps, step_counts

STARTS = ("auto", "linear", "steady", "periodic")
SETTLED = 1e-3  # [K] that a day may change a wall that started periodically, and that it may be from its limit
MOST_DAYS = 50  # of a periodic start


@dataclass(frozen=True, slots=True, kw_only=True)
class WallStart:
    """What was done before the first sample."""

    kind: str  # 'linear', 'steady' or 'periodic'
    days: int  # repetitions of the first day
    change: float | None  # [K] largest of a cell over the last of them, None without any
    left: float | None  # [K] largest that further ones would bring, by the wall's modes
    settled: bool  # False where a periodic start came to its limit of days first
    time_constant: float  # [s] of the wall's slowest mode; infinite where it exchanges nothing


def covers_day(time: FloatArray) -> bool:
    """Whether a series tells a whole day: its last sample counts for as long as the one before."""
    return bool(time[-1] - time[0] + (time[-1] - time[-2]) >= SECONDS_PER_DAY * (1.0 - 1e-9))


def first_day(boundary: WallBoundary) -> WallBoundary:
    """The first 24 h as a day to be repeated: over its last hour, or last interval, it returns to its beginning."""
    size = int(np.searchsorted(boundary.time, boundary.time[0] + SECONDS_PER_DAY * (1.0 - 1e-9)))
    time = np.append(boundary.time[:size] - boundary.time[0], SECONDS_PER_DAY)
    back = np.clip((time - SECONDS_PER_DAY) / SECONDS_PER_HOUR + 1.0, 0.0, 1.0)

    def closed(values: FloatArray) -> FloatArray:
        day = np.append(values[:size], values[0])
        return np.asarray(day + back * (values[0] - day))

    return WallBoundary(time=time, **{name: closed(values) for name, values in _series(boundary).items()})


def make_start(steps: WallSteps, boundary: WallBoundary, *, kind: str, lead_in: int | None, step: float) -> WallStart:
    """Bring a wall to its first sample; `kind` is one of STARTS.

    auto: periodic where the series covers a day, else steady, and linear for a wall that exchanges heat with nothing.
    lead_in: days under the repeated first day; a periodic start takes at most so many, the others exactly.
    """
    whole = covers_day(boundary.time)
    if kind == "auto":
        kind = "periodic" if whole else "steady"
        kind = kind if _exchanges(boundary, steps.surface, kind) else "linear"
    _require_possible(steps.surface, boundary, kind, lead_in, whole)
    modes = wall_modes(steps.grid, boundary, steps.surface)
    steps.put_line(float(boundary.air_temperature[0]), float(boundary.interior_air_temperature[0]))
    if kind == "periodic":
        return _periodic(steps, first_day(boundary), modes, MOST_DAYS if lead_in is None else lead_in, step)
    steps.hold(boundary, 0, FOREVER if kind == "steady" else AT_ONCE)
    change = None
    if lead_in:
        day = first_day(boundary)
        change = [_pass_day(steps, day, step) for _ in range(lead_in)][-1]
    return WallStart(
        kind=kind, days=lead_in or 0, change=None if change is None else _largest(change),
        left=None if change is None else _largest(modes.limit(change, SECONDS_PER_DAY) - change),
        settled=True, time_constant=modes.time_constant,
    )  # fmt: skip


def _periodic(steps: WallSteps, day: WallBoundary, modes: WallModes, most: int, step: float) -> WallStart:
    """Repeat a day until it changes nothing, from the steady state under its mean."""
    cells = steps.columns.cells
    line = cells.copy()
    try:
        steps.hold(_mean_sample(day), 0, FOREVER)
    except NumericsError:
        cells[:] = line
    for done in range(1, most + 1):
        change = _pass_day(steps, day, step)
        further = modes.limit(change, SECONDS_PER_DAY) - change
        settled = max(_largest(change), _largest(further)) <= SETTLED
        if settled or done == most:
            break
        cells[:, 0] += further
    return WallStart(
        kind="periodic", days=done, change=_largest(change), left=_largest(further), settled=settled,
        time_constant=modes.time_constant,
    )  # fmt: skip


def _pass_day(steps: WallSteps, day: WallBoundary, step: float) -> FloatArray:
    """March through a day; returns the change of the cells (n,) [K]. Its heat does not count."""
    before = steps.columns.cells[:, 0].copy()
    counts = step_counts(day.time, step)
    steps.cross(day, counts, 0, counts.size)
    steps.columns.heat[:] = 0.0
    return np.asarray(steps.columns.cells[:, 0] - before)


def _exchanges(boundary: WallBoundary, surface: WallSurface, kind: str) -> bool:
    """Whether a start leads to one state: by an emissivity, or a film at the samples that it is made from."""
    film = boundary.exterior_film + boundary.interior_film
    radiates = surface.emissivity + surface.interior_emissivity > 0.0
    return kind == "linear" or radiates or bool(np.any((film[:1] if kind == "steady" else film) > 0.0))


def _require_possible(
    surface: WallSurface, boundary: WallBoundary, kind: str, lead_in: int | None, whole: bool
) -> None:
    if kind not in STARTS:
        raise InputError("wall", "start", kind, "unknown", f"use one of {', '.join(STARTS)}")
    if lead_in is not None and lead_in < (1 if kind == "periodic" else 0):
        raise InputError("wall", "lead_in", lead_in, "too few days", "give 0 or more, a periodic start 1 or more")
    if not _exchanges(boundary, surface, kind):
        remedy = "use the linear start, or give a film or an emissivity"
        raise InputError("wall", "start", kind, "the wall exchanges heat with neither side", remedy)
    if not whole and (kind == "periodic" or lead_in):
        entry, value = ("start", kind) if kind == "periodic" else ("lead_in", lead_in)
        remedy = "use the steady start without lead-in, or give 24 h or more"
        raise InputError("wall", entry, value, "the series covers less than a day", remedy)


def _mean_sample(day: WallBoundary) -> WallBoundary:
    """Time means of a day, as a series of two equal samples."""
    mean = {name: np.trapezoid(values, day.time) / SECONDS_PER_DAY for name, values in _series(day).items()}
    return WallBoundary(time=day.time[[0, -1]], **{name: np.full(2, value) for name, value in mean.items()})


def _series(boundary: WallBoundary) -> dict[str, FloatArray]:
    return {field.name: getattr(boundary, field.name) for field in fields(boundary) if field.name != "time"}


def _largest(values: FloatArray) -> float:
    return float(np.max(np.abs(values), initial=0.0))
