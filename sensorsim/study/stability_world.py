"""The small world that the cases of the path to the pixel share: the hospital's coarsest level, baked coarsely."""

from datetime import date
from functools import cache

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment import read_weather
from sensorsim.render import World, build_world
from sensorsim.scene import load_scene
from sensorsim.tables import BakeSettings, surface_temperature

FloatArray = NDArray[np.float64]

NOON = 43200.0  # [s]
SETTINGS = BakeSettings(orientations="icosphere42", lead_in_days=1.0, step=600.0, slice_interval=1800.0)


@cache
def small_world() -> World:
    """The hospital at level IA on its winter day."""
    scene = load_scene("hospital", level="IA")
    return build_world(scene, read_weather("winter"), image_day=date(1976, 2, 7), settings=SETTINGS)


def directions(count: int, seed: int = 7) -> FloatArray:
    """Unit vectors all over the sphere (count, 3)."""
    vector = np.random.default_rng(seed).normal(size=(count, 3))
    return np.asarray(vector / np.linalg.norm(vector, axis=1, keepdims=True))


def shade(normal: FloatArray, *, row: int = 0, reflectance: float = 0.3, time: float = NOON) -> FloatArray:
    """Surface temperature (m,) [K] of one wall type at normals (m, 3)."""
    count = normal.shape[0]
    walls = np.full(count, row, dtype=np.int64)
    return surface_temperature(small_world().tables, normal, walls, np.full(count, reflectance), time)
