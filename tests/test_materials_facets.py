"""Facets of glossy surfaces: energy, reciprocity, power and place of the glint."""

import numpy as np
import pytest
from gloss_twin import COSINE, glint, scattered, whole_rise
from numpy.typing import NDArray

from sensorsim.environment import SUN_RADIUS
from sensorsim.materials.facets import facets, lobe_spread, lobe_variance
from sensorsim.materials.gloss import Gloss, fresnel_reflectance, load_gloss

FloatArray = NDArray[np.float64]
KINDS = {gloss.name: gloss for gloss in load_gloss()}
UP = np.array([0.0, 0.0, 1.0])
_TURN = 120  # sectors around the normal
# From a calm to a storm, panes, sheets.
CASES = [("water", 0.0), ("water", 5.0), ("water", 20.0), ("glass", 0.0), ("sheet metal", 0.0), ("plastic", 0.0)]


def towards(angle: float) -> FloatArray:
    """Unit direction at an angle [deg] from the normal."""
    return np.array([np.sin(np.radians(angle)), 0.0, np.cos(np.radians(angle))])


def around(direction: FloatArray, variance: float) -> tuple[FloatArray, FloatArray]:
    """Directions (n, 3) off facets of slopes around the normal, and the solid angle of each [sr]; fine at the lobe."""
    widest = 6.0 * np.sqrt(variance + SUN_RADIUS**2 / direction[2] ** 2)
    edges = np.concatenate([np.linspace(0.0, widest, 150), np.geomspace(widest, max(widest * 1.5, 60.0), 60)[1:]])
    ring, sector = 0.5 * (edges[1:] + edges[:-1]), 2.0 * np.pi * (np.arange(_TURN) + 0.5) / _TURN
    east, north = (np.outer(ring, turn(sector)) for turn in (np.cos, np.sin))
    half = np.stack([east, north, np.ones_like(east)], axis=-1)
    area = np.broadcast_to((ring * np.diff(edges) * 2.0 * np.pi / _TURN)[:, None], east.shape)
    length = np.linalg.norm(half, axis=-1, keepdims=True)
    half = half / length
    incidence = half @ direction
    out = 2.0 * incidence[..., None] * half - direction
    solid = 4.0 * np.maximum(incidence, 0.0) * area / length[..., 0] ** 3
    held = (incidence > 0.0) & (out[..., 2] > 0.0)
    return out[held], solid[held]


def sent_on(gloss: Gloss, wind: float, facet: float, angle: float) -> float:
    """Share of a beam from an angle [deg] that its glint has, by integration over directions."""
    sun = towards(angle)
    eye, solid = around(sun, gloss.slope_variance(wind))
    found = glint(gloss, np.full(len(eye), facet), UP, np.broadcast_to(sun, eye.shape), eye, wind)
    return float(np.sum(found * solid * eye[:, 2]) / sun[2])


@pytest.mark.parametrize(("name", "wind"), CASES)
@pytest.mark.parametrize("angle", [0.0, 30.0, 60.0, 75.0])
def test_facets_that_mirror_everything_send_back_all_light_however_rough(name: str, wind: float, angle: float) -> None:
    """White furnace; expected within 1 %: cosines are tabulated in 128 steps, and the disc is folded in."""
    assert sent_on(KINDS[name], wind, 1.0, angle) == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize(("name", "wind"), CASES)
@pytest.mark.parametrize("angle", [0.0, 50.0, 75.0])
def test_glint_has_the_power_of_the_beam_times_the_surfaces_reflectance(name: str, wind: float, angle: float) -> None:
    gloss, facet = KINDS[name], 0.02
    rise = float(np.interp(np.cos(np.radians(angle)), COSINE, whole_rise(gloss, wind)))
    assert sent_on(gloss, wind, facet, angle) == pytest.approx(facet + (1.0 - facet) * rise, rel=0.02)


