"""The house rules, held by reading the files: who imports whom, how long things are, which names and sources exist.

Everything is read from the repository root with no help from version control. Where a rule counts lines, the span of
lines in the file counts, blank lines and comments included.
"""

import ast
import collections
import importlib
import json
import re
import statistics
import subprocess
import sys
import tokenize
import tomllib
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = ROOT / "sensorsim"

# From the ground up. A room may import rooms of lower floors and its own modules, never a neighbour on its floor.
FLOORS: tuple[tuple[str, ...], ...] = (
    ("constants", "errors", "files", "units", "resources", "version"),
    ("radiometry",),
    ("scene", "materials", "environment", "sensor"),
    ("effects",),
    ("thermal",),
    ("tables",),
    ("gpu",),
    ("render",),
    ("frames",),
    ("viewer", "trainer", "study"),
    ("",),  # sensorsim/__init__.py, the public face
    ("cli",),
    ("__main__",),
)
FLOOR_OF = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
OPENGL = {"moderngl", "glcontext", "OpenGL"}
WINDOWS = {
    *{"glfw", "glumpy", "imgui", "imgui_bundle", "kivy", "moderngl_window", "panda3d", "pygame", "pyglet", "pyrender"},
    *{"PyQt5", "PyQt6", "PySide2", "PySide6", "sdl2", "tkinter", "turtle", "vispy", "vtk", "wx"},
}

LONGEST_MODULE = 300
LONGEST_MEDIAN = 120
LONGEST_BODY = 30
LONGEST_SHADER = 150

KEPT_OUT = {"__pycache__", "build", "dist", "node_modules", "out"}
UNFINISHED = re.compile("|".join(("TO" + "DO", "FIX" + "ME", "XX" + "X")))
MACHINE_PATH = re.compile(r"(?<![\w.~-])/(?:work|tmp|root|home)\b(?!\.)")
DATA_FORMATS: Mapping[str, Callable[[str], object]] = {
    ".toml": tomllib.loads,
    ".json": json.loads,
    ".geojson": json.loads,
}
PROSE = {".py", ".toml", ".csv", ".geojson", ".frag", ".vert", ".glsl", ".bib", ".md"}
KEY = re.compile(r"[A-Z][A-Za-z]+\d{1,5}[a-z]?")


def _files(*tops: str) -> list[Path]:
    """Files under the named entries of the root, without caches and other folders that are made and not kept."""
    found: list[Path] = []
    for top in tops:
        path = ROOT / top
        inside = sorted(path.rglob("*")) if path.is_dir() else [path]
        found += [file for file in inside if file.is_file() and not KEPT_OUT.intersection(file.relative_to(ROOT).parts)]
    return found


def _named(path: Path) -> str:
    return path.relative_to(ROOT).as_posix()


MODULES = [path for path in _files("sensorsim") if path.suffix == ".py"]
PACKAGES = sorted({path.parent for path in MODULES})
SHADERS = [path for path in _files("shaders") if path.suffix != ".md"]
TREES: Mapping[Path, ast.Module] = {path: ast.parse(path.read_text("utf-8"), str(path)) for path in MODULES}


