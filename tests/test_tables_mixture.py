"""Mixed blocks: shares of area from record and sheet, reflectances, and the one temperature that stands for all."""

from collections.abc import Iterator
from dataclasses import replace
from datetime import date
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from sensorsim.environment import build_environment, read_weather
from sensorsim.errors import InputError
from sensorsim.materials import (
    Catalogue,
    Coverage,
    WallPart,
    WallType,
    component_shares,
    load_catalogue,
    part_reflectances,
)
from sensorsim.radiometry import FLIR_BAND, build_band_table
from sensorsim.scene import load_scene
from sensorsim.tables import BakeSettings, bake_tables, surface_temperature
from sensorsim.tables.assign import assign_wall_types
from sensorsim.tables.mixture import mix_temperatures, mixed_reflectances

BLOCKS = (30, 31, 32, 33)
COVERAGES = [Coverage(roof=roof, tree=tree) for roof, tree in product((None, 0.0, 0.3, 1.0), (None, 0.0, 0.3, 0.8))]


@pytest.fixture(scope="module")
def catalogue() -> Catalogue:
    return load_catalogue()


def faces() -> Iterator[tuple[int, Coverage, bool]]:
    yield from product(BLOCKS, COVERAGES, (False, True))


def block(catalogue: Catalogue, parts: list[tuple[int, float, float]]) -> WallType:
    """Mixed wall type of (code, share, reflectance)."""
    made = tuple(
        WallPart(wall=catalogue.wall_type(code, "none"), share=share, reflectance=own) for code, share, own in parts
    )
    return replace(catalogue.wall_type(30, "heated"), parts=made)


def test_shares_sum_to_one_on_every_face_under_any_coverage(catalogue: Catalogue) -> None:
    for code, coverage, side in faces():
        shares = component_shares(catalogue.material(code).mixture, coverage, side=side)
        assert min(shares) >= 0.0
        assert sum(shares) == pytest.approx(1.0, abs=1e-12), (code, coverage, side)


def test_the_sheets_coverage_counts_on_tops(catalogue: Catalogue) -> None:
    """Expected: 30 % roofs and 30 % trees of a residential area leave 40 % for lawns and streets, 5 to 2."""
    mixture = catalogue.material(30).mixture
    shares = component_shares(mixture, Coverage(roof=0.3, tree=0.3), side=False)
    part = {name: sum(s for s, c in zip(shares, mixture, strict=True) if c.part == name) for name in ("roof", "wall")}
    assert part == {"roof": pytest.approx(0.3), "wall": 0.0}
    by_code = dict(zip((c.code for c in mixture), shares, strict=True))
    assert by_code[96] == pytest.approx(0.3)
    assert by_code[94] == pytest.approx(2.5 * by_code[81])
    full = component_shares(mixture, Coverage(roof=1.0, tree=0.3), side=False)
    assert dict(zip((c.code for c in mixture), full, strict=True))[50] == pytest.approx(1.0), "trees find no room"


def test_sides_show_walls_with_trees_before_them(catalogue: Catalogue) -> None:
    mixture = catalogue.material(30).mixture
    shares = component_shares(mixture, Coverage(roof=0.3, tree=0.25), side=True)
    shown = {component.part: 0.0 for component in mixture}
    for component, share in zip(mixture, shares, strict=True):
        shown[component.part] += share
    assert shown == {"roof": 0.0, "open": 0.0, "tree": pytest.approx(0.25), "wall": pytest.approx(0.75)}


def test_reflectances_of_the_parts_average_to_the_word(catalogue: Catalogue) -> None:
    for code in BLOCKS:
        parts = catalogue.wall_type(code, "heated").parts
        mean = sum(part.share * part.reflectance for part in parts)
        for word in (0.0, 0.1, mean, 0.45, 0.99, 1.0):
            own = part_reflectances([part.reflectance for part in parts], [part.share for part in parts], [word])[:, 0]
            assert all(-1e-12 <= value <= 1.0 + 1e-12 for value in own)
            assert sum(part.share * value for part, value in zip(parts, own, strict=True)) == pytest.approx(word)


def test_equal_components_make_the_component(catalogue: Catalogue) -> None:
    solved = np.array([300.0, 288.0])
    mixed = mix_temperatures(block(catalogue, [(20, 0.6, 0.3), (20, 0.4, 0.3)]), [solved, solved])
    np.testing.assert_allclose(mixed, solved, rtol=1e-13)


def test_the_block_lies_between_its_components_and_radiates_as_they_do(catalogue: Catalogue) -> None:
    """Expected: the sum of emitted fourth powers, exactly; 8-14 um radiance says the same within 0.04 K at +-10 K."""
    walls = [catalogue.wall_type(code, "none") for code in (20, 25)]
    made = block(catalogue, [(20, 0.5, 0.3), (25, 0.5, 0.3)])
    mixed = float(mix_temperatures(made, [np.array(300.0), np.array(280.0)]))
    weight = walls[0].emissivity / (walls[0].emissivity + walls[1].emissivity)
    assert 280.0 < mixed < 300.0
    assert mixed**4 == pytest.approx(weight * 300.0**4 + (1.0 - weight) * 280.0**4, rel=1e-9)
    table = build_band_table(FLIR_BAND)
    radiance = weight * table.radiance_at(np.array(300.0)) + (1.0 - weight) * table.radiance_at(np.array(280.0))
    assert abs(float(table.apparent_temperature(radiance)) - mixed) < 0.04


