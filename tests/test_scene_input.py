"""Any GeoJSON of footprints with heights is read; what cannot be honoured is refused in one line."""

import json
from collections.abc import Callable
from copy import deepcopy
from pathlib import Path
from typing import Any

import pytest

from sensorsim.errors import InputError
from sensorsim.resources import assets_folder
from sensorsim.scene import Counts, load_scene, scene_names

SQUARE = [[8.0, 50.0], [8.001, 50.0], [8.001, 50.001], [8.0, 50.001], [8.0, 50.0]]
BESIDE = [[[longitude + 0.002, latitude] for longitude, latitude in SQUARE]]
BOWTIE = [SQUARE[0], SQUARE[2], SQUARE[1], SQUARE[3], SQUARE[0]]
COURT = [[8.0004, 50.0004], [8.0006, 50.0004], [8.0006, 50.0006], [8.0004, 50.0006], [8.0004, 50.0004]]

Document = dict[str, Any]


def collection(**properties: object) -> Document:
    row = {
        "type": "Feature",
        "properties": {"height": 9.0} | properties,
        "geometry": {"type": "Polygon", "coordinates": [deepcopy(SQUARE)]},
    }
    return {"type": "FeatureCollection", "features": [row]}


def stored(folder: Path, document: object) -> Path:
    file = folder / "town.geojson"
    file.write_text(json.dumps(document))
    return file


def test_outline_with_a_height_is_enough(tmp_path: Path) -> None:
    scene = load_scene(stored(tmp_path, collection()))
    (row,) = scene.features
    assert (row.number, row.interior, row.roof_word, row.wall_word) == ("1", "heated", None, None)
    assert (row.roof_word_used, row.wall_word_used) == ("6730", "2040")
    assert scene.counts == Counts(features=1, surfaces=6, vertices=8, edges=24)
    assert scene.site.utc_offset == 1.0
    assert [camera.name for camera in scene.cameras] == ["overhead"]
    assert scene.name == "town"


def test_map_export_with_multipolygon_court_quotes_and_min_height_is_read(tmp_path: Path) -> None:
    document = collection(height="12.5", min_height="3", word="2240", building="yes", interior="unheated")
    document["features"][0]["geometry"] = {"type": "MultiPolygon", "coordinates": [[SQUARE, COURT], BESIDE]}
    scene = load_scene(stored(tmp_path, document))
    (row,) = scene.features
    assert [(part.base, part.top, len(part.holes)) for part in row.parts] == [(3.0, 12.5, 1), (3.0, 12.5, 0)]
    assert scene.counts == Counts(features=1, surfaces=16, vertices=24, edges=72)
    assert set(scene.surfaces.word) == {"2240"}
    assert set(scene.surfaces.interior) == {"unheated"}


def test_heights_in_feet_are_metres_inside(tmp_path: Path) -> None:
    document = collection(height_ft=100.0)
    del document["features"][0]["properties"]["height"]
    assert load_scene(stored(tmp_path, document)).features[0].parts[0].top == pytest.approx(30.48)


def test_height_of_zero_is_a_plane(tmp_path: Path) -> None:
    scene = load_scene(stored(tmp_path, collection(height=0, base=0.3)))
    assert scene.counts == Counts(features=1, surfaces=1, vertices=4, edges=4)
    assert (scene.surfaces.role[0], scene.surfaces.word[0], scene.surfaces.interior[0]) == ("plane", "9420", "none")
    assert (scene.mesh.position[:, 2] == 0.3).all()


def test_rows_of_one_number_are_parts_of_one_feature(tmp_path: Path) -> None:
    document = collection(number=7, top=4.0)
    document["features"].append(collection(number=7)["features"][0])
    document["features"][1]["properties"]["base"] = 4.0
    scene = load_scene(stored(tmp_path, document))
    assert [(part.base, part.top) for part in scene.features[0].parts] == [(0.0, 4.0), (4.0, 9.0)]
    assert scene.counts.features == 1


def test_packaged_scene_is_found_by_name() -> None:
    assert scene_names() == ("hospital",)
    assert load_scene("hospital", level="IA").name == "hospital"


