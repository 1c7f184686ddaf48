"""Frames that are shown and not kept: surfaces shaded once a moment, one float a pixel, the rest on the processor.

What does not vary within a surface is computed once for each moment, a texel a surface (scene/settled.frag); a pixel
adds the air before it, and what its surface mirrors where that has a gloss. Of two surfaces behind each other only the
nearer one is shaded wherever it was drawn first, so near tiles and high features are drawn first and the sky last.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import replace

import moderngl
import numpy as np
from numpy.typing import NDArray

from sensorsim.gpu import constants_glsl, mesh_buffers, render_target
from sensorsim.render.blocks import AIR, ILLUMINATION, VIEW_FRAME
from sensorsim.render.camera import Camera
from sensorsim.render.mirror import gloss_records
from sensorsim.render.passes import TEXTURE_UNITS, Pass, background_pass, screen_pass
from sensorsim.render.surface_table import SURFACES_PER_ROW
from sensorsim.render.tiles import build_tiles, visible_tiles
from sensorsim.render.world import World

MIRRORING = ("surface_table", "band_radiance_table", "rise_table", "mirror_table")


class QuickFrame:
    """Draws the radiance of a world's pictures of one size, and nothing else, in the renderer's context."""

    def __init__(
        self,
        ctx: moderngl.Context,
        world: World,
        size: tuple[int, int],
        generated: Mapping[str, str],
        *,
        emissive: bool,
    ) -> None:
        self.ctx, self.moment = ctx, -1
        count = world.scene.surfaces.area.size
        rows = -(-count // SURFACES_PER_ROW)
        self.settled = render_target(ctx, (min(count, SURFACES_PER_ROW), rows), {"picture": "RG32F"})
        self.target = render_target(ctx, size, {"radiance": "R32F"}, depth=True)
        self.stored = np.zeros((size[1], size[0]), np.float32)
        texts = {**generated, "constants": constants_glsl()}
        self.settle_pass = screen_pass(
            ctx, "scene/settled.frag", (*MIRRORING, "coefficient_table", "lobe_table"), {"EMISSIVE": int(emissive)},
            blocks=(ILLUMINATION,), generated=texts,
        )  # fmt: skip
        plain = {"EMISSIVE": int(emissive), "PATH": 1, "MARKED": 1}
        self.backgrounds = [background_pass(ctx, generated, {**plain, "HORIZON": horizon}) for horizon in range(3)]
        mesh = self.mesh = world.scene.mesh
        self.kind, self.height = _kinds_and_heights(world)
        self.tiles = build_tiles(mesh, self.kind, self.height)
        buffers = self.buffers = mesh_buffers(
            ctx, {"position": mesh.position.astype(np.float32), "surface": mesh.surface}, self.tiles.triangle
        )
        self.passes = [
            Pass(
                ctx, "scene/quick.vert", "scene/quick.frag", blocks=(VIEW_FRAME, ILLUMINATION, AIR),
                samplers=("settled_table", *MIRRORING), generated=texts,
                defines={"EMISSIVE": int(emissive), "MIRRORS": int(mirrors)}, mesh=buffers,
            )
            for mirrors in (False, True)
        ]  # fmt: skip

    def show_only(self, triangles: NDArray[np.bool_]) -> None:
        """Draw these of the mesh's triangles (t,) from now on."""
        some = replace(self.mesh, triangle=self.mesh.triangle[triangles])
        self.tiles = build_tiles(some, self.kind[triangles], self.height[triangles])
        assert self.buffers.index is not None
        self.buffers.index.write(self.tiles.triangle)

    def settle(self, moment: int) -> None:
        """Compute the surfaces of the moment of that number, which the tables in use hold, unless they are there."""
        if moment == self.moment:
            return
        self.moment = moment
        self.settled.use()
        self.ctx.enable_only(moderngl.NOTHING)
        self.settle_pass.draw()

    def draw(self, camera: Camera, draw_solids: Callable[[], None]) -> None:
        """Draw what the camera sees, into the target; `draw_solids` draws what stands among the surfaces."""
        self.settled.texture("picture").use(TEXTURE_UNITS["settled_table"])
        self.target.use()
        self.target.clear()
        self.ctx.enable_only(moderngl.DEPTH_TEST | moderngl.CULL_FACE)
        self.ctx.depth_func = "<"
        tiles = self.tiles
        for tile in visible_tiles(tiles, camera, self.target.size).tolist():
            first, last = 3 * int(tiles.edge[tile]), 3 * int(tiles.edge[tile + 1])
            self.passes[tiles.kind[tile]].vertices.render(first=first, vertices=last - first)
        draw_solids()
        self.ctx.enable_only(moderngl.DEPTH_TEST)
        self.ctx.depth_func = "<="
        low, high = horizon_rows(camera, self.target.size)
        for horizon, rows in ((2, (0, low)), (0, (low, high)), (1, (high, self.target.size[1]))):
            if rows[1] > rows[0]:
                self.target.framebuffer.scissor = (0, rows[0], self.target.size[0], rows[1] - rows[0])
                self.backgrounds[horizon].draw()
        self.target.framebuffer.scissor = (0, 0, *self.target.size)
        self.ctx.depth_func = "<"

    def read(self) -> NDArray[np.float32]:
        """Radiance (height, width) [W m-2 sr-1] from the lowest row up, its sign set where no surface is seen.

        The array is the same each time.
        """
        self.target.texture("radiance").read_into(self.stored)
        return self.stored


def horizon_rows(camera: Camera, size: tuple[int, int]) -> tuple[int, int]:
    """Rows, counted from the lowest, below which every pixel looks below the horizon, and from which on all above it.

    Of a camera that is upside down the sky is below: then no row is told apart.
    """
    corner, right, up = camera.view_rays(size)
    if up[2] <= 0.0:
        return 0, size[1]
    ends = corner[2] + np.array([0.0, right[2]])
    crossed = -ends / up[2] * size[1]  # row edges where the picture's sides meet the horizon
    low, high = math.floor(min(crossed)) - 1, math.ceil(max(crossed)) + 1  # a row to spare for rounding
    return min(max(low, 0), size[1]), min(max(high, 0), size[1])


def _kinds_and_heights(world: World) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Of each triangle: 1 where its surface has a gloss, and the height of its feature's top [m]."""
    mesh, assignment = world.scene.mesh, world.assignment
    surface = mesh.surface[mesh.triangle[:, 0]]
    codes = np.array([wall.code for wall in assignment.wall_types], dtype=np.int64)[assignment.wall_type]
    gloss = gloss_records(codes, assignment.emissivity, assignment.nir_reflectance)[:, 0] >= 0.0
    feature = world.scene.surfaces.feature
    top = np.full(int(feature.max()) + 1, -math.inf)
    np.maximum.at(top, feature[mesh.surface], mesh.position[:, 2])
    return gloss[surface].astype(np.int64), top[feature[surface]]
