"""The made solutions are solutions: of the heat equation, of continuity, and the march tells when they are not."""

import numpy as np
import pytest

from sensorsim.materials import Layer
from sensorsim.study import manufactured
from sensorsim.study.manufactured import (
    INNER_FILM,
    ONE_LAYER,
    SPAN,
    TWO_LAYERS,
    absorbed_sunlight,
    errors_in_space,
    errors_in_time,
    flux_at,
    march_error,
    order,
    temperature_at,
)
from sensorsim.study.wall_setup import uniform_grid

TIME = np.linspace(0.0, SPAN, 97)


@pytest.mark.parametrize("layers", [ONE_LAYER, TWO_LAYERS])
@pytest.mark.parametrize("depth", [0.01, 0.04, 0.07, 0.1])
def test_made_solution_obeys_the_heat_equation(layers: tuple[Layer, ...], depth: float) -> None:
    """Rationale: rho c dT/dt + dq/dx = 0 and q = -k dT/dx, by central differences."""
    layer = layers[0] if depth < layers[0].thickness else layers[-1]
    near, soon = 1e-5, 1.0
    warming = (temperature_at(layers, depth, TIME + soon) - temperature_at(layers, depth, TIME - soon)) / (2.0 * soon)
    gathering = (flux_at(layers, depth - near, TIME) - flux_at(layers, depth + near, TIME)) / (2.0 * near)
    capacity = layer.density * layer.specific_heat
    np.testing.assert_allclose(capacity * warming, gathering, rtol=0.0, atol=1e-5 * np.abs(gathering).max())
    slope = (temperature_at(layers, depth + near, TIME) - temperature_at(layers, depth - near, TIME)) / (2.0 * near)
    flux = flux_at(layers, depth, TIME)
    np.testing.assert_allclose(flux, -layer.conductivity * slope, rtol=0.0, atol=1e-6 * np.abs(flux).max())


def test_temperature_and_flux_are_continuous_where_layers_meet() -> None:
    border = TWO_LAYERS[0].thickness
    for quantity in (temperature_at, flux_at):
        above, below = quantity(TWO_LAYERS, border - 1e-9, TIME), quantity(TWO_LAYERS, border + 1e-9, TIME)
        assert np.abs(above - below).max() < 1e-4


@pytest.mark.parametrize("layers", [ONE_LAYER, TWO_LAYERS])
def test_made_boundary_is_one_that_a_wall_meets(layers: tuple[Layer, ...]) -> None:
    sun = absorbed_sunlight(layers, TIME)
    assert 0.0 <= sun.min() < sun.max() < 1200.0
    depth = sum(layer.thickness for layer in layers)
    room = temperature_at(layers, depth, TIME) - flux_at(layers, depth, TIME) / INNER_FILM
    np.testing.assert_allclose(room, room[0], rtol=0.0, atol=1e-9)
    assert 290.0 < room[0] < 315.0


@pytest.mark.parametrize("layers", [ONE_LAYER, TWO_LAYERS])
def test_errors_fall_with_every_halving_to_a_millikelvin(layers: tuple[Layer, ...]) -> None:
    space, time = errors_in_space(layers, (12, 24, 48, 96), 7.5), errors_in_time(layers)
    assert np.all(np.diff(space) < 0.0)
    assert np.all(np.diff(time) < 0.0)
    assert space[-1] < 2e-3
    assert time[-1] < 1e-3
    assert order([1 / 12, 1 / 24, 1 / 48, 1 / 96], space) == pytest.approx(2.0, abs=0.05)


def test_order_is_the_slope_of_the_errors() -> None:
    sizes = np.array([4.0, 2.0, 1.0])
    assert order(sizes, 0.3 * sizes**1.5) == pytest.approx(1.5)


def test_march_of_a_wall_that_is_not_the_solutions_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Radiation of a wall that is 2 % less emissive, in the march alone, is an error of tenths of a kelvin."""
    plain = march_error(ONE_LAYER, uniform_grid(ONE_LAYER, [48]), 60.0)
    outdoors = manufactured.outdoors
    monkeypatch.setattr(
        manufactured, "outdoors", lambda *values, **given: outdoors(*values, **{**given, "emissivity": 0.882})
    )
    assert march_error(ONE_LAYER, uniform_grid(ONE_LAYER, [48]), 60.0) > 0.05 > 10.0 * plain
