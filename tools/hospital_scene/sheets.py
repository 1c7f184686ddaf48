"""Figures 3, 5, 7 and 10 of [Report1978] as printed, and the readings chosen where figure 10 is unclear."""

from dataclasses import dataclass

COLUMNS = (
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
)  # B to K

# Description | A | B C D E F G H I J K
SHEETS = {
    "IA": """
        Trees | 1 | 2 5 40 1 80 5 907 - - 1
        Cluster of family houses | 2 | 2 4 25 11 30 30 730 - - 1
        Hospital | 3 | 0 3 65 - 0 100 730 - - 1
        Cluster of family houses | 4 | 2 4 25 11 30 30 730 - - 1
        Steam plant | 5 | 0 3 55 - 0 100 120 - 100 1
        Trees | 6 | 2 5 40 1 80 5 907 - - 1
        Residential area | 7-8 | 2 4 25 11 30 30 400 - - 1
        Cement plant | 9 | 0 3 70 - 0 100 120 - 600 1
        Trees | 10 | 2 5 40 1 80 5 907 - - 1
        Freeway | 11 | 1 6 0 - 0 0 230 - 100 1
        Normal soil | 12 | 2 10 0 1 10 5 904 - - 1
    """,
    "IIA": """
        Trees | 1 | 2 5 40 1 80 5 907 - - 3
        Cluster of family houses | 2 | 2 4 25 11 30 30 730 - - 3
        Officers housing | 3 | 2 3 40 13 0 100 730 - - 3
        Hospital | 4 | 2 3 65 13 0 100 730 - - 3
        Cluster of family houses | 5 | 2 4 25 11 30 30 730 - - 3
        Heating plant | 6 | 2 3 55 13 0 100 120 - - 3
        Trees | 7 | 2 5 40 1 80 5 907 - - 3
        Residential area | 8-11 | 2 4 25 11 30 30 400 - - 3
        Bridge | 12 | 2 3 35 0 0 0 260 - - 3
        Cement plant | 13-14 | 2 3 85 13 0 100 120 - - 3
        Grass | 15 | 0 10 0 0 10 5 904 - - 3
        Normal soil | 16 | 0 0 0 1 10 5 904 - - 3
        Athletic field | 17 | 0 10 0 0 0 0 220 - - 3
        Park | 18 | 0 10 0 1 30 1 300 - - 3
        Shopping center | 19 | 0 3 0 1 0 0 310 - - 3
        Normal soil | 20 | 2 10 0 1 10 5 904 - - 3
        Streets | 21 | 2 6 0 0 0 0 200 - - 3
    """,
    "IIIB": """
        Family housing | 1-22,25-39 | 2 4 25 11 30 30 730 - - 6
        Officers housing | 23 | 2 3 40 13 0 100 730 - - 6
        Hospital | 24 | 2 3 65 13 0 100 730 - - 6
        Heating plant | 40 | 2 3 55 13 0 100 120 - - 6
        Service station | 41 | 2 4 25 10 0 100 300 - - 6
        Church | 42 | 2 4 25 10 0 100 620 - - 6
        Bridge | 43 | 2 3 35 0 0 0 260 - - 6
        Cement plant | 44-54 | 2 3 85 13 0 100 120 - - 6
        Cement plant railroad tracks | 55 | 2 3 85 13 0 100 120 - - 6
        Trees | 56-62 | 2 5 40 1 0 5 907 - - 6
        Residential blocks | 63-75 | 2 4 25 11 30 30 400 - - 6
        Grass | 76-80 | 2 10 0 0 10 5 904 - - 6
        Park | 83 | 2 10 0 0 30 1 900 - - 6
        Bare ground | 81-82,84-86 | 2 10 0 1 10 5 904 - - 6
        Streets and roads | 87 | 2 6 0 0 0 0 200 - - 6
    """,
}  # fmt: skip

NATURAL = "word 33 is figure 9's homogeneous block 'natural', where IIA and IIIB have 96 for trees; kept as printed"
NOT_IN_9 = "figure 9 has no material 34 or 36; kept as printed, its reading stands beside the materials"
NINE_TWICE = (
    "figure 10 names 9 in two rows, residential 3030/3630 and industrial 3230/3238; by figure 3 it is the cement plant"
)
TWELVE_TWICE = (
    "figure 10 names 12 in two rows, bridge and cement plant 12-14; both have 3230/3238, so nothing hangs on it"
)
LEFT_OUT = "figure 10 does not list this feature; "

