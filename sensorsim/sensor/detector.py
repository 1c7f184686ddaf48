"""The detector of a sensor as data: its elements, how long they look, and what they add to the signal.

Three kinds: `photon` counts electrons; `detectivity` is a scanned detector given by its D*; `thermal` is a bolometer
given by its NETD.
"""

import math
from dataclasses import dataclass
from typing import Literal, get_args

from sensorsim.errors import InputError

Kind = Literal["photon", "detectivity", "thermal"]
NEEDED = {
    "photon": ("integration_time", "quantum_efficiency", "well"),
    "detectivity": ("detectivity", "bandwidth", "saturation"),
    "thermal": ("netd", "saturation"),
}
LIMITS = {
    "pitch": (1e-7, 1e-2),
    "width": (1e-7, 1e-2),
    "height": (1e-7, 1e-2),
    "integration_time": (1e-9, 100.0),
    "quantum_efficiency": (1e-4, 1.0),
    "well": (1.0, 1e12),
    "read_noise": (0.0, 1e9),
    "dark_current": (0.0, 1e15),
    "excess_noise": (1.0, 10.0),
    "detectivity": (1e3, 1e13),
    "bandwidth": (1e-3, 1e10),
    "netd": (1e-4, 10.0),
    "saturation": (100.0, 5000.0),
    "response_time": (0.0, 10.0),
    "lag": (0.0, 0.99),
    "blooming": (0.0, 1.0),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Detector:
    """One element and its read-out; zero stands for what a kind does not have."""

    kind: Kind
    pitch: float  # from one sample to the next [m]
    width: float  # of the sensitive area, along the rows [m]
    height: float  # [m]
    bits: int  # of the counts
    integration_time: float = 0.0  # [s]
    quantum_efficiency: float = 0.0  # at the peak of the band's response, per unit of energy [-]
    well: float = 0.0  # electrons that fill an element
    read_noise: float = 0.0  # [electrons]
    dark_current: float = 0.0  # [electrons s-1]
    excess_noise: float = 1.0  # of multiplication, on the variance of the electrons [-]
    detectivity: float = 0.0  # D* at the peak of the response [m Hz^0.5 W-1]
    bandwidth: float = 0.0  # of the noise [Hz]
    netd: float = 0.0  # at 300 K [K]
    saturation: float = 0.0  # temperature of the black body that gives the highest count, where no well does [K]
    response_time: float = 0.0  # of a bolometer [s]
    lag: float = 0.0  # share of the last picture that a tube keeps [-]
    blooming: float = 0.0  # share of the charge above a full well that spills along the column [-]

    def __post_init__(self) -> None:
        """Refuse what no detector can have."""
        if self.kind not in get_args(Kind):
            raise InputError("detector", "kind", self.kind, "unknown", f"use one of {', '.join(get_args(Kind))}")
        if type(self.bits) is not int or not 1 <= self.bits <= 32:
            raise InputError(
                "detector", "bits", self.bits, "not a whole number from 1 to 32", "give that of the counts"
            )
        for entry, (low, high) in LIMITS.items():
            value = getattr(self, entry)
            needed = entry in ("pitch", "width", "height") or entry in NEEDED[self.kind]
            if not (math.isfinite(value) and value <= high and (value >= low or (value == 0.0 and not needed))):
                problem = f"not {low:g} to {high:g}" if math.isfinite(value) else "not finite"
                raise InputError("detector", entry, value, problem, f"give what a {self.kind} detector has")
