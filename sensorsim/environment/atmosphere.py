"""How much of a band's radiation the air lets through, from the weather at hand.

Sums of exponentials fitted to [LOWTRAN7]; `assets/atmosphere/transmittance.toml` holds the numbers and says what they
are. The single coefficient of [Report1978] eq. 15 is read off them at one kilometre.
"""

import tomllib
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment.haze import MIXED, Haze
from sensorsim.environment.humidity import vapour_density
from sensorsim.errors import InputError
from sensorsim.resources import assets_folder

FloatArray = NDArray[np.float64]

METRES_PER_KILOMETRE = 1000.0
LAPSE_RATE = 6.5e-3  # [K m-1] by which air cools with height, standard atmosphere [USSA1976]
_REFERENCE_TEMPERATURE = 296.0  # [K] of the water vapour continuum
_KOSCHMIEDER = 3.912  # -ln of the 2 % contrast at which a black target is lost
_PRESSURE_HEIGHT = 29.27  # [m K-1] scale height of pressure per kelvin of air temperature, R / g
_VAPOUR_HEIGHT = 2200.0  # [m] scale height of water vapour density; estimate, that of the model atmospheres of LOWTRAN7
# How the parts of a coefficient go with pressure: dry gases p^1.5, vapour lines p, continuum not at all.
_DRY_PRESSURE_POWER = 1.5


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Transmittance:
    """Sum of weighted exponentials: tau(r) = sum of weight exp(-coefficient r) over a level path at the ground."""

    weight: FloatArray  # (k,) [-], sums to one
    coefficient: FloatArray  # (k,) [m-1] but for haze
    inverse_scale_height: FloatArray  # (k,) [m-1] by which the coefficients fall off with height
    haze: Haze  # the same in all terms
    scattered: FloatArray  # (k,) [-] share of each term's extinction, with haze, that is scattering

    def at(self, distance: FloatArray | float) -> FloatArray:
        """Transmittance [-] over distances [m], shape as given."""
        depth = np.asarray(distance, dtype=np.float64)[..., None] * (self.coefficient + self.haze.extinction)
        return np.asarray(np.exp(-depth) @ self.weight, dtype=np.float64)


def band_transmittance(
    band: str,
    *,
    air_temperature: float,
    relative_humidity: float,
    visibility: float,
    precipitation: float,
    aerosol: str = "rural",
) -> Transmittance:
    """Transmittance of a band near the ground: 'FLIR' (8-14 um), 'MWIR' (3-5 um) or 'LLLTV' (0.8-1.1 um).

    Parameters
    ----------
    air_temperature : [K]
    relative_humidity : [-]
    visibility : [m] meteorological range; at most that of clear air, 337 km
    precipitation : [mm h-1] of rain
    aerosol : 'rural', 'urban', 'maritime', 'tropospheric', 'advection_fog' or 'radiation_fog'

    Raises
    ------
    InputError : unknown band or aerosol, or weather that is not finite or out of range.
    """
    table = _tables()
    entry, haze_kind = _known("band", band, table["band"]), _known("aerosol", aerosol, table["haze"]["kind"])
    clearest = METRES_PER_KILOMETRE * _KOSCHMIEDER / table["haze"]["clear_air"]
    _require("air_temperature", air_temperature, 180.0, 340.0, "K")
    _require("relative_humidity", relative_humidity, 0.0, 1.0, "as a share")
    _require("visibility", visibility, 10.0, clearest, "m")
    _require("precipitation", precipitation, 0.0, 400.0, "mm/h")
    gas = _gas(entry, air_temperature, relative_humidity)
    extinction = _KOSCHMIEDER / (visibility / METRES_PER_KILOMETRE) - table["haze"]["clear_air"]
    haze = extinction * np.interp(relative_humidity, table["haze"]["humidity"], haze_kind[band])
    rain = table["rain_factor"] * precipitation ** table["rain_power"]
    coefficient = gas.sum(axis=0) + rain
    decay = (_gas_decay(entry, air_temperature) * gas).sum(axis=0)
    below, above = _haze_decay(table["haze"], haze_kind, extinction)
    weight = np.array(entry["weight"])
    return Transmittance(
        weight=weight / weight.sum(),
        coefficient=coefficient / METRES_PER_KILOMETRE,
        inverse_scale_height=decay / np.maximum(coefficient, 1e-12),
        haze=Haze(extinction=float(haze) / METRES_PER_KILOMETRE, below=below, above=above),
        scattered=entry["scattered"] * (haze + rain) / np.maximum(coefficient + haze, 1e-12),
    )


def _haze_decay(table: dict[str, Any], kind: dict[str, Any], extinction: float) -> tuple[float, float]:
    """Inverse scale heights [m-1] of haze below and above its mixed layer, by its extinction at 0.55 um [1/km]."""
    if "scale_height" in kind:  # fog
        inverse = 1.0 / (METRES_PER_KILOMETRE * kind["scale_height"])
        return inverse, inverse
    profile = table["profile"]
    known = max(extinction, 1e-9)
    first, second = (
        float(np.interp(known, profile["ground"], np.array(profile[at]) / profile["ground"])) for at in ("one", "two")
    )
    return -float(np.log(first)) / MIXED, -float(np.log(second / first)) / MIXED


def attenuation_coefficient(
    band: str,
    *,
    air_temperature: float,
    relative_humidity: float,
    visibility: float,
    precipitation: float,
    aerosol: str = "rural",
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
        aerosol=aerosol,
    )
    return float(-np.log(path.at(METRES_PER_KILOMETRE)) / METRES_PER_KILOMETRE)


def _gas(entry: dict[str, Any], air_temperature: float, relative_humidity: float) -> FloatArray:
    """Coefficients (3, k) [1/km] of dry gases, water vapour lines and water vapour continuum."""
    dry, vapour, continuum, power = (np.array(entry[name]) for name in ("dry", "vapour", "continuum", "power"))
    water = 1000.0 * float(vapour_density(np.array(air_temperature), np.array(relative_humidity)))
    swell = np.exp(entry["continuum_theta"] * (_REFERENCE_TEMPERATURE / air_temperature - 1.0))
    return np.stack([dry, vapour * water**power, continuum * water**2 * swell])


def _gas_decay(entry: dict[str, Any], air_temperature: float) -> FloatArray:
    """Inverse scale heights (3, k) [m-1] of the same parts at the ground."""
    pressure = 1.0 / (_PRESSURE_HEIGHT * air_temperature)
    warming = entry["continuum_theta"] * _REFERENCE_TEMPERATURE * LAPSE_RATE / air_temperature**2
    vapour = pressure + np.array(entry["power"]) / _VAPOUR_HEIGHT
    ones = np.ones_like(vapour)
    return np.stack([_DRY_PRESSURE_POWER * pressure * ones, vapour, (2.0 / _VAPOUR_HEIGHT - warming) * ones])


@cache
def _tables() -> dict[str, Any]:
    with (assets_folder() / "atmosphere" / "transmittance.toml").open("rb") as file:
        return tomllib.load(file)


def _known(entry: str, name: str, table: dict[str, Any]) -> dict[str, Any]:
    if name not in table:
        raise InputError("atmosphere", entry, name, "unknown", f"choose one of {', '.join(table)}")
    found: dict[str, Any] = table[name]
    return found


def _require(entry: str, value: float, low: float, high: float, unit: str) -> None:
    if not low <= value <= high:
        raise InputError("atmosphere", entry, value, "out of range", f"give {low:g} to {high:g} {unit}")
