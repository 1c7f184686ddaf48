"""The air between a sensor and what it looks at: a sum of exponentials that thins out with height and glows.

    tau = sum of weight_i exp(-d_i),   d_i = range * (coefficient_i * mean of exp(-z / H_i) along the path + haze)
    L   = sum of weight_i [t_i L_surface + path_i],   t_i = exp(-d_i)

A straight path from height z_c to z_t has the mean density (e^(-z_c/H) - e^(-z_t/H)) H / (z_t - z_c), whatever its
length. Each term has a source of its own, as each stands for other wavelengths. Sources fall off with height; along a
path they are taken to go in a straight line from that at the sensor to that at the target, which has the closed form

    path_i = (1 - t_i) S_sensor + ((1 - t_i) / d_i - t_i) (S_target - S_sensor).

Where all is of one temperature the sources are its blackbody radiance and L does not depend on the range.
The shader's counterpart is shaders/radiance/path.glsl.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from sensorsim.constants import PI
from sensorsim.environment.haze import NO_HAZE, SMALL, Haze, mean_decay
from sensorsim.errors import InputError

FloatArray = npt.NDArray[np.float64]

MOST_TERMS = 4  # that a shader has room for
_LEAST_HEIGHT = 1.0  # [m] over which the slope of a source is taken
_STEPS, _STILL = 12, 1e-10


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class AirPath:
    """Air above the scene's origin in one band, k terms of 1 to MOST_TERMS; heights are above that origin.

    Raises InputError for terms that are not finite, of different numbers, negative, or with weights off a sum of 1.
    """

    weight: FloatArray  # (k,) [-], sums to one
    coefficient: FloatArray  # (k,) [m-1] extinction at height 0, but for that of haze
    inverse_scale_height: FloatArray  # (k,) [m-1] of the extinction; 0 for air that is the same at all heights
    source: FloatArray  # (k,) [W m-2 sr-1] radiance of an endless level path at height 0
    source_decay: float  # [m-1] relative loss of the source with height
    beam_source: FloatArray  # (k,) [W m-2 sr-1] sunlight scattered at a right angle to the beam, height 0
    asymmetry: float  # [-] g of the phase function [HenyeyGreenstein1941], -1 to 1
    haze: Haze = NO_HAZE  # the same in all terms

    def __post_init__(self) -> None:
        count = self.weight.size
        for entry in ("weight", "coefficient", "inverse_scale_height", "source", "beam_source"):
            values = getattr(self, entry)
            if values.shape != (count,) or not 1 <= count <= MOST_TERMS or not np.isfinite(values).all():
                remedy = f"give 1 to {MOST_TERMS} finite terms, as many of each"
                raise InputError("air path", entry, values.tolist(), "no list of terms", remedy)
            if entry != "inverse_scale_height" and values.min() < 0.0:
                raise InputError("air path", entry, values.tolist(), "negative", "give zero or more")
        if abs(float(self.weight.sum()) - 1.0) > 1e-9:
            raise InputError("air path", "weight", self.weight.tolist(), "does not sum to 1", "divide by the sum")
        if not (np.isfinite(self.source_decay) and -1.0 < self.asymmetry < 1.0):
            pair = (self.source_decay, self.asymmetry)
            raise InputError("air path", "source_decay and asymmetry", pair, "out of range", "give finite, -1 to 1")

    def transmittance(
        self, distance: npt.ArrayLike, camera_height: npt.ArrayLike = 0.0, target_height: npt.ArrayLike = 0.0
    ) -> FloatArray:
        """Transmittance [-] over distances [m] between two heights [m], which broadcast."""
        depth = self._depth(distance, camera_height, target_height)
        return np.asarray(np.exp(-depth) @ self.weight, dtype=np.float64)

    def apparent_radiance(
        self,
        source: npt.ArrayLike,
        distance: npt.ArrayLike,
        camera_height: float = 0.0,
        target_height: npt.ArrayLike = 0.0,
        sun_cosine: npt.ArrayLike = 0.0,
    ) -> FloatArray:
        """Radiance [W m-2 sr-1] at the sensor of surfaces that send `source`; arrays broadcast.

        sun_cosine is that of the angle between the line of sight and the direction to the sun.
        """
        depth = self._depth(distance, camera_height, target_height)
        near, slope = self.source_at(camera_height)
        light = self.beam_source * self._phase(np.asarray(sun_cosine, dtype=np.float64))[..., None]
        rise = np.asarray(target_height, dtype=np.float64)[..., None] - camera_height
        part = np.exp(-depth)
        sent = np.asarray(source, dtype=np.float64)[..., None]
        seen = part * sent + (1.0 - part) * (near + light) + _lag(depth, part) * slope * rise
        return np.asarray(seen @ self.weight, dtype=np.float64)

    def source_at(self, camera_height: float) -> tuple[FloatArray, FloatArray]:
        """Sources (k,) [W m-2 sr-1] at a sensor's height [m], and their slope [W m-2 sr-1 m-1] down to the ground."""
        height = np.copysign(max(abs(camera_height), _LEAST_HEIGHT), camera_height)
        slope = self.source * np.expm1(-height * self.source_decay) / height
        return self.source + slope * camera_height, slope

    def _depth(self, distance: npt.ArrayLike, camera_height: npt.ArrayLike, target_height: npt.ArrayLike) -> FloatArray:
        start = np.asarray(camera_height, dtype=np.float64)[..., None] * self.inverse_scale_height
        end = np.asarray(target_height, dtype=np.float64)[..., None] * self.inverse_scale_height
        gas = self.coefficient * np.exp(-start) * mean_decay(end - start)
        haze = self.haze.extinction * self.haze.mean_density(camera_height, target_height)[..., None]
        return np.asarray(np.asarray(distance, dtype=np.float64)[..., None] * (gas + haze))

    def seen_from(self, camera_height: float) -> "AirPath":
        """The same air without haze as such, each term falling off so that paths down to the ground keep their depth.

        Paths from that height [m] to roofs are off as haze and gases fall off differently: in haze of 5 km, from above
        it, to a roof 40 m high, by up to a twentieth of the depth, from within it by a thousandth.
        """
        height = np.copysign(max(abs(camera_height), _LEAST_HEIGHT), camera_height)
        here = self.densest(np.array([height]))
        mean = self._depth(1.0, height, 0.0)
        inverse = _decay_of_mean(np.where(here > 0.0, mean / np.where(here > 0.0, here, 1.0), 1.0)) / -height
        return replace(self, coefficient=here * np.exp(height * inverse), inverse_scale_height=inverse, haze=NO_HAZE)

    def densest(self, heights: FloatArray) -> FloatArray:
        """Greatest extinction (k,) [m-1] of each term at any of the heights (n,) [m]."""
        gas = self.coefficient * np.exp(-np.outer(heights, self.inverse_scale_height))
        return np.asarray(np.max(gas + self.haze.extinction * self.haze.density(heights)[:, None], axis=0))

    def _phase(self, cosine: FloatArray) -> FloatArray:
        """Scattering towards the sensor relative to that at a right angle."""
        g = self.asymmetry
        return np.asarray(((1.0 + g * g) / (1.0 + g * g - 2.0 * g * cosine)) ** 1.5)


