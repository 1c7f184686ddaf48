"""From the words of a scene to rows of the tables: wall type, solar and near-infrared reflectance, emissivity."""

from dataclasses import dataclass

import numpy as np

from sensorsim.errors import InputError
from sensorsim.materials import Catalogue, MaterialWord, WallType, nir_reflectance
from sensorsim.scene import Scene
from sensorsim.tables.orientations import FloatArray, IntArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Assignment:
    """What every surface of a scene is made of; arrays have one row per surface."""

    wall_types: tuple[WallType, ...]
    wall_type: IntArray  # (s,) row in wall_types
    reflectance: FloatArray  # (s,) solar [-]
    nir_reflectance: FloatArray  # (s,) 0.8-1.1 um [-]
    emissivity: FloatArray  # (s,) 8-14 um [-]


def assign_wall_types(scene: Scene, catalogue: Catalogue) -> Assignment:
    """Resolve every surface's material word; each material under each interior condition is one wall type."""
    rows: dict[WallType, int] = {}
    surfaces = scene.surfaces
    count = surfaces.word.size
    wall_type = np.zeros(count, dtype=np.int64)
    reflectance, nir, emissivity = np.zeros(count), np.zeros(count), np.zeros(count)
    for row in range(count):
        word, _ = resolve_surface_word(scene, catalogue, row)
        wall = catalogue.wall_type(word.code, str(surfaces.interior[row]))
        wall_type[row] = rows.setdefault(wall, len(rows))
        reflectance[row] = word.reflectance
        nir[row] = nir_reflectance(catalogue.material(word.code), word.reflectance)
        emissivity[row] = wall.emissivity
    return Assignment(
        wall_types=tuple(rows), wall_type=wall_type, reflectance=reflectance, nir_reflectance=nir, emissivity=emissivity
    )


def resolve_surface_word(scene: Scene, catalogue: Catalogue, row: int) -> tuple[MaterialWord, str | None]:
    """Word of one surface with a code of the catalogue, and its note; InputError names the scene's file and feature."""
    try:
        return catalogue.resolve_word(str(scene.surfaces.word[row]))
    except InputError as error:
        where = f"{scene.files[0]}, feature {scene.features[int(scene.surfaces.feature[row])].number}"
        problem = f"{error.problem} in {error.where}"
        raise InputError(where, error.entry, error.value, problem, error.remedy) from error
