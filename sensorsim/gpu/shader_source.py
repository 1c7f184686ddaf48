"""Shader text from files: includes, defines, and driver messages that lead back to file and line.

The files are GLSL that any editor or compiler front end reads. An entry file (`.vert`, `.frag`) opens with
`#version 330 core`; the defines follow that line. `#include "folder/name.glsl"` stands at file scope, outside any
`#if`, and is taken in once; `#include "generated/name.glsl"` takes a text handed over by Python. `#if` may test given
names only, because a driver takes an unknown name for 0 without a word.

Each file's lines are numbered on from where the file before it ended, and `#line` tells the driver so. The line alone
then names the file: Mesa reports file number 0 for many errors, whatever `#line` said.
"""

import re
from bisect import bisect_left
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from sensorsim.errors import GraphicsError
from sensorsim.gpu.shader_text import code_lines, find_identifiers, preprocessor_names
from sensorsim.resources import shaders_folder

_ENTRY_PATH = re.compile(r"([a-z0-9_]+/)*[a-z0-9_]+\.(vert|frag)")
_INCLUDE_PATH = re.compile(r"([a-z0-9_]+/)*[a-z0-9_]+\.glsl")
_INCLUDE = re.compile(r'\s*#\s*include\s*"([^"]*)"\s*')
_DIRECTIVE = re.compile(r"\s*#\s*([a-z]+)\b(.*)")
_DEFINE_NAME = re.compile(r"(?!GL_)(?!.*__)[A-Z][A-Z0-9_]*")
_VERSION = re.compile(r"\s*#\s*version\s+330\s+core\s*")
# `2:14(5): error`, `2:14: error` (Mesa and others) and `2(14) : error` (NVIDIA)
_LOCATION = re.compile(r"\b(?P<file>\d+)(?::(?P<line>\d+)(?P<column>\(\d+\))?(?=:)|\((?P<bracketed>\d+)\)(?= ?:))")


@dataclass(frozen=True, slots=True, kw_only=True)
class ShaderSource:
    """Expanded text of one shader stage."""

    text: str
    files: tuple[str, ...]  # files[i] is the file that `#line` calls i; files[0] is the entry
    line_offsets: tuple[int, ...]  # what `#line` adds to the line numbers of files[i], ascending
    defines_used: frozenset[str]  # the given defines that the text mentions outside comments

    def translate(self, log: str) -> str:
        """A driver's message with its numbers replaced by file and line: `radiance/path.glsl:12(5): ...`."""

        def name(match: re.Match[str]) -> str:
            line = int(match["line"] or match["bracketed"])
            file = bisect_left(self.line_offsets, line) - 1
            if file < 0 or int(match["file"]) >= len(self.files):
                return match[0]
            return f"{self.files[file]}:{line - self.line_offsets[file]}{match['column'] or ''}"

        return _LOCATION.sub(name, log)


def expand_source(
    path: str,
    *,
    defines: Mapping[str, int] | None = None,
    generated: Mapping[str, str] | None = None,
    root: Path | None = None,
) -> ShaderSource:
    """Expand an entry file, its path given from the shaders folder: 'scene/surface.frag'.

    `defines` maps upper-case names to integers; `generated` maps NAME to the text of `generated/NAME.glsl`; `root`
    stands in for the package's shaders folder. Raises GraphicsError naming file and line.
    """
    if not _ENTRY_PATH.fullmatch(path):
        raise GraphicsError(f"{path}: not an entry file; give 'folder/name.vert' or 'folder/name.frag', snake_case")
    folder = root or shaders_folder()
    return expand_text(path, _read(folder, path, path), defines=defines, generated=generated, root=folder)


def expand_text(
    name: str,
    text: str,
    *,
    defines: Mapping[str, int] | None = None,
    generated: Mapping[str, str] | None = None,
    root: Path | None = None,
) -> ShaderSource:
    """Expand an entry text that is in memory; messages call it `name`. Otherwise as `expand_source`."""
    given = {key: _define_value(key, value) for key, value in (defines or {}).items()}
    expander = _Expander(root or shaders_folder(), generated or {}, given)
    expander.take(name, text, ())
    expanded = "\n".join(expander.lines) + "\n"
    used = frozenset(given) & frozenset().union(*expander.identifiers)
    return ShaderSource(
        text=expanded, files=tuple(expander.files), line_offsets=tuple(expander.line_offsets), defines_used=used
    )


