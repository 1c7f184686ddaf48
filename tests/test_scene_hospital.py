"""The hospital scene against what the report's text says of it."""

import importlib
import json
import math
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from shapely import union_all
from shapely.geometry import Polygon

from sensorsim.resources import assets_folder
from sensorsim.scene import LEVELS, Feature, Scene, load_scene
from sensorsim.units import METRES_PER_FOOT

ROUNDING = 0.02  # area of slivers that the coordinates' rounding to 0.1 mm can leave [m2]


@pytest.fixture(params=LEVELS)
def scene(request: pytest.FixtureRequest) -> Scene:
    return load_scene("hospital", level=request.param)


@pytest.fixture(scope="module")
def finest() -> Scene:
    return load_scene("hospital", level="IIIB")


def outline(scene: Scene, degrees: np.ndarray) -> Polygon:
    return Polygon(scene.frame.metres_from_degrees(degrees))


def ground(scene: Scene, *numbers: int | str) -> Polygon:
    parts = [part for number in numbers for part in feature(scene, number).parts]
    return union_all([outline(scene, part.footprint) for part in parts])


def feature(scene: Scene, number: int | str) -> Feature:
    return next(feature for feature in scene.features if feature.number == str(number))


def wall_azimuths(scene: Scene, number: int | str) -> np.ndarray:
    table = scene.surfaces
    rows = (table.feature == scene.features.index(feature(scene, number))) & (table.role == "wall")
    return np.degrees(np.arctan2(table.normal[rows, 0], table.normal[rows, 1])) % 360.0


def sides_in_feet(outline: Polygon) -> list[float]:
    corners = np.array(outline.exterior.coords)
    return sorted((np.hypot(*np.diff(corners, axis=0).T) / METRES_PER_FOOT).tolist())


