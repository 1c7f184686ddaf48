from pathlib import Path

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
