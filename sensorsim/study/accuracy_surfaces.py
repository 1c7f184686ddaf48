"""Surfaces whose fit is measured: a scene's own, or the catalogue's wall types at random normals and reflectances."""

from dataclasses import dataclass

import numpy as np

from sensorsim.materials import Catalogue, WallType
from sensorsim.materials.material import OUTDOOR_GROUPS
from sensorsim.tables.assign import Assignment
from sensorsim.tables.full_solve import SurfaceSet, distinct_surfaces
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.thermal import Season

SEED = 1978
NORMALS = 16  # of each of the catalogue's wall types
POINTS = (
    *("N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE"),
    *("S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"),
)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sample:
    """Surfaces to measure, and how many distinct ones they were drawn from."""

    surfaces: SurfaceSet
    whole: int
    row_of: IntArray  # (s,) row of each surface of the scene among `surfaces`, -1 where it was not drawn


def scene_sample(normal: FloatArray, assignment: Assignment, limit: int) -> Sample:
    """Distinct surfaces of a scene with normals (s, 3), `limit` of them drawn at random where there are more."""
    found = distinct_surfaces(normal, assignment)
    whole = found.surfaces.reflectance.size
    drawn = np.arange(whole)
    if whole > limit:
        drawn = np.sort(np.random.default_rng(SEED).choice(whole, limit, replace=False))
    place = np.full(whole, -1)
    place[drawn] = np.arange(drawn.size)
    surfaces = SurfaceSet(
        wall_types=assignment.wall_types,
        wall_type=found.surfaces.wall_type[drawn],
        normal=found.surfaces.normal[drawn],
        reflectance=found.surfaces.reflectance[drawn],
    )
    return Sample(surfaces=surfaces, whole=whole, row_of=place[found.row_of])


def catalogue_sample(catalogue: Catalogue, season: Season, seed: int = SEED) -> Sample:
    """Every material, buildings heated, at a random reflectance and NORMALS random normals."""
    walls = tuple(_wall_type(catalogue, code, season) for code in catalogue.materials)
    random, count = np.random.default_rng(seed), len(walls) * NORMALS
    normal = random.normal(size=(count, 3))
    surfaces = SurfaceSet(
        wall_types=walls,
        wall_type=np.repeat(np.arange(len(walls)), NORMALS),
        normal=normal / np.linalg.norm(normal, axis=1, keepdims=True),
        reflectance=np.repeat(random.uniform(0.0, 1.0, len(walls)), NORMALS),
    )
    return Sample(surfaces=surfaces, whole=count, row_of=np.zeros(0, dtype=np.int64))


def facing(normal: FloatArray) -> str:
    """A normal (3,) in words: 'wall facing SSE', 'slope facing N', 'level, facing up'."""
    tilt = float(np.degrees(np.arccos(np.clip(normal[2], -1.0, 1.0))))
    if tilt < 5.0:
        return "level, facing up"
    if tilt > 175.0:
        return "level, facing down"
    azimuth = float(np.degrees(np.arctan2(normal[0], normal[1])) % 360.0)
    kind = "wall" if 75.0 <= tilt <= 105.0 else "slope" if tilt < 90.0 else "overhang"
    return f"{kind} facing {POINTS[round(azimuth / 22.5) % 16]}"


def _wall_type(catalogue: Catalogue, code: int, season: Season) -> WallType:
    behind = "none" if catalogue.material(code).group in OUTDOOR_GROUPS else "heated"
    return catalogue.wall_type(code, behind, leafless=season.leafless)
