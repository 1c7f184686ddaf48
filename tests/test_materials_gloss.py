"""Surfaces that mirror: Fresnel's equations, what water and metal show of a cold sky, and what is refused."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from sensorsim.environment import band_sky
from sensorsim.errors import InputError
from sensorsim.materials.gloss import Gloss, fresnel_reflectance, load_gloss, read_gloss
from sensorsim.radiometry import FLIR_BAND, BandTable, build_band_table
from sensorsim.render.mirror import gloss_records, mirror_table


@pytest.fixture(scope="module")
def table() -> BandTable:
    return build_band_table(FLIR_BAND)


def _kind(name: str) -> tuple[int, Gloss]:
    return next((row, gloss) for row, gloss in enumerate(load_gloss()) if gloss.name == name)


def test_fresnel_has_its_closed_forms() -> None:
    """Along the normal ((n-1)^2 + k^2) / ((n+1)^2 + k^2), 1 at grazing, and half of what is crossed at Brewster's."""
    for index in (1.33 + 0.0j, 1.5 + 0.0j, 1.2 + 0.3j, 8.0 + 30.0j):
        n, k = index.real, index.imag
        normal = ((n - 1.0) ** 2 + k**2) / ((n + 1.0) ** 2 + k**2)
        assert float(fresnel_reflectance(np.array(index), np.array(1.0))) == pytest.approx(normal, rel=1e-12)
        assert float(fresnel_reflectance(np.array(index), np.array(1e-9))) == pytest.approx(1.0, abs=1e-6)
    brewster = np.arctan(1.5)
    expected = 0.5 * ((1.5**2 - 1.0) / (1.5**2 + 1.0)) ** 2
    assert float(fresnel_reflectance(np.array(1.5 + 0j), np.cos(brewster))) == pytest.approx(expected, rel=1e-12)


# Emissivity in 8-14 um at angles [deg] from the normal: Fresnel's equations on tabulated indices, band mean.
MEASURED = {
    "water": ((0.0, 50.0, 60.0, 70.0, 75.0, 80.0, 85.0), (0.985, 0.973, 0.947, 0.874, 0.796, 0.66, 0.42), 0.006),
    "glass": ((0.0, 50.0, 60.0, 70.0, 75.0, 80.0, 85.0), (0.880, 0.840, 0.786, 0.686, 0.604, 0.484, 0.300), 0.003),
}


@pytest.mark.parametrize("name", MEASURED)
def test_emissivity_falls_with_the_angle_as_the_indices_say(name: str) -> None:
    angle, expected, margin = MEASURED[name]
    _, gloss = _kind(name)
    assert gloss.normal_emissivity is not None
    found = gloss.emissivity(np.full(len(angle), gloss.normal_emissivity), np.cos(np.radians(angle)))
    assert np.abs(found - expected).max() <= margin


def test_index_of_glass_in_the_near_infrared_is_the_formula_for_clear_panes() -> None:
    """n = 1.5130 - 0.003169 l2 + 0.003962 / l2 [Rubin1985], and both faces of a pane of it."""
    wave = np.linspace(0.8, 1.1, 301)
    face = (
        (1.5130 - 0.003169 * wave**2 + 0.003962 / wave**2 - 1.0) / (2.5130 - 0.003169 * wave**2 + 0.003962 / wave**2)
    ) ** 2
    pane = np.mean(face + face * (1.0 - face) ** 2 / (1.0 - face**2))
    assert _kind("glass")[1].nir.highest == pytest.approx(pane, abs=1e-4)


@pytest.mark.parametrize("gloss", load_gloss(), ids=lambda gloss: gloss.name)
def test_emissivity_stays_a_share_at_every_angle(gloss: Gloss) -> None:
    cosine = np.linspace(0.0, 1.0, 500)
    for normal in (0.02, 0.5, 1.0):
        found = gloss.emissivity(np.full(500, normal), cosine)
        assert (found >= 0.0).all()
        assert (found <= normal).all()


def _winter_sky(table: BandTable) -> np.ndarray:
    """Clear mid-latitude winter: air 272.2 K, 440 Pa."""
    elevation = np.degrees(np.arcsin(np.linspace(0.0, 1.0, 1024)))
    parts = band_sky(elevation, vapour_pressure=440.0, cloud_cover=0.0)
    return np.asarray(parts.air * table.radiance_at(272.2))


def _looks(name: str, kelvin: float, angle: float, emissivity: float, table: BandTable) -> float:
    """Apparent temperature [K] of a level surface seen at an angle [deg] from its normal under that sky."""
    row, gloss = _kind(name)
    mirror = mirror_table(_winter_sky(table), float(table.radiance_at(272.2)))[row]
    cosine = np.cos(np.radians(angle))
    along = emissivity if gloss.normal_emissivity is None else gloss.normal_emissivity
    share = float(gloss.emissivity(np.array(along), np.array(cosine)))
    shown = float(np.interp(cosine, np.linspace(-1.0, 1.0, mirror.size), mirror))
    return float(table.apparent_temperature(share * table.radiance_at(kelvin) + (1.0 - share) * shown))


