"""Walls, boundary conditions and exact answers that the tests of conduction share."""

import csv
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.materials import Layer
from sensorsim.thermal import Inside, Outside, WallGrid

FloatArray = NDArray[np.float64]

DATA = Path(__file__).parent / "data"
WALLS = ("wood_uninsulated", "wood_insulated", "brick", "steel_sheet", "concrete_block", "roof_builtup")
DARK = np.zeros(1)  # absorptances of a wall that no sun reaches


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


def slab(thickness: float, conductivity: float, density: float, specific_heat: float, *, name: str = "slab") -> Layer:
    """A layer with heat capacity."""
    return Layer(
        name=name, thickness=thickness, conductivity=conductivity, density=density, specific_heat=specific_heat
    )


def gap(resistance: float) -> Layer:
    """A layer without heat capacity."""
    return Layer(name="gap", resistance=resistance)


def uniform_grid(layers: Sequence[Layer], cells: Sequence[int]) -> WallGrid:
    """Equal cells in each layer, as a grid that does not come from the code under test."""
    capacity: list[float] = []
    resistance = [0.0]
    depth: list[float] = []
    position = 0.0
    for layer, count in zip(layers, cells, strict=True):
        if layer.resistance is not None:
            resistance[-1] += layer.resistance
            continue
        thickness = layer.thickness / count
        half = 0.5 * thickness / layer.conductivity
        for _ in range(count):
            resistance[-1] += half
            resistance.append(half)
            capacity.append(thickness * layer.density * layer.specific_heat)
            depth.append(position + 0.5 * thickness)
            position += thickness
    return WallGrid(capacity=np.array(capacity), conductance=1.0 / np.array(resistance), depth=np.array(depth))


def outdoors(
    air: FloatArray,
    film: float | FloatArray,
    *,
    sun: float | FloatArray = 0.0,
    sky: float | FloatArray = 0.0,
    emissivity: float = 0.0,
    free: float = 0.0,
) -> Outside:
    """Exterior boundary of one orientation: air (t,) [K], film [W m-2 K-1], sun [W m-2], sky temperature [K]."""

    def column(values: float | FloatArray) -> FloatArray:
        return np.array(np.broadcast_to(values, air.shape)[:, None], dtype=np.float64, order="C")

    return Outside(
        irradiance=column(sun),
        longwave=column(SIGMA * np.asarray(sky, dtype=np.float64) ** 4),
        film=column(film),
        free=np.array([free]),
        air=air,
        emissivity=emissivity,
    )


def indoors(
    air: FloatArray, film: float | FloatArray, *, radiant: FloatArray | None = None, emissivity: float = 0.0
) -> Inside:
    """Interior boundary: air (t,) [K], film [W m-2 K-1], radiant temperature (t,) [K]."""
    return Inside(
        air=air,
        radiant=air if radiant is None else radiant,
        film=np.array(np.broadcast_to(film, air.shape), dtype=np.float64, order="C"),
        free=0.0,
        emissivity=emissivity,
    )


def constant(value: float, count: int) -> FloatArray:
    """`count` equal samples."""
    return np.full(count, value)
