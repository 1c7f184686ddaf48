"""Which outlines stand for which feature at each level of the hospital scene; keys are feature numbers."""

from hospital_scene.layout import (
    APRON_25,
    BLOCK_32,
    COVER_DIAMETER,
    COVER_MIDDLE,
    FOOT,
    HALF_LENGTH,
    HALF_WIDTH,
    HEATING_PLANT,
    HOSPITAL_AT,
    LAWN,
    LOWER,
    OFFICERS,
    OVERPASS,
    OVERPASS_NOTE,
    SOIL,
    TOWER_96,
    TRACK,
    UPPER_L,
    WING_64,
    WOOD_EAST,
    WOOD_NORTH,
    WOOD_WEST,
    FloatArray,
    Piece,
    block,
    disc,
    grove,
    housing_groups,
    notched,
    residential_blocks,
    silos,
    square,
    strip,
)

Outlines = dict[int, list[Piece]]

BASE = Piece(outline=block(-HALF_LENGTH, HALF_LENGTH, -HALF_WIDTH, HALF_WIDTH), layer=0.0)
OVERPASS_PIECE = Piece(outline=OVERPASS, base_ft=20.0, top_ft=35.0, note=OVERPASS_NOTE)
CHURCH_CROSS = [
    (-18, -6), (4, -6), (4, -12), (13, -12), (13, -6), (18, -6),
    (18, 6), (13, 6), (13, 12), (4, 12), (4, 6), (-18, 6),
]  # fmt: skip
KILN = [(1560, 50), (1600, 50), (1600, 56), (1700, 56), (1700, 79), (1600, 79), (1600, 85), (1560, 85)]
KILN_MILL_STORAGE = [
    (1560, 50),
    (1560, 190),
    (1480, 190),
    (1480, 255),
    (1530, 255),
    (1530, 215),
    (1700, 215),
    (1700, 50),
]
SILOS_PACK_HOUSE = [(1470, -190), (1511, -190), (1511, 44), (1489, 44), (1489, -75), (1470, -75)]
TRACKS = [
    (-HALF_LENGTH, 325), (1110, 325), (1446, 280), (1900, 280), (1900, 288),
    (1450, 288), (1160, 325), (HALF_LENGTH, 325), (HALF_LENGTH, 335), (-HALF_LENGTH, 335),
]  # fmt: skip


def solids(*outlines: FloatArray) -> list[Piece]:
    return [Piece(outline=outline) for outline in outlines]


def planes(layer: float, *blocks: tuple[float, float, float, float, int]) -> list[Piece]:
    return [Piece(outline=block(*sides), layer=layer) for sides in blocks]


def hospital(*levels: tuple[tuple[tuple[int, int], ...], float, float, bool]) -> list[Piece]:
    return [
        Piece(outline=square(*HOSPITAL_AT, *corners), base_ft=base, top_ft=top, has_bottom=bottom)
        for corners, base, top, bottom in levels
    ]


def level_ia() -> Outlines:
    middle = square(*HOSPITAL_AT, COVER_MIDDLE)[0]
    u, v = HOSPITAL_AT
    freeway = strip(
        (-HALF_LENGTH, -600.24), (1200, -600.24), (HALF_LENGTH, -445.24),
        (HALF_LENGTH, -414.76), (1200, -569.76), (-HALF_LENGTH, -569.76),
    )  # fmt: skip
    cover = disc(u, v, COVER_DIAMETER, 8) - square(u, v, (0, 0))[0] + middle
    return {
        1: solids(grove(*WOOD_WEST, 10, 1)),
        2: solids(block(-1866, -1394, -140, 40, 4)),
        3: [Piece(outline=cover, note="octagon of 437 ft, the diameter of the convex cover of the outline at IIIB")],
        4: solids(block(-1076, -764, -24, 122, 4)),
        5: solids(disc(-430, 70, 100 * FOOT, 8)),
        6: solids(grove(*WOOD_NORTH, 10, 2)),
        7: solids(notched(-318, 1080, -270, 150, 60, 70, 4)),
        8: solids(notched(64, 1080, 185, 560, 320, 195, 4)),
        9: solids(disc(1600, 30, 600 * FOOT, 8)),
        10: solids(grove(*WOOD_EAST, 9, 3)),
        11: [Piece(outline=freeway, layer=TRACK, note="Route 4, 100 ft wide, along the north-west edge")],
        12: [BASE],
    }  # fmt: skip


