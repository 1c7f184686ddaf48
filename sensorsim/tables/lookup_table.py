"""A function of one variable as a table: the values, the mapping to texels, and the GLSL that looks it up.

The shader interpolates between two exact texels itself: a texture unit's own filter has too few bits for kelvin.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LookupTable:
    """Values at equal spacing from `minimum` to `maximum`, both included; beyond them the end value holds."""

    name: str  # of the GLSL function; its sampler is `<name>_table`
    quantity: str  # GLSL alias of the result, from common/quantities.glsl
    argument: str  # GLSL alias of the argument
    minimum: float
    maximum: float
    values: NDArray[np.float64]  # (n,)

    def evaluate(self, argument: NDArray[np.float64]) -> NDArray[np.float64]:
        """The NumPy twin of the lookup, in float64."""
        grid = np.linspace(self.minimum, self.maximum, self.values.size)
        return np.asarray(np.interp(argument, grid, self.values))

    @property
    def texels(self) -> NDArray[np.float32]:
        """Values as one row of a texture (1, n, 1)."""
        return self.values.astype(np.float32).reshape(1, -1, 1)

    def glsl(self) -> str:
        """Sampler and lookup function."""
        count = self.values.size
        scale = (count - 1) / (self.maximum - self.minimum)
        return (
            f"uniform sampler2D {self.name}_table;\n"
            f"{self.quantity} {self.name}({self.argument} argument) {{\n"
            f"    float position = clamp((argument - {self.minimum!r}) * {scale!r}, 0.0, {float(count - 1)!r});\n"
            f"    int index = min(int(position), {count - 2});\n"
            f"    float low = texelFetch({self.name}_table, ivec2(index, 0), 0).r;\n"
            f"    float high = texelFetch({self.name}_table, ivec2(index + 1, 0), 0).r;\n"
            f"    return mix(low, high, position - float(index));\n"
            f"}}\n"
        )
