"""What effects cost, roughly: processor time by a count of what has to be computed, for the ledger's column.

Measured once on two cores of a server of 2024, each with and without in turn: bakes of the hospital at the default,
whole frames of 640 by 480 pixels drawn in software. A light or a sky acts on the orientations, once for all walls; a
film of air or water on each wall's own. `sensorsim study effects` measures all of it on the machine at hand.
"""

from collections.abc import Mapping

PER_COLUMN_SAMPLE = 1e-4  # [ms] one wall type, orientation and reflectance, marched over one step
PER_TERM_SAMPLE = 5e-6  # [ms] one term of the boundary at one orientation and sample
OF_WALLS = frozenset({"forced_convection", "free_convection", "evaporation", "rain", "interior"})
# [ms] one pixel: of the picture itself, then of the detector's chain. Others, as the sun's light on surfaces, cost
# a factor of zero.
PER_PIXEL: Mapping[str, float] = {
    "reflected_sky": 5e-5, "specular": 1e-5, "atmosphere": 5e-5,
    "blur": 4e-4, "noise": 2e-5, "memory": 3e-5, "streaks": 4e-5, "halo": 4e-5, "blooming": 4e-5, "interlace": 4e-5,
    "replacement": 4e-5, "raster_lines": 4e-5,
}  # fmt: skip


def march_cost(columns: int, samples: int) -> float:
    """Time [ms] of marching so many histories over so many samples."""
    return PER_COLUMN_SAMPLE * columns * samples


def term_cost(effect: str, shared: int, orientations: int, samples: int) -> float:
    """Time [ms] of a term for so many samples: at the orientations that walls share, or at those of all walls."""
    return PER_TERM_SAMPLE * (orientations if effect in OF_WALLS else shared) * samples


def pixel_cost(effect: str, pixels: int) -> float:
    """Time [ms] of an effect in so many pixels."""
    return PER_PIXEL.get(effect, 0.0) * pixels
