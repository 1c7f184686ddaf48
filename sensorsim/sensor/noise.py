"""Noise in three dimensions as data: how much stays in rows, columns and frames, and what is fixed.

The seven components of [DAgostino1991], each a standard deviation over that of the random noise of one pixel in one
frame (tvh): t frames, v rows, h columns; vh is the fixed pattern that correction has left.
"""

import math
from dataclasses import dataclass, fields

from sensorsim.errors import InputError


@dataclass(frozen=True, slots=True, kw_only=True)
class Noise:
    """Components over the random one [-], and elements that do not see; InputError for what cannot be."""

    random: float = 1.0  # tvh itself, over what the detector makes of light; 0: none at all
    v: float = 0.0  # rows that differ: channels of a scanner
    h: float = 0.0  # columns that differ: read-out of an array
    vh: float = 0.0  # fixed pattern
    t: float = 0.0  # frames that differ
    tv: float = 0.0  # rows that flicker
    th: float = 0.0  # columns that flicker
    gain: float = 0.0  # r.m.s. of what correction has left of the elements' gains [-]
    corrected_at: float = 300.0  # [K] where gains that differ do not show
    dead: float = 0.0  # share of elements that do not see [-]
    replaced: bool = False  # whether the median of their neighbours stands for them; else they show nothing
    seed: int = 1976

    def __post_init__(self) -> None:
        """Refuse what cannot be."""
        highest = {"gain": 0.5, "dead": 0.5, "corrected_at": 700.0}
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name == "replaced":
                if type(value) is not bool:
                    raise InputError("noise", "replaced", value, "neither true nor false", "give true or false")
                continue
            if field.name == "seed":
                if type(value) is not int or not 0 <= value < 2**32:
                    raise InputError("noise", "seed", value, "not a whole number below 2^32", "give for example 1")
                continue
            limit = highest.get(field.name, 100.0)
            if not (math.isfinite(value) and 0.0 <= value <= limit):
                raise InputError("noise", field.name, value, f"not 0 to {limit:g}", "give a share, not a percentage")
