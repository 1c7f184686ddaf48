from pathlib import Path
from typing import Any

import numpy as np
import pytest
from small_world import box, feature, town_features, write_town

from sensorsim.errors import InputError
from sensorsim.materials import load_catalogue, nir_reflectance
from sensorsim.scene import load_scene
from sensorsim.tables.assign import assign_wall_types


def test_every_surface_gets_the_wall_type_and_reflectance_of_its_word() -> None:
    scene, catalogue = load_scene("hospital", level="IIIB"), load_catalogue()
    assigned = assign_wall_types(scene, catalogue)
    surfaces = scene.surfaces
    assert assigned.wall_type.shape == surfaces.word.shape
    for row in range(0, surfaces.word.size, 7):
        word, _ = catalogue.resolve_word(str(surfaces.word[row]))
        wall = assigned.wall_types[assigned.wall_type[row]]
        assert (wall.code, wall.interior) == (word.code, str(surfaces.interior[row]))
        assert assigned.reflectance[row] == word.reflectance
        assert assigned.emissivity[row] == wall.emissivity
        if not wall.parts:  # a mixed block has the mean of its parts
            assert assigned.nir_reflectance[row] == nir_reflectance(catalogue.material(word.code), word.reflectance)


def test_wall_types_are_listed_once_each_and_all_are_used() -> None:
    for level in ("IA", "IIA", "IIIB"):
        assigned = assign_wall_types(load_scene("hospital", level=level), load_catalogue())
        assert len(set(assigned.wall_types)) == len(assigned.wall_types)
        assert sorted(np.unique(assigned.wall_type).tolist()) == list(range(len(assigned.wall_types)))


def test_unknown_material_is_told_with_the_file_the_feature_and_a_remedy(tmp_path: Path) -> None:
    features = [*town_features(), feature(box(0.0, 0.0, 5.0, 5.0), 5.0, number="7b", wall_word="7712")]
    path = write_town(tmp_path, features, "village.geojson")
    scene = load_scene(path, level="IIIB")
    with pytest.raises(InputError) as caught:
        assign_wall_types(scene, load_catalogue())
    message = str(caught.value)
    assert message.startswith(f"{path}, feature 7b: material code = 77: no such material in ")
    assert "use one of the" in message
    assert "\n" not in message


def test_of_several_unknown_materials_the_first_in_the_file_is_told(tmp_path: Path) -> None:
    bad = [feature(box(30.0 * k, 0.0, 5.0, 5.0), 5.0, number=f"9{k}", wall_word=f"77{k}0") for k in range(3)]
    scene = load_scene(write_town(tmp_path, [*town_features(), *bad]), level="IIIB")
    with pytest.raises(InputError, match="feature 90: material code = 77"):
        assign_wall_types(scene, load_catalogue())


def test_surfaces_of_one_word_differ_by_what_their_features_say(tmp_path: Path) -> None:
    """Interior and heat gain make wall types of their own; surfaces alike in all share one, wherever they stand."""
    told: list[dict[str, Any]] = [
        {"interior": "unheated", "heat_gain": 0.0}, {"interior": "unheated", "heat_gain": 8.0},
        {"interior": "heated"}, {"interior": "unheated", "heat_gain": 8.0},
    ]  # fmt: skip
    boxes = [
        feature(box(30.0 * k, 0.0, 9.0, 9.0), 5.0, word="2040", number=str(k), **properties)
        for k, properties in enumerate(told)
    ]
    scene = load_scene(write_town(tmp_path, boxes), level="IIIB")
    assigned = assign_wall_types(scene, load_catalogue())
    walls = [{assigned.wall_types[row] for row in assigned.wall_type[scene.surfaces.feature == k]} for k in range(4)]
    assert [len(found) for found in walls] == [1, 1, 1, 1]
    assert walls[1] == walls[3]
    assert len(set.union(*walls)) == 3
    assert [next(iter(found)).heat_gain for found in walls[:2]] == [0.0, 8.0]
