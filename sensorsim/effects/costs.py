"""What effects cost, roughly: milliseconds of one core by a count of what has to be computed, for the ledger's column.

Measured once on one core of a server of 2024; `sensorsim study effects` measures them on the machine at hand.
"""

PER_COLUMN_SAMPLE = 4e-4  # [ms] one wall type, orientation and reflectance, marched over one step
PER_TERM_SAMPLE = 5e-6  # [ms] one term of the boundary at one orientation and sample
PER_TERM_PIXEL = 2e-6  # [ms] one term of the radiance in one pixel


def march_cost(columns: int, samples: int) -> float:
    """Time [ms] of marching so many histories over so many samples."""
    return PER_COLUMN_SAMPLE * columns * samples


def term_cost(orientations: int, samples: int) -> float:
    """Time [ms] of one term for so many orientations and samples."""
    return PER_TERM_SAMPLE * orientations * samples


def pixel_cost(pixels: int) -> float:
    """Time [ms] of one term of the radiance in so many pixels, drawn in software."""
    return PER_TERM_PIXEL * pixels
