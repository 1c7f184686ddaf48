"""Each shader function of the surface pass, alone, against its twin in NumPy."""

from collections.abc import Callable, Mapping
from typing import Any

import moderngl
import numpy as np
import pytest
from glsl_harness import evaluate
from small_world import plain_tables, random_normals, tables

from sensorsim.environment import AirPath, clear_path, single_term
from sensorsim.gpu import constants_glsl, float_table
from sensorsim.materials.gloss import load_gloss
from sensorsim.radiometry import FLIR_BAND, BandTable, build_band_table
from sensorsim.render.air import air_values
from sensorsim.render.blocks import AIR, ILLUMINATION
from sensorsim.render.mirror import mirror_glsl, mirror_table, rise_table
from sensorsim.tables import LookupTable, ShadeTables, evaluate_polynomial, surface_temperature
from sensorsim.tables.coefficient_texture import coefficient_glsl, coefficient_texels, lobe_texels
from sensorsim.tables.coefficients import Moment
from sensorsim.tables.straighten import UNBENT
from sensorsim.thermal import quadrant_view_factors

COUNT = 3000
SUN = np.array([0.36, -0.48, 0.8])


def _light(**changes: Any) -> dict[str, Any]:
    """Surroundings of a frame as the block takes them."""
    return {
        "quadrant": np.array([12.0, 30.0, 55.0, 9.0]),
        "sun_direction": SUN,
        "beam": 410.0,
        "sky_radiance": 21.0,
        "ground_radiance": 37.0,
        "mirrors": 1.0,
        **changes,
    }


def _shade(
    ctx: moderngl.Context, coefficients: np.ndarray, inputs: Mapping[str, np.ndarray], moment: Moment | None = None
) -> np.ndarray:
    if moment is None:  # no lobes
        nothing, none = np.zeros(coefficients.shape[0]), np.zeros((coefficients.shape[0], 0, 2))
        moment = Moment(
            coefficients=coefficients, level=nothing, loss=np.tile(UNBENT, (nothing.size, 1)), towards=np.zeros(2),
            knot=0.7, direction=np.zeros((0, 3)), weight=none, gain=np.zeros((nothing.size, 5)),
        )  # fmt: skip
    most = moment.direction.shape[0] + 2
    textures = {
        "coefficient_table": float_table(ctx, "coefficient_table", coefficient_texels(coefficients)),
        "lobe_table": float_table(ctx, "lobe_table", lobe_texels(moment, most)),
    }
    result = evaluate(
        ctx, "surface_temperature(wall_type, corner.xyz, weight, reflectance, normal)", inputs,
        include=["radiance/shade.glsl"],
        generated={"coefficients": coefficient_glsl(coefficients.shape[-1], moment.knot)},
        tables=textures,
    )  # fmt: skip
    for texture in textures.values():
        texture.release()
    return result


@pytest.mark.parametrize("made", [tables, plain_tables])
@pytest.mark.parametrize("time", [0.0, 25200.0, 36000.0, 40500.0, 86400.0])
def test_shaded_temperature_is_its_twin_within_five_millikelvin(
    ctx: moderngl.Context, made: Callable[[], ShadeTables], time: float
) -> None:
    """Random normals, walls and reflectances, with and without lobes; single precision leaves a tenth of it."""
    rng, baked = np.random.default_rng(17), made()
    normal, wall = random_normals(COUNT), rng.integers(0, 4, COUNT)
    reflectance = rng.uniform(0.02, 0.98, COUNT)
    corner, weight = baked.orientations.locate(normal)
    padded = np.column_stack([corner, np.zeros(COUNT, dtype=np.int64)])
    inputs = {"wall_type": wall, "corner": padded, "weight": weight, "reflectance": reflectance, "normal": normal}
    moment = baked.at(time)
    shaded = _shade(ctx, moment.coefficients, inputs, moment)
    assert np.abs(shaded - surface_temperature(baked, normal, wall, reflectance, time)).max() < 5e-4


@pytest.mark.parametrize("powers", [1, 2, 3, 4, 5, 8, 9])
def test_polynomials_of_any_degree_are_read_whole(ctx: moderngl.Context, powers: int) -> None:
    """Four powers share a texel: degrees that fill one, spill into the next, or leave room."""
    rng = np.random.default_rng(powers)
    coefficients = rng.uniform(-20.0, 20.0, (2, 6, powers))
    wall, corner = rng.integers(0, 2, 500), rng.integers(0, 6, (500, 4))
    weight, reflectance = rng.dirichlet(np.ones(3), 500), rng.uniform(0.0, 1.0, 500)
    inputs = {
        "wall_type": wall, "corner": corner, "weight": weight, "reflectance": reflectance, "normal": random_normals(500)
    }  # fmt: skip
    blended = np.einsum("mk,mkp->mp", weight, coefficients[wall[:, None], corner[:, :3]])
    twin = evaluate_polynomial(blended, reflectance, knot=0.7)
    np.testing.assert_allclose(_shade(ctx, coefficients, inputs), twin, atol=1e-4)


