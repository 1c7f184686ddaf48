"""Glossy surfaces in a reflective band: the shader against its twin, under light of one radiance, and in pictures."""

from dataclasses import replace

import moderngl
import numpy as np
import pytest
from gloss_twin import glossy
from glsl_harness import evaluate
from picture_twin import pixel_rays
from pond_world import NORTH, pond, southern
from small_world import random_normals

from sensorsim.effects import read_choice
from sensorsim.environment import clear_glow
from sensorsim.gpu import constants_glsl, float_table
from sensorsim.materials.gloss import load_gloss
from sensorsim.render import Camera, Renderer, look_at
from sensorsim.render.blocks import ILLUMINATION
from sensorsim.render.illumination import SKY_ENTRIES, Illumination, dark
from sensorsim.render.mirror import mirror_glsl
from sensorsim.sensor import load_sensor
from sensorsim.thermal import quadrant_view_factors

COUNT = 3000
SUN = np.array([0.36, -0.48, 0.8])


def _seen_surfaces() -> dict[str, np.ndarray]:
    """Random faces and directions from which they show."""
    normal, view = random_normals(COUNT), random_normals(COUNT, seed=22)
    view = np.where(np.sum(view * normal, axis=1)[:, None] > 0.0, -view, view)
    return {"normal": normal, "view": view, "quarters": quadrant_view_factors(normal)}


@pytest.mark.parametrize("wind", [0.0, 8.0])
def test_glossy_low_light_radiance_is_its_twin(ctx: moderngl.Context, wind: float) -> None:
    """Every kind of gloss, all directions, half of them near the mirror direction; expected: single precision's share.

    On flat panes that is of the slope of a facet against the sun's disc, a few thousandths.
    """
    light, kinds, seen = _sunny(wind), load_gloss(), _seen_surfaces()
    normal, view, rng = seen["normal"], seen["view"], np.random.default_rng(8)
    mirrored = SUN - 2.0 * (normal @ SUN)[:, None] * normal + 0.01 * rng.normal(size=(COUNT, 3))
    near = (np.arange(COUNT) % 2 == 0) & (np.sum(mirrored * normal, axis=1) < -0.05)
    view = np.where(near[:, None], mirrored / np.linalg.norm(mirrored, axis=1, keepdims=True), view)
    kind, reflectance = rng.integers(0, len(kinds), COUNT), rng.uniform(0.0, 0.95, COUNT)
    facet = np.select([kind == row for row in range(len(kinds))], [gloss.nir.mirrored(reflectance) for gloss in kinds])
    factors = seen["quarters"]
    shaded = _glossy(
        ctx, light, {**seen, "view": view, "reflectance": reflectance, "gloss": np.column_stack([kind, facet])}
    )
    diffuse = 4.0 * factors @ light.quadrant + np.pi * light.ground_radiance * 0.5 * (1.0 - normal[:, 2])
    twin = np.zeros(COUNT)
    for row, gloss in enumerate(kinds):
        held = kind == row
        twin[held] = glossy(gloss, reflectance[held], normal[held], view[held], diffuse[held], light)
    assert twin.max() > 1e5
    assert np.abs(shaded / twin - 1.0).max() < 5e-3
    assert np.median(np.abs(shaded / twin - 1.0)) < 1e-5


@pytest.mark.parametrize("wind", [0.0, 8.0])
def test_white_gloss_under_light_of_one_radiance_is_as_bright_however_rough(ctx: moderngl.Context, wind: float) -> None:
    """White furnace: sky and ground of one radiance and a surface that reflects everything, seen from any side."""
    seen, kinds = _seen_surfaces(), load_gloss()
    light = replace(
        dark(), sky=np.full(SKY_ENTRIES, 20.0), ground_radiance=20.0, quadrant=np.full(4, np.pi / 4.0 * 20.0),
        wind_speed=wind,
    )  # fmt: skip
    for row, gloss in enumerate(kinds):
        facet = np.full(COUNT, gloss.nir.mirrored(np.array(1.0)))
        ones = {"reflectance": np.ones(COUNT), "gloss": np.column_stack([np.full(COUNT, row), facet])}
        np.testing.assert_allclose(_glossy(ctx, light, {**seen, **ones}), 20.0, rtol=1e-5)


