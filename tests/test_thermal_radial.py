"""Cylinders and spheres: closed forms of steady and transient radial conduction, pipes, and the flat limit."""

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import j0, j1
from wall_cases import DARK, FloatArray, constant, gap, indoors, outdoors, slab

from sensorsim.errors import InputError
from sensorsim.materials import Construction
from sensorsim.thermal import build_grid, march, march_paths, transmittance
from sensorsim.thermal.shells import Shells

CURVED = ("cylinder", "sphere")
PIPE = (slab(0.02, 0.04, 100.0, 900.0), slab(0.005, 50.0, 7800.0, 480.0))  # insulation on steel
RADIUS = 0.08
HOT, COLD = 350.0, 280.0


def _resistance(shape: str, radius: float, inner: float, outer: float) -> float:
    """Of a shell, times conductivity, per unit of area at `radius`."""
    return radius * np.log(outer / inner) if shape == "cylinder" else radius**2 * (1.0 / inner - 1.0 / outer)


def _pipe_resistance(shape: str) -> float:
    lagging = _resistance(shape, RADIUS, RADIUS - 0.02, RADIUS) / 0.04
    return lagging + _resistance(shape, RADIUS, RADIUS - 0.025, RADIUS - 0.02) / 50.0


@pytest.mark.parametrize("shape", CURVED)
@pytest.mark.parametrize("step", [1.0, 60.0, 3600.0])
def test_resistance_from_face_to_face_is_that_of_the_closed_form(shape: str, step: float) -> None:
    """Expected: to rounding, with any number of cells."""
    grid = build_grid(PIPE, step, shape=shape, radius=RADIUS)
    assert float(np.sum(1.0 / grid.conductance)) == pytest.approx(_pipe_resistance(shape), rel=1e-12)


@pytest.mark.parametrize(("shape", "power"), [("cylinder", 1), ("sphere", 2)])
def test_cells_hold_the_heat_of_their_shells(shape: str, power: int) -> None:
    grid = build_grid(PIPE, 60.0, shape=shape, radius=RADIUS)
    faces = np.array([RADIUS, RADIUS - 0.02, RADIUS - 0.025])
    volume = -np.diff(faces ** (power + 1)) / ((power + 1) * RADIUS**power)
    assert float(grid.capacity.sum()) == pytest.approx(volume @ [100.0 * 900.0, 7800.0 * 480.0], rel=1e-12)
    assert grid.interior_area == pytest.approx((1.0 - 0.025 / RADIUS) ** power, rel=1e-12)


@pytest.mark.parametrize("shape", CURVED)
def test_steady_pipe_has_the_closed_forms_temperatures_in_every_cell(shape: str) -> None:
    """A fluid inside and air outside: films in series with the shells, the inner film on its own, smaller area."""
    inner_film, outer_film, count = 40.0, 12.0, 400
    record = np.array([count - 1])
    grid = build_grid(PIPE, 3600.0, shape=shape, radius=RADIUS)
    history = march(
        PIPE, outdoors(constant(COLD, count), outer_film), indoors(constant(HOT, count), inner_film), DARK,
        step=3600.0, record=record, keep_nodes=True, grid=grid,
    )  # fmt: skip
    ratio = ((RADIUS - 0.025) / RADIUS) ** (1 if shape == "cylinder" else 2)
    total = 1.0 / outer_film + _pipe_resistance(shape) + 1.0 / (inner_film * ratio)
    flux = (HOT - COLD) / total
    assert history.exterior[0, 0, 0] == pytest.approx(COLD + flux / outer_film, abs=1e-7)
    assert history.interior[0, 0, 0] == pytest.approx(HOT - flux / (inner_film * ratio), abs=1e-7)
    assert history.nodes is not None
    lagging = grid.depth < 0.02
    radius = RADIUS - grid.depth[lagging]
    exact = [COLD + flux / outer_film + flux * _resistance(shape, RADIUS, r, RADIUS) / 0.04 for r in radius]
    np.testing.assert_allclose(history.nodes[0, lagging, 0, 0], exact, rtol=0.0, atol=1e-7)


