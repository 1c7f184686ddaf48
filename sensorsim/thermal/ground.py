"""The ground plane's own temperature history, which every wall sees: a column of soil under the open sky.

Section 3.1.3 of [Report1978]: an infinite grey plane, dry, wet or snow-covered, and under snow never above 0 C.
"""

import numpy as np

from sensorsim.effects import EVERYTHING, EffectPlan
from sensorsim.environment import SNOW_MAXIMUM_TEMPERATURE, Environment
from sensorsim.materials import WallType
from sensorsim.thermal.grid import FloatArray
from sensorsim.thermal.heat_balance import expose
from sensorsim.thermal.interior import build_interior
from sensorsim.thermal.natural import melting_depth, surface_boundary
from sensorsim.thermal.paths import march_paths


def ground_temperature(
    environment: Environment, soil: WallType, *, sky: str = "perez", repeated: bool = False,
    plan: EffectPlan = EVERYTHING,
) -> FloatArray:  # fmt: skip
    """Temperature (t,) [K] of the ground plane at every sample; the soil absorbs what the ground's albedo leaves.

    It begins linear, or as the first day leaves it when that is `repeated`; melting snow never does. Soil of snow stays
    at 0 C by what it takes to melt it. Other soil is cut off there while the weather says snow, as on a day that has it
    for less than half: the heat cut off melts nothing.
    """
    up = np.array([[0.0, 0.0, 1.0]])
    # A plane that faces up sees no ground.
    exposure = expose(environment, up, environment.air_temperature, sky=sky, plan=plan)
    absorbed = exposure.irradiance * (1.0 - environment.ground_albedo)[:, None]
    outside = surface_boundary(environment, exposure, soil, plan=plan)
    inside = build_interior(
        "none", environment.air_temperature, environment.wind_speed, environment.step, soil.interior_emissivity,
        plan=plan,
    )  # fmt: skip
    samples = np.arange(environment.time.size)
    history = march_paths(
        soil, outside._replace(irradiance=absorbed), inside, np.ones(1), step=environment.step, record=samples,
        melting_depth=melting_depth(soil), repeated=repeated and melting_depth(soil) == 0.0,
    )  # fmt: skip
    temperature = history.exterior[:, 0, 0]
    if not plan.has("snow"):
        return np.asarray(temperature)
    return np.where(environment.ground_state == "snow", np.minimum(temperature, SNOW_MAXIMUM_TEMPERATURE), temperature)
