"""Upper bounds of what each term of one frame is worth in the band: apparent kelvin where it emits, else radiance.

Apparent temperature rises with radiance ever more slowly, so that of all radiances that are L at least a change dL is
worth most to L itself: T(L + dL) - T(L). What the air leaves of both, tau dL of tau L at least and of what it adds, is
worth no more, since ln B flattens as temperature grows. And parts of a change are worth no less together than as one.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from sensorsim.constants import PI
from sensorsim.effects.air_bounds import AirBefore
from sensorsim.effects.costs import pixel_cost
from sensorsim.effects.face import FloatArray
from sensorsim.effects.glint import Gleam
from sensorsim.effects.ledger import NOISE_SHARE, Bound
from sensorsim.radiometry import BandTable

GREY_STEPS = 255.0  # of a display, from a black surface to a white one in the light of the moment


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Mirrors:
    """Emissivities [-] of the surfaces (g,) that may be in view and that mirror; none where they are matt."""

    matt: FloatArray  # of the same surface without its gloss
    least: FloatArray  # from the side where it is least
    greatest: FloatArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Look:
    """One frame in the numbers that its bounds need."""

    normal: FloatArray  # (s, 3) of all surfaces that may be in view
    emissivity: FloatArray  # (s,) in band, without gloss [-]
    reflectance: FloatArray  # (s,) in band [-]
    mirrors: Mirrors
    gleam: Gleam  # of those in a reflective band
    coldest: float  # of all surfaces at the moment, or a bound of it [K]
    warmest: float  # the same
    sun_direction: FloatArray  # (3,)
    beam: float  # irradiance normal to the sun, in band [W m-2]
    quadrant: FloatArray  # (4,) irradiance of the horizontal from the quarters of the sky, in band [W m-2]
    sky_radiance: float  # mean of the sky [W m-2 sr-1]
    sky_range: tuple[float, float]  # its least and greatest, with its glow [W m-2 sr-1]
    ground_radiance: float  # [W m-2 sr-1]
    air: AirBefore
    pixels: int  # of the picture


@dataclass(frozen=True, slots=True, kw_only=True)
class _Span:
    """Least and greatest radiance [W m-2 sr-1]."""

    least: float
    greatest: float

    def apart(self, other: "_Span") -> float:
        """Greatest difference of any two of both [W m-2 sr-1]."""
        return max(self.greatest - other.least, other.greatest - self.least)


def apparent_factor(table: BandTable, *, coldest: float, warmest: float) -> float:
    """Greatest change of the apparent temperature per kelvin that surfaces and ground change by [-]; 1 or more.

    A radiance is made of shares of theirs, of `coldest` at least, and of what only adds to them. Each share grows by
    B'(warmest) at most, so that the ratio is that of a black body whatever the shares.
    """
    return _slope_at(table, warmest) * _kelvin_per_radiance(table, _radiance(table, coldest))


def emissive_bounds(look: Look, table: BandTable, *, mirrored: bool = True) -> Mapping[str, Bound]:
    """Bounds [K] of apparent temperature; `mirrored` False where the user has left the reflected sky out.

    Without the reflected sky there are no mirrors either: surfaces emit alone, as matt ones.
    """
    own = _Span(least=_radiance(table, look.coldest), greatest=_radiance(table, look.warmest))
    ends = look.sky_radiance, look.ground_radiance
    mean = _Span(least=min(ends), greatest=max(ends))
    spots = _Span(least=min(look.sky_range[0], mean.least), greatest=max(look.sky_range[1], mean.greatest))
    matt, glossy = float(look.emissivity.min(initial=1.0)), float(look.mirrors.least.min(initial=1.0))
    alone = matt * own.least
    dimmest = min(_mix(matt, own.least, mean.least), _mix(glossy, own.least, spots.least))
    lost = max((1.0 - matt) * mean.greatest, _worth_of_emission_alone(look.mirrors, own, spots))
    mirrors = _worth_of_mirrors(look.mirrors, own, mean, spots)
    count = look.mirrors.matt.size
    return {
        "reflected_sky": Bound(
            value=_kelvin(table, min(alone, dimmest), lost), saves=pixel_cost("reflected_sky", look.pixels),
            reason=f"least emissivity {min(matt, glossy):.3g}",
        ),
        "specular": Bound(
            value=_kelvin(table, dimmest, mirrors), saves=pixel_cost("specular", look.pixels) if count else 0.0,
            reason=f"{count} glossy surfaces may be in view" if count else "no glossy surface is in view",
        ),
        "atmosphere": _air(look, dimmest if mirrored else alone, max(own.greatest, spots.greatest), table),
    }  # fmt: skip


def reflective_bounds(look: Look) -> Mapping[str, Bound]:
    """Bounds [W m-2 sr-1] of radiance. Light of sky and ground is what such a band is about, and no effect."""
    share, count = look.reflectance / PI, look.mirrors.matt.size
    direct = float(np.max(share * look.beam * np.maximum(look.normal @ look.sun_direction, 0.0), initial=0.0))
    sunlit = max(direct, look.gleam.sunlit)
    matt = direct + float(
        np.max(share * diffuse_irradiance(look.normal, look.quadrant, look.ground_radiance)[1], initial=0.0)
    )
    return {
        "specular": Bound(
            value=look.gleam.change, saves=pixel_cost("specular", look.pixels) if count else 0.0,
            reason=f"{count} glossy surfaces may be in view" if count else "no glossy surface is in view",
        ),
        "reflected_sun": Bound(
            value=sunlit, saves=pixel_cost("reflected_sun", look.pixels),
            reason="sun or moon lights surfaces" if sunlit > 0.0 else "neither sun nor moon",
        ),
        "atmosphere": _air(look, 0.0, max(matt, look.gleam.sent), None),
    }  # fmt: skip


def diffuse_irradiance(
    normal: FloatArray, quadrant: FloatArray, ground_radiance: float
) -> tuple[FloatArray, FloatArray]:
    """Least and greatest irradiance (s,) [W m-2] of faces (s, 3) by the quarters of the sky and the ground."""
    ground, share = PI * ground_radiance * 0.5 * (1.0 - normal[:, 2]), 2.0 * (1.0 + normal[:, 2])
    return ground + share * quadrant.min(), ground + share * quadrant.max()


def reflective_tolerance(look: Look) -> float:
    """A quarter of one of 255 grey steps between black and a white surface that faces sun and sky [W m-2 sr-1]."""
    return NOISE_SHARE / GREY_STEPS * (look.beam + float(look.quadrant.sum())) / PI


def _mix(emissivity: float, own: float, surroundings: float) -> float:
    """Least radiance of surfaces of that emissivity or more, whose surroundings may be brighter than they are."""
    return emissivity * own + (1.0 - emissivity) * min(own, surroundings)


def _worth_of_mirrors(mirrors: Mirrors, own: _Span, mean: _Span, spots: _Span) -> float:
    """Greatest change [W m-2 sr-1] from glossy to matt: (e - e') (B - mirrored) + (1 - e') (mirrored - mean)."""
    turned = np.maximum(np.abs(mirrors.least - mirrors.matt), np.abs(mirrors.greatest - mirrors.matt))
    change = turned * own.apart(spots) + (1.0 - mirrors.matt) * spots.apart(mean)
    return float(np.max(change, initial=0.0))


def _worth_of_emission_alone(mirrors: Mirrors, own: _Span, spots: _Span) -> float:
    """Greatest change [W m-2 sr-1] from a glossy surface to a matt one that emits alone."""
    more = np.maximum(mirrors.greatest - mirrors.matt, 0.0) * own.greatest + (1.0 - mirrors.least) * spots.greatest
    less = np.maximum(mirrors.matt - mirrors.least, 0.0) * own.greatest
    return float(np.max(np.maximum(more, less), initial=0.0))


def _air(look: Look, dimmest: float, brightest: float, table: BandTable | None) -> Bound:
    """What the air changes of surfaces and, where it is in view, of the ground plane."""
    change = max(look.air.change(dimmest, brightest), look.air.ground_change(look.ground_radiance))
    least = look.air.dimmed(min(dimmest, look.ground_radiance))
    worst = max(look.air.longest_range, look.air.ground_range)
    path = f"of up to {worst:,.0f} m" if np.isfinite(worst) else "to the horizon"
    return Bound(
        value=change if table is None else _kelvin(table, least, change),
        reason=f"a path {path}; up to {100.0 * look.air.worst_opacity:.3g} % of a surface's radiance is lost in it",
        saves=pixel_cost("atmosphere", look.pixels),
    )


def _radiance(table: BandTable, temperature: float) -> float:
    """Band radiance [W m-2 sr-1], that of the table's end beyond it: a frame there is refused anyway."""
    return float(np.interp(temperature, table.temperature, table.radiance))


