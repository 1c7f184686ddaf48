"""Features of which only the construction class is known get its sections: section 3.5 of [Report1978]."""

from dataclasses import replace

from sensorsim.errors import InputError
from sensorsim.materials import Catalogue, ConstructionClass
from sensorsim.scene import INTERIORS, Feature, Scene
from sensorsim.scene.features import Interior


def resolve_classes(scene: Scene, catalogue: Catalogue) -> Scene:
    """The scene with words, interiors and notes where a construction class decides; itself where none does.

    A word or an interior that a feature states stays. Raises InputError for a class that the catalogue lacks.
    """
    if all(feature.construction_class is None for feature in scene.features):
        return scene
    classes = [_class_of(scene, feature, catalogue) for feature in scene.features]
    features = tuple(
        feature if known is None else _resolve(feature, known)
        for feature, known in zip(scene.features, classes, strict=True)
    )
    table = scene.surfaces
    word, interior = table.word.copy(), table.interior.copy()
    for row in range(word.size):
        known = classes[int(table.feature[row])]
        if known is not None:
            interior[row] = features[int(table.feature[row])].interior
            if table.by_class[row]:
                word[row] = known.section_of(str(table.role[row])).word.text
    return replace(scene, features=features, surfaces=replace(table, word=word, interior=interior))


def _class_of(scene: Scene, feature: Feature, catalogue: Catalogue) -> ConstructionClass | None:
    if feature.construction_class is None:
        return None
    try:
        return catalogue.construction_class(feature.construction_class)
    except InputError as error:
        where = f"{scene.files[0]}, feature {feature.number}"
        raise InputError(where, error.entry, error.value, error.problem, error.remedy) from error


def _resolve(feature: Feature, known: ConstructionClass) -> Feature:
    """The feature with the class's words where it has none, its interior where it states none, and why."""
    roof, wall = known.section_of("roof"), known.section_of("wall")
    decided = {"roof": roof} if not feature.roof_word_used else {}
    if not feature.wall_word_used and not feature.parts[0].is_plane:
        decided["wall"] = wall
    notes = [feature.word_note] if feature.word_note else []
    for component, section in decided.items():
        stands_for = f" as {section.construction.name}" if section.construction is not None else ""
        name = "plane" if feature.parts[0].is_plane else component
        notes.append(f"{name} {section.word.text}{stands_for} by construction class {known.name}")
    interior_note = feature.interior_note if feature.interior_stated else f"by construction class {known.name}"
    return replace(
        feature,
        roof_word_used=feature.roof_word_used or roof.word.text,
        wall_word_used=feature.wall_word_used or wall.word.text,
        word_note="; ".join(notes),
        interior=feature.interior if feature.interior_stated else _interior(known),
        interior_note=interior_note,
    )


def _interior(known: ConstructionClass) -> Interior:
    return next(interior for interior in INTERIORS if interior == known.interior)
