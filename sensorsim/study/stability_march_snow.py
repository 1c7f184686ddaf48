"""Snow that melts: the plateau at 0 C, its heat, and no chatter at the threshold."""

from functools import partial

import numpy as np

from sensorsim.constants import ZERO_CELSIUS
from sensorsim.study.stability_model import Case
from sensorsim.study.wall_setup import DARK, FloatArray, constant, indoors, outdoors, slab
from sensorsim.thermal import History, march

SNOW = slab(0.10, 0.30, 300.0, 2100.0, name="snow")
SOIL = slab(0.5, 1.0, 1500.0, 1200.0, name="soil")
HEAT_OF_MELTING = 334e3  # [J kg-1]
STEPS = (60.0, 600.0, 3600.0)  # [s]


def melting_day(step: float) -> History:
    """Snow on soil through a cold night, six hours of thaw with sun, and a cold night; every sample is recorded."""
    hours = np.arange(round(30 * 3600.0 / step) + 1) * step / 3600.0
    thaw = np.clip(np.minimum(hours - 11.0, 19.0 - hours), 0.0, 1.0)
    return march(
        [SNOW, SOIL],
        outdoors(268.0 + 10.0 * thaw, 15.0, sun=500.0 * thaw, sky=255.0 + 10.0 * thaw, emissivity=0.98),
        indoors(constant(271.0, hours.size), 1000.0), np.array([0.3]), step=step, record=np.arange(hours.size),
        melting_depth=SNOW.thickness, keep_nodes=True,
    )  # fmt: skip


def _warmer_than_ice(step: float) -> float:
    history = melting_day(step)
    snow = history.exterior
    if history.nodes is not None:
        snow = np.concatenate([snow, history.nodes[:, history.grid.depth < SNOW.thickness, 0]], axis=1)
    return max(0.0, float(snow.max()) - ZERO_CELSIUS)


def _open_balance(step: float) -> float:
    """Heat that entered less stored and melted, over the heat that melts a kilogram."""
    history = melting_day(step)
    rest = history.heat.sum(axis=0) - history.stored - history.melted
    return float(np.abs(rest).max()) / HEAT_OF_MELTING


def turns(face: FloatArray) -> int:
    """How often a series changes direction by more than 1e-6 K."""
    direction = np.sign(np.where(np.abs(np.diff(face)) > 1e-6, np.diff(face), 0.0))
    moved = direction[direction != 0.0]
    return int(np.sum(moved[1:] != moved[:-1]))


def _chatter(step: float) -> float:
    """Changes of direction of the face from the beginning of the thaw to the end of its night."""
    face = melting_day(step).exterior[round(11 * 3600.0 / step) :, 0, 0]
    return float(turns(face))


def _cold_snow() -> float:
    """Melt [J m-2] of snow that stays below 0 C."""
    count = 100
    history = march(
        [SNOW, SOIL], outdoors(constant(268.0, count), 15.0, sky=250.0, emissivity=0.98),
        indoors(constant(271.0, count), 1000.0), DARK, step=600.0, record=np.array([count - 1]),
        melting_depth=SNOW.thickness,
    )  # fmt: skip
    return float(np.abs(history.melted).max())


CASES = (
    *(
        Case(
            name=f"thaw, step {step:g} s",
            group="melting snow",
            stresses="a plateau that begins and ends within a step",
            measured="how far face or cells of the snow get above 0 C",
            unit="K",
            bound=1e-9,
            reason="snow melts rather than warm",
            measure=partial(_warmer_than_ice, step),
        )
        for step in STEPS
    ),
    *(
        Case(
            name=f"heat of the thaw, step {step:g} s",
            group="melting snow",
            stresses="heat of melting is taken out of the cells",
            measured="heat that entered less stored and melted, over that which melts 1 kg m-2",
            unit="-",
            bound=1e-10,
            reason="conservation",
            measure=partial(_open_balance, step),
        )
        for step in STEPS
    ),
    *(
        Case(
            name=f"chatter at 0 C, step {step:g} s",
            group="melting snow",
            stresses="a threshold that a step may cross to and fro",
            measured="changes of direction of the face through thaw and night after it",
            unit="-",
            bound=1.0,
            reason="up to the plateau, along it, and down; only the night may turn it once more, towards its balance",
            measure=partial(_chatter, step),
        )
        for step in STEPS
    ),
    Case(
        name="frost",
        group="melting snow",
        stresses="a melting rule that takes heat where nothing melts",
        measured="melt of snow under air of -5 C at night",
        unit="J m-2",
        bound=0.0,
        reason="snow below 0 C does not melt",
        measure=_cold_snow,
    ),
)
