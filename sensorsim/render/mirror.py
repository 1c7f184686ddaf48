"""What glossy surfaces show: sky and ground along the mirror direction, seen through the lobe of each kind of gloss.

The surroundings depend on the elevation alone, and in reflective bands on the angle from the sun besides, so that a row
per kind holds their radiance against the upward component of the mirror direction, and one its share by that angle.
Buildings do not show in each other.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from sensorsim.effects.glint import DISC_VARIANCE
from sensorsim.environment import SkyGlow
from sensorsim.materials.facets import ANGLE_ENTRIES, facets, lobe_spread
from sensorsim.materials.gloss import load_gloss

FloatArray = NDArray[np.float64]

MIRROR_ENTRIES = 513  # equally spaced in the upward component of the mirror direction, -1 to 1
_RINGS, _SECTORS = 24, 32  # of a lobe
_FARTHEST = 3.0  # rings reach to this many half widths


def gloss_records(codes: NDArray[np.int64], emissivity: FloatArray, nir_reflectance: FloatArray) -> FloatArray:
    """Records (s, 4) by code: kind of gloss or -1, emissivity and a facet's reflectance along the normal, a spare."""
    record = np.zeros((codes.size, 4))
    record[:, 0] = -1.0
    record[:, 1] = emissivity
    for row, gloss in enumerate(load_gloss()):
        held = np.isin(codes, gloss.codes)
        record[held, 0] = row
        if gloss.normal_emissivity is not None:
            record[held, 1] = gloss.normal_emissivity
        record[held, 2] = gloss.nir.mirrored(nir_reflectance[held])
    return record


def rise_table() -> FloatArray:
    """Rise of the reflectance (kinds, ANGLE_ENTRIES) against the cosine from the normal, in thermal bands."""
    return np.stack([gloss.rise for gloss in load_gloss()])


@lru_cache(maxsize=64)
def facet_table(wind_speed: float) -> FloatArray:
    """Of each kind's facets in 0.8-1.1 um, in a wind [m s-1]: rows (3 kinds, ANGLE_ENTRIES + 1) against the cosine.

    First the rise of the surface's reflectance, with 1 - its mean over a hemisphere's light; then the share of facets
    seen, with the variance of their slopes; then the rise of a single facet's reflectance.
    """
    kinds, cosine = load_gloss(), np.linspace(0.0, 1.0, ANGLE_ENTRIES)
    variances = [gloss.slope_variance(wind_speed) for gloss in kinds]
    found = [facets(variance) for variance in variances]
    rises = [held.mean(gloss.nir.rise) for held, gloss in zip(found, kinds, strict=True)]
    scattered = [1.0 - 2.0 * float(np.trapezoid(rise * cosine, cosine)) for rise in rises]
    whole = [np.append(rise, last) for rise, last in zip(rises, scattered, strict=True)]
    seen = [np.append(held.seen, last) for held, last in zip(found, variances, strict=True)]
    return np.stack([*whole, *seen, *(np.append(gloss.nir.rise, 0.0) for gloss in kinds)])


def mirror_glsl() -> str:
    """Sizes of the tables for the shader, and what the sun's disc adds to the variance of slopes along its image."""
    return (
        f"const int ANGLE_ENTRIES = {ANGLE_ENTRIES};\nconst int MIRROR_ENTRIES = {MIRROR_ENTRIES};\n"
        f"const int GLOSS_KINDS = {len(load_gloss())};\nconst float DISC_VARIANCE = {DISC_VARIANCE};\n"
    )


def mirror_table(sky: FloatArray, ground_radiance: float) -> FloatArray:
    """Radiance (kinds, MIRROR_ENTRIES) [W m-2 sr-1] of sky and ground by the upward component of the mirror direction.

    sky (n,): radiance at elevations whose sine goes evenly from 0 to 1; below the horizon is the ground plane.
    """
    around = _all_around(sky, ground_radiance)
    spreads = [gloss.spread for gloss in load_gloss()]
    shown = {spread: _lobe(spread) @ around for spread in set(spreads)}
    return np.stack([shown[spread] for spread in spreads])


def glow_mirror_table(sky: FloatArray, ground_radiance: float, glow: SkyGlow | None, wind_speed: float) -> FloatArray:
    """The same in 0.8-1.1 um, in a wind [m s-1], with what leans to the sun (3 kinds, MIRROR_ENTRIES).

    The rows are of sky and ground, then the glow's gradation [W m-2 sr-1] by the upward component of the mirror
    direction, then its indicatrix [-] by the cosine of the mirror direction from the sun; lobes blur each alone.
    """
    lobes = [_lobe(lobe_spread(gloss.slope_variance(wind_speed))) for gloss in load_gloss()]
    shown = [_all_around(sky, ground_radiance)]
    if glow is None:
        shown += [np.zeros(MIRROR_ENTRIES)] * 2
    else:
        cosine = np.linspace(-1.0, 1.0, glow.indicatrix.size)
        indicatrix = np.interp(np.linspace(-1.0, 1.0, MIRROR_ENTRIES), cosine, glow.indicatrix)
        shown += [_all_around(glow.gradation, 0.0), indicatrix]
    return np.stack([lobe @ around for around in shown for lobe in lobes])


def _all_around(sky: FloatArray, below: float) -> FloatArray:
    up = np.linspace(-1.0, 1.0, MIRROR_ENTRIES)
    return np.where(up >= 0.0, np.interp(up, np.linspace(0.0, 1.0, sky.size), sky), below)


@lru_cache(maxsize=64)
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
