"""What glossy surfaces may show: never less than what any of them does show in a reflective band, and not much more."""

from dataclasses import replace

import numpy as np
import pytest
from gloss_twin import glint, glossy
from pond_world import NORTH, pond, southern
from small_world import random_normals

from sensorsim.effects import Glossy, diffuse_irradiance, gleam, read_choice
from sensorsim.effects.glint import glints
from sensorsim.environment import SUN_RADIUS, clear_glow
from sensorsim.materials.gloss import load_gloss
from sensorsim.render import Camera, Renderer, look_at
from sensorsim.render.illumination import SKY_ENTRIES, Illumination
from sensorsim.render.mirror import facet_table
from sensorsim.sensor import load_sensor
from sensorsim.thermal import quadrant_view_factors

FloatArray = np.ndarray
DISC = 1.0 / (np.pi * SUN_RADIUS**2)
BALLS, RAYS = 100, 60
KINDS = load_gloss()


def lit(seed: int) -> Illumination:
    """A clear sky and a sun anywhere above the horizon, in some wind."""
    rng = np.random.default_rng(seed)
    height = float(rng.uniform(0.02, 0.98))
    light = southern(float(rng.uniform(50.0, 300.0)), height, wind=float(rng.choice([0.0, 3.0, 12.0])))
    return replace(
        light, glow=clear_glow(20.0, light.sun_direction, SKY_ENTRIES), quadrant=rng.uniform(1.0, 9.0, 4)
    )  # fmt: skip


def balls(light: Illumination, seed: int, widest: float) -> Glossy:
    """Surfaces of all kinds, half of them near the mirror direction of the light."""
    rng = np.random.default_rng(seed)
    normal, eye = random_normals(BALLS, seed), random_normals(BALLS, seed + 1)
    eye = np.where(np.sum(eye * normal, axis=1)[:, None] < 0.0, -eye, eye)
    facing = normal @ light.sun_direction
    near = 2.0 * facing[:, None] * normal - light.sun_direction + rng.uniform(0.0, 0.1) * rng.normal(size=(BALLS, 3))
    eye = np.where(((np.arange(BALLS) % 2 == 0) & (facing > 0.0))[:, None], near, eye)
    kind, reflectance = rng.integers(0, len(KINDS), BALLS), rng.uniform(0.05, 0.9, BALLS)
    return Glossy(
        normal=normal, eye=eye / np.linalg.norm(eye, axis=1, keepdims=True), reach=rng.uniform(0.0, widest, BALLS),
        kind=kind, reflectance=reflectance, facets=facet_table(light.wind_speed),
        facet=np.array([KINDS[row].nir.mirrored(np.array(r)) for row, r in zip(kind, reflectance, strict=True)]),
        even=max(float(light.sky.max()), light.ground_radiance), glow=light.glow,
    )  # fmt: skip


def seen_from(surfaces: Glossy, row: int, seed: int) -> FloatArray:
    """Directions (n, 3) to the eye within the reach of one, from which it shows."""
    rng = np.random.default_rng(1000 * seed + row)
    off = rng.normal(size=(RAYS, 3))
    off *= surfaces.reach[row] * rng.uniform(0.0, 1.0, (RAYS, 1)) ** 0.3 / np.linalg.norm(off, axis=1, keepdims=True)
    eye = np.vstack([surfaces.eye[row], surfaces.eye[row] + off])
    eye = eye / np.linalg.norm(eye, axis=1, keepdims=True)
    kept = np.linalg.norm(eye - surfaces.eye[row], axis=1) <= surfaces.reach[row] + 1e-12
    return eye[kept & (eye @ surfaces.normal[row] > 0.0)]


