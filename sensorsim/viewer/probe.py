"""What a pixel shows: the surface, what it is made of, its temperature now and through the day."""

from dataclasses import dataclass

import numpy as np

from sensorsim.constants import SECONDS_PER_DAY
from sensorsim.radiometry import FloatArray
from sensorsim.render import Picture, World
from sensorsim.tables import surface_temperature

_TOLD = ("display", "radiance", "surface_temperature", "range", "surface_id", "feature", "apparent_temperature")


@dataclass(frozen=True, slots=True, kw_only=True)
class Probe:
    """One pixel; what describes a surface is None where it sees the sky."""

    column: int
    row: int
    radiance: float  # in band, at the sensor [W m-2 sr-1]
    apparent_temperature: float | None  # [K], in emissive bands
    surface: int | None  # row of the scene's surfaces
    feature: str  # number and description
    role: str  # roof, wall, bottom or plane
    wall_type: str
    interior: str  # condition behind the surface, empty where there is no room
    word: str  # four-digit material word of the scene, may be empty
    reflectance: float | None  # solar [-]
    emissivity: float | None  # 8-14 um [-]
    temperature: float | None  # of the surface [K]
    range: float | None  # [m]
    more: tuple[tuple[str, float], ...]  # other planes of the picture


def probe_pixel(world: World, picture: Picture, column: int, row: int) -> Probe | None:
    """What the pixel at column and row from the upper left corner sees; None outside of the picture."""
    planes = picture.planes
    height, width = planes["radiance"].shape
    if not (0 <= column < width and 0 <= row < height):
        return None
    surface = int(planes["surface_id"][row, column])
    apparent = planes.get("apparent_temperature")
    more = tuple((name, float(plane[row, column])) for name, plane in planes.items() if name not in _TOLD)
    seen = surface >= 0
    scene, assignment = world.scene, world.assignment
    feature = scene.features[int(scene.surfaces.feature[surface])] if seen else None
    wall = assignment.wall_types[int(assignment.wall_type[surface])] if seen else None
    return Probe(
        column=column,
        row=row,
        radiance=float(planes["radiance"][row, column]),
        apparent_temperature=None if apparent is None else float(apparent[row, column]),
        surface=surface if seen else None,
        feature="sky" if feature is None else f"{feature.number} {feature.description}".strip(),
        role=str(scene.surfaces.role[surface]) if seen else "",
        wall_type="" if wall is None else wall.name,
        interior="" if wall is None or wall.interior == "none" else wall.interior,
        word=str(scene.surfaces.word[surface]) if seen else "",
        reflectance=float(assignment.reflectance[surface]) if seen else None,
        emissivity=float(assignment.emissivity[surface]) if seen else None,
        temperature=float(planes["surface_temperature"][row, column]) if seen else None,
        range=float(planes["range"][row, column]) if seen else None,
        more=more,
    )


def day_of_surface(world: World, surface: int, count: int = 49) -> tuple[FloatArray, FloatArray]:
    """Times [s] of the image day, midnight to midnight, and temperatures [K] (count,) of a surface, from the tables."""
    time = np.linspace(0.0, SECONDS_PER_DAY, count)
    normal = world.scene.surfaces.normal[surface : surface + 1]
    wall = world.assignment.wall_type[surface : surface + 1]
    reflectance = world.assignment.reflectance[surface : surface + 1]
    kelvin = [surface_temperature(world.tables, normal, wall, reflectance, float(moment))[0] for moment in time]
    return time, np.array(kelvin, dtype=np.float64)


def histogram(picture: Picture, bins: int = 96) -> tuple[FloatArray, float, float, str]:
    """Share of the pixels per bin, the two ends of the axis and its unit.

    Over apparent temperature [K] in emissive bands, else over band radiance, from the 0.1 to the 99.9 percentile.
    """
    planes = picture.planes
    emissive = "apparent_temperature" in planes
    values = planes["apparent_temperature" if emissive else "radiance"].ravel()[::7]
    low, high = (float(value) for value in np.quantile(values, (0.001, 0.999)))
    if not high > low:
        low, high = low - 0.5, low + 0.5
    count, _ = np.histogram(values, bins=bins, range=(low, high))
    return np.asarray(count / max(values.size, 1), dtype=np.float64), low, high, "K" if emissive else "W m-2 sr-1"
