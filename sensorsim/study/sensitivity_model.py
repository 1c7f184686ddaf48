"""One wall under one day, everything that could be wrong about it, and its surface temperature by the march."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import date

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import SECONDS_PER_HOUR
from sensorsim.environment import Environment, Weather, build_environment
from sensorsim.materials import WallType
from sensorsim.thermal import build_interior, expose, ground_temperature, march_paths, surface_boundary
from sensorsim.thermal.lead_in import lead_in_of
from sensorsim.thermal.natural import melting_depth

FloatArray = NDArray[np.float64]

LEAD_IN = 2.0  # [day] after which brick has forgotten its start to 0.05 K; soil has not, and begins periodically


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Setup:
    """What decides a surface's temperature."""

    weather: Weather
    image_day: date
    environment: Environment
    ground: WallType  # the plane that walls see
    soil: FloatArray  # (t,) its temperature [K]
    wall: WallType
    reflectance: float  # [-] solar
    azimuth: float  # [deg]
    tilt: float  # [deg]
    film: float = 1.0  # times the film of convection
    evaporation: float = 1.0  # times the exchange of vapour
    room: float = 0.0  # [K] added to the air behind


Change = Callable[[Setup, float], Setup | None]  # by a standard uncertainty times a sign; None where that cannot be


@dataclass(frozen=True, slots=True, kw_only=True)
class Input:
    """An input with its standard uncertainty."""

    name: str
    amount: str
    source: str  # of the amount
    change: Change


@dataclass(frozen=True, slots=True, kw_only=True)
class Effect:
    """What one input is worth for one surface: larger of both signs, at each day and hour."""

    input: Input
    kelvin: FloatArray  # (d, h) [K], not negative

    @property
    def rms(self) -> float:
        """Over all days and hours [K]."""
        return float(np.sqrt(np.mean(self.kelvin**2)))

    @property
    def max(self) -> float:
        """Over all days and hours [K]."""
        return float(self.kelvin.max())


def build_setup(
    weather: Weather, image_day: date, *, ground: WallType, wall: WallType, reflectance: float, azimuth: float,
    tilt: float, step: float = 300.0,
) -> Setup:  # fmt: skip
    """A surface under a day of the weather."""
    environment = build_environment(weather, image_day=image_day, lead_in_days=LEAD_IN, step=step)
    return Setup(
        weather=weather, image_day=image_day, environment=environment, ground=ground,
        soil=_soil(environment, ground, tilt), wall=wall, reflectance=reflectance, azimuth=azimuth, tilt=tilt,
    )  # fmt: skip


def with_environment(setup: Setup, environment: Environment) -> Setup:
    """The same surface under another environment, its ground included."""
    return replace(setup, environment=environment, soil=_soil(environment, setup.ground, setup.tilt))


def _soil(environment: Environment, ground: WallType, tilt: float) -> FloatArray:
    """Temperature (t,) [K] of the ground before a surface; one that is level sees none, and is given the air's."""
    if tilt == 0.0:
        return environment.air_temperature
    return ground_temperature(environment, ground, repeated=lead_in_of(ground, environment, own=True).repeated)


def surface_history(setup: Setup) -> FloatArray:
    """Surface temperature (n,) [K] from midnight to midnight of the image day, at the environment's step.

    A wall that remembers more than the lead-in begins periodically, as in a bake.
    """
    environment, wall = setup.environment, setup.wall
    outside = surface_boundary(environment, expose(environment, normal_of(setup), setup.soil), wall)
    outside = outside._replace(
        film=setup.film * outside.film,
        free=setup.film**3 * outside.free,
        free_colder=setup.film**3 * outside.free_colder,
        latent=setup.evaporation * outside.latent,
    )
    air = environment.air_temperature
    inside = build_interior(
        wall.interior, air, environment.wind_speed, environment.step, wall.interior_emissivity, room=wall.room,
        heat_gain=wall.heat_gain,
    )  # fmt: skip
    inside = inside._replace(air=inside.air + setup.room, radiant=inside.radiant + setup.room)
    window = environment.image_window
    history = march_paths(
        wall, outside, inside, np.array([1.0 - setup.reflectance]), step=environment.step,
        record=np.arange(window.start, window.stop), melting_depth=melting_depth(wall),
        repeated=lead_in_of(wall, environment, own=True).repeated,
    )  # fmt: skip
    return np.asarray(history.exterior[:, 0, 0])


def normal_of(setup: Setup) -> FloatArray:
    """Unit normal (1, 3) of the surface."""
    azimuth, tilt = np.radians([setup.azimuth, setup.tilt])
    return np.array([[np.sin(tilt) * np.sin(azimuth), np.sin(tilt) * np.cos(azimuth), np.cos(tilt)]])


def at_hours(setup: Setup, history: FloatArray, hours: FloatArray) -> FloatArray:
    """Values (h,) of a history at hours of the day, linear between samples."""
    time = np.arange(history.size) * setup.environment.step / SECONDS_PER_HOUR
    return np.asarray(np.interp(hours, time, history))


def change_of(setup: Setup, change: Change, hours: FloatArray, plain: FloatArray) -> FloatArray:
    """What a change does to the temperature `plain` (h,) [K], the larger of both signs; 0 where neither can be."""
    sizes = [np.zeros(hours.size)]
    for sign in (1.0, -1.0):
        changed = change(setup, sign)
        if changed is not None:
            sizes.append(np.abs(at_hours(changed, surface_history(changed), hours) - plain))
    return np.asarray(np.max(sizes, axis=0))