@lru_cache(maxsize=1)
def clear_path() -> AirPath:
    """No air at all: surfaces are seen as they are."""
    return single_term(0.0, 0.0)


def single_term(coefficient: float, source: float) -> AirPath:
    """The air of [Report1978] eq. 15: one coefficient [m-1] at all heights and one radiance [W m-2 sr-1]."""
    return AirPath(
        weight=np.ones(1),
        coefficient=np.array([coefficient]),
        inverse_scale_height=np.zeros(1),
        source=np.array([source]),
        source_decay=0.0,
        beam_source=np.zeros(1),
        asymmetry=0.0,
    )


def right_angle_phase(asymmetry: float) -> float:
    """Phase function [sr-1] of [HenyeyGreenstein1941] at a right angle; it integrates to 1 over the sphere."""
    return float((1.0 - asymmetry**2) / (4.0 * PI * (1.0 + asymmetry**2) ** 1.5))


def _decay_of_mean(mean: FloatArray) -> FloatArray:
    """x of which (1 - e^-x) / x is `mean`, by Newton's steps on its logarithm, which is nearly straight."""
    x = np.where(mean > 1.0, -1.0 - 1.2 * np.log(np.maximum(mean, 1.0)), 2.0 * (1.0 - mean))
    for _ in range(_STEPS):
        value, above, below = mean_decay(np.stack([x, x + 1e-4, x - 1e-4]))
        step = (np.log(value) - np.log(mean)) * value * 2e-4 / (above - below)
        x = x - step
        if np.abs(step).max() < _STILL:
            break
    return np.asarray(x)


def _lag(depth: FloatArray, part: FloatArray) -> FloatArray:
    """(1 - t) / d - t with t = e^-d: the weight of the far end's source; 0 at 0 and at infinity."""
    safe = np.where(depth < SMALL, 1.0, depth)
    return np.asarray(np.where(depth < SMALL, depth / 2.0 - depth * depth / 3.0, -np.expm1(-safe) / safe - part))