@pytest.mark.parametrize("seed", range(4))
def test_no_direction_in_reach_shows_a_brighter_glint_or_a_greater_change(seed: int) -> None:
    light = lit(seed)
    surfaces = balls(light, 10 * seed, widest=(0.0, 0.02, 0.1, 0.4)[seed])
    bound = glints(surfaces, light.sun_direction, light.beam)
    assert np.all(bound <= DISC * light.beam)
    for row in range(BALLS):
        eye, gloss = seen_from(surfaces, row, seed), KINDS[surfaces.kind[row]]
        normal = np.broadcast_to(surfaces.normal[row], eye.shape)
        sun = np.broadcast_to(light.sun_direction, eye.shape)
        facet, reflectance = np.full(len(eye), surfaces.facet[row]), np.full(len(eye), surfaces.reflectance[row])
        shown = light.beam * glint(gloss, facet, normal, sun, eye, light.wind_speed)
        assert shown.max(initial=0.0) <= bound[row] * (1.0 + 1e-9), gloss.name
        alone = replace_rows(surfaces, row)
        low, high = diffuse_irradiance(alone.normal, light.quadrant, light.ground_radiance)
        held = gleam(alone, light.sun_direction, light.beam, (low, high))
        factor = quadrant_view_factors(alone.normal)[0]
        diffuse = 4.0 * factor @ light.quadrant + np.pi * light.ground_radiance * 0.5 * (1.0 - alone.normal[0, 2])
        assert low[0] - 1e-9 <= diffuse <= high[0] + 1e-9
        whole = glossy(gloss, reflectance, normal, -eye, np.full(len(eye), diffuse), light)
        into = max(float(alone.normal[0] @ light.sun_direction), 0.0)
        matt = reflectance * (light.beam * into + diffuse) / np.pi
        assert whole.max(initial=0.0) <= held.sent * (1.0 + 1e-9), gloss.name
        assert np.abs(whole - matt).max(initial=0.0) <= held.change * (1.0 + 1e-9), gloss.name


def replace_rows(surfaces: Glossy, row: int) -> Glossy:
    """One of them alone."""
    own = ("normal", "eye", "reach", "kind", "reflectance", "facet")
    return replace(surfaces, **{name: getattr(surfaces, name)[row : row + 1] for name in own})


def test_bound_of_one_direction_is_the_glint_itself_where_facets_are_far_rougher_than_the_disc() -> None:
    light = lit(0)
    surfaces = balls(light, 3, widest=0.0)
    bound = glints(surfaces, light.sun_direction, light.beam)
    count = 0
    for row in range(BALLS):
        gloss, eye = KINDS[surfaces.kind[row]], surfaces.eye[row : row + 1]
        if gloss.spread == 0.0:
            continue
        sun = light.sun_direction[None]
        shown = light.beam * glint(gloss, surfaces.facet[row : row + 1], surfaces.normal[row : row + 1], sun, eye)
        if shown[0] > 1e-3 and eye[0] @ surfaces.normal[row] > 0.05:
            assert shown[0] <= bound[row] * (1.0 + 1e-9)
            assert bound[row] < 1.2 * shown[0]
            count += 1
    assert count > 5


def test_surfaces_turned_from_the_light_have_no_glint_and_no_surface_has_no_gleam() -> None:
    light = lit(1)
    surfaces = balls(light, 5, widest=0.1)
    away = surfaces.normal @ light.sun_direction <= 0.0
    assert 10 < away.sum() < BALLS
    assert not glints(surfaces, light.sun_direction, light.beam)[away].any()
    none = replace_rows(surfaces, BALLS)
    assert gleam(none, light.sun_direction, light.beam, (np.zeros(0), np.zeros(0))).sent == 0.0


CAMERAS = [
    NORTH,
    look_at([0.0, -160.0, 25.0], [0.0, 60.0, 5.0], 50.0),
    look_at([0.0, 100.0, 3.0], [0.0, 0.0, 0.0], 20.0),
]


@pytest.mark.parametrize("camera", CAMERAS)
def test_what_a_picture_of_water_and_glass_loses_without_gloss_sun_or_air_is_less_than_its_bounds(
    camera: Camera,
) -> None:
    """By the moon, near sunrise and at noon."""
    for effect in ("specular", "reflected_sun", "atmosphere"):
        one, two = (replace(pond(), choice=read_choice(text)) for text in ("all", f"all,-{effect}"))
        lltv = load_sensor("lltv")
        with Renderer(one, lltv, size=(120, 90)) as whole, Renderer(two, lltv, size=(120, 90)) as less:
            for hour in (0.5, 7.6, 12.0):
                lean = less.render(camera, 3600.0 * hour)
                change = np.abs(whole.render(camera, 3600.0 * hour).planes["radiance"] - lean.planes["radiance"]).max()
                assert change <= lean.ledger.row(effect).bound * (1.0 + 1e-6), (effect, hour)


def test_bounds_of_a_picture_without_a_glint_are_no_brighter_than_a_white_surface() -> None:
    """From the south at noon no water or glass can mirror the sun: bounds were those of its disc before."""
    camera = look_at([0.0, -160.0, 25.0], [0.0, 60.0, 5.0], 50.0)
    with Renderer(pond(), load_sensor("lltv"), size=(120, 90)) as renderer:
        picture = renderer.render(camera, 43200.0)
    white = (picture.illumination.beam + float(picture.illumination.quadrant.sum())) / np.pi
    for effect in ("specular", "reflected_sun", "atmosphere"):
        assert picture.ledger.row(effect).bound < 2.0 * white, effect
