"""GeoJSON of footprints to features: the one road for the hospital's sheets and for any file of outlines with heights.

Required per feature: a Polygon or MultiPolygon and `height` [m] or `height_ft`. Everything else has a default:

    number                         its place in the file; features of one number are parts of one feature
    base or min_height (or _ft)    0 m
    top (or _ft)                   the height; where height is 0 or top equals base, a plane at the base
    has_bottom                     true for solids
    construction_class             none; with one, surfaces without a word get the sections of that class
    word, or roof_word, wall_word  6730 (built-up roof) and 2040 (brick) for solids, 9420 (cut grass) for planes
    interior                       that of the construction class; else heated for solids, none for planes
    heat_gain                      0 W per m2 of floor

A file with the top-level member `level` is a feature analysis sheet: there every column A to K must be present,
null where the sheet has a dash, so that a lost column is told and not guessed.
"""

import json
from dataclasses import replace
from pathlib import Path

from sensorsim.errors import InputError
from sensorsim.scene.entry import Entry
from sensorsim.scene.features import INTERIORS, Feature, Interior, Part
from sensorsim.scene.rings import read_rings

SHEET_COLUMNS = (
    "number",
    "feature_type",
    "surface_material",
    "height_ft",
    "number_of_structures",
    "tree_coverage",
    "roof_coverage",
    "feature_id",
    "directivity",
    "point_dimension_ft",
    "level",
)  # columns A to K of figures 3, 5 and 7 [Report1978]

DEFAULT_ROOF_WORD = "6730"
DEFAULT_WALL_WORD = "2040"
DEFAULT_PLANE_WORD = "9420"

_LONGITUDE_LATITUDE_CRS = ("CRS84", "EPSG::4326", "EPSG:4326")


def read_collection(file: Path) -> dict[str, object]:
    """The GeoJSON FeatureCollection in a file, its members not yet checked."""
    try:
        document = json.loads(file.read_text(encoding="utf-8"))
    except OSError as problem:
        reason = problem.strerror or "cannot be read"
        raise InputError(file, "file", file.name, reason, "give the path of a GeoJSON file") from problem
    except UnicodeDecodeError as problem:
        raise InputError(file, "byte", problem.start, "not UTF-8 text", "save the file as UTF-8") from problem
    except json.JSONDecodeError as problem:
        raise InputError(file, f"line {problem.lineno}", problem.msg, "not JSON", "repair the file there") from problem
    kind = document.get("type") if isinstance(document, dict) else document
    if not isinstance(document, dict) or kind != "FeatureCollection":
        raise InputError(file, "type", kind, "not a GeoJSON FeatureCollection", "export the outlines as one")
    if (crs := document.get("crs")) is not None and not any(name in str(crs) for name in _LONGITUDE_LATITUDE_CRS):
        raise InputError(file, "crs", crs, "not longitude and latitude", "reproject the file to WGS 84 (EPSG:4326)")
    return document


def read_features(file: Path, document: dict[str, object]) -> tuple[Feature, ...]:
    """Features of a collection in file order; rows of one number are joined as parts of one feature."""
    rows = document.get("features")
    if not isinstance(rows, list) or not rows:
        raise InputError(file, "features", rows, "the scene is empty", "give at least one feature with an outline")
    sheet = document.get("level") is not None
    joined: dict[str, Feature] = {}
    for index, row in enumerate(rows):
        feature = _read_row(file, index, row, sheet=sheet)
        known = joined.get(feature.number)
        joined[feature.number] = feature if known is None else _join(file, known, feature)
    return tuple(joined.values())


def _read_row(file: Path, index: int, row: object, *, sheet: bool) -> Feature:
    properties = row.get("properties") if isinstance(row, dict) else None
    if not isinstance(row, dict) or not isinstance(properties, dict):
        raise InputError(file, f"features[{index}]", row, "not a feature with properties", "give a GeoJSON Feature")
    number = properties.get("number")
    name = str(index + 1) if number is None else str(number)
    label = f"feature at index {index}" if number is None else f"feature {name}"
    entry = Entry(file=file, label=label, properties=properties)
    for column in SHEET_COLUMNS if sheet else ():
        if column not in properties:
            entry.refuse(column, None, "missing column of the sheet", "add it, null where the sheet has a dash")
    return _feature(entry, name, row.get("geometry"))


