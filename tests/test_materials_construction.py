"""Constructions: the report's three walls against closed forms, a user's own file, and files that are wrong."""

from pathlib import Path

import pytest

from sensorsim.errors import InputError
from sensorsim.materials import construction_names, load_construction

FILMS = 0.04 + 0.13  # outside and inside surface resistance [m2 K W-1] [ISO6946]

# Thermal transmittance [W m-2 K-1] with those films: closed form, one over the sum of all resistances [ISO6946].
TRANSMITTANCES = {
    "uninsulated_wood": 1.53108668878,
    "insulated_wood": 0.396088041723,
    "brick": 2.59202477261,
    "steel_sheet": 5.88098738683,
    "concrete_block": 2.83235519265,
    "builtup_roof": 0.472945966295,
}
IN_PATHS = ("curtain_wall", "insulated_wood_studs", "uninsulated_wood_studs", "wood_floor")

SLAB = "name = 'slab'\nthickness = 0.1\nconductivity = 0.5\ndensity = 1000\nspecific_heat = 900\n"


def write(folder: Path, text: str) -> Path:
    path = folder / "wall.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(("name", "transmittance"), TRANSMITTANCES.items())
def test_transmittance_equals_the_sum_of_resistances(name: str, transmittance: float) -> None:
    assert 1.0 / (FILMS + load_construction(name).thermal_resistance) == pytest.approx(transmittance, rel=1e-9)


def test_the_shipped_constructions_are_those_six_and_four_in_parallel_paths() -> None:
    assert construction_names() == tuple(sorted((*TRANSMITTANCES, *IN_PATHS)))
    assert {name for name in construction_names() if load_construction(name).paths} == set(IN_PATHS)


def test_the_walls_of_figure_12_have_its_layers_in_inches() -> None:
    inches = {
        "uninsulated_wood": [1 / 2, None, 3 / 4, None, 1 / 2],
        "insulated_wood": [5 / 8, None, 3 / 4, 3.5, 1 / 2],
        "brick": [4, 4, 3 / 4],
    }
    for name, thicknesses in inches.items():
        layers = load_construction(name).layers
        found = [None if layer.resistance is not None else layer.thickness / 0.0254 for layer in layers]
        assert found == [value if value is None else pytest.approx(value) for value in thicknesses]


def test_a_users_file_takes_the_same_road_with_plain_numbers(tmp_path: Path) -> None:
    text = f"[[layer]]\n{SLAB}\n[[layer]]\nname = 'air'\nresistance = {{ value = 0.15, source = 'my own' }}\n"
    construction = load_construction(write(tmp_path, text))
    slab, air = construction.layers
    assert (construction.name, construction.source) == ("wall", "file wall.toml")
    assert (slab.thermal_resistance, slab.areal_heat_capacity) == (pytest.approx(0.2), pytest.approx(9e4))
    assert (air.resistance, air.thickness, air.areal_heat_capacity) == (0.15, 0.0, 0.0)
    assert dict(slab.sources)["density"] == "unsourced"
    assert dict(air.sources) == {"resistance": "my own"}
    assert load_construction(str(tmp_path / "wall.toml")) == construction


def test_sources_are_no_part_of_what_a_layer_is(tmp_path: Path) -> None:
    plain = load_construction(write(tmp_path, f"[[layer]]\n{SLAB}")).layers
    sourced = SLAB.replace("0.5", "{ value = 0.5, source = 'a book' }")
    assert load_construction(write(tmp_path, f"[[layer]]\n{sourced}")).layers == plain


def test_a_layer_of_thickness_zero_is_allowed_and_adds_nothing(tmp_path: Path) -> None:
    text = f"[[layer]]\n{SLAB}[[layer]]\n{SLAB.replace('0.1', '0.0', 1)}"
    construction = load_construction(write(tmp_path, text))
    assert construction.layers[1].thickness == 0.0
    assert construction.thermal_resistance == pytest.approx(0.2)


BAD = {
    "negative conductivity": (SLAB.replace("0.5", "-0.5"), "layer 1 conductivity = -0.5: not a number above 0"),
    "conductivity of zero": (SLAB.replace("0.5", "0.0"), "layer 1 conductivity = 0.0: not a number above 0"),
    "NaN": (SLAB.replace("1000", "nan"), "layer 1 density = nan: not a number above 0"),
    "infinity": (SLAB.replace("0.1", "inf", 1), "layer 1 thickness = inf: not a number of 0 to 50"),
    "negative thickness": (SLAB.replace("0.1", "-0.1", 1), "layer 1 thickness = -0.1: not a number of 0 to 50"),
    "millimetres": (SLAB.replace("0.1", "100", 1), "layer 1 thickness = 100: not a number of 0 to 50, in metres"),
    "text for a number": (SLAB.replace("900", "'900'"), "layer 1 specific_heat = '900': not a number"),
    "truth for a number": (SLAB.replace("900", "true"), "layer 1 specific_heat = True: not a number"),
    "missing number": (SLAB.replace("density = 1000\n", ""), "layer 1 density = None: missing; add density"),
    "empty name": (SLAB.replace("name = 'slab'", "name = ''"), "layer 1 name = '': missing or not a text"),
    "both": (SLAB + "resistance = 0.2\n", "layer 1 thickness = 0.1: both resistance and thickness given"),
    "resistance of zero": ("name = 'air'\nresistance = 0\n", "layer 1 resistance = 0: not a number above 0"),
    "misspelt key": (SLAB + "densty = 3\n", "layer 1 densty = 3: unknown key; use one of name"),
    "substance": ("substance = 'plywood'\n", "layer 1 substance = 'plywood': unknown substance; give the numbers"),
    "only thickness zero": (SLAB.replace("0.1", "0", 1), "layer = 1: every layer has thickness 0"),
    "no value": (SLAB.replace("900", "{ source = 'x' }"), "layer 1 specific_heat value = None: missing"),
    "two sources": (SLAB.replace("900", "{ value = 900, source = 'x', estimate = 'y' }"), "both source and estimate"),
}


@pytest.mark.parametrize(("text", "message"), BAD.values(), ids=BAD.keys())
def test_a_wrong_layer_gets_one_line_with_file_entry_value_and_remedy(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        load_construction(write(tmp_path, f"[[layer]]\n{text}"))
    told = str(caught.value)
    assert told.startswith(str(tmp_path / "wall.toml"))
    assert message in told
    assert "; " in told
    assert "\n" not in told


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "layer = None: no layers; add at least one"),
        ("layer = []", "no layers; add at least one"),
        ("layer = 3", "layer = 3: not a list of tables"),
        ("wall = 3", "wall = 3: unknown key; use one of name"),
        ("[[layer]\n", "no valid TOML"),
    ],
)
def test_a_wrong_file_gets_one_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        load_construction(write(tmp_path, text))
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_unknown_name_lists_the_known_ones() -> None:
    with pytest.raises(InputError, match=r"name = 'adobe': no such .*use one of brick, builtup_roof.*path"):
        load_construction("adobe")
