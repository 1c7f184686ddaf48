"""Vertex arrays from named NumPy arrays, checked against what the program reads."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
import numpy.typing as npt

from sensorsim.errors import GraphicsError

# NumPy type: OpenGL's numbers of the GLSL types of 1 to 4 components, and their names
_ATTRIBUTE_TYPES: Mapping[str, tuple[tuple[int, ...], tuple[str, ...]]] = {
    "<f4": ((0x1406, 0x8B50, 0x8B51, 0x8B52), ("float", "vec2", "vec3", "vec4")),
    "<i4": ((0x1404, 0x8B53, 0x8B54, 0x8B55), ("int", "ivec2", "ivec3", "ivec4")),
    "<u4": ((0x1405, 0x8DC6, 0x8DC7, 0x8DC8), ("uint", "uvec2", "uvec3", "uvec4")),
}
_TYPE_NAMES = {
    number: name for numbers, names in _ATTRIBUTE_TYPES.values() for number, name in zip(numbers, names, strict=True)
}


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshBuffers:
    """Vertex attributes in buffers of their own, so that programs that read different ones share them."""

    ctx: moderngl.Context
    attributes: Mapping[str, tuple[moderngl.Buffer, str, int]]  # buffer, NumPy type, components
    index: moderngl.Buffer | None

    def vertex_array(self, program: moderngl.Program) -> moderngl.VertexArray:
        """The vertex array through which `program` draws these triangles; attributes it does not read stay out.

        Raises GraphicsError for an attribute that the mesh lacks or holds in another type or width.
        """
        content = []
        for attribute in _attributes(program):
            if attribute.name not in self.attributes:
                have = ", ".join(self.attributes)
                raise GraphicsError(f"vertex attribute '{attribute.name}' is not in the mesh; it has: {have}")
            buffer, kind, components = self.attributes[attribute.name]
            held = _ATTRIBUTE_TYPES[kind][1][components - 1]
            read = _TYPE_NAMES.get(getattr(attribute, "gl_type", 0), "no vector")  # gl_type is missing from the stubs
            if read != held or attribute.array_length != 1:
                raise GraphicsError(
                    f"vertex attribute '{attribute.name}': the shader reads {read}, the mesh has {held}"
                )
            content.append((buffer, f"{components}{kind[1:]}", attribute.name))
        return self.ctx.vertex_array(program, content, index_buffer=self.index, mode=moderngl.TRIANGLES)

    def release(self) -> None:
        """Give back the buffers; vertex arrays made from them are released by whoever holds them."""
        for buffer, _, _ in self.attributes.values():
            buffer.release()
        if self.index is not None:
            self.index.release()


def mesh_buffers(
    ctx: moderngl.Context, attributes: Mapping[str, npt.NDArray[Any]], triangles: npt.NDArray[Any] | None = None
) -> MeshBuffers:
    """Upload attributes (v,) or (v, 1 to 4) of float32, int32 or uint32 and, where given, triangles (t, 3).

    Raises GraphicsError for other types or shapes, differing lengths, a value that is not finite, or a triangle whose
    corner is no vertex. float64 is refused rather than rounded: the caller decides what is subtracted first.
    """
    if not attributes:
        raise GraphicsError("a mesh needs at least one vertex attribute")
    count = len(next(iter(attributes.values())))
    for name, values in attributes.items():
        _check_attribute(name, values, count)
    index = None if triangles is None else ctx.buffer(_checked_triangles(triangles, count))
    buffers = {
        name: (ctx.buffer(np.ascontiguousarray(values)), values.dtype.str, values.size // count)
        for name, values in attributes.items()
    }
    return MeshBuffers(ctx=ctx, attributes=buffers, index=index)


def screen_triangle(ctx: moderngl.Context, program: moderngl.Program) -> moderngl.VertexArray:
    """Three vertices without attributes: the vertex shader lays one triangle over the picture by gl_VertexID."""
    names = [attribute.name for attribute in _attributes(program)]
    if names:
        raise GraphicsError(f"a full-screen program reads no vertex attributes, this one reads {', '.join(names)}")
    array = ctx.vertex_array(program, [], mode=moderngl.TRIANGLES)
    array.vertices = 3
    return array


def _attributes(program: moderngl.Program) -> Iterator[moderngl.Attribute]:
    members = map(program.__getitem__, program)
    return (
        member for member in members if isinstance(member, moderngl.Attribute) and not member.name.startswith("gl_")
    )


def _check_attribute(name: str, values: npt.NDArray[Any], count: int) -> None:
    if values.dtype.str not in _ATTRIBUTE_TYPES:
        raise GraphicsError(f"vertex attribute '{name}' is of type {values.dtype}; use float32, int32 or uint32")
    width = values.shape[1] if values.ndim == 2 else 1
    if values.ndim not in (1, 2) or not 1 <= width <= 4 or len(values) != count or count == 0:
        raise GraphicsError(
            f"vertex attribute '{name}' has shape {values.shape}, expected ({count},) or ({count}, 1 to 4)"
        )
    if values.dtype.kind == "f" and not np.isfinite(values).all():
        raise GraphicsError(f"vertex attribute '{name}' holds a value that is not finite")


def _checked_triangles(triangles: npt.NDArray[Any], count: int) -> npt.NDArray[np.uint32]:
    if triangles.ndim != 2 or triangles.shape[1] != 3 or triangles.dtype.kind not in "iu" or len(triangles) == 0:
        raise GraphicsError(f"triangles of shape {triangles.shape}, {triangles.dtype}; expected (t, 3) integers")
    if triangles.min() < 0 or triangles.max() >= count:
        raise GraphicsError(f"a triangle's corner lies outside the {count} vertices")
    return np.ascontiguousarray(triangles, np.uint32)
