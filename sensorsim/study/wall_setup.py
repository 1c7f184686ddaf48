"""Walls and boundary conditions made by hand, for studies and tests of the march."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.materials import Layer
from sensorsim.thermal import Inside, Outside, WallGrid

FloatArray = NDArray[np.float64]

DARK = np.zeros(1)  # absorptances of a wall that no sun reaches


def slab(thickness: float, conductivity: float, density: float, specific_heat: float, *, name: str = "slab") -> Layer:
    """A layer with heat capacity."""
    return Layer(
        name=name, thickness=thickness, conductivity=conductivity, density=density, specific_heat=specific_heat
    )


def gap(resistance: float) -> Layer:
    """A layer without heat capacity."""
    return Layer(name="gap", resistance=resistance)


STEEL = slab(0.0015, 45.28, 7824.0, 500.0, name="steel sheet")
COPPER = slab(0.0007, 386.0, 8890.0, 385.0, name="copper sheet")
BATTING = slab(0.09, 0.0458, 19.0, 960.0, name="batting")
BLOCK = slab(0.2, 1.11, 800.0, 920.0, name="block")
CONCRETE = slab(1.0, 1.95, 2240.0, 900.0, name="concrete")


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
