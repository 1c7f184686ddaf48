"""A page of a study: headings, text, tables and plots in one HTML file that opens from disk and loads nothing."""

import base64
import html
import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from sensorsim.errors import InputError
from sensorsim.files import placed_whole

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; max-width: 68rem; margin: 2rem auto; padding: 0 1rem; color: #1b1f24; }
h1, h2 { line-height: 1.2; } h2 { margin-top: 2.2rem; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: 1rem 0; }
th, td { padding: .25rem .7rem; border-bottom: 1px solid #d5dae0; text-align: left; vertical-align: top; }
th { border-bottom: 2px solid #8a94a0; } td.number { text-align: right; white-space: nowrap; }
tr.alarm td { background: #fde7e4; } img { max-width: 100%; } p.note { color: #57606a; }
"""


NOTE, ALARM = ' class="note"', ' class="alarm"'


class Page:
    """Collects parts in order; `write` puts the file in place whole or not at all."""

    def __init__(self, title: str) -> None:
        self.title = title
        self.parts: list[str] = [f"<h1>{html.escape(title)}</h1>"]

    def heading(self, text: str) -> None:
        """Begin a section."""
        self.parts.append(f"<h2>{html.escape(text)}</h2>")

    def text(self, text: str, *, note: bool = False) -> None:
        """One paragraph; a `note` is set back."""
        self.parts.append(f"<p{NOTE if note else ''}>{html.escape(text)}</p>")

    def table(self, head: Sequence[str], rows: Sequence[Sequence[Any]], *, alarm: Sequence[bool] = ()) -> None:
        """A table; numbers stand to the right in five digits, rows marked in `alarm` are coloured."""
        marks = list(alarm) or [False] * len(rows)
        body = "".join(
            f"<tr{ALARM if mark else ''}>{''.join(map(_cell, row))}</tr>" for row, mark in zip(rows, marks, strict=True)
        )
        titles = "".join(f"<th>{html.escape(name)}</th>" for name in head)
        self.parts.append(f"<table><thead><tr>{titles}</tr></thead><tbody>{body}</tbody></table>")

    def figure(self, figure: Any, caption: str) -> None:
        """A matplotlib figure as a picture in the page; the figure stays the caller's to close."""
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png", dpi=110, bbox_inches="tight")
        text = base64.b64encode(buffer.getvalue()).decode()
        words = html.escape(caption)
        self.parts.append(f'<p><img src="data:image/png;base64,{text}" alt="{words}"></p><p class="note">{words}</p>')

    def write(self, path: Path) -> None:
        """The page as one file."""
        head = f'<meta charset="utf-8"><title>{html.escape(self.title)}</title><style>{STYLE}</style>'
        content = f'<!doctype html><html lang="en"><head>{head}</head><body>{"".join(self.parts)}</body></html>\n'
        try:
            with placed_whole(path) as (partial,):
                partial.write_text(content, encoding="utf-8")
        except OSError as error:
            problem = f"the page cannot be written: {error.strerror}"
            raise InputError("study", "page", str(path), problem, "name another place") from error


def _cell(value: Any) -> str:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return f"<td>{html.escape(str(value))}</td>"
    return f'<td class="number">{value:.5g}</td>'