def _feature(entry: Entry, name: str, geometry: object) -> Feature:
    parts, height = _parts(entry, geometry)
    is_plane = parts[0].is_plane
    roof_word, wall_word = entry.word("roof_word"), entry.word("wall_word")
    roof_default, wall_default = _default_words(entry, is_plane)
    return Feature(
        number=name,
        description=entry.text("description"),
        feature_type=entry.whole("feature_type"),
        surface_material=entry.whole("surface_material"),
        height=height,
        number_of_structures=entry.whole("number_of_structures"),
        tree_coverage=entry.percent("tree_coverage"),
        roof_coverage=entry.percent("roof_coverage"),
        feature_id=entry.whole("feature_id"),
        directivity=entry.whole("directivity"),
        point_dimension=entry.length("point_dimension"),
        level=entry.whole("level"),
        roof_word=roof_word,
        wall_word=wall_word,
        roof_word_used=entry.word("roof_word_used") or roof_word or roof_default,
        wall_word_used=entry.word("wall_word_used") or wall_word or wall_default,
        word_note=entry.text("word_note"),
        interior=_interior(entry, is_plane),
        interior_note=entry.text("interior_note"),
        note=entry.text("note"),
        parts=parts,
        construction_class=entry.text("construction_class") or None,
        interior_stated=bool(entry.text("interior")),
        heat_gain=_heat_gain(entry),
    )


def _default_words(entry: Entry, is_plane: bool) -> tuple[str, str]:
    """Words of roof and walls that have none of their own; empty where the construction class is to say."""
    if (either := entry.word("word")) is not None:
        return either, either
    if entry.text("construction_class"):
        return "", ""
    return (DEFAULT_PLANE_WORD, DEFAULT_PLANE_WORD) if is_plane else (DEFAULT_ROOF_WORD, DEFAULT_WALL_WORD)


def _heat_gain(entry: Entry) -> float:
    value = entry.real("heat_gain") or 0.0
    if value < 0.0:
        entry.refuse("heat_gain", value, "below 0", "give watts per square metre of floor")
    return value


def _interior(entry: Entry, is_plane: bool) -> Interior:
    value = entry.text("interior") or ("none" if is_plane else "heated")
    for interior in INTERIORS:
        if value == interior:
            return interior
    entry.refuse("interior", value, "no such interior condition", f"use one of {', '.join(INTERIORS)}")


def _parts(entry: Entry, geometry: object) -> tuple[tuple[Part, ...], float]:
    """The row's parts, one per polygon, and its predominant height [m]."""
    height = entry.length("height")
    if height is None:
        entry.refuse("height", None, "missing column", "give height in metres or height_ft in feet")
    if height < 0.0:
        entry.refuse("height", height, "below the ground", "give a height of 0 or more; 0 makes a plane")
    base = entry.length("base", "min_height") or 0.0
    given_top = entry.length("top")
    top = given_top if given_top is not None else (height or base)
    if base < 0.0:
        entry.refuse("base", base, "below the ground", "give a base of 0 m or more")
    if top < base or (top == base and height > 0.0 and given_top is None):
        entry.refuse("top", top, f"not above the base of {base:g} m", "raise the top (or height) or lower the base")
    has_bottom = entry.flag("has_bottom", default=True) and top > base
    rings = read_rings(entry, geometry)
    parts = tuple(
        Part(footprint=loops[0], holes=loops[1:], base=base, top=top, has_bottom=has_bottom) for loops in rings
    )
    return parts, height


def _join(file: Path, known: Feature, more: Feature) -> Feature:
    """The feature with the parts of another row of its number, which must agree in all else but its own note."""
    if known.parts[0].is_plane != more.parts[0].is_plane:
        problem = "another row of this number is a plane" if known.parts[0].is_plane else "another row is a solid"
        raise InputError(
            file, f"feature {more.number}: height", more.height, problem, "give the rows numbers of their own"
        )
    for column in Feature.__slots__:
        if column in ("parts", "note"):
            continue
        here, there = getattr(known, column), getattr(more, column)
        if here != there:
            problem = f"another row of this number has {here!r}"
            raise InputError(
                file, f"feature {more.number}: {column}", there, problem, "make the rows agree or renumber"
            )
    note = "; ".join(dict.fromkeys(text for text in (known.note, more.note) if text))
    return replace(known, parts=known.parts + more.parts, note=note)
