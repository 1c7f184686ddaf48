"""Outlines of the hospital scene in local metres, reconstructed from section II and IV of [Report1978].

Outlines are laid out in strip coordinates: u along the railroad towards its north-east end (azimuth 52 degrees), v
across it to the right (azimuth 142 degrees), both from the middle of the strip. The hospital and the heating plant
are laid out in east and north about their own middle, because their walls face south and west.

Seen from the tower at the south-west end, houses stand in front, the hospital in the middle distance left of the
middle, the heating plant right of it, the cement plant behind, the overpass to the right of the plant.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from shapely import union_all
from shapely.geometry import Polygon

FloatArray = NDArray[np.float64]

RAILROAD_AZIMUTH = 52.0  # [deg], estimate
MILE, FOOT = 1609.344, 0.3048  # [m]
HALF_LENGTH, HALF_WIDTH = 1.25 * MILE, 0.375 * MILE

# Heights of the plane layers above the base plane [m].
SOIL, LAWN, TRACK = 0.15, 0.30, 0.45


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """One outline in local east and north [m]; heights in feet where they differ from the sheet's column D."""

    outline: FloatArray
    base_ft: float | None = None
    top_ft: float | None = None
    layer: float | None = None  # of a plane [m]
    has_bottom: bool = True
    note: str = ""


def local(u: float, v: float) -> tuple[float, float]:
    """East and north [m] of strip coordinates."""
    azimuth = math.radians(RAILROAD_AZIMUTH)
    along, across = (math.sin(azimuth), math.cos(azimuth)), (math.cos(azimuth), -math.sin(azimuth))
    return u * along[0] + v * across[0], u * along[1] + v * across[1]


def strip(*corners: tuple[float, float]) -> FloatArray:
    """Outline given in strip coordinates."""
    return np.array([local(u, v) for u, v in corners])


def cut_corners(corners: list[tuple[float, float]], cuts: int, size: float) -> list[tuple[float, float]]:
    """The outline with its first corners cut off at the given distance along both sides."""
    result: list[tuple[float, float]] = []
    for index, corner in enumerate(corners):
        if index >= cuts:
            result.append(corner)
            continue
        here = np.array(corner)
        for neighbour in (corners[index - 1], corners[(index + 1) % len(corners)]):
            along = np.array(neighbour) - here
            result.append(tuple(here + along / np.hypot(*along) * size))
    return result


def block(u0: float, u1: float, v0: float, v1: float, cuts: int = 0, size: float = 10.0) -> FloatArray:
    """Rectangle along the strip with some corners cut, as street corners are: 4 + cuts sides."""
    return strip(*cut_corners([(u0, v0), (u1, v0), (u1, v1), (u0, v1)], cuts, size))


def notched(u0: float, u1: float, v0: float, v1: float, nu: float, nv: float, cuts: int = 0) -> FloatArray:
    """Rectangle along the strip without its far right corner: 6 + cuts sides."""
    corners = [(u0, v0), (u1, v0), (u1, v1 - nv), (u1 - nu, v1 - nv), (u1 - nu, v1), (u0, v1)]
    order = corners[-1:] + corners[:-1]  # the inner corner is cut last of all
    return strip(*cut_corners(order, cuts, 10.0))


def grove(u: float, v: float, half_u: float, half_v: float, sides: int, seed: int) -> FloatArray:
    """Uneven rounded outline of a wood, inside the given half axes."""
    turn = np.arange(sides) * (2.0 * np.pi / sides)
    radius = 0.92 + 0.08 * np.sin(3.0 * turn + seed)
    return strip(*zip(u + half_u * radius * np.cos(turn), v + half_v * radius * np.sin(turn), strict=True))


def disc(u: float, v: float, diameter: float, sides: int) -> FloatArray:
    """Regular polygon whose corners lie on a circle, one side facing the south-west end of the strip."""
    turn = (np.arange(sides) + 0.5) * (2.0 * np.pi / sides)
    return strip(*zip(u + diameter / 2 * np.cos(turn), v + diameter / 2 * np.sin(turn), strict=True))


def square(u: float, v: float, *corners: tuple[float, float]) -> FloatArray:
    """Outline in east and north about a point of the strip: its walls face the four quarters."""
    return np.array(corners, dtype=float) + np.array(local(u, v))


HOSPITAL_AT = (-930.0, -135.0)
TOWER_96 = ((-10, 10), (50, 10), (50, 28), (-10, 28))
WING_64 = ((-28, -30), (-10, -30), (-10, 28), (-28, 28))
BLOCK_32 = ((-10, -30), (40, -30), (40, 10), (-10, 10))
APRON_25 = ((-58, -50), (25, -50), (25, -30), (-28, -30), (-28, 12), (-58, 12))
UPPER_L = ((-28, -30), (-10, -30), (-10, 10), (50, 10), (50, 28), (-28, 28))
LOWER = ((-58, -50), (25, -50), (25, -30), (40, -30), (40, 10), (50, 10), (50, 28), (-28, 28), (-28, 12), (-58, 12))
COVER_DIAMETER = math.dist((-58, -50), (50, 28))  # of the convex cover [m]: 437 ft
COVER_MIDDLE = (-4.0, -11.0)

HEATING_PLANT = square(-430.0, 70.0, (-20, -16), (22, -16), (22, 6), (8, 6), (8, 16), (-20, 16))
OFFICERS = strip((-1195, 32), (-1115, 32), (-1115, 68), (-1129, 68), (-1129, 46), (-1181, 46), (-1181, 68), (-1195, 68))
OVERPASS = block(1330 - 30 * FOOT, 1330 + 30 * FOOT, 330 - 210 * FOOT, 330 + 210 * FOOT)
OVERPASS_NOTE = "deck 35 ft high and 15 ft thick (estimate), hanging free because its embankments are not modelled"
WOOD_WEST = (-1610.0, -390.0, 290.0, 165.0)
WOOD_NORTH = (-515.0, -345.0, 155.0, 210.0)
WOOD_EAST = (1090.0, -430.0, 190.0, 120.0)


def housing_groups() -> list[FloatArray]:
    """Features 1-22 and 25-39: rows of duplexes joined into groups along streets parallel to the railroad."""
    near = [(-1860.0 + 80.0 * k, v) for k in range(6) for v in (-128.0, -92.0, -8.0, 28.0)][1:-1]
    far = [(-1070.0 + 80.0 * k, v) for k in range(4) for v in (-15.0, 21.0, 75.0, 111.0)][:-1]
    return [block(u, u + 60.0, v - 5.5, v + 5.5) for u, v in near + far]


def silos() -> FloatArray:
    """Outline of five round silos in a row that touch along a side: 52 sides."""
    pitch = 22.0 * math.cos(math.pi / 12)
    drums = [Polygon(disc(1500.0, -10.0 + pitch * (k - 2), 22.0, 12).round(6)) for k in range(5)]
    ring = union_all(drums, grid_size=1e-6).exterior
    return np.array(ring.coords)[:-1]


def residential_blocks() -> list[FloatArray]:
    """Features 63-75 between open streets: nine of eight sides, four of ten."""
    columns = [(-318.0, 40.0), (64.0, 400.0), (424.0, 760.0), (784.0, 1080.0)]
    left = [block(*column, -270.0, -72.0, 4) for column in columns]
    middle = [notched(*column, -50.0, 150.0, 60.0, 70.0, 4) for column in columns]
    right = [block(*column, 185.0, 300.0, 4) for column in columns[1:]]
    beyond = [block(*column, 365.0, 560.0, 4) for column in columns[1:3]]
    return left + middle + right + beyond