def _emitted(ctx: moderngl.Context, table: BandTable, mirror: np.ndarray, inputs: dict[str, np.ndarray]) -> np.ndarray:
    """Radiance of surfaces under the surroundings of `_light`, in double precision's arrays."""
    lookup = LookupTable(
        name="band_radiance", quantity="Radiance", argument="Kelvin",
        minimum=150.0, maximum=700.0, values=np.array(table.radiance),
    )  # fmt: skip
    textures = {
        "band_radiance_table": float_table(ctx, "band_radiance_table", lookup.texels),
        "rise_table": float_table(ctx, "rise_table", rise_table()),
        "mirror_table": float_table(ctx, "mirror_table", mirror),
    }
    shaded = evaluate(
        ctx, "emitted_radiance(kelvin, emissivity, normal, view, gloss)", inputs,
        include=["radiance/emitted.glsl"],
        generated={"band_radiance": lookup.glsl(), "mirror_size": mirror_glsl()},
        blocks={ILLUMINATION: ILLUMINATION.pack(**_light())},
        tables=textures,
    )  # fmt: skip
    for texture in textures.values():
        texture.release()
    return shaded.astype(np.float64)


def _seen_surfaces() -> dict[str, np.ndarray]:
    """Random surfaces and directions from which their faces show."""
    rng = np.random.default_rng(4)
    normal, view = random_normals(COUNT), random_normals(COUNT, seed=22)
    view = np.where(np.sum(view * normal, axis=1)[:, None] > 0.0, -view, view)
    return {
        "kelvin": rng.uniform(200.0, 400.0, COUNT),
        "emissivity": rng.uniform(0.02, 1.0, COUNT),
        "normal": normal,
        "view": view,
    }


def test_emitted_radiance_is_its_twin_within_a_millikelvin(ctx: moderngl.Context) -> None:
    seen, table = _seen_surfaces(), build_band_table(FLIR_BAND)
    matt = np.column_stack([np.full(COUNT, -1.0), seen["emissivity"]])
    shaded = _emitted(ctx, table, mirror_table(np.linspace(37.0, 12.0, 100), 37.0), {**seen, "gloss": matt})
    sky, emissivity = 0.5 * (1.0 + seen["normal"][:, 2]), seen["emissivity"]
    twin = emissivity * table.radiance_at(seen["kelvin"]) + (1.0 - emissivity) * (sky * 21.0 + (1.0 - sky) * 37.0)
    miss = table.apparent_temperature(shaded) - table.apparent_temperature(twin)
    assert np.abs(miss).max() < 1e-3


def test_glossy_radiance_is_its_twin_within_two_millikelvin(ctx: moderngl.Context) -> None:
    """Every kind of gloss, all directions; fractions of a table's step and the mirror direction are in single."""
    seen, table = _seen_surfaces(), build_band_table(FLIR_BAND)
    kinds, mirror = load_gloss(), mirror_table(np.linspace(37.0, 12.0, 100), 37.0)
    kind = np.random.default_rng(5).integers(0, len(kinds), COUNT)
    shaded = _emitted(ctx, table, mirror, {**seen, "gloss": np.column_stack([kind, seen["emissivity"]])})
    cosine = -np.sum(seen["view"] * seen["normal"], axis=1)
    up = seen["view"][:, 2] + 2.0 * cosine * seen["normal"][:, 2]
    twin = np.zeros(COUNT)
    for row, gloss in enumerate(kinds):
        held = kind == row
        emissivity = gloss.emissivity(seen["emissivity"][held], cosine[held])
        shown = np.interp(up[held], np.linspace(-1.0, 1.0, mirror.shape[1]), mirror[row])
        twin[held] = emissivity * table.radiance_at(seen["kelvin"][held]) + (1.0 - emissivity) * shown
    miss = table.apparent_temperature(shaded) - table.apparent_temperature(twin)
    assert np.abs(miss).max() < 2e-3


def test_reflected_radiance_is_its_twin(ctx: moderngl.Context) -> None:
    """Every side of the surface, also where the sun is behind it."""
    light, normal = _light(), random_normals(COUNT)
    reflectance, factors = np.random.default_rng(6).uniform(0.0, 0.95, COUNT), quadrant_view_factors(normal)
    shaded = evaluate(
        ctx, "reflected_radiance(reflectance, normal, quarters)",
        {"reflectance": reflectance, "normal": normal, "quarters": factors},
        include=["radiance/reflected.glsl"],
        generated={"constants": constants_glsl()},
        blocks={ILLUMINATION: ILLUMINATION.pack(**light)},
    )  # fmt: skip
    sun = 410.0 * np.maximum(normal @ light["sun_direction"], 0.0)
    sky = 4.0 * factors @ light["quadrant"]
    ground = np.pi * 37.0 * 0.5 * (1.0 - normal[:, 2])
    np.testing.assert_allclose(shaded, reflectance * (sun + sky + ground) / np.pi, rtol=1e-5, atol=1e-5)


