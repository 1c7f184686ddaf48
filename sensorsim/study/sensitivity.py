"""What the uncertainty of each input is worth in kelvin at the surface, beside what the solver itself costs.

One input is changed at a time, by its standard uncertainty, and the wall marched anew: solver, sky and ground are the
ones that pictures are made with.
"""

import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from datetime import date
from functools import partial

import numpy as np

from sensorsim.environment import read_weather
from sensorsim.materials import Catalogue, load_catalogue
from sensorsim.study.gallery import FALL, SUMMER, WINTER
from sensorsim.study.sensitivity_inputs import INPUTS
from sensorsim.study.sensitivity_model import (
    Change,
    Effect,
    FloatArray,
    Input,
    Setup,
    at_hours,
    build_setup,
    change_of,
    normal_of,
    surface_history,
)
from sensorsim.tables import BakeSettings, bake_tables, surface_temperature

HOURS = np.array([7.0, 10.0, 13.0, 17.0])  # of the report's pictures
DAYS = (WINTER, SUMMER, FALL)
GROUND = 93  # loam, the plane that walls see
FINE_STEP = 100.0  # [s] of the solution that the solver's own error is taken against
UNCHANGED: Change = lambda _setup, _sign: None  # noqa: E731
SOLVER = Input(name="solver", amount="step 300 s", source="against steps of 100 s", change=UNCHANGED)
FIT = Input(name="fit", amount="tables", source="against the surface's own march", change=UNCHANGED)
Progress = Callable[[str, int, int], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Specimen:
    """A surface to be tried."""

    name: str
    code: int  # of its material
    interior: str
    azimuth: float  # [deg]
    tilt: float  # [deg]


SPECIMENS = (
    Specimen(name="brick wall, south-east", code=20, interior="heated", azimuth=142.0, tilt=90.0),
    Specimen(name="metal wall, south-west", code=12, interior="unheated", azimuth=232.0, tilt=90.0),
    Specimen(name="concrete wall, south-west", code=25, interior="heated", azimuth=232.0, tilt=90.0),
    Specimen(name="built-up roof", code=67, interior="heated", azimuth=0.0, tilt=0.0),
    Specimen(name="asphalt", code=81, interior="none", azimuth=0.0, tilt=0.0),
    Specimen(name="grass", code=94, interior="none", azimuth=0.0, tilt=0.0),
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Sensitivity:
    """Effects of all inputs on one surface, and the errors of solver and fit, which are no uncertainty of an input."""

    specimen: Specimen
    days: tuple[date, ...]
    hours: FloatArray  # (h,)
    temperature: FloatArray  # (d, h) [K] with nothing changed
    effects: tuple[Effect, ...]  # largest rms first
    solver: Effect
    fit: Effect


def study_sensitivity(
    specimens: Sequence[Specimen] = SPECIMENS,
    *,
    inputs: Sequence[Input] = INPUTS,
    days: Sequence[date] = DAYS,
    hours: FloatArray = HOURS,
    settings: BakeSettings | None = None,
    progress: Progress | None = None,
) -> tuple[Sensitivity, ...]:
    """Change one input at a time, on every surface, day and hour; days in threads."""
    catalogue, found = load_catalogue(), []
    with ThreadPoolExecutor(max_workers=os.cpu_count()) as pool:
        for done, specimen in enumerate(specimens):
            if progress is not None:
                progress(specimen.name, done, len(specimens))
            tried = partial(_try_day, specimen, catalogue=catalogue, inputs=inputs, hours=hours, settings=settings)
            found.append(_gather(specimen, tuple(days), hours, inputs, list(pool.map(tried, days))))
    return tuple(found)


def _try_day(
    specimen: Specimen, day: date, *, catalogue: Catalogue, inputs: Sequence[Input], hours: FloatArray,
    settings: BakeSettings | None,
) -> FloatArray:  # fmt: skip
    """Rows (3 + inputs, h) of a day: temperature, errors of solver and fit, and what each input is worth [K]."""
    setup = setup_of(specimen, day, catalogue)
    plain = at_hours(setup, surface_history(setup), hours)
    own = [plain, _solver_miss(setup, hours, plain), _fit_miss(setup, hours, plain, settings)]
    return np.stack([*own, *(change_of(setup, each.change, hours, plain) for each in inputs)])


def _gather(
    specimen: Specimen, days: tuple[date, ...], hours: FloatArray, inputs: Sequence[Input], rows: list[FloatArray]
) -> Sensitivity:
    table = np.stack(rows, axis=1)  # (3 + inputs, d, h)
    effects = [Effect(input=each, kelvin=kelvin) for each, kelvin in zip(inputs, table[3:], strict=True)]
    return Sensitivity(
        specimen=specimen, days=days, hours=hours, temperature=table[0],
        effects=tuple(sorted(effects, key=lambda effect: -effect.rms)),
        solver=Effect(input=SOLVER, kelvin=table[1]), fit=Effect(input=FIT, kelvin=table[2]),
    )  # fmt: skip


def setup_of(specimen: Specimen, day: date, catalogue: Catalogue, *, step: float = 300.0) -> Setup:
    """A surface of the catalogue under the weather of one of its days."""
    material = catalogue.material(specimen.code)
    return build_setup(
        read_weather(day.isoformat()), day, ground=catalogue.wall_type(GROUND, "none"),
        wall=catalogue.wall_type(specimen.code, specimen.interior), reflectance=material.solar_reflectance,
        azimuth=specimen.azimuth, tilt=specimen.tilt, step=step,
    )  # fmt: skip


def _solver_miss(setup: Setup, hours: FloatArray, plain: FloatArray) -> FloatArray:
    """What the steps of a bake cost (h,) [K], against steps and cells for 100 s."""
    fine = build_setup(
        setup.weather, setup.image_day, ground=setup.ground, wall=setup.wall, reflectance=setup.reflectance,
        azimuth=setup.azimuth, tilt=setup.tilt, step=FINE_STEP,
    )  # fmt: skip
    return np.asarray(np.abs(plain - at_hours(fine, surface_history(fine), hours)))


def _fit_miss(setup: Setup, hours: FloatArray, plain: FloatArray, settings: BakeSettings | None) -> FloatArray:
    """What the tables' orientations, reflectances and slices cost (h,) [K], against the surface's own march."""
    tables = bake_tables(setup.environment, (setup.wall,), ground=setup.ground, settings=settings)
    wall, reflectance = np.zeros(1, dtype=np.int64), np.array([setup.reflectance])
    fitted = [surface_temperature(tables, normal_of(setup), wall, reflectance, 3600.0 * hour)[0] for hour in hours]
    return np.asarray(np.abs(np.array(fitted) - plain))