def test_the_bake_mixes_what_it_solves_for_the_components(catalogue: Catalogue) -> None:
    settings = BakeSettings(
        orientations="report10", interpolation="barycentric", lobes=0.0, step=1800.0, slice_interval=7200.0,
        lead_in_days=1.0, reflectances=(0.1, 0.3, 0.5, 0.7, 0.9), degree=4,
    )  # fmt: skip
    weather = read_weather("fall")
    environment = build_environment(weather, image_day=date(1976, 10, 7), lead_in_days=1.0, step=1800.0)
    made = catalogue.wall_type(30, "heated", coverage=Coverage(roof=0.3, tree=0.3))
    own = [part.wall for part in made.parts]
    ground = catalogue.wall_type(93, "none")
    tables = bake_tables(environment, [made, *own], ground=ground, settings=settings)
    normal = tables.orientations.normal
    count = normal.shape[0]
    for word, hour in product((0.1, 0.3, 0.9), (8.0, 12.0)):
        fourth = np.zeros(count)
        own_reflectances = mixed_reflectances(made, np.array([word]))[:, 0]
        for row, part in enumerate(made.parts, start=1):
            own_reflectance = np.full(count, own_reflectances[row - 1])
            shade = surface_temperature(tables, normal, np.full(count, row), own_reflectance, 3600.0 * hour)
            fourth += part.share * part.wall.emissivity / made.emissivity * shade**4
        block_shade = surface_temperature(tables, normal, np.zeros(count, int), np.full(count, word), 3600.0 * hour)
        np.testing.assert_allclose(block_shade, fourth**0.25, atol=2e-3)
    assert made.emissivity == pytest.approx(sum(part.share * part.wall.emissivity for part in made.parts))


def test_a_knot_that_no_power_has_changes_no_mixture(catalogue: Catalogue) -> None:
    """Parts are read off at reflectances between those that are solved, which may all lie below the knot."""
    settings = BakeSettings(
        orientations="report10", interpolation="barycentric", lobes=0.0, step=1800.0, slice_interval=43200.0,
        lead_in_days=1.0, reflectances=(0.1, 0.2, 0.35, 0.5), degree=2, knot=0.6,
    )  # fmt: skip
    environment = build_environment(read_weather("fall"), image_day=date(1976, 10, 7), lead_in_days=1.0, step=1800.0)
    made, ground = catalogue.wall_type(30, "heated"), catalogue.wall_type(93, "none")
    knotted, plain = (
        bake_tables(environment, [made], ground=ground, settings=replace(settings, knot=knot)) for knot in (0.6, 0.0)
    )
    np.testing.assert_array_equal(knotted.coefficients, plain.coefficients)


def test_blocks_of_the_scene_take_the_coverage_of_their_feature(catalogue: Catalogue) -> None:
    scene = load_scene("hospital", level="IA")
    assignment = assign_wall_types(scene, catalogue)
    number = np.array([feature.number for feature in scene.features])[scene.surfaces.feature]
    roofs = np.nonzero((number == "2") & (scene.surfaces.role == "roof"))[0]
    parts = assignment.wall_types[assignment.wall_type[roofs[0]]].parts
    shares = {part.wall.code: part.share for part in parts}
    assert shares[50] == pytest.approx(0.3)
    assert shares[96] == pytest.approx(0.3)
    trees = np.nonzero((number == "1") & (scene.surfaces.role == "wall"))[0]
    assert {part.wall.code for part in assignment.wall_types[assignment.wall_type[trees[0]]].parts} == {96}


@pytest.mark.parametrize(
    ("mixture", "problem"),
    [
        ('[{ code = 1, part = "roof", share = 0.7 }]', "shares do not sum to 1"),
        ('[{ code = 55, part = "roof", share = 1.0 }]', "no plain material"),
        ('[{ code = 1, part = "moat", share = 1.0 }]', "not a word of the list"),
        ('[{ code = 1, part = "roof", share = 1.0, colour = 3 }]', "unknown key"),
    ],
)
def test_a_mixture_that_cannot_be_is_refused(tmp_path: Path, mixture: str, problem: str) -> None:
    plain = (
        'name = "x"\ngroup = "x"\nsolar_absorptance = 0.5\nemissivity = 0.9\nreflectance_nir = 0.3\n'
        'roughness = "smooth"\ncharacteristic_length = 1.0\nconstruction = { description = "x", source = "x" }\n'
    )
    wall = "[[material]]\ncode = 1\n" + plain + "layer = [{ name = 'a', resistance = 1.0 }]\n"
    (tmp_path / "own.toml").write_text(wall + "[[material]]\ncode = 2\n" + plain + f"mixture = {mixture}\n")
    with pytest.raises(InputError, match=problem):
        load_catalogue(tmp_path)


def test_reflectances_of_the_parts_go_smoothly_with_the_word_and_are_their_own_at_the_mean() -> None:
    own, share = [0.1, 0.35, 0.8], [0.5, 0.3, 0.2]
    mean = float(np.dot(own, share))
    np.testing.assert_allclose(part_reflectances(own, share, np.array([mean]))[:, 0], own, atol=1e-9)
    words = np.linspace(0.01, 0.99, 981)
    slope = np.diff(part_reflectances(own, share, words), axis=1) / np.diff(words)
    assert slope.min() > 0.0
    assert np.abs(np.diff(slope, axis=1)).max() < 0.02  # a kink would step by 0.3
