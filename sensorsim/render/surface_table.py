"""Surfaces as records of a texture, so that a vertex carries only its place and its surface's row.

The layout stands in shaders/scene/surface_record.glsl.
"""

import numpy as np
from numpy.typing import NDArray

from sensorsim.render.mirror import gloss_records
from sensorsim.tables import OrientationSet
from sensorsim.tables.assign import Assignment
from sensorsim.thermal.view_factors import quadrant_view_factors

SURFACE_TEXELS = 6
SURFACES_PER_ROW = 1024


def surface_table(
    normal: NDArray[np.float64],
    feature: NDArray[np.int32],
    assignment: Assignment,
    orientations: OrientationSet,
) -> NDArray[np.float32]:
    """Records (rows, SURFACES_PER_ROW * SURFACE_TEXELS, 4) of surfaces with normals (s, 3)."""
    corner, weight = orientations.locate(normal)
    count = normal.shape[0]
    record = np.zeros((count, SURFACE_TEXELS, 4))
    record[:, 0] = np.column_stack([normal, assignment.wall_type])
    record[:, 1] = np.column_stack([corner, assignment.emissivity])
    record[:, 2] = np.column_stack([weight, assignment.reflectance])
    record[:, 3] = quadrant_view_factors(normal)
    record[:, 4, 0] = assignment.nir_reflectance
    record[:, 4, 1] = feature
    record[:, 5] = gloss_records(surface_codes(assignment), assignment.emissivity, assignment.nir_reflectance)
    rows = -(-count // SURFACES_PER_ROW)
    columns = SURFACES_PER_ROW if rows > 1 else count
    padded = np.zeros((rows * columns, SURFACE_TEXELS, 4), dtype=np.float32)
    padded[:count] = record
    return padded.reshape(rows, columns * SURFACE_TEXELS, 4)


def set_offsets(records: NDArray[np.float32], offset: NDArray[np.float64]) -> None:
    """Write into the records what surfaces (s,) differ from the tables by at a moment [K]."""
    records.reshape(-1, SURFACE_TEXELS, 4)[: offset.size, 4, 2] = offset


def surface_codes(assignment: Assignment) -> NDArray[np.int64]:
    """Material code (s,) of each surface."""
    return np.array([wall.code for wall in assignment.wall_types], dtype=np.int64)[assignment.wall_type]
