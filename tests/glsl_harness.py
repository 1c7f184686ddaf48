"""Evaluate a GLSL expression on arrays by drawing to a float target, so that shaders can be held to NumPy twins."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import moderngl
import numpy as np
import numpy.typing as npt

from sensorsim.gpu import (
    UniformBlock,
    bind_samplers,
    expand_text,
    float_table,
    integer_table,
    link_program,
    render_target,
    screen_triangle,
)

WIDTH = 1024  # [texel] of the pictures that hold the inputs and the result

VERTEX = """#version 330 core
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
"""

FRAGMENT = """#version 330 core
{includes}
{samplers}
layout(location = 0) out vec4 harness_result;
void main() {{
    ivec2 harness_texel = ivec2(gl_FragCoord.xy);
    {inputs}
    {result_type} harness_value = {expression};
    harness_result = vec4({padded});
}}
"""

RESULT_PADDING = {
    "float": "harness_value, 0.0, 0.0, 0.0",
    "vec2": "harness_value, 0.0, 0.0",
    "vec3": "harness_value, 0.0",
    "vec4": "harness_value",
}


def evaluate(
    ctx: moderngl.Context,
    expression: str,
    inputs: Mapping[str, npt.NDArray[Any]],
    *,
    include: Sequence[str] = (),
    returns: str = "float",
    defines: Mapping[str, int] | None = None,
    generated: Mapping[str, str] | None = None,
    blocks: Mapping[UniformBlock, bytes] | None = None,
    tables: Mapping[str, moderngl.Texture] | None = None,
    root: Path | None = None,
) -> npt.NDArray[np.float32]:
    """Value of `expression` for each row of the inputs: (n,) for a float, (n, c) for a vector.

    `inputs` become variables of the expression: a float array (n,) is a float, (n, 2 to 4) a vec2 to vec4; an integer
    array (n,) is an int, (n, 4) an ivec4. `include` lists files as a shader would, `blocks` gives packed uniform
    blocks, `tables` the textures behind the samplers that the included text declares.
    """
    count = len(next(iter(inputs.values())))
    blocks, tables = blocks or {}, dict(tables or {})
    created = {f"harness_{name}": _input_table(ctx, name, values) for name, values in inputs.items()}
    text = FRAGMENT.format(
        includes="\n".join(f'#include "{path}"' for path in include),
        samplers="\n".join(_sampler_line(name, values) for name, values in inputs.items()),
        inputs="\n    ".join(_input_line(name, values) for name, values in inputs.items()),
        result_type=returns,
        expression=expression,
        padded=RESULT_PADDING[returns],
    )
    texts = {**(generated or {}), **{block.include_name: block.glsl() for block in blocks}}
    fragment = expand_text("harness.frag", text, defines=defines, generated=texts, root=root)
    samplers = {**tables, **created}
    program = link_program(
        ctx, expand_text("harness.vert", VERTEX), fragment, blocks=tuple(blocks), samplers=samplers.keys()
    )
    bind_samplers(program, {name: unit for unit, name in enumerate(samplers)})
    picture = _draw(ctx, program, samplers, blocks, _rows(count))
    for resource in (program, *created.values()):
        resource.release()
    components = int(returns[3:]) if returns != "float" else 1
    values = picture.reshape(-1, 4)[:count, :components]
    return values[:, 0] if returns == "float" else values


def _draw(
    ctx: moderngl.Context,
    program: moderngl.Program,
    samplers: Mapping[str, moderngl.Texture],
    blocks: Mapping[UniformBlock, bytes],
    rows: int,
) -> npt.NDArray[np.float32]:
    for unit, texture in enumerate(samplers.values()):
        texture.use(unit)
    buffers = [ctx.buffer(data) for data in blocks.values()]
    for block, buffer in zip(blocks, buffers, strict=True):
        buffer.bind_to_uniform_block(block.binding)
    target = render_target(ctx, (WIDTH, rows), {"result": "RGBA32F"})
    target.use()
    array = screen_triangle(ctx, program)
    array.render()
    bottom_up = target.read("result")[::-1]  # texel rows count from the bottom, as the inputs do
    for resource in (array, target, *buffers):
        resource.release()
    return bottom_up


def _rows(count: int) -> int:
    return -(-count // WIDTH)


def _components(values: npt.NDArray[Any]) -> int:
    return 1 if values.ndim == 1 else values.shape[1]


def _input_table(ctx: moderngl.Context, name: str, values: npt.NDArray[Any]) -> moderngl.Texture:
    integer = values.dtype.kind in "iu"
    components = _components(values)
    stored = 4 if components == 3 else components
    padded = np.zeros((_rows(len(values)) * WIDTH, stored), np.int32 if integer else np.float32)
    padded[: len(values), :components] = values.reshape(len(values), components)
    padded[len(values) :] = padded[len(values) - 1]  # unused texels repeat the last input: no stray domain errors
    create = integer_table if integer else float_table
    return create(ctx, name, padded.reshape(-1, WIDTH, stored))


def _sampler_line(name: str, values: npt.NDArray[Any]) -> str:
    return f"uniform {'i' if values.dtype.kind in 'iu' else ''}sampler2D harness_{name};"


def _input_line(name: str, values: npt.NDArray[Any]) -> str:
    components = _components(values)
    integer = values.dtype.kind in "iu"
    kind = f"{'i' if integer else ''}vec{components}" if components > 1 else "int" if integer else "float"
    return f"{kind} {name} = texelFetch(harness_{name}, harness_texel, 0).{'rgba'[:components]};"
