"""Write assets/scenes/hospital from the reconstruction in tools/hospital_scene."""

import json
import sys
from pathlib import Path

import numpy as np
from hospital_scene import sheets
from hospital_scene.layout import FloatArray, Piece, local
from hospital_scene.levels import Outlines, level_ia, level_iia, level_iiib
from hospital_scene.notes import LEVEL_NOTES, NOTES
from shapely.geometry import Polygon
from shapely.geometry.polygon import orient

from sensorsim.scene import LocalFrame

SITE = LocalFrame(longitude=-84.02, latitude=39.82)
DIGITS = 9  # of a degree: 0.1 mm
FOLDER = Path(__file__).resolve().parent.parent / "assets" / "scenes" / "hospital"

# name: u, v, altitude; target u, v, altitude [m]; horizontal field of view [deg]; note
CAMERAS = {
    "tower": (
        (-2311.68, -40.0, 48.0), (-1254.8, -30.8, 0.0), 15.0,
        ("The tower of the Avionics Laboratory, as in the report. Its place 300 m south-west of the strip, its height "
        "and the field of view are estimates, chosen so that houses, hospital and cement plant are all in frame."),
    ),
    "hospital": ((-1165.0, -150.0, 35.0), (-930.0, -135.0, 12.0), 36.0, "The hospital's south and west walls."),
    "cement_plant": ((600.0, 10.0, 70.0), (1500.0, 120.0, 25.0), 44.0, "South-west walls, the overpass at the right."),
    "overhead": ((-4300.0, 0.0, 2200.0), (-710.0, 0.0, 0.0), 37.0, "All of the strip, from the air."),
}  # fmt: skip


def degrees(outline: FloatArray) -> list[list[float]]:
    """Closed counter-clockwise ring in longitude and latitude [deg]."""
    wound = np.array(orient(Polygon(outline)).exterior.coords)
    return SITE.degrees_from_metres(wound).round(DIGITS).tolist()


def lookup(table: tuple[tuple[str, ...], ...], number: int) -> tuple:
    """The cells of the one table row whose list of numbers holds the number."""
    (cells,) = (row[1:] for row in table if number in sheets.numbers(row[0]))
    return cells


def geojson_feature(level: str, row: sheets.Row, piece: Piece) -> dict[str, object]:
    roof, wall, roof_used, wall_used, word_note = lookup(sheets.WORDS[level], row.number)
    interior, interior_note = lookup(sheets.INTERIORS[level], row.number)
    heights = {"base": piece.layer, "top": piece.layer} if piece.layer is not None else {}
    heights |= {"base_ft": piece.base_ft, "top_ft": piece.top_ft}
    properties = {
        "number": str(row.number),
        "description": row.description,
        **row.columns,
        **{name: value for name, value in heights.items() if value is not None},
        **({} if piece.has_bottom else {"has_bottom": False}),
        "roof_word": roof,
        "wall_word": wall,
        "roof_word_used": roof_used,
        "wall_word_used": wall_used,
        "word_note": word_note,
        "interior": interior,
        "interior_note": interior_note,
        "note": piece.note,
    }
    geometry = {"type": "Polygon", "coordinates": [degrees(piece.outline)]}
    return {"type": "Feature", "properties": properties, "geometry": geometry}


def level_text(level: str, outlines: Outlines) -> str:
    features = [
        geojson_feature(level, row, piece) for row in sheets.rows(level) for piece in outlines[row.number]
    ]  # fmt: skip
    head = {"type": "FeatureCollection", "name": f"hospital_{level}", "level": level}
    notes = json.dumps([*NOTES, *LEVEL_NOTES[level]], indent=1)
    lines = ",\n".join(json.dumps(feature) for feature in features)
    return f'{json.dumps(head)[:-1]},\n"notes": {notes},\n"features": [\n{lines}\n]}}\n'


def place_text() -> str:
    lines = [
        "# Where the hospital scene is and from where it is looked at. Altitudes of cameras are above its ground.",
        "",
        "[site]",
        'name = "Fairborn, Ohio"',
        f"longitude = {SITE.longitude}  # origin of local metres: middle of the strip",
        f"latitude = {SITE.latitude}",
        "altitude = 255.0  # estimate: the town's ground lies near 250 to 260 m",
        "utc_offset = -5.0  # Eastern Standard Time",
    ]
    for name, (place, target, view, note) in CAMERAS.items():
        lines += ["", f"[cameras.{name}]"]
        for prefix, (u, v, altitude) in (("", place), ("target_", target)):
            longitude, latitude = SITE.degrees_from_metres(np.array([local(u, v)]))[0].round(7).tolist()
            lines += [
                f"{prefix}longitude = {longitude}",
                f"{prefix}latitude = {latitude}",
                f"{prefix}altitude = {altitude}",
            ]
        lines += [f"horizontal_field_of_view = {view}", f"note = {json.dumps(note)}"]
    return "\n".join(lines) + "\n"


def texts() -> dict[str, str]:
    """The folder's files by name."""
    levels = {"IA": level_ia(), "IIA": level_iia(), "IIIB": level_iiib()}
    files = {f"hospital_{level}.geojson": level_text(level, outlines) for level, outlines in levels.items()}
    return files | {"scene.toml": place_text()}


def main() -> int:
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name, text in texts().items():
        (FOLDER / name).write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
