"""The times of the image day that tables keep.

By day and in rain a sheet of metal is warm or cold within minutes. In a dry night temperatures follow the air and the
wind, which weather files give by the hour: there a slice in QUIET seconds does as well.
"""

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.environment import Environment
from sensorsim.errors import InputError
from sensorsim.tables.orientations import IntArray
from sensorsim.tables.settings import BakeSettings

QUIET = 900.0  # [s] between slices in the dark and dry, or the settings' interval where that is longer
DRYING = 3600.0  # [s] after light or rain, and before light, in which slices are as close as by day


def kept_samples(environment: Environment, settings: BakeSettings) -> IntArray:
    """Samples (t,) from midnight to midnight of the image day that are kept, ascending, both midnights among them."""
    stride = settings.slice_interval / environment.step
    if round(stride) < 1 or abs(stride - round(stride)) > 1e-9:
        problem = f"no multiple of the environment's step of {environment.step:g} s"
        raise InputError("bake settings", "slice_interval", settings.slice_interval, problem, "give both one step")
    count = round(SECONDS_PER_DAY / settings.slice_interval)
    every = environment.image_window.start + np.arange(count + 1) * round(stride)
    apart = max(int(QUIET // settings.slice_interval), 1)
    stirred = (environment.beam_irradiance + environment.diffuse_irradiance > 0.0) | (environment.precipitation > 0.0)
    when = environment.time[every]
    times = environment.time[stirred]
    place = np.searchsorted(times, when)
    before = when - np.concatenate([[-np.inf], times])[place]
    after = np.concatenate([times, [np.inf]])[place] - when
    busy = np.minimum(before, after) <= DRYING
    return np.asarray(every[busy | (np.arange(count + 1) % apart == 0) | (np.arange(count + 1) == count)])
