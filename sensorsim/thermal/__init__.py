"""Temperature history: conduction through layers, heat balance of both faces, one march for many columns."""

from sensorsim.thermal.grid import WallGrid, build_grid
from sensorsim.thermal.ground import ground_temperature
from sensorsim.thermal.heat_balance import Exposure, expose, outside_of
from sensorsim.thermal.interior import build_interior
from sensorsim.thermal.boundary import Inside, Outside
from sensorsim.thermal.march import History, march
from sensorsim.thermal.view_factors import ground_view_factor, quadrant_view_factors, sky_view_factor

__all__ = [
    "Exposure",
    "History",
    "Inside",
    "Outside",
    "WallGrid",
    "build_grid",
    "build_interior",
    "expose",
    "ground_temperature",
    "ground_view_factor",
    "march",
    "outside_of",
    "quadrant_view_factors",
    "sky_view_factor",
]