def _property(name: str, value: object) -> Callable[[Document], None]:
    def change(document: Document) -> None:
        document["features"][0]["properties"][name] = value

    return change


def _geometry(kind: str, coordinates: object) -> Callable[[Document], None]:
    def change(document: Document) -> None:
        document["features"][0]["geometry"] = {"type": kind, "coordinates": coordinates}

    return change


def _member(name: str, value: object) -> Callable[[Document], None]:
    def change(document: Document) -> None:
        document[name] = value

    return change


def _second(**properties: object) -> Callable[[Document], None]:
    def change(document: Document) -> None:
        document["features"].append(collection(number="7", **properties)["features"][0])

    return change


REFUSED = {
    "polygon crosses itself": (_geometry("Polygon", [BOWTIE]), "coordinates", "Self-intersection", "simple outline"),
    "ring not closed": (_geometry("Polygon", [SQUARE[:-1]]), "coordinates[0]", "50.001", "repeat the first"),
    "two corners": (
        _geometry("Polygon", [[SQUARE[0], SQUARE[1], SQUARE[0]]]),
        "coordinates[0]",
        "8.0",
        "three corners",
    ),
    "no area": (_geometry("Polygon", [[SQUARE[0], SQUARE[1], [8.002, 50.0], SQUARE[0]]]), "coordinates", "", "simple"),
    "position twice": (_geometry("Polygon", [[*SQUARE[:1], *SQUARE]]), "coordinates[0][0]", "8.0", "remove one"),
    "metres for degrees": (_geometry("Polygon", [[[500.0, 4e6], *SQUARE]]), "[0][0]", "4000000.0", "WGS 84"),
    "NaN coordinate": (_geometry("Polygon", [[[float("nan"), 50.0], *SQUARE]]), "[0][0]", "nan", "WGS 84"),
    "text coordinate": (_geometry("Polygon", [[["8", 50.0], *SQUARE]]), "[0][0]", "'8'", "in degrees"),
    "court outside": (_geometry("Polygon", [SQUARE, *BESIDE]), "coordinates", "Hole lies outside", "simple outline"),
    "point": (_geometry("Point", SQUARE[0]), "geometry", "'Point'", "a Polygon or a MultiPolygon"),
    "empty multipolygon": (_geometry("MultiPolygon", []), "coordinates", "[]", "at least one polygon"),
    "missing height": (_property("height", None), "height", "None", "height_ft in feet"),
    "NaN height": (_property("height", float("nan")), "height", "nan", "plain number"),
    "huge height": (_property("height", 10**400), "height", "1000", "plain number"),
    "infinite height": (_property("height", float("inf")), "height", "inf", "plain number"),
    "height with unit": (_property("height", "9 m"), "height", "'9 m'", "plain number"),
    "height true": (_property("height", True), "height", "True", "plain number"),
    "negative height": (_property("height", -1), "height", "-1.0", "0 or more"),
    "height twice": (_property("height_ft", 30), "height and height_ft", "[9.0, 30]", "keep one"),
    "base above top": (_property("base", 10), "top", "9.0", "lower the base"),
    "bad word": (_property("roof_word", "20"), "roof_word", "'20'", "four digits"),
    "word as number": (_property("wall_word", 2040), "wall_word", "2040", "in quotes"),
    "bad interior": (_property("interior", "cosy"), "interior", "'cosy'", "use one of heated, cooled"),
    "bad percentage": (_property("tree_coverage", 130), "tree_coverage", "130.0", "0 to 100"),
    "bad code": (_property("feature_type", 1.5), "feature_type", "1.5", "0, 1, 2"),
    "bad flag": (_property("has_bottom", "no"), "has_bottom", "'no'", "true or false"),
    "bad text": (_property("description", 3), "description", "3", "in quotes"),
    "rows disagree": (_second(interior="open"), "interior", "'open'", "renumber"),
    "plane and solid in one": (_second(top=0.0), "height", "9.0", "numbers of their own"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_bad_feature_is_refused_naming_file_feature_value_and_remedy(tmp_path: Path, case: str) -> None:
    change, entry, value, remedy = REFUSED[case]
    document = collection(number="7")
    change(document)
    file = stored(tmp_path, document)
    with pytest.raises(InputError) as refusal:
        load_scene(file)
    message = str(refusal.value)
    assert message.startswith(f"{file}: feature 7: ")
    assert entry in refusal.value.entry
    assert value in message
    assert remedy in message
    assert "\n" not in message


FILES: dict[str, tuple[str | Callable[[Document], None], str, str]] = {
    "not JSON": ('{"type": ', "line 1", "repair the file"),
    "not a collection": ('{"type": "Feature"}', "type", "export the outlines"),
    "a list": ("[1]", "type", "export the outlines"),
    "empty scene": (_member("features", []), "features", "at least one feature"),
    "no features": (_member("features", None), "features", "at least one feature"),
    "no properties": (_member("features", [3]), "features[0]", "GeoJSON Feature"),
    "other axes": (_member("crs", {"properties": {"name": "EPSG:3857"}}), "crs", "WGS 84"),
    "unknown level": (_member("level", "IV"), "level", "IA, IIA, IIIB"),
    "other level": (_member("level", "IA"), "level", "ask for IA"),
    "bad notes": (_member("notes", "hello"), "notes", "quoted sentences"),
}


@pytest.mark.parametrize("case", FILES)
def test_bad_file_is_refused_in_one_line(tmp_path: Path, case: str) -> None:
    change, entry, remedy = FILES[case]
    document = collection()
    if callable(change):
        change(document)
    file = stored(tmp_path, document)
    if isinstance(change, str):
        file.write_text(change)
    with pytest.raises(InputError) as refusal:
        load_scene(file)
    message = str(refusal.value)
    assert message.startswith(f"{file}: {entry} = ")
    assert remedy in message
    assert "\n" not in message


def test_binary_file_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "town.geojson"
    file.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(InputError, match="not UTF-8 text; save the file as UTF-8"):
        load_scene(file)


@pytest.mark.parametrize(
    "column", ["number", "feature_type", "height_ft", "directivity", "point_dimension_ft", "level"]
)
def test_missing_column_of_a_sheet_is_refused(tmp_path: Path, column: str) -> None:
    document = json.loads((assets_folder() / "scenes" / "hospital" / "hospital_IA.geojson").read_text())
    del document["features"][4]["properties"][column]
    with pytest.raises(InputError, match=f"{column} = None: missing column of the sheet; add it, null where"):
        load_scene(stored(tmp_path, document), level="IA")


@pytest.mark.parametrize(("name", "level", "message"), [
    ("hospital", "IIIA", "hospital: level = 'IIIA': no such level of detail; use one of IA, IIA, IIIB"),
    ("airport", "IA", "airport: scene = 'airport': no such scene or file; use one of hospital or the path"),
])  # fmt: skip
def test_unknown_names_are_refused(name: str, level: str, message: str) -> None:
    with pytest.raises(InputError) as refusal:
        load_scene(name, level=level)
    assert str(refusal.value).startswith(message)


def test_unknown_camera_is_refused() -> None:
    with pytest.raises(InputError, match="camera = 'moon': no such camera; use one of tower, hospital"):
        load_scene("hospital").camera("moon")


@pytest.mark.parametrize(("text", "entry"), [
    ("x = ", "file"),
    ("x = 1", "site"),
    ('[site]\nname = "a"\nlongitude = nan', "site: longitude"),
    ('[site]\nname = "a"\nlongitude = 8\nlatitude = 50\naltitude = 0\nutc_offset = 1', "cameras"),
    ('[site]\nname = "a"\nlongitude = 8\nlatitude = 50\naltitude = 0\nutc_offset = 1\n[cameras.one]\nlongitude = 8',
     "cameras.one: latitude"),
])  # fmt: skip
def test_bad_place_is_refused(tmp_path: Path, text: str, entry: str) -> None:
    (tmp_path / "scene.toml").write_text(text)
    with pytest.raises(InputError) as refusal:
        load_scene(stored(tmp_path, collection()))
    assert refusal.value.entry == entry
    assert "\n" not in str(refusal.value)
