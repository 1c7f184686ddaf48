"""Walls with studs and around a centre under a boundary series: closed forms, limits and balances."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from wall_cases import gap, slab

from sensorsim.errors import InputError
from sensorsim.materials import Construction, Layer, ThermalPath, load_construction
from sensorsim.thermal import (
    WallBoundary,
    WallHistory,
    build_wall_boundary,
    exterior_loads,
    march_construction,
    march_wall,
)

HOUR = 3600.0
SURFACE = {"absorptance": 0.7, "emissivity": 0.9, "interior_emissivity": 0.9, "sky_view": 0.5}
BARE = {"absorptance": 0.7, "emissivity": 0.0, "interior_emissivity": 0.0, "sky_view": 0.5}
BRICK = slab(0.1, 0.9, 1900.0, 790.0)


def stack(*layers: Layer, **changes: Any) -> Construction:
    return replace(Construction(name="stack", description="", layers=layers, source="test"), **changes)


def days(count: int) -> WallBoundary:
    hour = np.arange(24 * count + 1, dtype=np.float64)
    return build_wall_boundary(
        HOUR * hour,
        air_temperature=283.0 + 8.0 * np.sin((hour - 9.0) / 12.0 * np.pi),
        sky_temperature=260.0,
        ground_temperature=283.0,
        beam=np.maximum(600.0 * np.sin((hour - 6.0) / 12.0 * np.pi), 0.0),
        exterior_film=15.0,
        interior_air_temperature=293.0,
        interior_film=3.0,
    )


def constant(air: float, indoors: float, exterior_film: float, interior_film: float, count: int = 25) -> WallBoundary:
    return build_wall_boundary(
        HOUR * np.arange(count), air_temperature=air, exterior_film=exterior_film, interior_air_temperature=indoors,
        interior_film=interior_film,
    )  # fmt: skip


def test_paths_of_one_kind_are_one_wall() -> None:
    alike = tuple(ThermalPath(name=name, fraction=share, layers=(BRICK,)) for name, share in (("a", 0.3), ("b", 0.7)))
    both = march_construction(stack(BRICK, paths=alike), days(2), **SURFACE)
    alone = march_wall((BRICK,), days(2), **SURFACE)
    for name in ("exterior", "interior", "heat"):
        np.testing.assert_allclose(getattr(both, name), getattr(alone, name), rtol=1e-12)
    assert both.stored == pytest.approx(alone.stored, rel=1e-12)
    np.testing.assert_allclose(
        exterior_loads(both, days(2)).total, exterior_loads(alone, days(2)).total, rtol=0.0, atol=1e-9
    )


def test_studs_join_by_area_in_heat_and_by_the_fourth_power_in_temperature() -> None:
    wall, boundary = load_construction("insulated_wood_studs"), days(2)
    joined = march_construction(wall, boundary, keep_nodes=True, **SURFACE)
    parts = [(path.fraction, march_wall(path.layers, boundary, **SURFACE)) for path in wall.paths]
    assert joined.share[0] == max(share for share, _ in parts)
    np.testing.assert_allclose(joined.heat, sum(share * part.heat for share, part in parts), rtol=1e-12, atol=1e-6)
    fourth = sum(share * part.exterior**4 for share, part in parts)
    np.testing.assert_allclose(joined.exterior**4, fourth, rtol=1e-12)
    loads = sum(share * exterior_loads(part, boundary).total for share, part in parts)
    np.testing.assert_allclose(exterior_loads(joined, boundary).total, loads, rtol=0.0, atol=1e-9)
    assert abs(joined.energy_residual) < 1e-12
    assert joined.start.time_constant == max(part.start.time_constant for _, part in parts)
    assert joined.nodes is not None
    assert joined.nodes.shape == (boundary.time.size, joined.grid.capacity.size)
    warmer = joined.interior - min((part for _, part in parts), key=lambda part: part.interior.min()).interior
    assert np.max(np.abs(warmer)) > 0.2


@pytest.mark.parametrize(("shape", "power"), [("cylinder", 1), ("sphere", 2)])
def test_steady_heat_through_a_shell_is_the_closed_form(shape: str, power: int) -> None:
    """Flow through r ln(b / a) / k or r^2 (1 / a - 1 / b) / k between both films, the integrals of dr over area."""
    outer, inner, conductivity = 0.2, 0.15, 0.5
    layer = slab(outer - inner, conductivity, 1000.0, 900.0)
    shell = outer * np.log(outer / inner) if power == 1 else outer**2 * (1.0 / inner - 1.0 / outer)
    resistance = 1.0 / 12.0 + shell / conductivity + (outer / inner) ** power / 6.0
    flow = (300.0 - 280.0) / resistance  # outwards, per exterior area
    boundary = constant(280.0, 300.0, 12.0, 6.0)
    history = march_construction(stack(layer, shape=shape, radius=outer), boundary, **BARE, start="steady")
    np.testing.assert_allclose(history.exterior, 280.0 + flow / 12.0, rtol=0.0, atol=1e-8)
    np.testing.assert_allclose(history.interior, 300.0 - flow * (outer / inner) ** power / 6.0, rtol=0.0, atol=1e-8)
    assert history.heat[-1, 1] == pytest.approx(flow * 24 * HOUR, rel=1e-9)
    assert history.heat[-1, 0] == pytest.approx(-flow * 24 * HOUR, rel=1e-9)


@pytest.mark.parametrize("shape", ["cylinder", "sphere"])
def test_a_shell_of_a_huge_radius_is_a_slab(shape: str) -> None:
    curved = march_construction(stack(BRICK, shape=shape, radius=1e7), days(2), **SURFACE)
    flat = march_wall((BRICK,), days(2), **SURFACE)
    np.testing.assert_allclose(curved.exterior, flat.exterior, rtol=0.0, atol=1e-5)
    np.testing.assert_allclose(curved.interior, flat.interior, rtol=0.0, atol=1e-5)


@pytest.mark.parametrize(("shape", "dimension"), [("cylinder", 2), ("sphere", 3)])
def test_a_small_solid_cools_by_its_exponential(shape: str, dimension: int) -> None:
    """Biot number 1e-3: T - T_air = exp(-n h t / (rho c r)), from 20 K above the air that drops at the first step."""
    radius, film, heat = 0.01, 5.0, 2.0e6
    solid = slab(radius, 50.0, 2000.0, heat / 2000.0)
    time = 60.0 * np.arange(61)
    air = np.where(time < 30.0, 300.0, 280.0)
    boundary = build_wall_boundary(
        time, air_temperature=air, exterior_film=film, interior_air_temperature=250.0, interior_film=9.0
    )
    history: WallHistory = march_construction(
        stack(solid, shape=shape, radius=radius), boundary, **BARE, start="steady"
    )
    rate = dimension * film / (heat * radius)
    assert history.start.time_constant == pytest.approx(1.0 / rate, rel=2e-3)
    excess = history.interior[1] - 280.0
    np.testing.assert_allclose(
        history.interior[1:] - 280.0, excess * np.exp(-rate * (time[1:] - 60.0)), rtol=0.0, atol=0.02
    )
    np.testing.assert_allclose(history.interior, history.exterior, rtol=0.0, atol=0.02)
    assert history.heat[-1, 1] == pytest.approx(0.0, abs=1e-6)  # nothing passes the middle, whatever the room is like
    assert abs(history.energy_residual) < 1e-11


def test_curved_walls_that_cannot_be_are_refused() -> None:
    for changes, problem in (({"radius": 0.05}, "layers reach"), ({"radius": None}, "needs one above 0")):
        with pytest.raises(InputError, match=problem):
            march_construction(replace(stack(BRICK), shape="sphere", **changes), days(1), **SURFACE)
    with pytest.raises(InputError, match="layer 1"):
        march_construction(stack(gap(float("nan"))), days(1), **SURFACE)
