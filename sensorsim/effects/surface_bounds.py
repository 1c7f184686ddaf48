"""Upper bounds of what each term of the heat balance is worth to any surface temperature [K], with no solve.

A face gains q(t) and loses a flux that grows with its temperature T by s at least,

    s = 4 emissivity sigma T_coldest^3 + h   [W m-2 K-1],

as emission does, and the wind's film, of h at least, where that is sure to be kept; other films, evaporation and the
wall only add. Leave a term out that is worth up to Q [W m-2], and T changes by Q / s at most: Q / s added to the whole
wall for good already loses Q more outside, nothing less anywhere else, and so bounds the change from above for all
times, and its negative from below: the comparison principle of the heat equation [Protter1984]. It holds for all terms
together with the sum of their Q, so that bounds add up. Walls also see the ground plane change, by its own bound times
4 emissivity sigma T_ground^3 / s, and a mixture or a wall of parallel paths changes by no more than its part that
changes most. Nothing changes by more than the limits of its temperature leave.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.effects.face import Face, FloatArray, Limits, interior_share, slope, temperature_limits
from sensorsim.effects.ledger import Bound
from sensorsim.environment import Environment, circumsolar_irradiance, saturation_vapour_pressure

HORIZON_WARMTH = 0.11  # at least that of the thermal sky of walls
NONE = "none in the history"
QUARTERS = ("sky_north", "sky_east", "sky_south", "sky_west")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Situation:
    """A weather history, the faces that it acts on and the ground plane that they see."""

    environment: Environment
    faces: tuple[Face, ...]
    ground: Face
    film_kept: bool = False  # whether the wind's film is computed, whatever else is left out

    @property
    def limits(self) -> Limits:
        """Temperatures that no surface leaves."""
        return temperature_limits(self.environment, self.faces, self.ground, film_kept=self.film_kept)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Case:
    """One face in its weather."""

    environment: Environment
    face: Face
    limits: Limits
    warmest: float  # of the face [K]
    film_kept: bool

    @property
    def apart(self) -> float:
        """Greatest difference of surface and air [K]."""
        air = self.environment.air_temperature
        return max(self.warmest - float(air.min()), float(air.max()) - self.limits.coldest)

    @property
    def latent(self) -> float:
        """Greatest latent heat flux [W m-2]."""
        pressure = float(saturation_vapour_pressure(np.array(self.warmest)))
        return self.face.latent * max(pressure, float(self.environment.vapour_pressure.max()))

    @property
    def down(self) -> float:
        """Greatest share of the ground in a hemisphere [-]."""
        return float(np.max(1.0 - _upwards(self), initial=0.0))

    @property
    def dry(self) -> "_Case":
        """The same without vapour, whose bound is wide: for what is told of a term."""
        return replace(self, face=replace(self.face, latent=0.0))

    @property
    def slope(self) -> float:
        """Least growth of the face's loss with its temperature [W m-2 K-1]."""
        return slope(self.face.emissivity, self.limits.coldest) + self.film_kept * self.face.least_film

    @property
    def per_flux(self) -> float:
        """Kelvin per absorbed flux [K m2 W-1]; a skin of water follows the flux itself besides."""
        return 1.0 / self.slope + self.face.skin

    def by_ground(self, change: float) -> float:
        """What a change of the ground plane [K] is worth to the face [K], at most."""
        return change * slope(self.face.emissivity, self.limits.ground) / self.slope

    def lit(self, irradiance: float) -> float:
        """Flux [W m-2] of an irradiance, with what it does to stomata and to the drying of a film of water."""
        light = self.face.absorptance * irradiance
        return light + (self.latent if light > 0.0 and self.face.latent_by_light else 0.0)

    def warmed(self, apart: float, share: float) -> float:
        """Flux [W m-2] of long waves from a share whose temperature's fourth power is `apart` [K4] from the air's."""
        flux = self.face.emissivity * STEFAN_BOLTZMANN_CONSTANT * apart * share
        return flux + (self.latent if flux > 0.0 and self.face.rain > 0.0 else 0.0)


Rule = Callable[[_Case], float]  # W m-2 that a term is worth


def surface_bounds(situation: Situation) -> Mapping[str, Bound]:
    """Bound [K] of each term by its name."""
    cases = _cases(situation)
    bounds = {name: _worth(cases, rule, reason) for name, (rule, reason) in _RULES.items()}
    if situation.film_kept:  # as far as the others go
        bounds["forced_convection"] = film_bound(situation)
    bounds["snow"] = _snow(situation)
    bounds["interior"] = _interior(cases)
    return bounds


def film_bound(situation: Situation) -> Bound:
    """Bound [K] of the wind's film."""
    return _worth(_cases(replace(situation, film_kept=False)), *_RULES["forced_convection"])


def reflectance_bound(situation: Situation, misses: Sequence[float]) -> float:
    """Most kelvin between faces as polynomials in reflectance have them and as they are.

    `misses` [-]: how far in reflectance the polynomial of each face reaches; that share of its light may be amiss.
    """
    found = [0.0]
    for case, miss in zip(_cases(situation)[1:], misses, strict=True):
        drying = case.latent if miss > 0.0 and case.face.latent_by_light else 0.0
        flux = miss * case.face.light + (drying if case.face.light > 0.0 else 0.0)
        found.append(min(flux * case.per_flux, case.warmest - case.limits.coldest))
    return max(found)


def _cases(situation: Situation) -> tuple[_Case, ...]:
    """The ground plane, and all faces."""
    limits = situation.limits
    faces, warmest = (situation.ground, *situation.faces), (limits.ground, *limits.warmest)
    return tuple(
        _Case(
            environment=situation.environment, face=face, limits=limits, warmest=high, film_kept=situation.film_kept
        )
        for face, high in zip(faces, warmest, strict=True)
    )  # fmt: skip


