"""Surfaces that mirror, from assets/materials/gloss.toml: emissivity in 8-14 um, and facets in 0.8-1.1 um, by angle."""

import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.materials.facets import ANGLE_ENTRIES, lobe_variance
from sensorsim.resources import assets_folder

FloatArray = NDArray[np.float64]
_WAVE_STEP = 5e-4  # [-] of the variance of slopes: a tenth of a metre per second


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NearInfraredGloss:
    """What the facets of one kind mirror in 0.8-1.1 um."""

    highest: float  # reflectance of a facet along its normal [-]
    share: float  # of the surface's reflectance that is mirrored and not scattered, at most [-]
    rise: FloatArray  # (ANGLE_ENTRIES,) [-] of a facet's reflectance, 0 along the normal, at cosines from 0 to 1

    def mirrored(self, reflectance: FloatArray) -> FloatArray:
        """Reflectance of a facet along its normal [-], of surfaces of a reflectance in band [-]."""
        return np.asarray(np.minimum(self.share * reflectance, self.highest))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Gloss:
    """One kind of mirroring surface."""

    name: str
    codes: tuple[int, ...]
    normal_emissivity: float | None  # [-], None where the material's own holds
    rise: FloatArray  # (ANGLE_ENTRIES,) [-] of the reflectance, 0 along the normal, at cosines from 0 to 1
    spread: float  # [deg] half width of the lobe
    waves: tuple[float, float] | None  # variance of slopes in 0.8-1.1 um: calm [-], and by wind [s m-1]
    nir: NearInfraredGloss

    def slope_variance(self, wind_speed: float) -> float:
        """Variance of the facets' slopes [-] in 0.8-1.1 um, in a wind [m s-1]; of waves [CoxMunk1954] in fine steps."""
        if self.waves is None:
            return lobe_variance(self.spread)
        calm, per_wind = self.waves
        return _WAVE_STEP * round((calm + per_wind * wind_speed) / _WAVE_STEP)

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
    if "index" in entry:
        rows = np.array(entry["index"])
        index = (rows[:, 1:2] + 1j * rows[:, 2:3]).astype(np.complex128)
        rise = _rise(_mean_over(rows[:, 0], fresnel_reflectance(index, _cosines())))
    else:
        rise = _schlick_rise(path, name, entry)
    normal = _number(path, name, entry, "normal", 1.0) if "normal" in entry else None
    spread = _number(path, name, entry, "spread", 60.0)
    return Gloss(
        name=entry["name"], codes=tuple(entry["codes"]), normal_emissivity=normal, rise=rise, spread=spread,
        waves=_read_waves(path, name, entry), nir=_read_nir(path, f"{name} nir", entry.get("nir", {})),
    )  # fmt: skip


def _read_nir(path: Path, name: str, entry: dict[str, Any]) -> NearInfraredGloss:
    """The [gloss.nir] of an entry."""
    share, faces = _number(path, name, entry, "share", 1.0), entry.get("faces", 1)
    if ("index" in entry) == ("exponent" in entry) or faces not in (1, 2):
        raise InputError(path, name, faces, "needs an index or an exponent, of 1 or 2 faces", "give one of them")
    if "exponent" in entry:
        return NearInfraredGloss(highest=1.0, share=share, rise=_schlick_rise(path, name, entry))
    rows = np.array(entry["index"], dtype=np.float64)
    if rows.ndim != 2 or rows.shape[0] < 2 or rows.shape[1] != 2 or not (np.isfinite(rows) & (rows > 0.0)).all():
        raise InputError(path, f"{name} index", entry["index"], "no rows of wavelength and index", "give two or more")
    index = rows[:, 1:].astype(np.complex128)
    mean = _mean_over(rows[:, 0], fresnel_reflectance(index, _cosines()))
    if faces == 2:  # of what passes the first, the second sends back as much, and so on to and fro
        mean = 2.0 * mean / (1.0 + mean)
    return NearInfraredGloss(highest=float(mean[-1]), share=share, rise=_rise(mean))


def _read_waves(path: Path, name: str, entry: dict[str, Any]) -> tuple[float, float] | None:
    held = entry.get("waves")
    if held is None:
        return None
    calm, per_wind = (held.get(key) for key in ("calm", "per_wind"))
    if not all(type(value) in (int, float) and 0.0 < value < 0.1 for value in (calm, per_wind)):
        raise InputError(path, f"{name} waves", held, "out of range", "give calm and per_wind between 0 and 0.1")
    return float(calm), float(per_wind)


def fresnel_reflectance(index: NDArray[np.complex128], cosine: FloatArray) -> FloatArray:
    """Reflectance [-] of unpolarised light off a medium of complex index n + ik, mean of both polarisations.

    Shapes broadcast; cosine is of the angle from the normal. [Howell2010]
    """
    below = np.sqrt(index**2 - 1.0 + cosine**2)  # index times the cosine inside, by Snell's law
    across = np.abs((cosine - below) / (cosine + below)) ** 2
    along = np.abs((index**2 * cosine - below) / (index**2 * cosine + below)) ** 2
    return np.asarray(0.5 * (across + along))


def _cosines() -> FloatArray:
    return np.maximum(np.linspace(0.0, 1.0, ANGLE_ENTRIES), 1e-9)


def _mean_over(wavelength: FloatArray, reflectance: FloatArray) -> FloatArray:
    """Mean (ANGLE_ENTRIES,) of rows over wavelength."""
    return np.asarray(np.trapezoid(reflectance, wavelength, axis=0) / (wavelength[-1] - wavelength[0]))


def _rise(reflectance: FloatArray) -> FloatArray:
    """Rise of a reflectance from the normal on, 1 where it is 1."""
    return np.asarray((reflectance - reflectance[-1]) / (1.0 - reflectance[-1]))


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