@pytest.mark.parametrize("angle", [0.0, 40.0, 70.0])
def test_flat_panes_mirror_as_fresnel_has_it(angle: float) -> None:
    """Two faces of index 1.515, closed form."""
    one = float(fresnel_reflectance(np.array(1.5153 + 0j), np.array(np.cos(np.radians(angle)))))
    gloss = KINDS["glass"]
    assert sent_on(gloss, 0.0, gloss.nir.highest, angle) == pytest.approx(2.0 * one / (1.0 + one), rel=0.02)


@pytest.mark.parametrize(("name", "wind"), CASES)
def test_light_takes_every_way_back_as_well(name: str, wind: float) -> None:
    """f(i, o) = f(o, i): what a beam sends to the eye per irradiance of the face."""
    gloss, rng = KINDS[name], np.random.default_rng(3)
    sun, eye = rng.normal(size=(2, 500, 3))
    sun[:, 2], eye[:, 2] = np.abs(sun[:, 2]) + 0.05, np.abs(eye[:, 2]) + 0.05
    eye[:250] = sun[:250] * [-1.0, -1.0, 1.0] + 0.02 * rng.normal(size=(250, 3))  # near the mirror direction
    eye[:, 2] = np.maximum(eye[:, 2], 0.05)
    sun, eye = (way / np.linalg.norm(way, axis=1, keepdims=True) for way in (sun, eye))
    facet, reflectance = np.full(500, 0.1), np.full(500, 0.4)

    def share(way: FloatArray, back: FloatArray) -> FloatArray:
        below = scattered(gloss, reflectance, facet, way[:, 2], back[:, 2], wind)
        return np.asarray((glint(gloss, facet, UP, way, back, wind) + below) / way[:, 2])

    there, back = share(sun, eye), share(eye, sun)
    assert there.max() > 0.1
    np.testing.assert_allclose(there, back, rtol=1e-9)


@pytest.mark.parametrize(("name", "wind"), CASES)
@pytest.mark.parametrize("reflectance", [0.0, 0.3, 1.0])
def test_reflectance_is_what_was_given_along_the_normal_and_never_above_one(
    name: str, wind: float, reflectance: float
) -> None:
    """Facets and what lies below them, by integration over the hemisphere; expected 1 %."""
    gloss = KINDS[name]
    facet = float(gloss.nir.mirrored(np.array(reflectance)))
    cosine = (np.arange(4000) + 0.5) / 4000.0
    for angle in (0.0, 60.0):
        sun = np.full(4000, np.cos(np.radians(angle)))
        below = scattered(gloss, np.array(reflectance), np.array(facet), sun, cosine, wind) / sun
        total = sent_on(gloss, wind, facet, angle) + 2.0 * np.pi * float(np.mean(below * cosine))
        rise = float(np.interp(sun[0], COSINE, whole_rise(gloss, wind)))
        assert total == pytest.approx(reflectance + (1.0 - reflectance) * rise, abs=0.01)
        assert total <= 1.01
        if angle == 0.0:
            assert total == pytest.approx(reflectance, abs=0.01)


@pytest.mark.parametrize("name", ["glass", "sheet metal"])
@pytest.mark.parametrize("angle", [0.0, 30.0, 55.0])
def test_glint_peaks_at_the_mirror_angle(name: str, angle: float) -> None:
    """Sweep through the plane of the sun; a lobe of finite width leans to grazing, by less than its own width."""
    swept = np.linspace(-80.0, 80.0, 3201)
    eye = np.stack([-np.sin(np.radians(swept)), np.zeros_like(swept), np.cos(np.radians(swept))], axis=-1)
    gloss = KINDS[name]
    found = glint(gloss, np.full(len(eye), 0.05), UP, np.broadcast_to(towards(angle), eye.shape), eye)
    assert abs(swept[np.argmax(found)] - angle) <= 0.06 + 0.5 * gloss.spread


