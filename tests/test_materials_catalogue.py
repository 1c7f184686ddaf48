"""The shipped catalogue: complete, sourced, physical, and readable as wall types."""

import re
from dataclasses import FrozenInstanceError, fields

import pytest

from sensorsim.errors import InputError
from sensorsim.materials import (
    INTERIORS,
    ROUGHNESS_CLASSES,
    Catalogue,
    Choice,
    Layer,
    Material,
    Quantity,
    load_catalogue,
    nir_reflectance,
)
from sensorsim.resources import assets_folder

# Figure 9 of the report.
FIGURE_9 = [*range(1, 17), *range(20, 34), *range(40, 47), *range(50, 56), 60, 61, 65, 66, 67, 80, 81, *range(90, 99)]
SNOW = 99  # what lies on every ground in snowy weather; figure 9 has no code for it
# Every word of figure 10 of the report.
FIGURE_10 = [
    "3314",
    "3310",
    "3030",
    "3630",
    "3430",
    "3434",
    "3230",
    "3238",
    "8038",
    "9614",
    "9610",
    "3130",
    "3245",
    "3320",
    "5030",
    "2040",
    "6730",
    "2636",
    "2245",
    "1040",
    "2060",
    "1230",
    "2530",
    "2240",
    "2000",
    "2640",
    "0930",
    "0940",
    "1220",
    "1210",
    "2025",
    "3040",
    "9420",
    "9523",
]


@pytest.fixture(scope="module")
def catalogue() -> Catalogue:
    return load_catalogue()


def numbers_with_sources(material: Material) -> dict[str, str]:
    """Source of every number and choice of a material, by a name for it."""
    own = {field.name: getattr(material, field.name) for field in fields(material)}
    found = {name: held.source for name, held in own.items() if isinstance(held, Quantity | Choice)}
    for place, layer in enumerate(material.construction.layers, 1):
        found |= {f"layer {place} {name}": source for name, source in layer.sources}
    if material.cover is not None:
        found |= {f"cover {name}": source for name, source in material.cover.sources}
    if material.leafless is not None:
        leafless = [(field.name, getattr(material.leafless, field.name)) for field in fields(material.leafless)]
        found |= {f"leafless {name}": held.source for name, held in leafless}
    found |= {f"share of {component.code}": component.source for component in material.mixture}
    return found | {"construction": material.construction.source}


def source_keys(source: str) -> list[str]:
    return [] if source.startswith("estimate: ") else [part.split()[0] for part in source.split(";")]


def bibliography_keys() -> list[str]:
    text = (assets_folder() / "references.bib").read_text(encoding="utf-8")
    return re.findall(r"^@\w+\{([^,\s]+),", text, flags=re.MULTILINE)


def test_the_catalogue_holds_the_59_codes_of_figure_9_and_snow(catalogue: Catalogue) -> None:
    assert len(FIGURE_9) == 59
    assert list(catalogue.materials) == [*FIGURE_9, SNOW]
    assert catalogue.codes[20] == "Brick"
    assert {material.code for material in catalogue.materials.values()} == {*FIGURE_9, SNOW}


def test_every_number_of_a_material_has_a_source_or_says_why_it_is_an_estimate(catalogue: Catalogue) -> None:
    known = set(bibliography_keys())
    for material in catalogue.materials.values():
        sources = numbers_with_sources(material)
        for layer in material.construction.layers:
            expected = {"resistance"} if layer.resistance is not None else {field.name for field in fields(Layer)[1:5]}
            assert {name for name, _ in layer.sources} == expected, (material.code, layer.name)
        for name, source in sources.items():
            assert source.startswith("estimate: ") or source_keys(source), (material.code, name)
            assert set(source_keys(source)) <= known, (material.code, name, source)


def test_every_number_of_a_construction_has_a_source_or_says_why_it_is_an_estimate(catalogue: Catalogue) -> None:
    known = set(bibliography_keys())
    for construction in catalogue.constructions.values():
        layers = [source for layer in construction.layers for _, source in layer.sources]
        assert len(layers) == sum(1 if layer.resistance is not None else 4 for layer in construction.layers)
        for source in [construction.source, *layers]:
            assert set(source_keys(source)) <= known, (construction.name, source)


def test_bibliography_keys_are_unique() -> None:
    keys = bibliography_keys()
    assert len(keys) == len(set(keys))


def test_surfaces_obey_the_energy_law(catalogue: Catalogue) -> None:
    for material in catalogue.materials.values():
        total = material.solar_absorptance.value + material.solar_transmittance.value
        assert 0.0 < material.solar_absorptance.value < 1.0
        assert total <= 1.0
        assert material.solar_reflectance == pytest.approx(1.0 - total)
        assert 0.5 < material.emissivity.value < 1.0
        assert 0.0 < material.reflectance_nir.value <= 0.95
        # 0.8-1.1 um holds about a fifth of the sun's energy, so its reflectance bounds the solar one from below.
        assert material.solar_reflectance >= 0.18 * material.reflectance_nir.value


def test_snow_conducts_as_its_density_says(catalogue: Catalogue) -> None:
    """k = 2.22362 rho^1.885, rho in Mg m-3 [Yen1981]."""
    snow = catalogue.material(SNOW).construction.layers[0]
    assert snow.conductivity == pytest.approx(2.22362 * (snow.density / 1000.0) ** 1.885, rel=0.005)


