"""Exact solutions of conduction under true fourth-power boundaries, and the errors of the march against them.

The march has no source within the wall, so a solution is made through its boundaries. Inside, temperatures are sums of
waves exp(i w t) that obey the heat equation in every layer and keep temperature and flux continuous where layers meet;
the sunlight that the exterior face needs for its balance with air, sky and its own fourth power follows in closed
form; the room's air is steady. What is left is the error of cells and steps.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT as SIGMA
from sensorsim.materials import Layer
from sensorsim.study.wall_setup import FloatArray, indoors, outdoors, slab, uniform_grid
from sensorsim.thermal import WallGrid, march

MEAN, DRIFT = 300.0, -15.0  # [K] at the exterior face, [W m-2] steady flux into the wall
WAVES = ((86400.0, 12.0), (21600.0, 4.0), (7200.0, 1.5))  # period [s] and amplitude at the exterior face [K]
FILM, INNER_FILM, EMISSIVITY, SKY = 15.0, 6.0, 0.9, 200.0
ONE_LAYER = (slab(0.12, 1.0, 1800.0, 900.0),)
TWO_LAYERS = (slab(0.05, 0.9, 1700.0, 900.0), slab(0.06, 0.15, 600.0, 1500.0))
SPAN = 43200.0  # [s] that is marched
CELLS, STEPS = (6, 12, 24, 48), (900.0, 450.0, 225.0, 112.5, 56.25, 28.125)


@dataclass(frozen=True, slots=True, kw_only=True)
class Wave:
    """Temperature and downward flux of one complex wave at a depth, relative to time zero."""

    angular: float  # [s-1]
    temperature: complex  # [K]
    flux: complex  # [W m-2]

    def through(self, layer: Layer, thickness: float) -> "Wave":
        """The wave `thickness` [m] deeper in a layer."""
        root = np.sqrt(1j * self.angular * layer.density * layer.specific_heat / layer.conductivity)
        slope = layer.conductivity * root
        cosine, sine = np.cosh(root * thickness), np.sinh(root * thickness)
        return Wave(
            angular=self.angular,
            temperature=complex(cosine * self.temperature - sine / slope * self.flux),
            flux=complex(cosine * self.flux - slope * sine * self.temperature),
        )


def surface_waves(layers: Sequence[Layer]) -> tuple[Wave, ...]:
    """Waves at the exterior face that leave through the interior film into a room that does not swing."""
    waves = []
    for period, amplitude in WAVES:
        wave = Wave(angular=2.0 * np.pi / period, temperature=1.0, flux=INNER_FILM)
        for layer in reversed(layers):
            wave = wave.through(layer, -layer.thickness)
        scale = amplitude / wave.temperature
        waves.append(Wave(angular=wave.angular, temperature=amplitude, flux=scale * wave.flux))
    return tuple(waves)


def at_depth(layers: Sequence[Layer], depth: float) -> tuple[tuple[Wave, ...], float]:
    """Waves and steady temperature [K] at a depth [m]."""
    waves, steady = surface_waves(layers), MEAN
    for layer in layers:
        part = min(layer.thickness, depth)
        waves = tuple(wave.through(layer, part) for wave in waves)
        steady -= DRIFT * part / layer.conductivity
        depth -= part
    return waves, steady


def temperature_at(layers: Sequence[Layer], depth: float, time: FloatArray) -> FloatArray:
    """Exact temperature (t,) [K]."""
    waves, steady = at_depth(layers, depth)
    return np.asarray(steady + sum((wave.temperature * np.exp(1j * wave.angular * time)).real for wave in waves))


def flux_at(layers: Sequence[Layer], depth: float, time: FloatArray) -> FloatArray:
    """Exact flux into the depth (t,) [W m-2]."""
    waves, _ = at_depth(layers, depth)
    return np.asarray(DRIFT + sum((wave.flux * np.exp(1j * wave.angular * time)).real for wave in waves))


def outdoor_air(time: FloatArray) -> FloatArray:
    """Air [K] before the exterior face."""
    return np.asarray(290.0 + 5.0 * np.sin(2.0 * np.pi * time / 43200.0))


def absorbed_sunlight(layers: Sequence[Layer], time: FloatArray) -> FloatArray:
    """Sunlight (t,) [W m-2] that closes the balance of the exterior face."""
    face = temperature_at(layers, 0.0, time)
    lost = FILM * (face - outdoor_air(time)) + EMISSIVITY * SIGMA * (face**4 - SKY**4)
    return np.asarray(flux_at(layers, 0.0, time) + lost)


def march_error(layers: Sequence[Layer], grid: WallGrid, step: float) -> float:
    """Rms difference [K] of both faces from the exact solution over the hours of the span."""
    time = np.arange(round(SPAN / step) + 1, dtype=np.float64) * step
    thickness = sum(layer.thickness for layer in layers)
    face, back = temperature_at(layers, 0.0, time), temperature_at(layers, thickness, time)
    air = outdoor_air(time)
    room = back - flux_at(layers, thickness, time) / INNER_FILM
    every = np.arange(0, time.size, round(3600.0 / step))[1:]
    start = np.array([temperature_at(layers, float(depth), time[:1])[0] for depth in grid.depth])
    sun = absorbed_sunlight(layers, time)
    history = march(
        layers, outdoors(air, FILM, sun=sun, sky=SKY, emissivity=EMISSIVITY), indoors(room, INNER_FILM), np.ones(1),
        step=step, record=every, grid=grid, start=start,
    )  # fmt: skip
    misses = np.stack([history.exterior[:, 0, 0] - face[every], history.interior[:, 0, 0] - back[every]])
    return float(np.sqrt(np.mean(misses**2)))


def errors_in_space(layers: Sequence[Layer], cells: Sequence[int] = CELLS, step: float = 15.0) -> FloatArray:
    """Errors [K] for numbers of cells in each layer, at a step that adds nothing."""
    return np.array([march_error(layers, uniform_grid(layers, [count] * len(layers)), step) for count in cells])


def errors_in_time(layers: Sequence[Layer], steps: Sequence[float] = STEPS, cells: int = 400) -> FloatArray:
    """Errors [K] for steps [s], with cells that add nothing."""
    grid = uniform_grid(layers, [cells] * len(layers))
    return np.array([march_error(layers, grid, step) for step in steps])


def order(sizes: Sequence[float], errors: FloatArray) -> float:
    """Order of convergence: slope of the logarithm of errors over that of cell or step, by least squares."""
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])