def _dotted(path: Path) -> tuple[str, ...]:
    """Dotted name of a module, the package's own name first; a package is named by its folder."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return parts[:-1] if parts[-1] == "__init__" else parts


KNOWN_MODULES = {_dotted(path) for path in MODULES}


def _room(dotted: tuple[str, ...]) -> str:
    return dotted[1] if len(dotted) > 1 else ""


def _imports(path: Path) -> Iterator[tuple[int, tuple[str, ...]]]:
    """Line and dotted name of all that a module imports, wherever in it the import stands."""
    package = _dotted(path) if path.name == "__init__.py" else _dotted(path)[:-1]
    for node in ast.walk(TREES[path]):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield node.lineno, tuple(alias.name.split("."))
        elif isinstance(node, ast.ImportFrom):
            start = package[: len(package) - node.level + 1] if node.level else ()
            origin = start + (tuple(node.module.split(".")) if node.module else ())
            for alias in node.names:
                yield node.lineno, (*origin, alias.name)


def _own_imports(path: Path) -> Iterator[tuple[int, tuple[str, ...]]]:
    """Line and dotted name of the modules of this package that a module imports."""
    for line, dotted in _imports(path):
        if dotted[0] == PACKAGE.name:
            yield line, dotted if dotted in KNOWN_MODULES else dotted[:-1]


def _functions(tree: ast.Module) -> Iterator[ast.FunctionDef | ast.AsyncFunctionDef]:
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            yield node


def _body_lines(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    """Lines from the first statement after the docstring to the last one."""
    body = function.body[1:] if ast.get_docstring(function, clean=False) is not None else function.body
    return (body[-1].end_lineno or 0) - body[0].lineno + 1 if body else 0


# --- imports -----------------------------------------------------------------------------------------------------


def test_every_module_belongs_to_a_room_with_a_floor() -> None:
    assert MODULES, f"no module found under {PACKAGE}"
    assert {_named(path): _room(_dotted(path)) for path in MODULES if _room(_dotted(path)) not in FLOOR_OF} == {}


def test_imports_run_one_way() -> None:
    wrong = []
    for path in MODULES:
        here = _room(_dotted(path))
        for line, dotted in _own_imports(path):
            there = _room(dotted)
            if there != here and FLOOR_OF.get(there, -1) >= FLOOR_OF.get(here, len(FLOORS)):
                wrong.append(f"{_named(path)}:{line}: {here or 'the public face'} imports {'.'.join(dotted)}")
    assert wrong == []


def test_modules_of_a_room_do_not_import_in_circles() -> None:
    below = {_dotted(path): {dotted for _, dotted in _own_imports(path)} - {_dotted(path)} for path in MODULES}
    while free := {module for module, imported in below.items() if not imported.intersection(below)}:
        below = {module: imported for module, imported in below.items() if module not in free}
    assert sorted(".".join(module) for module in below) == []


def test_only_the_rooms_from_gpu_upwards_import_opengl() -> None:
    wrong = [
        f"{_named(path)}:{line}: {dotted[0]}"
        for path in MODULES
        for line, dotted in _imports(path)
        if dotted[0] in OPENGL and FLOOR_OF.get(_room(_dotted(path)), -1) < FLOOR_OF["gpu"]
    ]
    assert wrong == []


def test_only_the_viewer_imports_a_window_library() -> None:
    wrong = [
        f"{_named(path)}:{line}: {dotted[0]}"
        for path in MODULES
        for line, dotted in _imports(path)
        if dotted[0] in WINDOWS and _room(_dotted(path)) != "viewer"
    ]
    assert wrong == []


def test_the_viewers_face_needs_no_window_library() -> None:
    """Without the extra the package and its command line still load."""
    code = "import sys\nfor name in {names!r}: sys.modules[name] = None\nimport sensorsim.cli, sensorsim.viewer"
    run = [sys.executable, "-c", code.format(names=sorted(WINDOWS))]
    done = subprocess.run(run, cwd=ROOT, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr


# --- sizes -------------------------------------------------------------------------------------------------------


def test_no_module_is_longer_than_its_limit() -> None:
    lengths = {_named(path): len(path.read_text("utf-8").splitlines()) for path in MODULES}
    assert {name: length for name, length in lengths.items() if length > LONGEST_MODULE} == {}


def test_median_module_is_short() -> None:
    """Faces (`__init__`, `__main__`) do not count: they would flatter the median."""
    lengths = [len(path.read_text("utf-8").splitlines()) for path in MODULES if not path.name.startswith("__")]
    assert statistics.median(lengths) <= LONGEST_MEDIAN


def test_no_function_body_is_longer_than_its_limit() -> None:
    long = {
        f"{_named(path)}:{function.lineno}: {function.name}": _body_lines(function)
        for path in MODULES
        for function in _functions(TREES[path])
        if _body_lines(function) > LONGEST_BODY
    }
    assert long == {}


def test_no_shader_file_is_longer_than_its_limit() -> None:
    lengths = {_named(path): len(path.read_text("utf-8").splitlines()) for path in SHADERS}
    assert lengths, "no shader found"
    assert {name: length for name, length in lengths.items() if length > LONGEST_SHADER} == {}


# --- what is not written -----------------------------------------------------------------------------------------


def _fault(node: ast.AST) -> str | None:
    """What is wrong with one node, if anything."""
    match node:
        case ast.Call(func=ast.Name(id="print")):
            return "print"
        case ast.Attribute(value=ast.Name(id="np" | "numpy"), attr="empty" | "empty_like" as name):
            return f"np.{name}: memory nobody wrote"
        case ast.ImportFrom(module="numpy", names=names) if {alias.name for alias in names} & {"empty", "empty_like"}:
            return "numpy.empty: memory nobody wrote"
        case ast.ExceptHandler(type=None):
            return "bare except"
        case ast.Global():
            return "global: state that a module keeps"
    return None


def test_package_has_no_print_no_unwritten_memory_no_bare_except_and_no_global() -> None:
    """The command line is the one room whose work is to print."""
    faults = [
        f"{_named(path)}:{getattr(node, 'lineno', 0)}: {fault}"
        for path in MODULES
        for node in ast.walk(TREES[path])
        if (fault := _fault(node)) and not (fault == "print" and _room(_dotted(path)) == "cli")
    ]
    assert faults == []


def test_no_test_is_skipped_or_expected_to_fail() -> None:
    banned = {"skip", "skipif", "xfail", "importorskip"}
    found = [
        f"{_named(path)}:{node.lineno}: {node.attr}"
        for path in _files("tests")
        if path.suffix == ".py"
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.Attribute) and node.attr in banned
    ]
    assert found == []


def _text(path: Path) -> str | None:
    """The text of a file; None where it is not text."""
    data = path.read_bytes()
    if b"\0" in data:
        return None
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return None


def _lines_with(pattern: re.Pattern[str]) -> list[str]:
    tops = ("sensorsim", "shaders", "tests", "assets", "tools", ".ci", "pyproject.toml")
    return [
        f"{_named(path)}:{number}: {line.strip()[:100]}"
        for path in _files(*tops, "README.md", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE", ".gitignore")
        for number, line in enumerate((_text(path) or "").splitlines(), 1)
        if pattern.search(line)
    ]


def test_no_file_names_a_path_of_the_machine_it_was_written_on() -> None:
    assert _lines_with(MACHINE_PATH) == []


def test_nothing_is_marked_as_unfinished() -> None:
    assert _lines_with(UNFINISHED) == []


@pytest.mark.parametrize("top", ["work", "tmp", "root", "home"])
def test_a_machine_path_is_told_from_what_only_looks_like_one(top: str) -> None:
    """The paths are put together here, so that this file does not hold what it forbids."""
    path = f"/{top}"
    assert all(MACHINE_PATH.search(line) for line in (f"see {path}/x", f'"{path}"', f"file://{path}/a"))
    assert not any(
        MACHINE_PATH.search(line) for line in (f"x.org{path}/a", f"and{path}", f"1{path}", f"{path}s", f"~{path}")
    )


# --- public names ------------------------------------------------------------------------------------------------


def _isort_order(name: str) -> tuple[int, list[tuple[int, int, str]]]:
    """CONSTANTS, then Classes, then functions; numbers inside a name by their value. The order that ruff holds."""
    kind = 0 if name.isupper() else 1 if name[:1].isupper() else 2
    return kind, [(0, int(part), "") if part.isdigit() else (1, 0, part) for part in re.split(r"(\d+)", name)]


@pytest.mark.parametrize("folder", PACKAGES, ids=_named)
def test_public_names_of_a_package_are_sorted_and_exist(folder: Path) -> None:
    module = importlib.import_module(".".join(folder.relative_to(ROOT).parts))
    assert module.__doc__, f"{_named(folder)}/__init__.py says in a paragraph what the room is for"
    names = list(module.__all__)
    assert len(set(names)) == len(names)
    assert names == sorted(names, key=_isort_order)
    assert [name for name in names if not hasattr(module, name)] == []


# --- sources -----------------------------------------------------------------------------------------------------


def _bracketed_keys(text: str) -> Iterator[str]:
    """Keys of references as text gives them: [Name1998], [Name1998 eq. 3], [Name1998; Other2001 table 2]."""
    for bracket in re.findall(rf"\[({KEY.pattern}(?:[\s;,][^\[\]]*)?)\]", text):
        for part in re.split(r"[;,]", bracket):
            first = part.split()[:1]
            yield from (word for word in first if KEY.fullmatch(word))


def _python_prose(path: Path) -> str:
    """Comments and strings, docstrings among them, of a module."""
    with path.open("rb") as file:
        tokens = list(tokenize.tokenize(file.readline))
    return "\n".join(token.string for token in tokens if token.type in (tokenize.COMMENT, tokenize.STRING))


def _shader_prose(path: Path) -> str:
    return "\n".join(re.findall(r"//[^\n]*|/\*.*?\*/", path.read_text("utf-8"), re.DOTALL))


def _sources(value: object) -> Iterator[str]:
    """Texts of all entries named `source` or `..._source`, however deep they lie."""
    if isinstance(value, Mapping):
        for name, inner in value.items():
            if isinstance(inner, str) and (name == "source" or name.endswith("_source")):
                yield inner
            yield from _sources(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from _sources(inner)


def _asset_prose(path: Path) -> str:
    """A data file without TOML's table headers; a bare key that begins a source is put in brackets to be found."""
    text = path.read_text("utf-8")
    parts = [re.sub(r"^\[.*\]$", "", text, flags=re.MULTILINE)]
    for source in _sources(DATA_FORMATS[path.suffix](text)) if path.suffix in DATA_FORMATS else ():
        parts += [f"[{part.strip()}]" for part in source.split(";")]
    return "\n".join(parts)


