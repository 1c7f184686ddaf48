"""GLSL text made from Python values, for `#include "generated/..."`: nothing is typed twice."""

import numpy as np

from sensorsim import constants
from sensorsim.errors import GraphicsError


def constants_glsl() -> str:
    """Every number of `sensorsim.constants` as a GLSL constant in the same SI unit, for `generated/constants.glsl`.

    Raises GraphicsError for a constant that single precision cannot hold as a normal number.
    """
    numbers = {name: value for name, value in vars(constants).items() if name.isupper()}
    return "".join(f"const float {name} = {float_literal(name, value)};\n" for name, value in numbers.items())


def float_literal(name: str, value: float) -> str:
    """A number as a GLSL float literal, shortest text that is exact in double precision.

    Raises GraphicsError, with `name`, when single precision would turn it into infinity, a subnormal number or zero.
    """
    limits = np.finfo(np.float32)
    if value != 0.0 and not limits.smallest_normal <= abs(value) <= limits.max:
        raise GraphicsError(f"{name} = {value!r} lies outside the normal numbers of single precision")
    return repr(float(value))
