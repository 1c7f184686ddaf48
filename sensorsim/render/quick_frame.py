"""Which surface each pixel of a frame for display alone shows: all that is drawn of it, one number a pixel.

A rasteriser is good at telling what hides what, and a software one is bad at the rest: what a surface sends and what
the air does to it is left to compiled loops (`pixel_kernels`). Of two surfaces behind each other only the nearer one
is written wherever it was drawn first, so near tiles and high features are drawn first.
"""

import math
from dataclasses import replace

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.gpu import mesh_buffers, render_target
from sensorsim.render.blocks import VIEW_FRAME, view_frame
from sensorsim.render.camera import Camera
from sensorsim.render.passes import Pass
from sensorsim.render.solids import Solids
from sensorsim.render.tiles import build_tiles, visible_tiles
from sensorsim.render.world import World

MOST_SURFACES = 2**24 - 1  # that single precision counts


class QuickFrame:
    """Draws the numbers of the surfaces in a world's pictures of one size, in the renderer's context."""

    def __init__(self, ctx: moderngl.Context, world: World, size: tuple[int, int]) -> None:
        mesh = self.mesh = world.scene.mesh
        self.ctx, self.first = ctx, world.scene.surfaces.area.size
        self.box = mesh.position.min(axis=0), mesh.position.max(axis=0)
        self.target = render_target(ctx, size, {"number": "R32F"}, depth=True)
        self.stored = np.zeros((size[1], size[0]), np.float32)
        self.block = ctx.buffer(reserve=VIEW_FRAME.dtype.itemsize)
        self.top = _tops(world)
        self.tiles = build_tiles(mesh, self.top)
        buffers = self.buffers = mesh_buffers(
            ctx, {"position": mesh.position.astype(np.float32), "surface": mesh.surface}, self.tiles.triangle
        )
        self.surfaces = Pass(
            ctx, "scene/number.vert", "scene/number.frag", blocks=(VIEW_FRAME,), samplers=(), generated={},
            mesh=buffers,
        )  # fmt: skip

    def show_only(self, triangles: NDArray[np.bool_]) -> None:
        """Draw these of the mesh's triangles (t,) from now on."""
        some = replace(self.mesh, triangle=self.mesh.triangle[triangles])
        self.tiles = build_tiles(some, self.top[triangles])
        assert self.buffers.index is not None
        self.buffers.index.write(self.tiles.triangle)

    def draw(self, camera: Camera, solids: Solids | None) -> None:
        """Draw what the camera sees into the target, and what stands among the surfaces."""
        box = self.box if solids is None else solids.box(*self.box)
        self.block.write(view_frame(camera, self.target.size, *box))
        self.block.bind_to_uniform_block(VIEW_FRAME.binding)
        self.target.use()
        self.target.clear()
        self.ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        for tile in visible_tiles(self.tiles, camera, self.target.size).tolist():
            first, last = 3 * int(self.tiles.edge[tile]), 3 * int(self.tiles.edge[tile + 1])
            self.surfaces.vertices.render(first=first, vertices=last - first)
        if solids is not None:
            self._draw_solids(solids)

    def read(self) -> NDArray[np.float32]:
        """Number of the surface plus one (height, width), 0 where none is seen, from the lowest row up.

        Triangles of solids follow on the surfaces of the scene. The array is the same each time.
        """
        self.target.texture("number").read_into(self.stored)
        return self.stored

    def _draw_solids(self, solids: Solids) -> None:
        corners = solids.triangles.reshape(-1, 3).astype(np.float32)
        numbers = np.repeat(np.arange(len(solids.triangles), dtype=np.int32) + self.first, 3)
        buffers = mesh_buffers(self.ctx, {"position": corners, "surface": numbers})
        vertices = buffers.vertex_array(self.surfaces.program)
        vertices.render()
        vertices.release()
        buffers.release()


def _tops(world: World) -> NDArray[np.float64]:
    """Height of the top of the feature of each triangle [m]."""
    mesh, feature = world.scene.mesh, world.scene.surfaces.feature
    top = np.full(int(feature.max()) + 1, -math.inf)
    np.maximum.at(top, feature[mesh.surface], mesh.position[:, 2])
    return np.asarray(top[feature[mesh.surface[mesh.triangle[:, 0]]]])
