"""What is tried: the presets, one knob at a time away from the default, and combinations between them."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from sensorsim.errors import InputError
from sensorsim.tables import PRESETS, BakeSettings, preset

BASELINE = "standard"  # that one knob at a time is turned away from
THREE = (0.1, 0.5, 0.9)
SEVEN = (0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98)


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """One setting of the baker that is measured."""

    group: str  # 'preset', 'factor' or 'combination'
    factor: str  # the knob that is turned; empty but for a factor
    name: str  # unique; of a factor 'knob value'
    settings: BakeSettings
    sky: str  # of the full solve that it is held against


@dataclass(frozen=True, slots=True, kw_only=True)
class Factor:
    """One knob: what it does, and the values it is turned to."""

    title: str
    values: Sequence[tuple[str, Mapping[str, Any]]]  # label, changes of the baseline


FACTORS: Mapping[str, Factor] = {
    "orientations": Factor(
        title="standard orientations",
        values=tuple(
            (name, {"orientations": name})
            for name in ("report10", "report26", "icosphere42", "icosphere162", "icosphere642")
        ),
    ),
    "reflectances": Factor(
        title="reflectances that are solved, through all of which the polynomial goes",
        values=(
            ("2", {"reflectances": (0.1, 0.9), "degree": 1}),
            ("3", {"reflectances": THREE, "degree": 2}),
            ("5", {"reflectances": (0.1, 0.3, 0.5, 0.7, 0.9), "degree": 4}),
            ("7", {"reflectances": SEVEN, "degree": 6}),
        ),
    ),
    "degree": Factor(
        title="degree of the polynomial through five reflectances",
        values=tuple(
            (str(degree), {"reflectances": (0.1, 0.3, 0.5, 0.7, 0.9), "degree": degree}) for degree in range(5)
        ),
    ),
    "step": Factor(
        title="step of the march [s]",
        values=tuple((f"{step:g}", {"step": step}) for step in (100.0, 300.0, 900.0)),
    ),
    "slice_interval": Factor(
        title="time between the slices that are kept [min]",
        values=tuple((f"{minutes}", {"slice_interval": 60.0 * minutes}) for minutes in (5, 15, 30, 60, 120)),
    ),
    "lead_in_days": Factor(
        title="lead-in before the image day [d]",
        values=tuple((f"{days}", {"lead_in_days": float(days)}) for days in (0, 1, 2, 3, 4)),
    ),
    "sky": Factor(
        title="sky of the daylight, against the full solve under the default's",
        values=tuple((name, {"sky": name}) for name in ("perez", "quadrants")),
    ),
}


def plan_trials(presets: Iterable[str] | None = None, factors: Iterable[str] | None = None) -> list[Trial]:
    """Trials of the named presets and factors, of all where None; combinations come with all factors.

    Raises InputError for a preset or a factor of an unknown name.
    """
    chosen = list(PRESETS) if presets is None else list(dict.fromkeys(presets))
    trials = [_trial("preset", "", name, preset(name)) for name in chosen]
    for name in FACTORS if factors is None else dict.fromkeys(factors):
        if name not in FACTORS:
            raise InputError("accuracy study", "factor", name, "unknown factor", f"use {', '.join(FACTORS)}")
        trials += _turned(name)
    return trials + (_combinations() if factors is None else [])


def _turned(factor: str) -> list[Trial]:
    base = preset(BASELINE)
    return [
        _trial("factor", factor, f"{factor} {label}", replace(base, **_settled(base, changes)), sky=base.sky)
        for label, changes in FACTORS[factor].values
    ]


def _settled(base: BakeSettings, changes: Mapping[str, Any]) -> dict[str, Any]:
    """The changes, with slices no finer than the step that is asked for."""
    step = changes.get("step", base.step)
    interval = changes.get("slice_interval", base.slice_interval)
    return {**changes, "slice_interval": max(interval, step)}


def _combinations() -> list[Trial]:
    """Orientations by reflectances by step, the default else."""
    base = preset(BASELINE)
    found = []
    for orientations in ("report26", "icosphere42", "icosphere162"):
        for reflectances in ((0.1, 0.9), THREE):
            for step in (300.0, 900.0):
                name = f"{orientations}, {len(reflectances)} reflectances, {step:g} s"
                changes: dict[str, Any] = {
                    "orientations": orientations, "reflectances": reflectances, "degree": len(reflectances) - 1,
                    "step": step,
                }  # fmt: skip
                found.append(_trial("combination", "", name, replace(base, **changes)))
    return found


def _trial(group: str, factor: str, name: str, settings: BakeSettings, *, sky: str | None = None) -> Trial:
    return Trial(group=group, factor=factor, name=name, settings=settings, sky=settings.sky if sky is None else sky)
