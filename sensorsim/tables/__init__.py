"""Coefficient matrix and lookup tables: histories solved ahead, fitted, and evaluated for any normal, wall and time."""

from sensorsim.tables.bake import bake_tables
from sensorsim.tables.cache import CACHE_VARIABLE, cache_folder, cached_tables
from sensorsim.tables.classes import resolve_classes
from sensorsim.tables.coefficients import Moment, ShadeTables, fit_polynomials
from sensorsim.tables.lobes import Lobes
from sensorsim.tables.lookup_table import LookupTable
from sensorsim.tables.near_surfaces import SurfaceOffsets, near_surface_offsets
from sensorsim.tables.orientations import LAYOUTS, OrientationSet, orientation_set
from sensorsim.tables.settings import PRESETS, BakeSettings, preset
from sensorsim.tables.shade import evaluate_polynomial, surface_temperature

__all__ = [
    "CACHE_VARIABLE",
    "LAYOUTS",
    "PRESETS",
    "BakeSettings",
    "Lobes",
    "LookupTable",
    "Moment",
    "OrientationSet",
    "ShadeTables",
    "SurfaceOffsets",
    "bake_tables",
    "cache_folder",
    "cached_tables",
    "evaluate_polynomial",
    "fit_polynomials",
    "near_surface_offsets",
    "orientation_set",
    "preset",
    "resolve_classes",
    "surface_temperature",
]
