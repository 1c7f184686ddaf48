"""Upper bounds of what each term of one frame is worth in the band: apparent kelvin where it emits, else radiance."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from sensorsim.constants import PI
from sensorsim.effects.costs import pixel_cost
from sensorsim.effects.face import FloatArray
from sensorsim.effects.ledger import NOISE_SHARE, Bound
from sensorsim.radiometry import BandTable

GREY_STEPS = 255.0  # of a display, from a black surface to a white one in the light of the moment


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Look:
    """One frame in the numbers that its bounds need."""

    normal: FloatArray  # (s, 3) of all surfaces
    emissivity: FloatArray  # (s,) in band [-]
    reflectance: FloatArray  # (s,) in band [-]
    coldest: float  # of all surfaces at the moment, or a bound of it [K]
    warmest: float  # the same
    longest_range: float  # of any surface that may be in view [m]
    ground_range: float  # of the ground plane where it may be in view [m]; 0 where it is not, infinite at the horizon
    sun_direction: FloatArray  # (3,)
    beam: float  # irradiance normal to the sun, in band [W m-2]
    quadrant: FloatArray  # (4,) irradiance of the horizontal from the quarters of the sky, in band [W m-2]
    sky_radiance: float  # mean of the sky [W m-2 sr-1]
    ground_radiance: float  # [W m-2 sr-1]
    air_radiance: float  # of an infinite path [W m-2 sr-1]
    attenuation: float  # [m-1]
    pixels: int  # of the picture


def apparent_factor(table: BandTable, *, coldest: float, warmest: float, emissivity: float) -> float:
    """Greatest change of the apparent temperature per kelvin of surface temperature [-]; above 1.

    Radiance grows with temperature by B'(warmest) at most, and an apparent temperature with radiance by 1 / B' at the
    least radiance that reaches the sensor: what the least emissivity emits at the coldest, since all else adds. The
    air mixes in its own and takes as much of both.
    """
    return _slope_at(table, warmest) / _slope_of_radiance(table, emissivity * float(_radiance(table, coldest)))


def emissive_bounds(look: Look, table: BandTable, *, mirrored: bool = True) -> Mapping[str, Bound]:
    """Bounds [K] of apparent temperature; `mirrored` False where the user has left the reflected sky out.

    The path takes (1 - tau) |L - L_air| of a surface that mirrors its surroundings; leaving these out as well adds its
    own bound, so that the sum holds for both.
    """
    least = float(look.emissivity.min(initial=1.0))
    surroundings = (look.sky_radiance, look.ground_radiance)
    emitted = least * _radiance(table, look.coldest)
    dimmest = emitted + ((1.0 - least) * min(*surroundings, _radiance(table, look.coldest)) if mirrored else 0.0)
    brightest = max(_radiance(table, look.warmest), *surroundings)
    arriving = min(look.air_radiance, look.ground_radiance)
    lost = (1.0 - least) * max(surroundings) / _slope_of_radiance(table, min(emitted, arriving))
    kelvin = 1.0 / _slope_of_radiance(table, min(dimmest, arriving))
    return {
        "reflected_sky": Bound(value=lost, reason=f"least emissivity {least:.3g}", saves=pixel_cost(look.pixels)),
        "atmosphere": _air(look, dimmest, brightest, kelvin),
    }


def reflective_bounds(look: Look) -> Mapping[str, Bound]:
    """Bounds [W m-2 sr-1] of radiance. Light of sky and ground is what such a band is about, and no effect."""
    share = look.reflectance / PI
    direct = float(np.max(share * look.beam * np.maximum(look.normal @ look.sun_direction, 0.0), initial=0.0))
    sky = 4.0 * float(look.quadrant.max()) * 0.5 * (1.0 + look.normal[:, 2])
    ground = PI * look.ground_radiance * 0.5 * (1.0 - look.normal[:, 2])
    brightest = direct + float(np.max(share * (sky + ground), initial=0.0))
    return {
        "reflected_sun": Bound(
            value=direct, reason="the sun lights surfaces" if direct > 0.0 else "no sun", saves=pixel_cost(look.pixels)
        ),
        "atmosphere": _air(look, 0.0, brightest, 1.0),
    }


def reflective_tolerance(look: Look) -> float:
    """A quarter of one of 255 grey steps between black and a white surface that faces sun and sky [W m-2 sr-1]."""
    return NOISE_SHARE / GREY_STEPS * (look.beam + float(look.quadrant.sum())) / PI


def _air(look: Look, dimmest: float, brightest: float, scale: float) -> Bound:
    """(1 - tau) |L - L_air| for surfaces and, where it is in view, for the ground plane, times `scale`."""
    lost = opacity(look.attenuation, look.longest_range)
    apart = max(brightest - look.air_radiance, look.air_radiance - dimmest, 0.0)
    ground = opacity(look.attenuation, look.ground_range) * abs(look.ground_radiance - look.air_radiance)
    worst = max(look.longest_range, look.ground_range)
    path = f"of up to {worst:,.0f} m" if np.isfinite(worst) else "to the horizon"
    return Bound(
        value=scale * max(lost * apart, ground),
        reason=f"a path {path} at {look.attenuation * 1000:.3g} per km",
        saves=pixel_cost(look.pixels),
    )


def opacity(attenuation: float, distance: float) -> float:
    """1 - tau [-]; an infinite path through clear vacuum takes nothing."""
    return -float(np.expm1(-attenuation * distance)) if attenuation > 0.0 else 0.0


def _radiance(table: BandTable, temperature: float) -> float:
    """Band radiance [W m-2 sr-1], that of the table's end beyond it: a frame there is refused anyway."""
    return float(np.interp(temperature, table.temperature, table.radiance))


def _slope_at(table: BandTable, temperature: float) -> float:
    """Slope [W m-2 sr-1 K-1] of the table's piece that holds a temperature [K]; it grows with temperature."""
    piece = int(np.clip(np.searchsorted(table.temperature, temperature), 1, table.temperature.size - 1))
    return float(
        np.diff(table.radiance[piece - 1 : piece + 1])[0] / np.diff(table.temperature[piece - 1 : piece + 1])[0]
    )


def _slope_of_radiance(table: BandTable, radiance: float) -> float:
    """The slope where the table has a radiance [W m-2 sr-1]."""
    return _slope_at(table, float(np.interp(radiance, table.radiance, table.temperature)))
