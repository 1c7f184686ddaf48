"""Construction classes: complete and sourced, sections that the thermal model can solve, wrong files refused."""

from pathlib import Path

import pytest

from sensorsim.errors import InputError
from sensorsim.materials import ENCLOSED, ConstructionClass, Room, load_catalogue
from sensorsim.thermal import transmittance

BUILDINGS = ("wood_frame", "masonry", "metal", "concrete", "curtain_wall")
GROUNDS = ("bare_soil", "sand", "grass", "meadow", "deciduous_trees", "coniferous_trees", "water")
PAVEMENTS = ("asphalt_pavement", "concrete_pavement")
ROLES = ("wall", "roof", "bottom", "plane")

MATERIAL = """
[[material]]
code = 70
name = "mud"
group = "mine"
solar_absorptance = 0.6
emissivity = 0.9
reflectance_nir = 0.4
roughness = "rough"
characteristic_length = 5.0
construction = { description = "a heap", estimate = "mine" }
layer = [{ name = "mud", thickness = 0.3, conductivity = 0.8, density = 1700, specific_heat = 900 }]
"""
CLASS = """
[[class]]
name = "heap"
group = "ground"
description = "mud"
interior = "none"
surface = { material = 70, estimate = "mine" }
"""
HOUSE = """
[[class]]
name = "house"
group = "building"
description = "all of mud"
interior = "heated"
wall = { material = 70, construction = "brick", reflectance = 0.305, estimate = "mine" }
roof = { material = 70, estimate = "mine" }
window = { material = 70, estimate = "mine" }
floor = { material = 70, estimate = "mine" }
room = { loss_coefficient = 2.0, time_constant = 1000.0 }
"""


def _catalogue(folder: Path, classes: str) -> dict[str, ConstructionClass]:
    (folder / "mine.toml").write_text(MATERIAL, encoding="utf-8")
    (folder / "classes.toml").write_text(classes, encoding="utf-8")
    return dict(load_catalogue(folder).classes)


def test_classes_are_those_of_buildings_grounds_and_pavements() -> None:
    classes = load_catalogue().classes
    assert tuple(classes) == (*BUILDINGS, *GROUNDS, *PAVEMENTS)
    groups = {name: known.group for name, known in classes.items()}
    assert groups == dict.fromkeys(BUILDINGS, "building") | dict.fromkeys(GROUNDS, "ground") | dict.fromkeys(
        PAVEMENTS, "pavement"
    )


def test_every_section_of_every_class_is_a_wall_type_that_can_be_solved() -> None:
    catalogue = load_catalogue()
    for name, known in catalogue.classes.items():
        for role in ROLES:
            section = known.section_of(role)
            wall = catalogue.wall_type(section.word.code, known.interior, section=section, room=known.room)
            assert transmittance(wall, 0.04, 0.13) > 0.0, name
            assert 0.0 <= section.word.reflectance <= 1.0
            assert hash(wall) == hash(wall)


def test_every_section_says_why() -> None:
    for known in load_catalogue().classes.values():
        assert known.description
        for section in known.sections.values():
            assert section.reason != "unsourced"
            assert len(section.reason) > 10


def test_ground_has_the_same_surface_whichever_way_it_faces_and_no_room() -> None:
    classes = load_catalogue().classes
    for name in (*GROUNDS, *PAVEMENTS):
        assert len({id(classes[name].section_of(role)) for role in ROLES}) == 1
        assert classes[name].interior == "none"


def test_buildings_have_walls_roofs_windows_and_floors_of_their_own() -> None:
    classes = load_catalogue().classes
    for name in BUILDINGS:
        assert set(classes[name].sections) == {"wall", "roof", "window", "floor"}
        assert classes[name].section_of("roof").word != classes[name].section_of("wall").word
        assert classes[name].section_of("plane") is classes[name].section_of("roof")
        assert classes[name].section_of("bottom") is classes[name].sections["floor"]
        assert classes[name].interior in ENCLOSED


def test_sections_reflect_as_their_materials_do() -> None:
    catalogue = load_catalogue()
    for known in catalogue.classes.values():
        for section in known.sections.values():
            own = catalogue.material(section.word.code).solar_reflectance
            assert section.word.reflectance == pytest.approx(own, abs=0.005 + 1e-9)