def tower_angles(scene: Scene, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Degrees to the right of and above the tower camera's axis, of points of shape (n, 3) [m]."""
    camera = scene.camera("tower")
    position, target = camera.position(scene.frame), camera.target(scene.frame)
    forward = (target - position) / np.linalg.norm(target - position)
    right = np.cross(forward, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    seen = points - position
    depth = seen @ forward
    assert (depth > 0.0).all()
    return np.degrees(np.arctan(seen @ right / depth)), np.degrees(np.arctan(seen @ np.cross(right, forward) / depth))


def corners(scene: Scene, number: int | str) -> np.ndarray:
    index = scene.features.index(feature(scene, number))
    return scene.mesh.position[scene.surfaces.feature[scene.mesh.surface] == index]


def test_strip_is_two_and_a_half_by_three_quarter_miles(scene: Scene) -> None:
    base = feature(scene, scene.features[-1].number)
    sides = sides_in_feet(outline(scene, base.parts[0].footprint))
    assert sides == pytest.approx([3960.0, 3960.0, 13200.0, 13200.0], abs=0.01)
    everything = union_all([outline(scene, part.footprint) for row in scene.features for part in row.parts])
    assert everything.area == pytest.approx(outline(scene, base.parts[0].footprint).area, rel=1e-6)


@pytest.mark.parametrize(("level", "number"), [("IIA", 12), ("IIIB", 43)])
def test_overpass_is_420_by_60_feet_and_hangs_free(level: str, number: int) -> None:
    scene = load_scene("hospital", level=level)
    (part,) = feature(scene, number).parts
    assert sides_in_feet(outline(scene, part.footprint)) == pytest.approx([60.0, 60.0, 420.0, 420.0], abs=0.01)
    assert part.top / METRES_PER_FOOT == pytest.approx(35.0)
    assert part.base > 0.0
    assert part.has_bottom


def test_hospital_has_its_heights_at_each_level(finest: Scene) -> None:
    heights = {
        "IA": [65.0],
        "IIA": [25.0, 64.0],
        "IIIB": [25.0, 32.0, 64.0, 96.0],
    }
    for (level, feet), number in zip(heights.items(), (3, 4, 24), strict=True):
        row = feature(load_scene("hospital", level=level), number)
        assert row.height / METRES_PER_FOOT == pytest.approx(65.0)
        assert sorted(part.top / METRES_PER_FOOT for part in row.parts) == pytest.approx(feet)
    coarse = load_scene("hospital", level="IA")
    cover = ground(finest, 24).convex_hull
    diameter = max(math.dist(a, b) for a, b in combinations(cover.exterior.coords, 2))
    (part,) = feature(coarse, 3).parts
    point = outline(coarse, part.footprint)
    assert max(math.dist(a, b) for a, b in combinations(point.exterior.coords, 2)) == pytest.approx(diameter, abs=0.01)
    assert diameter < 500.0 * METRES_PER_FOOT  # or it would not be a point feature at level IA


@pytest.mark.parametrize(("number", "feet"), [(5, 100.0), (9, 600.0)])
def test_point_features_have_the_sheets_diameter(number: int, feet: float) -> None:
    scene = load_scene("hospital", level="IA")
    row = feature(scene, number)
    assert row.point_dimension is not None
    assert row.point_dimension / METRES_PER_FOOT == pytest.approx(feet)
    points = outline(scene, row.parts[0].footprint).exterior.coords
    assert max(math.dist(a, b) for a, b in combinations(points, 2)) / METRES_PER_FOOT == pytest.approx(feet, abs=0.01)


def test_solids_do_not_intersect(scene: Scene) -> None:
    solids = [
        (row.number, part, outline(scene, part.footprint))
        for row in scene.features
        for part in row.parts
        if not part.is_plane
    ]
    for (number, part, here), (other, another, there) in combinations(solids, 2):
        if part.base < another.top and another.base < part.top:
            assert here.intersection(there).area < ROUNDING, (number, other)


def test_the_solid_without_a_bottom_stands_on_a_roof() -> None:
    scene = load_scene("hospital", level="IIA")
    lower, upper = sorted(feature(scene, 4).parts, key=lambda part: part.base)
    assert [part.has_bottom for row in scene.features for part in row.parts if not part.is_plane].count(False) == 1
    assert not upper.has_bottom
    assert upper.base == lower.top
    outside = outline(scene, upper.footprint).difference(outline(scene, lower.footprint))
    assert outside.area < ROUNDING


def test_planes_of_one_layer_do_not_overlap(scene: Scene) -> None:
    layers: dict[float, list[Polygon]] = {}
    for row in scene.features:
        for part in row.parts:
            if part.is_plane:
                layers.setdefault(part.base, []).append(outline(scene, part.footprint))
    for planes in layers.values():
        for here, there in combinations(planes, 2):
            assert here.intersection(there).area < ROUNDING
    assert len(layers[0.0]) == 1


def test_a_24_bit_depth_buffer_tells_the_layers_apart_from_every_camera(scene: Scene) -> None:
    near = 10.0
    layers = sorted({part.base for row in scene.features for part in row.parts if part.is_plane})
    gap = min(np.diff(layers))
    for camera in scene.cameras:
        away = scene.mesh.position - camera.position(scene.frame)
        reach = np.linalg.norm(away, axis=1).max()
        step = reach**2 / (near * 2.0**24)
        assert gap * reach / camera.altitude > 1.5 * step


def test_hospital_and_heating_plant_face_the_four_quarters() -> None:
    for level, numbers in (("IIA", (4, 6)), ("IIIB", (24, 40))):
        scene = load_scene("hospital", level=level)
        for number in numbers:
            azimuths = wall_azimuths(scene, number)
            turned = azimuths - 90.0 * np.round(azimuths / 90.0)
            np.testing.assert_allclose(turned, 0.0, atol=0.01)
            assert {0, 1, 2, 3} == set(np.round(azimuths / 90.0).astype(int) % 4)


def test_houses_stand_along_the_railroad_and_the_cement_plant_turns_its_back_on_the_morning_sun(finest: Scene) -> None:
    for number in (*range(1, 24), *range(25, 40), 45, 46, 51, 52):
        azimuths = np.sort(np.unique(wall_azimuths(finest, number).round(1)))
        np.testing.assert_allclose(azimuths, [52.0, 142.0, 232.0, 322.0], atol=0.11)
    sun_at_ten, sun_at_sixteen = 135.0, 229.0  # azimuths on 7 February [deg]
    assert abs(232.0 - sun_at_ten) > 90.0
    assert abs(232.0 - sun_at_sixteen) < 5.0


def test_tower_has_houses_hospital_plants_and_overpass_in_frame(finest: Scene) -> None:
    half = finest.camera("tower").horizontal_field_of_view / 2.0
    upright = math.degrees(math.atan(math.tan(math.radians(half)) * 0.75))
    for number in (2, 14, 23, 24, 40, 41, 42, 43, *range(44, 55)):
        right, up = tower_angles(finest, corners(finest, number))
        assert (np.abs(right) < half).all(), number
        assert (np.abs(up) < upright).all(), number


def test_tower_sees_block_walls_left_and_metal_walls_right_at_the_cement_plant(finest: Scene) -> None:
    spans = {}
    for number in range(44, 55):
        right, _ = tower_angles(finest, corners(finest, number))
        spans[number] = (float(right.min()), float(right.max()))
    leftmost = min(spans, key=lambda number: spans[number][0])
    rightmost = max(spans, key=lambda number: spans[number][1])
    assert feature(finest, leftmost).wall_word == "2240"
    assert feature(finest, rightmost).wall_word == "0940"
    pixel = finest.camera("tower").horizontal_field_of_view / 640
    for number in (leftmost, rightmost):
        low, high = spans[number]
        assert (high - low) / pixel > 25.0
        hidden = [other for other, (left, right) in spans.items() if other != number and left < high and right > low]
        position = finest.camera("tower").position(finest.frame)
        reach = {n: np.linalg.norm(corners(finest, n) - position, axis=1).min() for n in (number, *hidden)}
        assert all(reach[number] < reach[other] for other in hidden)


def test_tower_sees_south_and_west_walls_and_roofs(finest: Scene) -> None:
    position = finest.camera("tower").position(finest.frame)
    for number in (24, 40):
        middle = corners(finest, number).mean(axis=0)
        towards = position - middle
        assert towards[0] < 0.0
        assert towards[1] < 0.0
    assert position[2] > max(part.top for number in (1, 24, 40) for part in feature(finest, number).parts)


def test_levels_show_the_same_features_at_the_same_places(finest: Scene) -> None:
    coarse, middle = load_scene("hospital", level="IA"), load_scene("hospital", level="IIA")
    inside = [
        (ground(finest, *range(1, 23)), ground(coarse, 2)),
        (ground(finest, *range(1, 23)), ground(middle, 2)),
        (ground(finest, *range(25, 40)), ground(coarse, 4)),
        (ground(finest, *range(25, 40)), ground(middle, 5)),
        (ground(finest, 24), ground(middle, 4)),
        (ground(middle, 4), ground(finest, 24)),
        (ground(finest, 44, 45), ground(middle, 14)),
        (ground(finest, 50, 51, 52), ground(middle, 13)),
        (ground(finest, *range(63, 76)), ground(middle, 8, 9, 10, 11)),
        (ground(finest, 23), ground(middle, 3)),
        (ground(finest, 40), ground(middle, 6)),
        (ground(finest, 43), ground(middle, 12)),
        (ground(finest, 83), ground(middle, 18)),
    ]
    for small, large in inside:
        assert small.difference(large).area < ROUNDING * 100
    assert ground(coarse, 9).intersects(ground(middle, 13))


def test_sheets_and_words_are_those_printed(finest: Scene) -> None:
    officers = feature(finest, 23)
    assert (officers.feature_type, officers.surface_material, officers.number_of_structures) == (2, 3, 13)
    assert (officers.tree_coverage, officers.roof_coverage, officers.feature_id, officers.level) == (0.0, 100.0, 730, 6)
    assert officers.directivity is None
    assert officers.height / METRES_PER_FOOT == pytest.approx(40.0)
    assert (officers.roof_word, officers.wall_word) == ("6730", "2040")
    assert feature(finest, 55).height / METRES_PER_FOOT == pytest.approx(85.0)
    assert feature(finest, 87).roof_word is None
    assert [row.number for row in finest.features] == [str(number) for number in range(1, 88)]


def test_notes_say_that_outlines_are_reconstructed(scene: Scene) -> None:
    assert any("reconstructed" in note and "estimates" in note for note in scene.notes)
    assert any("Counting rule" in note for note in scene.notes)


def test_files_are_what_the_generator_writes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(Path(__file__).resolve().parent.parent / "tools"))
    folder = assets_folder() / "scenes" / "hospital"
    for name, text in importlib.import_module("make_hospital_scene").texts().items():
        stored = (folder / name).read_text(encoding="utf-8")
        if not name.endswith(".geojson"):
            assert stored == text
            continue
        here, there = json.loads(stored), json.loads(text)
        assert [row["properties"] for row in here["features"]] == [row["properties"] for row in there["features"]]
        assert here["notes"] == there["notes"]
        for row, again in zip(here["features"], there["features"], strict=True):
            coordinates = (row["geometry"]["coordinates"], again["geometry"]["coordinates"])
            np.testing.assert_allclose(*coordinates, rtol=0.0, atol=2e-9)
