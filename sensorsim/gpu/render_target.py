"""Off-screen pictures: several planes drawn at once and read back as arrays."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import moderngl
import numpy as np
import numpy.typing as npt

from sensorsim.errors import GraphicsError

# format: components, moderngl's type, NumPy's type
PLANE_FORMATS: Mapping[str, tuple[int, str, str]] = {
    "R32F": (1, "f4", "<f4"),
    "RG32F": (2, "f4", "<f4"),
    "RGBA32F": (4, "f4", "<f4"),
    "R32I": (1, "i4", "<i4"),
    "R32UI": (1, "u4", "<u4"),
    "R8": (1, "f1", "u1"),
    "RGBA8": (4, "f1", "u1"),
}


@dataclass(frozen=True, slots=True, kw_only=True)
class RenderTarget:
    """Named planes of one size that a fragment shader writes together; plane i is `layout(location = i) out`."""

    size: tuple[int, int]  # width, height [pixel]
    planes: Mapping[str, moderngl.Texture]
    framebuffer: moderngl.Framebuffer

    def use(self) -> None:
        """Direct drawing here, over the whole picture."""
        self.framebuffer.use()
        self.framebuffer.viewport = (0, 0, *self.size)

    def clear(self) -> None:
        """Set every plane to zero and the depth, where there is one, to 1, the far end."""
        # glClear leaves integer planes undefined, so they are masked out and written instead.
        textures = tuple(self.planes.values())
        drawn = self.framebuffer.color_mask
        masks = tuple((texture.dtype in ("f4", "f1"),) * 4 for texture in textures)
        self.framebuffer.color_mask = masks if len(masks) > 1 else masks[0]  # type: ignore[assignment]
        self.framebuffer.clear(depth=1.0)
        self.framebuffer.color_mask = drawn
        for texture in textures:
            if texture.dtype in ("i4", "u4"):
                texture.write(bytes(4 * texture.components * texture.width * texture.height))

    def clear_depth(self) -> None:
        """Set the depth to 1 and leave the planes: enough where a background is drawn over the whole picture."""
        drawn = self.framebuffer.color_mask
        off = (False,) * 4
        self.framebuffer.color_mask = (off,) * len(self.planes) if len(self.planes) > 1 else off  # type: ignore[assignment]
        self.framebuffer.clear(depth=1.0)
        self.framebuffer.color_mask = drawn

    def read(self, plane: str) -> npt.NDArray[Any]:
        """One plane as (height, width, components), float32, int32, uint32 or uint8 as its format says.

        Row 0 is the top of the picture: OpenGL counts rows from the bottom, so they are flipped here, and only here.
        """
        texture = self.texture(plane)
        kind = {moderngl_type: dtype for _, moderngl_type, dtype in PLANE_FORMATS.values()}[texture.dtype]
        rows = np.frombuffer(texture.read(alignment=1), kind)
        return rows.reshape(texture.height, texture.width, texture.components)[::-1].copy()

    def texture(self, plane: str) -> moderngl.Texture:
        """The texture of a plane, for a later pass to read; row 0 of the texture is the bottom of the picture."""
        if plane not in self.planes:
            raise GraphicsError(f"no plane '{plane}'; there are: {', '.join(self.planes)}")
        return self.planes[plane]

    def release(self) -> None:
        """Give back the memory of all planes."""
        # moderngl rebinds the framebuffer it believes in use; a released one must not be it.
        if self.framebuffer.ctx.fbo is self.framebuffer:
            self.framebuffer.ctx.detect_framebuffer(0).use()
        depth = self.framebuffer.depth_attachment
        self.framebuffer.release()
        for texture in self.planes.values():
            texture.release()
        if depth is not None:
            depth.release()


def render_target(
    ctx: moderngl.Context, size: tuple[int, int], planes: Mapping[str, str], *, depth: bool = False
) -> RenderTarget:
    """Planes by name and format (a key of PLANE_FORMATS), in the order of the shader's output locations.

    `size` is width, height [pixel]; `depth` adds a depth buffer. Raises GraphicsError for a size or number of planes
    beyond the driver's limits and for an unknown format.
    """
    limit = min(ctx.info["GL_MAX_TEXTURE_SIZE"], *ctx.info["GL_MAX_VIEWPORT_DIMS"])
    if not all(1 <= side <= limit for side in size):
        raise GraphicsError(f"picture of {size[0]} x {size[1]} pixels, but this OpenGL draws 1 to {limit} a side")
    most = min(ctx.info["GL_MAX_COLOR_ATTACHMENTS"], ctx.info["GL_MAX_DRAW_BUFFERS"])
    if not 1 <= len(planes) <= most:
        raise GraphicsError(f"{len(planes)} planes, but this OpenGL draws 1 to {most} at once")
    unknown = [name for name in planes.values() if name not in PLANE_FORMATS]
    if unknown:
        raise GraphicsError(f"no plane format {unknown[0]}; there are: {', '.join(PLANE_FORMATS)}")
    textures = {}
    for name, kind in planes.items():
        components, dtype, _ = PLANE_FORMATS[kind]
        textures[name] = ctx.texture(size, components, dtype=dtype)
        textures[name].filter = (moderngl.NEAREST, moderngl.NEAREST)
    buffer = ctx.depth_renderbuffer(size) if depth else None
    return RenderTarget(size=size, planes=textures, framebuffer=ctx.framebuffer([*textures.values()], buffer))