def test_rooms_are_as_their_envelopes_say() -> None:
    """The hall of bare sheet forgets a night within hours and loses most; a concrete building remembers for a day."""
    rooms = {name: load_catalogue().classes[name].room for name in BUILDINGS}
    losses = sorted(BUILDINGS, key=lambda name: rooms[name].loss_coefficient)
    times = sorted(BUILDINGS, key=lambda name: rooms[name].time_constant)
    assert (losses[-1], times[0], times[-1]) == ("metal", "metal", "concrete")
    capacity = {name: room.loss_coefficient * room.time_constant / 1e3 for name, room in rooms.items()}
    expected = {"metal": 80.0, "wood_frame": 110.0, "curtain_wall": 165.0, "masonry": 260.0, "concrete": 370.0}
    assert capacity == {name: pytest.approx(value, rel=0.01) for name, value in expected.items()}


def test_wood_frame_has_the_reports_insulated_wall_with_studs() -> None:
    catalogue = load_catalogue()
    section = catalogue.construction_class("wood_frame").section_of("wall")
    wall = catalogue.wall_type(section.word.code, "heated", section=section)
    assert wall.paths == catalogue.constructions["insulated_wood_studs"].paths
    assert wall.emissivity == catalogue.material(5).emissivity.value
    assert wall.name == "Lapped wood siding (Insulated wood wall with studs)"


def test_ones_own_classes_take_words_rooms_and_constructions(tmp_path: Path) -> None:
    classes = _catalogue(tmp_path, CLASS + HOUSE)
    assert classes["house"].section_of("wall").word.text in ("7030", "7031")
    assert classes["house"].section_of("roof").word.text == "7040"
    construction = classes["house"].section_of("wall").construction
    assert construction is not None
    assert construction.name == "Brick wall"
    assert classes["house"].room == Room(loss_coefficient=2.0, time_constant=1000.0)
    assert classes["heap"].room == Room()


def test_a_folder_without_classes_has_none(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(MATERIAL, encoding="utf-8")
    catalogue = load_catalogue(tmp_path)
    assert dict(catalogue.classes) == {}
    with pytest.raises(InputError, match=r"construction_class = 'masonry': no such .*add classes\.toml"):
        catalogue.construction_class("masonry")


def test_unknown_class_is_told_with_all_that_are_known() -> None:
    with pytest.raises(InputError) as caught:
        load_catalogue().construction_class("straw")
    told = str(caught.value)
    assert "construction_class = 'straw': no such construction class; use one of wood_frame, masonry, metal" in told
    assert all(name in told for name in (*BUILDINGS, *GROUNDS, *PAVEMENTS))
    assert "\n" not in told


WRONG = {
    "group": (CLASS.replace('"ground"', '"sea"'), "group = 'sea': not a word of the list; use one of building"),
    "material": (CLASS.replace("70", "71"), "class heap surface material = 71: not a code of the catalogue"),
    "interior": (CLASS.replace('"none"', '"cosy"'), "class heap interior = 'cosy': not a word of the list"),
    "no surface": (CLASS.replace("surface", "#"), "class heap surface = None: missing or not a table"),
    "no roof": (HOUSE.replace("roof", "#"), "class house roof = None: missing or not a table"),
    "construction": (HOUSE.replace('"brick"', '"straw"'), "wall construction = 'straw': no such construction; use one"),
    "reflectance": (HOUSE.replace("0.305", "1.5"), "wall reflectance = 1.5: not a number from 0 to 1"),
    "room": (HOUSE.replace("1000.0", "0.0"), "room time_constant = 0.0: not a number above 0"),
    "misspelt": (CLASS.replace("description", "descripton"), "descripton = 'mud': unknown key"),
    "twice": (CLASS + CLASS, "name = 'heap': class given twice"),
    "ground with a roof": (CLASS + "roof = { material = 70 }\n", "class heap roof = {'material': 70}: unknown key"),
}


@pytest.mark.parametrize(("text", "message"), WRONG.values(), ids=WRONG.keys())
def test_a_wrong_file_gets_one_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        _catalogue(tmp_path, text)
    told = str(caught.value)
    assert told.startswith(str(tmp_path / "classes.toml"))
    assert message in told
    assert "\n" not in told


@pytest.mark.parametrize("interior", ["open", "none"])
def test_a_gain_without_enclosed_air_is_refused(interior: str) -> None:
    with pytest.raises(InputError, match=rf"heat_gain = 20.0: no enclosed air to warm: interior '{interior}'"):
        load_catalogue().wall_type(20, interior, heat_gain=20.0)


@pytest.mark.parametrize("gain", [-1.0, float("nan"), float("inf")])
def test_a_gain_that_is_no_amount_is_refused(gain: float) -> None:
    with pytest.raises(InputError, match=r"heat_gain = .*: not a number of 0 or more"):
        load_catalogue().wall_type(20, "heated", heat_gain=gain)