def level_iia() -> Outlines:
    return {
        1: solids(grove(*WOOD_WEST, 6, 1)),
        2: solids(block(-1866, -1394, -140, 40)),
        3: solids(OFFICERS),
        4: hospital((LOWER, 0.0, 25.0, True), (UPPER_L, 25.0, 64.0, False)),
        5: solids(block(-1076, -764, -24, 122)),
        6: solids(HEATING_PLANT),
        7: solids(grove(*WOOD_NORTH, 5, 2)),
        8: solids(block(-318, 400, -270, 150)),
        9: solids(block(424, 1080, -270, 150)),
        10: solids(block(64, 1080, 185, 300)),
        11: solids(block(64, 760, 365, 560)),
        12: [OVERPASS_PIECE],
        13: [Piece(outline=strip(*KILN_MILL_STORAGE), note="kiln building, finish mills and rock storage as one")],
        14: [Piece(outline=strip(*SILOS_PACK_HOUSE), note="silos and pack house as one")],
        15: planes(LAWN, (-1990, -1290, -160, 6, 3), (-1990, -1290, 14, 150, 3), (-1250, -700, -255, 150, 3),
                   (-318, 40, 185, 300, 3)),
        16: planes(SOIL, (-1990, -1280, 185, 315, 2), (-1250, -345, 185, 315, 2), (-1990, -1280, 345, 565, 2),
                   (-1250, -345, 345, 565, 2), (-680, -345, -565, 150, 2), (-1990, -1290, -565, -175, 2)),
        17: planes(LAWN, (-1150, -960, 380, 530, 3)),
        18: planes(LAWN, (-1240, -690, -565, -280, 3)),
        19: planes(LAWN, (-318, 40, 345, 565, 3)),
        20: planes(SOIL, (1104, 1318, -270, 315, 2), (1342, 1990, -270, 315, 2), (784, 1318, 345, 565, 2),
                   (1342, 1990, 345, 565, 2), (-318, 1290, -565, -290, 2)),
        21: [BASE],
    }  # fmt: skip


def cement_plant() -> Outlines:
    """Features 44-54. The sheet has 85 ft for all; heights of the lower and slender ones are estimates."""
    outlines = {
        44: (silos(), 110.0),
        45: (block(1470, 1500, -190, -135), 85.0),
        46: (block(1480, 1560, -125, -75), 45.0),
        47: (disc(1720, -20, 14, 12), 120.0),
        48: (disc(1640, 115, 6, 12), 200.0),
        49: (block(1580, 1610, 92, 108), 60.0),
        50: (strip(*KILN), 85.0),
        51: (block(1480, 1530, 190, 255), 85.0),
        52: (block(1570, 1690, 130, 215), 70.0),
        53: (notched(1425, 1445, 60, 110, 8, 20), 30.0),
        54: (notched(1425, 1447, 120, 165, 10, 15), 30.0),
    }
    note = "height of its own, estimate; the sheet has 85 ft for all of 44-55"
    return {
        number: [Piece(outline=outline, top_ft=top, note="" if top == 85.0 else note)]
        for number, (outline, top) in outlines.items()
    }


def woods() -> list[FloatArray]:
    return [
        grove(-1940, 100, 35, 35, 12, 0), grove(-1190, -190, 40, 18, 12, 1), grove(*WOOD_WEST, 12, 1),
        grove(*WOOD_NORTH, 12, 2), grove(-1400, 245, 100, 45, 12, 4), grove(-500, 450, 90, 60, 12, 5),
        grove(*WOOD_EAST, 12, 3),
    ]  # fmt: skip


def level_iiib() -> Outlines:
    groups = dict(zip([*range(1, 23), *range(25, 40)], housing_groups(), strict=True))
    return {
        **{number: solids(outline) for number, outline in groups.items()},
        23: solids(OFFICERS),
        24: hospital((TOWER_96, 0.0, 96.0, True), (WING_64, 0.0, 64.0, True), (BLOCK_32, 0.0, 32.0, True),
                     (APRON_25, 0.0, 25.0, True)),
        40: solids(HEATING_PLANT),
        41: solids(block(-300, -284, 198, 216)),
        42: solids(strip(*[(-250 + u, 225 + v) for u, v in CHURCH_CROSS])),
        43: [OVERPASS_PIECE],
        **cement_plant(),
        55: [Piece(outline=strip(*TRACKS), layer=TRACK, note="main line and the plant's siding")],
        **{56 + index: solids(outline) for index, outline in enumerate(woods())},
        **{63 + index: solids(outline) for index, outline in enumerate(residential_blocks())},
        76: planes(LAWN, (-1990, -1290, -160, -114, 3), (-1990, -1290, -106, 6, 3)),
        77: planes(LAWN, (-1990, -1290, 14, 150, 3)),
        78: planes(LAWN, (-1250, -700, -255, -5, 3)),
        79: planes(LAWN, (-1250, -700, 11, 89, 3)),
        80: planes(LAWN, (-1250, -700, 97, 150, 3), (-318, 40, 185, 300, 3)),
        81: planes(SOIL, (-1990, -345, 185, 315, 3)),
        82: planes(SOIL, (-1990, -345, 345, 565, 3)),
        83: planes(LAWN, (-1240, -690, -565, -280, 3)),
        84: planes(SOIL, (-680, -345, -565, 150, 3)),
        85: planes(SOIL, (1104, 1318, -270, 315, 4), (1342, 1990, -270, 315, 4), (784, 1990, 345, 565, 4)),
        86: planes(SOIL, (-1990, -1290, -565, -175, 4), (-318, 1290, -565, -290, 4)),
        87: [BASE],
    }  # fmt: skip
