"""What the uncertainty of each input is worth in kelvin at the surface, beside what the solver itself costs.

One input is changed at a time, by its standard uncertainty, and the wall marched anew: solver, sky and ground are the
ones that pictures are made with.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import date

import numpy as np

from sensorsim.environment import read_weather
from sensorsim.materials import Catalogue, load_catalogue
from sensorsim.study.gallery import FALL, SUMMER, WINTER
from sensorsim.study.sensitivity_inputs import INPUTS
from sensorsim.study.sensitivity_model import (
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
FINE_STEP = 30.0  # [s] of the solution that the solver's own error is taken against
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
    """Change one input at a time, on every surface, day and hour."""
    catalogue, found = load_catalogue(), []
    for done, specimen in enumerate(specimens):
        if progress is not None:
            progress(specimen.name, done, len(specimens))
        setups = [setup_of(specimen, day, catalogue) for day in days]
        effects = [
            Effect(input=each, kelvin=np.stack([change_of(setup, each.change, hours) for setup in setups]))
            for each in inputs
        ]
        found.append(
            Sensitivity(
                specimen=specimen, days=tuple(days), hours=hours,
                temperature=np.stack([at_hours(setup, surface_history(setup), hours) for setup in setups]),
                effects=tuple(sorted(effects, key=lambda effect: -effect.rms)),
                solver=_own_error("solver", [_solver_miss(setup, hours) for setup in setups]),
                fit=_own_error("fit", [_fit_miss(setup, hours, settings) for setup in setups]),
            )
        )  # fmt: skip
    return tuple(found)


def setup_of(specimen: Specimen, day: date, catalogue: Catalogue, *, step: float = 300.0) -> Setup:
    """A surface of the catalogue under the weather of one of its days."""
    material = catalogue.material(specimen.code)
    return build_setup(
        read_weather(day.isoformat()), day, ground=catalogue.wall_type(GROUND, "none"),
        wall=catalogue.wall_type(specimen.code, specimen.interior), reflectance=material.solar_reflectance,
        azimuth=specimen.azimuth, tilt=specimen.tilt, step=step,
    )  # fmt: skip


def _own_error(name: str, misses: Sequence[FloatArray]) -> Effect:
    unchanged = Input(name=name, amount="", source="", change=lambda _setup, _sign: None)
    return Effect(input=unchanged, kelvin=np.stack(misses))


def _solver_miss(setup: Setup, hours: FloatArray) -> FloatArray:
    """What the steps of a bake cost (h,) [K], against steps and cells for 30 s."""
    fine = build_setup(
        setup.weather, setup.image_day, ground=setup.ground, wall=setup.wall, reflectance=setup.reflectance,
        azimuth=setup.azimuth, tilt=setup.tilt, step=FINE_STEP,
    )  # fmt: skip
    coarse = at_hours(setup, surface_history(setup), hours)
    return np.asarray(np.abs(coarse - at_hours(fine, surface_history(fine), hours)))


def _fit_miss(setup: Setup, hours: FloatArray, settings: BakeSettings | None) -> FloatArray:
    """What the tables' standard orientations, reflectances and slices cost (h,) [K], against the surface's own march."""
    tables = bake_tables(setup.environment, (setup.wall,), ground=setup.ground, settings=settings)
    wall, reflectance = np.zeros(1, dtype=np.int64), np.array([setup.reflectance])
    fitted = [surface_temperature(tables, normal_of(setup), wall, reflectance, 3600.0 * hour)[0] for hour in hours]
    return np.asarray(np.abs(np.array(fitted) - at_hours(setup, surface_history(setup), hours)))
