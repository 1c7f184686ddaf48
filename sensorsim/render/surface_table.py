"""Surfaces as records of a texture, so that a vertex carries only its place and its surface's row.

The layout stands in shaders/scene/surface_record.glsl.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sensorsim.render.mirror import gloss_records
from sensorsim.tables import OrientationSet
from sensorsim.tables.assign import Assignment
from sensorsim.thermal.view_factors import quadrant_view_factors

SURFACE_TEXELS = 6
SURFACES_PER_ROW = 1024
FloatArray = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SurfaceRows:
    """What the records hold of each surface, in single precision's values."""

    normal: FloatArray  # (s, 3)
    wall_type: NDArray[np.int64]  # (s,)
    corner: NDArray[np.int64]  # (s, 3) standard orientations
    weight: FloatArray  # (s, 3) of them
    emissivity: FloatArray  # (s,)
    reflectance: FloatArray  # (s,) solar
    quarters: FloatArray  # (s, 4) view factors of the N, E, S and W quarter of the sky
    nir_reflectance: FloatArray  # (s,)
    gloss: NDArray[np.int64]  # (s,) kind of gloss or -1
    normal_emissivity: FloatArray  # (s,)
    facet: FloatArray  # (s,) reflectance of a facet along the normal in 0.8-1.1 um


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


def surface_rows(records: NDArray[np.float32], count: int) -> SurfaceRows:
    """Read the records of `count` surfaces."""
    row = records.reshape(-1, SURFACE_TEXELS, 4)[:count].astype(np.float64)
    return SurfaceRows(
        normal=np.ascontiguousarray(row[:, 0, :3]),
        wall_type=row[:, 0, 3].astype(np.int64),
        corner=row[:, 1, :3].astype(np.int64),
        weight=np.ascontiguousarray(row[:, 2, :3]),
        emissivity=row[:, 1, 3].copy(),
        reflectance=row[:, 2, 3].copy(),
        quarters=np.ascontiguousarray(row[:, 3]),
        nir_reflectance=row[:, 4, 0].copy(),
        gloss=row[:, 5, 0].astype(np.int64),
        normal_emissivity=row[:, 5, 1].copy(),
        facet=row[:, 5, 2].copy(),
    )


def set_offsets(records: NDArray[np.float32], offset: NDArray[np.float64]) -> None:
    """Write into the records what surfaces (s,) differ from the tables by at a moment [K]."""
    records.reshape(-1, SURFACE_TEXELS, 4)[: offset.size, 4, 2] = offset


def surface_codes(assignment: Assignment) -> NDArray[np.int64]:
    """Material code (s,) of each surface."""
    return np.array([wall.code for wall in assignment.wall_types], dtype=np.int64)[assignment.wall_type]
