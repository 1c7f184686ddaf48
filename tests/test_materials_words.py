"""Material words, and catalogues of one's own: what is read, and what is refused with one line."""

from pathlib import Path

import pytest

from sensorsim.errors import InputError
from sensorsim.materials import MaterialWord, load_catalogue, parse_word

LAYER = "layer = [{ name = 'mud', thickness = 0.3, conductivity = 0.7, density = 1500, specific_heat = 1000 }]"
ENTRY = f"""
[[material]]
code = 70
name = "Adobe"
group = "masonry"
solar_absorptance = 0.7
emissivity = 0.93
reflectance_nir = 0.35
roughness = "rough"
characteristic_length = 3.0
construction = {{ description = "a wall of mud", estimate = "a house" }}
{LAYER}
"""


def write(folder: Path, **files: str) -> Path:
    for name, text in files.items():
        (folder / f"{name}.toml").write_text(text, encoding="utf-8")
    return folder


def told(folder: Path) -> str:
    """The one line with which the catalogue of `folder` is refused."""
    with pytest.raises(InputError) as caught:
        load_catalogue(folder)
    assert "\n" not in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize(
    ("text", "code", "reflectance"),
    [("2040", 20, 0.40), ("0930", 9, 0.30), ("2000", 20, 0.0), ("9899", 98, 0.99), ("0000", 0, 0.0)],
)
def test_a_word_is_two_digits_material_and_two_digits_percent(text: str, code: int, reflectance: float) -> None:
    word = parse_word(text)
    assert word == MaterialWord(code=code, reflectance=reflectance)
    assert word.text == text


def test_a_word_survives_the_round_trip() -> None:
    for number in range(10000):
        assert parse_word(f"{number:04d}").text == f"{number:04d}"


@pytest.mark.parametrize(
    "word", ["204", "20400", "20.4", "-204", "", " 2040", "2040\n", "20A0", "²040", "٢٠٤٠", 2040, None]
)
def test_what_is_no_word_is_refused_with_the_place_it_came_from(word: object) -> None:
    with pytest.raises(InputError, match=r"feature 3: word = .*: not a text of four digits; write code and percent"):
        parse_word(word, where="feature 3")  # type: ignore[arg-type]


def test_a_material_takes_one_entry_in_one_file(tmp_path: Path) -> None:
    catalogue = load_catalogue(write(tmp_path, mine=ENTRY))
    assert catalogue.codes == {70: "Adobe"}
    assert catalogue.material(70).emissivity.source == "unsourced"
    assert catalogue.wall_type(70, "open").layers[0].thickness == 0.3


def test_an_entry_may_name_a_substance_and_override_it(tmp_path: Path) -> None:
    mud = "[mud]\nname = 'mud'\nthickness = 0.3\nconductivity = 0.7\ndensity = 1500\nspecific_heat = 1000\n"
    entry = ENTRY.replace(LAYER, "layer = [{ substance = 'mud', thickness = 0.5 }, { substance = 'mud' }]")
    layers = load_catalogue(write(tmp_path, substances=mud, mine=entry)).material(70).construction.layers
    assert [(layer.thickness, layer.conductivity) for layer in layers] == [(0.5, 0.7), (0.3, 0.7)]
    assert "layer 1 substance = 'straw': unknown substance" in told(
        write(tmp_path, mine=entry.replace("'mud'", "'straw'"))
    )
    assert "substances.toml: mud density = -1: not a number" in told(
        write(tmp_path, substances=mud.replace("1500", "-1"), mine=entry)
    )


