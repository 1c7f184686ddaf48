"""The air of a moment in a sensor's band, by the name of the atmosphere that a user chose.

'report' is eq. 15 of the report: one coefficient. 'standard' follows the weather with a sum of exponentials that thins
out with height. 'modtran' takes pyBSM's MODTRAN tables, for their conditions. 'none' shows surfaces as they are.
"""

from collections.abc import Mapping
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from sensorsim.environment import LAPSE_RATE, AirPath, EnvironmentSample, clear_path, right_angle_phase, single_term
from sensorsim.environment.air_path import MOST_TERMS
from sensorsim.environment.modtran import modtran_path
from sensorsim.errors import InputError
from sensorsim.radiometry import BandTable
from sensorsim.sensor import Sensor

FloatArray = npt.NDArray[np.float64]
Atmosphere = Literal["standard", "report", "modtran", "none"]
DEFAULT_ATMOSPHERE: Atmosphere = "standard"
_HAZE_ASYMMETRY = 0.65  # [-] of rural haze in the near infrared; estimate


def check_atmosphere(name: str) -> str:
    """The name, if it is one of an atmosphere; InputError otherwise."""
    if name not in get_args(Atmosphere):
        raise InputError("renderer", "atmosphere", name, "unknown", f"use {', '.join(get_args(Atmosphere))}")
    return name


def air_path(
    atmosphere: str,
    sensor: Sensor,
    sample: EnvironmentSample,
    table: BandTable | None,
    *,
    beam: float,
    sky_radiance: float,
    ground_radiance: float,
    camera_height: float,
) -> AirPath:
    """Air of a moment; beam [W m-2] and radiances [W m-2 sr-1] are of its surroundings.

    `table` is None for reflective bands. Errors as `illuminate`.
    """
    band = sensor.band.name
    glow = sky_radiance if table is None else float(table.radiance_at(sample.air_temperature))
    if check_atmosphere(atmosphere) == "none":
        return clear_path()
    if atmosphere == "report":
        return single_term(sample.attenuation_coefficient(band), glow)
    if atmosphere == "modtran":
        return modtran_path(sensor.band, sample, camera_height, emissive=table is not None)
    found = sample.transmittance(band)
    around = 0.5 * (sky_radiance + ground_radiance)  # what falls on the haze from above and below
    emitted = 0.0 if table is None else 1.0
    return AirPath(
        weight=found.weight,
        coefficient=found.coefficient,
        inverse_scale_height=found.inverse_scale_height,
        haze=found.haze,
        source=emitted * (1.0 - found.scattered) * glow + found.scattered * around,
        source_decay=0.0 if table is None else source_decay(table, sample.air_temperature),
        beam_source=found.scattered * beam * right_angle_phase(_HAZE_ASYMMETRY),
        asymmetry=_HAZE_ASYMMETRY,
    )


def source_decay(table: BandTable, air_temperature: float) -> float:
    """Relative loss of the air's own radiance with height [m-1], from the lapse rate of the standard atmosphere."""
    below, here, above = table.radiance_at(air_temperature + np.array([-1.0, 0.0, 1.0]))
    return float(LAPSE_RATE * 0.5 * (above - below) / here)


def air_values(air: AirPath, camera_height: float, sun_direction: FloatArray) -> Mapping[str, npt.ArrayLike]:
    """Fields of the `Air` block for a camera's height [m]."""
    air = air.seen_from(camera_height)
    source, slope = air.source_at(camera_height)
    terms = {
        "extinction": air.coefficient * np.exp(-camera_height * air.inverse_scale_height),
        "weight": air.weight,
        "inverse_scale_height": air.inverse_scale_height,
        "source": source,
        "source_slope": slope,
        "beam_source": air.beam_source,
    }
    rows = np.zeros((len(terms), MOST_TERMS))
    for row, values in zip(rows, terms.values(), strict=True):
        row[: values.size] = values
    return {**dict(zip(terms, rows, strict=True)), "sun_direction": sun_direction, "asymmetry": air.asymmetry}
