"""Which level of detail each part of a scene calls for: the coarsest whose error stays below a few pixels.

A level leaves out what is smaller than its resolution [Report1978 2.1], so that is its error in metres; seen from a
distance it covers resolution / (distance x angle of a pixel) pixels. The distance is that to the part's box, so that a
part is as fine as its nearest corner asks. Between two levels lies a band in which the present one stays: what flies
along the border does not flicker, and whatever changes is, at that moment, `pixels` in size or smaller by the band.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.render.camera import Camera
from sensorsim.scene import LEVELS, RESOLUTION

FloatArray = NDArray[np.float64]
Choice = NDArray[np.int64]

RESOLUTIONS = tuple(RESOLUTION[level] for level in LEVELS)  # [m] from coarse to fine


@dataclass(frozen=True, slots=True, kw_only=True)
class DetailRule:
    """How much may be missing; InputError for what cannot be."""

    pixels: float = 1.0  # that the error of a level may cover
    band: float = 0.2  # share of it by which a coarser level must be better before it is taken
    resolutions: Sequence[float] = RESOLUTIONS  # [m] of the levels, from coarse to fine
    steady: bool = False  # whether the last picture's choice holds within the band: a picture then depends on it

    def __post_init__(self) -> None:
        """Refuse what cannot be."""
        if not (np.isfinite(self.pixels) and self.pixels > 0.0):
            raise InputError("level of detail", "pixels", self.pixels, "not above zero", "give for example 1")
        if not 0.0 <= self.band < 1.0:
            raise InputError("level of detail", "band", self.band, "not 0 to 1", "give for example 0.2")
        sizes = np.asarray(self.resolutions, dtype=np.float64)
        if sizes.size == 0 or not np.all(sizes > 0.0) or not np.all(np.diff(sizes) < 0.0):
            problem = "not above zero and falling"
            raise InputError(
                "level of detail", "resolutions", list(self.resolutions), problem, "begin with the coarsest"
            )


def pixel_angle(camera: Camera, size: tuple[int, int]) -> float:
    """Angle [rad] that a pixel in the middle of a picture of `size` covers."""
    return 2.0 * camera.half_extent(size)[0] / size[0]


def box_distance(place: FloatArray, lowest: FloatArray, highest: FloatArray) -> FloatArray:
    """Distance [m] of a place (3,) to boxes (g, 3), 0 within them."""
    return np.asarray(np.linalg.norm(np.maximum(np.maximum(lowest - place, place - highest), 0.0), axis=1))


def choose_detail(distance: FloatArray, angle: float, rule: DetailRule, present: Choice | None = None) -> Choice:
    """Level (g,) of parts at distances (g,) [m] by pixels of an angle [rad]: 0 the coarsest.

    present (g,): levels shown now; a part goes to a coarser one only where that would do by the band too.
    """
    allowed = rule.pixels * angle * np.asarray(distance, dtype=np.float64)  # [m] that may be missing
    wanted = _coarsest(allowed, rule.resolutions)
    if present is None:
        return wanted
    return np.where(
        wanted < present, np.minimum(present, _coarsest(allowed * (1.0 - rule.band), rule.resolutions)), wanted
    )


def _coarsest(allowed: FloatArray, resolutions: Sequence[float]) -> Choice:
    """First level whose resolution is allowed, the finest where none is."""
    errors = np.asarray(resolutions, dtype=np.float64)
    fits = errors[None, :] <= allowed[:, None]
    return np.where(fits.any(axis=1), fits.argmax(axis=1), errors.size - 1)
