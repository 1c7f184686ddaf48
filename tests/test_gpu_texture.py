import re

import moderngl
import numpy as np
import pytest
from glsl_harness import evaluate

from sensorsim.errors import GraphicsError
from sensorsim.gpu import float_table, integer_table, update_table


def fetch(ctx: moderngl.Context, table: moderngl.Texture, kind: str) -> np.ndarray:
    """Every texel of a table as [row, column, component]."""
    row, column = np.indices((table.height, table.width)).reshape(2, -1)
    values = evaluate(
        ctx,
        "vec4(texelFetch(table, ivec2(column, row), 0))",
        {"row": row, "column": column},
        include=["generated/table.glsl"],
        generated={"table": f"uniform {kind} table;\n"},
        returns="vec4",
        tables={"table": table},
    )
    return values.reshape(table.height, table.width, 4)[:, :, : table.components]


@pytest.mark.parametrize("shape", [(3, 7), (5, 3, 1), (3, 5, 2), (2, 3, 4)])
def test_float_table_texels_are_the_array(ctx: moderngl.Context, shape: tuple[int, ...]) -> None:
    data = np.random.default_rng(7).normal(300.0, 50.0, shape)
    table = float_table(ctx, "kelvin", data)
    expected = data.astype(np.float32).reshape(shape[0], shape[1], -1)
    np.testing.assert_array_equal(fetch(ctx, table, "sampler2D"), expected)
    update_table(table, -data[:, ::-1])  # a view with negative strides
    np.testing.assert_array_equal(fetch(ctx, table, "sampler2D"), -expected[:, ::-1])
    table.release()


@pytest.mark.parametrize("shape", [(3, 7), (2, 3, 4)])
def test_integer_table_texels_are_the_array(ctx: moderngl.Context, shape: tuple[int, ...]) -> None:
    data = np.random.default_rng(8).integers(-(2**23), 2**23, shape)
    table = integer_table(ctx, "rows", data)
    np.testing.assert_array_equal(fetch(ctx, table, "isampler2D"), data.reshape(shape[0], shape[1], -1))
    table.release()


@pytest.mark.parametrize(
    ("data", "problem"),
    [
        (np.array([[1.0, np.nan]]), r"entry \(0, 1, 0\) is nan"),
        (np.array([[1.0], [1e39]]), r"entry \(1, 0, 0\) is 1e\+39"),
        (np.array([[1, 2]]), "array of int64, expected floats"),
        (np.zeros((2, 2, 3)), r"shape \(2, 2, 3\)"),
        (np.zeros(4), r"shape \(4,\)"),
        (np.zeros((0, 4)), r"shape \(0, 4\)"),
    ],
)
def test_data_that_no_float_table_can_hold_is_refused(ctx: moderngl.Context, data: np.ndarray, problem: str) -> None:
    with pytest.raises(GraphicsError, match=f"table 'kelvin': .*{problem}"):
        float_table(ctx, "kelvin", data)


@pytest.mark.parametrize("data", [np.array([[1.0]]), np.array([[2**31]]), np.zeros((2, 2, 2), int)])
def test_data_that_no_integer_table_can_hold_is_refused(ctx: moderngl.Context, data: np.ndarray) -> None:
    with pytest.raises(GraphicsError, match="table 'rows': "):
        integer_table(ctx, "rows", data)


def test_a_table_beyond_the_limit_is_named(ctx: moderngl.Context) -> None:
    limit = ctx.info["GL_MAX_TEXTURE_SIZE"]
    message = f"table 'kelvin': 1 rows x {limit + 1} columns, but this OpenGL allows {limit} a side"
    with pytest.raises(GraphicsError, match=re.escape(message)):
        float_table(ctx, "kelvin", np.zeros((1, limit + 1)))


def test_update_keeps_shape_and_kind(ctx: moderngl.Context) -> None:
    table = float_table(ctx, "kelvin", np.zeros((2, 3)))
    for data in (np.zeros((3, 2)), np.zeros((2, 3, 2)), np.zeros((2, 3), int)):
        with pytest.raises(GraphicsError, match="table 'kelvin'"):
            update_table(table, data)
    table.release()
