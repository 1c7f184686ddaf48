"""Features of one scene at its levels of detail, and which stands in which."""

import json
from pathlib import Path

import numpy as np
import pytest
from small_world import LATITUDE, LONGITUDE, box, feature, town_features, write_town

from sensorsim.errors import InputError
from sensorsim.scene import ALL_LEVELS, LEVELS, RESOLUTION, Lineage, Scene, load_all_levels, load_scene, trace
from sensorsim.scene.features import Feature
from sensorsim.scene.projection import LocalFrame
from sensorsim.scene.reader import read_features


@pytest.fixture(scope="module")
def hospital() -> Scene:
    return load_all_levels("hospital")


def lineage_of(scene: Scene) -> Lineage:
    assert scene.lineage is not None
    return scene.lineage


def test_scene_of_all_levels_holds_each_level_whole(hospital: Scene) -> None:
    """Expected: features, surfaces and triangles of the three levels one after the other, as each alone has them."""
    lineage, first = lineage_of(hospital), 0
    assert hospital.level == ALL_LEVELS
    for number, level in enumerate(LEVELS):
        alone = load_scene("hospital", level=level)
        rows = np.flatnonzero(lineage.level == number)
        assert [hospital.features[row].number for row in rows] == [f"{level} {one.number}" for one in alone.features]
        kept = np.isin(hospital.surfaces.feature, rows)
        np.testing.assert_array_equal(hospital.surfaces.normal[kept], alone.surfaces.normal)
        np.testing.assert_array_equal(hospital.surfaces.word[kept], alone.surfaces.word)
        drawn = np.isin(hospital.surfaces.feature[hospital.mesh.surface[hospital.mesh.triangle[:, 0]]], rows)
        np.testing.assert_array_equal(
            hospital.mesh.position[hospital.mesh.triangle[drawn]], alone.mesh.position[alone.mesh.triangle]
        )
        first += len(rows)
    assert first == len(hospital.features) == 12 + 21 + 87


def test_audit_of_kin_of_the_hospital(hospital: Scene) -> None:
    """All but nine solids of the finer levels have kin, four of them as neighbours; one wood has no finer part."""
    lineage = lineage_of(hospital)
    counts = [{kin: int(np.sum((lineage.level == level) & (lineage.kin == kin))) for kin in np.unique(lineage.kin)}
              for level in range(3)]  # fmt: skip
    assert counts == [
        {"ground": 2, "near": 0, "none": 0, "overlap": 0, "root": 10},
        {"ground": 7, "near": 2, "none": 1, "overlap": 11, "root": 0},
        {"ground": 13, "near": 2, "none": 8, "overlap": 64, "root": 0},
    ]
    names = {hospital.features[row].number: row for row in range(len(hospital.features))}
    of = {number: int(lineage.parent[row]) for number, row in names.items()}
    assert of["IIIB 24"] == names["IIA 4"]  # the hospital
    assert of["IIA 4"] == names["IA 3"]
    assert of["IIIB 40"] == names["IIA 6"]  # the heating plant
    assert of["IIA 3"] == names["IA 4"]  # officers' housing, 39 m from its cluster
    assert of["IIIB 42"] == -1  # the church
    assert [hospital.features[row].number for row in lineage.childless()] == ["IA 10"]


def test_kin_is_of_the_next_level_alike_in_kind_and_near(hospital: Scene) -> None:
    lineage = lineage_of(hospital)
    linked = np.flatnonzero(lineage.parent >= 0)
    assert np.all(lineage.level[lineage.parent[linked]] == lineage.level[linked] - 1)
    assert not np.any(lineage.is_ground[linked] | lineage.is_ground[lineage.parent[linked]])
    allowed = np.array([RESOLUTION[LEVELS[level - 1]] for level in lineage.level[linked]])
    assert np.all(lineage.apart[linked] <= allowed)
    near = linked[lineage.kin[linked] == "near"]
    assert np.all(lineage.apart[near] > 0.0)
    for row in near:
        assert hospital.features[row].feature_id == hospital.features[lineage.parent[row]].feature_id


def _features(tmp_path: Path, *rows: dict[str, object]) -> tuple[Feature, ...]:
    path = write_town(tmp_path, list(rows))
    return read_features(path, json.loads(path.read_text()))


def test_kin_by_overlap_then_by_nearness_then_none(tmp_path: Path) -> None:
    """Two blocks; a house in each, one across both, one just outside of its kind, one of another, one far away."""
    coarse = _features(
        tmp_path, feature(box(0, 0, 100, 100), 8.0, feature_id=1), feature(box(100, 0, 100, 100), 8.0, feature_id=2)
    )
    fine = _features(
        tmp_path,
        feature(box(0, 0, 10, 10), 8.0, feature_id=9),
        feature(box(52, 0, 10, 10), 8.0, feature_id=1),  # 70 % in the second
        feature(box(-70, 0, 10, 10), 8.0, feature_id=1),  # 15 m outside of the first
        feature(box(-70, 0, 10, 10), 8.0, feature_id=2),  # but 115 m from its own kind: farther than 61 m, not 152 m
        feature(box(-70, 0, 10, 10), 8.0, feature_id=3),
        feature(box(-400, 0, 10, 10), 8.0, feature_id=1),
        feature(box(0, 0, 10, 10), 0.0, feature_id=1),
    )
    frame = LocalFrame(longitude=LONGITUDE, latitude=LATITUDE)
    found = trace((coarse, fine), frame)
    assert found.parent.tolist() == [-1, -1, 0, 1, 0, 1, -1, -1, -1]
    assert found.kin.tolist() == ["root", "root", "overlap", "overlap", "near", "near", "none", "none", "ground"]
    assert found.apart[4] == pytest.approx(15.0, abs=0.1)
    lower = trace(((), coarse, fine), frame)
    assert lower.kin.tolist() == ["none", "none", "overlap", "overlap", "near", "none", "none", "none", "ground"]


def test_a_file_holds_one_level(tmp_path: Path) -> None:
    for name in (str(write_town(tmp_path, town_features())), "nowhere"):
        with pytest.raises(InputError, match="level = 'auto'"):
            load_all_levels(name)
    with pytest.raises(InputError, match="no such level"):
        load_scene("hospital", level=ALL_LEVELS)
