"""From the words of a scene to rows of the tables: wall type, solar and near-infrared reflectance, emissivity."""

from dataclasses import dataclass

import numpy as np

from sensorsim.errors import InputError
from sensorsim.materials import (
    Catalogue,
    Coverage,
    MaterialWord,
    Section,
    WallType,
    nir_reflectance,
)
from sensorsim.materials.material import OUTDOOR_GROUPS
from sensorsim.scene import Feature, Scene
from sensorsim.tables.classes import resolve_classes
from sensorsim.tables.mixture import mixed_reflectances
from sensorsim.tables.orientations import FloatArray, IntArray
from sensorsim.thermal.season import Season

SNOW_CODE = 99
MILD = Season(leafless=False, snow=False)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Assignment:
    """What every surface of a scene is made of; arrays have one row per surface."""

    wall_types: tuple[WallType, ...]
    wall_type: IntArray  # (s,) row in wall_types
    reflectance: FloatArray  # (s,) solar, of what is not absorbed [-]
    transmittance: FloatArray  # (s,) solar, the part of it that passes a pane [-]
    nir_reflectance: FloatArray  # (s,) 0.8-1.1 um [-]
    emissivity: FloatArray  # (s,) 8-14 um [-]


def assign_wall_types(scene: Scene, catalogue: Catalogue, season: Season = MILD) -> Assignment:
    """Resolve every surface's material word; each material under each interior condition is one wall type.

    Surfaces that go by their construction class get its sections. What passes a pane does not warm it, so that glass
    goes into the tables with its transmittance added to its reflectance. Deciduous trees are bare and grounds under
    snow, as the season has it. Blocks are mixed by the roof and tree coverage of their feature's sheet.
    """
    scene = resolve_classes(scene, catalogue)
    rows: dict[WallType, int] = {}
    first, alike = _alike(scene)
    wall_type = np.zeros(first.size, dtype=np.int64)
    reflectance, transmittance, nir, emissivity = np.zeros((4, first.size))
    for kind, row in enumerate(first):
        word, _ = resolve_surface_word(scene, catalogue, row)
        covered = season.snow and scene.surfaces.role[row] == "plane" and _takes_snow(catalogue, word.code)
        word = _snow_word(catalogue) if covered else word
        section = None if covered else _section(scene, catalogue, row)
        wall = _wall_type(scene, catalogue, row, word.code, section=section, leafless=season.leafless)
        wall_type[kind] = rows.setdefault(wall, len(rows))
        reflectance[kind] = min(word.reflectance + catalogue.material(word.code).solar_transmittance.value, 1.0)
        transmittance[kind] = reflectance[kind] - word.reflectance
        nir[kind] = _nir_reflectance(catalogue, wall, word.reflectance, leafless=season.leafless)
        emissivity[kind] = wall.emissivity
    return Assignment(
        wall_types=tuple(rows), wall_type=wall_type[alike], reflectance=reflectance[alike],
        transmittance=transmittance[alike], nir_reflectance=nir[alike], emissivity=emissivity[alike],
    )  # fmt: skip


def _alike(scene: Scene) -> tuple[IntArray, IntArray]:
    """Kinds of surfaces that differ in anything asked of them here: the first of each, and the kind of all (s,).

    Kinds ascend by their first surface, so that the first that cannot be resolved is the one that is told.
    """
    surfaces = scene.surfaces
    kinds: dict[tuple[object, ...], int] = {}
    asked = [(one.construction_class, one.heat_gain, _coverage(one)) for one in scene.features]
    of_feature = {one: place for place, one in enumerate(dict.fromkeys(asked))}
    own = np.array([of_feature[one] for one in asked], dtype=np.int64)[surfaces.feature]
    columns = (surfaces.word, surfaces.role, surfaces.interior, surfaces.by_class, own)
    rows = zip(*(column.tolist() for column in columns), strict=True)
    alike = np.array([kinds.setdefault(row, len(kinds)) for row in rows], dtype=np.int64)
    return np.unique(alike, return_index=True)[1], alike


def resolve_surface_word(scene: Scene, catalogue: Catalogue, row: int) -> tuple[MaterialWord, str | None]:
    """Word of one surface with a code of the catalogue, and its note; InputError names the scene's file and feature."""
    try:
        return catalogue.resolve_word(str(scene.surfaces.word[row]))
    except InputError as error:
        where = _where(scene, row)
        problem = f"{error.problem} in {error.where}"
        raise InputError(where, error.entry, error.value, problem, error.remedy) from error


def _takes_snow(catalogue: Catalogue, code: int) -> bool:
    """Whether snow hides a plane of this code; blocks show on, as their roofs and trees are not covered."""
    group = catalogue.material(code).group
    return group in OUTDOOR_GROUPS and group != "water"


def _snow_word(catalogue: Catalogue) -> MaterialWord:
    return MaterialWord(code=SNOW_CODE, reflectance=catalogue.material(SNOW_CODE).solar_reflectance)


def _coverage(feature: Feature) -> Coverage:
    roof, tree = feature.roof_coverage, feature.tree_coverage
    return Coverage(roof=None if roof is None else roof / 100.0, tree=None if tree is None else tree / 100.0)


def _nir_reflectance(catalogue: Catalogue, wall: WallType, reflectance: float, *, leafless: bool) -> float:
    """Reflectance in 0.8-1.1 um [-]: of a block the mean of its parts, of a bare crown that of its bark."""
    if wall.parts:
        own_parts = mixed_reflectances(wall, np.array([reflectance]))[:, 0]
        return sum(
            part.share * _nir_reflectance(catalogue, part.wall, float(own), leafless=leafless)
            for part, own in zip(wall.parts, own_parts, strict=True)
        )
    material = catalogue.material(wall.code)
    own = nir_reflectance(material, reflectance)
    if leafless and material.leafless is not None:
        own *= material.leafless.reflectance_nir.value / material.reflectance_nir.value
    return own


def _section(scene: Scene, catalogue: Catalogue, row: int) -> Section | None:
    """Section of a surface that goes by its construction class."""
    name = scene.features[int(scene.surfaces.feature[row])].construction_class
    if name is None or not scene.surfaces.by_class[row]:
        return None
    return catalogue.construction_class(name).section_of(str(scene.surfaces.role[row]))


def _wall_type(
    scene: Scene, catalogue: Catalogue, row: int, code: int, *, section: Section | None, leafless: bool
) -> WallType:
    """Wall type of one surface of a scene whose classes are resolved."""
    surfaces, feature = scene.surfaces, scene.features[int(scene.surfaces.feature[row])]
    name = feature.construction_class
    try:
        return catalogue.wall_type(
            code,
            str(surfaces.interior[row]),
            section=section,
            room=None if name is None else catalogue.construction_class(name).room,
            heat_gain=feature.heat_gain,
            leafless=leafless,
            coverage=_coverage(feature),
            side=str(surfaces.role[row]) in ("wall", "bottom"),
        )
    except InputError as error:
        raise InputError(_where(scene, row), error.entry, error.value, error.problem, error.remedy) from error


def _where(scene: Scene, row: int) -> str:
    return f"{scene.files[0]}, feature {scene.features[int(scene.surfaces.feature[row])].number}"
