"""What is tried: the presets, one knob at a time away from the default, and combinations between them."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from sensorsim.errors import InputError
from sensorsim.tables import PRESETS, BakeSettings, preset
from sensorsim.tables.full_solve import fine_settings

BASELINE = "standard"  # that one knob at a time is turned away from
TWO, THREE, FOUR, FIVE = (0.07, 0.93), (0.07, 0.5, 0.93), (0.05, 0.45, 0.8, 0.95), (0.1, 0.3, 0.5, 0.7, 0.9)


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """One setting of the baker that is measured."""

    group: str  # 'preset', 'factor' or 'combination'
    factor: str  # the knob that is turned; empty but for a factor
    name: str  # unique; of a factor 'knob value'
    settings: BakeSettings
    truth: BakeSettings  # of the full solve that it is held against


@dataclass(frozen=True, slots=True, kw_only=True)
class Factor:
    """One knob: what it does, and the values it is turned to."""

    title: str
    values: Sequence[tuple[str, Mapping[str, Any]]]  # label, changes of the baseline


def _values(knob: str, *values: Any) -> tuple[tuple[str, Mapping[str, Any]], ...]:
    """Values of one knob under their own names."""
    return tuple((f"{value:g}" if isinstance(value, float) else str(value), {knob: value}) for value in values)


FACTORS: Mapping[str, Factor] = {
    "orientations": Factor(
        title="standard orientations",
        values=_values(
            "orientations",
            "report26",
            "icosphere42",
            "octahedron66",
            "icosphere162",
            "octahedron258",
        ),
    ),
    "interpolation": Factor(
        title="interpolation between them",
        values=_values("interpolation", "spline", "barycentric", "closest"),
    ),
    "lobes": Factor(
        title="time between sun lobes [s], 0 for none",
        values=_values("lobes", 0.0, 3600.0, 1800.0, 900.0, 300.0),
    ),
    "reflectances": Factor(
        title="reflectances that are solved, the polynomial through all of them",
        values=tuple(
            (str(len(chosen)), {"reflectances": chosen, "degree": len(chosen) - 1})
            for chosen in (TWO, THREE, FOUR, FIVE)
        ),
    ),
    "degree": Factor(
        title="degree of the polynomial through five reflectances",
        values=tuple((str(degree), {"reflectances": FIVE, "degree": degree}) for degree in (0, 1, 2, 3, 4)),
    ),
    "knot": Factor(
        title="reflectance at which the last power of four begins, 0 for a cubic",
        values=_values("knot", 0.0, 0.4, 0.6, 0.7),
    ),
    "step": Factor(
        title="step of the march [s]",
        values=_values("step", 60.0, 150.0, 300.0, 600.0),
    ),
    "cell_size": Factor(
        title="size of the walls' cells over the usual",
        values=_values("cell_size", 0.5, 1.0, 2.0, 4.0),
    ),
    "slice_interval": Factor(
        title="time between the slices that are kept [s]",
        values=_values("slice_interval", 300.0, 900.0, 1800.0, 3600.0),
    ),
    "lead_in_days": Factor(
        title="lead-in before the image day [d]",
        values=(("by wall", {"lead_in_days": None}), *_values("lead_in_days", 0.0, 1.0, 2.0, 4.0)),
    ),
    "lead_in_stride": Factor(
        title="steps that are joined to one in the lead-in",
        values=_values("lead_in_stride", 1, 3, 6, 12),
    ),
    "precision": Factor(
        title="precision of the tables",
        values=_values("precision", "float32", "float16"),
    ),
    "sky": Factor(
        title="sky of the daylight, against the full solve under the default's",
        values=_values("sky", "perez", "quadrants"),
    ),
}
COMBINATIONS: Mapping[str, Mapping[str, Any]] = {
    f"{orientations}, {interpolation}, lobes {lobes:g} s, {len(chosen)} reflectances, step {step:g} s": {
        "orientations": orientations, "interpolation": interpolation, "lobes": lobes, "reflectances": chosen,
        "degree": len(chosen) - 1, "step": step,
    }
    for orientations, interpolation, lobes, chosen, step in (
        ("report26", "barycentric", 0.0, THREE, 900.0),
        ("report26", "barycentric", 3600.0, TWO, 900.0),
        ("report26", "spline", 3600.0, TWO, 600.0),
        ("icosphere42", "spline", 3600.0, TWO, 900.0),
        ("icosphere42", "spline", 1800.0, THREE, 600.0),
        ("icosphere42", "spline", 900.0, THREE, 300.0),
        ("octahedron66", "spline", 900.0, TWO, 600.0),
        ("octahedron66", "spline", 300.0, FOUR, 300.0),
        ("icosphere162", "barycentric", 0.0, THREE, 600.0),
        ("icosphere162", "spline", 900.0, THREE, 300.0),
    )
}  # fmt: skip


def plan_trials(presets: Iterable[str] | None = None, factors: Iterable[str] | None = None) -> list[Trial]:
    """Trials of the named presets and factors, of all where None; combinations come with all factors.

    Raises InputError for a preset or a factor of an unknown name.
    """
    chosen = list(PRESETS) if presets is None else list(dict.fromkeys(presets))
    trials = [_trial("preset", "", name, preset(name)) for name in chosen]
    for name in FACTORS if factors is None else dict.fromkeys(factors):
        if name not in FACTORS:
            raise InputError(
                "accuracy study",
                "factor",
                name,
                "unknown factor",
                f"use {', '.join(FACTORS)}",
            )
        trials += _turned(name)
    return trials + (_combinations() if factors is None else [])


def _turned(factor: str) -> list[Trial]:
    base = preset(BASELINE)
    return [
        _trial("factor", factor, f"{factor} {label}", _settled(base, changes), truth=base)
        for label, changes in FACTORS[factor].values
    ]


def _combinations() -> list[Trial]:
    base = preset(BASELINE)
    return [_trial("combination", "", name, _settled(base, changes)) for name, changes in COMBINATIONS.items()]


def _settled(base: BakeSettings, changes: Mapping[str, Any]) -> BakeSettings:
    """The baseline with the changes, its slices as coarse as the step that is asked for demands."""
    step = changes.get("step", base.step)
    interval = changes.get("slice_interval", base.slice_interval)
    return replace(base, **{**changes, "slice_interval": step * math.ceil(interval / step)})


def _trial(group: str, factor: str, name: str, settings: BakeSettings, *, truth: BakeSettings | None = None) -> Trial:
    truth = settings if truth is None else truth
    return Trial(group=group, factor=factor, name=name, settings=settings, truth=fine_settings(truth))