BAD = {
    "absorptance above 1": (
        "solar_absorptance = 0.7",
        "solar_absorptance = 1.2",
        "solar_absorptance = 1.2: not a number",
    ),
    "absorptance in percent": ("solar_absorptance = 0.7", "solar_absorptance = 70", "= 70: not a number from 0 to 1"),
    "absorptance below 0": ("solar_absorptance = 0.7", "solar_absorptance = -0.1", "= -0.1: not a number from 0 to 1"),
    "emissivity NaN": ("emissivity = 0.93", "emissivity = nan", "emissivity = nan: not a number from 0 to 1"),
    "reflectance infinite": ("reflectance_nir = 0.35", "reflectance_nir = inf", "reflectance_nir = inf: not a number"),
    "missing field": ("emissivity = 0.93", "", "material 70 emissivity = None: missing; add emissivity"),
    "roughness": ("'rough'", "'bumpy'", "'bumpy'"),
    "length of zero": ("characteristic_length = 3.0", "characteristic_length = 0", "= 0: not a number above 0"),
    "code as text": ("code = 70", "code = '70'", "material 1 code = '70': not a whole number from 0 to 99"),
    "code above 99": ("code = 70", "code = 100", "material 1 code = 100: not a whole number from 0 to 99"),
    "missing code": ("code = 70", "", "material 1 code = None: not a whole number"),
    "misspelt key": ("emissivity = 0.93", "emisivity = 0.93", "material 70 emisivity = 0.93: unknown key"),
    "no layers": (LAYER, "layer = []", "material 70 layer = []: no layers"),
    "no construction": ("construction = {", "# {", "material 70 construction = None: missing"),
    "negative conductivity": ("conductivity = 0.7", "conductivity = -0.7", "material 70 layer 1 conductivity = -0.7"),
    "both": ("name = 'mud',", "name = 'mud', resistance = 1.0,", "both resistance and thickness given"),
    "more light than falls": (
        "solar_absorptance = 0.7",
        "solar_absorptance = 0.7\nsolar_transmittance = 0.4",
        "material 70 solar_transmittance = 0.4: absorptance and transmittance add up to more than 1",
    ),
}


@pytest.mark.parametrize(("old", "new", "message"), BAD.values(), ids=BAD.keys())
def test_a_wrong_material_gets_one_line(tmp_path: Path, old: str, new: str, message: str) -> None:
    entry = ENTRY.replace('"', "'")
    assert old in entry
    line = told(write(tmp_path, mine=entry.replace(old, new)))
    assert line.startswith(str(tmp_path / "mine.toml"))
    assert message in line


def test_a_code_given_twice_names_both_places(tmp_path: Path) -> None:
    line = told(write(tmp_path, first=ENTRY, second=ENTRY.replace("Adobe", "Cob")))
    assert "second.toml: material code = 70: code given twice, first for Adobe in first.toml" in line


def test_a_folder_without_materials_is_refused(tmp_path: Path) -> None:
    assert "no materials" in told(tmp_path)
    assert "no such folder" in told(tmp_path / "nowhere")
    assert "materials = 3: unknown key" in told(write(tmp_path, mine="materials = 3"))


READING = "[[reading]]\ncode = 71\nmeans = 70\nwords = ['7130']\nreason = 'a slip'\n"


def test_a_reading_sends_a_code_to_another(tmp_path: Path) -> None:
    note = "[[note]]\nwords = ['7000']\ntext = 'black'\n"
    catalogue = load_catalogue(write(tmp_path, mine=ENTRY, readings=READING + note))
    assert catalogue.resolve(71) == (70, "a slip")
    assert catalogue.word_notes == {"7130": "a slip", "7000": "black"}
    assert catalogue.resolve_word("7000") == (MaterialWord(code=70, reflectance=0.0), "black")


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("means = 70", "means = 72", "reading 1 means = 72: not a code of the catalogue"),
        ("code = 71", "code = 70", "reading 1 code = 70: is Adobe in mine.toml; delete this reading"),
        ("code = 71", "code = -1", "reading 1 code = -1: not a whole number from 0 to 99"),
        ("'7130'", "'7230'", "'7230' does not begin with 71"),
        ("'7130'", "'713'", "word = '713': not a text of four digits"),
        ("['7130']", "[]", "reading 1 words = []: missing or empty"),
        ("reason = 'a slip'", "", "reading 1 reason = None: missing"),
        (READING, READING + READING, "reading 2 code = 71: read twice"),
    ],
)
def test_a_wrong_reading_gets_one_line(tmp_path: Path, old: str, new: str, message: str) -> None:
    line = told(write(tmp_path, mine=ENTRY, readings=READING.replace(old, new)))
    assert line.startswith(str(tmp_path / "readings.toml"))
    assert message in line