# A | roof printed | wall printed | roof used | wall used | note
WORDS: dict[str, tuple[tuple[str, str | None, str | None, str, str, str], ...]] = {
    "IA": (
        ("1,6,10", "3314", "3310", "3314", "3310", NATURAL),
        ("2,4,7-8", "3030", "3630", "3030", "3630", NOT_IN_9),
        ("3", "3430", "3434", "3430", "3434", NOT_IN_9),
        ("5", "3230", "3238", "3230", "3238", ""),
        ("9", "3230", "3238", "3230", "3238", NINE_TWICE),
        ("11", "8038", "8038", "8038", "8038", ""),
        ("12", None, None, "3320", "3320", LEFT_OUT + "3320 is its word for terrain at IIA"),
    ),
    "IIA": (
        ("1,7", "9614", "9610", "9614", "9610", ""),
        ("2,5,8", "3030", "3030", "3030", "3030", ""),
        ("9-11", None, None, "3030", "3030", LEFT_OUT + "figure 5 has the same columns for 8 to 11, so 8's words hold"),
        ("3", "3130", "3130", "3130", "3130", ""),
        ("4", "3430", "3430", "3430", "3430", NOT_IN_9),
        ("6", "3230", "3245", "3230", "3245", ""),
        ("12", "3230", "3238", "3230", "3238", TWELVE_TWICE),
        ("13-14", "3230", "3238", "3230", "3238", ""),
        ("15-20", "3320", "3320", "3320", "3320", ""),
        ("21", "8038", "8038", "8038", "8038", ""),
    ),
    "IIIB": (
        ("1-22,25-39", "5030", "2040", "5030", "2040", ""),
        ("23", "6730", "2040", "6730", "2040", ""),
        ("24", "6730", "2636", "6730", "2636", ""),
        ("40", "6730", "2245", "6730", "2245", ""),
        ("41", "6730", "1040", "6730", "1040", ""),
        ("42", "5030", "2060", "5030", "2060", ""),
        ("43", "8038", "1230", "8038", "1230", ""),
        ("44", "1230", "2530", "1230", "2530", ""),
        ("45-46", "6730", "2240", "6730", "2240", ""),
        ("47", "1230", "1230", "1230", "1230", ""),
        ("48", "2000", "2040", "2000", "2040", "0 % reflectance is read as the open, black mouth of the stack"),
        ("49", "6730", "2040", "6730", "2040", ""),
        ("50", "6730", "2640", "6730", "2640", ""),
        ("51", "0930", "0940", "0930", "0940", ""),
        ("52", "1220", "1210", "1220", "1210", ""),
        ("53-54", "6730", "2025", "6730", "2025", ""),
        ("55", "1220", "1220", "1220", "1220", ""),
        ("56-62", "9614", "9610", "9614", "9610", ""),
        ("63-75", "3040", "3040", "3040", "3040", ""),
        ("76-80", "9420", "9420", "9420", "9420", ""),
        ("83", "9523", "9523", "9523", "9523", ""),
        ("81-82,84-86", None, None, "9020", "9020",
         LEFT_OUT + "bare earth is 90 in figure 9, with the 20 % of grass here and of terrain at IIA"),
        ("87", None, None, "8038", "8038", LEFT_OUT + "8038 is its word for roads at IA and IIA"),
    ),
}  # fmt: skip

UNDER_BRIDGE = "a deck with outdoor air below it"
HALL = "an industrial hall whose machines keep it warm"
INTERIORS: dict[str, tuple[tuple[str, str, str], ...]] = {
    "IA": (
        ("1,6,10-12", "none", "no room behind the surface"),
        ("2,4,7-8", "heated", "dwellings"),
        ("3", "heated", "hospital"),
        ("5,9", "heated", HALL),
    ),
    "IIA": (
        ("1,7,15-21", "none", "no room behind the surface"),
        ("12", "open", UNDER_BRIDGE),
        ("2-3,5,8-11", "heated", "dwellings"),
        ("4", "heated", "hospital"),
        ("6,13-14", "heated", HALL),
    ),
    "IIIB": (
        ("1-23,25-39,63-75", "heated", "dwellings"),
        ("24", "heated", "hospital"),
        ("40,45,50-51", "heated", HALL),
        ("41-42,53-54", "heated", "occupied building"),
        ("44,46", "unheated", "storage, enclosed"),
        ("47", "unheated", "a tank; its water is not modelled"),
        ("48-49", "heated", "flue gas keeps the casing warm; heated air is the nearest condition"),
        ("52", "open", "one wall is missing [Report1978, 2.2.3]"),
        ("43", "open", UNDER_BRIDGE),
        ("55-62,76-87", "none", "no room behind the surface"),
    ),
}
STRUCTURES = {
    44: "silos",
    45: "pack house",
    46: "warehouse",
    47: "water tower",
    48: "smokestack",
    49: "precipitator",
    50: "kiln building",
    51: "finish mills",
    52: "rock storage",
    53: "laboratories and offices",
    54: "shop and stores",
}  # names of the cement plant's parts at IIIB, from the text of 2.2.3 and figure 10


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """One row of a sheet."""

    number: int
    description: str
    columns: dict[str, int | None]


def numbers(listed: str) -> list[int]:
    """The numbers of a list such as '1-22,25'."""
    result: list[int] = []
    for item in listed.split(","):
        first, _, last = item.partition("-")
        result.extend(range(int(first), int(last or first) + 1))
    return result


def rows(level: str) -> list[Row]:
    """All rows of a level's sheet, by number."""
    result: list[Row] = []
    for line in SHEETS[level].strip().splitlines():
        description, listed, values = (cell.strip() for cell in line.split("|"))
        columns = {
            name: None if value == "-" else int(value) for name, value in zip(COLUMNS, values.split(), strict=True)
        }
        for number in numbers(listed):
            name = f"{description}, {STRUCTURES[number]}" if level == "IIIB" and number in STRUCTURES else description
            result.append(Row(number=number, description=name, columns=columns))
    return sorted(result, key=lambda row: row.number)
