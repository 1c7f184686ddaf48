"""A small world that tests of tables and pictures share: a few walls, one winter day, baked once per session."""

import json
from datetime import date
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment import Environment, build_environment, read_weather
from sensorsim.materials import WallType, load_catalogue
from sensorsim.render import World, build_world
from sensorsim.scene import load_scene
from sensorsim.tables import BakeSettings, ShadeTables, bake_tables

FloatArray = NDArray[np.float64]

DAY = date(1976, 2, 7)
SETTINGS = BakeSettings(slice_interval=1800.0, lead_in_days=1.0)
PLAIN = BakeSettings(
    orientations="icosphere42", interpolation="barycentric", lobes=0.0, reflectances=(0.1, 0.3, 0.5, 0.7, 0.9),
    degree=4, knot=0.0, slice_interval=1800.0, lead_in_days=1.0, lead_in_stride=1,
)  # fmt: skip
LONGITUDE, LATITUDE = -84.02, 39.82


@cache
def environment() -> Environment:
    """The winter day after one day of lead-in, in steps of five minutes."""
    return build_environment(
        read_weather("winter"), image_day=DAY, lead_in_days=SETTINGS.lead_in_days, step=SETTINGS.step
    )


@cache
def wall_types() -> tuple[WallType, ...]:
    """Brick over a heated room, a metal shed, a flat roof and bare ground."""
    catalogue = load_catalogue()
    return tuple(
        catalogue.wall_type(code, interior)
        for code, interior in ((20, "heated"), (12, "unheated"), (67, "heated"), (93, "none"))
    )


@cache
def tables() -> ShadeTables:
    """All four walls baked, as the default has it but for slices and lead-in."""
    return bake_tables(environment(), wall_types(), ground=wall_types()[3], settings=SETTINGS)


@cache
def plain_tables() -> ShadeTables:
    """The same walls without lobes: straight lines between orientations, a quartic through five reflectances."""
    return bake_tables(environment(), wall_types(), ground=wall_types()[3], settings=PLAIN)


def random_normals(count: int, seed: int = 21) -> FloatArray:
    """Unit vectors all over the sphere (count, 3)."""
    vector = np.random.default_rng(seed).normal(size=(count, 3))
    return np.asarray(vector / np.linalg.norm(vector, axis=1, keepdims=True))


def box(east: float, north: float, width: float, depth: float) -> list[list[float]]:
    """Outline in degrees of a rectangle whose middle is `east`, `north` [m] of the origin; closed."""
    metres_per_degree = 111_320.0
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)]
    scale = metres_per_degree * np.cos(np.radians(LATITUDE))
    return [
        [LONGITUDE + (east + x * width / 2) / scale, LATITUDE + (north + y * depth / 2) / metres_per_degree]
        for x, y in corners
    ]


def feature(outline: list[list[float]], height: float, **properties: Any) -> dict[str, Any]:
    """A GeoJSON feature of one outline [deg] and a height [m]."""
    return {
        "type": "Feature",
        "properties": {"height": height, **properties},
        "geometry": {"type": "Polygon", "coordinates": [outline]},
    }


def write_town(folder: Path, features: list[dict[str, Any]], name: str = "town.geojson") -> Path:
    """A GeoJSON file of features."""
    path = folder / name
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    return path


def town_features() -> list[dict[str, Any]]:
    """Ground, two buildings, a tall metal mast and a low wall of another material."""
    return [
        feature(box(0.0, 0.0, 400.0, 400.0), 0.0, word="9420"),
        feature(box(-40.0, 0.0, 40.0, 30.0), 12.0, roof_word="6730", wall_word="2040", interior="heated"),
        feature(box(50.0, 30.0, 20.0, 60.0), 25.0, roof_word="6060", wall_word="1260", interior="unheated"),
        feature(box(10.0, -60.0, 3.0, 3.0), 40.0, word="0730", interior="open"),
        feature(box(-10.0, 80.0, 90.0, 2.0), 3.0, word="2005", interior="open"),
    ]


@cache
def town() -> World:
    """The town of `town_features` under the winter day."""
    with TemporaryDirectory() as folder:
        scene = load_scene(write_town(Path(folder), town_features()))
    return build_world(scene, read_weather("winter"), image_day=DAY, settings=SETTINGS)
