import re

import moderngl
import numpy as np
import pytest
from glsl_harness import evaluate

from sensorsim.errors import GraphicsError
from sensorsim.gpu import Field, UniformBlock

BLOCK = UniformBlock(
    name="ProbeFrame",
    binding=2,
    fields=(
        Field("gain", "float", "gain [-]"),
        Field("camera_position", "vec3", "[m]"),
        Field("time_of_day", "float", "[s] since local midnight"),  # std140 packs it into the vec3's last word
        Field("screen", "vec2", "[pixel]"),
        Field("count", "int", "[-]"),
        Field("clip_from_world", "mat4", "[-]"),
        Field("seed", "uint", "[-]"),
        Field("lobes", "vec4", "direction, weight [K]", count=3),
        Field("last", "vec2", "[-]"),
        Field("views", "mat4", "[-]", count=2),
        Field("tail", "float", "[-]"),
    ),
)


def random_values(rng: np.random.Generator) -> dict[str, np.ndarray]:
    values = {}
    for field in BLOCK.fields:
        if field.type in ("int", "uint"):
            limits = np.iinfo(np.int32 if field.type == "int" else np.uint32)
            values[field.name] = rng.integers(limits.min, limits.max, dtype=np.int64)
        else:
            values[field.name] = rng.normal(size=field.shape).astype(np.float32)
    return values


def elements(field: Field) -> list[tuple[str, tuple[int, ...]]]:
    """GLSL expression and NumPy index of each scalar; GLSL's m[c][r] is NumPy's m[r, c]."""
    found = []
    for index in np.ndindex(field.shape):
        own = index if field.count is None else index[1:]
        where = own[::-1] if field.type == "mat4" else own
        outer = "" if field.count is None else f"[{index[0]}]"
        found.append((f"probe_frame.{field.name}{outer}" + "".join(f"[{i}]" for i in where), index))
    return found


def test_every_member_reads_back_exactly_on_the_gpu(ctx: moderngl.Context) -> None:
    values = random_values(np.random.default_rng(11))
    packed = {BLOCK: BLOCK.pack(**values)}
    scalars = [(field, *element) for field in BLOCK.fields for element in elements(field)]
    # One drawing: row i of the input selects scalar i; integers go through in two halves, each exact in a float.
    lines = []
    for i, (field, expression, _) in enumerate(scalars):
        high, low = (
            f"float({expression} >> 16)",
            f"float({expression} & {'0xffffu' if field.type == 'uint' else '0xffff'})",
        )
        value = f"vec2({high}, {low})" if field.type in ("int", "uint") else f"vec2({expression}, 0.0)"
        lines.append(f"if (i == {i}) return {value};")
    probe = "vec2 probe(int i) {\n" + "\n".join(lines) + "\nreturn vec2(0.0);\n}\n"
    result = evaluate(
        ctx,
        "probe(i)",
        {"i": np.arange(len(scalars))},
        include=[f"generated/{BLOCK.include_name}.glsl", "generated/probe.glsl"],
        generated={"probe": probe},
        returns="vec2",
        blocks=packed,
    )
    for (field, expression, index), read in zip(scalars, result.astype(np.float64), strict=True):
        got = read[0] * 65536.0 + read[1] if field.type in ("int", "uint") else read[0]
        assert got == np.asarray(values[field.name])[index], expression


def test_offsets_follow_std140() -> None:
    offsets = {name: offset for name, _, offset, _ in BLOCK.table_rows()}
    assert list(offsets.values()) == [0, 16, 28, 32, 40, 48, 112, 128, 176, 192, 320]
    assert BLOCK.dtype.itemsize == len(BLOCK.pack(**random_values(np.random.default_rng(1)))) == 336


def test_matrix_times_vector_is_the_same_in_both_languages(ctx: moderngl.Context) -> None:
    rng = np.random.default_rng(3)
    block = UniformBlock(name="View", binding=0, fields=(Field("clip_from_world", "mat4", "[-]"),))
    matrix, points = rng.integers(-9, 9, (4, 4)).astype(float), rng.integers(-9, 9, (50, 4)).astype(float)
    result = evaluate(
        ctx,
        "view.clip_from_world * p",
        {"p": points},
        include=["generated/view_block.glsl"],
        returns="vec4",
        blocks={block: block.pack(clip_from_world=matrix)},
    )
    np.testing.assert_array_equal(result, points @ matrix.T)


def test_text_and_rows_carry_the_documentation() -> None:
    assert (BLOCK.instance, BLOCK.include_name) == ("probe_frame", "probe_frame_block")
    text = BLOCK.glsl()
    assert text.startswith("layout(std140, row_major) uniform ProbeFrame {\n")
    for name, kind, _, description in BLOCK.table_rows():
        base, count = re.fullmatch(r"(\w+)(.*)", kind).groups()  # type: ignore[union-attr]
        assert f"    {base} {name}{count};  // {description}\n" in text


@pytest.mark.parametrize(
    ("change", "problem"),
    [
        ({"gain": None}, r"missing \['gain'\]"),
        ({"gian": 1.0}, r"unknown \['gian'\]"),
        ({"gain": np.nan}, "gain = nan is not finite"),
        ({"camera_position": (0.0, np.inf, 0.0)}, "camera_position"),
        ({"gain": 1e39}, "does not fit float32"),
        ({"camera_position": (0.0, 1.0)}, r"shape \(2,\), expected \(3,\)"),
        ({"gain": (1.0,)}, r"shape \(1,\), expected \(\)"),
        ({"lobes": np.zeros((4, 4))}, r"expected \(3, 4\)"),
        ({"count": 1.0}, "count is of type float64, expected int32"),
        ({"count": 2**31}, "does not fit int32"),
        ({"seed": -1}, "does not fit uint32"),
        ({"gain": True}, "type bool"),
        ({"gain": "1"}, "expected float32"),
    ],
)
def test_values_that_do_not_fit_are_refused(change: dict[str, object], problem: str) -> None:
    values = {**random_values(np.random.default_rng(2)), **change}
    given = {name: value for name, value in values.items() if value is not None}
    with pytest.raises(GraphicsError, match=f"block ProbeFrame: .*{problem}"):
        BLOCK.pack(**given)


@pytest.mark.parametrize(
    "fields",
    [
        (),
        (Field("a", "mat3", ""),),
        (Field("a", "bool", ""),),
        (Field("a", "float", "", count=4),),
        (Field("a", "vec3", "", count=4),),
        (Field("a", "vec4", "", count=0),),
        (Field("a", "float", ""), Field("a", "int", "")),
        (Field("notSnake", "float", ""),),
        (Field("double__under", "float", ""),),
    ],
)
def test_fields_that_std140_makes_treacherous_are_refused(fields: tuple[Field, ...]) -> None:
    with pytest.raises(GraphicsError, match="block Bad"):
        UniformBlock(name="Bad", binding=0, fields=fields)
