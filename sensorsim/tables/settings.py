"""What a bake may spend: the knobs of accuracy against time, with named presets.

What the default was chosen from: winter's clear day, seven wall types from sheet metal to a mixed block, 100 normals of
any tilt at reflectances of 0.05 to 0.95, every 25 minutes of the day, against the full solve of those very surfaces;
99th percentile / maximum of the error [K], and columns solved for each wall type. All with lobes have slices of 5 min.

plain, barycentric on icosphere162, 5 reflectances, quartic   0.40 / 2.5    810
lobes 1800 s, barycentric on octahedron66, 3 reflectances     0.15 / 0.47   198
lobes 1800 s, barycentric on icosphere162                     0.08 / 0.37   486
lobes 1800 s, spline through icosphere42                      0.11 / 0.49   126
lobes 3600 s, spline through octahedron66                     0.10 / 0.58   198
lobes 1800 s, the same                                        0.08 / 0.38   198
lobes 900 s, the same: the default                            0.08 / 0.29   198
lobes 1800 s, spline through octahedron146                    0.05 / 0.27   438

The default over the whole catalogue of 60 materials, 36 normals, every 45 minutes: 0.10 / 0.34 in winter, 0.08 / 0.29
in fall, 0.03 / 0.10 in summer, snow apart, which melts: 0.3 to 0.6 / 0.8 to 1.6. Clear sun in perfectly still air,
insulated faces to 87 C: 0.20 / 0.5, snow 1.2 / 2.7. Lead-ins of three steps in one add up to 0.03.

At the default's orientations a degree of 1 through three reflectances gives 0.09 / 0.39, two reflectances 0.29 / 0.69,
four and a cubic the same as three; slices of 10 and 15 minutes 0.14 / 0.47 and 0.22 / 0.87, because the sun leaves a
sheet of metal within minutes; half precision the same as single.
"""

from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.errors import InputError
from sensorsim.tables.orientations import LAYOUTS
from sensorsim.thermal import CORRELATIONS, SKIES

INTERPOLATIONS = ("spline", "barycentric", "closest")
PRECISIONS = ("float32", "float16")
THREE = (0.07, 0.5, 0.93)
FIVE = (0.1, 0.3, 0.5, 0.7, 0.9)


@dataclass(frozen=True, slots=True, kw_only=True)
class BakeSettings:
    """How finely histories are solved and fitted."""

    orientations: str = "icosphere42"  # layout of the standard orientations
    interpolation: str = "spline"  # between them, one of INTERPOLATIONS
    lobes: float = 900.0  # [s] between the sun's places that have lobes of their own; 0: no lobes
    reflectances: tuple[float, ...] = (0.02, 0.35, 0.8, 0.98)  # solar reflectances that are solved
    degree: int = 3  # of the polynomial in reflectance
    step: float = 300.0  # [s]
    cell_size: float = 1.0  # of the walls' finite volumes over the usual
    slice_interval: float = 300.0  # [s] between the times that are kept
    precision: str = "float32"  # of the numbers that are kept, one of PRECISIONS
    lead_in_days: float | None = None  # before the image day; None: by the walls' own time constants, see `lead_in`
    lead_in_stride: int = 6  # steps that are joined to one in the lead-in
    sky: str = "perez"  # diffuse light on tilted surfaces: perez, or the four quadrants of 1978
    convection: str = "mowitt"  # correlation of the forced film
    exchange: bool = False  # whether near surfaces of the scene see each other, see `near_surfaces`

    def __post_init__(self) -> None:
        """Refuse what cannot be solved or fitted."""
        for entry, broken, remedy in (*self._choices(), *self._numbers()):
            if broken:
                raise InputError("bake settings", entry, getattr(self, entry), "cannot be used", remedy)

    def _choices(self) -> tuple[tuple[str, bool, str], ...]:
        """Entries that are one of a few words: whether they are broken, and the remedy."""
        words = {
            "orientations": LAYOUTS, "interpolation": INTERPOLATIONS, "precision": PRECISIONS, "sky": SKIES,
            "convection": tuple(CORRELATIONS),
        }  # fmt: skip
        return tuple(
            (entry, getattr(self, entry) not in known, f"use one of {', '.join(known)}")
            for entry, known in words.items()
        )

    def _numbers(self) -> tuple[tuple[str, bool, str], ...]:
        """Entries that are numbers: whether they are broken, and the remedy."""
        degrees, days, stride = range(len(self.reflectances)), self.lead_in_days, self.lead_in_stride
        sliced = _is_whole(self.slice_interval, self.step) and _is_whole(SECONDS_PER_DAY, self.slice_interval)
        return (
            ("step", not 0 < self.step <= 3600, "use a step above 0 and up to 3600 s"),
            ("lobes", not self._lobes_fit(), "use 0, or 60 to 21600 s that divide the day"),
            ("cell_size", not 0.05 <= self.cell_size <= 5.0, "use a size from 0.05 to 5"),
            ("reflectances", _unusable(self.reflectances), "give different values between 0 and 1"),
            (
                "degree",
                not (isinstance(self.degree, int) and self.degree in degrees),
                "use a whole number from 0 up to the number of reflectances less one",
            ),
            ("slice_interval", not sliced, "use a multiple of the step that divides the day"),
            ("exchange", not isinstance(self.exchange, bool), "use True or False"),
            ("lead_in_days", days is not None and not 0 <= days <= 365, "use 0 to 365 days, or None"),
            ("lead_in_stride", type(stride) is not int or not 1 <= stride <= 24, "use a whole number from 1 to 24"),
        )

    def _lobes_fit(self) -> bool:
        return self.lobes == 0 or (60.0 <= self.lobes <= 21600.0 and _is_whole(SECONDS_PER_DAY, self.lobes))

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
    "draft": BakeSettings(orientations="report26", interpolation="barycentric", lobes=3600.0, reflectances=THREE,
                          degree=2, step=600.0, cell_size=1.5, slice_interval=1200.0),
    # the choices of 1978: few orientations, the closest three, five reflectances and a quartic, quarters of the sky
    "report": BakeSettings(orientations="report26", interpolation="closest", lobes=0.0, reflectances=FIVE, degree=4,
                           slice_interval=900.0, sky="quadrants"),
    "standard": BakeSettings(),
    "reference": BakeSettings(orientations="icosphere642", interpolation="barycentric", lobes=300.0, reflectances=FIVE,
                              degree=4, step=60.0, lead_in_stride=1),
}  # fmt: skip


def preset(name: str) -> BakeSettings:
    """The named preset."""
    if name not in PRESETS:
        raise InputError("bake settings", "preset", name, "unknown preset", f"use one of {', '.join(PRESETS)}")
    return PRESETS[name]
