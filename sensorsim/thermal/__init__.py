"""Temperature history: conduction through layers, heat balance of both faces, one march for many columns."""

from sensorsim.thermal.boundary import Inside, Outside
from sensorsim.thermal.convection import CORRELATIONS
from sensorsim.thermal.exchange import Exchange, build_exchange, largest_possible_change, longwave_from_neighbours
from sensorsim.thermal.grid import WallGrid, build_grid
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import SKIES, Exposure, expose, outside_of
from sensorsim.thermal.interior import build_interior, room_air
from sensorsim.thermal.march import History, march
from sensorsim.thermal.paths import march_wall, transmittance, wall_paths
from sensorsim.thermal.polygon_view_factors import (
    Outlines,
    outlines_of_mesh,
    outlines_of_polygons,
    polygon_view_factor,
    view_factor_matrix,
)
from sensorsim.thermal.view_factors import ground_view_factor, quadrant_view_factors, sky_view_factor

__all__ = [
    "CORRELATIONS",
    "SKIES",
    "Exchange",
    "Exposure",
    "History",
    "Inside",
    "Outlines",
    "Outside",
    "WallGrid",
    "build_exchange",
    "build_grid",
    "build_interior",
    "expose",
    "ground_temperature",
    "ground_view_factor",
    "largest_possible_change",
    "longwave_from_neighbours",
    "march",
    "march_wall",
    "outlines_of_mesh",
    "outlines_of_polygons",
    "outside_of",
    "polygon_view_factor",
    "quadrant_view_factors",
    "room_air",
    "sky_view_factor",
    "transmittance",
    "view_factor_matrix",
    "wall_paths",
]