def _used_keys() -> dict[str, set[str]]:
    """Files by the key they use."""
    prose = {path: _python_prose(path) for path in MODULES}
    prose |= {path: _shader_prose(path) for path in SHADERS}
    prose |= {path: _asset_prose(path) for path in _files("assets") if path.suffix in {*DATA_FORMATS, ".csv"}}
    used: dict[str, set[str]] = {}
    for path, text in prose.items():
        for key in _bracketed_keys(text):
            used.setdefault(key, set()).add(_named(path))
    return used


def test_every_source_named_is_in_the_bibliography_once() -> None:
    bibliography = (ROOT / "assets" / "references.bib").read_text("utf-8")
    entries = re.findall(
        r"^\s*@(?!comment|string|preamble)\w+\s*\{\s*([^,\s]+)", bibliography, re.MULTILINE | re.IGNORECASE
    )
    assert sorted({key for key in entries if entries.count(key) > 1}) == []
    assert {key: sorted(files) for key, files in _used_keys().items() if key not in entries} == {}


def test_every_entry_of_the_bibliography_is_named_somewhere() -> None:
    """In code, shaders, data, tests or tools, or in the note of another entry."""
    bibliography = ROOT / "assets" / "references.bib"
    entries = re.findall(r"^@\w+\{([^,\s]+)", bibliography.read_text("utf-8"), re.MULTILINE)
    folders = ("assets", "sensorsim", "shaders", "tests", "tools")
    texts = [path.read_text("utf-8") for folder in folders for path in _files(folder) if path.suffix in PROSE]
    words = collections.Counter(re.findall(r"\w+", "\n".join(texts)))
    assert [key for key in entries if words[key] < 2] == []


def test_keys_are_found_in_prose_and_shapes_are_not() -> None:
    prose = "eq. 3 of [Prata1996]; [Berdahl1984 table 2; Idso1981, p. 4] [NIST811], [W m-2 sr-1] (n, 3) [K] [m2 K W-1]"
    assert list(_bracketed_keys(prose)) == ["Prata1996", "Berdahl1984", "Idso1981", "NIST811"]


# --- version -----------------------------------------------------------------------------------------------------


def test_changelog_and_package_agree_on_the_version() -> None:
    headings = re.findall(r"^## \[?(\d[^\]\s]*)", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    package = importlib.import_module(PACKAGE.name)
    assert headings[:1] == [package.__version__]