def _kelvin(table: BandTable, radiance: float, change: float) -> float:
    """Most kelvin that a change [W m-2 sr-1] of that radiance [W m-2 sr-1] or more is worth, up to the table's end."""
    ends = np.interp([radiance, radiance + change], table.radiance, table.temperature)
    return float(ends[1] - ends[0])


def _slope_at(table: BandTable, temperature: float) -> float:
    """Slope [W m-2 sr-1 K-1] of the table's piece that holds a temperature [K]; it grows with temperature."""
    piece = int(np.clip(np.searchsorted(table.temperature, temperature), 1, table.temperature.size - 1))
    return float(
        (table.radiance[piece] - table.radiance[piece - 1]) / (table.temperature[piece] - table.temperature[piece - 1])
    )


def _kelvin_per_radiance(table: BandTable, radiance: float) -> float:
    """Most kelvin [K W-1 m2 sr] that a change of that radiance [W m-2 sr-1], of any share of it or of more is worth."""
    known = max(radiance, float(table.radiance[0]))
    pieces = max(int(np.searchsorted(table.radiance, known)), 1)
    return 1.0 / (known * float(_least_steepness(table)[pieces - 1]))


@lru_cache(maxsize=16)
def _least_steepness(table: BandTable) -> FloatArray:
    """Least relative slope [K-1] of a table's pieces up to each of them."""
    steepness = np.diff(table.radiance) / np.diff(table.temperature) / table.radiance[1:]
    return np.asarray(np.minimum.accumulate(steepness))
