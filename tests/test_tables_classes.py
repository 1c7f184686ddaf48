"""Features of which only the class is known: sections, rooms and notes by class, and what a feature states itself."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from small_world import box, environment, feature, wall_types, write_town

from sensorsim.errors import InputError
from sensorsim.materials import load_catalogue
from sensorsim.scene import Scene, audit_scene, load_scene
from sensorsim.tables import BakeSettings, bake_tables, resolve_classes
from sensorsim.tables.assign import assign_wall_types


def _scene(folder: Path, *properties: dict[str, Any], height: float = 10.0) -> Scene:
    outlines = [box(60.0 * place, 0.0, 40.0, 30.0) for place in range(len(properties))]
    features = [
        feature(outline, **({"height": height} | own)) for outline, own in zip(outlines, properties, strict=True)
    ]
    return load_scene(write_town(folder, features))


def test_a_feature_with_only_a_class_gets_its_sections_on_every_side(tmp_path: Path) -> None:
    scene = resolve_classes(_scene(tmp_path, {"construction_class": "wood_frame"}), load_catalogue())
    words = {str(role): str(word) for role, word in zip(scene.surfaces.role, scene.surfaces.word, strict=True)}
    assert words == {"wall": "0555", "roof": "5015", "bottom": "0657"}
    assert set(scene.surfaces.interior) == {"heated"}


def test_the_scene_knows_the_class_before_any_catalogue_does(tmp_path: Path) -> None:
    """A scene is read without a catalogue: the words are empty until one says what the class is made of."""
    scene = _scene(tmp_path, {"construction_class": "metal"}, {})
    assert scene.features[0].construction_class == "metal"
    assert scene.features[0].roof_word_used == ""
    assert scene.surfaces.by_class.tolist() == [index == 0 for index in scene.surfaces.feature]
    assert scene.features[1].roof_word_used == "6730"


def test_words_and_interior_that_a_feature_states_stay(tmp_path: Path) -> None:
    scene = _scene(
        tmp_path,
        {"construction_class": "metal", "wall_word": "2040"},
        {"construction_class": "metal", "interior": "heated"},
        {"construction_class": "metal", "word": "2231"},
    )
    resolved = resolve_classes(scene, load_catalogue())
    assert [row.wall_word_used for row in resolved.features] == ["2040", "0821", "2231"]
    assert [row.roof_word_used for row in resolved.features] == ["6025", "6025", "2231"]
    assert [row.interior for row in resolved.features] == ["unheated", "heated", "unheated"]


def test_the_audit_says_what_the_class_decided(tmp_path: Path) -> None:
    catalogue = load_catalogue()
    scene = _scene(tmp_path, {"construction_class": "wood_frame"}, {"construction_class": "metal", "wall_word": "2040"})
    audit = audit_scene(resolve_classes(scene, catalogue), catalogue.codes, {})
    notes = {reading.numbers: reading.note for reading in audit.readings}
    assert notes[("1",)] == (
        "roof 5015 by construction class wood_frame; "
        "wall 0555 as Insulated wood wall with studs by construction class wood_frame"
    )
    assert notes[("2",)] == "roof 6025 by construction class metal"
    assert audit.interiors == {"heated": ("1",), "unheated": ("2",)}
    assert sum(use.surfaces for use in audit.words) == scene.counts.surfaces
    assert {use.word for use in audit.words} == {"5015", "0555", "0657", "6025", "2040"}
    assert json.loads(json.dumps(audit.to_dict()))["readings"][0]["wall_word"] is None


def test_an_audit_of_unresolved_classes_is_refused(tmp_path: Path) -> None:
    catalogue = load_catalogue()
    with pytest.raises(InputError, match=r"feature 1: construction_class = 'metal': its sections are not resolved"):
        audit_scene(_scene(tmp_path, {"construction_class": "metal"}), catalogue.codes, {})


def test_resolving_twice_changes_nothing_and_a_scene_without_classes_is_left_alone(tmp_path: Path) -> None:
    catalogue = load_catalogue()
    once = resolve_classes(_scene(tmp_path, {"construction_class": "masonry"}, {}), catalogue)
    twice = resolve_classes(once, catalogue)
    assert twice.features[0].word_note == once.features[0].word_note
    assert twice.features[0].interior_note == once.features[0].interior_note
    np.testing.assert_array_equal(twice.surfaces.word, once.surfaces.word)
    hospital = load_scene("hospital", level="IA")
    assert resolve_classes(hospital, catalogue) is hospital


def test_wall_types_carry_the_classes_construction_room_and_the_features_gain(tmp_path: Path) -> None:
    catalogue = load_catalogue()
    scene = _scene(
        tmp_path,
        {"construction_class": "wood_frame", "heat_gain": 5},
        {"construction_class": "metal", "heat_gain": 250},
    )
    for given in (scene, resolve_classes(scene, catalogue)):
        assigned = assign_wall_types(given, catalogue)
        walls = [assigned.wall_types[row] for row in assigned.wall_type]
        of = {
            (int(f), str(r)): wall
            for f, r, wall in zip(scene.surfaces.feature, scene.surfaces.role, walls, strict=True)
        }
        assert of[0, "wall"].paths == catalogue.constructions["insulated_wood_studs"].paths
        assert of[0, "roof"].layers == catalogue.material(50).construction.layers
        assert of[0, "bottom"].paths == catalogue.constructions["wood_floor"].paths
        assert (of[0, "wall"].heat_gain, of[1, "wall"].heat_gain) == (5.0, 250.0)
        assert of[1, "wall"].room == catalogue.construction_class("metal").room


def test_a_word_brings_its_own_construction_whatever_the_class(tmp_path: Path) -> None:
    catalogue = load_catalogue()
    scene = _scene(tmp_path, {"construction_class": "wood_frame", "wall_word": "0540"})
    assigned = assign_wall_types(scene, catalogue)
    row = int(np.flatnonzero(scene.surfaces.role == "wall")[0])
    wall = assigned.wall_types[assigned.wall_type[row]]
    assert wall.layers == catalogue.material(5).construction.layers
    assert wall.paths == ()
    assert wall.room == catalogue.construction_class("wood_frame").room


def test_planes_of_ground_classes_need_no_word(tmp_path: Path) -> None:
    scene = _scene(tmp_path, {"construction_class": "asphalt_pavement"}, {"construction_class": "grass"}, height=0.0)
    resolved = resolve_classes(scene, load_catalogue())
    assert resolved.surfaces.word.tolist() == ["8110", "9425"]
    assert set(resolved.surfaces.interior) == {"none"}
    assert resolved.features[1].word_note == "plane 9425 by construction class grass"


def test_a_wood_is_no_heated_room(tmp_path: Path) -> None:
    resolved = resolve_classes(_scene(tmp_path, {"construction_class": "deciduous_trees"}), load_catalogue())
    assert set(resolved.surfaces.interior) == {"none"}
    assert set(resolved.surfaces.word) == {"9620"}
    assert resolved.features[0].interior_note == "by construction class deciduous_trees"


@pytest.mark.parametrize(
    ("properties", "message"),
    [
        ({"construction_class": "straw"}, "construction_class = 'straw': no such construction class; use one of"),
        ({"interior": "open", "heat_gain": 10}, "heat_gain = 10.0: no enclosed air to warm: interior 'open'"),
    ],
)  # fmt: skip
def test_what_cannot_be_assigned_is_told_with_its_feature(
    tmp_path: Path, properties: dict[str, Any], message: str
) -> None:
    with pytest.raises(InputError) as caught:
        assign_wall_types(_scene(tmp_path, {}, {"number": "7b"} | properties), load_catalogue())
    assert "town.geojson, feature 7b" in str(caught.value)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("properties", "message"),
    [
        ({"heat_gain": -1}, "heat_gain = -1.0: below 0; give watts"),
        ({"heat_gain": "warm"}, "heat_gain = 'warm': not a finite number"),
        ({"construction_class": 3}, "construction_class = 3: not a text"),
    ],
)
def test_a_wrong_property_is_told_when_the_scene_is_read(
    tmp_path: Path, properties: dict[str, Any], message: str
) -> None:
    with pytest.raises(InputError, match="feature at index 0") as caught:
        _scene(tmp_path, properties)
    assert message in str(caught.value)


def test_a_pane_absorbs_only_what_it_neither_reflects_nor_lets_through(tmp_path: Path) -> None:
    catalogue = load_catalogue()
    scene = _scene(tmp_path, {"construction_class": "curtain_wall"})
    assigned = assign_wall_types(scene, catalogue)
    row = int(np.flatnonzero(scene.surfaces.role == "wall")[0])
    absorptance = catalogue.material(43).solar_absorptance.value
    assert 1.0 - assigned.reflectance[row] == pytest.approx(absorptance, abs=0.005)
    assert assigned.nir_reflectance[row] == pytest.approx(0.053, abs=0.005)


def test_baked_walls_show_their_studs_their_gain_and_their_room() -> None:
    """Winter: studs and a heat gain warm a wall's face; the bake takes paths, room and gain as they come."""
    catalogue = load_catalogue()
    metal = catalogue.construction_class("metal")
    walls = [
        catalogue.wall_type(5, "heated"),
        catalogue.wall_type(5, "heated", section=catalogue.construction_class("wood_frame").section_of("wall")),
        catalogue.wall_type(8, "unheated", room=metal.room),
        catalogue.wall_type(8, "unheated", room=metal.room, heat_gain=250.0),
    ]
    settings = BakeSettings(
        orientations="report10", interpolation="barycentric", lobes=0.0, step=600.0, slice_interval=7200.0,
        lead_in_days=1.0,
    )  # fmt: skip
    tables = bake_tables(environment(), walls, ground=wall_types()[3], settings=settings)
    midnight = tables.at(0.0).coefficients @ (0.3 ** np.arange(settings.degree + 1))
    assert np.all(np.isfinite(tables.coefficients))
    assert np.all(midnight[3] - midnight[2] > 3.0)
    assert np.all(np.abs(midnight[1] - midnight[0]) < 2.0)
    assert not np.array_equal(midnight[1], midnight[0])
