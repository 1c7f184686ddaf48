"""Constructions in parallel paths, and curved ones: how files give them, and what is refused."""

from pathlib import Path

import pytest

from sensorsim.errors import InputError
from sensorsim.materials import Layer, load_catalogue, load_construction

SIDING = "[[layer]]\nname = 'siding'\nthickness = 0.02\nconductivity = 0.1\ndensity = 500\nspecific_heat = 1500\n"
STUD = SIDING.replace("siding", "stud").replace("[[layer]]", "[[layer]]\npath = 'studs'")
AIR = "[[layer]]\npath = 'between'\nname = 'air'\nresistance = 0.16\n"
SHARES = "[path]\nstuds = 0.2\nbetween = 0.8\n"


def write(folder: Path, text: str) -> Path:
    path = folder / "wall.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_layers_stand_in_the_path_they_name_and_else_in_all(tmp_path: Path) -> None:
    wall = load_construction(write(tmp_path, SHARES + SIDING + STUD + AIR + SIDING.replace("siding", "board")))
    found = {path.name: (path.fraction, [layer.name for layer in path.layers]) for path in wall.paths}
    assert found == {
        "studs": (0.2, ["siding", "stud", "board"]),
        "between": (0.8, ["siding", "air", "board"]),
    }
    assert wall.layers == wall.paths[1].layers


def test_a_file_without_paths_has_none(tmp_path: Path) -> None:
    wall = load_construction(write(tmp_path, SIDING))
    assert (wall.paths, wall.shape, wall.radius) == ((), "slab", None)


def test_a_share_carries_its_source(tmp_path: Path) -> None:
    text = SHARES.replace("0.2", "{ value = 0.2, estimate = 'a guess' }") + SIDING + STUD + AIR
    assert [path.source for path in load_construction(write(tmp_path, text)).paths] == [
        "estimate: a guess",
        "unsourced",
    ]


@pytest.mark.parametrize("shape", ["cylinder", "sphere"])
def test_a_file_may_give_a_shape_with_the_radius_outside(tmp_path: Path, shape: str) -> None:
    wall = load_construction(write(tmp_path, f"shape = '{shape}'\nradius = 0.02\n{SIDING}"))
    assert (wall.shape, wall.radius) == (shape, 0.02)


WRONG = {
    "sum": (SHARES.replace("0.8", "0.7") + SIDING + STUD + AIR, "path = 0.9: shares do not add up to 1"),
    "share of 0": (SHARES.replace("0.2", "0") + SIDING + STUD, "path studs = 0: not a number above 0, up to 1"),
    "share NaN": (SHARES.replace("0.2", "nan") + SIDING + STUD, "path studs = nan: not a number above 0, up to 1"),
    "unknown path": (SHARES + SIDING + STUD.replace("'studs'", "'beams'"), "layer 2 path = 'beams': no such path; use"),
    "no table": (SIDING + STUD, "layer 2 path = 'studs': no such path; use one of the [path] table: none"),
    "idle paths": (SHARES + SIDING, "no layer names one; write path ="),
    "empty path": (SHARES + STUD, "no layers; add at least one"),
    "not a table": ("path = 3\n" + SIDING, "path = 3: not a table of shares"),
    "shape": ("shape = 'cone'\n" + SIDING, "shape = 'cone': not a word of the list; use one of slab, cylinder, sphere"),
    "no radius": ("shape = 'cylinder'\n" + SIDING, "radius = None: missing; add radius"),
    "radius of a slab": ("radius = 0.3\n" + SIDING, "radius = 0.3: a slab has none; leave it out"),
    "too deep": ("shape = 'sphere'\nradius = 0.01\n" + SIDING, "radius = 0.01: layers reach 0.02 m deep; make"),
}


@pytest.mark.parametrize(("text", "message"), WRONG.values(), ids=WRONG.keys())
def test_wrong_paths_and_shapes_get_one_line(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        load_construction(write(tmp_path, text))
    told = str(caught.value)
    assert told.startswith(str(tmp_path / "wall.toml"))
    assert message in told
    assert "\n" not in told


@pytest.mark.parametrize("name", ["insulated_wood", "uninsulated_wood"])
def test_walls_with_studs_are_the_plain_walls_between_the_studs(name: str) -> None:
    plain, framed = load_construction(name), load_construction(f"{name}_studs")
    assert framed.layers == plain.layers
    (studs, between) = framed.paths
    assert between.layers == plain.layers
    differing = [(one, two) for one, two in zip(studs.layers, plain.layers, strict=True) if one != two]
    assert len(differing) == 1
    wood, _ = differing[0]
    assert wood.thickness == pytest.approx(3.5 * 0.0254 if name == "insulated_wood" else 4.0 * 0.0254)
    assert 1.5 / 16.0 < studs.fraction <= 0.25


def test_every_number_of_the_new_constructions_has_a_source() -> None:
    for construction in load_catalogue().constructions.values():
        texts = [construction.source, *(path.source for path in construction.paths)]
        layers: list[Layer] = [layer for path in construction.paths for layer in path.layers]
        texts += [source for layer in layers for _, source in layer.sources]
        assert all(text and text != "unsourced" for text in texts), construction.name


def test_a_material_of_ones_own_may_have_paths(tmp_path: Path) -> None:
    entry = """
    [[material]]
    code = 70
    name = "framed"
    group = "siding"
    solar_absorptance = 0.5
    emissivity = 0.9
    reflectance_nir = 0.4
    roughness = "rough"
    characteristic_length = 5.0
    construction = { description = "boards on studs", estimate = "mine" }
    path = { studs = 0.2, between = 0.8 }
    layer = [
      { name = "board", thickness = 0.02, conductivity = 0.1, density = 500, specific_heat = 1500 },
      { path = "studs", name = "stud", thickness = 0.1, conductivity = 0.13, density = 500, specific_heat = 1600 },
      { path = "between", name = "air", resistance = 0.16 },
    ]
    """
    (tmp_path / "mine.toml").write_text(entry, encoding="utf-8")
    wall = load_catalogue(tmp_path).wall_type(70, "heated")
    assert [path.name for path in wall.paths] == ["studs", "between"]
    assert wall.layers == wall.paths[1].layers
    assert hash(wall) == hash(load_catalogue(tmp_path).wall_type(70, "heated"))