@pytest.mark.parametrize(("angle", "colder"), [(0.0, 0.7), (60.0, 2.2), (70.0, 4.9), (80.0, 11.0), (85.0, 14.6)])
def test_water_under_a_clear_winter_sky_looks_colder_than_it_is(angle: float, colder: float, table: BandTable) -> None:
    """Water at 280 K under LOWTRAN7's mid-latitude winter sky: the sky it shows lies at 90 degrees minus the angle."""
    assert 280.0 - _looks("water", 280.0, angle, 0.983, table) == pytest.approx(colder, abs=0.4)


def test_sheet_metal_mirrors_the_cold_zenith_and_the_warm_horizon(table: BandTable) -> None:
    """Seen from above it looks far colder than seen from the side, and colder than the sky's mean would make it."""
    steep, flat = (_looks("sheet metal", 272.2, angle, 0.7, table) for angle in (0.0, 85.0))
    sky, sine = _winter_sky(table), np.linspace(0.0, 1.0, 1024)
    mean = float(np.trapezoid(sky * sine, sine) / np.trapezoid(sine, sine))
    matt = float(table.apparent_temperature(0.7 * table.radiance_at(272.2) + 0.3 * mean))
    assert steep < matt - 0.5
    assert flat > matt + 5.0


def test_lobes_keep_surroundings_of_one_radiance_as_they_are() -> None:
    np.testing.assert_allclose(mirror_table(np.full(64, 31.0), 31.0), 31.0, rtol=1e-12)


def test_wider_lobe_blurs_the_horizon_but_not_the_mean() -> None:
    """Sky 0, ground 1: each lobe is at a half on the horizon, and sharp only where it has no spread."""
    mirror = mirror_table(np.zeros(64), 1.0)
    for row, gloss in enumerate(load_gloss()):
        middle = mirror.shape[1] // 2
        assert mirror[row, 0] == pytest.approx(1.0, abs=1e-6)
        assert mirror[row, -1] == pytest.approx(0.0, abs=1e-6)
        if gloss.spread > 0.0:
            assert mirror[row, middle] == pytest.approx(0.5, abs=0.02)
            assert (np.diff(mirror[row]) <= 1e-12).all()


def test_records_know_glossy_codes_from_matt_ones() -> None:
    found = gloss_records(np.array([98, 20, 12]), np.array([0.983, 0.93, 0.705]), np.array([0.01, 0.4, 0.2]))
    assert found[0].tolist() == [_kind("water")[0], 0.985, 0.01, 0.0]
    assert found[1].tolist() == [-1.0, 0.93, 0.0, 0.0]
    assert found[2].tolist() == [_kind("sheet metal")[0], 0.705, 0.1, 0.0]


def test_no_code_has_two_kinds() -> None:
    codes = [code for gloss in load_gloss() for code in gloss.codes]
    assert len(codes) == len(set(codes))


@pytest.mark.parametrize(
    ("changes", "entry"),
    [
        ({"exponent": {"value": -1.0}}, "exponent"),
        ({"exponent": {"value": float("nan")}}, "exponent"),
        ({"spread": {"value": 90.0}}, "spread"),
        ({"normal": {"value": 1.2}}, "normal"),
        ({"index": [[8.0, 1.3, 0.0], [14.0, 1.2, 0.3]]}, "gloss"),
        ({"exponent": 5.0}, "exponent"),
        ({"nir": {"share": {"value": 1.0}}}, "nir"),
        ({"nir": {"share": {"value": 1.1}, "exponent": {"value": 5.0}}}, "nir share"),
        ({"nir": {"share": {"value": 1.0}, "exponent": {"value": float("inf")}}}, "nir exponent"),
        ({"nir": {"share": {"value": 1.0}, "index": [[0.8, 1.5], [1.1, 1.5]], "faces": 3}}, "nir"),
        ({"nir": {"share": {"value": 1.0}, "index": [[0.8, 1.5]]}}, "nir index"),
        ({"nir": {"share": {"value": 1.0}, "index": [[0.8, 1.5], [1.1, float("nan")]]}}, "nir index"),
        ({"waves": {"calm": -0.01, "per_wind": 0.005}}, "waves"),
        ({"waves": {"calm": 0.003}}, "waves"),
    ],
)
def test_impossible_gloss_is_refused_by_file_and_entry(changes: dict[str, Any], entry: str) -> None:
    nir = {"exponent": {"value": 5.0}, "share": {"value": 1.0}}
    good = {"name": "paint", "codes": [1], "exponent": {"value": 5.0}, "spread": {"value": 1.0}, "nir": nir}
    assert read_gloss(Path("gloss.toml"), good).name == "paint"
    with pytest.raises(InputError, match=rf"gloss.toml.*{entry}"):
        read_gloss(Path("gloss.toml"), {**good, **changes})
