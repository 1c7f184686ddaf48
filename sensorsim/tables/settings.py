"""What a bake may spend: the knobs of accuracy against time, with named presets."""

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.errors import InputError
from sensorsim.tables.orientations import LAYOUTS
from sensorsim.thermal import CORRELATIONS, SKIES


@dataclass(frozen=True, slots=True, kw_only=True)
class BakeSettings:
    """How finely histories are solved and fitted."""

    orientations: str = "icosphere162"  # layout of the standard orientations
    reflectances: tuple[float, ...] = (0.1, 0.3, 0.5, 0.7, 0.9)  # solar reflectances that are solved
    degree: int = 4  # of the polynomial in reflectance
    step: float = 300.0  # [s]
    slice_interval: float = 900.0  # [s] between the times that are kept
    lead_in_days: float | None = None  # before the image day; None: by the walls' own time constants, see `lead_in`
    sky: str = "perez"  # diffuse light on tilted surfaces: perez, or the four quadrants of 1978
    convection: str = "mowitt"  # correlation of the forced film
    exchange: bool = False  # whether near surfaces of the scene see each other, see `near_surfaces`

    def __post_init__(self) -> None:
        """Refuse what cannot be solved or fitted."""
        for entry, broken, remedy in (
            ("orientations", self.orientations not in LAYOUTS, f"use one of {', '.join(LAYOUTS)}"),
            ("reflectances", _unusable(self.reflectances), "give different values between 0 and 1"),
            (
                "degree",
                not (isinstance(self.degree, int) and 0 <= self.degree < len(self.reflectances)),
                "use a whole number from 0 up to the number of reflectances less one",
            ),
            ("step", not 0 < self.step <= 3600, "use a step above 0 and up to 3600 s"),
            (
                "slice_interval",
                not (_is_whole(self.slice_interval, self.step) and _is_whole(SECONDS_PER_DAY, self.slice_interval)),
                "use a multiple of the step that divides the day",
            ),
            ("sky", self.sky not in SKIES, f"use one of {', '.join(SKIES)}"),
            ("convection", self.convection not in CORRELATIONS, f"use one of {', '.join(CORRELATIONS)}"),
            ("exchange", not isinstance(self.exchange, bool), "use True or False"),
            (
                "lead_in_days",
                self.lead_in_days is not None and not 0 <= self.lead_in_days <= 365,
                "use 0 to 365 days, or None",
            ),
        ):
            if broken:
                raise InputError("bake settings", entry, getattr(self, entry), "cannot be used", remedy)

    def to_dict(self) -> dict[str, Any]:
        """All settings by name."""
        return {field.name: getattr(self, field.name) for field in fields(self)}


def _unusable(reflectances: tuple[float, ...]) -> bool:
    values = np.asarray(reflectances, dtype=np.float64)
    inside = np.all(np.isfinite(values)) and np.all((values >= 0.0) & (values <= 1.0))
    return values.size == 0 or not inside or np.unique(values).size != values.size


def _is_whole(whole: float, part: float) -> bool:
    """Whether `part` goes into `whole` without a rest; never for what is not finite and above zero."""
    if not (0.0 < part < np.inf and 0.0 < whole < np.inf):
        return False
    return round(whole / part) >= 1 and abs(whole / part - round(whole / part)) < 1e-9


PRESETS = {
    "report": BakeSettings(
        orientations="report26", sky="quadrants"
    ),  # the few orientations, five reflectances and quartic of 1978
    "standard": BakeSettings(),
    "reference": BakeSettings(orientations="icosphere642", step=60.0),
}


def preset(name: str) -> BakeSettings:
    """The named preset."""
    if name not in PRESETS:
        raise InputError("bake settings", "preset", name, "unknown preset", f"use one of {', '.join(PRESETS)}")
    return PRESETS[name]
