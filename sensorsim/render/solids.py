"""Moving things among the surfaces: triangles with a temperature each, placed anew for every frame."""

from dataclasses import dataclass, fields
from typing import Any

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.errors import InputError
from sensorsim.gpu import build_program
from sensorsim.render.blocks import AIR, VIEW_FRAME

# Of a vertex: name in the shader, components, type
_ATTRIBUTES = (
    ("position", 3, "f"),
    ("nature", 2, "f"),
    ("surface", 1, "i"),
)
_ROW = np.dtype([(name, f"<{kind}4", (count,)) for name, count, kind in _ATTRIBUTES])


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
            if len(values) != len(self.triangles) or len(values) == 0 or not np.isfinite(values).all():
                raise InputError("solids", field.name, values.shape, "not finite, or not one a triangle", "give all")

    def box(self, lowest: NDArray[Any], highest: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        """A box (3,), (3,) [m] widened by the solids."""
        corners = self.triangles.reshape(-1, 3)
        return np.minimum(lowest, corners.min(axis=0)), np.maximum(highest, corners.max(axis=0))

    def vertices(self, first: int, sent: NDArray[np.floating[Any]]) -> bytes:
        """Rows of the vertex buffer with the radiance (t,) [W m-2 sr-1] sent; ids of surfaces go on from `first`."""
        record = np.zeros((len(self.triangles), 3), dtype=_ROW)
        record["position"] = self.triangles
        record["nature"] = np.stack([sent, self.temperature], axis=1)[:, None]
        record["surface"] = (first + self.number)[:, None, None]
        return record.tobytes()


class SolidPass:
    """Draws the solids of a frame, `solids`: a program, made when there are any, and a buffer that grows."""

    def __init__(self, ctx: moderngl.Context, first: int) -> None:
        """first: the id that follows on those of the scene's surfaces."""
        self.solids: Solids | None = None
        self._ctx, self._first = ctx, first
        self._program: moderngl.Program | None = None
        self._buffer: moderngl.Buffer | None = None
        self._array: moderngl.VertexArray | None = None

    def box(self, lowest: NDArray[Any], highest: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        """A box (3,), (3,) [m] widened by the solids."""
        return (lowest, highest) if self.solids is None else self.solids.box(lowest, highest)

    def draw(self, sent: NDArray[np.floating[Any]]) -> None:
        """Draws solids that send so much (t,) [W m-2 sr-1] into the target in use, which has a depth."""
        if self.solids is None:
            return
        data = self.solids.vertices(self._first, sent)
        if self._buffer is None or self._array is None or self._buffer.size < len(data):
            for held in (self._array, self._buffer):
                if held is not None:
                    held.release()
            self._program = self._program or self._build()
            read = [name for name, _, _ in _ATTRIBUTES if name in self._program]
            layout = " ".join(f"{count}{kind if name in read else 'x4'}" for name, count, kind in _ATTRIBUTES)
            self._buffer = self._ctx.buffer(reserve=2 * len(data))
            self._array = self._ctx.vertex_array(self._program, [(self._buffer, layout, *read)])
        self._buffer.write(data)
        self._array.render(vertices=3 * len(self.solids.triangles))

    def _build(self) -> moderngl.Program:
        return build_program(
            self._ctx, vertex="scene/solid.vert", fragment="scene/solid.frag", blocks=(VIEW_FRAME, AIR)
        )  # fmt: skip
