"""The same triangles in one colour, with read-back: the floor that frames are measured against."""

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.gpu import create_context, mesh_buffers, render_target
from sensorsim.render.blocks import VIEW_FRAME, view_frame
from sensorsim.render.camera import Camera
from sensorsim.render.passes import Pass
from sensorsim.scene import Mesh


class ConstantColour:
    """Draws a mesh in one colour at one size; holds an OpenGL context of its own."""

    def __init__(self, mesh: Mesh, size: tuple[int, int], *, backend: str = "auto") -> None:
        self.size = size
        self.box = mesh.position.min(axis=0), mesh.position.max(axis=0)
        self.ctx = create_context(backend)
        buffers = mesh_buffers(self.ctx, {"position": mesh.position.astype(np.float32)}, mesh.triangle)
        self.triangles = Pass(
            self.ctx, "scene/constant.vert", "scene/constant.frag", blocks=(VIEW_FRAME,), samplers=(), generated={},
            mesh=buffers,
        )  # fmt: skip
        self.target = render_target(self.ctx, size, {"colour": "RGBA8"}, depth=True)
        self.block = self.ctx.buffer(reserve=VIEW_FRAME.dtype.itemsize)
        self.stored = np.zeros((size[1], size[0], 4), np.uint8)

    def release(self) -> None:
        """Give back the context."""
        self.ctx.release()

    def render(self, camera: Camera) -> NDArray[np.uint8]:
        """Colours (height, width, 4) from the lowest row up, valid until the next call."""
        with self.ctx:
            self.block.write(view_frame(camera, self.size, *self.box))
            self.block.bind_to_uniform_block(VIEW_FRAME.binding)
            self.target.use()
            self.target.clear()
            self.ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
            self.triangles.draw()
            self.target.texture("colour").read_into(self.stored)
        return self.stored
