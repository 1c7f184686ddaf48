"""What glossy surfaces can show at most in a reflective band, by where each of them lies and what it faces.

A surface within a ball is seen along directions e to the eye that lie within a distance of that to its middle. Over all
of them each factor of shaders/radiance/glossy.glsl has an end: the slope of the facets that mirror the light s into
the eye is (s + e) along the face over (s + e) across it, and cannot be less than the nearest e makes it; the share of
facets seen, the rise of their reflectance and the sky's glow by the angle from the light are tables, read at the worst
of the cosines that can occur. And no glint is brighter than the disc of the light itself.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import PI
from sensorsim.effects.face import FloatArray
from sensorsim.environment import SUN_RADIUS, SkyGlow
from sensorsim.materials.facets import lobe_spread

LEAST_COSINE = 1e-4  # of the angle to the eye, as in the shader
DISC_VARIANCE = 0.25 * SUN_RADIUS**2  # [-] added to that of slopes: a flat mirror shows the light as bright as its disc
BEYOND = 1e30  # [-] density of facets that shows the disc itself, whatever the rest
LOBE_REACH = np.radians(3.0)  # of its half width [rad deg-1], to which the mirrors' tables are blurred
COARSER = 4  # entries of the indicatrix to two of the mirrors' tables, and a step
_RISE, _SEEN, _SINGLE = range(3)  # tables of each kind


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Glossy:
    """Glossy surfaces (g,) that may be in view, and what there is for them to mirror."""

    normal: FloatArray  # (g, 3)
    eye: FloatArray  # (g, 3) unit, towards the camera from the middle of what can be seen
    reach: FloatArray  # (g,) greatest distance of any direction towards the camera from that [-]
    kind: NDArray[np.int64]  # (g,)
    reflectance: FloatArray  # (g,) in band [-]
    facet: FloatArray  # (g,) of a facet along its normal [-]
    facets: FloatArray  # (3 kinds, n + 1) rise, share of facets seen and rise of one, see `render.mirror.facet_table`
    even: float  # most that sky and ground send without the glow [W m-2 sr-1]
    glow: SkyGlow | None

    def cosines(self) -> tuple[FloatArray, FloatArray]:
        """Least and greatest cosine (g,) of the angle from the normal to the eye."""
        middle = np.einsum("gk,gk->g", self.normal, self.eye)
        return np.clip(middle - self.reach, 0.0, 1.0), np.clip(middle + self.reach, 0.0, 1.0)

    @property
    def variance(self) -> FloatArray:
        """Variance of slopes (kinds,) [-]."""
        return self.facets[self.facets.shape[0] // 3 : 2 * self.facets.shape[0] // 3, -1]


@dataclass(frozen=True, slots=True, kw_only=True)
class Gleam:
    """What glossy surfaces of a picture may show at most, the brightest of them [W m-2 sr-1]; 0 where there is none."""

    change: float = 0.0  # brighter or darker than the same surface without gloss
    sent: float = 0.0  # all together
    sunlit: float = 0.0  # of that by the light itself, mirrored or scattered


def gleam(glossy: Glossy, sun: FloatArray, beam: float, diffuse: tuple[FloatArray, FloatArray]) -> Gleam:
    """Bounds under a light in a direction (3,), `beam` [W m-2] normal to it, with the least and greatest diffuse (g,).

    `diffuse`: irradiance [W m-2] by sky and ground.
    """
    if not glossy.kind.size:
        return Gleam()
    least, _ = glossy.cosines()
    into = np.maximum(glossy.normal @ sun, 0.0)
    rise = _most(glossy, _RISE, least)
    sky = (glossy.facet + (1.0 - glossy.facet) * rise) * _brightest_sky(glossy, sun)
    under = (glossy.reflectance - glossy.facet) / PI  # what scatters below the facets
    left = glossy.facets[glossy.kind, -1]  # of a hemisphere's light, by them
    sunlit = glints(glossy, sun, beam) + under * beam * into * (1.0 - _at(glossy, _RISE, into)) / left
    sent = sky + sunlit + under * diffuse[1]
    darkest, brightest = (glossy.reflectance * (beam * into + light) / PI for light in diffuse)
    change = np.maximum(sent - darkest, brightest)
    return Gleam(change=float(change.max()), sent=float(sent.max()), sunlit=float(sunlit.max()))


def glints(glossy: Glossy, sun: FloatArray, beam: float) -> FloatArray:
    """Bound (g,) of what facets mirror of the light itself [W m-2 sr-1]."""
    facing, (least, greatest) = glossy.normal @ sun, glossy.cosines()
    variance, both, into = glossy.variance[glossy.kind], sun + glossy.eye, np.maximum(facing, 0.0)
    across = np.einsum("gk,gk->g", both, glossy.normal)
    along = np.linalg.norm(both - across[:, None] * glossy.normal, axis=1)
    tilt = (np.maximum(along - glossy.reach, 0.0) / np.maximum(into + greatest, LEAST_COSINE)) ** 2
    incidence = np.maximum(np.linalg.norm(both, axis=1) - glossy.reach, into + least)
    incidence = np.clip(0.5 * incidence, LEAST_COSINE, 1.0)
    density = _densest(tilt, variance + DISC_VARIANCE, variance + DISC_VARIANCE / incidence**2)
    shown = density * _at(glossy, _SEEN, into) * _most(glossy, _SEEN, least, per_cosine=True) / 4.0
    mirrored = glossy.facet + (1.0 - glossy.facet) * _most(glossy, _SINGLE, incidence)
    found = beam * mirrored * np.minimum(shown, 1.0 / (PI * SUN_RADIUS**2))
    return np.asarray(np.where((facing > 0.0) & (greatest > 0.0), found, 0.0))


def _densest(tilt: FloatArray, wide: FloatArray, broad: FloatArray) -> FloatArray:
    """Most (g,) of the density of facets whose squared slope is `tilt` or more, widened by `wide` to `broad`.

    exp(-t / b) / sqrt(b) is greatest at b = 2 t; exp(-t / b) (1 + t)^2 falls with t from 2 b - 1 on.
    """
    worst = np.clip(2.0 * tilt, wide, broad)
    value = np.exp(-tilt / worst) * (1.0 + tilt) ** 2 / (PI * np.sqrt(wide * worst))
    return np.asarray(np.where(2.0 * broad - 1.0 <= tilt, value, BEYOND))


def _brightest_sky(glossy: Glossy, sun: FloatArray) -> FloatArray:
    """Most (g,) [W m-2 sr-1] that lies in any mirror direction."""
    glow = glossy.glow
    if glow is None:
        return np.full(glossy.kind.size, glossy.even)
    towards = np.einsum("gk,gk->g", glossy.normal, glossy.eye)[:, None]
    off = np.arccos(np.clip((2.0 * towards * glossy.normal - glossy.eye) @ sun, -1.0, 1.0))
    spread = np.array([lobe_spread(float(variance)) for variance in glossy.variance])[glossy.kind]
    within = 2.0 * np.arcsin(np.clip(0.5 * glossy.reach, 0.0, 1.0)) + LOBE_REACH * spread
    entries = glow.indicatrix.size - 1
    place = np.ceil((0.5 + 0.5 * np.cos(np.maximum(off - within, 0.0))) * entries).astype(np.int64) + COARSER
    most = np.maximum.accumulate(glow.indicatrix)[np.minimum(place, entries)]
    return np.asarray(glossy.even + glow.gradation.max() * most)


def _at(glossy: Glossy, which: int, cosine: FloatArray) -> FloatArray:
    """A table (g,) of the surfaces' own kinds at a cosine."""
    last, row = glossy.facets.shape[1] - 2, which * glossy.variance.size + glossy.kind
    place = np.clip(cosine, 0.0, 1.0) * last
    low = np.minimum(place.astype(np.int64), last - 1)
    near, far = glossy.facets[row, low], glossy.facets[row, low + 1]
    return np.asarray(near + (place - low) * (far - near))


def _most(glossy: Glossy, which: int, cosine: FloatArray, *, per_cosine: bool = False) -> FloatArray:
    """Most (g,) of a table, or of it over the cosine, at that cosine or a greater one: there, or at an entry."""
    kinds, last = glossy.variance.size, glossy.facets.shape[1] - 2
    table = glossy.facets[which * kinds : (which + 1) * kinds, : last + 1]
    here = _at(glossy, which, np.maximum(cosine, LEAST_COSINE))
    if per_cosine:
        table, here = table / np.maximum(np.linspace(0.0, 1.0, last + 1), LEAST_COSINE), here / np.maximum(
            cosine, LEAST_COSINE
        )  # fmt: skip
    later = np.maximum.accumulate(table[:, ::-1], axis=1)[:, ::-1]
    return np.asarray(np.maximum(here, later[glossy.kind, np.ceil(cosine * last).astype(np.int64)]))
