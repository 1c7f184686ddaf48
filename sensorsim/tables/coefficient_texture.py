"""The tables of one moment as textures, and the GLSL that reads them."""

import numpy as np
from numpy.typing import NDArray

from sensorsim.tables.coefficients import UNKNOTTED, Moment, ShadeTables
from sensorsim.tables.orientations import FloatArray

POWERS_PER_TEXEL = 4
HEAD = 3  # texels of a wall type before its lobes


def coefficient_texels(coefficients: FloatArray) -> NDArray[np.float32]:
    """Texels (w, o * groups, 4) of coefficients (w, o, p), lowest powers first, missing ones zero."""
    walls, orientations, powers = coefficients.shape
    groups = -(-powers // POWERS_PER_TEXEL)
    padded = np.zeros((walls, orientations, groups * POWERS_PER_TEXEL), dtype=np.float32)
    padded[:, :, :powers] = coefficients
    return padded.reshape(walls, orientations * groups, POWERS_PER_TEXEL)


def coefficient_glsl(powers: int, knot: float = 0.0) -> str:
    """Sampler of the coefficient matrix, the lookup of one group of four powers, and where the last power begins."""
    groups = -(-powers // POWERS_PER_TEXEL)
    knotted = powers - 1 if powers > UNKNOTTED else -1
    return (
        f"const int KNOTTED = {knotted};  // power that begins at the knot, -1 for none\n"
        f"const float KNOT = {knot!r};\n"
        f"const int COEFFICIENT_GROUPS = {groups};\n"
        "uniform sampler2D coefficient_table;  // row: wall type; column: orientation, group; [K]\n"
        "vec4 coefficient_group(int wall_type, int orientation, int group) {\n"
        "    return texelFetch(coefficient_table, ivec2(orientation * COEFFICIENT_GROUPS + group, wall_type), 0);\n"
        "}\n"
    )


def shade_texels(tables: ShadeTables, time_of_day: float, *, most: int | None = None) -> dict[str, NDArray[np.float32]]:
    """Texels of all that the shade of a time [s] is made from, by the name of the sampler.

    most: lobes that the texture has room for; counted over the day where it is left out, which takes a while.
    """
    moment = tables.at(time_of_day)
    room = 0 if tables.lobes is None else (tables.lobes.most if most is None else most)
    return {"coefficient_table": coefficient_texels(moment.coefficients), "lobe_table": lobe_texels(moment, room)}


def lobe_texels(moment: Moment, most: int) -> NDArray[np.float32]:
    """Texels (1 + w, HEAD + most, 4) of losses and of `most` lobes or fewer; layout in shaders/radiance/lobes.glsl."""
    walls, count = moment.weight.shape[:2]
    texels = np.zeros((1 + walls, HEAD + most, 4), dtype=np.float32)
    texels[0, 0, 0], texels[0, 0, 1:3] = count, moment.towards
    texels[0, HEAD : HEAD + count, :3] = moment.direction
    texels[1:, 0] = np.column_stack([moment.level, moment.loss[:, [0, 1, 4]]])
    texels[1:, 1] = np.column_stack([moment.loss[:, 2:4], moment.gain[:, [0, 4]]])
    texels[1:, 2, :3] = moment.gain[:, 1:4]
    texels[1:, HEAD : HEAD + count, :2] = moment.weight
    return texels