@pytest.mark.parametrize("shape", CURVED)
def test_transmittance_of_a_pipe_counts_the_inner_film_on_its_own_area(shape: str) -> None:
    pipe = Construction(name="pipe", description="", layers=PIPE, source="", shape=shape, radius=RADIUS)
    ratio = ((RADIUS - 0.025) / RADIUS) ** (1 if shape == "cylinder" else 2)
    exact = 1.0 / (0.1 + _pipe_resistance(shape) + 0.02 / ratio)
    assert transmittance(pipe, 0.1, 0.02) == pytest.approx(exact, rel=1e-12)


def test_resistance_layer_counts_on_the_area_where_it_stands() -> None:
    grid = build_grid((PIPE[0], gap(0.1), PIPE[1]), 60.0, shape="sphere", radius=RADIUS)
    plain = build_grid(PIPE, 60.0, shape="sphere", radius=RADIUS)
    more = float(np.sum(1.0 / grid.conductance) - np.sum(1.0 / plain.conductance))
    assert more == pytest.approx(0.1 * (0.08 / 0.06) ** 2, rel=1e-9)


def _series(shape: str, biot: float, fourier: FloatArray, place: FloatArray) -> FloatArray:
    """Excess (fourier, place) over the fluid of a solid body that started uniform at 1; place is radius over radius."""
    if shape == "cylinder":

        def balance(z: float) -> float:
            return float(z * j1(z) - biot * j0(z))
    else:

        def balance(z: float) -> float:
            return float(z * np.cos(z) - (1.0 - biot) * np.sin(z))

    grid = np.linspace(1e-6, 160.0, 16001)
    signs = np.array([balance(z) for z in grid])
    roots = np.array([brentq(balance, grid[i], grid[i + 1]) for i in np.nonzero(signs[:-1] * signs[1:] < 0.0)[0]])
    if shape == "cylinder":
        weight = 2.0 * j1(roots) / (roots * (j0(roots) ** 2 + j1(roots) ** 2))
        form = j0(np.outer(place, roots))
    else:
        weight = 4.0 * (np.sin(roots) - roots * np.cos(roots)) / (2.0 * roots - np.sin(2.0 * roots))
        form = np.sinc(np.outer(place, roots) / np.pi)
    return np.asarray(np.exp(-np.outer(fourier, roots**2)) @ (weight[:, None] * form.T))


@pytest.mark.parametrize("biot", [0.1, 1.0, 10.0])
@pytest.mark.parametrize("shape", CURVED)
def test_solid_body_cools_as_its_series(shape: str, biot: float) -> None:
    """Expected: within 1e-3 of the initial excess, at the surface and in every cell, from Fourier number 0.02 on."""
    radius, conductivity, heat = 0.15, 0.5, 1.5e6
    body = (slab(radius, conductivity, 1500.0, 1000.0),)
    seconds = radius**2 * heat / conductivity  # of one Fourier number
    step = 1e-3 * seconds
    count = 1001
    record = np.array([20, 50, 100, 200, 500, 1000])
    grid = build_grid(body, step / 10.0, shape=shape, radius=radius, cell_size=0.2)
    assert grid.interior_area == 0.0
    history = march(
        body, outdoors(constant(COLD, count), biot * conductivity / radius), indoors(constant(COLD, count), 5.0), DARK,
        step=step, record=record, keep_nodes=True, grid=grid, start=constant(COLD + 1.0, grid.depth.size),
    )  # fmt: skip
    place = np.concatenate([[1.0], 1.0 - grid.depth / radius])
    exact = _series(shape, biot, record * 1e-3, place)
    assert history.nodes is not None
    found = np.concatenate([history.exterior[:, None, 0, 0], history.nodes[:, :, 0, 0]], axis=1) - COLD
    assert np.abs(found - exact).max() < 1e-3


