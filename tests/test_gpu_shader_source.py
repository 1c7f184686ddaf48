from pathlib import Path

import moderngl
import pytest

from sensorsim.errors import GraphicsError
from sensorsim.gpu import build_program, expand_source

HEAD = "#version 330 core\n"
VERTEX = HEAD + "void main() { gl_Position = vec4(0.0); }\n"


def write(root: Path, files: dict[str, str]) -> Path:
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return root


def test_includes_nest_and_come_in_once(ctx: moderngl.Context, tmp_path: Path) -> None:
    root = write(
        tmp_path,
        {
            "a.vert": VERTEX,
            "a.frag": HEAD + '#include "common/two.glsl"\n#include "common/one.glsl"\n'
            "out vec4 colour;\nvoid main() { colour = vec4(one() + two()); }\n",
            "common/one.glsl": "float one() { return 1.0; }\n",
            "common/two.glsl": '#include "common/one.glsl"\nfloat two() { return one() + one(); }\n',
        },
    )
    source = expand_source("a.frag", root=root)
    assert source.files == ("a.frag", "common/two.glsl", "common/one.glsl")
    assert source.text.count("float one()") == 1
    build_program(ctx, vertex="a.vert", fragment="a.frag", root=root).release()


def test_cycle_is_told_with_its_chain(tmp_path: Path) -> None:
    root = write(
        tmp_path,
        {
            "a.frag": HEAD + '#include "x.glsl"\n',
            "x.glsl": '\n#include "y.glsl"\n',
            "y.glsl": '#include "x.glsl"\n',
        },
    )
    with pytest.raises(GraphicsError, match=r"y\.glsl:1: include cycle x\.glsl -> y\.glsl -> x\.glsl"):
        expand_source("a.frag", root=root)


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("float f() {\n    return missing;\n}\n", r"common/bad\.glsl:2\(\d+\): error.*missing"),
        ("// a comment\n/* two\nlines */ float f() { return missing; }\n", r"common/bad\.glsl:3\(\d+\): error"),
        ('#include "common/good.glsl"\nfloat f() { return missing; }\n', r"common/bad\.glsl:2\(\d+\): error"),
    ],
)
def test_driver_messages_name_file_and_line(ctx: moderngl.Context, tmp_path: Path, body: str, expected: str) -> None:
    root = write(
        tmp_path,
        {
            "a.vert": VERTEX,
            "a.frag": HEAD + '#include "common/bad.glsl"\nout vec4 c;\nvoid main() { c = vec4(f()); }\n',
            "common/bad.glsl": body,
            "common/good.glsl": "float g() { return 1.0; }\n",
        },
    )
    with pytest.raises(GraphicsError, match=r"a\.frag: does not compile\n" + expected):
        build_program(ctx, vertex="a.vert", fragment="a.frag", root=root, defines=None)


def test_line_numbers_after_includes_and_defines_are_the_files_own(ctx: moderngl.Context, tmp_path: Path) -> None:
    text = "// provides nothing\n" + HEAD + '\n#include "one.glsl"\n#include "one.glsl"\nvoid main() { missing(); }\n'
    root = write(tmp_path, {"a.vert": text, "a.frag": VERTEX, "one.glsl": "float one() { return float(ONE); }\n"})
    with pytest.raises(GraphicsError, match=r"a\.vert: does not compile\na\.vert:6\("):
        build_program(ctx, vertex="a.vert", fragment="a.frag", defines={"ONE": 1}, root=root)


def test_messages_of_other_drivers_are_translated(tmp_path: Path) -> None:
    root = write(tmp_path, {"a.frag": HEAD + '#include "scene/one.glsl"\n', "scene/one.glsl": "\n" * 20})
    source = expand_source("a.frag", root=root)
    line = source.line_offsets[1] + 12
    assert source.translate(f"1({line}) : error C1008: undefined") == "scene/one.glsl:12 : error C1008: undefined"
    assert source.translate(f"ERROR: 1:{line}: 'x' : undeclared") == "ERROR: scene/one.glsl:12: 'x' : undeclared"
    assert source.translate(f"0:{line}(3): error: x") == "scene/one.glsl:12(3): error: x"
    assert source.translate("0:2(3): error: x") == "a.frag:2(3): error: x"
    assert source.translate("7:12(3): error: x") == "7:12(3): error: x"


