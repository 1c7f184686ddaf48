"""From the words of a scene to rows of the tables: wall type, solar and near-infrared reflectance, emissivity."""

from dataclasses import dataclass

import numpy as np

from sensorsim.errors import InputError
from sensorsim.materials import Catalogue, MaterialWord, WallType, nir_reflectance
from sensorsim.scene import Scene
from sensorsim.tables.classes import resolve_classes
from sensorsim.tables.orientations import FloatArray, IntArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Assignment:
    """What every surface of a scene is made of; arrays have one row per surface."""

    wall_types: tuple[WallType, ...]
    wall_type: IntArray  # (s,) row in wall_types
    reflectance: FloatArray  # (s,) solar, of what is not absorbed [-]
    nir_reflectance: FloatArray  # (s,) 0.8-1.1 um [-]
    emissivity: FloatArray  # (s,) 8-14 um [-]


def assign_wall_types(scene: Scene, catalogue: Catalogue) -> Assignment:
    """Resolve every surface's material word; each material under each interior condition is one wall type.

    Surfaces that go by their construction class get its sections. What passes a pane does not warm it, so that glass
    goes into the tables with its transmittance added to its reflectance.
    """
    scene = resolve_classes(scene, catalogue)
    rows: dict[WallType, int] = {}
    count = scene.surfaces.word.size
    wall_type = np.zeros(count, dtype=np.int64)
    reflectance, nir, emissivity = np.zeros(count), np.zeros(count), np.zeros(count)
    for row in range(count):
        word, _ = resolve_surface_word(scene, catalogue, row)
        wall, material = _wall_type(scene, catalogue, row, word.code), catalogue.material(word.code)
        wall_type[row] = rows.setdefault(wall, len(rows))
        reflectance[row] = min(word.reflectance + material.solar_transmittance.value, 1.0)
        nir[row] = nir_reflectance(material, word.reflectance)
        emissivity[row] = wall.emissivity
    return Assignment(
        wall_types=tuple(rows), wall_type=wall_type, reflectance=reflectance, nir_reflectance=nir, emissivity=emissivity
    )


def resolve_surface_word(scene: Scene, catalogue: Catalogue, row: int) -> tuple[MaterialWord, str | None]:
    """Word of one surface with a code of the catalogue, and its note; InputError names the scene's file and feature."""
    try:
        return catalogue.resolve_word(str(scene.surfaces.word[row]))
    except InputError as error:
        where = _where(scene, row)
        problem = f"{error.problem} in {error.where}"
        raise InputError(where, error.entry, error.value, problem, error.remedy) from error


def _wall_type(scene: Scene, catalogue: Catalogue, row: int, code: int) -> WallType:
    """Wall type of one surface of a scene whose classes are resolved."""
    surfaces, feature = scene.surfaces, scene.features[int(scene.surfaces.feature[row])]
    name = feature.construction_class
    known = None if name is None else catalogue.construction_class(name)
    try:
        return catalogue.wall_type(
            code,
            str(surfaces.interior[row]),
            section=known.section_of(str(surfaces.role[row])) if known is not None and surfaces.by_class[row] else None,
            room=None if known is None else known.room,
            heat_gain=feature.heat_gain,
        )
    except InputError as error:
        raise InputError(_where(scene, row), error.entry, error.value, error.problem, error.remedy) from error


def _where(scene: Scene, row: int) -> str:
    return f"{scene.files[0]}, feature {scene.features[int(scene.surfaces.feature[row])].number}"
