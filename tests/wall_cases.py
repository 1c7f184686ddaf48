"""Walls, boundary conditions and exact answers that the tests of conduction share."""

import csv
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.materials import Layer
from sensorsim.study.wall_setup import DARK, constant, gap, indoors, outdoors, slab, uniform_grid

__all__ = [
    "DARK",
    "SIGMA",
    "WALLS",
    "FloatArray",
    "constant",
    "exact_case",
    "exact_values",
    "gap",
    "indoors",
    "outdoors",
    "reference_walls",
    "slab",
    "uniform_grid",
]

FloatArray = NDArray[np.float64]

DATA = Path(__file__).parent / "data"
WALLS = ("wood_uninsulated", "wood_insulated", "brick", "steel_sheet", "concrete_block", "roof_builtup")


@cache
def reference_walls() -> dict[str, tuple[Layer, ...]]:
    """The six walls of the EnergyPlus set, exterior to interior."""
    walls: dict[str, tuple[Layer, ...]] = {}
    with (DATA / "energyplus" / "layers.csv").open(newline="") as file:
        for row in csv.DictReader(file):
            name = row["name"]
            layer = (
                Layer(name=name, resistance=float(row["R_m2K_W"]))
                if row["kind"] == "resistance"
                else slab(*(float(row[key]) for key in ("thickness_m", "k_W_mK", "rho_kg_m3", "cp_J_kgK")), name=name)
            )
            walls[row["wall"]] = (*walls.get(row["wall"], ()), layer)
    return walls


@cache
def exact_values() -> dict[tuple[str, str, str], float]:
    """Rows of conduction_exact.csv: (case, parameters, quantity) to value."""
    with (DATA / "conduction_exact.csv").open(newline="") as file:
        return {(row["case"], row["parameters"], row["quantity"]): float(row["value"]) for row in csv.DictReader(file)}


def exact_case(case: str) -> list[tuple[str, str, float]]:
    """Parameters, quantity and value of every row of a case."""
    rows = [(key[1], key[2], value) for key, value in exact_values().items() if key[0] == case]
    assert rows, case
    return rows