def _sunny(wind: float) -> Illumination:
    """A clear sky with its glow around `SUN`."""
    return replace(
        dark(), sun_direction=SUN, beam=150.0, quadrant=np.array([12.0, 30.0, 55.0, 9.0]), ground_radiance=3.0,
        sky=np.linspace(2.0, 1.0, SKY_ENTRIES), glow=clear_glow(20.0, SUN, SKY_ENTRIES), wind_speed=wind,
    )  # fmt: skip


def _glossy(ctx: moderngl.Context, light: Illumination, inputs: dict[str, np.ndarray]) -> np.ndarray:
    """Radiance of glossy surfaces in a reflective band, in double precision's arrays."""
    textures = {name: float_table(ctx, name, rows) for name, rows in light.mirror_tables(emissive=False).items()}
    held = {
        "quadrant": light.quadrant, "sun_direction": light.sun_direction, "beam": light.beam,
        "sky_radiance": light.sky_radiance, "ground_radiance": light.ground_radiance, "mirrors": 1.0,
    }  # fmt: skip
    shaded = evaluate(
        ctx, "glossy_radiance(gloss, reflectance, normal, view, quarters)", inputs,
        include=["radiance/glossy.glsl"],
        generated={"constants": constants_glsl(), "mirror_size": mirror_glsl()},
        blocks={ILLUMINATION: ILLUMINATION.pack(**held)},
        tables=textures,
    )  # fmt: skip
    for texture in textures.values():
        texture.release()
    return shaded.astype(np.float64)


@pytest.mark.parametrize("beam", [200.0, 3e-4])  # of the sun, and of the moon
def test_calm_water_glitters_where_it_mirrors_the_light(beam: float) -> None:
    with Renderer(pond(), load_sensor("lltv"), size=(120, 90), atmosphere="none") as renderer:
        lit, unlit = (
            renderer.render(NORTH, 43200.0, illumination=southern(light)).planes["radiance"] for light in (beam, 0.0)
        )
    more = (lit - unlit) / beam
    row, column = np.unravel_index(np.argmax(more), more.shape)
    ray = pixel_rays(NORTH, (120, 90))[row, column]
    towards = ray * [1.0, 1.0, -1.0] @ southern(beam).sun_direction
    assert np.degrees(np.arccos(towards)) < 6.0  # waves of a calm lean it to grazing angles
    assert more.max() > 0.3


def test_wind_spreads_the_glitter_and_takes_its_peak() -> None:
    with Renderer(pond(), load_sensor("lltv"), size=(120, 90), atmosphere="none") as renderer:
        calm, windy = (
            renderer.render(NORTH, 43200.0, illumination=southern(200.0, wind=wind)).planes["radiance"]
            for wind in (0.0, 10.0)
        )
    assert windy.max() < 0.5 * calm.max()
    assert np.mean(windy > 0.2 * windy.max()) > 1.5 * np.mean(calm > 0.2 * calm.max())


@pytest.mark.parametrize("camera", [NORTH, look_at([0.0, -160.0, 25.0], [0.0, 60.0, 5.0], 50.0)])
@pytest.mark.parametrize("hour", [0.5, 13.0])
def test_mirrors_of_a_low_light_picture_are_worth_less_than_their_bound(camera: Camera, hour: float) -> None:
    """By night, of the sky alone, and by day; the picture without them is that of the effect left out."""
    pictures = []
    for text in ("all", "all,-specular"):
        with Renderer(replace(pond(), choice=read_choice(text)), load_sensor("lltv"), size=(120, 90)) as renderer:
            pictures.append(renderer.render(camera, 3600.0 * hour))
    change = float(np.abs(pictures[0].planes["radiance"] - pictures[1].planes["radiance"]).max())
    row = pictures[1].ledger.row("specular")
    assert row.tolerance < change <= row.bound
    assert not row.on


def test_frames_for_display_alone_glitter_as_whole_ones() -> None:
    with Renderer(pond(), load_sensor("lltv"), size=(120, 90)) as renderer:
        for hour in (0.5, 12.0):
            quick = renderer.render(NORTH, 3600.0 * hour, planes=("display",)).planes["display"]
            whole = renderer.render(NORTH, 3600.0 * hour).planes["display"]
            assert np.abs(quick.astype(int) - whole).max() <= 1
            assert quick.std() > 1.0
