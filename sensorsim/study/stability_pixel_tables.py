"""The tables between march and pixel: ends of the day, ends of reflectance, ill-conditioned fits, precision."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import product
from typing import Any

import numpy as np

from sensorsim.study.stability_model import Case
from sensorsim.study.stability_world import SETTINGS, FloatArray, directions, shade, small_world
from sensorsim.tables import (
    LookupTable,
    ShadeTables,
    bake_tables,
    evaluate_polynomial,
    fit_polynomials,
    surface_temperature,
)
from sensorsim.tables.coefficient_texture import coefficient_texels

MIDNIGHT = 86400.0  # [s]


def _at_slices() -> float:
    """Shade at every slice, midnights included, less that of tables which hold this slice alone."""
    tables, normal = small_world().tables, directions(200)
    rows, reflectance = np.arange(200) % len(tables.wall_types), np.linspace(0.0, 1.0, 200)
    worst = 0.0
    for k, time in enumerate(tables.time_of_day):
        whole = surface_temperature(tables, normal, rows, reflectance, float(time))
        alone = surface_temperature(_only(tables, k), normal, rows, reflectance, 0.0)
        worst = max(worst, float(np.abs(whole - alone).max()))
    return worst


def _only(tables: ShadeTables, index: int) -> ShadeTables:
    """Tables that hold one slice, twice, all day."""
    twice = np.array([index, index])
    lobes = tables.lobes
    if lobes is not None:
        lobes = replace(lobes, sun=lobes.sun[twice], weight=lobes.weight[twice], gain=lobes.gain[twice])
    return replace(
        tables, time_of_day=np.array([0.0, MIDNIGHT]), coefficients=tables.coefficients[twice],
        level=tables.level[twice], loss=tables.loss[twice], towards=tables.towards[twice], lobes=lobes,
    )  # fmt: skip


def _beside_slices() -> float:
    """Jump of the shade over a thousandth of a second at every slice and at both midnights."""
    normal, worst = directions(200), 0.0
    for time in small_world().tables.time_of_day:
        before, after = max(float(time) - 5e-4, 0.0), min(float(time) + 5e-4, MIDNIGHT)
        worst = max(worst, float(np.abs(shade(normal, time=after) - shade(normal, time=before)).max()))
    return worst


def _at_white_and_black() -> float:
    """Shade at reflectances 0 and 1, beyond those solved, less walls solved there, at the orientations solved."""
    world = small_world()
    plain = replace(SETTINGS, lobes=0.0, interpolation="barycentric", reflectances=(0.0, 1.0), degree=1)
    walls = world.assignment.wall_types[4:9:2]
    solved = bake_tables(world.environment, walls, ground=walls[0], settings=plain)
    fitted = bake_tables(world.environment, walls, ground=walls[0], settings=SETTINGS)
    normal, worst = solved.orientations.normal, 0.0
    for row, time, reflectance in product(range(len(walls)), solved.time_of_day, (0.0, 1.0)):
        asked = (normal, np.full(len(normal), row), np.full(len(normal), reflectance), float(time))
        worst = max(
            worst, float(np.abs(surface_temperature(fitted, *asked) - surface_temperature(solved, *asked)).max())
        )
    return worst


def _refit(points: FloatArray) -> float:
    """Polynomial through temperatures at close-lying reflectances, evaluated there in float32 coefficients."""
    values = 300.0 + 40.0 * np.cos(2.0 * np.outer(np.linspace(0.5, 1.0, 20), points) * (1.0 - points))
    coefficient = fit_polynomials(values, points, points.size - 1).astype(np.float32).astype(np.float64)
    worst = 0.0
    for column, point in enumerate(points):
        worst = max(
            worst, float(np.abs(evaluate_polynomial(coefficient, np.full(20, point)) - values[:, column]).max())
        )
    return worst


def rounding(kind: type[np.floating[Any]]) -> float:
    """The most that storing the coefficients in a floating-point type can cost a day's temperatures [K]."""
    coefficients = np.abs(small_world().tables.coefficients).astype(kind)
    half_steps = 0.5 * np.spacing(coefficients).astype(np.float64)
    powers = np.vander(np.linspace(0.0, 1.0, 21), half_steps.shape[-1], increasing=True)
    return float((half_steps @ powers.T).max())


