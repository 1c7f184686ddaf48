"""How much of a band's radiation a level path lets through, from the weather at hand.

Three exponentials per band, fitted to [LOWTRAN7]; `assets/atmosphere/transmittance.toml` holds the numbers and says
what they are. The single coefficient of [Report1978] eq. 15 is read off them at one kilometre.
"""

import tomllib
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment.humidity import vapour_density
from sensorsim.errors import InputError
from sensorsim.resources import assets_folder

FloatArray = NDArray[np.float64]

METRES_PER_KILOMETRE = 1000.0
_REFERENCE_TEMPERATURE = 296.0  # [K] of the water vapour continuum
_KOSCHMIEDER = 3.912  # -ln of the 2 % contrast at which a black target is lost


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Transmittance:
    """Sum of weighted exponentials: tau(r) = sum of weight exp(-coefficient r)."""

    weight: FloatArray  # (3,) [-], sums to one
    coefficient: FloatArray  # (3,) [m-1]

    def at(self, distance: FloatArray | float) -> FloatArray:
        """Transmittance [-] over distances [m], shape as given."""
        depth = np.asarray(distance, dtype=np.float64)[..., None] * self.coefficient
        return np.asarray(np.exp(-depth) @ self.weight, dtype=np.float64)


def band_transmittance(
    band: str, *, air_temperature: float, relative_humidity: float, visibility: float, precipitation: float
) -> Transmittance:
    """Transmittance of a band, 'FLIR' (8-14 um) or 'LLLTV' (0.8-1.1 um), near the ground.

    Parameters
    ----------
    air_temperature : [K]
    relative_humidity : [-]
    visibility : [m] meteorological range, rural aerosol; at most that of clear air, 337 km
    precipitation : [mm h-1] of rain

    Raises
    ------
    InputError : unknown band, or weather that is not finite or out of range.
    """
    table = _tables()
    bands = [name for name, entry in table.items() if isinstance(entry, dict)]
    if band not in bands:
        raise InputError("atmosphere", "band", band, "unknown", f"choose one of {', '.join(bands)}")
    clearest = METRES_PER_KILOMETRE * _KOSCHMIEDER / table["clear_air_extinction"]
    _require("air_temperature", air_temperature, 180.0, 340.0, "K")
    _require("relative_humidity", relative_humidity, 0.0, 1.0, "as a share")
    _require("visibility", visibility, 10.0, clearest, "m")
    _require("precipitation", precipitation, 0.0, 400.0, "mm/h")
    values = {name: np.asarray(entry, dtype=np.float64) for name, entry in table[band].items()}
    water = 1000.0 * float(vapour_density(np.array(air_temperature), np.array(relative_humidity)))
    swell = np.exp(values["continuum_theta"] * (_REFERENCE_TEMPERATURE / air_temperature - 1.0))
    gas = values["dry"] + values["vapour"] * water ** values["power"] + values["continuum"] * water**2 * swell
    haze = _KOSCHMIEDER / (visibility / METRES_PER_KILOMETRE) - table["clear_air_extinction"]
    aerosol = haze * np.interp(relative_humidity, table["aerosol_humidity"], values["aerosol_ratio"])
    rain = table["rain_factor"] * precipitation ** table["rain_power"]
    weight = values["weight"] / values["weight"].sum()
    return Transmittance(weight=weight, coefficient=(gas + aerosol + rain) / METRES_PER_KILOMETRE)


def attenuation_coefficient(
    band: str, *, air_temperature: float, relative_humidity: float, visibility: float, precipitation: float
) -> float:
    """The one coefficient alpha [m-1] of [Report1978] eq. 15: that of a path of one kilometre, -ln tau(1 km) / 1 km.

    Exact there; too strong beyond, too weak before, as absorption lines saturate. Arguments as `band_transmittance`.
    """
    path = band_transmittance(
        band,
        air_temperature=air_temperature,
        relative_humidity=relative_humidity,
        visibility=visibility,
        precipitation=precipitation,
    )
    return float(-np.log(path.at(METRES_PER_KILOMETRE)) / METRES_PER_KILOMETRE)


@cache
def _tables() -> dict[str, Any]:
    with (assets_folder() / "atmosphere" / "transmittance.toml").open("rb") as file:
        return tomllib.load(file)


def _require(entry: str, value: float, low: float, high: float, unit: str) -> None:
    if not low <= value <= high:
        raise InputError("atmosphere", entry, value, "out of range", f"give {low:g} to {high:g} {unit}")
