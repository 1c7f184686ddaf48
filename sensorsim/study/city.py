"""A city of any size, the same for the same seed, as a GeoJSON file that goes the way of any scene.

Blocks of rectangular buildings on a street grid over one ground; walls, roofs, heights and interiors by chance.
"""

import json
import math
from pathlib import Path

import numpy as np

from sensorsim.errors import InputError

LONGITUDE, LATITUDE = -84.02, 39.82
METRES_PER_DEGREE = 111_320.0
PITCH = 30.0  # [m] from building to building
STREET = 12.0  # [m] between buildings at least
ROOFS = ("6730", "6060", "6750")
WALLS = ("2040", "1260", "2030")
INTERIORS = ("heated", "unheated", "cooled")


def write_city(path: Path, buildings: int, *, seed: int = 1976) -> float:
    """Write a city of so many buildings; returns the length of its side [m]. InputError for fewer than one."""
    if buildings < 1:
        raise InputError("city", "buildings", buildings, "no building", "give 1 or more")
    rng = np.random.default_rng(seed)
    across = math.ceil(math.sqrt(buildings))
    side = across * PITCH
    place = np.arange(buildings)
    middle = (np.stack([place % across, place // across], axis=1) + 0.5) * PITCH - 0.5 * side
    extent = rng.uniform(0.4, 1.0, (buildings, 2)) * (PITCH - STREET)
    height = np.round(4.0 + rng.gamma(2.0, 5.0, buildings), 1)
    kind = rng.integers(0, 3, (buildings, 3))
    corner = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5]])
    outline = _degrees(middle[:, None, :] + corner * extent[:, None, :])
    ground = _degrees(corner * (side + 200.0))
    features = [_feature(ground, 0.0, {"word": "9420"})]
    features += [
        _feature(
            outline[row], float(height[row]),
            {"roof_word": ROOFS[a], "wall_word": WALLS[b], "interior": INTERIORS[c]},
        )
        for row, (a, b, c) in enumerate(kind.tolist())
    ]  # fmt: skip
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}), encoding="utf-8")
    return side


def _degrees(metres: np.ndarray) -> np.ndarray:
    scale = np.array([METRES_PER_DEGREE * math.cos(math.radians(LATITUDE)), METRES_PER_DEGREE])
    return np.asarray(np.array([LONGITUDE, LATITUDE]) + metres / scale)


def _feature(outline: np.ndarray, height: float, properties: dict[str, str]) -> dict[str, object]:
    return {
        "type": "Feature",
        "properties": {"height": height, **properties},
        "geometry": {"type": "Polygon", "coordinates": [outline.tolist()]},
    }
