"""The coefficient matrix of one moment as a texture, and the GLSL that reads it."""

import numpy as np
from numpy.typing import NDArray

from sensorsim.tables.orientations import FloatArray

POWERS_PER_TEXEL = 4


def coefficient_texels(coefficients: FloatArray) -> NDArray[np.float32]:
    """Texels (w, o * groups, 4) of coefficients (w, o, p), lowest powers first, missing ones zero."""
    walls, orientations, powers = coefficients.shape
    groups = -(-powers // POWERS_PER_TEXEL)
    padded = np.zeros((walls, orientations, groups * POWERS_PER_TEXEL), dtype=np.float32)
    padded[:, :, :powers] = coefficients
    return padded.reshape(walls, orientations * groups, POWERS_PER_TEXEL)


def coefficient_glsl(powers: int) -> str:
    """Sampler of the coefficient matrix and the lookup of one group of four powers."""
    groups = -(-powers // POWERS_PER_TEXEL)
    return (
        f"const int COEFFICIENT_GROUPS = {groups};\n"
        "uniform sampler2D coefficient_table;  // row: wall type; column: orientation, group; [K]\n"
        "vec4 coefficient_group(int wall_type, int orientation, int group) {\n"
        "    return texelFetch(coefficient_table, ivec2(orientation * COEFFICIENT_GROUPS + group, wall_type), 0);\n"
        "}\n"
    )
