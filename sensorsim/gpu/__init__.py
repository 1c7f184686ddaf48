"""A thin layer over moderngl, OpenGL 3.3 core: context, shader text, program, uniform block, table, target, mesh.

No physics and no knowledge of the scene. What does not fit raises GraphicsError with the name of the file, block,
table or attribute.
"""

from sensorsim.gpu.context import BACKENDS, context_info, create_context
from sensorsim.gpu.generated import constants_glsl, float_literal
from sensorsim.gpu.mesh import MeshBuffers, mesh_buffers, screen_triangle
from sensorsim.gpu.program import bind_samplers, build_program, link_program
from sensorsim.gpu.render_target import PLANE_FORMATS, RenderTarget, render_target
from sensorsim.gpu.shader_source import ShaderSource, expand_source, expand_text
from sensorsim.gpu.texture import float_table, integer_table, update_table
from sensorsim.gpu.uniform_block import Field, UniformBlock

__all__ = [
    "BACKENDS",
    "PLANE_FORMATS",
    "Field",
    "MeshBuffers",
    "RenderTarget",
    "ShaderSource",
    "UniformBlock",
    "bind_samplers",
    "build_program",
    "constants_glsl",
    "context_info",
    "create_context",
    "expand_source",
    "expand_text",
    "float_literal",
    "float_table",
    "integer_table",
    "link_program",
    "mesh_buffers",
    "render_target",
    "screen_triangle",
    "update_table",
]