def test_only_glass_and_screen_let_the_sun_through(catalogue: Catalogue) -> None:
    through = {code for code, material in catalogue.materials.items() if material.solar_transmittance.value > 0.0}
    assert through == set(range(40, 47))


def test_real_layers_have_real_diffusivities(catalogue: Catalogue) -> None:
    stacks = [material.construction for material in catalogue.materials.values()]
    for construction in [*stacks, *catalogue.constructions.values()]:
        for layer in construction.layers:
            if layer.resistance is None:
                diffusivity = layer.conductivity / (layer.density * layer.specific_heat)
                assert 1e-8 < diffusivity < 2e-4, (construction.name, layer.name)
                assert 1e-4 < layer.thickness <= 1.0, (construction.name, layer.name)
            else:
                assert 0.001 < layer.resistance < 5.0, (construction.name, layer.name)


def test_the_material_itself_is_the_outermost_layer_and_has_heat_capacity(catalogue: Catalogue) -> None:
    for material in catalogue.materials.values():
        if material.mixture:
            continue
        outer = material.construction.layers[0]
        assert outer.resistance is None, material.code
        assert outer.areal_heat_capacity > 400.0, material.code


def test_grounds_and_pavements_reach_below_the_daily_wave(catalogue: Catalogue) -> None:
    for code in (80, 81, *range(90, 96), SNOW):
        layers = catalogue.materials[code].construction.layers
        assert 0.6 <= sum(layer.thickness for layer in layers) <= 1.0, code


def test_the_walls_of_figure_12_stand_behind_the_codes_they_show(catalogue: Catalogue) -> None:
    for code, name in ((2, "uninsulated_wood"), (6, "insulated_wood"), (20, "brick"), (22, "concrete_block")):
        assert catalogue.materials[code].construction.layers == catalogue.constructions[name].layers


def test_metal_conducts_and_a_built_up_roof_insulates(catalogue: Catalogue) -> None:
    resistance = {code: material.construction.thermal_resistance for code, material in catalogue.materials.items()}
    assert resistance[12] < 1e-3 < resistance[22] < resistance[67]


def test_wall_types_are_hashable_and_tell_interiors_apart(catalogue: Catalogue) -> None:
    walls = {catalogue.wall_type(code, interior) for code in FIGURE_9 for interior in INTERIORS}
    assert len(walls) == len(FIGURE_9) * len(INTERIORS)
    brick = catalogue.wall_type(20, "heated")
    assert brick == load_catalogue().wall_type(20, "heated")
    assert hash(brick) == hash(load_catalogue().wall_type(20, "heated"))
    assert (brick.code, brick.name, brick.interior, brick.interior_emissivity) == (20, "Brick", "heated", 0.9)
    assert brick.roughness in ROUGHNESS_CLASSES
    assert catalogue.wall_type(12, "heated").interior_emissivity == pytest.approx(0.705)
    with pytest.raises(FrozenInstanceError):
        brick.code = 21  # type: ignore[misc]


def test_every_word_of_figure_10_resolves_to_a_material(catalogue: Catalogue) -> None:
    for text in FIGURE_10:
        word, note = catalogue.resolve_word(text)
        assert word.code in catalogue.materials
        assert word.reflectance == pytest.approx(int(text[2:]) / 100)
        assert (note is not None) == (text in catalogue.word_notes), text


def test_codes_outside_figure_9_are_read_with_a_reason(catalogue: Catalogue) -> None:
    assert catalogue.resolve(20) == (20, None)
    for code, means in ((34, 31), (36, 30)):
        assert catalogue.resolve(code) == (means, catalogue.readings[code].reason)
        with pytest.raises(InputError, match=f"material code = {code}: .*read as {means}"):
            catalogue.material(code)
    assert catalogue.resolve_word("3314") == (catalogue.resolve_word("3314")[0], catalogue.word_notes["3314"])
    assert catalogue.resolve_word("3314")[0].code == 33


def test_unknown_codes_and_interiors_are_refused(catalogue: Catalogue) -> None:
    for ask in (catalogue.resolve, catalogue.material):
        with pytest.raises(InputError, match=r"materials: material code = 17: no such material; use one of the 60"):
            ask(17)
    with pytest.raises(InputError, match=r"material 20 interior = 'warm': unknown .* heated, cooled, unheated, open"):
        catalogue.wall_type(20, "warm")


def test_near_infrared_reflectance_follows_the_word(catalogue: Catalogue) -> None:
    for material in catalogue.materials.values():
        own = nir_reflectance(material, material.solar_reflectance)
        assert own == pytest.approx(material.reflectance_nir.value)
        assert nir_reflectance(material, 0.0) == 0.0
        assert 0.0 < nir_reflectance(material, 0.3) <= nir_reflectance(material, 0.9) <= 0.95
    brick, leaves = catalogue.material(20), catalogue.material(96)
    assert nir_reflectance(brick, 0.40) == pytest.approx(0.308 * 0.40 / 0.24)
    assert nir_reflectance(leaves, 0.14) > 2.0 * 0.14
    assert nir_reflectance(brick, 0.99) == 0.95


@pytest.mark.parametrize("reflectance", [-0.01, 1.01, float("nan"), float("inf")])
def test_near_infrared_reflectance_refuses_what_is_no_reflectance(catalogue: Catalogue, reflectance: float) -> None:
    with pytest.raises(InputError, match="material 20 reflectance"):
        nir_reflectance(catalogue.material(20), reflectance)
