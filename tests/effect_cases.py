"""Weather, walls and scenes for tests of effects: one that calls for each effect, one that does not."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from datetime import date
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.effects import EVERYTHING, EffectPlan, Situation
from sensorsim.environment import Environment, Weather, build_environment, read_weather
from sensorsim.materials import Layer, WallType, load_catalogue
from sensorsim.tables import BakeSettings, bake_tables
from sensorsim.tables.coefficients import reflectance_powers
from sensorsim.tables.faces import ground_face, wall_face
from sensorsim.tables.orientations import orientation_set

FloatArray = NDArray[np.float64]
COARSE = BakeSettings(
    interpolation="barycentric",
    lobes=0.0,
    orientations="report10",
    reflectances=(0.1, 0.9),
    degree=1,
    step=1200.0,
    lead_in_stride=3,  # an hour
    slice_interval=3600.0,
    lead_in_days=1.0,
)
DAYS = {"winter": date(1976, 2, 7), "summer": date(1976, 9, 3), "fall": date(1976, 10, 7)}
Change = Callable[[Environment], Environment]


@cache
def environment(name: str = "winter") -> Environment:
    """A day that comes with the package, in coarse steps."""
    return build_environment(read_weather(name), image_day=DAYS[name], lead_in_days=1.0, step=COARSE.step)


@cache
def wall(code: int, interior: str = "heated") -> WallType:
    return load_catalogue().wall_type(code, interior)


BRICK, METAL, GRASS, LOAM, ASPHALT = (20, "heated"), (12, "unheated"), (94, "none"), (93, "none"), (81, "none")


def thick(base: WallType) -> WallType:
    """The wall made of eight metres of concrete."""
    layer = Layer(name="concrete", thickness=8.0, conductivity=1.4, density=2200.0, specific_heat=880.0)
    return replace(base, layers=(layer,), paths=())


def situation(
    weather: Environment, walls: tuple[WallType, ...], ground: WallType, settings: BakeSettings,
    normal: FloatArray | None = None,
) -> Situation:  # fmt: skip
    """The walls with all orientations of the settings, or those given."""
    normals = orientation_set(settings.orientations).normal if normal is None else normal
    darkest = 1.0 - min(settings.reflectances)
    faces = tuple(wall_face(weather, one, normals, darkest, settings) for one in walls)
    return Situation(environment=weather, faces=faces, ground=ground_face(weather, ground, settings))


def temperatures(
    weather: Environment, walls: tuple[WallType, ...], ground: WallType, settings: BakeSettings,
    plan: EffectPlan = EVERYTHING,
) -> FloatArray:  # fmt: skip
    """Temperature [K] of all walls, orientations and solved reflectances, and of the ground, as one row per slice."""
    tables = bake_tables(weather, walls, ground=ground, settings=settings, plan=plan)
    powers = reflectance_powers(np.asarray(settings.reflectances), settings.degree + 1, settings.knot)
    solved = tables.coefficients.astype(np.float64) @ powers.T + tables.level[:, :, None, None]
    return np.column_stack([solved.reshape(tables.time_of_day.size, -1), tables.ground_temperature])


def measured(
    name: str, weather: Environment, walls: tuple[WallType, ...], ground: WallType, settings: BakeSettings
) -> float:
    """Greatest change [K] that leaving one effect out makes."""
    whole = temperatures(weather, walls, ground, settings)
    return float(np.abs(temperatures(weather, walls, ground, settings, EVERYTHING.without(name)) - whole).max())


def quiet(**series: float) -> Change:
    """Series of the environment set to a constant; `sky_temperature` to that of the air."""

    def change(weather: Environment) -> Environment:
        arrays: Mapping[str, Any] = {
            key: np.full_like(getattr(weather, key), value) for key, value in series.items() if key != "sky_temperature"
        }
        if "sky_temperature" in series:
            arrays = {**arrays, "sky_temperature": weather.air_temperature.copy()}
        return replace(weather, **arrays)

    return change


def rainy(weather: Environment) -> Environment:
    """Five millimetres an hour in the afternoon, air above freezing, everything wet."""
    rain = np.where((weather.time % 86400.0) > 43200.0, 5.0, 0.0)
    state = np.full_like(weather.ground_state, "wet")
    return replace(weather, precipitation=rain, ground_state=state, air_temperature=weather.air_temperature + 8.0)


def snowy(weather: Environment) -> Environment:
    state, albedo = np.full(weather.time.size, "snow"), np.full(weather.time.size, 0.7)
    return replace(weather, ground_state=state, ground_albedo=albedo)


def random_weather(seed: int) -> Weather:
    """Three days of any weather: cold or hot, still or stormy, dry, raining or with snow on the ground."""
    rng, base = np.random.default_rng(seed), read_weather("winter")
    count = base.time.size
    wander = np.cumsum(rng.normal(0.0, 0.05, count))
    cold = rng.uniform(-20.0, 25.0)
    state = "snow" if cold < -5.0 else str(rng.choice(["dry", "wet"]))
    raining = rng.uniform() < 0.5 and state != "snow"
    return replace(
        base,
        name=f"random {seed}",
        air_temperature=base.air_temperature + cold + np.clip(wander, -5.0, 5.0),
        relative_humidity=np.clip(base.relative_humidity + rng.uniform(-0.3, 0.3), 0.1, 1.0),
        wind_speed=np.full(count, float(rng.choice([0.0, 0.3, 4.0, 15.0]))),
        wind_direction=np.full(count, rng.uniform(0.0, 360.0)),
        cloud_cover=np.full(count, float(rng.choice([0.0, 0.6, 1.0]))),
        precipitation=np.where(rng.uniform(size=count) < 0.4, 3.0, 0.0) * float(raining),
        ground_state=np.full(count, state),
    )
