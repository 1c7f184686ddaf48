"""Effects on demand: which terms of the model a scene calls for, with a bound for each one that is left out.

`surface_bounds` and `frame_bounds` bound what each effect is worth, with no solve; `decide` shares a tolerance among
them by the user's `EffectChoice`; the `EffectPlan` that comes out is what march, baker and shaders obey, and its
`Ledger` says why.
"""

from sensorsim.effects.air_bounds import AirBefore
from sensorsim.effects.catalogue import EFFECTS, FRAME, NOT_MODELLED, SUNLIGHT, SURFACE, Effect
from sensorsim.effects.choice import EffectChoice, applicable, read_choice
from sensorsim.effects.costs import march_cost, term_cost
from sensorsim.effects.face import Face, Limits, temperature_limits
from sensorsim.effects.frame_bounds import (
    Look,
    Mirrors,
    apparent_factor,
    diffuse_irradiance,
    emissive_bounds,
    reflective_bounds,
    reflective_tolerance,
)
from sensorsim.effects.glint import Gleam, Glossy, gleam
from sensorsim.effects.ledger import DEFAULT_NOISE, NOISE_SHARE, Bound, Ledger, LedgerRow, decide
from sensorsim.effects.plan import EVERYTHING, EffectPlan
from sensorsim.effects.sensor_bounds import sensor_bounds, signal_tolerance
from sensorsim.effects.surface_bounds import QUARTERS, Situation, film_bound, reflectance_bound, surface_bounds

__all__ = [
    "DEFAULT_NOISE",
    "EFFECTS",
    "EVERYTHING",
    "FRAME",
    "NOISE_SHARE",
    "NOT_MODELLED",
    "QUARTERS",
    "SUNLIGHT",
    "SURFACE",
    "AirBefore",
    "Bound",
    "Effect",
    "EffectChoice",
    "EffectPlan",
    "Face",
    "Gleam",
    "Glossy",
    "Ledger",
    "LedgerRow",
    "Limits",
    "Look",
    "Mirrors",
    "Situation",
    "apparent_factor",
    "applicable",
    "decide",
    "diffuse_irradiance",
    "emissive_bounds",
    "film_bound",
    "gleam",
    "march_cost",
    "read_choice",
    "reflectance_bound",
    "reflective_bounds",
    "reflective_tolerance",
    "sensor_bounds",
    "signal_tolerance",
    "surface_bounds",
    "temperature_limits",
    "term_cost",
]
