import moderngl
import numpy as np
import pytest

from sensorsim.errors import GraphicsError
from sensorsim.gpu import expand_text, link_program, mesh_buffers, render_target, screen_triangle

VERTEX = """#version 330 core
in vec2 position;
in int surface;
in uint tag;
flat out vec2 surface_and_tag;
void main() {
    surface_and_tag = vec2(float(surface), float(tag));
    gl_Position = vec4(position, 0.0, 1.0);
}
"""
FRAGMENT = """#version 330 core
flat in vec2 surface_and_tag;
out vec2 result;
void main() { result = surface_and_tag; }
"""
# Left and right half of the picture, four corners each.
POSITION = np.array([[-1, -1], [0, -1], [0, 1], [-1, 1], [0, -1], [1, -1], [1, 1], [0, 1]], np.float32)
SURFACE = np.repeat(np.array([-16777215, 16777213], np.int32), 4)
TAG = np.repeat(np.array([3, 4], np.uint32), 4)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
ATTRIBUTES = {"position": POSITION, "surface": SURFACE, "tag": TAG, "idle": np.zeros((8, 3), np.float32)}


@pytest.fixture
def program(ctx: moderngl.Context) -> moderngl.Program:
    return link_program(ctx, expand_text("a.vert", VERTEX), expand_text("a.frag", FRAGMENT))


@pytest.mark.parametrize("indexed", [True, False])
def test_attributes_reach_the_shader_exactly(ctx: moderngl.Context, program: moderngl.Program, indexed: bool) -> None:
    corners = {name: values if indexed else values[TRIANGLES.ravel()] for name, values in ATTRIBUTES.items()}
    mesh = mesh_buffers(ctx, corners, TRIANGLES if indexed else None)
    array = mesh.vertex_array(program)
    target = render_target(ctx, (4, 2), {"result": "RG32F"})
    target.use()
    array.render()
    expected = np.repeat([[[-16777215, 3], [16777213, 4]]], 2, axis=1).repeat(2, axis=0)
    np.testing.assert_array_equal(target.read("result"), expected)
    for resource in (array, mesh, target, program):
        resource.release()


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"position": None}, "'position' is not in the mesh; it has: surface, tag, idle"),
        ({"surface": SURFACE.astype(np.float32)}, "'surface': the shader reads int, the mesh has float"),
        ({"tag": TAG.astype(np.int32)}, "'tag': the shader reads uint, the mesh has int"),
        ({"position": np.zeros((8, 3), np.float32)}, "reads vec2, the mesh has vec3"),
    ],
)
def test_attributes_that_the_program_cannot_read_are_refused(
    ctx: moderngl.Context, program: moderngl.Program, change: dict[str, np.ndarray | None], problem: str
) -> None:
    given = {name: values for name, values in {**ATTRIBUTES, **change}.items() if values is not None}
    mesh = mesh_buffers(ctx, given, TRIANGLES)
    with pytest.raises(GraphicsError, match=problem):
        mesh.vertex_array(program)
    mesh.release()
    program.release()


@pytest.mark.parametrize(
    ("attributes", "triangles", "problem"),
    [
        ({}, None, "at least one"),
        ({"a": np.zeros((3, 3))}, None, "'a' is of type float64; use float32"),
        ({"a": np.zeros((3, 5), np.float32)}, None, r"shape \(3, 5\)"),
        ({"a": np.zeros((0, 3), np.float32)}, None, r"shape \(0, 3\)"),
        ({"a": np.zeros(3, np.float32), "b": np.zeros(4, np.float32)}, None, r"'b' has shape \(4,\), expected \(3,\)"),
        ({"a": np.array([0, np.nan, 0], np.float32)}, None, "not finite"),
        ({"a": np.zeros(3, np.float32)}, np.array([[0, 1, 3]]), "outside the 3 vertices"),
        ({"a": np.zeros(3, np.float32)}, np.array([[0, 1, -1]]), "outside the 3 vertices"),
        ({"a": np.zeros(3, np.float32)}, np.array([0, 1, 2]), r"expected \(t, 3\) integers"),
        ({"a": np.zeros(3, np.float32)}, np.array([[0.0, 1.0, 2.0]]), r"expected \(t, 3\) integers"),
    ],
)
def test_arrays_that_make_no_mesh_are_refused(
    ctx: moderngl.Context, attributes: dict[str, np.ndarray], triangles: np.ndarray | None, problem: str
) -> None:
    with pytest.raises(GraphicsError, match=problem):
        mesh_buffers(ctx, attributes, triangles)


def test_full_screen_program_reads_no_attributes(ctx: moderngl.Context, program: moderngl.Program) -> None:
    with pytest.raises(GraphicsError, match="this one reads position, surface, tag"):
        screen_triangle(ctx, program)
    program.release()
