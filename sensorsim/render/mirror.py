"""What glossy surfaces show: sky and ground along the mirror direction, seen through the lobe of each kind of gloss.

The surroundings depend on the elevation alone, so one row per kind holds their radiance against the upward component
of the mirror direction. Buildings do not show in each other.
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from sensorsim.materials.gloss import ANGLE_ENTRIES, load_gloss

FloatArray = NDArray[np.float64]

MIRROR_ENTRIES = 513  # equally spaced in the upward component of the mirror direction, -1 to 1
_RINGS, _SECTORS = 24, 32  # of a lobe
_FARTHEST = 3.0  # rings reach to this many half widths


def gloss_records(codes: NDArray[np.int64], emissivity: FloatArray) -> FloatArray:
    """Records (s, 4) of surfaces by their material's code: kind of gloss or -1, emissivity along the normal."""
    record = np.zeros((codes.size, 4))
    record[:, 0] = -1.0
    record[:, 1] = emissivity
    for row, gloss in enumerate(load_gloss()):
        held = np.isin(codes, gloss.codes)
        record[held, 0] = row
        if gloss.normal_emissivity is not None:
            record[held, 1] = gloss.normal_emissivity
    return record


def rise_table() -> FloatArray:
    """Rise of the reflectance (kinds, ANGLE_ENTRIES) against the cosine from the normal."""
    return np.stack([gloss.rise for gloss in load_gloss()])


def mirror_glsl() -> str:
    """Sizes of both tables for the shader."""
    return f"const int ANGLE_ENTRIES = {ANGLE_ENTRIES};\nconst int MIRROR_ENTRIES = {MIRROR_ENTRIES};\n"


def mirror_table(sky: FloatArray, ground_radiance: float) -> FloatArray:
    """Radiance (kinds, MIRROR_ENTRIES) [W m-2 sr-1] of sky and ground by the upward component of the mirror direction.

    sky (n,): radiance at elevations whose sine goes evenly from 0 to 1; below the horizon is the ground plane.
    """
    up = np.linspace(-1.0, 1.0, MIRROR_ENTRIES)
    around = np.where(up >= 0.0, np.interp(up, np.linspace(0.0, 1.0, sky.size), sky), ground_radiance)
    return np.stack([_lobe(gloss.spread) @ around for gloss in load_gloss()])


@cache
def _lobe(spread: float) -> csr_array:
    """Shares (MIRROR_ENTRIES, MIRROR_ENTRIES) that a lobe around each mirror direction has in each elevation."""
    if spread == 0.0:
        return csr_array(np.eye(MIRROR_ENTRIES))
    middle = np.linspace(-1.0, 1.0, MIRROR_ENTRIES)[:, None, None]
    off = np.radians(min(_FARTHEST * spread, 90.0)) * (np.arange(_RINGS) + 0.5) / _RINGS
    around = np.pi * (np.arange(_SECTORS) + 0.5) / _SECTORS
    up = np.cos(off)[:, None] * middle + np.sin(off)[:, None] * np.sqrt(1.0 - middle**2) * np.cos(around)
    ring = np.exp(-np.log(2.0) * (np.degrees(off) / spread) ** 2) * np.sin(off)
    weight = np.broadcast_to(ring[:, None] / (ring.sum() * _SECTORS), up.shape)
    place = np.clip(0.5 + 0.5 * up, 0.0, 1.0) * (MIRROR_ENTRIES - 1)
    low = np.minimum(place.astype(np.int64), MIRROR_ENTRIES - 2)
    row = np.broadcast_to(np.arange(MIRROR_ENTRIES)[:, None, None], up.shape)
    share = np.zeros((MIRROR_ENTRIES, MIRROR_ENTRIES))
    np.add.at(share, (row, low), weight * (1.0 - (place - low)))
    np.add.at(share, (row, low + 1), weight * (place - low))
    return csr_array(share)
