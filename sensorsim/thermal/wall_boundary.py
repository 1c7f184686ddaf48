"""The boundary series of one wall: what acts on both faces at samples of any spacing, linear between them.

Temperatures, films and irradiances are interpolated each by itself, never a product of two of them.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sensorsim.constants import STEFAN_BOLTZMANN_CONSTANT
from sensorsim.errors import InputError
from sensorsim.thermal.boundary import FloatArray, Inside, Outside
from sensorsim.units import kelvin_from_celsius

TEMPERATURES = (
    "air_temperature",
    "sky_temperature",
    "ground_temperature",
    "interior_air_temperature",
    "interior_radiant_temperature",
)
IRRADIANCES = ("beam", "sky_diffuse", "ground_reflected")
FILMS = ("exterior_film", "interior_film")
# Above it a number is far likelier to be a kelvin taken for a degree Celsius than a wall's surroundings.
WARMEST = kelvin_from_celsius(150.0)  # [K]
BRIGHTEST = 1e5  # [W m-2] seventy suns: what lies above is likelier to be joules an hour
STRONGEST = 1e9  # [W m-2 K-1] film, with which a face is its air's to the last digit


@dataclass(frozen=True, slots=True, kw_only=True)
class WallBoundary:
    """What acts on both faces of a wall, at samples (t,) in ascending order of time."""

    time: FloatArray  # (t,) [s]
    air_temperature: FloatArray  # (t,) [K]
    sky_temperature: FloatArray  # (t,) [K] of a black sky
    ground_temperature: FloatArray  # (t,) [K] of a black ground
    beam: FloatArray  # (t,) incident on the face [W m-2]
    sky_diffuse: FloatArray  # (t,) incident on the face [W m-2]
    ground_reflected: FloatArray  # (t,) incident on the face [W m-2]
    exterior_film: FloatArray  # (t,) of convection alone [W m-2 K-1]
    interior_air_temperature: FloatArray  # (t,) [K]
    interior_radiant_temperature: FloatArray  # (t,) [K] of black surroundings
    interior_film: FloatArray  # (t,) of convection alone [W m-2 K-1]

    @property
    def sunlight(self) -> FloatArray:
        """Solar irradiance of the face (t,) [W m-2]."""
        return self.beam + self.sky_diffuse + self.ground_reflected


@dataclass(frozen=True, slots=True, kw_only=True)
class WallSurface:
    """What both faces of a wall are like."""

    absorptance: float  # solar, exterior [-]
    emissivity: float  # exterior [-]
    interior_emissivity: float  # [-]
    sky_view: float  # share of the exterior half space that is sky; the rest is ground [-]


class Fault(NamedTuple):
    """One value of a series that cannot be honoured."""

    name: str
    row: int
    problem: str
    remedy: str


def build_wall_boundary(
    time: FloatArray,
    *,
    air_temperature: FloatArray | float,
    exterior_film: FloatArray | float,
    interior_air_temperature: FloatArray | float,
    interior_film: FloatArray | float,
    sky_temperature: FloatArray | float | None = None,
    ground_temperature: FloatArray | float | None = None,
    interior_radiant_temperature: FloatArray | float | None = None,
    beam: FloatArray | float = 0.0,
    sky_diffuse: FloatArray | float = 0.0,
    ground_reflected: FloatArray | float = 0.0,
) -> WallBoundary:
    """Boundary series from arrays (t,) and constants, in the units of `WallBoundary`.

    Sky and ground are at air temperature where they are left out, the room's surfaces at that of its air.
    Raises InputError for a wrong shape or a value that cannot be.
    """
    radiant = interior_air_temperature if interior_radiant_temperature is None else interior_radiant_temperature
    given = {
        "time": time,
        "air_temperature": air_temperature,
        "sky_temperature": air_temperature if sky_temperature is None else sky_temperature,
        "ground_temperature": air_temperature if ground_temperature is None else ground_temperature,
        "beam": beam,
        "sky_diffuse": sky_diffuse,
        "ground_reflected": ground_reflected,
        "exterior_film": exterior_film,
        "interior_air_temperature": interior_air_temperature,
        "interior_radiant_temperature": radiant,
        "interior_film": interior_film,
    }
    shape = np.shape(time)
    for name, values in given.items():
        if len(shape) != 1 or np.shape(values) not in ((), shape):
            remedy = "give a number or one value per time"
            raise InputError("boundary", name, np.shape(values), f"shape does not fit times {shape}", remedy)
    boundary = WallBoundary(
        **{key: np.array(np.broadcast_to(values, shape), dtype=np.float64) for key, values in given.items()}
    )
    require_valid(boundary)
    return boundary


def require_valid(boundary: WallBoundary) -> None:
    """Raise InputError at the first value of a boundary that cannot be honoured."""
    series = {field.name: getattr(boundary, field.name) for field in fields(boundary)}
    if boundary.time.size < 2:
        raise InputError("boundary", "time", boundary.time.size, "too few samples", "give two or more")
    fault = find_fault(series)
    if fault is not None:
        value = float(series[fault.name][fault.row])
        raise InputError("boundary", f"{fault.name}[{fault.row}]", value, fault.problem, fault.remedy)


def find_fault(series: Mapping[str, FloatArray]) -> Fault | None:
    """First value in SI units that is not finite or out of its range, or time that does not ascend; else None."""
    for name, values in series.items():
        for wrong, problem, remedy in _rules(name, values):
            if np.any(wrong):
                return Fault(name, int(np.argmax(wrong)), problem, remedy)
    return None


def _rules(name: str, values: FloatArray) -> list[tuple[NDArray[np.bool_], str, str]]:
    """What may be wrong with a series: where, what, and what to do."""
    rules = [(~np.isfinite(values), "not a finite number", "fill the gap or drop the row")]
    if name == "time":
        falls = np.concatenate([[False], np.diff(values) <= 0.0])
        rules.append((falls, "does not come after the row before", "sort the rows and drop repeated times"))
    elif name in TEMPERATURES:
        rules.append((values < -1e-9, "below absolute zero", "check the unit"))
        rules.append(
            (values > WARMEST, "above 150 C", "check that it is in degrees Celsius in a file, kelvin in an array")
        )
    elif name in IRRADIANCES:
        rules.append((values < 0.0, "a negative irradiance", "set the night's instrument offsets to 0"))
        rules.append((values > BRIGHTEST, f"above {BRIGHTEST:g} W m-2", "check that it is not joules or a sum"))
    elif name in FILMS:
        rules.append((values < 0.0, "a negative film coefficient", "give 0 or more"))
        rules.append((values > STRONGEST, f"above {STRONGEST:g} W m-2 K-1", "give less: the face has its air's anyway"))
    return rules


def conditions(
    boundary: WallBoundary, surface: WallSurface, row: NDArray[np.int64], share: FloatArray
) -> tuple[Outside, Inside]:
    """Conditions on both faces at shares [-] of the way from samples `row` to the next ones."""
    later = np.minimum(row + 1, boundary.time.size - 1)

    def at(values: FloatArray) -> FloatArray:
        return np.asarray(values[row] + share * (values[later] - values[row]))

    air, sky, ground = at(boundary.air_temperature), at(boundary.sky_temperature), at(boundary.ground_temperature)
    view = surface.sky_view
    longwave = STEFAN_BOLTZMANN_CONSTANT * (view * sky**4 + (1.0 - view) * ground**4)
    outside = Outside(
        irradiance=at(boundary.sunlight)[:, None],
        longwave=longwave[:, None],
        film=at(boundary.exterior_film)[:, None],
        free=np.zeros(1),
        air=air,
        emissivity=surface.emissivity,
        vapour=np.zeros_like(air),
        free_colder=np.zeros(1),
    )
    inside = Inside(
        air=at(boundary.interior_air_temperature),
        radiant=at(boundary.interior_radiant_temperature),
        film=at(boundary.interior_film),
        free=0.0,
        emissivity=surface.interior_emissivity,
    )
    return outside, inside
