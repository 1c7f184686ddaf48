"""All hard cases of the march and of the path from its temperatures to the pixel, and their measurement."""

from collections.abc import Callable

from sensorsim.study import (
    stability_inputs,
    stability_march_exact,
    stability_march_laws,
    stability_march_layers,
    stability_march_loads,
    stability_march_skins,
    stability_march_snow,
    stability_pixel_frames,
    stability_pixel_normals,
    stability_pixel_tables,
)
from sensorsim.study.stability_model import Case, Outcome, evaluate_case

Progress = Callable[[str, int, int], None]

CASES: tuple[Case, ...] = (
    *stability_march_skins.CASES,
    *stability_march_layers.CASES,
    *stability_march_loads.CASES,
    *stability_march_snow.CASES,
    *stability_march_laws.CASES,
    *stability_march_exact.CASES,
    *stability_pixel_normals.CASES,
    *stability_pixel_tables.CASES,
    *stability_pixel_frames.CASES,
    *stability_inputs.CASES,
)


def evaluate_cases(progress: Progress | None = None) -> tuple[Outcome, ...]:
    """Measure all cases in order."""
    outcomes = []
    for done, case in enumerate(CASES):
        if progress is not None:
            progress(case.name, done, len(CASES))
        outcomes.append(evaluate_case(case))
    return tuple(outcomes)
