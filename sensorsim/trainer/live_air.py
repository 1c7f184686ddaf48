"""What of the host's weather a frame can honour at once: the air that is looked through.

Walls keep the temperatures of the weather they stood in, which only a new bake changes (see `bake_request`).
"""

from dataclasses import replace

import numpy as np

from sensorsim.environment import EnvironmentSample, vapour_pressure
from sensorsim.trainer.host_state import Air


def live_sample(
    sample: EnvironmentSample, air: Air | None, visibility: float | None, *, sun: bool = True
) -> EnvironmentSample:
    """The moment with the host's air temperature, humidity and visibility [m]; without its sun where that is off."""
    if air is not None:
        pressure = float(vapour_pressure(np.array(air.temperature), np.array(air.relative_humidity)))
        sample = replace(
            sample,
            air_temperature=air.temperature,
            relative_humidity=air.relative_humidity,
            vapour_pressure=pressure,
            wind_speed=air.wind_speed,
        )
    if visibility is not None and visibility > 0.0:
        sample = replace(sample, visibility=visibility)
    return sample if sun else replace(sample, beam_irradiance=0.0, nir_beam=0.0)
