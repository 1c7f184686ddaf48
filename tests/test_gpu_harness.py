from pathlib import Path

import moderngl
import numpy as np
import pytest
from glsl_harness import evaluate

from sensorsim.errors import GraphicsError
from sensorsim.gpu import Field, UniformBlock, constants_glsl, float_table


def test_harness_evaluates_a_function_for_every_row(ctx: moderngl.Context, tmp_path: Path) -> None:
    (tmp_path / "common").mkdir()
    (tmp_path / "common" / "scaled.glsl").write_text(
        "vec3 scaled(vec3 v, float factor, int offset) { return v * factor + float(offset); }\n"
    )
    rng = np.random.default_rng(5)
    count = 2500  # more than two rows of the picture, the last one partly filled
    v = rng.normal(size=(count, 3)).astype(np.float32)
    factor = rng.integers(-8, 8, count).astype(np.float32)  # small powers of two keep the product exact enough
    offset = rng.integers(-100, 100, count)
    result = evaluate(
        ctx,
        "scaled(v, factor, offset)",
        {"v": v, "factor": factor, "offset": offset},
        include=["common/scaled.glsl"],
        returns="vec3",
        root=tmp_path,
    )
    assert result.shape == (count, 3)
    np.testing.assert_allclose(result, v * factor[:, None] + offset[:, None], rtol=0, atol=2e-5)


def test_harness_passes_blocks_tables_and_generated_constants(ctx: moderngl.Context) -> None:
    block = UniformBlock(name="Gain", binding=3, fields=(Field("factor", "float", "[-]"),))
    table = float_table(ctx, "row", np.array([[1.5, 2.5, 3.5]]))
    result = evaluate(
        ctx,
        "gain.factor * texelFetch(row, ivec2(i, 0), 0).r + ZERO_CELSIUS",
        {"i": np.array([0, 1, 2])},
        include=["generated/gain_block.glsl", "generated/constants.glsl", "generated/row.glsl"],
        generated={"constants": constants_glsl(), "row": "uniform sampler2D row;\n"},
        blocks={block: block.pack(factor=2.0)},
        tables={"row": table},
    )
    table.release()
    np.testing.assert_allclose(result, np.array([3.0, 5.0, 7.0]) + 273.15, rtol=1e-7)


def test_every_constant_reads_back_in_single_precision(ctx: moderngl.Context) -> None:
    from sensorsim import constants

    for name, value in vars(constants).items():
        if name.isupper():
            text = {"constants": constants_glsl()}
            result = evaluate(ctx, name, {"i": np.array([0])}, include=["generated/constants.glsl"], generated=text)
            assert result[0] == np.float32(value), name


def test_harness_errors_name_the_expression(ctx: moderngl.Context) -> None:
    with pytest.raises(GraphicsError, match=r"harness\.frag:\d+\(\d+\): error.*missing"):
        evaluate(ctx, "missing(x)", {"x": np.array([0.0])})
