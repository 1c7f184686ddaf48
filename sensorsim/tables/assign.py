"""From the words of a scene to rows of the tables: wall type, solar and near-infrared reflectance, emissivity."""

from dataclasses import dataclass

import numpy as np

from sensorsim.errors import InputError
from sensorsim.materials import Catalogue, Coverage, MaterialWord, WallType, nir_reflectance, part_reflectance
from sensorsim.materials.material import OUTDOOR_GROUPS
from sensorsim.scene import Feature, Scene
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.thermal.season import Season

SNOW_CODE = 99
MILD = Season(leafless=False, snow=False)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Assignment:
    """What every surface of a scene is made of; arrays have one row per surface."""

    wall_types: tuple[WallType, ...]
    wall_type: IntArray  # (s,) row in wall_types
    reflectance: FloatArray  # (s,) solar [-]
    nir_reflectance: FloatArray  # (s,) 0.8-1.1 um [-]
    emissivity: FloatArray  # (s,) 8-14 um [-]


def assign_wall_types(scene: Scene, catalogue: Catalogue, season: Season = MILD) -> Assignment:
    """Resolve every surface's material word; each material under each interior condition is one wall type.

    Deciduous trees are bare and grounds under snow, as the season has it. Blocks are mixed by the roof and tree
    coverage of their feature's sheet.
    """
    rows: dict[WallType, int] = {}
    surfaces = scene.surfaces
    count = surfaces.word.size
    wall_type = np.zeros(count, dtype=np.int64)
    reflectance, nir, emissivity = np.zeros(count), np.zeros(count), np.zeros(count)
    for row in range(count):
        word, _ = resolve_surface_word(scene, catalogue, row)
        word = _under_snow(word, catalogue) if season.snow and surfaces.role[row] == "plane" else word
        wall = catalogue.wall_type(
            word.code,
            str(surfaces.interior[row]),
            leafless=season.leafless,
            coverage=_coverage(scene.features[int(surfaces.feature[row])]),
            side=str(surfaces.role[row]) in ("wall", "bottom"),
        )
        wall_type[row] = rows.setdefault(wall, len(rows))
        reflectance[row] = word.reflectance
        nir[row] = _nir_reflectance(catalogue, wall, word.reflectance, leafless=season.leafless)
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


def _under_snow(word: MaterialWord, catalogue: Catalogue) -> MaterialWord:
    """The word of snow in place of a ground's own; blocks keep theirs, as their roofs and trees are not covered."""
    if catalogue.material(word.code).group not in OUTDOOR_GROUPS or catalogue.material(word.code).group == "water":
        return word
    return MaterialWord(code=SNOW_CODE, reflectance=catalogue.material(SNOW_CODE).solar_reflectance)


def _coverage(feature: Feature) -> Coverage:
    roof, tree = feature.roof_coverage, feature.tree_coverage
    return Coverage(roof=None if roof is None else roof / 100.0, tree=None if tree is None else tree / 100.0)


def _nir_reflectance(catalogue: Catalogue, wall: WallType, reflectance: float, *, leafless: bool) -> float:
    """Reflectance in 0.8-1.1 um [-]: of a block the mean of its parts, of a bare crown that of its bark."""
    if wall.parts:
        mean = sum(part.share * part.reflectance for part in wall.parts)
        return sum(
            part.share
            * _nir_reflectance(
                catalogue, part.wall, part_reflectance(part.reflectance, mean, reflectance), leafless=leafless
            )
            for part in wall.parts
        )
    material = catalogue.material(wall.code)
    own = nir_reflectance(material, reflectance)
    if leafless and material.leafless is not None:
        own *= material.leafless.reflectance_nir.value / material.reflectance_nir.value
    return own