def test_includes_in_comments_have_no_effect(tmp_path: Path) -> None:
    comment = '// #include "no.glsl", 3 \u00b5m\n/*\n#include "no.glsl"\n#if NO \\\n*/'
    text = HEAD + comment + " void main() {}\n"
    source = expand_source("a.frag", root=write(tmp_path, {"a.frag": text}))
    assert source.files == ("a.frag",)
    assert source.text.split() == [*HEAD.split(), "#line", "2", "0", "void", "main()", "{}"]


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("#if MISSPELT", r"a\.frag:2: #if tests MISSPELT, not given; given are: REFLECTIVE"),
        ("#if REFLECTIVE && !defined(MISSPELT)", "tests MISSPELT"),
        ("#ifdef MISSPELT", "#ifdef tests MISSPELT"),
        ("#  ifndef MISSPELT", "#ifndef tests MISSPELT"),
        ("#if REFLECTIVE == 1\n#elif MISSPELT", r"a\.frag:3: #elif tests MISSPELT"),
        ('void f() {\n#include "one.glsl"\n}', r"a\.frag:3: #include stands at file scope"),
        ('#if REFLECTIVE\n#include "one.glsl"\n#endif', r"a\.frag:3: #include stands at file scope"),
        ("#include <one.glsl>", r"a\.frag:2: .* is not of the form"),
        ('#include "../one.glsl"', "is not of the form"),
        ('#include "/one.glsl"', "is not of the form"),
        ('#include "absent.glsl"', r"a\.frag:2: cannot read shader 'absent\.glsl'"),
        ('#include "generated/absent.glsl"', r"a\.frag:2: no generated text 'absent' was given; given are: table"),
        ("#version 330 core", r"a\.frag:2: #version belongs on the first line"),
        ("#line 7", "#line is written by the expander"),
        ("#define TWO \\\n 2", r"a\.frag:2: a backslash"),
        ("float \u00b5m;", r"a\.frag:2: GLSL is ASCII outside comments"),
        ("\n/* open", r"a\.frag:3: comment is not closed"),
    ],
)
def test_text_that_a_driver_would_take_wrongly_is_refused(tmp_path: Path, line: str, problem: str) -> None:
    root = write(tmp_path, {"one.glsl": "\n"})
    (root / "a.frag").write_text(HEAD + line + "\n", encoding="utf-8")
    with pytest.raises(GraphicsError, match=problem):
        expand_source("a.frag", defines={"REFLECTIVE": 1}, generated={"table": ""}, root=root)


@pytest.mark.parametrize("first", ["", "void main() {}\n", "#version 450 core\n", "#version 330\n"])
def test_entry_files_open_with_the_one_version(tmp_path: Path, first: str) -> None:
    with pytest.raises(GraphicsError, match=r"a\.frag:1: an entry file opens with '#version 330 core'"):
        expand_source("a.frag", root=write(tmp_path, {"a.frag": first}))


@pytest.mark.parametrize("path", ["a.glsl", "../a.frag", "/a.frag", "A.frag"])
def test_entry_paths_are_snake_case_below_the_root(tmp_path: Path, path: str) -> None:
    with pytest.raises(GraphicsError, match="not an entry file"):
        expand_source(path, root=tmp_path)


def test_defines_select_and_are_known_by_name(ctx: moderngl.Context, tmp_path: Path) -> None:
    body = "#if REFLECTIVE\nbroken\n#endif\nout vec4 c;\nvoid main() { c = vec4(LOBES); }\n"
    root = write(tmp_path, {"a.vert": VERTEX, "a.frag": HEAD + body})
    build = {"vertex": "a.vert", "fragment": "a.frag", "root": root}
    build_program(ctx, defines={"REFLECTIVE": 0, "LOBES": 11}, **build).release()  # type: ignore[arg-type]
    with pytest.raises(GraphicsError, match=r"a\.frag:3"):
        build_program(ctx, defines={"REFLECTIVE": 1, "LOBES": 11}, **build)  # type: ignore[arg-type]
    with pytest.raises(GraphicsError, match=r"no line mentions the given defines REFLECTIV$"):
        build_program(ctx, defines={"REFLECTIVE": 0, "LOBES": 1, "REFLECTIV": 1}, **build)  # type: ignore[arg-type]


@pytest.mark.parametrize(("name", "value"), [("lower", 1), ("GL_X", 1), ("A__B", 1), ("A", 0.5), ("A", "1")])
def test_defines_are_upper_case_integers(tmp_path: Path, name: str, value: int) -> None:
    with pytest.raises(GraphicsError, match="define"):
        expand_source("a.frag", defines={name: value}, root=write(tmp_path, {"a.frag": HEAD}))