@pytest.mark.parametrize("angle", [0.0, 40.0, 80.0])
def test_flat_mirror_shows_the_disc_as_bright_as_it_is_and_no_brighter(angle: float) -> None:
    sun, eye = towards(angle)[None], towards(-angle)[None]
    disc = 1.0 / (np.pi * SUN_RADIUS**2)
    gloss = KINDS["glass"]
    mirrored = float(np.interp(np.cos(np.radians(angle)), COSINE, 0.1 + 0.9 * gloss.nir.rise))
    assert glint(gloss, np.array([0.1]), UP, sun, eye)[0] == pytest.approx(mirrored * disc, rel=1e-3)
    for name, wind in CASES:
        ways, _ = around(towards(angle), KINDS[name].slope_variance(wind))
        found = glint(KINDS[name], np.ones(len(ways)), UP, np.broadcast_to(sun, ways.shape), ways, wind)
        assert found.max() <= disc * (1.0 + 1e-3)


def test_no_glint_is_brighter_than_the_disc_at_the_flattest_angles() -> None:
    """Sun and eye within two widths of the disc of the face itself, on all sides."""
    rng = np.random.default_rng(3)
    up, azimuth = rng.uniform(1e-5, 4.0 * SUN_RADIUS, (2, 20000)), rng.normal(0.0, 2.0 * SUN_RADIUS, 20000)
    level = np.sqrt(1.0 - up**2)
    sun = np.stack([level[0], np.zeros(20000), up[0]], axis=1)
    eye = np.stack([-level[1] * np.cos(azimuth), level[1] * np.sin(azimuth), up[1]], axis=1)
    found = glint(KINDS["glass"], np.ones(20000), UP, sun, eye)
    assert 0.3 < found.max() * np.pi * SUN_RADIUS**2 <= 1.0 + 1e-9


def test_no_glint_from_a_sun_below_the_face() -> None:
    rng = np.random.default_rng(1)
    sun, eye = rng.normal(size=(2, 200, 3))
    sun[:, 2], eye[:, 2] = -np.abs(sun[:, 2]), np.abs(eye[:, 2])
    sun, eye = (way / np.linalg.norm(way, axis=1, keepdims=True) for way in (sun, eye))
    for name, wind in CASES:
        assert not glint(KINDS[name], np.ones(200), UP, sun, eye, wind).any()


def test_waves_are_those_of_cox_and_munk() -> None:
    """[CoxMunk1954]: mean square slope 0.003 + 0.00512 per metre a second of wind, in steps of 0.0005."""
    water = KINDS["water"]
    for wind in (0.0, 3.3, 10.0, 14.0):
        assert water.slope_variance(wind) == pytest.approx(0.003 + 0.00512 * wind, abs=2.6e-4)
    assert KINDS["glass"].slope_variance(9.0) == 0.0


def test_rough_water_mirrors_less_at_grazing_angles_and_no_less_along_the_normal() -> None:
    calm, rough = whole_rise(KINDS["water"], 0.0), whole_rise(KINDS["water"], 15.0)
    assert rough[8] < 0.6 * calm[8]
    assert abs(rough[-1] - calm[-1]) < 1e-3


@pytest.mark.parametrize("spread", [0.0, 1.0, 10.0, 40.0])
def test_slopes_have_the_lobe_that_was_asked_for(spread: float) -> None:
    """At half the spread's slope, half the density: facets turn by half of what their light turns."""
    variance = lobe_variance(spread)
    assert lobe_spread(variance) == pytest.approx(spread, abs=1e-12)
    if spread > 0.0:
        assert np.exp(-(np.tan(np.radians(spread / 2.0)) ** 2) / variance) == pytest.approx(0.5, rel=1e-12)


@pytest.mark.parametrize("variance", [1e-6, 1e-3, 0.05, 0.5])
def test_weights_of_facets_add_up_and_lie_between_the_ends(variance: float) -> None:
    held = facets(variance)
    np.testing.assert_allclose(held.weight.sum(axis=1), 1.0, rtol=1e-8)
    assert (held.weight >= 0.0).all()
    assert (held.seen >= 0.0).all()