def test_white_roof_under_a_uniform_sky_is_as_bright_as_the_sky(ctx: moderngl.Context) -> None:
    """Rationale: a Lambertian surface of reflectance 1 under radiance L all around has radiance L, however tilted."""
    normal = random_normals(500)
    light = _light(quadrant=np.full(4, np.pi / 4.0 * 20.0), beam=0.0, ground_radiance=20.0)
    shaded = evaluate(
        ctx, "reflected_radiance(1.0, normal, quarters)", {"normal": normal, "quarters": quadrant_view_factors(normal)},
        include=["radiance/reflected.glsl"],
        generated={"constants": constants_glsl()},
        blocks={ILLUMINATION: ILLUMINATION.pack(**light)},
    )  # fmt: skip
    np.testing.assert_allclose(shaded, 20.0, rtol=1e-5)


def _air(**changes: Any) -> AirPath:
    """Four terms that thin out and glow each in its own way."""
    values: dict[str, Any] = {
        "weight": np.array([0.55, 0.25, 0.15, 0.05]),
        "coefficient": np.array([5e-5, 2e-4, 1e-3, 1e-2]),
        "inverse_scale_height": np.array([1e-4, 3e-4, 7e-4, 0.0]),
        "source": np.array([30.0, 33.0, 34.0, 34.5]),
        "source_decay": 1.1e-4,
        "beam_source": np.array([1.0, 0.5, 0.2, 0.0]),
        "asymmetry": 0.65,
    }
    return AirPath(**{**values, **changes})


def _through_air(
    ctx: moderngl.Context, air: AirPath, source: np.ndarray, distance: np.ndarray,
    view: np.ndarray | None = None, camera_height: float = 0.0,
) -> np.ndarray:  # fmt: skip
    if view is None:
        view = np.tile([1.0, 0.0, 0.0], (len(source), 1))
    return evaluate(
        ctx, "apparent_radiance(source, distance_, distance_ * view.z, mean_extinction(distance_ * view.z), view)",
        {"source": source, "distance_": distance, "view": view},
        include=["radiance/path.glsl"],
        blocks={AIR: AIR.pack(**air_values(air, camera_height, SUN))},
    )  # fmt: skip


@pytest.mark.parametrize("camera_height", [0.0, 2.0, 150.0, 3000.0])
def test_air_path_is_its_twin(ctx: moderngl.Context, camera_height: float) -> None:
    """All ranges, up and down, into and away from the sun; expected: 1e-5, single precision's share of exponentials."""
    rng, air = np.random.default_rng(9), _air()
    source, view = rng.uniform(0.0, 90.0, COUNT), random_normals(COUNT)
    target = rng.uniform(0.0, 4000.0, COUNT)
    distance = np.minimum(np.abs((target - camera_height) / view[:, 2]), 60e3)
    target = camera_height + distance * view[:, 2]
    shaded = _through_air(ctx, air, source, distance, view, camera_height)
    twin = air.apparent_radiance(source, distance, camera_height, target, view @ SUN)
    np.testing.assert_allclose(shaded, twin, rtol=2e-5)


def test_path_leaves_a_near_surface_alone_and_a_far_one_to_the_air(ctx: moderngl.Context) -> None:
    """The limits: range 0, infinite range, and no air."""
    source = np.random.default_rng(9).uniform(0.0, 90.0, COUNT).astype(np.float32)
    report = single_term(2.3e-4, 34.0)
    np.testing.assert_allclose(_through_air(ctx, _air(), source, np.zeros(COUNT)), source, rtol=2e-7, atol=4e-6)
    np.testing.assert_array_equal(_through_air(ctx, report, source, np.full(COUNT, 1e9)), np.float32(34.0))
    np.testing.assert_array_equal(_through_air(ctx, clear_path(), source, np.full(COUNT, 1e5)), source)


def test_air_of_the_report_is_its_equation_15(ctx: moderngl.Context) -> None:
    rng = np.random.default_rng(10)
    source, distance, view = rng.uniform(0.0, 90.0, COUNT), rng.uniform(0.0, 20e3, COUNT), random_normals(COUNT)
    transmittance = np.exp(-2.3e-4 * distance)
    shaded = _through_air(ctx, single_term(2.3e-4, 34.0), source, distance, view, 700.0)
    np.testing.assert_allclose(shaded, transmittance * source + (1.0 - transmittance) * 34.0, rtol=1e-5)


def test_surface_as_bright_as_the_air_stays_so_at_any_range(ctx: moderngl.Context) -> None:
    distance = np.geomspace(0.1, 1e6, 400)
    air = _air(source=np.full(4, 34.0), source_decay=0.0, beam_source=np.zeros(4))
    np.testing.assert_allclose(_through_air(ctx, air, np.full(400, 34.0), distance), 34.0, rtol=4e-7)
