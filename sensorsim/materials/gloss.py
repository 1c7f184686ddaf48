"""Surfaces that mirror: emissivity in 8-14 um against the angle from the normal, from assets/materials/gloss.toml."""

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.resources import assets_folder

FloatArray = NDArray[np.float64]
ANGLE_ENTRIES = 129  # equally spaced in the cosine of the angle from the normal, 0 to 1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Gloss:
    """One kind of mirroring surface."""

    name: str
    codes: tuple[int, ...]
    normal_emissivity: float | None  # [-], None where the material's own holds
    rise: FloatArray  # (ANGLE_ENTRIES,) [-] of the reflectance, 0 along the normal, at cosines from 0 to 1
    spread: float  # [deg] half width of the lobe

    def emissivity(self, normal_emissivity: FloatArray, cosine: FloatArray) -> FloatArray:
        """Emissivity [-] at cosines of the angle from the normal, of surfaces that have that along it."""
        rise = np.interp(cosine, np.linspace(0.0, 1.0, ANGLE_ENTRIES), self.rise)
        return np.asarray(normal_emissivity * (1.0 - rise))


@cache
def load_gloss() -> tuple[Gloss, ...]:
    """All kinds; InputError, naming the entry, for one that is no number or outside of its bounds."""
    path = assets_folder() / "materials" / "gloss.toml"
    return tuple(read_gloss(path, entry) for entry in tomllib.loads(path.read_text(encoding="utf-8"))["gloss"])


def read_gloss(path: Path, entry: dict[str, Any]) -> Gloss:
    """One [[gloss]] entry."""
    name = f"gloss {entry.get('name')!r}"
    if ("index" in entry) == ("exponent" in entry):
        raise InputError(path, name, None, "needs an index or an exponent", "give one of them")
    cosine = np.linspace(0.0, 1.0, ANGLE_ENTRIES)
    rise = _fresnel_rise(np.array(entry["index"]), cosine) if "index" in entry else _schlick_rise(path, name, entry)
    normal = _number(path, name, entry, "normal", 1.0) if "normal" in entry else None
    spread = _number(path, name, entry, "spread", 60.0)
    return Gloss(name=entry["name"], codes=tuple(entry["codes"]), normal_emissivity=normal, rise=rise, spread=spread)


def fresnel_reflectance(index: NDArray[np.complex128], cosine: FloatArray) -> FloatArray:
    """Reflectance [-] of unpolarised light off a medium of complex index n + ik, mean of both polarisations.

    Shapes broadcast; cosine is of the angle from the normal. [Howell2010]
    """
    below = np.sqrt(index**2 - 1.0 + cosine**2)  # index times the cosine inside, by Snell's law
    across = np.abs((cosine - below) / (cosine + below)) ** 2
    along = np.abs((index**2 * cosine - below) / (index**2 * cosine + below)) ** 2
    return np.asarray(0.5 * (across + along))


def _fresnel_rise(rows: FloatArray, cosine: FloatArray) -> FloatArray:
    """Rise of the reflectance from the normal on, mean over wavelength."""
    wavelength, index = rows[:, 0], rows[:, 1] + 1j * rows[:, 2]
    reflectance = fresnel_reflectance(index[:, None], np.maximum(cosine, 1e-9))
    mean = np.trapezoid(reflectance, wavelength, axis=0) / (wavelength[-1] - wavelength[0])
    return np.asarray((mean - mean[-1]) / (1.0 - mean[-1]))


def _schlick_rise(path: Path, name: str, entry: dict[str, Any]) -> FloatArray:
    exponent = _number(path, name, entry, "exponent", 100.0)
    cosine = np.linspace(0.0, 1.0, ANGLE_ENTRIES)
    return np.asarray((1.0 - cosine) ** exponent) if exponent > 0.0 else np.zeros(ANGLE_ENTRIES)


def _number(path: Path, name: str, entry: dict[str, Any], key: str, highest: float) -> float:
    held = entry.get(key)
    value: Any = held.get("value") if isinstance(held, dict) else None
    if type(value) not in (int, float) or not 0.0 <= value <= highest:
        raise InputError(path, f"{name} {key}", value, "out of range", f"give a value from 0 to {highest:g}")
    return float(value)
