import moderngl
import numpy as np
import pytest

from sensorsim.errors import GraphicsError
from sensorsim.gpu import RenderTarget, expand_text, link_program, render_target, screen_triangle

VERTEX = """#version 330 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.25, 1.0); }
"""
FRAGMENT = """#version 330 core
layout(location = 0) out vec2 position;
layout(location = 1) out uint identity;
layout(location = 2) out int signed_identity;
layout(location = 3) out float grey;
layout(location = 4) out vec4 colour;
void main() {
    position = gl_FragCoord.xy;
    identity = 4000000000u + uint(gl_FragCoord.x);
    signed_identity = -int(gl_FragCoord.y);
    grey = gl_FragCoord.x * 20.0 / 255.0;
    colour = vec4(gl_FragCoord.xy, gl_FragCoord.z, 1.0);
}
"""
PLANES = {
    "position": "RG32F",
    "identity": "R32UI",
    "signed_identity": "R32I",
    "grey": "R8",
    "colour": "RGBA32F",
}
WIDTH, HEIGHT = 7, 5  # odd, so that padded rows would show


def draw(ctx: moderngl.Context, target: RenderTarget) -> None:
    program = link_program(ctx, expand_text("a.vert", VERTEX), expand_text("a.frag", FRAGMENT))
    array = screen_triangle(ctx, program)
    target.use()
    array.render()
    array.release()
    program.release()


def test_planes_read_back_exactly_with_row_0_on_top(ctx: moderngl.Context) -> None:
    target = render_target(ctx, (WIDTH, HEIGHT), PLANES)
    draw(ctx, target)
    x = np.arange(WIDTH) + 0.5
    y = np.arange(HEIGHT)[::-1, None] + 0.5  # OpenGL's y points up: the top row has the largest
    position = target.read("position")
    assert (position.shape, position.dtype) == ((HEIGHT, WIDTH, 2), np.float32)
    np.testing.assert_array_equal(position[:, :, 0], np.broadcast_to(x, (HEIGHT, WIDTH)))
    np.testing.assert_array_equal(position[:, :, 1], np.broadcast_to(y, (HEIGHT, WIDTH)))
    identity = target.read("identity")
    assert (identity.shape, identity.dtype) == ((HEIGHT, WIDTH, 1), np.uint32)
    np.testing.assert_array_equal(identity[0, :, 0], 4_000_000_000 + np.arange(WIDTH))
    signed = target.read("signed_identity")
    assert signed.dtype == np.int32
    np.testing.assert_array_equal(signed[:, 0, 0], -np.arange(HEIGHT)[::-1])
    grey = target.read("grey")
    assert (grey.dtype, grey[0, :, 0].tolist()) == (np.uint8, [10, 30, 50, 70, 90, 110, 130])
    assert target.read("colour").shape == (HEIGHT, WIDTH, 4)
    target.release()


def test_clear_zeroes_every_plane_and_frees_the_depth(ctx: moderngl.Context) -> None:
    target = render_target(ctx, (WIDTH, HEIGHT), PLANES, depth=True)
    ctx.enable(moderngl.DEPTH_TEST)
    target.clear()
    draw(ctx, target)
    drawn = {name: target.read(name) for name in PLANES}
    target.clear()
    for name in PLANES:
        assert not target.read(name).any(), name
    draw(ctx, target)  # passes the depth test again, on all planes
    target.clear_depth()
    for name in PLANES:
        np.testing.assert_array_equal(target.read(name), drawn[name])
    ctx.disable(moderngl.DEPTH_TEST)
    target.release()


def test_clear_works_for_a_single_plane(ctx: moderngl.Context) -> None:
    for form in ("R32UI", "R32F"):
        target = render_target(ctx, (3, 3), {"only": form}, depth=True)
        target.planes["only"].write(np.ones(9, np.uint32 if form == "R32UI" else np.float32))
        target.clear_depth()
        assert target.read("only").all()
        target.clear()
        assert not target.read("only").any()
        target.release()


def test_a_target_in_use_can_be_released(ctx: moderngl.Context) -> None:
    target = render_target(ctx, (4, 4), {"a": "R32F"})
    target.use()
    target.release()
    render_target(ctx, (4, 4), {"a": "R32F"}).release()
    assert ctx.error == "GL_NO_ERROR"


@pytest.mark.parametrize(
    ("size", "planes", "problem"),
    [
        ((0, 4), {"a": "R32F"}, "picture of 0 x 4 pixels"),
        ((4, 1 << 20), {"a": "R32F"}, "picture of 4 x 1048576 pixels"),
        ((4, 4), {}, "0 planes"),
        ((4, 4), {"a": "RGB16F"}, "no plane format RGB16F; there are: R32F"),
    ],
)
def test_targets_that_cannot_be_are_refused(
    ctx: moderngl.Context, size: tuple[int, int], planes: dict[str, str], problem: str
) -> None:
    with pytest.raises(GraphicsError, match=problem):
        render_target(ctx, size, planes)


def test_unknown_plane_is_refused(ctx: moderngl.Context) -> None:
    target = render_target(ctx, (4, 4), {"a": "R32F"})
    with pytest.raises(GraphicsError, match="no plane 'b'; there are: a"):
        target.read("b")
    target.release()