@pytest.mark.parametrize("shape", CURVED)
def test_heat_that_enters_a_solid_body_is_stored_and_none_leaves_through_its_middle(shape: str) -> None:
    body = (slab(0.15, 0.5, 1500.0, 1000.0),)
    count = 200
    grid = build_grid(body, 300.0, shape=shape, radius=0.15)
    history = march(
        body, outdoors(np.linspace(280.0, 310.0, count), 10.0), indoors(constant(250.0, count), 1000.0), DARK,
        step=300.0, record=np.array([count - 1]), grid=grid,
    )  # fmt: skip
    entered = float(history.heat[0, 0, 0])
    assert history.heat[1, 0, 0] == 0.0
    assert float(history.stored[0, 0]) == pytest.approx(entered, rel=1e-12)
    assert 280.0 < history.interior[0, 0, 0] < 310.0


@pytest.mark.parametrize("shape", CURVED)
def test_wall_of_a_huge_radius_is_a_flat_one(shape: str) -> None:
    layers = (slab(0.1, 1.3, 2400.0, 800.0), gap(0.1), slab(0.1, 0.9, 1900.0, 800.0))
    count = 289
    air = 280.0 + 8.0 * np.sin(2.0 * np.pi * np.arange(count) / 288.0)
    runs = [
        march(
            layers, outdoors(air, 12.0, sun=300.0), indoors(constant(293.0, count), 6.0), np.array([0.7]),
            step=300.0, record=np.arange(count), grid=build_grid(layers, 300.0, **curved),
        ).exterior
        for curved in ({}, {"shape": shape, "radius": 1e7})
    ]  # fmt: skip
    assert np.abs(runs[0] - runs[1]).max() < 1e-6


def test_thin_tube_of_small_radius_stores_and_conducts_less_inside() -> None:
    """A curved wall warms faster in the sun than a flat one of the same layers: less of it lies behind its face."""
    wood = (slab(0.1, 0.13, 500.0, 1600.0),)
    count = 145
    rise = []
    for shape, radius in (("slab", None), ("cylinder", 0.1), ("sphere", 0.1)):
        trunk = Construction(name="trunk", description="", layers=wood, source="", shape=shape, radius=radius)
        history = march_paths(
            trunk, outdoors(constant(280.0, count), 12.0, sun=500.0), indoors(constant(280.0, count), 0.0),
            np.array([0.8]), step=300.0, record=np.array([count - 1]),
        )  # fmt: skip
        rise.append(float(history.exterior[0, 0, 0]) - 280.0)
    assert rise[0] < rise[1] < rise[2]
    assert rise[2] < 0.8 * 500.0 / 12.0


@pytest.mark.parametrize(
    ("shape", "radius", "message"),
    [
        ("cone", 0.1, "shape = 'cone': unknown shape; use one of slab, cylinder, sphere"),
        ("cylinder", None, "radius = None: a cylinder needs one above 0"),
        ("sphere", 0.0, "radius = 0.0: a sphere needs one above 0"),
        ("sphere", float("nan"), "radius = nan: a sphere needs one above 0"),
        ("slab", 0.1, "radius = 0.1: a slab has none"),
        ("cylinder", 0.02, "layers reach 0.025 m deep; make the layers thinner"),
    ],
)
def test_wrong_shape_is_told_in_one_line(shape: str, radius: float | None, message: str) -> None:
    with pytest.raises(InputError) as caught:
        build_grid(PIPE, 60.0, shape=shape, radius=radius)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("shape", CURVED)
def test_middle_of_a_cell_is_where_a_parabola_takes_its_mean(shape: str) -> None:
    shells = Shells(shape=shape, radius=0.3)
    for depth, thickness in ((0.0, 0.3), (0.05, 0.1), (0.1, 1e-6)):
        r = np.linspace(0.3 - depth - thickness, 0.3 - depth, 200001)
        weight = r ** (1 if shape == "cylinder" else 2)
        mean = np.trapezoid(weight * r**2, r) / np.trapezoid(weight, r)
        assert 0.3 - depth - shells.middle(depth, thickness) == pytest.approx(np.sqrt(mean), rel=1e-8)
