"""What a bake may spend: the knobs of accuracy against time, with named presets.

What the default was chosen from: all 60 materials of the catalogue, 16 random normals of each, 8 reflectances of 0 to
1, every 12 minutes of the day, against the full solve of those very surfaces in steps of a minute; 99th percentile /
maximum of the error [K] without snow, and columns solved for each wall type. Without wind: a clear summer day in
perfectly still air, faces to 90 C.

                                              winter       fall         without wind  columns
octahedron66, 3 reflectances, quadratic       0.08 / 0.37  0.06 / 0.26  0.18 / 0.97   198
icosphere42, 3 reflectances, quadratic        0.09 / 0.39  0.07 / 0.38  0.19 / 0.97   126
icosphere42, 4 reflectances, knot: default    0.07 / 0.30  0.05 / 0.38  0.13 / 0.61   168
octahedron66, 4 reflectances, knot            0.06 / 0.34  0.05 / 0.26  0.12 / 0.59   264
the default, plain cubic, bent by radiation   0.10 / 0.39  0.07 / 0.39  0.22 / 0.84   168

The default has 0.02 / 0.13 in summer. The last line is what a quadratic bend of the temperature (see `straighten` for
what took its place), a cubic without a knot and a gain of the lobes told from each slice alone gave. The largest errors
in fall are those of leaves that open by each face's own light; by the light from above the default has 0.28. Snow: 0.02
where it thaws all day, 0.3 / 0.6 where it freezes at night. Without wind 0.1 is not had with 66 orientations and 7
reflectances either (0.11 / 0.59 on half of the materials): what is left lies along the edge of the last hours' sun,
which had shone on faces of other films.

`sensorsim study accuracy --catalogue --still` measures other surfaces, one reflectance for each wall type.
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
    reflectances: tuple[float, ...] = (0.05, 0.45, 0.8, 0.95)  # solar reflectances that are solved
    degree: int = 3  # of the polynomial in reflectance
    knot: float = 0.6  # reflectance at which its last power begins, from the third degree on
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
            ("knot", not 0.0 <= self.knot < self._most_knot(), "use 0 up to the largest reflectance"),
            ("slice_interval", not sliced, "use a multiple of the step that divides the day"),
            ("exchange", not isinstance(self.exchange, bool), "use True or False"),
            ("lead_in_days", days is not None and not 0 <= days <= 365, "use 0 to 365 days, or None"),
            ("lead_in_stride", type(stride) is not int or not 1 <= stride <= 24, "use a whole number from 1 to 24"),
        )

    def _most_knot(self) -> float:
        """Where the last power would begin beyond what is solved, if it has a knot at all."""
        return max(self.reflectances, default=1.0) if self.degree > 2 else 1.0

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
                           knot=0.0, slice_interval=900.0, sky="quadrants"),
    "standard": BakeSettings(),
    "reference": BakeSettings(orientations="icosphere642", interpolation="barycentric", lobes=300.0, reflectances=FIVE,
                              degree=4, knot=0.0, step=60.0, lead_in_stride=1),
}  # fmt: skip


def preset(name: str) -> BakeSettings:
    """The named preset."""
    if name not in PRESETS:
        raise InputError("bake settings", "preset", name, "unknown preset", f"use one of {', '.join(PRESETS)}")
    return PRESETS[name]
