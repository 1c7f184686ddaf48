"""Temperature history: conduction through layers, heat balance of both faces, one march for many columns."""

from sensorsim.thermal.boundary import Inside, Outside
from sensorsim.thermal.boundary_file import BoundaryFile, read_boundary
from sensorsim.thermal.construction_march import march_construction
from sensorsim.thermal.convection import CORRELATIONS
from sensorsim.thermal.exchange import Exchange, build_exchange
from sensorsim.thermal.grid import WallGrid, build_grid
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import SKIES, Exposure, expose, outside_of
from sensorsim.thermal.history_file import history_csv, write_whole
from sensorsim.thermal.interior import build_interior, room_air
from sensorsim.thermal.march import History, march
from sensorsim.thermal.natural import surface_boundary
from sensorsim.thermal.neighbour_radiation import (
    change_by_neighbours,
    largest_possible_change,
    longwave_from_neighbours,
)
from sensorsim.thermal.paths import march_paths, transmittance, wall_paths
from sensorsim.thermal.polygon_view_factors import (
    Outlines,
    outlines_of_mesh,
    outlines_of_polygons,
    polygon_view_factor,
    view_factor_matrix,
)
from sensorsim.thermal.season import Season, growing_season_index, season_of
from sensorsim.thermal.view_factors import ground_view_factor, quadrant_view_factors, sky_view_factor
from sensorsim.thermal.wall import LONGEST_STEP, WallHistory, WallLoads, exterior_loads, march_wall
from sensorsim.thermal.wall_boundary import WallBoundary, WallSurface, build_wall_boundary
from sensorsim.thermal.wall_start import WallStart

__all__ = [
    "CORRELATIONS",
    "LONGEST_STEP",
    "SKIES",
    "BoundaryFile",
    "Exchange",
    "Exposure",
    "History",
    "Inside",
    "Outlines",
    "Outside",
    "Season",
    "WallBoundary",
    "WallGrid",
    "WallHistory",
    "WallLoads",
    "WallStart",
    "WallSurface",
    "build_exchange",
    "build_grid",
    "build_interior",
    "build_wall_boundary",
    "change_by_neighbours",
    "expose",
    "exterior_loads",
    "ground_temperature",
    "ground_view_factor",
    "growing_season_index",
    "history_csv",
    "largest_possible_change",
    "longwave_from_neighbours",
    "march",
    "march_construction",
    "march_paths",
    "march_wall",
    "outlines_of_mesh",
    "outlines_of_polygons",
    "outside_of",
    "polygon_view_factor",
    "quadrant_view_factors",
    "read_boundary",
    "room_air",
    "season_of",
    "sky_view_factor",
    "surface_boundary",
    "transmittance",
    "view_factor_matrix",
    "wall_paths",
    "write_whole",
]
