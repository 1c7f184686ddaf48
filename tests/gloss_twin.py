"""Glossy surfaces in 0.8-1.1 um in NumPy, from sky and sun themselves: what the shader's tables are held to."""

import numpy as np
from numpy.typing import NDArray

from sensorsim.environment import SUN_RADIUS
from sensorsim.materials.facets import ANGLE_ENTRIES, facets, lobe_spread
from sensorsim.materials.gloss import Gloss
from sensorsim.render import Illumination
from sensorsim.render.mirror import MIRROR_ENTRIES, _lobe

FloatArray = NDArray[np.float64]
COSINE = np.linspace(0.0, 1.0, ANGLE_ENTRIES)


def whole_rise(gloss: Gloss, wind: float) -> FloatArray:
    """Rise of the surface's reflectance (ANGLE_ENTRIES,)."""
    return facets(gloss.slope_variance(wind)).mean(gloss.nir.rise)


def glint(
    gloss: Gloss, facet: FloatArray, normal: FloatArray, sun: FloatArray, eye: FloatArray, wind: float = 0.0,
    radius: float = SUN_RADIUS,
) -> FloatArray:  # fmt: skip
    """Radiance (n,) [sr-1] that facets mirror of irradiance 1, directions (n, 3) towards light and eye."""
    variance = gloss.slope_variance(wind)
    half = sun + eye
    half = half / np.linalg.norm(half, axis=1, keepdims=True)
    upright, incidence = np.sum(half * normal, axis=1), np.sum(half * sun, axis=1)
    into, out = np.sum(sun * normal, axis=1), np.maximum(np.sum(eye * normal, axis=1), 1e-4)
    slope = half / upright[:, None] - normal
    along = np.cross(normal, np.cross(sun - eye, normal))
    along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    in_plane = np.sum(slope * along, axis=1) ** 2
    across = np.maximum(np.sum(slope**2, axis=1) - in_plane, 0.0)
    plane, side = variance + radius**2 / 4.0, variance + radius**2 / (4.0 * incidence**2)
    density = np.exp(-in_plane / plane - across / side) / (np.pi * np.sqrt(plane * side) * upright**4)
    seen = facets(variance).seen
    shown = np.interp(into, COSINE, seen) * np.interp(out, COSINE, seen)
    mirrored = facet + (1.0 - facet) * np.interp(incidence, COSINE, gloss.nir.rise)
    found = np.minimum(density * shown / (4.0 * out), 1.0 / (np.pi * radius**2))
    return np.asarray(np.where(into > 0.0, mirrored * found, 0.0))


def scattered(
    gloss: Gloss, reflectance: FloatArray, facet: FloatArray, sun: FloatArray, eye: FloatArray, wind: float = 0.0
) -> FloatArray:
    """Radiance [sr-1] that comes from below the facets, of a light of irradiance 1, by the cosines of light and eye."""
    rise = whole_rise(gloss, wind)
    left = 1.0 - 2.0 * np.trapezoid(rise * COSINE, COSINE)
    both = (1.0 - np.interp(sun, COSINE, rise)) * (1.0 - np.interp(eye, COSINE, rise)) / left
    return np.asarray((reflectance - facet) * both * np.maximum(sun, 0.0) / np.pi)


def mirrored_sky(gloss: Gloss, light: Illumination, outward: FloatArray) -> FloatArray:
    """Radiance [W m-2 sr-1] of sky and ground through the lobe around directions (n, 3)."""
    grid = np.linspace(-1.0, 1.0, MIRROR_ENTRIES)
    lobe = _lobe(lobe_spread(gloss.slope_variance(light.wind_speed)))
    above = np.linspace(0.0, 1.0, light.sky.size)
    shown = lobe @ np.where(grid >= 0.0, np.interp(grid, above, light.sky), light.ground_radiance)
    total = np.interp(outward[:, 2], grid, shown)
    if light.glow is not None:
        gradation = lobe @ np.where(grid >= 0.0, np.interp(grid, above, light.glow.gradation), 0.0)
        cosine = np.linspace(-1.0, 1.0, light.glow.indicatrix.size)
        leaning = lobe @ np.interp(grid, cosine, light.glow.indicatrix)
        total += np.interp(outward[:, 2], grid, gradation) * np.interp(outward @ light.sun_direction, grid, leaning)
    return np.asarray(total)


def glossy(
    gloss: Gloss, reflectance: FloatArray, normal: FloatArray, view: FloatArray, diffuse: FloatArray,
    light: Illumination,
) -> FloatArray:  # fmt: skip
    """Radiance (n,) [W m-2 sr-1] of surfaces seen along `view`, with diffuse irradiance [W m-2] and sun."""
    facet, wind = gloss.nir.mirrored(reflectance), light.wind_speed
    eye, sun = -np.sum(view * normal, axis=1), normal @ light.sun_direction
    rise = np.interp(eye, COSINE, whole_rise(gloss, wind))
    sky = (facet + (1.0 - facet) * rise) * mirrored_sky(gloss, light, view + 2.0 * eye[:, None] * normal)
    below = (reflectance - facet) * (1.0 - rise) * diffuse / np.pi
    towards = np.broadcast_to(light.sun_direction, view.shape)
    direct = glint(gloss, facet, normal, towards, -view, wind)
    direct = direct + scattered(gloss, reflectance, facet, sun, eye, wind)
    return np.asarray(sky + below + light.beam * direct)
