"""Moving things among the surfaces: triangles with a temperature each, placed anew for every frame."""

from dataclasses import dataclass, fields

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.render.passes import Pass

_FORMAT = "3f 3f 4f 3f 1i"
_NAMES = ("position", "normal", "sky_quarters", "nature", "surface")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Solids:
    """Triangles (t, 3, 3) [m] east, north, up, counter-clockwise seen from outside, and what each is like.

    normal (t, 3) of unit length; quarters (t, 4): view factors of the N, E, S, W quarter of the sky; temperature (t,)
    [K]; emissivity and reflectance in the low-light band (t,); number (t,): of the thing, from 0.
    """

    triangles: NDArray[np.float64]
    normal: NDArray[np.float64]
    quarters: NDArray[np.float64]
    temperature: NDArray[np.float64]
    emissivity: NDArray[np.float64]
    reflectance: NDArray[np.float64]
    number: NDArray[np.int64]

    def __post_init__(self) -> None:
        """Refuse what differs in length or is not finite."""
        for field in fields(self):
            values = getattr(self, field.name)
            if len(values) != len(self.triangles) or not np.isfinite(values).all():
                raise InputError("solids", field.name, values.shape, "not finite, or not one a triangle", "give all")

    def vertices(self, first: int) -> bytes:
        """Rows of the vertex buffer; ids of surfaces go on from `first`."""
        record = np.zeros((len(self.triangles), 3), dtype=_ROW)
        record["position"] = self.triangles
        record["normal"] = self.normal[:, None]
        record["sky_quarters"] = self.quarters[:, None]
        record["nature"] = np.stack([self.temperature, self.emissivity, self.reflectance], axis=1)[:, None]
        record["surface"] = (first + self.number)[:, None]
        return record.tobytes()


_ROW = np.dtype(
    [("position", "<f4", 3), ("normal", "<f4", 3), ("sky_quarters", "<f4", 4), ("nature", "<f4", 3), ("surface", "<i4")]
)


class SolidPass:
    """The program of solids and a buffer that grows with what there is to draw."""

    def __init__(self, ctx: moderngl.Context, program: moderngl.Program) -> None:
        self._ctx, self._program = ctx, program
        self._buffer: moderngl.Buffer | None = None
        self._array: moderngl.VertexArray | None = None

    def draw(self, solids: Solids, first: int) -> None:
        """Draws into the target in use, which has a depth."""
        data = solids.vertices(first)
        if not data:
            return
        if self._buffer is None or self._array is None or self._buffer.size < len(data):
            self.release()
            self._buffer = self._ctx.buffer(reserve=2 * len(data))
            names = [name for name in _NAMES if name in self._program]
            layout = " ".join(
                part if name in names else f"{part[0]}x{4}"
                for name, part in zip(_NAMES, _FORMAT.split(), strict=True)
            )
            self._array = self._ctx.vertex_array(self._program, [(self._buffer, layout, *names)])
        self._buffer.write(data)
        self._array.render(vertices=3 * len(solids.triangles))

    def release(self) -> None:
        """Gives back the buffer and its vertex array."""
        for held in (self._array, self._buffer):
            if held is not None:
                held.release()
        self._array = self._buffer = None


def solid_program(made: Pass) -> moderngl.Program:
    """The program of a pass."""
    return made.program
