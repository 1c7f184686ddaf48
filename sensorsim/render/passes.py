"""The passes of a frame, each a program with what it draws: surfaces, background, display."""

from collections.abc import Mapping

import moderngl

from sensorsim.gpu import UniformBlock, bind_samplers, build_program, constants_glsl, screen_triangle
from sensorsim.gpu.mesh import MeshBuffers
from sensorsim.render.blocks import AIR, DISPLAY, ILLUMINATION, VIEW_FRAME
from sensorsim.tables import LookupTable

TEXTURE_UNITS = {
    "surface_table": 0,
    "coefficient_table": 1,
    "band_radiance_table": 2,
    "sky_radiance_table": 3,
    "radiance_picture": 4,
    "lobe_table": 12,
    "product_picture": 5,
    "focal_plane": 6,
    "kernel_table": 7,
    "column_table": 8,
    "pattern_table": 9,
    "row_table": 10,
    "line_table": 11,
    "deviate_table": 12,
    "tone_table": 5,
    "last_picture": 13,
    "block_picture": 14,
    "baseline_picture": 15,
    "halo_picture": 14,
    "reported_picture": 13,
    "means_picture": 13,
    "raster_table": 14,
    "sky_gradation_table": 16,  # units of one stage end at 15, those of a program later
    "sky_indicatrix_table": 17,
    "rise_table": 18,
    "mirror_table": 19,
}


class Pass:
    """A program and the vertices that it draws."""

    def __init__(
        self, ctx: moderngl.Context, vertex: str, fragment: str, *,
        blocks: tuple[UniformBlock, ...], samplers: tuple[str, ...], generated: Mapping[str, str],
        defines: Mapping[str, int] | None = None, mesh: MeshBuffers | None = None,
    ) -> None:  # fmt: skip
        self.program = build_program(
            ctx, vertex=vertex, fragment=fragment, defines=defines, generated=generated, blocks=blocks,
            samplers=samplers,
        )  # fmt: skip
        bind_samplers(self.program, {name: TEXTURE_UNITS[name] for name in samplers})
        self.vertices = screen_triangle(ctx, self.program) if mesh is None else mesh.vertex_array(self.program)

    def draw(self) -> None:
        """Draw into the target in use."""
        self.vertices.render()

    def release(self) -> None:
        """Give back the program and its vertex array."""
        self.vertices.release()
        self.program.release()


def surface_pass(
    ctx: moderngl.Context, mesh: MeshBuffers, generated: Mapping[str, str], defines: Mapping[str, int]
) -> Pass:
    """Surfaces of the scene: band radiance [W m-2 sr-1], temperature [K], range [m], id."""
    return Pass(
        ctx,
        "scene/surface.vert",
        "scene/surface.frag",
        blocks=(VIEW_FRAME, ILLUMINATION, AIR),
        samplers=(
            "surface_table",
            "coefficient_table",
            "band_radiance_table",
            "lobe_table",
            "rise_table",
            "mirror_table",
        ),
        generated={**generated, "constants": constants_glsl()},
        defines=defines,
        mesh=mesh,
    )


def background_pass(ctx: moderngl.Context, generated: Mapping[str, str], defines: Mapping[str, int]) -> Pass:
    """Sky and far ground where no surface is: band radiance [W m-2 sr-1]."""
    return Pass(
        ctx,
        "scene/background.vert",
        "scene/background.frag",
        blocks=(VIEW_FRAME, ILLUMINATION, AIR),
        samplers=("sky_radiance_table", "sky_gradation_table", "sky_indicatrix_table"),
        generated=generated,
        defines=defines,
    )


def screen_pass(
    ctx: moderngl.Context,
    fragment: str,
    samplers: tuple[str, ...],
    defines: Mapping[str, int] | None = None,
    *,
    blocks: tuple[UniformBlock, ...] = (),
    generated: Mapping[str, str] | None = None,
) -> Pass:
    """A pass over the whole picture."""
    return Pass(
        ctx,
        "common/screen.vert",
        fragment,
        blocks=blocks,
        samplers=samplers,
        generated=generated or {},
        defines=defines,
    )


def display_pass(ctx: moderngl.Context, curve: LookupTable | None = None) -> Pass:
    """Grey [0, 1] from band radiance, by a straight line or a curve."""
    straight = "Ratio tone(Ratio straight) { return straight; }\n"
    return screen_pass(
        ctx,
        "sensor/display.frag",
        ("radiance_picture",) if curve is None else ("radiance_picture", "tone_table"),
        blocks=(DISPLAY,),
        generated={"tone": straight if curve is None else curve.glsl()},
    )
