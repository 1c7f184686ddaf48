from pathlib import Path

import moderngl
import numpy as np
import pytest

from sensorsim.errors import GraphicsError
from sensorsim.gpu import (
    Field,
    UniformBlock,
    bind_samplers,
    build_program,
    expand_text,
    float_table,
    link_program,
    render_target,
    screen_triangle,
)

FRAME = UniformBlock(name="Frame", binding=4, fields=(Field("gain", "float", "[-]"),))
VERTEX = """#version 330 core
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }
"""
FRAGMENT = """#version 330 core
#include "generated/frame_block.glsl"
uniform sampler2D first;
uniform sampler2D second;
uniform sampler2D idle;
layout(location = 0) out float result;
void main() { result = frame.gain * (texelFetch(first, ivec2(0), 0).r + 10.0 * texelFetch(second, ivec2(0), 0).r); }
"""
SAMPLERS = ("first", "second", "idle")


def build(ctx: moderngl.Context, root: Path, fragment: str, **options: object) -> moderngl.Program:
    (root / "a.vert").write_text(VERTEX)
    (root / "a.frag").write_text(fragment)
    given = {"blocks": (FRAME,), "samplers": SAMPLERS, **options}
    return build_program(ctx, vertex="a.vert", fragment="a.frag", root=root, **given)  # type: ignore[arg-type]


def test_blocks_and_samplers_reach_the_shader(ctx: moderngl.Context, tmp_path: Path) -> None:
    program = build(ctx, tmp_path, FRAGMENT)
    bind_samplers(program, {"first": 5, "second": 2})
    tables = [float_table(ctx, "first", np.array([[3.0]])), float_table(ctx, "second", np.array([[4.0]]))]
    for table, unit in zip(tables, (5, 2), strict=True):
        table.use(unit)
    buffer = ctx.buffer(FRAME.pack(gain=2.0))
    buffer.bind_to_uniform_block(FRAME.binding)
    target = render_target(ctx, (1, 1), {"result": "R32F"})
    target.use()
    array = screen_triangle(ctx, program)
    array.render()
    assert target.read("result").tolist() == [[[86.0]]]
    for resource in (array, target, buffer, program, *tables):
        resource.release()


@pytest.mark.parametrize(
    ("units", "problem"),
    [
        ({"first": 0}, r"without a unit: \['second'\]"),
        ({"first": 0, "second": 1, "thrid": 2}, r"not declared: \['thrid'\]"),
        ({"first": 1, "second": 1}, "not distinct"),
        ({"first": 0, "second": 100000}, "not distinct numbers below"),
        ({"first": 0, "second": -1}, "not distinct numbers below"),
    ],
)
def test_each_sampler_gets_one_unit(ctx: moderngl.Context, tmp_path: Path, units: dict[str, int], problem: str) -> None:
    program = build(ctx, tmp_path, FRAGMENT)
    with pytest.raises(GraphicsError, match=r"a\.vert, a\.frag: .*" + problem):
        bind_samplers(program, units)
    bind_samplers(program, {"first": 0, "second": 1, "idle": 2})
    program.release()


@pytest.mark.parametrize(
    ("options", "problem"),
    [
        ({"samplers": ("first", "idle")}, "sampler 'second' was not declared; declared are: first, idle"),
        ({"blocks": (), "generated": {"frame_block": FRAME.glsl()}}, "uniform block Frame was not given"),
        ({"blocks": (FRAME, UniformBlock(name="Other", binding=4, fields=FRAME.fields))}, "share a binding"),
    ],
)
def test_what_the_program_takes_in_is_declared(
    ctx: moderngl.Context, tmp_path: Path, options: dict[str, object], problem: str
) -> None:
    with pytest.raises(GraphicsError, match=problem):
        build(ctx, tmp_path, FRAGMENT, **options)


def test_a_hand_written_block_of_another_size_is_refused(ctx: moderngl.Context, tmp_path: Path) -> None:
    own = "layout(std140) uniform Frame { float gain; vec4 more; } frame;"
    with pytest.raises(GraphicsError, match="block Frame has 32 bytes in OpenGL, 16 in Python"):
        build(ctx, tmp_path, FRAGMENT.replace('#include "generated/frame_block.glsl"', own))


@pytest.mark.parametrize(
    "declaration", ["uniform float gain;", "uniform sampler3D gain;", "uniform sampler2D gain[2];"]
)
def test_lone_uniforms_are_refused(ctx: moderngl.Context, tmp_path: Path, declaration: str) -> None:
    use = {"float": "gain", "sampler3D": "texelFetch(gain, ivec3(0), 0).r"}.get(
        declaration.split()[1], "texelFetch(gain[1], ivec2(0), 0).r"
    )
    text = f"#version 330 core\n{declaration}\nout float result;\nvoid main() {{ result = {use}; }}\n"
    with pytest.raises(GraphicsError, match=r"uniform 'gain' is no single 2-D sampler"):
        build(ctx, tmp_path, text, samplers=("gain",))


def test_link_errors_name_both_files(ctx: moderngl.Context) -> None:
    head = "#version 330 core\n"
    vertex = expand_text(
        "a.vert", head + "out vec2 range;\nvoid main() { range = vec2(0.0); gl_Position = vec4(0.0); }\n"
    )
    fragment = expand_text("a.frag", head + "in vec3 range;\nout float o;\nvoid main() { o = range.x; }\n")
    with pytest.raises(GraphicsError, match=r"a\.vert, a\.frag: does not link\n.*range"):
        link_program(ctx, vertex, fragment)
