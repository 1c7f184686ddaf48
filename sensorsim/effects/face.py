"""What a scene shows of one wall type, as the few numbers that bounds are made of."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import PI, STEFAN_BOLTZMANN_CONSTANT, ZERO_CELSIUS
from sensorsim.environment import Environment, saturation_vapour_pressure
from sensorsim.materials import Layer

FloatArray = NDArray[np.float64]

LEAST_RESISTANCE = 1e-6  # [m2 K W-1] stands in where layers have none
NEWTON_STEPS = 12  # of a smooth balance: each doubles the digits


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Face:
    """One plain wall type with the orientations that are solved of it; films are the greatest of the whole history."""

    name: str
    normal: FloatArray  # (m, 3) unit
    absorptance: float  # greatest [-] solar
    light: float  # greatest solar irradiance, also of some of its terms alone [W m-2]
    emissivity: float  # [-] long-wave
    forced: float  # forced film without rain [W m-2 K-1]
    least_film: float  # least of it [W m-2 K-1]
    free: float  # free film cubed per kelvin [W3 m-6 K-4]
    rain: float  # film by which rain exchanges heat [W m-2 K-1]
    latent: float  # vapour exchange [W m-2 Pa-1]
    latent_by_light: bool  # whether that depends on the sunlight that comes in
    snow: bool
    traffic: float  # heat from vehicles [W m-2]
    skin: float  # resistance of a skin of still water [m2 K W-1]
    memory: float  # how long ago its history began [s]; infinite where it begins periodically
    indoors: tuple[float, float]  # least and greatest air and radiant temperature behind [K]
    paths: tuple[Sequence[Layer], ...]  # layers exterior to interior


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Limits:
    """Temperatures [K] that no surface leaves, whatever is left out: by the maximum principle.

    A surface colder than all of air, sky, ground, room and dew point gains heat from each of them and so cannot be.
    One warmer than all, air films only cool: it is at most where emission alone balances sun and sky. Where the wind's
    film is kept, its least value holds a surface closer to the air from both sides.
    """

    coldest: float
    warmest: tuple[float, ...]  # of each face
    ground: float  # greatest of the ground plane

    @property
    def greatest(self) -> float:
        """Over all faces and the ground."""
        return max(*self.warmest, self.ground) if self.warmest else self.ground


def temperature_limits(
    environment: Environment, faces: Sequence[Face], ground: Face, *, film_kept: bool = False
) -> Limits:
    """Limits of the faces and of the ground plane; with `film_kept` as long as the wind's film is not left out."""
    air, sky = environment.air_temperature, environment.sky_temperature
    dew, rooms = float(dew_point(environment).min()), [face.indoors for face in (*faces, ground)]
    hottest, lowest = max(float(air.max()), float(sky.max())), min(dew, *(low for low, _ in rooms))
    coolest = min(float(air.min()), float(sky.min()), lowest)

    def balance(face: Face, surroundings: float, temperature: float, heat: float) -> float:
        film = face.least_film if film_kept else 0.0
        return _balance(face.emissivity, film, radiating=surroundings, air=temperature, heat=heat)

    coldest = min(lowest, *(balance(face, coolest, float(air.min()), 0.0) for face in (*faces, ground)))
    light, warm = [face.absorptance * face.light + face.traffic for face in (ground, *faces)], float(air.max())
    soil = max(hottest, ground.indoors[1], balance(ground, hottest, warm, light[0]))
    warmest = tuple(
        max(soil, face.indoors[1], balance(face, soil, warm, heat)) for face, heat in zip(faces, light[1:], strict=True)
    )
    return Limits(coldest=coldest, warmest=warmest, ground=soil)


def _balance(emissivity: float, film: float, *, radiating: float, air: float, heat: float) -> float:
    """Temperature [K] at which emission and a film to the `air` balance `heat` and what radiates from around [K].

    By Newton's method, from where emission alone does, or the air if that is warmer: the balance is convex, and so
    each step comes closer from above.
    """
    grey = emissivity * STEFAN_BOLTZMANN_CONSTANT
    temperature = max((radiating**4 + heat / grey) ** 0.25, air)
    for _ in range(NEWTON_STEPS if film > 0.0 else 0):
        over = grey * (temperature**4 - radiating**4) + film * (temperature - air) - heat
        temperature -= over / (4.0 * grey * temperature**3 + film)
    return float(temperature)


def dew_point(environment: Environment) -> FloatArray:
    """Temperature (t,) [K] below which water comes down; the inverse of the Magnus form of [Alduchov1996]."""
    at_freezing = float(saturation_vapour_pressure(np.array(ZERO_CELSIUS)))
    ratio = np.log(np.maximum(environment.vapour_pressure, 1.0) / at_freezing)
    return np.asarray(ZERO_CELSIUS + 243.04 * ratio / (17.625 - ratio))


def slope(emissivity: float, temperature: float) -> float:
    """Growth of a surface's emission with its temperature [W m-2 K-1]."""
    return 4.0 * emissivity * STEFAN_BOLTZMANN_CONSTANT * temperature**3


def interior_share(face: Face, least_slope: float) -> float:
    """How much of a change of the inner face can reach the outer one within its memory [-], at most.

    In the steady state the wall's conductance U and the least slope s share it, U / (U + s), and no response to a
    change runs past that. Before, heat has to get through: of a layer of thickness l and diffusivity a with a face that
    no heat passes, 2 erfc(l / sqrt(4 a t)) bounds the response, and what lies outside of the layer follows it.
    """
    shares = []
    for layers in face.paths:
        resistance = max(sum(layer.thermal_resistance for layer in layers), LEAST_RESISTANCE)
        steady = 1.0 / (1.0 + resistance * least_slope)
        depth = max((_depth(layer, face.memory) for layer in layers), default=0.0)
        shares.append(min(steady, 2.0 * _erfc_bound(depth)))
    return max(shares, default=1.0)


def _depth(layer: Layer, duration: float) -> float:
    """Thickness of a layer over sqrt(4 a t) [-]; 0 without heat capacity."""
    if layer.areal_heat_capacity == 0.0:
        return 0.0
    diffusivity = layer.conductivity / (layer.density * layer.specific_heat)
    return float(layer.thickness / np.sqrt(4.0 * diffusivity * duration))


def _erfc_bound(x: float) -> float:
    """Upper bound of erfc(x), exp(-x^2) at most."""
    return float(np.exp(-x * x) / max(1.0, x * np.sqrt(PI)))