class _Expander:
    """The growing text of one stage; `take` appends a file and, where it includes others, those first."""

    def __init__(self, root: Path, generated: Mapping[str, str], defines: Mapping[str, int]) -> None:
        self.root, self.generated, self.defines = root, generated, defines
        self.lines: list[str] = []
        self.files: list[str] = []
        self.line_offsets: list[int] = []
        self.next_line = 0
        self.identifiers: list[frozenset[str]] = []

    def take(self, name: str, text: str, chain: tuple[str, ...]) -> None:
        number, base = len(self.files), self.next_line
        self.files.append(name)
        self.line_offsets.append(base)
        self.next_line += text.count("\n") + 1
        awaiting_version = not chain
        depth = 0  # of braces and conditionals together: file scope is 0
        for line, code in enumerate(code_lines(name, text), start=1):
            where = f"{name}:{line}"
            if awaiting_version and code:
                self._take_version(where, code, line)
                awaiting_version = False
                continue
            directive = _DIRECTIVE.fullmatch(code)
            word, rest = (directive[1], directive[2]) if directive else ("", code)
            depth += code.count("{") - code.count("}") + word.startswith("if") - (word == "endif")
            if word == "include":
                self._include(where, code, depth, (*chain, name))
                self.lines.append(f"#line {base + line + 1} {number}")
                continue
            self._check(where, word, rest)
            self.identifiers.append(find_identifiers(code))
            self.lines.append(code)
        if awaiting_version:
            raise GraphicsError(f"{name}:1: an entry file opens with '#version 330 core'; it holds no code")

    def _take_version(self, where: str, code: str, line: int) -> None:
        if not _VERSION.fullmatch(code):
            raise GraphicsError(f"{where}: an entry file opens with '#version 330 core', not with '{code.strip()}'")
        self.lines.append("#version 330 core")
        self.lines.extend(f"#define {name} {value}" for name, value in self.defines.items())
        self.lines.append(f"#line {line + 1} 0")

    def _include(self, where: str, code: str, depth: int, chain: tuple[str, ...]) -> None:
        match = _INCLUDE.fullmatch(code)
        if not match or not _INCLUDE_PATH.fullmatch(match[1]):
            raise GraphicsError(
                f"{where}: '{code.strip()}' is not of the form #include \"folder/name.glsl\", snake_case"
            )
        if depth != 0:
            raise GraphicsError(f"{where}: #include stands at file scope only, outside braces and #if")
        name = match[1]
        if name in chain:
            raise GraphicsError(f"{where}: include cycle {' -> '.join((*chain[chain.index(name) :], name))}")
        if name not in self.files:
            text = self._text(where, name)
            self.lines.append(f"#line {self.next_line + 1} {len(self.files)}")
            self.take(name, text, chain)

    def _text(self, where: str, name: str) -> str:
        key = name.removeprefix("generated/").removesuffix(".glsl")
        if not name.startswith("generated/"):
            return _read(self.root, name, where)
        if key not in self.generated:
            given = ", ".join(sorted(self.generated)) or "none"
            raise GraphicsError(f"{where}: no generated text '{key}' was given; given are: {given}")
        return self.generated[key]

    def _check(self, where: str, word: str, rest: str) -> None:
        if word == "version":
            raise GraphicsError(f"{where}: #version belongs on the first line of an entry file")
        if word == "line":
            raise GraphicsError(f"{where}: #line is written by the expander")
        unknown = preprocessor_names(word, rest) - self.defines.keys()
        if unknown:
            given = ", ".join(sorted(self.defines)) or "none"
            raise GraphicsError(f"{where}: #{word} tests {', '.join(sorted(unknown))}, not given; given are: {given}")


def _define_value(name: str, value: int) -> int:
    if not _DEFINE_NAME.fullmatch(name):
        raise GraphicsError(f"define '{name}': a name is upper case with single underscores, and not GL_...")
    if not isinstance(value, int):
        raise GraphicsError(f"define {name} = {value!r}: a define is an integer; numbers come from generated/")
    return int(value)


def _read(root: Path, name: str, where: str) -> str:
    try:
        return (root / name).read_text(encoding="utf-8")
    except OSError as error:
        raise GraphicsError(f"{where}: cannot read shader '{name}' under {root}: {error.strerror}") from error
