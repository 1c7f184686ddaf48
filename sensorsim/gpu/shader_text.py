"""What the include expander asks of GLSL text: code without comments, identifiers, names under `#if`."""

import re

from sensorsim.errors import GraphicsError

_COMMENT = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
_IDENTIFIER = re.compile(r"\b[A-Za-z_][A-Za-z0-9_]*")
_PREDEFINED = frozenset({"defined", "__VERSION__"})


def code_lines(name: str, text: str) -> list[str]:
    """The lines of a text with their comments blanked, each still at its line and column.

    Directives inside comments so have no effect, and no driver can lose count of lines over a comment. GLSL 3.30 knows
    neither characters outside ASCII nor line continuation; both raise GraphicsError with file and line, as does a
    comment that is not closed.
    """
    unix = text.replace("\r\n", "\n")
    lines = _COMMENT.sub(lambda match: _blank(name, unix, match), unix).split("\n")
    for number, line in enumerate(lines, start=1):
        if not line.isascii():
            raise GraphicsError(f"{name}:{number}: GLSL is ASCII outside comments")
        if line.endswith("\\"):
            raise GraphicsError(f"{name}:{number}: a backslash at the end of a line does not continue it in GLSL 3.30")
    return [line.rstrip() for line in lines]


def find_identifiers(code: str) -> frozenset[str]:
    """Identifiers and key words in a piece of code without comments."""
    return frozenset(_IDENTIFIER.findall(code))


def preprocessor_names(directive: str, rest: str) -> frozenset[str]:
    """Names that a conditional directive tests; empty for any other directive."""
    if directive not in ("if", "ifdef", "ifndef", "elif"):
        return frozenset()
    return find_identifiers(rest) - _PREDEFINED


def _blank(name: str, text: str, match: re.Match[str]) -> str:
    comment = match[0]
    if comment.startswith("/*") and (len(comment) < 4 or not comment.endswith("*/")):
        line = text.count("\n", 0, match.start()) + 1
        raise GraphicsError(f"{name}:{line}: comment is not closed")
    return re.sub(r"[^\n]", " ", comment)
