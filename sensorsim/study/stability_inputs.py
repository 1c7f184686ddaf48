"""NaN and infinity in every input: each has to be refused by name, never marched or drawn."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields, replace
from functools import partial
from typing import Any

import numpy as np

from sensorsim.errors import GraphicsError, InputError, SensorsimError
from sensorsim.render import Camera, World
from sensorsim.study.stability_march_laws import rough_weather
from sensorsim.study.stability_model import Case
from sensorsim.study.stability_pixel_frames import card, look
from sensorsim.study.stability_world import small_world
from sensorsim.study.wall_setup import BLOCK
from sensorsim.tables import BakeSettings
from sensorsim.thermal import Inside, Outside, build_wall_boundary, march, march_wall
from sensorsim.thermal.wall_boundary import WallBoundary

BAD = (float("nan"), float("inf"), float("-inf"))
Attempt = Callable[[], object]


def _passed(attempts: Iterator[Attempt], refusals: tuple[type[SensorsimError], ...]) -> float:
    """How many attempts went through instead of being refused."""
    through = 0
    for attempt in attempts:
        try:
            attempt()
        except refusals:
            continue
        through += 1
    return float(through)


def _march_inputs() -> Iterator[Attempt]:
    for value in BAD:
        for name in ("irradiance", "longwave", "film", "air", "free"):
            outside, inside = rough_weather(20, 1)
            array = getattr(outside, name).copy()
            array[min(10, len(array) - 1)] = value
            yield partial(_march_once, outside._replace(**{name: array}), inside)
        for name in ("air", "radiant", "film"):
            outside, inside = rough_weather(20, 1)
            array = getattr(inside, name).copy()
            array[10] = value
            yield partial(_march_once, outside, inside._replace(**{name: array}))


def _march_once(outside: Outside, inside: Inside) -> object:
    return march([BLOCK], outside, inside, np.ones(1), step=60.0, record=np.array([19]))


def _wall_boundary(hours: np.ndarray) -> WallBoundary:
    return build_wall_boundary(
        hours, air_temperature=280.0, exterior_film=15.0, interior_air_temperature=290.0, interior_film=8.0
    )


def _wall_inputs() -> Iterator[Attempt]:
    plain = _wall_boundary(3600.0 * np.arange(30.0))
    given: dict[str, Any] = {
        "absorptance": 0.7,
        "emissivity": 0.9,
        "interior_emissivity": 0.9,
        "sky_view": 0.5,
        "step": 600.0,
    }
    for value in BAD:
        for field in fields(plain):
            array = getattr(plain, field.name).copy()
            array[7] = value
            yield partial(march_wall, [BLOCK], replace(plain, **{field.name: array}), **given)
        for name in given:
            yield partial(march_wall, [BLOCK], plain, **{**given, name: value})
        for name in ("thickness", "conductivity", "density", "specific_heat"):
            changed: dict[str, Any] = {name: value}
            yield partial(march_wall, [replace(BLOCK, **changed)], plain, **given)


def _settings_inputs() -> Iterator[Attempt]:
    for value in BAD:
        for name in ("step", "slice_interval", "lead_in_days"):
            yield partial(BakeSettings, **{name: value})  # type: ignore[arg-type]
        yield partial(BakeSettings, reflectances=(0.1, 0.5, value))
        yield partial(BakeSettings, degree=value)  # type: ignore[arg-type]


def _moments() -> Iterator[Attempt]:
    world = small_world()
    for value in (*BAD, -1e-6, 86400.01):
        yield partial(world.tables.at, value)
        yield partial(world.environment.at, value)


def _camera_inputs() -> Iterator[Attempt]:
    plain: dict[str, Any] = {
        "position": np.zeros(3),
        "yaw": 0.0,
        "pitch": 0.0,
        "roll": 0.0,
        "horizontal_field_of_view": 30.0,
    }
    for value in BAD:
        for name in plain:
            bad = np.array([0.0, value, 0.0]) if name == "position" else value
            yield partial(Camera, **{**plain, name: bad})


def _table_inputs() -> Iterator[Attempt]:
    world = small_world()
    for value in BAD:
        coefficients = world.tables.coefficients.copy()
        coefficients[:, -1, -1, -1] = value
        bad = replace(world, tables=replace(world.tables, coefficients=coefficients))
        yield partial(_look_quietly, bad)


def _look_quietly(bad: World) -> None:
    """A frame of a world; arithmetic with what is not finite says nothing until it is refused."""
    with np.errstate(invalid="ignore"):
        look(bad, card([(0.0, 0.0, 10.0, 100.0, 0)]))


def _case(name: str, attempts: Callable[[], Iterator[Attempt]], refusals: Sequence[type[SensorsimError]]) -> Case:
    kinds = " or ".join(kind.__name__ for kind in refusals)
    return Case(
        name=name, group="inputs", stresses="NaN, infinity and its negative in every entry, one at a time",
        measured="entries that are let through", unit="-", bound=0.0, reason=f"refused as {kinds}, never drawn",
        measure=lambda: _passed(attempts(), tuple(refusals)),
    )  # fmt: skip


CASES = (
    _case("boundary values of a march", _march_inputs, (SensorsimError,)),
    _case("boundary series, faces and layers of a wall", _wall_inputs, (InputError,)),
    _case("settings of a bake", _settings_inputs, (InputError,)),
    _case("time of the day", _moments, (InputError,)),
    _case("place and attitude of a camera", _camera_inputs, (InputError,)),
    _case("last coefficient of the tables", _table_inputs, (GraphicsError,)),
)
