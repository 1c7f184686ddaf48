"""The inputs of a surface temperature, each with the standard uncertainty that a user has to reckon with.

Amounts come from the spread of measured samples of one class where that is known, else they are estimates and say so.
"""

from dataclasses import replace

import numpy as np

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.environment import build_environment
from sensorsim.materials import Layer
from sensorsim.study.sensitivity_model import LEAD_IN, Input, Setup, with_environment

ABSORPTANCE, EMISSIVITY, CONDUCTIVITY, CAPACITY = 0.1, 0.03, 0.2, 0.2
FILM, EVAPORATION, CLOUD, BEAM, DIFFUSE, SKY = 0.25, 0.5, 0.2, 0.1, 0.25, 20.0
AIR, ROOM, TURN = 1.0, 2.0, 5.0


def _reflectance(setup: Setup, sign: float) -> Setup | None:
    value = setup.reflectance - sign * ABSORPTANCE
    return replace(setup, reflectance=value) if 0.0 <= value <= 1.0 else None


def _emissivity(setup: Setup, sign: float) -> Setup | None:
    value = setup.wall.emissivity + sign * EMISSIVITY
    return replace(setup, wall=replace(setup.wall, emissivity=value)) if 0.0 <= value <= 1.0 else None


def _layers(setup: Setup, conductivity: float, capacity: float) -> Setup:
    """All layers with other conductivities and heat capacities, by factors."""

    def changed(layer: Layer) -> Layer:
        if layer.resistance is not None:
            return replace(layer, resistance=layer.resistance / conductivity)
        return replace(
            layer, conductivity=conductivity * layer.conductivity, specific_heat=capacity * layer.specific_heat
        )

    wall = setup.wall
    paths = tuple(replace(path, layers=tuple(map(changed, path.layers))) for path in wall.paths)
    return replace(setup, wall=replace(wall, layers=tuple(map(changed, wall.layers)), paths=paths))


def _conductivity(setup: Setup, sign: float) -> Setup:
    return _layers(setup, 1.0 + sign * CONDUCTIVITY, 1.0)


def _capacity(setup: Setup, sign: float) -> Setup:
    return _layers(setup, 1.0, 1.0 + sign * CAPACITY)


def _film(setup: Setup, sign: float) -> Setup:
    return replace(setup, film=1.0 + sign * FILM)


def _evaporation(setup: Setup, sign: float) -> Setup | None:
    """Of grounds and plants; walls and roofs are dry but for rain."""
    if setup.wall.cover is None:
        return None
    return replace(setup, evaporation=1.0 + sign * EVAPORATION)


def _room(setup: Setup, sign: float) -> Setup:
    return replace(setup, room=sign * ROOM)


def _orientation(setup: Setup, sign: float) -> Setup:
    if setup.tilt == 0.0:
        return replace(setup, tilt=TURN, azimuth=90.0 + sign * 90.0)
    return replace(setup, azimuth=setup.azimuth + sign * TURN)


def _beam(setup: Setup, sign: float) -> Setup:
    beam = setup.environment.beam_irradiance * (1.0 + sign * BEAM)
    return with_environment(setup, replace(setup.environment, beam_irradiance=beam))


def _diffuse(setup: Setup, sign: float) -> Setup:
    environment, factor = setup.environment, 1.0 + sign * DIFFUSE
    changed = replace(
        environment,
        diffuse_irradiance=factor * environment.diffuse_irradiance,
        quadrant_irradiance=factor * environment.quadrant_irradiance,
    )
    return with_environment(setup, changed)


def _air(setup: Setup, sign: float) -> Setup:
    air = setup.environment.air_temperature + sign * AIR
    return with_environment(setup, replace(setup.environment, air_temperature=air))


def _sky(setup: Setup, sign: float) -> Setup:
    received = STEFAN_BOLTZMANN_CONSTANT * setup.environment.sky_temperature**4 + sign * SKY
    temperature = (received / STEFAN_BOLTZMANN_CONSTANT) ** 0.25
    return with_environment(setup, replace(setup.environment, sky_temperature=temperature))


def _cloud(setup: Setup, sign: float) -> Setup | None:
    """Cover changed where it may be: an overcast sky gets no more of it, nor a clear one less."""
    cover = np.clip(setup.weather.cloud_cover + sign * CLOUD, 0.0, 1.0)
    if np.array_equal(cover, setup.weather.cloud_cover):
        return None
    environment = build_environment(
        replace(setup.weather, cloud_cover=cover), image_day=setup.image_day, lead_in_days=LEAD_IN,
        step=setup.environment.step,
    )  # fmt: skip
    return with_environment(setup, environment)


CLASS = "spread of measured samples of one class, 0.05 to 0.15 [Meerdink2019]"
INPUTS: tuple[Input, ...] = (
    Input(name="solar absorptance", amount="0.1", source=CLASS, change=_reflectance),
    Input(name="emissivity", amount="0.03", source="estimate, of non-metals; of metals more", change=_emissivity),
    Input(name="conductivity", amount="20 %", source="estimate: moisture and make", change=_conductivity),
    Input(name="heat capacity", amount="20 %", source="estimate: moisture and make", change=_capacity),
    Input(name="wind and film", amount="25 %", source="estimate: correlations differ by as much", change=_film),
    Input(name="evaporation", amount="50 %", source="estimate: moisture of soil and leaves", change=_evaporation),
    Input(name="cloud cover", amount="0.2", source="estimate: observed in tenths, one sky for all", change=_cloud),
    Input(name="beam", amount="10 %", source="estimate: turbidity of the day", change=_beam),
    Input(name="diffuse light", amount="25 %", source="estimate: sky model and horizon", change=_diffuse),
    Input(name="sky radiation", amount="20 W m-2", source="estimate: 5 K of sky temperature", change=_sky),
    Input(name="air temperature", amount="1 K", source="estimate: station to site", change=_air),
    Input(name="interior", amount="2 K", source="estimate: rooms, deep soil", change=_room),
    Input(name="orientation", amount="5 deg", source="estimate: outlines from maps", change=_orientation),
)
