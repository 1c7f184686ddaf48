"""The march against exact solutions made through its boundaries: error at the default, orders in space and time."""

from functools import partial

from sensorsim.materials import Layer
from sensorsim.study.manufactured import (
    CELLS,
    ONE_LAYER,
    STEPS,
    TWO_LAYERS,
    errors_in_space,
    errors_in_time,
    march_error,
    order,
)
from sensorsim.study.stability_model import Case
from sensorsim.thermal import build_grid
from sensorsim.thermal.wall_steps import FINER

WALLS = {"one layer": ONE_LAYER, "two layers": TWO_LAYERS}


def _at_a_minute(layers: tuple[Layer, ...], finer: float) -> float:
    return march_error(layers, build_grid(layers, 60.0, cell_size=finer), 60.0)


def _order_in_space(layers: tuple[Layer, ...]) -> float:
    return abs(order([1.0 / count for count in CELLS], errors_in_space(layers)) - 2.0)


def _order_in_time(layers: tuple[Layer, ...]) -> float:
    return abs(order(STEPS, errors_in_time(layers)) - 2.0)


CASES = (
    *(
        Case(
            name=f"exact waves in {name}, cells of {words}, step 60 s",
            group="exact solutions",
            stresses="true fourth power, films, and waves of 24, 6 and 2 h that meet at an interface",
            measured="rms error of both faces over half a day",
            unit="K",
            bound=bound,
            reason=reason,
            measure=partial(_at_a_minute, layers, finer),
        )
        for words, finer, bound, reason in (
            ("a bake", 1.0, 0.02, "what is asked of a wall against EnergyPlus"),
            ("a single wall", FINER, 0.01, "what is asked of a wall against closed forms"),
        )
        for name, layers in WALLS.items()
    ),
    *(
        Case(
            name=f"order in space, {name}",
            group="exact solutions",
            stresses="faces without capacity, and an interface between unlike conductivities",
            measured="fitted order less 2",
            unit="-",
            bound=0.1,
            reason="central differences with resistances in series are of second order",
            measure=partial(_order_in_space, layers),
        )
        for name, layers in WALLS.items()
    ),
    *(
        Case(
            name=f"order in time, {name}",
            group="exact solutions",
            stresses="inputs linear between samples, films and fourth powers that change within a step",
            measured="fitted order less 2, steps of 15 min to 28 s",
            unit="-",
            bound=0.2,
            reason="the step is of second order but where it is damped",
            measure=partial(_order_in_time, layers),
        )
        for name, layers in WALLS.items()
    ),
)