def _worth(cases: Sequence[_Case], rule: Rule, reason: str) -> Bound:
    """Kelvin that a flux by `rule` is worth, to the faces directly and by way of the ground, the first of the cases."""
    fluxes = [rule(case) for case in cases]
    ground = fluxes[0] * cases[0].per_flux
    kelvin = [ground] + [
        case.by_ground(ground) * case.down + flux * case.per_flux
        for flux, case in zip(fluxes[1:], cases[1:], strict=True)
    ]
    return Bound(
        # No change is greater than all that the limits leave.
        value=max(min(one, case.warmest - case.limits.coldest) for one, case in zip(kelvin, cases, strict=True)),
        reason=reason.format(max(rule(case.dry) for case in cases)) if any((ground, *fluxes)) else NONE,
    )


def _towards_sun(case: _Case) -> FloatArray:
    return np.asarray(np.maximum(case.environment.sun_direction @ case.face.normal.T, 0.0))


def _upwards(case: _Case) -> FloatArray:
    return np.asarray(0.5 * (1.0 + case.face.normal[:, 2]))


def _level(case: _Case) -> FloatArray:
    return np.asarray(np.hypot(case.face.normal[:, 0], case.face.normal[:, 1]))


def _direct(case: _Case) -> float:
    return case.lit(float(np.max(case.environment.beam_irradiance[:, None] * _towards_sun(case), initial=0.0)))


def _dome(case: _Case) -> float:
    dome = case.environment.diffuse_irradiance * (1.0 - case.environment.circumsolar_brightness)
    return case.lit(float(dome.max() * _upwards(case).max()))


def _circumsolar(case: _Case) -> float:
    weather = case.environment
    glow = circumsolar_irradiance(weather.diffuse_irradiance, weather.sky_brightness, weather.sun_direction)
    return case.lit(float(np.max(glow[:, None] * _towards_sun(case), initial=0.0)))


def _horizon(case: _Case) -> float:
    rim = np.abs(case.environment.diffuse_irradiance * case.environment.horizon_brightness)
    return case.lit(float(rim.max() * _level(case).max()))


def _quarter(k: int) -> Rule:
    return lambda case: case.lit(float(4.0 * case.environment.quadrant_irradiance[:, k].max() * _upwards(case).max()))


def _from_ground(case: _Case) -> float:
    weather = case.environment
    level = weather.beam_irradiance * np.maximum(weather.sun_direction[:, 2], 0.0) + weather.diffuse_irradiance
    return case.lit(float((weather.ground_albedo * level).max()) * case.down)


def _thermal_sky(case: _Case) -> float:
    lacking = np.abs(case.environment.air_temperature**4 - case.environment.sky_temperature**4)
    share = _upwards(case) + HORIZON_WARMTH * _level(case) ** 1.5
    return case.warmed(float(lacking.max()), float(share.max()))


def _ground(case: _Case) -> float:
    air, limits = case.environment.air_temperature, case.limits
    apart = max(limits.ground**4 - float(air.min()) ** 4, float(air.max()) ** 4 - limits.coldest**4)
    return case.warmed(apart, case.down)


def _forced(case: _Case) -> float:
    return case.face.forced * case.apart + case.latent if case.face.forced > 0.0 else 0.0


def _free(case: _Case) -> float:
    film = float(np.cbrt(case.face.free * case.apart))
    return film * case.apart + case.latent if film > 0.0 else 0.0


def _rain(case: _Case) -> float:
    return case.face.rain * case.apart + case.latent if case.face.rain > 0.0 else 0.0


_RULES: Mapping[str, tuple[Rule, str]] = {
    "direct_sun": (_direct, "the beam is worth up to {:.3g} W m-2"),
    "sky_dome": (_dome, "the dome is worth up to {:.3g} W m-2"),
    "sky_glow": (_circumsolar, "the glow is worth up to {:.3g} W m-2"),
    "sky_horizon": (_horizon, "the horizon gives or takes up to {:.3g} W m-2"),
    **{name: (_quarter(k), "this quarter is worth up to {:.3g} W m-2") for k, name in enumerate(QUARTERS)},
    "ground_sun": (_from_ground, "the ground's light is worth up to {:.3g} W m-2"),
    "thermal_sky": (_thermal_sky, "the sky's long waves are up to {:.3g} W m-2 from the air's"),
    "ground_exchange": (_ground, "the ground's long waves may be {:.3g} W m-2 from the air's"),
    "forced_convection": (_forced, "the wind may carry {:.3g} W m-2"),
    "free_convection": (_free, "free convection may carry {:.3g} W m-2"),
    "rain": (_rain, "rain may take {:.3g} W m-2"),
    "evaporation": (lambda case: case.latent, "surfaces are wet, or give off vapour when dry"),
}


def _snow(situation: Situation) -> Bound:
    lying = bool(np.any(situation.environment.ground_state == "snow"))
    if not (lying or any(face.snow for face in (*situation.faces, situation.ground))):
        return Bound(value=0.0, reason="no snow lies in the history")
    limits = situation.limits
    return Bound(value=limits.greatest - limits.coldest, reason="snow lies: it melts rather than warms, and is bright")


def _interior(cases: Sequence[_Case]) -> Bound:
    reach = [
        interior_share(case.face, case.slope) * (case.warmest - case.limits.coldest) for case in cases
    ]  # fmt: skip
    seen = [0.0, *(case.by_ground(reach[0]) for case in cases[1:])]
    value = max(own + ground for own, ground in zip(reach, seen, strict=True))
    return Bound(value=value, reason=f"of any change of an inner face {value:.3g} K may reach the outer one")