def _texels(powers: int) -> float:
    """Coefficients read back from the texture's layout less those put in; every border texel included."""
    coefficients = np.random.default_rng(powers).uniform(-20.0, 20.0, (3, 7, powers)).astype(np.float32)
    texels = coefficient_texels(coefficients.astype(np.float64))
    groups = texels.shape[1] // 7
    back = texels.reshape(3, 7, groups * 4)
    return float(max(np.abs(back[:, :, :powers] - coefficients).max(), np.abs(back[:, :, powers:]).sum()))


def _lookup_ends() -> float:
    """A table at its entries, its ends and far beyond them, less the values there."""
    values = 300.0 + np.random.default_rng(2).normal(size=65)
    table = LookupTable(
        name="band_radiance", quantity="Radiance", argument="Kelvin", minimum=150.0, maximum=214.0, values=values
    )
    asked = np.concatenate([150.0 + np.arange(65.0), [-1e30, 149.999, 214.001, 1e30]])
    return float(np.abs(table.evaluate(asked) - np.concatenate([values, values[[0, 0, -1, -1]]])).max())


def _case(
    name: str, stresses: str, measured: str, bound: float, reason: str, measure: Callable[[], float], unit: str = "K"
) -> Case:
    return Case(
        name=name, group="tables", stresses=stresses, measured=measured, unit=unit, bound=bound, reason=reason,
        measure=measure,
    )  # fmt: skip


CASES = (
    _case(
        "midnight, the other midnight, and every slice",
        "the last slice has no next one",
        "shade less that of tables which hold this time alone",
        1e-9,
        "a time that was solved is not interpolated; sums of a hundred lobes round",
        _at_slices,
    ),
    _case(
        "a millisecond around every slice",
        "which two slices count changes there",
        "jump of the shade",
        1e-4,
        "30 K an hour over a millisecond is 1e-5 K; the rest is float32",
        _beside_slices,
    ),
    _case(
        "reflectance 0 and 1",
        "the polynomial is asked beyond the reflectances that were solved",
        "difference from walls solved there, all hours and orientations",
        0.3,
        "what the fit may cost at most",
        _at_white_and_black,
    ),
    *(
        _case(
            f"fit through {words}",
            f"powers of nearly equal numbers: condition number {np.linalg.cond(np.vander(points)):.0e}",
            "fitted polynomial in float32 less the temperatures that it goes through",
            5e-3,
            "what separates shader and NumPy at most",
            partial(_refit, points),
        )
        for words, points in (
            ("0.1 to 0.9", np.linspace(0.1, 0.9, 5)),
            ("0.6 to 0.9", np.linspace(0.6, 0.9, 5)),
            ("nine reflectances, degree 8", np.linspace(0.1, 0.9, 9)),
        )
    ),
    _case(
        "coefficients in float32",
        "powers of reflectance cancel each other",
        "the most that rounding can cost at any reflectance from 0 to 1",
        5e-3,
        "what separates shader and NumPy at most",
        partial(rounding, np.float32),
    ),
    *(
        _case(
            f"{powers} powers in texels of four",
            "the last group of the last orientation of the last wall type",
            "coefficients read back less those put in",
            0.0,
            "a layout moves numbers and rounds none",
            partial(_texels, powers),
        )
        for powers in (1, 4, 5, 9)
    ),
    _case(
        "lookup table at its ends and beyond",
        "an index of -1 or n",
        "difference from the end values",
        0.0,
        "beyond its ends a table holds them",
        _lookup_ends,
    ),
)
